//! The portable float map: `PF` (three channels) and `Pf` (one), rows from the bottom up.
//!
//! Source: <https://www.pauldebevec.com/Research/HDR/PFM/>.

use crate::error::{Fault, check_size};

/// What a PFM file holds, turned so that row 0 is the top.
pub(crate) struct Pfm {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) n_channels: usize,
    pub(crate) samples: Vec<f32>,
}

/// Decodes a whole file.
///
/// The sign of the scale tells the byte order, negative for little-endian; a magnitude other than one
/// multiplies the values, as pbrt-v4 does it.
pub(crate) fn decode(bytes: &[u8]) -> Result<Pfm, Fault> {
    let mut at = 0;
    let magic = word(bytes, &mut at).ok_or_else(|| Fault::damaged("the file ends inside its header"))?;
    let n_channels = match magic {
        "PF" => 3,
        "Pf" => 1,
        _ => return Err(Fault::damaged("a PFM file starts with `PF` or `Pf`")),
    };
    let width = number(bytes, &mut at, "width")?;
    let height = number(bytes, &mut at, "height")?;
    let scale_text = word(bytes, &mut at).unwrap_or_default();
    let scale: f32 = scale_text.parse().unwrap_or(0.0);
    if !scale.is_normal() {
        return Err(Fault::damaged(format!(
            "the scale `{scale_text}` must be a number other than zero, negative for little-endian"
        )));
    }
    let (width, height) = check_size(width, height, 4 * n_channels as u64, bytes.len())?;
    let data = &bytes[at.min(bytes.len())..];
    let wanted = width * height * n_channels * 4;
    if data.len() != wanted {
        return Err(Fault::damaged(format!(
            "{width} x {height} pixels with {n_channels} channels take {wanted} bytes, but {} follow the header",
            data.len()
        )));
    }
    let mut samples = Vec::with_capacity(width * height * n_channels);
    for row in data.chunks_exact(width * n_channels * 4).rev() {
        let words = row.as_chunks::<4>().0.iter();
        if scale < 0.0 {
            samples.extend(words.map(|b| f32::from_le_bytes(*b)));
        } else {
            samples.extend(words.map(|b| f32::from_be_bytes(*b)));
        }
    }
    let factor = scale.abs();
    if (factor - 1.0).abs() > 0.0 {
        samples.iter_mut().for_each(|v| *v *= factor);
    }
    Ok(Pfm { width, height, n_channels, samples })
}

/// The next word of the header; the single blank that ends it is consumed with it.
fn word<'a>(bytes: &'a [u8], at: &mut usize) -> Option<&'a str> {
    let start = *at + bytes.get(*at..)?.iter().position(|b| !b.is_ascii_whitespace())?;
    let len = bytes[start..].iter().take(32).position(u8::is_ascii_whitespace)?;
    *at = start + len + 1;
    std::str::from_utf8(&bytes[start..start + len]).ok()
}

fn number(bytes: &[u8], at: &mut usize, what: &str) -> Result<u64, Fault> {
    let text = word(bytes, at).unwrap_or_default();
    // `+3` would parse, but no writer says so.
    let plain = !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    text.parse()
        .ok()
        .filter(|_| plain)
        .ok_or_else(|| Fault::damaged(format!("the {what} `{text}` must be a positive whole number")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(header: &str, values: &[f32], little: bool) -> Vec<u8> {
        let mut b = header.as_bytes().to_vec();
        for v in values {
            b.extend(if little { v.to_le_bytes() } else { v.to_be_bytes() });
        }
        b
    }

    #[test]
    fn rows_are_turned_and_bytes_ordered() {
        let v = [1.0, 2.0, 3.0, 4.0];
        for (scale, little) in [("-1", true), ("1.0", false)] {
            let p = decode(&file(&format!("Pf\n2 2\n{scale}\n"), &v, little)).unwrap();
            assert_eq!((p.width, p.height, p.n_channels), (2, 2, 1));
            assert_eq!(p.samples, [3.0, 4.0, 1.0, 2.0]);
        }
        let p = decode(&file("PF 1 1 -2.5 ", &[1.0, 2.0, 4.0], true)).unwrap();
        assert_eq!((p.n_channels, p.samples), (3, vec![2.5, 5.0, 10.0]));
    }

    #[test]
    fn a_first_byte_that_looks_blank_is_data() {
        // 0x0a in front: the header ends with exactly one blank.
        let v = f32::from_le_bytes([0x0a, 0x20, 0x0d, 0x3f]);
        assert_eq!(decode(&file("Pf\n1 1\n-1\n", &[v], true)).unwrap().samples, [v]);
    }

    #[test]
    fn faults_are_named() {
        let cases: [(&str, usize, &str); 11] = [
            ("", 0, "ends inside its header"),
            ("P6\n1 1\n-1\n", 4, "starts with `PF`"),
            ("PFM\n1 1\n-1\n", 4, "starts with `PF`"),
            ("Pf\n-1 1\n-1\n", 4, "width `-1`"),
            ("Pf\n1 1.5\n-1\n", 4, "height `1.5`"),
            ("Pf\n0 1\n-1\n", 4, "empty"),
            ("Pf\n1 1\n0\n", 4, "scale `0`"),
            ("Pf\n1 1\nnan\n", 4, "scale `nan`"),
            ("Pf\n1 1\n-1\n", 3, "but 3 follow"),
            ("Pf\n1 1\n-1\n", 5, "but 5 follow"),
            ("PF\n4000000000 4000000000\n-1\n", 12, "far more than"),
        ];
        for (header, n, want) in cases {
            let mut b = header.as_bytes().to_vec();
            b.resize(b.len() + n, 0);
            let e = decode(&b).err().map(|f| f.at("x.pfm".as_ref()).to_string()).unwrap_or_default();
            assert!(e.contains(want), "{header:?}: {e:?} lacks {want:?}");
        }
    }
}
