//! `[Key, eq. n]` in a comment: the key stands in `docs/references.bib`. In backticks it is an example.

use std::collections::BTreeMap;
use std::path::Path;

use super::{Findings, Source};

const BIBLIOGRAPHY: &str = "docs/references.bib";
/// Words that follow the key and make a bracket a citation, whatever the key looks like.
const PLACES: [&str; 14] = [
    "eq",
    "sec",
    "section",
    "ch",
    "chapter",
    "fig",
    "tab",
    "table",
    "tables",
    "alg",
    "algorithm",
    "listing",
    "app",
    "p",
];

pub(super) fn check(_: &Path, sources: &[Source], found: &mut Findings) -> Result<(), String> {
    let Some(bibliography) = sources.iter().find(|s| s.path == BIBLIOGRAPHY) else {
        return Err(format!("{BIBLIOGRAPHY} is missing"));
    };
    let mut known: BTreeMap<&str, usize> = keys(&bibliography.text).map(|k| (k, 0)).collect();
    for source in sources {
        for (number, line) in source.text.lines().enumerate() {
            let Some(comment) = comment(&source.path, line) else { continue };
            for key in cited(comment) {
                match known.get_mut(key) {
                    Some(n) => *n += 1,
                    None => found.fault(format!(
                        "{}:{}: [{key}] is not in {BIBLIOGRAPHY}",
                        source.path,
                        number + 1
                    )),
                }
            }
        }
    }
    for (key, _) in known.iter().filter(|(_, n)| **n == 0) {
        found.note(format!("{BIBLIOGRAPHY}: nobody cites [{key}]"));
    }
    Ok(())
}

/// Keys of a BibTeX file: what stands between `@kind{` and the comma, and in the lists of other keys, `ids`.
fn keys(bibliography: &str) -> impl Iterator<Item = &str> {
    bibliography.lines().flat_map(|line| {
        let key = line
            .strip_prefix('@')
            .and_then(|l| l.split_once('{'))
            .map(|(_, rest)| rest.trim_end_matches(','));
        let ids = line.trim().strip_prefix("ids = {").and_then(|l| l.split('}').next());
        key.into_iter().chain(ids.into_iter().flat_map(|l| l.split(','))).map(str::trim)
    })
}

/// The part of a line that people read.
fn comment<'a>(path: &str, line: &'a str) -> Option<&'a str> {
    match path.rsplit('.').next()? {
        // Slashes after an odd number of quotes stand in a text.
        "rs" => line.match_indices("//").map(|(at, _)| line.split_at(at)).find_map(|(code, comment)| {
            (code.replace("\\\"", "").matches('"').count() % 2 == 0).then_some(comment)
        }),
        "pbrt" | "py" | "toml" => line.find('#').map(|at| &line[at..]),
        "md" => Some(line),
        _ => None,
    }
}

/// Keys cited in a text, such as `Walter2007` in `[Walter2007, eq. 16]` or both in `[Owen1995; Owen1997]`.
fn cited(text: &str) -> Vec<&str> {
    let mut keys = Vec::new();
    for (at, _) in text.match_indices('[').filter(|(at, _)| !text[..*at].ends_with('`')) {
        let Some((inside, _)) = text[at + 1..].split_once(']') else { continue };
        for one in inside.split(';') {
            let (key, place) = one.split_once(',').unwrap_or((one, ""));
            let (key, place) = (key.trim(), place.trim_start());
            let word: String = place.chars().take_while(char::is_ascii_alphabetic).collect();
            let placed = PLACES.contains(&word.as_str()) || is_a_name(key) && starts_with_digit(place);
            if looks_like_a_key(key) && (ends_with_year(key) || placed) {
                keys.push(key);
            }
        }
    }
    keys
}

fn looks_like_a_key(key: &str) -> bool {
    key.starts_with(|c: char| c.is_ascii_alphabetic())
        && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '-')
}

/// Such as `Hecht`, unlike a constant or an index.
fn is_a_name(key: &str) -> bool {
    key.starts_with(|c: char| c.is_ascii_uppercase()) && key.contains(|c: char| c.is_ascii_lowercase())
}

fn starts_with_digit(place: &str) -> bool {
    place.starts_with(|c: char| c.is_ascii_digit())
}

/// Such as `Owen1997` or `Burley2020a`.
fn ends_with_year(key: &str) -> bool {
    let key = key.strip_suffix(|c: char| c.is_ascii_lowercase()).unwrap_or(key);
    let name = key.trim_end_matches(|c: char| c.is_ascii_digit());
    key.len() == name.len() + 4 && name.starts_with(|c: char| c.is_ascii_uppercase())
}

#[cfg(test)]
mod tests {
    use super::super::tests::source;
    use super::*;

    #[test]
    fn tells_citations_from_other_brackets() {
        assert_eq!(
            cited("/// G1 [Heitz2014, eq. 43] and [Owen1995; Owen1997]"),
            ["Heitz2014", "Owen1995", "Owen1997"]
        );
        assert_eq!(cited("// [CIE15, sec. 3], [Hecht, eq. 4.34]"), ["CIE15", "Hecht"]);
        assert_eq!(cited("// [AbramowitzStegun, 9.8.1], as `[Key1999, eq. 1]`"), ["AbramowitzStegun"]);
        assert_eq!(cited("// a slice `[f32; 4]`, a link [`Real`], [0, 1], [x, 1], [Vec3]"), [""; 0]);
    }

    #[test]
    fn misses_and_idle_entries_are_told() {
        let sources = [
            source(BIBLIOGRAPHY, "@article{Good1990,\n  ids = {Old},\n}\n@book{Idle1991,\n}"),
            source(
                "a.rs",
                "let x = 1; // [Good1990, eq. 1], [Old, p. 2]\n/// [Bad1992]\nlet y = \"// [Text1993]\";",
            ),
        ];
        let mut found = Findings::default();
        check(Path::new(""), &sources, &mut found).expect("there is a bibliography");
        assert_eq!(found.faults, ["a.rs:2: [Bad1992] is not in docs/references.bib"]);
        assert_eq!(found.notes, ["docs/references.bib: nobody cites [Idle1991]"]);
    }
}
