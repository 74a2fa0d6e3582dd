use super::*;

fn tokens(text: &[u8]) -> Vec<(TokenKind<'_>, (u32, u32, u32))> {
    let mut lexer = Lexer::new(text, 0);
    let mut out = Vec::new();
    while let Some(t) = lexer.next_token().unwrap() {
        out.push((t.kind, (t.at.line, t.at.column, t.at.len)));
    }
    out
}

fn quoted(s: &str) -> TokenKind<'_> {
    TokenKind::Quoted(Cow::Borrowed(s))
}

#[test]
fn tokens_have_kinds_and_places() {
    let text = b"Shape \"sphere\"[1]# end\r\n  \"a b\"\n";
    let want = vec![
        (TokenKind::Word("Shape"), (1, 1, 5)),
        (quoted("sphere"), (1, 7, 8)),
        (TokenKind::Open, (1, 15, 1)),
        (TokenKind::Word("1"), (1, 16, 1)),
        (TokenKind::Close, (1, 17, 1)),
        (quoted("a b"), (2, 3, 5)),
    ];
    assert_eq!(tokens(text), want);
}

#[test]
fn columns_count_characters() {
    // Two bytes for the umlaut in UTF-8, one in Latin-1: the next token stands in the same column.
    assert_eq!(tokens("\"ü\" x".as_bytes())[1].1, (1, 5, 1));
    let latin = tokens(b"\"\xfc\" x");
    assert_eq!((&latin[0].0, latin[1].1), (&quoted("ü"), (1, 5, 1)));
}

#[test]
fn a_byte_order_mark_is_skipped() {
    assert_eq!(tokens(b"\xef\xbb\xbfWorldBegin")[0], (TokenKind::Word("WorldBegin"), (1, 1, 10)));
}

#[test]
fn escapes_are_resolved_or_refused() {
    assert_eq!(tokens(br#" "a\"b\\c\n" "#)[0].0, quoted("a\"b\\c\n"));
    let fault = Lexer::new(br#"  "C:\dir" "#, 0).next_token().unwrap_err();
    assert_eq!(
        (fault.at.column, fault.message.as_str()),
        (3, "`\\d` is no escape; write `\\\\` for a backslash")
    );
}

#[test]
fn an_open_string_is_stepped_over() {
    let mut lexer = Lexer::new(b"\"abc\nShape", 7);
    let fault = lexer.next_token().unwrap_err();
    assert_eq!((fault.at.file, fault.at.line, fault.at.column), (7, 1, 1));
    let next = lexer.next_token().unwrap().unwrap();
    assert_eq!((next.kind, next.at.line), (TokenKind::Word("Shape"), 2));
}

#[test]
fn numbers_in_all_spellings() {
    let mut lexer = Lexer::new(b"1e-5 .5 -0 1. +1 -2.5E+3 3]x", 0);
    let (v, rest) = lexer.floats::<1>().unwrap();
    assert_eq!((v.into_flattened(), rest), (vec![1e-5, 0.5, -0.0, 1.0, 1.0, -2500.0, 3.0], 0));
    assert_eq!(lexer.next_token().unwrap().unwrap().kind, TokenKind::Word("x"));
}

#[test]
fn numbers_come_in_groups() {
    let (v, rest) = Lexer::new(b"1 2 3 #c\n4 5 6 7]", 0).floats::<3>().unwrap();
    assert_eq!((v, rest), (vec![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]], 1));
}

#[test]
fn what_is_no_number_is_named_with_its_place() {
    for (text, column, begins) in [
        ("1 nan]", 3, "`nan` is not allowed here"),
        ("1 -inf]", 3, "`-inf` is not allowed here"),
        ("1e99]", 1, "`1e99` is too large"),
        ("1 2 x]", 5, "`x` is not a number"),
        ("1 \"s\"]", 3, "a string stands in a list of numbers"),
        ("1 2", 4, "the file ends in the middle of a list"),
        ("1-2]", 1, "`1-2` is not a number"),
    ] {
        let fault = Lexer::new(text.as_bytes(), 0).floats::<1>().unwrap_err();
        assert_eq!(fault.at.column, column, "{text}");
        assert!(fault.message.starts_with(begins), "{text}: {}", fault.message);
    }
    let fault = Lexer::new(b"1 2.0]", 0).ints().unwrap_err();
    assert_eq!(fault.message, "`2.0` is not an integer; write `2`");
    let fault = Lexer::new(b"99999999999]", 0).ints().unwrap_err();
    assert!(fault.message.ends_with("integers go from -2147483648 to 2147483647"), "{}", fault.message);
}

#[test]
fn columns_on_a_very_long_line_take_linear_time() {
    // Quadratic counting would need 10^12 steps here.
    let text = "\"a\" ".repeat(1 << 20);
    let last = tokens(text.as_bytes()).pop().unwrap();
    assert_eq!(last.1, (1, 4 * (1 << 20) - 3, 3));
}

#[test]
fn short_numbers_are_what_the_parser_of_the_library_makes_of_them() {
    let mut texts: Vec<String> = [
        "0",
        "-0",
        "5.",
        ".5",
        "-.25",
        "16777216",
        "0000000001.5",
        "1.0000000000",
        "0.0000000001",
        "7.77777e0",
    ]
    .map(String::from)
    .to_vec();
    // Every number of digits before and behind the point, up to one too many.
    for whole in [1_u32, 9, 37, 104_845, 999_999, 8_388_609, 16_777_215, 16_777_217, 99_999_999] {
        texts.extend((0..12).map(|n| format!("{:.n$}", f64::from(whole) / 10_f64.powi(n as i32))));
        texts.extend((0..12).map(|n| format!("-{:.n$}", f64::from(whole) / 10_f64.powi(n as i32))));
    }
    let mut n_short = 0;
    for text in &texts {
        let listed = format!("{text}]");
        if let Some((value, length)) = short_f32(listed.as_bytes()) {
            n_short += 1;
            assert_eq!(length, text.len(), "{text}");
            assert_eq!(value.to_bits(), text.parse::<f32>().unwrap().to_bits(), "{text}");
        }
    }
    assert!(n_short > 150 && n_short < texts.len(), "{n_short} of {}", texts.len());
    for other in
        ["]", "-]", ".]", "-.]", "+1]", "1e3]", "1.2.3]", "--1]", "nan]", "16777217]", "0.00000000001]", "1"]
    {
        assert_eq!(short_f32(other.as_bytes()), None, "{other}");
    }
}
