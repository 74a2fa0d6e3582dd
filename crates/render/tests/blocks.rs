//! Paths side by side and the loop that is the reference give the same bits, ray counts included.

mod common;

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use sparrow_render::film::Film;
use sparrow_render::{RayCounts, RenderOptions, RenderPlan, compile, render, render_strategies};
use sparrow_scene::{ColourMode, IntegratorName, RouletteName, SceneDesc};

/// All of a film that a picture is made of.
type Bits = Vec<([u64; 3], [u64; 3], u64, u64)>;

fn bits(film: &Film) -> Bits {
    let places = (0..film.height()).flat_map(|y| (0..film.width()).map(move |x| (x, y)));
    let pixel = |(x, y)| {
        let p = film.pixel(x, y);
        (p.rgb.map(f64::to_bits), p.variance.map(f64::to_bits), p.weight.to_bits(), p.n)
    };
    places.map(pixel).collect()
}

const OPTIONS: RenderOptions = RenderOptions { threads: 2, variance: true, time_limit: None };

/// The picture and the rays it took, in blocks and one by one.
fn both(desc: SceneDesc) -> [(Bits, RayCounts); 2] {
    let mut plan = RenderPlan::new(&desc).expect("a plan");
    let compiled = compile(desc).expect("a scene");
    [false, true].map(|one_by_one| {
        plan.one_by_one = one_by_one;
        let (film, stats) =
            render(&compiled.scene, &plan, &OPTIONS, &AtomicBool::new(false), &|_| ()).expect("a picture");
        assert_eq!(film.rejected(), 0);
        (bits(&film), stats.rays)
    })
}

#[track_caller]
fn agree(desc: SceneDesc, what: &str) {
    let [block, reference] = both(desc);
    let differ = block.0.iter().zip(&reference.0).filter(|(a, b)| a != b).count();
    assert_eq!(differ, 0, "{what}: {differ} of {} pixels differ", block.0.len());
    assert_eq!(block.1, reference.1, "{what}: rays");
    assert!(block.0.iter().any(|p| p.0 != [0; 3]), "{what}: the picture is black");
}

/// The scenes of the repository.
fn scenes() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut folders = vec![root];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder").flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "pbrt") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// A scene with few pixels and samples.
fn small(path: &Path) -> SceneDesc {
    let mut desc = sparrow_scene::read(path).expect("a scene");
    let [w, h] = desc.film.resolution.map(f64::from);
    let scale = f64::sqrt(1500.0 / (w * h));
    desc.film.resolution = [w, h].map(|s| ((s * scale) as u32).max(8));
    desc.film.pixel_bounds = [0, desc.film.resolution[0], 0, desc.film.resolution[1]];
    desc.sampler.samples_per_pixel = 5;
    desc
}

#[test]
fn every_scene_of_the_repository_gives_the_same_bits() {
    let scenes = scenes();
    assert!(scenes.len() > 10, "{scenes:?}");
    for path in scenes {
        agree(small(&path), &path.display().to_string());
    }
}

/// What the scenes of the repository lack: see-through surfaces, cut-outs, dispersion, motion, fibres, all kinds of light.
const EVERYTHING: &str = r#"
    Film "rgb" "integer xresolution" 48 "integer yresolution" 40
    Sampler "zsobol" "integer pixelsamples" 7
    Integrator "path" "integer maxdepth" 9 "bool regularize" REGULARIZE
    LookAt 0 1 4  0 0.8 0  0 1 0
    Camera "perspective" "float fov" 42 "float lensradius" 0.02 "float focaldistance" 4
    WorldBegin
    LightSource "infinite" "rgb L" [ 0.2 0.25 0.3 ]
    LightSource "point" "rgb I" [ 1 2 3 ] "point3 from" [ -2 3 1 ]
    LightSource "distant" "rgb L" [ 0.3 0.2 0.1 ] "point3 from" [ 1 3 2 ]
    LightSource "spot" "rgb I" [ 9 8 7 ] "point3 from" [ 0 4 0 ] "point3 to" [ 0 0 0 ]
    AttributeBegin
      AreaLightSource "diffuse" "rgb L" [ 8 7 6 ]
      Material "interface"
      Translate 1 2.5 1
      Shape "sphere" "float radius" 0.3
    AttributeEnd
    Texture "checks" "spectrum" "checkerboard" "float uscale" 8 "float vscale" 8
      "rgb tex1" [ 0.9 0.6 0.1 ] "rgb tex2" [ 0.1 0.2 0.5 ]
    Texture "holes" "float" "checkerboard" "float uscale" 6 "float vscale" 6 "float tex1" 0.2 "float tex2" 1
    Material "diffuse" "texture reflectance" "checks"
    Shape "bilinearmesh" "point3 P" [ -5 0 -5  5 0 -5  -5 0 5  5 0 5 ]
    Material "conductor" "float uroughness" 0.3 "float vroughness" 0.05
    AttributeBegin Translate -1.6 0.7 0 Shape "sphere" "float radius" 0.6 AttributeEnd
    Material "dielectric" "spectrum eta" "glass-SF11"
    AttributeBegin Translate 0.2 0.6 0.4 Shape "sphere" "float radius" 0.5 AttributeEnd
    Material "dielectric" "float roughness" 0.15
    AttributeBegin Translate 1.3 0.6 0.4 Shape "sphere" "float radius" 0.4 "float alpha" 0.7 AttributeEnd
    Material "coateddiffuse" "rgb reflectance" [ 0.2 0.5 0.3 ]
    AttributeBegin
      ActiveTransform EndTime Translate 0 0.4 0 ActiveTransform All
      Translate -0.5 1.6 -0.5 Shape "sphere" "float radius" 0.3 "texture alpha" "holes"
    AttributeEnd
    Material "hair" "rgb sigma_a" [ 0.3 0.6 1.2 ]
    Shape "curve" "point3 P" [ -0.8 0 1  -0.7 0.4 1.2  -0.4 0.8 1  -0.6 1.2 1.1 ] "float width" 0.1
    Material "diffusetransmission"
    AttributeBegin Translate 0.4 1.6 -1 Shape "disk" "float radius" 0.5 AttributeEnd
"#;

fn everything(regularize: bool) -> SceneDesc {
    common::describe(&EVERYTHING.replace("REGULARIZE", if regularize { "true" } else { "false" }))
}

#[test]
fn all_kinds_of_matter_and_light_agree() {
    agree(everything(false), "plain");
    agree(everything(true), "regularized");
    let mut direct = everything(false);
    direct.integrator.name = IntegratorName::DirectLighting;
    agree(direct, "direct lighting");
}

/// A room with lamps of every form, balls first: each form has its lanes.
fn lamps(others: &str, n_balls: usize, depth: u32) -> SceneDesc {
    let emission = ["rgb L\" [ 9 7 5 ]", "blackbody L\" [ 3000 ] \"float scale\" 2", "rgb L\" [ 2 4 9 ]"];
    let ball = |i: usize| {
        let (x, y, side) = (i % 5, i / 5, if i % 4 == 3 { "true" } else { "false" });
        let turned = if i % 6 == 5 { "ReverseOrientation" } else { "" };
        format!(
            "AttributeBegin AreaLightSource \"diffuse\" \"{} \"bool twosided\" {side} {turned} Translate {} {} {} \
             Shape \"sphere\" \"float radius\" {} AttributeEnd\n",
            emission[i % 3],
            0.5 * x as f64 - 1.0,
            1.2 + 0.4 * y as f64,
            0.3 * y as f64 - 0.5,
            [0.02, 0.1, 0.2][i % 3],
        )
    };
    let balls: String = (0..n_balls).map(ball).collect();
    common::describe(&format!(
        "Film \"rgb\" \"integer xresolution\" 40 \"integer yresolution\" 32
         Sampler \"zsobol\" \"integer pixelsamples\" 6
         Integrator \"path\" \"integer maxdepth\" {depth}
         LookAt 0 1 4  0 0.8 0  0 1 0
         Camera \"perspective\" \"float fov\" 50
         WorldBegin
         {balls}{others}
         Material \"diffuse\" \"rgb reflectance\" [ 0.5 0.4 0.3 ]
         Shape \"bilinearmesh\" \"point3 P\" [ -5 0 -5  5 0 -5  -5 0 5  5 0 5 ]
         Shape \"bilinearmesh\" \"point3 P\" [ -5 0 -2  5 0 -2  -5 5 -2  5 5 -2 ]
         Material \"conductor\" \"float roughness\" 0.1
         AttributeBegin Translate 0 0.5 0.5 Shape \"sphere\" \"float radius\" 0.5 AttributeEnd"
    ))
}

/// All that shines, but for balls.
const OTHER_LAMPS: &str = r#"
    LightSource "point" "rgb I" [ 1 2 3 ] "point3 from" [ -2 3 1 ]
    AttributeBegin
      AreaLightSource "diffuse" "rgb L" [ 3 3 2 ]
      Shape "bilinearmesh" "point3 P" [ -1 3 -1  1 3 -1  -1 3 1  1 3 1 ]
      Shape "disk" "float height" 2 "float radius" 0.2
      Shape "trianglemesh" "point3 P" [ -3 1 0  -3 2 0  -3 1 1 ]
    AttributeEnd
"#;

#[test]
fn lamps_of_all_forms_agree() {
    for (others, n_balls) in [("", 5), (OTHER_LAMPS, 7), (OTHER_LAMPS, 20), ("", 14)] {
        for depth in [0, 1, 3] {
            let mut desc = lamps(others, n_balls, depth);
            agree(desc.clone(), &format!("{n_balls} balls, depth {depth}"));
            desc.film.colour = ColourMode::Rgb;
            agree(desc, &format!("{n_balls} balls, depth {depth}, in RGB"));
        }
    }
    let mut direct = lamps(OTHER_LAMPS, 7, 4);
    direct.integrator.name = IntegratorName::DirectLighting;
    agree(direct, "direct lighting");
}

#[test]
fn every_heuristic_agrees() {
    for mis in sparrow_mis::Mis::EXAMPLES {
        for splits in [1, 3] {
            let mut desc = everything(false);
            desc.integrator.mis = mis.parse().expect("a heuristic");
            desc.integrator.splits = Some(splits);
            agree(desc, &format!("{mis}, {splits} ways on"));
        }
    }
}

#[test]
fn every_roulette_agrees() {
    for roulette in [RouletteName::Throughput, RouletteName::Efficiency] {
        let mut desc = everything(false);
        desc.integrator.roulette = roulette;
        agree(desc, &format!("{roulette:?}"));
    }
}

#[test]
fn every_sampler_agrees() {
    for sampler in ["independent", "stratified", "halton", "sobol", "paddedsobol", "zsobol", "pmj02bn"] {
        let statement = match sampler {
            "stratified" => r#""stratified" "integer xsamples" 3 "integer ysamples" 2"#.to_owned(),
            other => format!(r#""{other}" "integer pixelsamples" 7"#),
        };
        let text = EVERYTHING.replace(r#""zsobol" "integer pixelsamples" 7"#, &statement);
        let text = text.replace("REGULARIZE", "false");
        agree(common::describe(&text), sampler);
    }
}

#[test]
fn the_light_of_each_technique_agrees() {
    for mis in ["power", "one-sample"] {
        let mut desc = everything(false);
        desc.integrator.mis = mis.parse().expect("a heuristic");
        let mut plan = RenderPlan::new(&desc).expect("a plan");
        let compiled = compile(desc).expect("a scene");
        let [block, reference] = [false, true].map(|one_by_one| {
            plan.one_by_one = one_by_one;
            let stop = AtomicBool::new(false);
            let (film, parts, _) =
                render_strategies(&compiled.scene, &plan, &OPTIONS, &stop, &|_| ()).expect("a picture");
            let [l, b] = [&parts.light, &parts.bsdf];
            [&film, &parts.seen, &l.unweighted, &l.weighted, &b.unweighted, &b.weighted].map(bits)
        });
        assert_eq!(block, reference, "{mis}");
    }
}
