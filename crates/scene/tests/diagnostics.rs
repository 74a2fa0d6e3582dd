//! What the reader says about faulty scenes, word for word: the cases of `diagnostics.txt`.
//!
//! A case is a scene text, followed by what is said about it on lines that begin with `>`: its faults, or its
//! warnings where it has no faults. Lines that begin with `=` are headings.

use std::path::Path;

use sparrow_scene::{Diagnostic, read_str};

/// Faults of a text, or else its warnings, one per line, as `line:column: message`.
fn said(text: &str) -> String {
    let (list, files) = match read_str(text, "t", Path::new("nowhere")) {
        Ok(scene) => (scene.warnings, scene.files),
        Err(e) => (e.faults, e.files),
    };
    let line = |d: &Diagnostic| {
        let line = d.display(&files).to_string().replace('\\', "/");
        format!("> {}\n", line.strip_prefix("t:").unwrap_or(&line).trim())
    };
    if list.is_empty() { "> nothing\n".to_string() } else { list.iter().map(line).collect() }
}

#[test]
fn diagnostics_read_as_written_down() {
    let mut is = String::new();
    let mut text = String::new();
    let want = include_str!("diagnostics.txt");
    for line in want.lines() {
        if line.starts_with('>') {
            if !text.is_empty() {
                is += &said(text.trim_end());
            }
            text.clear();
            continue;
        }
        is += line;
        is += "\n";
        if !line.starts_with('=') && !line.is_empty() {
            text += line;
            text += "\n";
        }
    }
    if is != want {
        for (a, b) in is.lines().zip(want.lines()).filter(|(a, b)| a != b) {
            eprintln!("is   {a}\nwant {b}");
        }
    }
    assert!(is == want, "the reader says something else than diagnostics.txt");
}

#[test]
fn all_faults_are_told_in_file_order() {
    let text = "Camera \"perspective\" \"float fov\" 200\nWorldBegin\nMaterial \"difuse\"\n\
        Shape \"sphere\" \"float r\" 1\nAttributeBegin";
    let e = read_str(text, "t", Path::new("")).map(|_| ()).unwrap_err();
    let places: Vec<_> = e.faults.iter().map(|f| (f.at.line, f.at.column)).collect();
    assert_eq!(places, [(1, 22), (3, 10), (4, 16), (5, 1)], "{e}");
}

#[test]
fn a_file_in_another_format_does_not_flood() {
    let text = "vertex\n".repeat(5000);
    let e = read_str(&text, "t", Path::new("")).map(|_| ()).unwrap_err();
    assert_eq!(e.faults.len(), 1, "what follows a fault is skipped up to a directive");
    let text = "Shpae \"sphere\" Identity\n".repeat(5000);
    let e = read_str(&text, "t", Path::new("")).map(|_| ()).unwrap_err();
    assert_eq!(e.faults.len(), 101);
    assert_eq!(e.faults[100].message, "and 4900 more faults; mend these first");
}
