//! Formulas as MathML, from a short notation: [`mathml`].
//!
//! | written | means |
//! | --- | --- |
//! | `a_i`, `x^2`, `a_{ij}^2` | below, above, both |
//! | `frac{a}{b}`, `sqrt{a}`, `sum` | fraction, root, sum |
//! | `text{for all}` | words |
//! | `theta`-like letters | written as they are: `θ_i` |
//! | `cos θ` | a name of several letters, upright |
//! | `{a b}` | one group |
//!
//! Blanks part names and are otherwise of no meaning.

/// The `math` element of a formula.
pub(crate) fn mathml(text: &str) -> String {
    let chars: Vec<char> = text.chars().collect();
    let mut reader = Reader { chars: &chars, at: 0 };
    let mut body = String::new();
    while reader.at < chars.len() {
        body.push_str(&reader.row());
        // A closing brace too many is left out.
        reader.at += 1;
    }
    format!("<math><mrow>{body}</mrow></math>")
}

struct Reader<'a> {
    chars: &'a [char],
    at: usize,
}

impl Reader<'_> {
    fn peek(&self) -> Option<char> {
        self.chars.get(self.at).copied()
    }
    fn skip_blanks(&mut self) {
        while self.peek().is_some_and(char::is_whitespace) {
            self.at += 1;
        }
    }
    /// Items up to a closing brace or the end.
    fn row(&mut self) -> String {
        const GAP: &str = "<mspace width=\"0.17em\"></mspace>";
        let mut out = String::new();
        loop {
            self.skip_blanks();
            if matches!(self.peek(), None | Some('}')) {
                return out;
            }
            // The name of a function touches neither what stands before it nor its argument.
            let function = self.starts_function();
            if function && !out.is_empty() {
                out.push_str(GAP);
            }
            out.push_str(&self.item());
            if function && self.peek() == Some(' ') {
                out.push_str(GAP);
            }
        }
    }
    /// A name of several letters that is no construct.
    fn starts_function(&self) -> bool {
        let name: String = self.chars[self.at..].iter().take_while(|c| c.is_alphabetic()).collect();
        name.chars().count() > 1 && !matches!(name.as_str(), "frac" | "sqrt" | "text" | "sum")
    }
    /// An atom with what stands below and above it.
    fn item(&mut self) -> String {
        let base = self.atom();
        let (mut below, mut above) = (None, None);
        loop {
            match self.peek() {
                Some('_') if below.is_none() => {
                    self.at += 1;
                    below = Some(self.atom());
                }
                Some('^') if above.is_none() => {
                    self.at += 1;
                    above = Some(self.atom());
                }
                _ => break,
            }
        }
        match (below, above) {
            (None, None) => base,
            (Some(b), None) => format!("<msub>{base}{b}</msub>"),
            (None, Some(a)) => format!("<msup>{base}{a}</msup>"),
            (Some(b), Some(a)) => format!("<msubsup>{base}{b}{a}</msubsup>"),
        }
    }
    fn atom(&mut self) -> String {
        self.skip_blanks();
        let Some(c) = self.peek() else { return "<mrow></mrow>".to_owned() };
        if c == '{' {
            return self.group();
        }
        if c.is_ascii_digit() {
            return format!("<mn>{}</mn>", self.run(|c| c.is_ascii_digit() || c == '.'));
        }
        if c.is_alphabetic() {
            return self.name();
        }
        self.at += 1;
        match c {
            '-' => "<mo>−</mo>".to_owned(),
            '*' => "<mo>·</mo>".to_owned(),
            '\'' => "<mo>′</mo>".to_owned(),
            '<' => "<mo>&lt;</mo>".to_owned(),
            '>' => "<mo>&gt;</mo>".to_owned(),
            '&' => "<mo>&amp;</mo>".to_owned(),
            '∞' => "<mi>∞</mi>".to_owned(),
            c => format!("<mo>{c}</mo>"),
        }
    }
    fn group(&mut self) -> String {
        self.at += usize::from(self.peek() == Some('{'));
        let body = self.row();
        self.at += usize::from(self.peek() == Some('}'));
        format!("<mrow>{body}</mrow>")
    }
    fn run(&mut self, belongs: impl Fn(char) -> bool) -> String {
        let start = self.at;
        while self.peek().is_some_and(&belongs) {
            self.at += 1;
        }
        self.chars[start..self.at].iter().collect()
    }
    fn name(&mut self) -> String {
        let name = self.run(char::is_alphabetic);
        match name.as_str() {
            "frac" => format!("<mfrac>{}{}</mfrac>", self.group(), self.group()),
            "sqrt" => format!("<msqrt>{}</msqrt>", self.group()),
            "text" => {
                self.at += usize::from(self.peek() == Some('{'));
                let words = self.run(|c| c != '}');
                self.at += usize::from(self.peek() == Some('}'));
                format!("<mtext>{}</mtext>", words.replace('&', "&amp;").replace('<', "&lt;"))
            }
            "sum" => "<mo>∑</mo>".to_owned(),
            _ => format!("<mi>{name}</mi>"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inner(text: &str) -> String {
        let all = mathml(text);
        all["<math><mrow>".len()..all.len() - "</mrow></math>".len()].to_owned()
    }

    #[test]
    fn formulas_become_elements() {
        assert_eq!(inner("f_r"), "<msub><mi>f</mi><mi>r</mi></msub>");
        assert_eq!(inner("x_i^2"), "<msubsup><mi>x</mi><mi>i</mi><mn>2</mn></msubsup>");
        assert_eq!(
            inner("frac{1}{a-b}"),
            "<mfrac><mrow><mn>1</mn></mrow><mrow><mi>a</mi><mo>−</mo><mi>b</mi></mrow></mfrac>"
        );
        assert_eq!(inner("text{if a < b}"), "<mtext>if a &lt; b</mtext>");
        assert!(inner("cos θ").starts_with("<mi>cos</mi><mspace"));
    }

    #[test]
    fn whatever_is_written_the_elements_are_balanced() {
        for text in ["", "_", "^", "{", "}", "}}a", "frac", "frac{a", "sqrt", "text{", "a_", "a^^b", "_^_"] {
            assert!(roxmltree::Document::parse(&mathml(text)).is_ok(), "`{text}` gives {}", mathml(text));
        }
    }
}
