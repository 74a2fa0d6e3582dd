//! Options of a setting, written as one word: [`Setting`].

use std::path::Path;

use clap::Parser;
use clap::error::{ContextKind, ContextValue, ErrorKind};

use crate::args::{Cli, RenderArgs, Verb};
use crate::failure::Failure;

/// One of the two that race.
#[derive(Debug)]
pub(super) struct Setting {
    /// `A` or `B`.
    pub(super) name: char,
    /// As the user wrote it, with what both share.
    pub(super) text: String,
    pub(super) args: Box<RenderArgs>,
}

impl Setting {
    /// Reads `text` after `both`, as options of `sparrow render`; `option` is where `text` stands.
    ///
    /// # Errors
    /// What is wrong and in which column.
    pub(super) fn read(option: &str, text: &str, both: &str, scene: &Path) -> Result<Setting, Failure> {
        let mut words = vec!["sparrow".into(), "render".into(), scene.as_os_str().to_owned()];
        for (option, text) in [("--both", both), (option, text)] {
            let split = split(text).map_err(|column| {
                Failure::usage(format!(
                    "{option}, column {column}: this quotation mark is never closed; close it"
                ))
            })?;
            words.extend(split.into_iter().map(Into::into));
        }
        let cli = Cli::try_parse_from(words).map_err(|e| {
            let (option, column) = place(&e, &[(option, text), ("--both", both)]);
            Failure::usage(format!("{option}{column}: {}", reason(&e)))
        })?;
        let Some(Verb::Render(args)) = cli.verb else {
            return Err(Failure::usage(format!("{option}: these are no options of `sparrow render`")));
        };
        let of_the_race = [
            ("--output", args.output.is_some()),
            ("--seed", args.seed.is_some()),
            ("--time", args.time.is_some()),
            ("--stats", args.stats.is_some()),
            ("--variance", args.variance),
            ("--json", args.json),
            ("--quiet", args.quiet),
        ];
        if let Some((name, _)) = of_the_race.iter().find(|(_, given)| *given) {
            let (option, column) = find(name, &[(option, text), ("--both", both)]);
            return Err(Failure::usage(format!(
                "{option}{column}: {name} is not for a setting: seeds, times and results are the race's own; leave it out"
            )));
        }
        crate::adaptive::check(&args)?;
        let name = if option == "--a" { 'A' } else { 'B' };
        let shown = [both, text].map(str::trim).join(" ").trim().to_owned();
        Ok(Setting { name, text: shown, args })
    }
}

/// The sentence of the command line's own complaint.
fn reason(e: &clap::Error) -> String {
    if matches!(e.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) {
        return "help and version are no settings; leave them out".to_owned();
    }
    let text = e.to_string();
    text.lines().next().unwrap_or_default().trim_start_matches("error: ").to_owned()
}

/// Which of the texts the complaint is about, and where in it.
fn place<'a>(e: &clap::Error, texts: &[(&'a str, &str)]) -> (&'a str, String) {
    // The value is nearer to the fault than the option's name.
    let named = [ContextKind::InvalidValue, ContextKind::InvalidArg];
    let words = named.into_iter().filter_map(|kind| match e.get(kind) {
        Some(ContextValue::String(s)) => s.split([' ', '=']).next(),
        _ => None,
    });
    let found =
        words.filter(|w| !w.is_empty()).map(|word| find(word, texts)).find(|(_, column)| !column.is_empty());
    found.unwrap_or((texts.first().map_or("", |t| t.0), String::new()))
}

/// The text in which `word` stands, and `, column N`, counted in characters from 1.
fn find<'a>(word: &str, texts: &[(&'a str, &str)]) -> (&'a str, String) {
    let found = texts.iter().find_map(|(option, text)| {
        let at = text.find(word)?;
        Some((*option, format!(", column {}", text[..at].chars().count() + 1)))
    });
    found.unwrap_or((texts.first().map_or("", |t| t.0), String::new()))
}

/// Words as a POSIX shell parts them: blanks between, single and double quotation marks around; else the column of a mark
/// that is not closed.
fn split(text: &str) -> Result<Vec<String>, usize> {
    let (mut words, mut word) = (Vec::new(), None::<String>);
    let mut open: Option<(char, usize)> = None;
    for (column, c) in text.chars().enumerate() {
        match open {
            Some((mark, _)) if c == mark => open = None,
            Some(_) => word.get_or_insert_default().push(c),
            None if c == '\'' || c == '"' => {
                open = Some((c, column + 1));
                word.get_or_insert_default();
            }
            None if c.is_whitespace() => words.extend(word.take()),
            None => word.get_or_insert_default().push(c),
        }
    }
    words.extend(word);
    open.map_or(Ok(words), |(_, column)| Err(column))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_parted_as_by_a_shell() {
        let text = r#"--mis  power --material '"a" "string type" "hair"' --x=""y"#;
        let want = ["--mis", "power", "--material", r#""a" "string type" "hair""#, "--x=y"];
        assert_eq!(split(text), Ok(want.map(str::to_owned).to_vec()));
        assert_eq!(split("  "), Ok(vec![]));
        assert_eq!(split("a 'b c"), Err(3));
    }

    #[test]
    fn faults_are_told_with_their_place() {
        let told = |text: &str| {
            format!("{:?}", Setting::read("--b", text, "--threads 2", Path::new("s.pbrt")).unwrap_err())
        };
        for (text, says) in [
            ("--spp 9 --mis blance", "--b, column 15: invalid value 'blance'"),
            ("--miss power", "--b, column 1: unexpected argument '--miss'"),
            ("power", "--b, column 1: "),
            ("--threads 3", "--b, column 1: the argument '--threads"),
            ("--mis", "--b, column 1: a value is required"),
            ("--spp 9 --quiet", "--b, column 9: --quiet is not for a setting"),
            ("--help", "help and version"),
            ("--mis 'power", "--b, column 7: this quotation mark"),
        ] {
            assert!(told(text).contains(says), "{text}: {}", told(text));
        }
        let shared = Setting::read("--a", "--spp 8", "--resolution 9", Path::new("s.pbrt"));
        assert!(format!("{:?}", shared.unwrap_err()).contains("--both, column 14: invalid value '9'"));
    }
}
