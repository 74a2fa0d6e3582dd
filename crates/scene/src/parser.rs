//! Tokens to statements: [`Parser`].

use std::borrow::Cow;

use sparrow_spectra::ColorSpace;

use crate::diagnostic::{Diagnostic, Span};
use crate::lexer::{Lexer, Token, TokenKind, expected, parse_f64, shorten};
use crate::params::{Param, Values};
use crate::suggest::{nearest, remedy};
use crate::tables::{DIRECTIVES, TYPES, Type};

/// Reads the statements of one file.
#[derive(Debug)]
pub(crate) struct Parser<'a> {
    lexer: Lexer<'a>,
    /// A token that was looked at and belongs to what follows.
    ahead: Option<Token<'a>>,
}

type Parsed<T> = Result<T, Diagnostic>;

impl<'a> Parser<'a> {
    /// A parser at the start of a text; `file` goes into every span.
    pub(crate) fn new(text: &'a [u8], file: u32) -> Self {
        Parser { lexer: Lexer::new(text, file), ahead: None }
    }

    /// The next directive; `None` at the end of the file.
    pub(crate) fn directive(&mut self) -> Parsed<Option<(&'static str, Span)>> {
        let Some(token) = self.next()? else { return Ok(None) };
        let TokenKind::Word(word) = token.kind else {
            self.recover();
            return Err(expected(&token, "a directive"));
        };
        match DIRECTIVES.iter().find(|d| **d == word) {
            Some(directive) => Ok(Some((directive, token.at))),
            None => {
                self.recover();
                Err(Diagnostic::error(token.at, unknown_directive(word)))
            }
        }
    }

    /// A string.
    pub(crate) fn text(&mut self) -> Parsed<(String, Span)> {
        let token = self.required()?;
        match token.kind {
            TokenKind::Quoted(s) => Ok((s.into_owned(), token.at)),
            TokenKind::Word(_) | TokenKind::Open | TokenKind::Close => {
                self.give_back(token.clone());
                Err(expected(&token, "a string in quotes"))
            }
        }
    }

    /// A string, where one follows.
    pub(crate) fn optional_text(&mut self) -> Parsed<Option<(Cow<'a, str>, Span)>> {
        match self.next()? {
            Some(Token { kind: TokenKind::Quoted(s), at }) => Ok(Some((s, at))),
            Some(other) => {
                self.give_back(other);
                Ok(None)
            }
            None => Ok(None),
        }
    }

    /// A bare word, such as the argument of `ActiveTransform`.
    pub(crate) fn word(&mut self) -> Parsed<(&'a str, Span)> {
        let token = self.required()?;
        match token.kind {
            TokenKind::Word(w) => Ok((w, token.at)),
            TokenKind::Quoted(_) | TokenKind::Open | TokenKind::Close => Err(expected(&token, "a word")),
        }
    }

    /// A word or string as it stands: the value of an `Option`.
    pub(crate) fn option_value(&mut self) -> Parsed<(String, bool, Span)> {
        let token = self.required()?;
        match token.kind {
            TokenKind::Word(w) => Ok((w.to_string(), false, token.at)),
            TokenKind::Quoted(s) => Ok((s.into_owned(), true, token.at)),
            TokenKind::Open | TokenKind::Close => Err(expected(&token, "a value")),
        }
    }

    /// `N` numbers behind a directive.
    pub(crate) fn numbers<const N: usize>(&mut self) -> Parsed<[f64; N]> {
        let mut out = [0.0; N];
        for v in &mut out {
            let token = self.required()?;
            let number = match &token.kind {
                TokenKind::Word(w) => parse_f64(w.as_bytes()),
                TokenKind::Quoted(_) | TokenKind::Open | TokenKind::Close => None,
            };
            let Some(number) = number else {
                self.give_back(token.clone());
                return Err(expected(&token, "a number"));
            };
            *v = number;
        }
        Ok(out)
    }

    /// Sixteen numbers in brackets.
    pub(crate) fn matrix(&mut self) -> Parsed<[f64; 16]> {
        self.bracket(TokenKind::Open, "`[`")?;
        let m = self.numbers()?;
        self.bracket(TokenKind::Close, "`]` after sixteen numbers")?;
        Ok(m)
    }

    /// The parameters behind a statement. Faulty ones are left out and reported.
    pub(crate) fn params(
        &mut self,
        color_space: ColorSpace,
        mut fault: impl FnMut(Diagnostic),
    ) -> Vec<Param> {
        let mut out = Vec::new();
        loop {
            match self.param(color_space) {
                Ok(Some(p)) => out.push(p),
                Ok(None) => return out,
                Err(d) => {
                    fault(d);
                    self.skip_to_declaration();
                }
            }
        }
    }

    fn param(&mut self, color_space: ColorSpace) -> Parsed<Option<Param>> {
        let Some((text, at)) = self.optional_text()? else { return Ok(None) };
        let mut words = text.split([' ', '\t']).filter(|w| !w.is_empty());
        let (Some(ty), Some(name)) = (words.next(), words.next()) else {
            let message = format!(
                "\"{}\" declares no parameter; write \"type name\", such as \"float radius\"",
                shorten(&text)
            );
            return Err(Diagnostic::error(at, message));
        };
        let Some(ty) = Type::from_name(ty) else {
            let remedy = if ty == "color" || ty == "xyz" {
                "write \"rgb\"".into()
            } else {
                remedy(ty, TYPES.iter().map(|t| t.0))
            };
            let message = format!("\"{}\" is no type of parameter; {remedy}", shorten(ty));
            return Err(Diagnostic::error(at, message));
        };
        let name = name.to_string();
        let values = self.values(ty, &name, at)?;
        Ok(Some(Param { ty, name, values, color_space, at }))
    }

    fn values(&mut self, ty: Type, name: &str, at: Span) -> Parsed<Values> {
        let first = self.required()?;
        if first.kind != TokenKind::Open {
            return self.single(ty, name, first);
        }
        let uneven = |rest: usize| {
            let (ty, width) = (ty.name(), ty.width());
            let message = format!(
                "\"{ty} {name}\" takes numbers in groups of {width}, and {rest} remain; add or remove some"
            );
            Diagnostic::error(at, message)
        };
        match ty {
            Type::Integer => Ok(Values::Ints(self.lexer.ints()?)),
            Type::Bool | Type::Text | Type::Texture => self.words(ty),
            Type::Spectrum if self.lexer.at_quote() => self.words(ty),
            Type::Float | Type::Blackbody | Type::Spectrum => {
                Ok(Values::Floats(self.lexer.floats::<1>()?.0.into_flattened()))
            }
            Type::Point2 | Type::Vector2 => match self.lexer.floats()? {
                (pairs, 0) => Ok(Values::Pairs(pairs)),
                (_, rest) => Err(uneven(rest)),
            },
            Type::Point3 | Type::Vector3 | Type::Normal | Type::Rgb => match self.lexer.floats()? {
                (triples, 0) => Ok(Values::Triples(triples)),
                (_, rest) => Err(uneven(rest)),
            },
        }
    }

    /// A value without brackets.
    fn single(&mut self, ty: Type, name: &str, token: Token<'a>) -> Parsed<Values> {
        let kind = token.kind.clone();
        match (ty, kind) {
            (Type::Integer, _) => Ok(Values::Ints(vec![Lexer::single_i32(&token)?])),
            (Type::Bool, _) => Ok(Values::Bools(vec![boolean(&token)?])),
            (Type::Text | Type::Texture | Type::Spectrum, TokenKind::Quoted(s)) => {
                Ok(Values::Texts(vec![(s.into_owned(), token.at)]))
            }
            (Type::Float | Type::Blackbody, _) => Ok(Values::Floats(vec![Lexer::single_f32(&token)?])),
            (Type::Text | Type::Texture, _) => {
                self.give_back(token.clone());
                Err(expected(&token, "a string in quotes"))
            }
            (_, TokenKind::Word(w)) if parse_f64(w.as_bytes()).is_some() => {
                let message =
                    format!("the numbers of \"{name}\" stand without brackets; write them in `[ ]`");
                Err(Diagnostic::error(token.at, message))
            }
            _ => {
                self.give_back(token.clone());
                Err(expected(&token, "`[`"))
            }
        }
    }

    /// Strings or booleans up to `]`.
    fn words(&mut self, ty: Type) -> Parsed<Values> {
        let (mut texts, mut bools) = (Vec::new(), Vec::new());
        loop {
            let token = self.required()?;
            match (&token.kind, ty) {
                (TokenKind::Close, Type::Bool) => return Ok(Values::Bools(bools)),
                (TokenKind::Close, _) => return Ok(Values::Texts(texts)),
                (_, Type::Bool) => bools.push(boolean(&token)?),
                (TokenKind::Quoted(s), _) => texts.push((s.to_string(), token.at)),
                _ => {
                    self.give_back(token.clone());
                    return Err(expected(&token, "a string in quotes"));
                }
            }
        }
    }

    fn bracket(&mut self, kind: TokenKind<'_>, what: &str) -> Parsed<()> {
        let token = self.required()?;
        if token.kind == kind {
            return Ok(());
        }
        self.give_back(token.clone());
        Err(expected(&token, what))
    }

    fn next(&mut self) -> Parsed<Option<Token<'a>>> {
        match self.ahead.take() {
            Some(token) => Ok(Some(token)),
            None => self.lexer.next_token(),
        }
    }

    fn required(&mut self) -> Parsed<Token<'a>> {
        match self.next()? {
            Some(token) => Ok(token),
            None => {
                let at = self.lexer.end();
                Err(Diagnostic::error(at, "the file ends in the middle of a statement; finish it"))
            }
        }
    }

    fn give_back(&mut self, token: Token<'a>) {
        self.ahead = Some(token);
    }

    /// Skips what follows a fault, up to the next directive.
    pub(crate) fn recover(&mut self) {
        self.skip_until(is_directive);
    }

    /// Skips the rest of a faulty parameter: its values, up to the next declaration or directive.
    fn skip_to_declaration(&mut self) {
        self.skip_until(|kind| match kind {
            TokenKind::Quoted(s) => {
                s.split_once([' ', '\t']).is_some_and(|(ty, _)| Type::from_name(ty).is_some())
            }
            TokenKind::Word(_) => is_directive(kind),
            TokenKind::Open | TokenKind::Close => false,
        });
    }

    fn skip_until(&mut self, stop: impl Fn(&TokenKind<'_>) -> bool) {
        loop {
            match self.next() {
                Ok(Some(token)) if stop(&token.kind) => {
                    self.give_back(token);
                    return;
                }
                Ok(None) => return,
                // A second fault in what is skipped anyway is not worth a line.
                Ok(Some(_)) | Err(_) => {}
            }
        }
    }
}

fn is_directive(kind: &TokenKind<'_>) -> bool {
    matches!(kind, TokenKind::Word(w) if DIRECTIVES.contains(w))
}

fn boolean(token: &Token<'_>) -> Parsed<bool> {
    let text = match &token.kind {
        TokenKind::Word(w) => *w,
        // The spelling of pbrt-v3.
        TokenKind::Quoted(s) => s.as_ref(),
        TokenKind::Open | TokenKind::Close => "",
    };
    match text {
        "true" => Ok(true),
        "false" => Ok(false),
        _ => Err(expected(token, "`true` or `false`")),
    }
}

fn unknown_directive(word: &str) -> String {
    let shown = shorten(word);
    match nearest(word, DIRECTIVES) {
        Some(d) => format!("`{shown}` is no directive; did you mean `{d}`?"),
        None if parse_f64(word.as_bytes()).is_some() => {
            format!(
                "the number `{shown}` stands where a directive is expected; remove it, or put lists in brackets"
            )
        }
        None => format!("`{shown}` is no directive; remove it, or begin a comment with `#`"),
    }
}
