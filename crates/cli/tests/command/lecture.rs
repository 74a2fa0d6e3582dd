//! `sparrow lecture`: the folder of the book, what is listed, and what is refused.

use std::fs;

use crate::scratch::Scratch;

#[test]
fn one_slide_makes_a_book_of_its_own() {
    let s = Scratch::new();
    let ran = s.run("lecture --only 18").ok();
    assert!(ran.err.contains("wrote lecture-18/index.html: 1 of 1 slides passed"), "{ran:?}");
    assert_eq!(s.files(), ["lecture-18", "room.pbrt"]);
    let page = fs::read_to_string(s.path("lecture-18/kajiya-kay.html")).unwrap();
    assert!(page.contains("<math") && page.contains("sparrow lecture --only kajiya-kay-terms"), "{page}");
    let csv = fs::read_to_string(s.path("lecture-18/data/kajiya-kay-terms.csv")).unwrap();
    assert!(csv.starts_with("chart,curve,x,y\n"), "{csv}");
    let json = s.run("lecture --only kajiya-kay-terms -o lecture-18 --json --quiet").ok().json();
    assert_eq!((&json["status"], &json["passed"]), (&"done".into(), &1.into()));
    assert_eq!(json["figures"][0]["slides"], serde_json::json!([18]));
}

#[test]
fn the_list_makes_nothing() {
    let s = Scratch::new();
    let list = s.run("lecture --list").ok().out;
    for id in ["cosine-lobe", "off-specular-aluminium", "caustic-density", "weights"] {
        assert!(list.contains(id), "{id} is not in {list}");
    }
    let json = s.run("lecture --list --only 7 --json").ok().json();
    assert_eq!(json["figures"].as_array().map(Vec::len), Some(4), "{json}");
    assert_eq!(s.files(), ["room.pbrt"]);
}

#[test]
fn what_is_no_book_is_left_alone() {
    let s = Scratch::new();
    fs::create_dir(s.path("mine")).unwrap();
    s.put("mine/notes.txt", "mine");
    let ran = s.run("lecture --only 18 -o mine");
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(ran.err.contains("mine: the folder holds something else than a book"), "{ran:?}");
    for (words, code) in [
        ("lecture --only 18 -o room.pbrt", 1),
        ("lecture --only 18 -o missing/book", 1),
        ("lecture --only 99", 2),
        ("lecture --only 26", 2),
        ("lecture --only fresnell", 2),
        ("lecture --quality best", 2),
    ] {
        let ran = s.run(words);
        assert_eq!(ran.code, Some(code), "`{words}`: {ran:?}");
        assert!(!ran.err.is_empty(), "`{words}` says nothing");
    }
    assert_eq!(s.files(), ["mine", "room.pbrt"]);
    assert_eq!(fs::read_to_string(s.path("mine/notes.txt")).unwrap(), "mine");
}
