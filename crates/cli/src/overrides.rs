//! What the command line changes in a scene, before anything is built from it.

use sparrow_scene::{ColourMode, IntegratorName, LightSamplerName, SamplerName, SceneDesc};

use crate::args::{Colour, Crop, Integrator, LightSampler, MAX_SPP, RenderArgs};

/// Applies the options to the description.
pub(crate) fn apply(args: &RenderArgs, desc: &mut SceneDesc) {
    if let Some(resolution) = args.resolution {
        resize(desc, resolution);
    }
    if let Some(crop) = args.crop {
        desc.film.pixel_bounds = bounds_of(crop, desc.film.resolution);
    }
    // Time or noise alone means: as many samples as it takes.
    let endless = args.time.is_some() || args.noise.is_some();
    if let Some(spp) = args.spp.or(endless.then_some(MAX_SPP)) {
        set_samples(desc, spp);
    }
    if let Some(seed) = args.seed {
        desc.seed = seed;
        desc.sampler.seed = None;
    }
    match args.colour {
        Some(Colour::Spectral) => desc.film.colour = ColourMode::Spectral,
        Some(Colour::Rgb) => desc.film.colour = ColourMode::Rgb,
        None => {}
    }
    let integrator = &mut desc.integrator;
    match args.integrator {
        Some(Integrator::Path) => integrator.name = IntegratorName::Path,
        Some(Integrator::Reference) => integrator.name = IntegratorName::Reference,
        Some(Integrator::Directlighting) => integrator.name = IntegratorName::DirectLighting,
        None => {}
    }
    match args.lightsampler {
        Some(LightSampler::Uniform) => integrator.light_sampler = LightSamplerName::Uniform,
        Some(LightSampler::Power) => integrator.light_sampler = LightSamplerName::Power,
        Some(LightSampler::Bvh) => integrator.light_sampler = LightSamplerName::Bvh,
        None => {}
    }
    integrator.max_depth = args.max_depth.unwrap_or(integrator.max_depth);
    if let Some(splits) = args.splits {
        integrator.splits = (splits > 0).then_some(splits);
    }
    if let Some(mis) = args.mis {
        integrator.mis = mis;
    }
    if let Some(switch) = args.mis_compensation {
        integrator.mis_compensation = switch.is_on();
    }
    if let Some(switch) = args.half {
        desc.film.save_fp16 = switch.is_on();
    }
}

fn set_samples(desc: &mut SceneDesc, spp: u32) {
    let sampler = &mut desc.sampler;
    sampler.samples_per_pixel = spp;
    if sampler.name == SamplerName::Stratified {
        sampler.strata = strata(spp);
    }
}

/// The stratified sampler has as many samples as strata; the rectangle nearest to a square is taken, as pbrt-v4 does.
pub(crate) fn strata(spp: u32) -> [u32; 2] {
    let short = (1..=spp.isqrt()).rev().find(|d| spp.is_multiple_of(*d)).unwrap_or(1);
    [spp / short, short]
}

/// Another size of the whole picture; the part that is rendered keeps its place in it.
fn resize(desc: &mut SceneDesc, resolution: [u32; 2]) {
    let film = &mut desc.film;
    let [x0, x1, y0, y1] = film.pixel_bounds;
    let side = |lo: u32, hi: u32, axis: usize| {
        let (old, new) = (u64::from(film.resolution[axis].max(1)), u64::from(resolution[axis]));
        // To the nearest pixel, so that parts that met before still meet.
        let place = |v: u32| ((2 * u64::from(v) * new + old) / (2 * old)).min(new) as u32;
        at_least_one(place(lo), place(hi), resolution[axis])
    };
    let ([x0, x1], [y0, y1]) = (side(x0, x1, 0), side(y0, y1, 1));
    film.pixel_bounds = [x0, x1, y0, y1];
    film.resolution = resolution;
}

/// Pixels of a crop window. [pbrt-v4, film.cpp: both ends are rounded up, in single precision]
fn bounds_of(Crop(crop): Crop, resolution: [u32; 2]) -> [u32; 4] {
    let place = |v: f32, axis: usize| ((resolution[axis] as f32 * v).ceil() as u32).min(resolution[axis]);
    let [x0, x1] = at_least_one(place(crop[0], 0), place(crop[1], 0), resolution[0]);
    let [y0, y1] = at_least_one(place(crop[2], 1), place(crop[3], 1), resolution[1]);
    [x0, x1, y0, y1]
}

/// A part thinner than a pixel becomes the pixel it begins in.
fn at_least_one(lo: u32, hi: u32, n: u32) -> [u32; 2] {
    let lo = lo.min(n.saturating_sub(1));
    [lo, hi.max(lo + 1)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{Cli, Verb};
    use clap::Parser;
    use std::path::Path;

    /// The description of a scene with this film and sampler, after these options.
    fn after(statements: &str, options: &str) -> SceneDesc {
        let text = format!("{statements}\nWorldBegin\n");
        let mut desc = sparrow_scene::read_str(&text, "test.pbrt", Path::new(".")).unwrap();
        let words = ["sparrow", "render", "test.pbrt"].into_iter().chain(options.split_whitespace());
        let Some(Verb::Render(args)) = Cli::try_parse_from(words).unwrap().verb else { panic!("no render") };
        apply(&args, &mut desc);
        desc
    }

    #[test]
    fn crops_tile_the_picture() {
        let res = [101, 7];
        let left = bounds_of(Crop([0.0, 0.3, 0.0, 1.0]), res);
        let right = bounds_of(Crop([0.3, 1.0, 0.0, 1.0]), res);
        assert_eq!(left, [0, 31, 0, 7]);
        assert_eq!(right, [31, 101, 0, 7]);
        assert_eq!(bounds_of(Crop([0.501, 0.502, 0.999, 1.0]), res), [51, 52, 6, 7], "never empty");
    }

    #[test]
    fn a_crop_keeps_its_place_in_another_resolution() {
        let film = "Film \"rgb\" \"integer xresolution\" 100 \"integer yresolution\" 50 \"integer pixelbounds\" [25 75 0 25]";
        let film_of = |options| after(film, options).film;
        assert_eq!(film_of("").pixel_bounds, [25, 75, 0, 25]);
        let half = film_of("--resolution 50x25");
        assert_eq!((half.resolution, half.pixel_bounds), ([50, 25], [13, 38, 0, 13]));
        assert_eq!(film_of("--resolution 200x100").pixel_bounds, [50, 150, 0, 50]);
        assert_eq!(film_of("--resolution 1x1").pixel_bounds, [0, 1, 0, 1]);
        assert_eq!(film_of("--resolution 40x40 --crop 0,0.5,0.5,1").pixel_bounds, [0, 20, 20, 40]);
    }

    #[test]
    fn options_win_over_the_scene() {
        let scene = "Sampler \"stratified\" \"integer xsamples\" 3 \"integer ysamples\" 3 \"integer seed\" 5\n\
                     Integrator \"path\" \"integer maxdepth\" 9 \"string lightsampler\" \"uniform\" \"bool samplelights\" false \"integer splits\" 4";
        let untouched = after(scene, "");
        assert_eq!((untouched.sampler.strata, untouched.sampler.seed), ([3, 3], Some(5)));
        assert_eq!((untouched.integrator.max_depth, untouched.integrator.splits), (9, Some(4)));
        assert_eq!([0, 3].map(|n| after(scene, &format!("--splits {n}")).integrator.splits), [None, Some(3)]);
        let desc = after(
            scene,
            "--spp 24 --seed 7 --colour rgb --max-depth 0 --integrator directlighting --mis power:1.5 --lightsampler power \
             --mis-compensation off --half=off",
        );
        assert_eq!((desc.sampler.strata, desc.sampler.samples_per_pixel), ([6, 4], 24));
        assert_eq!((desc.seed, desc.sampler.seed), (7, None));
        let i = &desc.integrator;
        assert_eq!(
            (i.max_depth, i.name, i.mis.to_string().as_str()),
            (0, IntegratorName::DirectLighting, "power:1.5")
        );
        assert_eq!((i.light_sampler, i.mis_compensation), (LightSamplerName::Power, false));
        assert!(!desc.film.save_fp16);
        assert_eq!((untouched.film.colour, desc.film.colour), (ColourMode::Spectral, ColourMode::Rgb));
        assert_eq!(after(scene, "--time 1").sampler.samples_per_pixel, MAX_SPP);
        assert_eq!(after(scene, "--noise 0.1").sampler.samples_per_pixel, MAX_SPP);
        assert_eq!(after(scene, "--time 1 --spp 4").sampler.samples_per_pixel, 4);
        assert!(after(scene, "--half").film.save_fp16);
    }
}
