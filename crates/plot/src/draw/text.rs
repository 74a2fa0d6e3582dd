//! Texts and numbers inside of SVG.

use core::fmt::{Display, Write};

/// A coordinate with at most two decimals.
pub(super) struct Num(pub(super) f64);
impl Display for Num {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let hundredths = (self.0 * 100.0).round();
        let hundredths = if hundredths.is_finite() { hundredths } else { 0.0 };
        // Adding zero takes the sign from a negative zero.
        write!(f, "{}", hundredths / 100.0 + 0.0)
    }
}

/// Text as XML wants it; characters that XML does not know are left out.
pub(super) struct Escaped<'a>(pub(super) &'a str);
impl Display for Escaped<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        for c in self.0.chars() {
            match c {
                '&' => f.write_str("&amp;")?,
                '<' => f.write_str("&lt;")?,
                '>' => f.write_str("&gt;")?,
                '"' => f.write_str("&quot;")?,
                '\t' | '\n' | '\r' => f.write_char(' ')?,
                c if c < ' ' || ('\u{fffe}'..='\u{ffff}').contains(&c) => {}
                c => f.write_char(c)?,
            }
        }
        Ok(())
    }
}

/// The pieces of a text: what it says, and by how much it is raised (1), lowered (-1) or neither (0).
fn pieces(text: &str) -> Vec<(&str, i32)> {
    let mut out = Vec::new();
    let mut rest = text;
    loop {
        let next = ["_{", "^{"].iter().filter_map(|m| rest.find(m)).min();
        let Some(at) = next else { break };
        let Some(end) = rest[at..].find('}').map(|e| at + e) else { break };
        out.push((&rest[..at], 0));
        out.push((&rest[at + 2..end], if rest[at..].starts_with('_') { -1 } else { 1 }));
        rest = &rest[end + 1..];
    }
    out.push((rest, 0));
    out.retain(|(s, _)| !s.is_empty());
    out
}

/// The content of a text element.
pub(super) fn spans(text: &str, size: f64) -> String {
    let mut out = String::new();
    let mut height = 0;
    for (s, level) in pieces(text) {
        let shift = f64::from(height - level) * 0.28 * size;
        height = level;
        let small = if level == 0 { String::new() } else { format!(" font-size=\"{}\"", Num(0.72 * size)) };
        let _ = if level == 0 && shift.abs() <= 0.0 {
            write!(out, "{}", Escaped(s))
        } else {
            write!(out, "<tspan dy=\"{}\"{small}>{}</tspan>", Num(shift), Escaped(s))
        };
    }
    out
}

/// About how wide a text is, in pixels; rather too wide than too narrow, since fonts differ.
pub fn text_width(text: &str, size: f64) -> f64 {
    let narrow = |c: char| matches!(c, 'i' | 'l' | 'j' | 't' | 'f' | '.' | ',' | ':' | ' ' | '|' | '(' | ')');
    let of = |s: &str| s.chars().map(|c| if narrow(c) { 0.36 } else { 0.62 }).sum::<f64>();
    pieces(text).iter().map(|(s, level)| of(s) * if *level == 0 { size } else { 0.72 * size }).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::svg::{Svg, Type};

    #[test]
    fn text_is_escaped_and_raised() {
        let mut svg = Svg::new([10.0, 10.0], "#ffffff");
        svg.text([1.0, 2.0], Type::new(10.0, "#000000"), "a < b & \u{1}θ_{i} 10^{-3}");
        let text = svg.finish("x<y");
        assert!(text.contains("a &lt; b &amp; θ<tspan dy=\"2.8\" font-size=\"7.2\">i</tspan>"), "{text}");
        assert!(
            text.contains("<tspan dy=\"-2.8\"> 10</tspan><tspan dy=\"-2.8\" font-size=\"7.2\">-3</tspan>")
        );
        assert!(text.contains("<title>x&lt;y</title>"));
    }

    #[test]
    fn numbers_are_short() {
        let say = |v: f64| Num(v).to_string();
        assert_eq!(
            [say(-0.001), say(1.005), say(2.0), say(f64::NAN)],
            ["0", "1", "2", "0"].map(String::from)
        );
    }
}
