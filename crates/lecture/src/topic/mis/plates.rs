//! Slide 29: the plate scene of Veach and Guibas.

use sparrow_math::{Vec3, vec3};
use sparrow_mis::{Heuristic, Mis};
use sparrow_plot::draw::table::Table;
use sparrow_scene::SamplerName;

use crate::{Check, Figure, Formula, LectureError, Photo, Picture, Studio};

const SCENE: &str = "veach-mis.pbrt";
/// Name, label and weights of each picture.
const WAYS: [(&str, &str, Mis); 6] = [
    ("light-only", "(a) light sampling", Mis::LightOnly),
    ("bsdf-only", "(b) BSDF sampling", Mis::BsdfOnly),
    ("balance", "(c) balance heuristic", Mis::Both(Heuristic::Balance)),
    ("power", "power heuristic", Mis::Both(Heuristic::Power(2.0))),
    ("maximum", "maximum heuristic", Mis::Both(Heuristic::Maximum)),
    ("optimal", "optimal weights", Mis::Optimal),
];
/// Near and far edge of each plate, y and z, from the smoothest to the roughest, as the scene has them.
const EDGES: [[[f64; 2]; 2]; 4] = [
    [[-2.70651, 0.25609], [-2.08375, -0.526323]],
    [[-3.28825, 1.36972], [-2.83856, 0.476536]],
    [[-3.73096, 2.70046], [-3.43378, 1.74564]],
    [[-3.99615, 4.0667], [-3.82069, 3.08221]],
];
/// Places of the lamps along x, the smallest first.
const LAMPS: [f64; 4] = [-3.75, -1.25, 1.25, 3.75];

/// Plate and lamp of a view: the plate that it meets, and the lamp that its mirrored view comes nearest to.
fn highlight(o: Vec3<f64>, d: Vec3<f64>) -> Option<[usize; 2]> {
    let (plate, p, n) = EDGES.iter().enumerate().find_map(|(j, [near, far])| {
        let along = vec3(0.0, far[0] - near[0], far[1] - near[1]);
        let n = vec3(0.0, -along.z, along.y).normalized();
        let corner = vec3(0.0, near[0], near[1]);
        let p = o + d * ((corner - o).dot(n) / d.dot(n));
        let t = (p - corner).dot(along) / along.dot(along);
        ((0.0..=1.0).contains(&t) && p.x.abs() <= 4.0).then_some((j, p, n))
    })?;
    let mirrored = d - n * (2.0 * d.dot(n));
    let cos = |x: f64| (vec3(x, 0.0, 0.0) - p).normalized().dot(mirrored);
    let lamp = (0..4).max_by(|a, b| cos(LAMPS[*a]).total_cmp(&cos(LAMPS[*b])))?;
    Some([plate, lamp])
}

/// Mean squared error of green over the square of the mean, of each highlight: pictures are unbiased, so that it is the mean variance.
fn errors(photo: &Photo) -> [[f64; 4]; 4] {
    let mut sums = [[[0.0; 3]; 4]; 4];
    for (i, (rgb, variance)) in photo.rgb.iter().zip(&photo.variance).enumerate() {
        let (x, y) = (i % photo.size[0], i / photo.size[0]);
        let ray = photo.camera.ray([x as f32 + 0.5, y as f32 + 0.5], [0.5; 2], 0.0);
        let Some([plate, lamp]) = highlight(ray.o.to_f64(), ray.d.to_f64()) else { continue };
        let cell = &mut sums[plate][lamp];
        for (sum, v) in cell.iter_mut().zip([f64::from(variance[1]), f64::from(rgb[1]), 1.0]) {
            *sum += v;
        }
    }
    sums.map(|row| row.map(|[v, l, n]| v * n / (l * l)))
}

/// Slide 29.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let size = studio.pick([120, 80], [480, 320]);
    // Samples for errors, and few for the pictures, whose noise is to be seen.
    let spp = studio.pick(64, 128);
    let mut table =
        Table::new(["plate", "lamp", "light_only", "bsdf_only", "balance", "power", "maximum", "optimal"]);
    let (mut pictures, mut all) = (Vec::new(), Vec::new());
    for (id, label, mis) in WAYS {
        // Equal totals: a pair of both techniques counts twice.
        let pairs = if matches!(mis, Mis::LightOnly | Mis::BsdfOnly) { 1 } else { 2 };
        let take = |spp: u32| {
            let mut desc = studio.open(SCENE)?;
            desc.integrator.mis = mis;
            desc.sampler.name = SamplerName::Independent;
            studio.take(desc, size, spp)
        };
        all.push(errors(&take(spp / pairs)?));
        let photo = take(16 / pairs)?;
        let alt =
            format!("Four plates that mirror four lamps, by {label}: grainy where the technique fails.");
        pictures.push(
            Picture::png(id, alt, photo.png(1.0)?)
                .labelled(format!("{label}, {} samples a pixel", 16 / pairs)),
        );
    }
    let (mut worst, mut steps) = (0.0_f64, 0.0_f64);
    for (plate, lamp) in (0..4).flat_map(|p| (0..4).map(move |l| (p, l))) {
        let row: Vec<f64> = all.iter().map(|e| e[plate][lamp]).collect();
        worst = worst.max(row[2] / row[0].min(row[1]));
        steps = steps.max(row[5] / row[2]);
        table.numbers([plate as f64 + 1.0, lamp as f64 + 1.0].into_iter().chain(row));
    }
    let corner = |k: usize, plate: usize, lamp: usize| all[k][plate][lamp];
    let figure = Figure {
        caption: "Four lamps of equal power over four plates of growing roughness. (a) Light sampling fails for large lamps in smooth plates, (b) BSDF sampling for small lamps in rough plates, \
            (c) their combination nowhere. Equal numbers of rays to lamps in all pictures.\nThe table has the mean squared error of each of the sixteen highlights over its squared mean, at equal totals; \
            plate 1 is the smoothest, lamp 1 the smallest. Radii and colours of the original are not known; this is the classroom version of the scene."
            .to_owned(),
        formulas: vec![
            Formula::new("w_i = frac{p_i}{p_1 + p_2}", "[VeachGuibas1995]", "mis/src/heuristic.rs: weight"),
            Formula::new("F = B - c Z", "[Kondapaneni2019]", "mis/src/pair.rs: slope"),
        ],
        commands: WAYS.iter().map(|(id, ..)| format!("sparrow render scenes/{SCENE} --spp 8 --resolution 480x320 --mis {id}")).collect(),
        pictures,
        table: Some(table),
        checks: vec![
            Check::at_most("largest ratio, over all highlights, of the error by balance to that by the better technique", worst, 3.0),
            Check::at_least("largest lamp, smoothest plate: error by light sampling over that by BSDF sampling", corner(0, 0, 3) / corner(1, 0, 3), 100.0),
            Check::at_least("smallest lamp, roughest plate: error by BSDF sampling over that by light sampling", corner(1, 3, 0) / corner(0, 3, 0), 20.0),
            Check::at_most("largest ratio of the error by optimal weights to that by balance", steps, 1.25),
        ],
        ..Figure::default()
    };
    Ok(figure.with("samples of one technique", spp).with("pairs of both", spp / 2))
}
