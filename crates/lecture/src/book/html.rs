//! HTML text: what all pages share.

use core::fmt::{Display, Write};

/// Text as HTML wants it.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Text as HTML wants it; Latin letters right after a Greek one are its index: `θi`.
pub(super) fn rich(text: &str) -> String {
    let greek = |c: char| ('α'..='ω').contains(&c) || ('Α'..='Ω').contains(&c);
    let (mut out, mut after_greek, mut below) = (String::new(), false, false);
    for c in escaped(text).chars() {
        let index = c.is_ascii_alphabetic() && (after_greek || below);
        if index != below {
            out.push_str(if index { "<sub>" } else { "</sub>" });
        }
        out.push(c);
        (below, after_greek) = (index, greek(c));
    }
    if below { out + "</sub>" } else { out }
}

/// Paragraphs of a plain text.
pub(super) fn paragraphs(text: &str) -> String {
    text.lines().filter(|l| !l.trim().is_empty()).fold(String::new(), |mut out, line| {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "<p>{}</p>", rich(line));
        out
    })
}

/// A whole document.
pub(super) fn document(title: &str, body: impl Display) -> String {
    let title = escaped(title);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<link rel=\"stylesheet\" href=\"style.css\">\n</head>\n<body>\n{body}</body>\n</html>\n"
    )
}

/// A number with four digits that count.
pub(super) fn number(v: f64) -> String {
    let size = v.abs();
    if !v.is_finite() {
        return "not a number".to_owned();
    }
    if size > 0.0 && !(1e-3..1e6).contains(&size) {
        let text = format!("{v:.3e}");
        let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}·10<sup>{}</sup>", digits.replace('-', "−"), power.replace('-', "−"));
    }
    let decimals = if size >= 1000.0 {
        0
    } else if size >= 100.0 {
        1
    } else if size >= 10.0 {
        2
    } else {
        4
    };
    let text = format!("{v:.decimals$}");
    let short = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    short.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_after_greek_ones_are_indices() {
        assert_eq!(rich("θi = −θo & αTT, π f"), "θ<sub>i</sub> = −θ<sub>o</sub> &amp; α<sub>TT</sub>, π f");
        assert_eq!(rich("2θh"), "2θ<sub>h</sub>");
    }

    #[test]
    fn numbers_are_short() {
        let all = [0.0, 1.5, -0.25, 1234.5, 1e-7, 0.123456, 42.0].map(number);
        assert_eq!(all, ["0", "1.5", "−0.25", "1234", "1.000·10<sup>−7</sup>", "0.1235", "42"]);
    }
}
