//! `sparrow info`: what is in a scene, and what of it was not understood.

use std::fmt::Write;

use crate::args::InfoArgs;
use crate::console;
use crate::failure::{DONE, Failure};
use crate::inventory::{Counts, Instances, Inventory, Lights, Material, Shapes};
use crate::report::bytes;

/// Reads a scene and tells what is in it.
///
/// # Errors
/// Everything that is wrong with the scene.
pub(crate) fn run(args: &InfoArgs) -> Result<u8, Failure> {
    let desc = sparrow_scene::read(&args.scene).map_err(|e| Failure::scene(&e))?;
    let info = Inventory::new(&args.scene, &desc);
    let text = if args.json {
        serde_json::to_string(&info)
            .map_err(|e| Failure::input(format!("the result is no JSON: {e}; please report this")))?
    } else {
        text(&info)
    };
    console::print(text.trim_end())?;
    Ok(DONE)
}

/// The inventory for people: a line per thing, its name in front.
fn text(info: &Inventory) -> String {
    let mut out = String::new();
    let mut line = |name: &str, what: String| {
        if !what.is_empty() {
            // Writing to a string cannot fail.
            let _ = writeln!(out, "{name:<12} {what}");
        }
    };
    line("scene", info.scene.clone());
    line("shapes", shapes(&info.shapes));
    line("instances", instances(&info.instances));
    line("geometry", format!("about {}", bytes(info.geometry_bytes_estimate)));
    info.materials.iter().for_each(|m| line("material", material(m)));
    line("lights", lights(&info.lights));
    line("textures", textures(info));
    info.images.iter().for_each(|i| line("image", i.clone()));
    line("camera", camera(info));
    line("film", film(info));
    let s = &info.sampler;
    line(
        "sampler",
        format!(
            "{}, {} samples per pixel, randomization {}, seed {}",
            s.name, s.samples_per_pixel, s.randomization, s.seed
        ),
    );
    let i = &info.integrator;
    let mut integrator =
        format!("{}, maxdepth {}, mis {}, light sampler {}", i.name, i.max_depth, i.mis, i.light_sampler);
    if let Some(n) = i.splits {
        let _ = write!(integrator, ", {n} ways on from the first vertex");
    }
    for (on, word) in [(i.mis_compensation, "MIS compensation"), (i.regularize, "regularized")] {
        if on {
            let _ = write!(integrator, ", {word}");
        }
    }
    line("integrator", integrator);
    info.files.iter().for_each(|f| line("file", f.clone()));
    line("statements", list(&info.statements));
    match info.warnings.len() {
        0 => line("warnings", "none: everything was understood".to_owned()),
        _ => info.warnings.iter().for_each(|w| line("warning", w.text.replacen(" warning:", "", 1))),
    }
    out
}

/// `2 spheres, 1 disk`: what there is none of is left out.
fn tally(parts: &[(usize, &str)]) -> String {
    let there = parts.iter().filter(|(n, _)| *n > 0).map(|(n, what)| plural(*n, what));
    there.collect::<Vec<_>>().join(", ")
}

fn plural(n: usize, what: &str) -> String {
    let ending = match what {
        _ if n == 1 => "",
        w if w.ends_with("sh") || w.ends_with("ch") => "es",
        _ => "s",
    };
    format!("{n} {what}{ending}")
}

fn shapes(s: &Shapes) -> String {
    if s.total == 0 {
        return "none".to_owned();
    }
    let mut text = tally(&[
        (s.triangles, "triangle"),
        (s.bilinear_patches, "bilinear patch"),
        (s.spheres, "sphere"),
        (s.disks, "disk"),
        (s.cylinders, "cylinder"),
        (s.strands, "strand"),
    ]);
    if s.strands > 0 {
        let (segments, points) =
            (plural(s.curve_segments, "segment"), plural(s.control_points, "control point"));
        let _ = write!(text, " of {segments} and {points} ({})", bytes(s.curve_bytes));
    }
    if s.meshes > 0 {
        let _ = write!(text, "; {} ({} distinct)", plural(s.meshes, "mesh"), s.distinct_meshes);
    }
    if s.with_alpha > 0 {
        let _ = write!(text, "; {} with a cut-out", s.with_alpha);
    }
    text
}

fn instances(i: &Instances) -> String {
    if i.prototypes == 0 {
        return String::new();
    }
    format!("{} of {} with {}", i.total, plural(i.prototypes, "object"), plural(i.shapes, "shape"))
}

fn material(m: &Material) -> String {
    let model = m.model.unwrap_or("none: rays pass unchanged");
    format!("{} \"{}\" (model {model}), on {}", m.count, m.type_name, plural(m.shapes, "shape"))
}

fn lights(l: &Lights) -> String {
    let mut text = tally(&[
        (l.point, "point light"),
        (l.spot, "spot light"),
        (l.distant, "distant light"),
        (l.infinite, "uniform infinite light"),
        (l.infinite_image, "environment map"),
    ]);
    if l.emitting_shapes > 0 {
        let and = if text.is_empty() { "" } else { ", " };
        let shapes = plural(l.emitting_shapes, "emitting shape");
        let _ = write!(text, "{and}{shapes} with {}", plural(l.emitting_primitives, "primitive"));
    }
    if text.is_empty() { "none: the picture will be black".to_owned() } else { text }
}

fn textures(info: &Inventory) -> String {
    let kinds = [("float", &info.float_textures), ("spectrum", &info.spectrum_textures)];
    let there = kinds.iter().filter(|(_, c)| !c.is_empty()).map(|(name, c)| format!("{name}: {}", list(c)));
    there.collect::<Vec<_>>().join("; ")
}

fn list(counts: &Counts) -> String {
    counts.iter().map(|(name, n)| format!("{n} {name}")).collect::<Vec<_>>().join(", ")
}

fn camera(info: &Inventory) -> String {
    let c = &info.camera;
    let place = |v: [f64; 3]| v.map(|x| format!("{:.4}", x + 0.0)).join(" ");
    let fov = c.fov.map_or(String::new(), |f| format!(", field of view {f} degrees"));
    let lens = if c.lens_radius > 0.0 {
        format!(", lens radius {}, in focus at {}", c.lens_radius, c.focal_distance)
    } else {
        String::new()
    };
    format!("{}{fov}, at {}, looking along {}{lens}", c.projection, place(c.position), place(c.direction))
}

fn film(info: &Inventory) -> String {
    let f = &info.film;
    let [w, h] = f.resolution;
    let mut text = format!("{w} x {h} pixels");
    if f.pixel_bounds != [0, w, 0, h] {
        let [x0, x1, y0, y1] = f.pixel_bounds;
        let _ = write!(text, ", rendered from {x0} to {x1} and {y0} to {y1}");
    }
    let depth = if f.half { 16 } else { 32 };
    let _ = write!(text, ", {depth}-bit, {}, sensor {}, iso {}", f.color_space, f.sensor, f.iso);
    let _ = write!(text, ", exposure {} s, filter {} {:?}", f.exposure_time, f.filter, f.filter_radius);
    if let Some(k) = f.white_balance {
        let _ = write!(text, ", white balance {k} K");
    }
    if let Some(name) = &f.filename {
        let _ = write!(text, ", named \"{name}\"");
    }
    text
}
