//! Lines drawn over a rendered picture: [`over`].

use core::fmt::Write;

use crate::measure::Segment;

/// A mark on a picture.
pub(crate) enum Mark<'a> {
    /// A line of many pieces.
    Curve(&'a [Segment]),
    /// Words at a place, in pixels from the top left corner, that are smaller where they would be wider than so many pixels of the document.
    Word([f64; 2], &'a str, f64),
}

/// An SVG document with the PNG file `png` of `size` pixels, `scale` times as large, and marks over it.
pub(crate) fn over(png: &[u8], size: [usize; 2], scale: f64, marks: &[Mark<'_>]) -> String {
    let [w, h] = size.map(|n| n as f64);
    // Writing to a string cannot fail.
    let mut out = String::new();
    let _ = write!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0}\" height=\"{:.0}\" viewBox=\"0 0 {w} {h}\">\n\
         <image width=\"{w}\" height=\"{h}\" style=\"image-rendering:auto\" href=\"data:image/png;base64,{}\"/>\n",
        w * scale,
        h * scale,
        base64(png)
    );
    let thin = 1.2 / scale;
    for mark in marks {
        match mark {
            Mark::Curve(segments) => {
                let _ = write!(out, "<path fill=\"none\" stroke=\"#ff7a00\" stroke-width=\"{thin:.3}\" d=\"");
                for [a, b] in *segments {
                    let _ = write!(out, "M{:.2} {:.2}L{:.2} {:.2}", a[0], a[1], b[0], b[1]);
                }
                out.push_str("\"/>\n");
            }
            Mark::Word([x, y], word, width) => {
                let size = (1.7 * width / word.len() as f64).min(11.0) / scale;
                let _ = writeln!(
                    out,
                    "<text x=\"{x:.2}\" y=\"{y:.2}\" fill=\"#b34700\" font-family=\"sans-serif\" font-size=\"{size:.2}\">{word}</text>"
                );
            }
        }
    }
    out.push_str("</svg>\n");
    out
}

const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// RFC 4648, with padding.
fn base64(bytes: &[u8]) -> String {
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let bits = three.iter().enumerate().fold(0u32, |b, (i, v)| b | u32::from(*v) << (16 - 8 * i));
        for k in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * k)) as usize & 63];
            out.push(if k <= three.len() { char::from(letter) } else { '=' });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_of_the_standard_are_encoded() {
        // RFC 4648, section 10.
        let pairs = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("foobar", "Zm9vYmFy"),
        ];
        for (text, code) in pairs {
            assert_eq!(base64(text.as_bytes()), code);
        }
    }

    #[test]
    fn the_document_is_well_formed() {
        let curve = [[[1.0, 2.0], [3.0, 4.0]]];
        let svg = over(&[1, 2, 3], [8, 4], 2.0, &[Mark::Curve(&curve), Mark::Word([1.0, 1.0], "h", 9.0)]);
        let document = roxmltree::Document::parse(&svg).unwrap();
        assert_eq!(document.root_element().attribute("width"), Some("16"));
    }
}
