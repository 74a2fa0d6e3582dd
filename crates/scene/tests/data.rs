//! Scenes of other programs, where they are at hand: all are read, or refused with a place.

use std::path::{Path, PathBuf};

use sparrow_scene::{SceneDesc, SceneError, read};

/// The folder of test data: `SPARROW_DATA`, or `../shared/data` beside the workspace.
fn data(sub: &str) -> Option<PathBuf> {
    let base = match std::env::var_os("SPARROW_DATA") {
        Some(dir) => PathBuf::from(dir),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
    };
    let dir = base.join(sub);
    if !dir.is_dir() {
        eprintln!("skipped: there is no {}", dir.display());
        return None;
    }
    Some(dir)
}

fn scenes_below(dir: &Path, out: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(dir) else { return };
    for path in entries.filter_map(|e| e.ok()).map(|e| e.path()) {
        if path.is_dir() {
            scenes_below(&path, out);
        } else if path.extension().is_some_and(|e| e == "pbrt") {
            out.push(path);
        }
    }
    out.sort();
}

fn check(path: &Path, result: &Result<SceneDesc, SceneError>) {
    match result {
        Ok(scene) => {
            for w in &scene.warnings {
                eprintln!("{}", w.display(&scene.files));
            }
        }
        Err(e) => {
            eprintln!("{e}");
            assert!(!e.faults.is_empty() && e.faults.iter().all(|f| f.message.contains("; ")), "{path:?}");
        }
    }
}

#[test]
fn feature_files_are_read_or_refused() {
    let Some(dir) = data("pbrt4-features") else { return };
    let mut paths = Vec::new();
    scenes_below(&dir, &mut paths);
    let mut refused = Vec::new();
    for path in &paths {
        let result = read(path);
        check(path, &result);
        if result.is_err() {
            refused.push(path.file_name().and_then(|n| n.to_str()).unwrap_or_default());
        }
    }
    eprintln!("{} read, {} refused of {}", paths.len() - refused.len(), refused.len(), paths.len());
    // One has a block without an end, the other is a part that a scene would include.
    refused.sort_unstable();
    assert_eq!(refused, ["test_geolight_no_geo.pbrt", "test_singlegeo.pbrt"]);
}

#[test]
fn whole_scenes_are_read() {
    for folder in ["pbrt4-bitterli", "pbrt4-cornell"] {
        let Some(dir) = data(folder) else { continue };
        let mut paths = Vec::new();
        scenes_below(&dir, &mut paths);
        for path in &paths {
            let result = read(path);
            check(path, &result);
            let scene = result.unwrap_or_else(|e| panic!("{}:\n{e}", path.display()));
            eprintln!("{}: {} shapes", path.display(), scene.shapes.len());
            assert!(!scene.shapes.is_empty() && !scene.lights.is_empty() | !scene.area_lights.is_empty());
        }
    }
}
