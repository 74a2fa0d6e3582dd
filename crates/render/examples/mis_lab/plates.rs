//! The plate scene (`scenes/veach-mis.pbrt`): the error in each of its sixteen highlights.

use std::path::Path;
use std::sync::atomic::AtomicBool;

use sparrow_math::{Vec3, vec3};
use sparrow_mis::{Heuristic, Mis};
use sparrow_render::{RenderOptions, RenderPlan, Scene, compile, render};
use sparrow_scene::{SamplerName, SceneDesc};

/// Upper edges of the plates, y and z, from the smoothest to the roughest, and the lower ones.
pub const EDGES: [[[f32; 2]; 2]; 4] = [
    [[-2.70651, 0.25609], [-2.08375, -0.526323]],
    [[-3.28825, 1.36972], [-2.83856, 0.476536]],
    [[-3.73096, 2.70046], [-3.43378, 1.74564]],
    [[-3.99615, 4.0667], [-3.82069, 3.08221]],
];
/// Places of the lamps along x, the smallest first.
pub const LAMPS: [f32; 4] = [-3.75, -1.25, 1.25, 3.75];
/// Ways to join the techniques.
pub const WAYS: [(&str, Mis); 7] = [
    ("light-only", Mis::LightOnly),
    ("bsdf-only", Mis::BsdfOnly),
    ("balance", Mis::Both(Heuristic::Balance)),
    ("power", Mis::Both(Heuristic::Power(2.0))),
    ("maximum", Mis::Both(Heuristic::Maximum)),
    ("cutoff:0.1", Mis::Both(Heuristic::Cutoff(0.1))),
    ("optimal", Mis::Optimal),
];

/// The scene with independent samples, whose scatter is their error.
///
/// # Errors
/// Where the scene cannot be read.
pub fn description(scenes: &Path, resolution: [u32; 2]) -> Result<SceneDesc, String> {
    let mut desc =
        sparrow_scene::read_with_materials(&scenes.join("veach-mis.pbrt"), &[]).map_err(|e| e.to_string())?;
    desc.film.resolution = resolution;
    desc.film.pixel_bounds = [0, resolution[0], 0, resolution[1]];
    desc.sampler.name = SamplerName::Independent;
    Ok(desc)
}

/// The plate on which a point lies, and its normal.
fn plate_of(p: Vec3<f32>) -> Option<(usize, Vec3<f32>)> {
    EDGES.iter().enumerate().find_map(|(j, [near, far])| {
        let along = vec3(0.0, far[0] - near[0], far[1] - near[1]);
        let n = vec3(0.0, -along.z, along.y).normalized();
        let from = vec3(0.0, p.y - near[0], p.z - near[1]);
        let t = from.dot(along) / along.length2();
        ((0.0..=1.0).contains(&t) && from.dot(n).abs() < 1e-3).then_some((j, n))
    })
}

/// For each pixel the highlight that it belongs to: plate and the lamp that the mirrored view comes nearest to.
fn highlights(scene: &Scene, [w, h]: [u32; 2]) -> Vec<Option<[usize; 2]>> {
    let of = |x: u32, y: u32| {
        let ray = scene.camera().ray([x as f32 + 0.5, y as f32 + 0.5], [0.5; 2], 0.0);
        let p = scene.intersect(&ray)?.p;
        let (plate, n) = plate_of(p)?;
        let mirrored = ray.d - n * (2.0 * ray.d.dot(n));
        let cos = |x: f32| (vec3(x, 0.0, 0.0) - p).normalized().dot(mirrored);
        let lamp = (0..4).max_by(|a, b| cos(LAMPS[*a]).total_cmp(&cos(LAMPS[*b])))?;
        Some([plate, lamp])
    };
    (0..h).flat_map(|y| (0..w).map(move |x| (x, y))).map(|(x, y)| of(x, y)).collect()
}

/// Relative error of green in each highlight, `[plate][lamp]`: root of the mean variance over the mean.
///
/// Both techniques together take `samples` samples a pixel, one alone as many.
///
/// # Errors
/// Where the scene cannot be read or rendered.
pub fn errors(scenes: &Path, resolution: [u32; 2], mis: Mis, samples: u32) -> Result<[[f64; 4]; 4], String> {
    let mut desc = description(scenes, resolution)?;
    desc.integrator.mis = mis;
    let alone = matches!(mis, Mis::LightOnly | Mis::BsdfOnly);
    desc.sampler.samples_per_pixel = if alone { samples } else { samples / 2 };
    let plan = RenderPlan::new(&desc).map_err(|e| e.join(", "))?;
    let scene = compile(desc).map_err(|e| e.to_string())?.scene;
    let options = RenderOptions { threads: 0, variance: true, time_limit: None };
    let (film, _) =
        render(&scene, &plan, &options, &AtomicBool::new(false), &|_| ()).map_err(|e| e.to_string())?;
    let mut sums = [[[0.0; 3]; 4]; 4];
    for (i, highlight) in highlights(&scene, resolution).into_iter().enumerate() {
        let Some([plate, lamp]) = highlight else { continue };
        let pixel = film.pixel(i as u32 % resolution[0], i as u32 / resolution[0]);
        let sum = &mut sums[plate][lamp];
        *sum = [sum[0] + pixel.rgb[1], sum[1] + pixel.variance[1], sum[2] + 1.0];
    }
    Ok(sums.map(|row| row.map(|[mean, variance, n]| (variance * n).sqrt() / mean)))
}
