//! Rays per second of processor time: meshes and soups of triangles; camera, bounce and shadow rays; one thread.
//!
//! `cargo bench -p sparrow-geometry --bench rays -- [SCENE] [ROUNDS] [RESOLUTION] [SETTINGS]`, with SCENE one of `mesh`, `soup`, `small`,
//! `cornell` or `all`; or `instances`, and instead of SETTINGS their number; or `build`, which builds with one thread and with two. With
//! `--features embree` and `EMBREE_LIB_DIR` naming a folder that holds `libembree4.so`, every round runs Embree beside it, and the
//! ratio of the two is the median over the rounds. Linux only: the clock is a thread's processor time.

#![allow(clippy::print_stdout, reason = "printing is what it is for")]
#![allow(clippy::unwrap_used, reason = "a benchmark stops where something is missing")]

#[cfg(target_os = "linux")]
mod build;
#[cfg(target_os = "linux")]
mod cornell;
#[cfg(target_os = "linux")]
#[cfg(feature = "embree")]
mod embree;
#[cfg(target_os = "linux")]
mod instances;
#[cfg(target_os = "linux")]
mod race;
#[cfg(target_os = "linux")]
mod rays;
#[cfg(target_os = "linux")]
mod scenes;
#[cfg(target_os = "linux")]
mod surfaces;

#[cfg(not(target_os = "linux"))]
fn main() {
    println!("this benchmark reads a clock that only Linux has");
}

#[cfg(target_os = "linux")]
fn main() {
    let args: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let what = args.first().map_or("all", String::as_str);
    let number = |i: usize, default: usize| args.get(i).and_then(|s| s.parse().ok()).unwrap_or(default);
    let (rounds, resolution, settings) = (number(1, 7), number(2, 448), number(3, 5));
    let wanted = |name: &str| what == "all" || what == name;
    // Trees are built by this thread, whose clock is read.
    rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global().unwrap();
    for scene in scenes::ALL {
        if wanted(scene.name) {
            scene.run(rounds, resolution, settings);
        }
    }
    if wanted("cornell") {
        cornell::run(rounds, resolution);
    }
    if what == "build" {
        scenes::ALL.iter().for_each(|scene| build::run(scene.name, &scene.mesh(), rounds));
    }
    if what == "instances" {
        instances::run(scenes::bumpy_ball(20), number(3, 10_000_000), rounds, resolution);
    }
}
