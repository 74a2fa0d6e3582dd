//! Every heuristic, every choice of lights, every sampler and every roulette has the same mean, whatever shines and scatters.

#![allow(clippy::panic, clippy::expect_used, reason = "a test that cannot go on has failed")]

#[path = "../common/mod.rs"]
mod common;
mod scenes;
mod trial;

use std::path::PathBuf;

use trial::{SETTINGS, limit, try_all};

/// A sky brighter above, with a soft sun.
fn map() -> PathBuf {
    let path = std::env::temp_dir().join(format!("sparrow-{}-unbiased.pfm", std::process::id()));
    let mut bytes = b"PF\n64 32\n-1.0\n".to_vec();
    for (x, y) in (0..32i32).flat_map(|y| (0..64i32).map(move |x| (x, y))) {
        let sun = if (x - 20).pow(2) + (y - 22).pow(2) < 9 { 12.0f32 } else { 0.0 };
        let sky = 0.3 + 0.02 * y as f32;
        [sky + sun, sky + 0.8 * sun, 1.5 * sky + 0.5 * sun]
            .iter()
            .for_each(|v| bytes.extend(v.to_le_bytes()));
    }
    std::fs::write(&path, bytes).expect("a file in the temporary folder");
    path
}

#[test]
fn every_setting_has_the_same_mean() {
    let scenes = scenes::all(&map());
    let limit = limit(scenes.len());
    let mut faults = Vec::new();
    for scene in &scenes {
        for v in try_all(&scene.text, &scene.text, &scene.truth) {
            if v.p < limit {
                let setting = v.setting.map_or_else(|| "all together".to_owned(), |s| format!("{s:?}"));
                faults.push(format!("{}: {setting}: {} times the truth, p = {:e}", scene.name, v.ratio, v.p));
            }
        }
    }
    assert!(faults.is_empty(), "at p below {limit:e}:\n{}", faults.join("\n"));
}

#[test]
fn half_a_percent_in_one_light_is_caught() {
    let scenes = scenes::all(&map());
    let limit = limit(scenes.len());
    let scene = scenes.iter().find(|s| s.name == "sphere").expect("a floor under a sphere");
    let verdicts = try_all(&scenes::planted(&scene.text, "[ 5 5 5 ]", 1.005), &scene.text, &scene.truth);
    let caught: Vec<_> = verdicts.iter().filter(|v| v.p < limit).collect();
    assert!(verdicts.last().is_some_and(|v| v.p < limit), "all together: {:?}", verdicts.last());
    assert!(caught.len() > SETTINGS.len() / 2, "{} of {}: {caught:?}", caught.len(), SETTINGS.len());
}
