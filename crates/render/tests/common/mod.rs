//! A picture from a scene given as text.

#![allow(
    dead_code,
    unreachable_pub,
    clippy::panic,
    reason = "each test file uses its part; a test panics when it fails"
)]

use std::path::Path;
use std::sync::atomic::AtomicBool;

use sparrow_render::film::Film;
use sparrow_render::{RenderOptions, RenderPlan, RenderStats, compile, render};
use sparrow_scene::SceneDesc;

/// Reads a scene; panics with the reader's message where it does not like it.
pub fn describe(text: &str) -> SceneDesc {
    sparrow_scene::read_str(text, "test.pbrt", Path::new(env!("CARGO_MANIFEST_DIR")))
        .unwrap_or_else(|e| panic!("{e}"))
}

/// Renders a description on `threads` threads.
pub fn picture_of(desc: SceneDesc, threads: usize) -> (Film, RenderStats) {
    let plan = RenderPlan::new(&desc).unwrap_or_else(|e| panic!("{e:?}"));
    let compiled = compile(desc).unwrap_or_else(|e| panic!("{e}"));
    let options = RenderOptions { threads, variance: true, time_limit: None };
    render(&compiled.scene, &plan, &options, &AtomicBool::new(false), &|_| ())
        .unwrap_or_else(|e| panic!("{e}"))
}

/// Renders a scene text on one thread.
pub fn picture(text: &str) -> Film {
    picture_of(describe(text), 1).0
}

/// Mean over all pixels, and the standard error of that mean from the pixels' own variances.
pub fn mean(film: &Film) -> ([f64; 3], [f64; 3]) {
    let n = f64::from(film.width() * film.height());
    let (mut sum, mut var) = ([0.0; 3], [0.0; 3]);
    for y in 0..film.height() {
        for x in 0..film.width() {
            let p = film.pixel(x, y);
            for c in 0..3 {
                sum[c] += p.rgb[c] / n;
                var[c] += p.variance[c] / (n * n);
            }
        }
    }
    (sum, var.map(f64::sqrt))
}
