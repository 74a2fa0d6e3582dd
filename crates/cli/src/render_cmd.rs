//! `sparrow render`: scene in, picture out.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use sparrow_render::film::{self, Film};
use sparrow_render::{
    Compiled, RenderOptions, RenderPlan, RenderStats, Scene, Strategies, compile, render, render_strategies,
    render_to_noise,
};
use sparrow_scene::{Diagnostic, FilmDesc, SceneDesc, Span};

use crate::args::{MAX_SPP, RenderArgs};
use crate::failure::{self, DONE, Failure, INTERRUPTED, Remark};
use crate::output::Picture;
use crate::paths::{self, Outputs};
use crate::process::{Usage, available_memory};
use crate::progress::Watch;
use crate::report::{Outcome, Stats, Status, Times, bytes, clock, si};
use crate::{adaptive, console, images, interrupt, overrides, strategies};

/// Renders, and gives the exit code.
///
/// # Errors
/// Everything that is wrong with the input.
pub(crate) fn run(args: &RenderArgs) -> Result<u8, Failure> {
    let start = Instant::now();
    interrupt::install();
    check_named_paths(args)?;
    let threads = start_threads(args)?;
    let mut log = Log { quiet: args.quiet, notes: Vec::new() };

    let mut desc =
        sparrow_scene::read_with_materials(&args.scene, &args.material).map_err(|e| Failure::scene(&e))?;
    let read = start.elapsed();
    overrides::apply(args, &mut desc);
    let out = outputs(args, &desc)?;
    check_memory(&desc.film, args)?;
    let warnings = failure::warnings(&desc.warnings, &desc.files);
    warnings.iter().for_each(|w| log.line(&w.text));

    let film_desc = desc.film.clone();
    let mut stats = Stats::new(args, &desc, threads);
    let (scene, plan) = build(args, desc, &warnings, &mut stats, &mut log)?;
    let compiled = start.elapsed() - read;
    log.line(&beginning(&film_desc, &plan, args, threads));
    let (film, parts, did) = take(&scene, &plan, args, threads)?;
    note_losses(&did, &mut log);
    adaptive::note_noise(args, &did, &mut stats, |note| log.note(note));
    let status = fill(&mut stats, &scene, film.bytes(), &did)?;

    let write_start = Instant::now();
    let picture = Picture::new(&*film, film_desc.save_fp16, args.variance, args.noise.is_some());
    if picture.n_clipped > 0 {
        log.note(format!(
            "{} pixels are brighter than 16-bit floats can hold and were cut at 65504; keep them with --half=off",
            picture.n_clipped
        ));
    }
    let saved = picture.save(&out, &film_desc, scene.camera(), &stats);
    saved.map_err(|e| Failure::input(e.to_string()))?;
    if let (Some(folder), Some(parts)) = (&args.strategies, &parts) {
        strategies::save(folder, parts, &picture, &film_desc)?;
    }
    stats.times = Times {
        wall_seconds: start.elapsed().as_secs_f64(),
        read_seconds: read.as_secs_f64(),
        compile_seconds: compiled.as_secs_f64(),
        write_seconds: write_start.elapsed().as_secs_f64(),
        render_seconds: did.elapsed.as_secs_f64(),
    };
    stats.usage = Usage::now();
    log.line(&ending(&out, &stats));
    stats.notes = log.notes;
    hand_over(args, &out, &stats, &warnings)?;
    Ok(exit_code(status))
}

/// What the log has said, kept for the machine-readable outcome too.
struct Log {
    quiet: bool,
    notes: Vec<String>,
}

impl Log {
    fn line(&self, text: &str) {
        if !self.quiet {
            console::log(text);
        }
    }
    fn note(&mut self, text: String) {
        self.line(&format!("note: {text}"));
        self.notes.push(text);
    }
}

/// The paths that the user named, before a large scene is read.
fn check_named_paths(args: &RenderArgs) -> Result<(), Failure> {
    adaptive::check(args)?;
    if let Some(stats) = &args.stats {
        paths::check_writable(stats)?;
        paths::check_no_input(stats, [args.scene.as_path()])?;
    }
    match &args.output {
        Some(exr) => paths::check_writable(exr),
        None => Ok(()),
    }
}

/// One pool for reading, building and rendering.
fn start_threads(args: &RenderArgs) -> Result<usize, Failure> {
    let n = args.threads.unwrap_or(0) as usize;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build_global();
    pool.map_err(|e| Failure::input(format!("cannot start {n} threads: {e}; use fewer with --threads")))?;
    Ok(rayon::current_num_threads())
}

/// The files to be written, all checked.
fn outputs(args: &RenderArgs, desc: &SceneDesc) -> Result<Outputs, Failure> {
    let out = Outputs::new(args.output.as_deref(), desc.film.filename.as_deref(), &args.scene);
    let out = if args.noise.is_some() { out.with_samples() } else { out };
    let stats = args.stats.as_deref();
    for path in out.files() {
        paths::check_writable(path)?;
        if stats == Some(path) {
            return Err(Failure::usage(format!(
                "{}: --stats and the picture have the same name; name another file",
                path.display()
            )));
        }
    }
    strategies::check(args, desc.integrator.mis)?;
    let inputs: Vec<&Path> =
        desc.files.iter().map(|f| f.as_path()).chain(images::of(desc).into_iter().map(|i| i.0)).collect();
    for path in out.files().chain(stats) {
        paths::check_no_input(path, inputs.iter().copied())?;
    }
    for path in strategy_files(args) {
        paths::check_no_input(&path, inputs.iter().copied())?;
    }
    Ok(out)
}

/// The files of `--strategies`.
fn strategy_files(args: &RenderArgs) -> Vec<PathBuf> {
    args.strategies.as_deref().map(strategies::files).unwrap_or_default()
}

/// Refuses a film that cannot fit, before the system ends the program for it.
fn check_memory(film: &FilmDesc, args: &RenderArgs) -> Result<(), Failure> {
    let [x0, x1, y0, y1] = film.pixel_bounds.map(u64::from);
    let pixels = x1.saturating_sub(x0) * y1.saturating_sub(y0);
    // One pixel of a film, or of two, and of the copies that are made when it is written.
    let adaptive = args.noise.is_some();
    let pixel = Film::new(1, 1, args.variance || adaptive).bytes() as u64;
    let one = if adaptive { 2 * pixel + 8 } else { pixel } + if args.variance { 72 } else { 36 };
    let one = one + args.strategies.as_ref().map_or(0, |_| strategies::bytes_per_pixel());
    let needed = pixels.saturating_mul(one);
    match available_memory() {
        Some(free) if needed > free => Err(Failure::input(format!(
            "a picture of {} x {} pixels needs {} of memory, {} are free; use --crop or a smaller --resolution",
            x1 - x0,
            y1 - y0,
            bytes(needed),
            bytes(free)
        ))),
        _ => Ok(()),
    }
}

/// Description to scene.
fn build(
    args: &RenderArgs,
    desc: SceneDesc,
    warnings: &[Remark],
    stats: &mut Stats,
    log: &mut Log,
) -> Result<(Scene, RenderPlan), Failure> {
    let files = desc.files.clone();
    let images: Vec<(String, Span)> =
        images::of(&desc).iter().map(|(path, at)| (path.display().to_string(), *at)).collect();
    // What is wrong with an image is told without its place, which the description knew.
    let located = |message: String| match images.iter().find(|i| message.starts_with(&i.0)) {
        Some(&(_, at)) => Remark::of(&Diagnostic::error(at, message), &files),
        None => Remark::in_file(&args.scene, &message),
    };
    let refused =
        |faults: Vec<String>| Failure::in_scene(faults.into_iter().map(located).collect(), warnings.to_vec());
    let plan = RenderPlan::new(&desc).map_err(refused)?;
    stats.samples_per_pixel_wanted = plan.samples_per_pixel;
    stats.mis = plan.integrator.mis.to_string();
    stats.sampler_notes = plan.sampler.notes();
    stats.sampler_notes.iter().for_each(|n| log.line(&format!("note: {n}")));
    let Compiled { scene, notes } = compile(desc).map_err(|e| refused(e.0))?;
    notes.into_iter().for_each(|n| log.note(n));
    Ok((scene, plan))
}

/// A finished render, the light of each technique where it was asked for, and what was done.
type Taken = (Box<dyn film::Picture>, Option<Strategies>, RenderStats);

/// Renders, with progress.
fn take(scene: &Scene, plan: &RenderPlan, args: &RenderArgs, threads: usize) -> Result<Taken, Failure> {
    let watch = Watch::new(args.quiet, args.time);
    let options = RenderOptions { threads, variance: args.variance, time_limit: args.time };
    interrupt::rendering_begins();
    let (stop, tell) = (interrupt::stop(), |p| watch.update(p));
    let done = match (args.noise, &args.strategies) {
        (Some(target), _) => render_to_noise(scene, plan, target, &options, stop, &tell)
            .map(|(halves, did)| (Box::new(halves) as Box<dyn film::Picture>, None, did)),
        (None, Some(_)) => render_strategies(scene, plan, &options, stop, &tell)
            .map(|(film, parts, did)| (Box::new(film) as _, Some(parts), did)),
        (None, None) => {
            render(scene, plan, &options, stop, &tell).map(|(film, did)| (Box::new(film) as _, None, did))
        }
    };
    watch.finish();
    done.map_err(|e| Failure::input(e.to_string()))
}

fn note_losses(did: &RenderStats, log: &mut Log) {
    if did.samples_per_pixel == 0 && did.samples > 0 {
        log.note("stopped before every pixel had a sample; those without are black".to_owned());
    }
    if did.rejected > 0 {
        log.note(format!("{} samples were no numbers and were left out; please report this", did.rejected));
    }
}

/// Enters what the render did.
///
/// # Errors
/// Where it did nothing, so that there is nothing to save.
fn fill(stats: &mut Stats, scene: &Scene, film_bytes: usize, did: &RenderStats) -> Result<Status, Failure> {
    let interrupted = interrupt::stop().load(std::sync::atomic::Ordering::SeqCst);
    let status = match (did.stopped, interrupted) {
        (false, _) => Status::Done,
        (true, true) => Status::Interrupted,
        (true, false) => Status::TimeLimit,
    };
    if did.samples == 0 {
        return Err(match status {
            Status::Interrupted => {
                Failure::interrupted("interrupted before the first sample; nothing was written")
            }
            Status::Done | Status::TimeLimit => {
                Failure::input("the time was over before the first sample; nothing was written; raise --time")
            }
        });
    }
    let seconds = did.elapsed.as_secs_f64().max(1e-9);
    stats.status = status;
    stats.stopped = did.stopped;
    stats.samples = did.samples;
    stats.samples_per_pixel = did.samples_per_pixel;
    stats.splits = did.splits;
    stats.rejected_samples = did.rejected;
    stats.rays = did.rays.into();
    stats.samples_per_second = did.samples as f64 / seconds;
    stats.rays_per_second = did.rays.total() as f64 / seconds;
    stats.times.render_seconds = did.elapsed.as_secs_f64();
    stats.acceleration_structure = scene.geometry().stats().into();
    stats.lights = scene.lights().len();
    stats.materials = scene.n_materials();
    stats.scene_bytes = scene.bytes();
    stats.film_bytes = film_bytes;
    Ok(status)
}

fn exit_code(status: Status) -> u8 {
    match status {
        Status::Done | Status::TimeLimit => DONE,
        Status::Interrupted => INTERRUPTED,
    }
}

fn beginning(film: &FilmDesc, plan: &RenderPlan, args: &RenderArgs, threads: usize) -> String {
    let [w, h] = plan.size();
    let part = match film.resolution {
        [fw, fh] if [fw, fh] != [w, h] => format!(" of {fw} x {fh}"),
        _ => String::new(),
    };
    let seconds = |t: Duration| format!("{} s", t.as_secs_f64());
    let goal = match (plan.samples_per_pixel, args.time) {
        _ if args.noise.is_some() => adaptive::goal(args),
        (spp, Some(t)) if spp >= MAX_SPP => format!("for {}", seconds(t)),
        (spp, Some(t)) => format!("with {spp} samples per pixel, for at most {}", seconds(t)),
        (spp, None) => format!("with {spp} samples per pixel"),
    };
    format!("rendering {w} x {h} pixels{part} {goal}, {threads} threads")
}

fn ending(out: &Outputs, stats: &Stats) -> String {
    let how = match stats.status {
        Status::Done => "",
        Status::TimeLimit => ", as far as the time went",
        Status::Interrupted => ", as far as it was rendered",
    };
    let time = stats.times.render_seconds;
    let time = if time < 60.0 { format!("{time:.2} s") } else { clock(time) };
    let samples = match &stats.noise {
        Some(noise) => noise.to_string(),
        None => format!("{} samples per pixel", stats.samples_per_pixel),
    };
    let ways = match stats.splits {
        0 | 1 => String::new(),
        n => format!(", {n} ways on from each"),
    };
    format!(
        "wrote {} and {}{how}: {samples}{ways} in {time}, {}rays/s",
        out.exr.display(),
        out.png.display(),
        si(stats.rays_per_second)
    )
}

/// The machine-readable results.
fn hand_over(args: &RenderArgs, out: &Outputs, stats: &Stats, warnings: &[Remark]) -> Result<(), Failure> {
    let unwritable =
        |e: serde_json::Error| Failure::input(format!("the result is no JSON: {e}; please report this"));
    let layers = strategy_files(args);
    let mut files: Vec<&Path> = out.files().chain(layers.iter().map(PathBuf::as_path)).collect();
    if let Some(path) = &args.stats {
        let text = serde_json::to_string_pretty(stats).map_err(unwritable)?;
        paths::write_whole(path, &(text + "\n"))?;
        files.push(path);
    }
    if args.json {
        let outputs: Vec<String> = files.iter().map(|f| f.display().to_string()).collect();
        let outcome = Outcome {
            status: stats.status,
            exit_code: exit_code(stats.status),
            version: stats.version,
            outputs: &outputs,
            stats,
            warnings,
        };
        console::print(serde_json::to_string(&outcome).map_err(unwritable)?)?;
    }
    Ok(())
}
