//! The whole book in draft quality: every check of every figure holds, and the folder is sound.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::sync::atomic::AtomicBool;

use sparrow_lecture::{Book, Quality, SLIDES, Standing, TOPICS};

/// The book, made once for all tests, and its folder.
static BOOK: LazyLock<(Book, PathBuf)> = LazyLock::new(|| {
    let folder = std::env::temp_dir().join(format!("sparrow-lecture-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    let made = Book::write(None, Quality::Draft, &folder, &AtomicBool::new(false), &mut |_, _, _| {});
    (made.unwrap_or_else(|e| panic!("{e}")), folder)
});

#[test]
fn every_check_holds() {
    let mut faults = Vec::new();
    for made in &BOOK.0.figures {
        for check in made.figure.checks.iter().filter(|c| !c.holds()) {
            faults.push(format!("{}: {check:?}", made.entry.id));
        }
        if made.figure.checks.is_empty() {
            faults.push(format!("{}: no checks", made.entry.id));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_slide_has_its_figures() {
    let rows = BOOK.0.rows();
    assert_eq!(rows.len(), SLIDES.len());
    let standing =
        |s: Standing| rows.iter().filter(|r| r.standing == s).map(|r| r.slide.row).collect::<Vec<_>>();
    assert_eq!(standing(Standing::Absent), Vec::<u8>::new());
    assert_eq!(standing(Standing::Untitled), [26]);
    assert_eq!(standing(Standing::Failed), Vec::<u8>::new());
}

#[test]
fn figures_say_where_they_come_from() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let bibliography = fs::read_to_string(root.join("docs/references.bib")).unwrap();
    let mut ids = HashSet::new();
    for made in &BOOK.0.figures {
        let (id, figure) = (made.entry.id, &made.figure);
        assert!(ids.insert(id), "{id} is there twice");
        assert!(!figure.caption.is_empty() && !figure.pictures.is_empty() && figure.table.is_some(), "{id}");
        for formula in &figure.formulas {
            let (file, function) =
                formula.code.split_once(": ").unwrap_or_else(|| panic!("{id}: {}", formula.code));
            let text = fs::read_to_string(root.join("crates").join(file))
                .unwrap_or_else(|e| panic!("{id}: {file}: {e}"));
            assert!(text.contains(&format!("fn {function}")), "{id}: {file} has no function {function}");
            let key = formula.source.trim_matches(['[', ']']).split(',').next().unwrap_or_default();
            assert!(bibliography.contains(&format!("{{{key},")), "{id}: {key} is not in the bibliography");
        }
    }
    let entries: usize = TOPICS.iter().map(|t| t.figures.len()).sum();
    assert_eq!(ids.len(), entries);
}

/// Elements that have no end.
const VOID: [&str; 4] = ["meta", "link", "img", "br"];

/// Faults of a page: elements that do not end in turn, links to nothing, pictures without a text.
fn faults(folder: &Path, name: &str, page: &str) -> Vec<String> {
    let (mut open, mut faults): (Vec<&str>, Vec<String>) = (Vec::new(), Vec::new());
    for piece in page.split('<').skip(1) {
        let (tag, _) = piece.split_once('>').unwrap_or((piece, ""));
        let word = tag.split([' ', '\n']).next().unwrap_or_default();
        if let Some(end) = word.strip_prefix('/') {
            if open.pop() != Some(end) {
                faults.push(format!("</{end}> ends nothing"));
            }
        } else if !word.starts_with('!') && !VOID.contains(&word) {
            open.push(word);
        }
        if word == "img" && (!tag.contains(" alt=\"") || tag.contains(" alt=\"\"")) {
            faults.push(format!("no text for <{tag}>"));
        }
        for attribute in ["href=\"", "src=\""] {
            let Some((_, rest)) = tag.split_once(attribute) else { continue };
            let target = rest.split('"').next().unwrap_or_default();
            let (file, part) = target.split_once('#').unwrap_or((target, ""));
            let there = fs::read(folder.join(file));
            let whole = part.is_empty()
                || there
                    .as_ref()
                    .is_ok_and(|t| String::from_utf8_lossy(t).contains(&format!("id=\"{part}\"")));
            if there.is_err() || !whole {
                faults.push(format!("{target} is not there"));
            }
        }
    }
    faults.extend(open.iter().map(|e| format!("<{e}> does not end")));
    faults.into_iter().map(|f| format!("{name}: {f}")).collect()
}

#[test]
fn pages_are_sound() {
    let folder = &BOOK.1;
    let mut pages = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if !name.ends_with(".html") {
            continue;
        }
        let page = fs::read_to_string(folder.join(&name)).unwrap();
        let faults = faults(folder, &name, &page);
        assert!(faults.is_empty(), "{}", faults.join("\n"));
        for formula in page.split("<math").skip(1) {
            let formula = format!("<math{}", formula.split_once("</math>").unwrap().0) + "</math>";
            assert!(roxmltree::Document::parse(&formula).is_ok(), "{name}: {formula}");
        }
        pages += 1;
    }
    assert_eq!(pages, 1 + TOPICS.iter().filter(|t| !t.figures.is_empty()).count());
    for entry in fs::read_dir(folder.join("figures")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "svg") {
            let text = fs::read_to_string(&path).unwrap();
            assert!(roxmltree::Document::parse(&text).is_ok(), "{}", path.display());
        }
    }
}

#[test]
fn the_same_figures_have_the_same_bytes() {
    let folder = std::env::temp_dir().join(format!("sparrow-lecture-again-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    for only in ["azimuths", "many-reflections"] {
        Book::write(Some(only), Quality::Draft, &folder, &AtomicBool::new(false), &mut |_, _, _| {}).unwrap();
        for file in [format!("figures/{only}.svg"), format!("data/{only}.csv")] {
            assert!(fs::read(folder.join(&file)).unwrap() == fs::read(BOOK.1.join(&file)).unwrap(), "{file}");
        }
    }
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn the_first_page_counts() {
    let index = fs::read_to_string(BOOK.1.join("index.html")).unwrap();
    // All but the untitled one.
    let passed = SLIDES.len() - 1;
    assert!(index.contains(&format!("<b>{passed} of 29</b> slides passed")), "{index}");
}

#[test]
fn a_stopped_book_leaves_nothing() {
    let folder = std::env::temp_dir().join(format!("sparrow-lecture-stopped-{}", std::process::id()));
    let e =
        Book::write(None, Quality::Draft, &folder, &AtomicBool::new(true), &mut |_, _, _| {}).unwrap_err();
    assert!(e.to_string().contains("interrupted"), "{e}");
    assert!(!folder.exists());
}
