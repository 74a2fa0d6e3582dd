//! Scene text to tokens: [`Lexer`].
//!
//! Words end at white space, quotes and brackets, as in pbrt-v4; a comment begins at a `#` that begins a token.
//! Arrays of numbers do not pass through tokens: [`Lexer::floats`] and [`Lexer::ints`] read them in place.

use std::borrow::Cow;

use crate::diagnostic::{Diagnostic, Span};

/// What a token is.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum TokenKind<'a> {
    /// A directive, number or other bare word.
    Word(&'a str),
    /// A string, without its quotes and with its escapes resolved.
    Quoted(Cow<'a, str>),
    /// `[`
    Open,
    /// `]`
    Close,
}

/// A token and its place.
#[derive(Clone, Debug)]
pub(crate) struct Token<'a> {
    pub(crate) kind: TokenKind<'a>,
    pub(crate) at: Span,
}

/// What bytes mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Encoding {
    /// All of them are characters.
    Ascii,
    Utf8,
    /// Text that is no UTF-8 is taken byte by byte.
    Latin1,
}

/// Reads tokens from the text of one file.
#[derive(Debug)]
pub(crate) struct Lexer<'a> {
    text: &'a [u8],
    encoding: Encoding,
    file: u32,
    pos: usize,
    line: u32,
    /// Offset and column up to which characters of this line were counted: a line may be megabytes long.
    counted: (usize, u32),
}

fn is_space(b: u8) -> bool {
    matches!(b, b' ' | b'\t' | b'\n' | b'\r' | 0x0b | 0x0c)
}

fn ends_word(b: u8) -> bool {
    is_space(b) || matches!(b, b'"' | b'[' | b']')
}

/// Begins as a number does. Rust's parser would also take `inf` and `nan`.
fn looks_numeric(word: &[u8]) -> bool {
    let digits = word.strip_prefix(b"-").or(word.strip_prefix(b"+")).unwrap_or(word);
    matches!(digits.first(), Some(b'0'..=b'9' | b'.'))
}

/// A finite number in single precision.
pub(crate) fn parse_f32(word: &[u8]) -> Option<f32> {
    let s = std::str::from_utf8(word).ok().filter(|_| looks_numeric(word))?;
    s.parse().ok().filter(|v: &f32| v.is_finite())
}

/// A finite number in double precision.
pub(crate) fn parse_f64(word: &[u8]) -> Option<f64> {
    let s = std::str::from_utf8(word).ok().filter(|_| looks_numeric(word))?;
    s.parse().ok().filter(|v: &f64| v.is_finite())
}

/// Powers of ten that single precision holds exactly.
const TENS: [f32; 11] = [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10];

/// A number of few digits that the text begins with, and its length. `None` where it is written in any other way, or not behind it.
///
/// Whole numbers up to 2^24 and powers of ten up to 10^10 are exact, so that their quotient is the number, rounded once.
fn short_f32(text: &[u8]) -> Option<(f32, usize)> {
    let first = usize::from(text.first() == Some(&b'-'));
    let (mut whole, mut point) = (0_u64, None);
    // As many characters hold no number beyond 64 bits.
    for (i, &b) in text.iter().enumerate().skip(first).take(19) {
        match b {
            b'0'..=b'9' => whole = 10 * whole + u64::from(b - b'0'),
            b'.' if point.is_none() => point = Some(i),
            _ if ends_word(b) => {
                let has_digits = i > first + usize::from(point.is_some());
                let tens = TENS.get(point.map_or(0, |point| i - point - 1))?;
                let value = whole as f32 / tens;
                return (has_digits && whole <= 1 << 24)
                    .then_some((if first == 1 { -value } else { value }, i));
            }
            _ => return None,
        }
    }
    None
}

fn parse_i32(word: &[u8]) -> Option<i32> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

fn not_a_number(word: &str) -> String {
    let rest = word.strip_prefix(['-', '+']).unwrap_or(word);
    if rest.eq_ignore_ascii_case("nan") || rest.to_ascii_lowercase().starts_with("inf") {
        return format!("`{word}` is not allowed here; write a finite number");
    }
    match word.parse::<f64>() {
        Ok(_) => format!("`{}` is too large for single precision; write a smaller number", shorten(word)),
        Err(_) => format!("`{}` is not a number; write one, or end the list with `]`", shorten(word)),
    }
}

fn not_an_integer(word: &str) -> String {
    let remedy = match word.parse::<f64>() {
        Ok(v) if v.fract() == 0.0 && v.abs() <= f64::from(i32::MAX) => format!("write `{v:.0}`"),
        Ok(v) if v.abs() > f64::from(i32::MAX) => "integers go from -2147483648 to 2147483647".to_string(),
        Ok(_) | Err(_) => "write a whole number, or end the list with `]`".to_string(),
    };
    format!("`{}` is not an integer; {remedy}", shorten(word))
}

/// Long words are cut in messages.
pub(crate) fn shorten(word: &str) -> Cow<'_, str> {
    match word.char_indices().nth(40) {
        Some((i, _)) => Cow::Owned(format!("{}...", &word[..i])),
        None => Cow::Borrowed(word),
    }
}

impl<'a> Lexer<'a> {
    /// A lexer at the start of a text; `file` goes into every span.
    pub(crate) fn new(text: &'a [u8], file: u32) -> Self {
        let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
        let encoding = match std::str::from_utf8(text) {
            Ok(_) if text.is_ascii() => Encoding::Ascii,
            Ok(_) => Encoding::Utf8,
            Err(_) => Encoding::Latin1,
        };
        Lexer { text, encoding, file, pos: 0, line: 1, counted: (0, 1) }
    }

    /// The next token; `None` at the end. A fault has been stepped over: the next call goes on behind it.
    pub(crate) fn next_token(&mut self) -> Result<Option<Token<'a>>, Diagnostic> {
        self.skip_blank();
        let start = self.pos;
        let Some(&b) = self.text.get(start) else { return Ok(None) };
        let at = self.span(start, 1);
        let kind = match b {
            b'[' | b']' => {
                self.pos += 1;
                if b == b'[' { TokenKind::Open } else { TokenKind::Close }
            }
            b'"' => TokenKind::Quoted(self.quoted(at)?),
            _ => {
                let word = self.word();
                let Ok(word) = std::str::from_utf8(word) else {
                    let message = "this word holds bytes that are no text; is this a scene file?";
                    return Err(Diagnostic::error(at, message));
                };
                TokenKind::Word(word)
            }
        };
        let len = self.n_chars(start, self.pos);
        Ok(Some(Token { kind, at: Span { len, ..at } }))
    }

    /// Reads numbers up to `]`, in groups of `N`, behind a `[` that has been read.
    ///
    /// Returns the groups, and how many numbers were left over.
    pub(crate) fn floats<const N: usize>(&mut self) -> Result<(Vec<[f32; N]>, usize), Diagnostic> {
        let mut out = Vec::new();
        let mut group = [0.0; N];
        let mut n = 0;
        while let Some(v) = self.list_number()? {
            group[n] = v;
            n += 1;
            if n == N {
                out.push(group);
                n = 0;
            }
        }
        Ok((out, n))
    }

    /// Reads integers up to `]`, behind a `[` that has been read.
    pub(crate) fn ints(&mut self) -> Result<Vec<i32>, Diagnostic> {
        let mut out = Vec::new();
        while let Some((start, word)) = self.list_item()? {
            let Some(v) = parse_i32(word) else { return Err(self.fault(start, word, not_an_integer)) };
            out.push(v);
        }
        Ok(out)
    }

    /// Whether the list whose `[` has been read goes on with a string.
    pub(crate) fn at_quote(&mut self) -> bool {
        self.skip_blank();
        self.text.get(self.pos) == Some(&b'"')
    }

    /// A number as a single value, from a word.
    pub(crate) fn single_f32(token: &Token<'_>) -> Result<f32, Diagnostic> {
        match &token.kind {
            TokenKind::Word(w) => {
                parse_f32(w.as_bytes()).ok_or_else(|| Diagnostic::error(token.at, not_a_number(w)))
            }
            TokenKind::Quoted(_) | TokenKind::Open | TokenKind::Close => Err(expected(token, "a number")),
        }
    }

    /// An integer as a single value, from a word.
    pub(crate) fn single_i32(token: &Token<'_>) -> Result<i32, Diagnostic> {
        match &token.kind {
            TokenKind::Word(w) => {
                parse_i32(w.as_bytes()).ok_or_else(|| Diagnostic::error(token.at, not_an_integer(w)))
            }
            TokenKind::Quoted(_) | TokenKind::Open | TokenKind::Close => Err(expected(token, "an integer")),
        }
    }

    /// The place where the text ends.
    pub(crate) fn end(&mut self) -> Span {
        self.skip_blank();
        self.span(self.pos, 0)
    }

    /// The next word of a list, with its offset; `None` behind `]`.
    fn list_item(&mut self) -> Result<Option<(usize, &'a [u8])>, Diagnostic> {
        self.skip_blank();
        let start = self.pos;
        match self.text.get(start) {
            Some(b']') => {
                self.pos += 1;
                Ok(None)
            }
            Some(b'"' | b'[') => {
                let at = self.span(start, 1);
                let what = if self.text[start] == b'[' { "`[`" } else { "a string" };
                Err(Diagnostic::error(
                    at,
                    format!("{what} stands in a list of numbers; close the list with `]`"),
                ))
            }
            Some(_) => Ok(Some((start, self.word()))),
            None => {
                let at = self.span(start, 0);
                Err(Diagnostic::error(at, "the file ends in the middle of a list; close the list with `]`"))
            }
        }
    }

    /// The next number of a list; `None` behind `]`.
    fn list_number(&mut self) -> Result<Option<f32>, Diagnostic> {
        self.skip_blank();
        if let Some((v, length)) = short_f32(&self.text[self.pos..]) {
            self.pos += length;
            return Ok(Some(v));
        }
        let Some((start, word)) = self.list_item()? else { return Ok(None) };
        match parse_f32(word) {
            Some(v) => Ok(Some(v)),
            None => Err(self.fault(start, word, not_a_number)),
        }
    }

    fn fault(&mut self, start: usize, word: &[u8], message: fn(&str) -> String) -> Diagnostic {
        let at = self.span(start, self.n_chars(start, self.pos));
        Diagnostic::error(at, message(&String::from_utf8_lossy(word)))
    }

    fn word(&mut self) -> &'a [u8] {
        let rest = &self.text[self.pos..];
        let len = rest.iter().position(|&b| ends_word(b)).unwrap_or(rest.len());
        self.pos += len;
        &rest[..len]
    }

    fn quoted(&mut self, at: Span) -> Result<Cow<'a, str>, Diagnostic> {
        self.pos += 1;
        let start = self.pos;
        let mut escaped = false;
        loop {
            match self.text.get(self.pos) {
                Some(b'"') => break,
                Some(b'\\') if self.text.get(self.pos + 1).is_some_and(|&b| b != b'\n') => {
                    escaped = true;
                    self.pos += 2;
                }
                None | Some(b'\n' | b'\r') => {
                    return Err(Diagnostic::error(
                        at,
                        "this string does not end on its line; close it with `\"`",
                    ));
                }
                Some(_) => self.pos += 1,
            }
        }
        let raw = &self.text[start..self.pos];
        self.pos += 1;
        let text: Cow<'a, str> = match std::str::from_utf8(raw) {
            Ok(s) if self.encoding != Encoding::Latin1 => Cow::Borrowed(s),
            Ok(_) | Err(_) => Cow::Owned(raw.iter().map(|&b| char::from(b)).collect()),
        };
        if escaped { unescape(&text, at).map(Cow::Owned) } else { Ok(text) }
    }

    /// Steps over white space and comments.
    fn skip_blank(&mut self) {
        while let Some(&b) = self.text.get(self.pos) {
            match b {
                b'\n' => {
                    self.pos += 1;
                    self.line += 1;
                    self.counted = (self.pos, 1);
                }
                b'#' => {
                    let rest = &self.text[self.pos..];
                    self.pos += rest.iter().position(|&b| b == b'\n' || b == b'\r').unwrap_or(rest.len());
                }
                _ if is_space(b) => self.pos += 1,
                _ => break,
            }
        }
    }

    fn n_chars(&self, from: usize, to: usize) -> u32 {
        let n = match self.encoding {
            // Every byte but those of the form 10xxxxxx begins a character.
            Encoding::Utf8 => self.text[from..to].iter().filter(|&&b| b & 0xc0 != 0x80).count(),
            Encoding::Ascii | Encoding::Latin1 => to - from,
        };
        u32::try_from(n).unwrap_or(u32::MAX)
    }

    fn span(&mut self, offset: usize, len: u32) -> Span {
        let (from, column) = self.counted;
        let column = column.saturating_add(self.n_chars(from, offset.max(from)));
        self.counted = (offset.max(from), column);
        Span { file: self.file, line: self.line, column, len }
    }
}

/// The fault that something else stands where `what` was expected.
pub(crate) fn expected(token: &Token<'_>, what: &str) -> Diagnostic {
    let found = match &token.kind {
        TokenKind::Word(w) => format!("`{}`", shorten(w)),
        TokenKind::Quoted(s) => format!("the string \"{}\"", shorten(s)),
        TokenKind::Open => "`[`".into(),
        TokenKind::Close => "`]`".into(),
    };
    Diagnostic::error(token.at, format!("{found} stands where {what} is expected; correct the statement"))
}

fn unescape(text: &str, at: Span) -> Result<String, Diagnostic> {
    let mut out = String::with_capacity(text.len());
    let mut chars = text.chars();
    while let Some(c) = chars.next() {
        if c != '\\' {
            out.push(c);
            continue;
        }
        out.push(match chars.next() {
            Some('b') => '\u{8}',
            Some('f') => '\u{c}',
            Some('n') => '\n',
            Some('r') => '\r',
            Some('t') => '\t',
            Some(c @ ('\\' | '\'' | '"')) => c,
            other => {
                let shown = other.map(String::from).unwrap_or_default();
                let message = format!("`\\{shown}` is no escape; write `\\\\` for a backslash");
                return Err(Diagnostic::error(at, message));
            }
        });
    }
    Ok(out)
}

#[cfg(test)]
mod tests;
