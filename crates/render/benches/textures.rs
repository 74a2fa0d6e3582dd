//! What looking up an image costs: a plain under the camera, with a texture and without.
//!
//! `cargo bench -p sparrow-render --bench textures`; ns per camera sample more than with a reflectance that is the same everywhere, the
//! median of many rounds, in which all take turns. The image has 4096 x 4096 texels of 8 bits. It fills the picture once, so that neighbours share
//! texels, or 64 times across, so that without smaller levels each sample asks for texels far from the last.

#![allow(
    clippy::print_stdout,
    clippy::panic,
    clippy::expect_used,
    reason = "printing is what it is for; it ends where it cannot go on"
)]

use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use sparrow_image::write_png;
use sparrow_render::{RenderOptions, RenderPlan, Scene, compile, render};

const SIDE: usize = 4096;
const ROUNDS: usize = 15;
/// Pixels along a side, and samples of each.
const PIXELS: u32 = 256;
const SPP: u32 = 4;

/// A plain that fills the picture, lit from above.
fn scene(reflectance: &str, colour: &str) -> String {
    format!(
        r#"Option "colour" "{colour}"
        Film "rgb" "integer xresolution" {PIXELS} "integer yresolution" {PIXELS}
        Sampler "independent" "integer pixelsamples" {SPP}
        Integrator "path" "integer maxdepth" 1
        LookAt 0 0 1  0 0 0  0 1 0
        Camera "orthographic"
        WorldBegin
        LightSource "distant" "point3 from" [ 0 0 1 ] "point3 to" [ 0 0 0 ]
        {reflectance}
        Shape "bilinearmesh" "point3 P" [ -1 -1 0  1 -1 0  -1 1 0  1 1 0 ]"#
    )
}

fn prepared(text: &str) -> (Scene, RenderPlan) {
    let desc = sparrow_scene::read_str(text, "bench.pbrt", Path::new(".")).unwrap_or_else(|e| panic!("{e}"));
    let plan = RenderPlan::new(&desc).unwrap_or_else(|e| panic!("{e:?}"));
    (compile(desc).unwrap_or_else(|e| panic!("{e}")).scene, plan)
}

fn main() {
    let file = std::env::temp_dir().join(format!("sparrow-bench-{}.png", std::process::id()));
    let texel = |i: usize| {
        [0u64, 1, 2]
            .map(|c| ((i as u64 * 3 + c).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) as f32 / 16_777_216.0)
    };
    let texels: Vec<[f32; 3]> = (0..SIDE * SIDE).map(texel).collect();
    write_png(&file, SIDE, SIDE, &texels).expect("a file in the temporary folder");
    let plain = r#"Material "diffuse" "rgb reflectance" [ 0.5 0.4 0.3 ]"#;
    for colour in ["spectral", "rgb"] {
        let mut all = vec![("constant".to_owned(), prepared(&scene(plain, colour)))];
        for filter in ["point", "bilinear", "trilinear", "ewa"] {
            for times in [1, 64] {
                let reflectance = format!(
                    r#"Texture "t" "spectrum" "imagemap" "string filename" "{}" "string filter" "{filter}"
                    "float uscale" {times} "float vscale" {times}
                    Material "diffuse" "texture reflectance" "t""#,
                    file.display()
                );
                all.push((format!("{filter}, {times} x"), prepared(&scene(&reflectance, colour))));
            }
        }
        let options = RenderOptions { threads: 1, variance: false, time_limit: None };
        let mut times = vec![Vec::new(); all.len()];
        for _ in 0..ROUNDS {
            for ((_, (scene, plan)), times) in all.iter().zip(&mut times) {
                let start = Instant::now();
                render(scene, plan, &options, &AtomicBool::new(false), &|_| ())
                    .unwrap_or_else(|e| panic!("{e}"));
                times.push(start.elapsed().as_secs_f64() * 1e9 / f64::from(PIXELS * PIXELS * SPP));
            }
        }
        let medians = times.iter_mut().map(|t| {
            t.sort_unstable_by(f64::total_cmp);
            t[t.len() / 2]
        });
        let medians: Vec<f64> = medians.collect();
        for ((name, (scene, _)), median) in all.iter().zip(&medians) {
            println!(
                "{colour:9} {name:16} {:7.1} ns {:7.1} MB",
                median - medians[0],
                scene.bytes() as f64 / 1e6
            );
        }
    }
    let _ = std::fs::remove_file(&file);
}
