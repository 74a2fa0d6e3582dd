//! What scenes mean: transforms, attributes, materials, defaults.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::float_cmp,
    reason = "tests stop where something is missing; the values are exact"
)]

use std::path::Path;

use sparrow_math::{Vec3, vec3};
use sparrow_models::{FibreKind, ModelKind, ParamKind, SurfaceKind};
use sparrow_scene::*;
use sparrow_spectra::ColorSpace;

fn scene(text: &str) -> SceneDesc {
    read_str(text, "t", Path::new("")).map_err(|e| e.to_string()).unwrap()
}

fn near(a: Vec3<f64>, b: [f64; 3]) -> bool {
    (a - vec3(b[0], b[1], b[2])).length() < 1e-12
}

fn origin(s: &SceneDesc, shape: usize) -> Vec3<f64> {
    s.shapes[shape].to_world.point(vec3(0.0, 0.0, 0.0))
}

#[test]
fn the_camera_stands_where_look_at_puts_it() {
    let s = scene("LookAt 0 0 5  0 0 0  0 1 0 Camera \"perspective\" WorldBegin");
    let t = s.camera.to_world;
    // Camera z looks ahead, which is -z of the world; y is up; left-handed, so that x points to world -x.
    assert!(near(t.point(vec3(0.0, 0.0, 0.0)), [0.0, 0.0, 5.0]));
    assert!(near(t.vector(vec3(0.0, 0.0, 1.0)), [0.0, 0.0, -1.0]));
    assert!(near(t.vector(vec3(0.0, 1.0, 0.0)), [0.0, 1.0, 0.0]));
    assert!(near(t.vector(vec3(1.0, 0.0, 0.0)), [-1.0, 0.0, 0.0]));
}

#[test]
fn scale_before_look_at_mirrors_the_picture() {
    let s = scene("Scale -1 1 1 LookAt 0 0 5  0 0 0  0 1 0 Camera \"perspective\" WorldBegin");
    assert!(near(s.camera.to_world.vector(vec3(1.0, 0.0, 0.0)), [1.0, 0.0, 0.0]));
    assert!(near(s.camera.to_world.point(vec3(0.0, 0.0, 0.0)), [0.0, 0.0, 5.0]));
}

#[test]
fn transforms_apply_from_the_last_to_the_first() {
    let s = scene("WorldBegin Translate 1 2 3 Scale 2 2 2 Rotate 90 0 0 1 Shape \"sphere\"");
    // Turned (1,0,0) -> (0,1,0), then doubled, then moved.
    assert!(near(s.shapes[0].to_world.point(vec3(1.0, 0.0, 0.0)), [1.0, 4.0, 3.0]));
}

#[test]
fn matrices_are_listed_by_columns() {
    let m = "[1 0 0 0  0 1 0 0  0 0 1 0  5 6 7 1]";
    let s = scene(&format!(
        "WorldBegin Translate 1 0 0 ConcatTransform {m} Shape \"sphere\" Transform {m} Shape \"sphere\""
    ));
    assert!(near(origin(&s, 0), [6.0, 6.0, 7.0]));
    assert!(near(origin(&s, 1), [5.0, 6.0, 7.0]), "Transform replaces what was there");
}

#[test]
fn world_begin_resets_the_transform_and_camera_space_has_a_name() {
    let s = scene(
        "Translate 0 0 -4 Camera \"perspective\" WorldBegin Shape \"sphere\" \
         AttributeBegin CoordSysTransform \"camera\" Shape \"sphere\" AttributeEnd \
         Translate 1 0 0 CoordinateSystem \"here\" Identity CoordSysTransform \"here\" Shape \"sphere\" \
         CoordSysTransform \"world\" Shape \"sphere\"",
    );
    // The world is moved by -4 to the camera, so the camera stands at +4.
    let places = [[0.0; 3], [0.0, 0.0, 4.0], [1.0, 0.0, 0.0], [0.0; 3]];
    for (i, place) in places.into_iter().enumerate() {
        assert!(near(origin(&s, i), place), "{i}: {:?}", origin(&s, i));
    }
}

#[test]
fn attributes_are_saved_and_brought_back() {
    let s = scene(
        "WorldBegin Material \"conductor\" AttributeBegin ReverseOrientation Material \"interface\" \
         Translate 1 0 0 AreaLightSource \"diffuse\" Material \"diffuse\" Shape \"sphere\" AttributeEnd Shape \"sphere\"",
    );
    let [a, b] = [&s.shapes[0], &s.shapes[1]];
    assert!(a.reverse_orientation && !b.reverse_orientation);
    assert!(a.area_light.is_some() && b.area_light.is_none());
    assert!(near(origin(&s, 1), [0.0; 3]));
    let model = |shape: &ShapeDesc| s.materials[shape.material.0 as usize].model;
    assert_eq!(
        (model(a), model(b)),
        (Some(SurfaceKind::Lambert.into()), Some(SurfaceKind::Conductor.into()))
    );
}

#[test]
fn attribute_gives_defaults_that_a_shape_overrides() {
    let s = scene(
        "WorldBegin AttributeBegin Attribute \"shape\" \"float radius\" 3 Attribute \"shape\" \"float radius\" 4 \
         Shape \"sphere\" Shape \"sphere\" \"float radius\" 5 AttributeEnd Shape \"sphere\"",
    );
    let radius =
        |i: usize| if let ShapeKind::Sphere { radius, .. } = s.shapes[i].kind { radius } else { 0.0 };
    assert_eq!([radius(0), radius(1), radius(2)], [4.0, 5.0, 1.0]);
}

#[test]
fn objects_are_kept_apart_from_the_places_where_they_stand() {
    let s = scene(
        "WorldBegin ObjectBegin \"o\" Translate 0 1 0 Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \
         ObjectEnd Shape \"sphere\" ObjectBegin \"none\" ObjectEnd ObjectInstance \"none\" \
         Translate 10 0 0 ObjectInstance \"o\" Scale 2 2 2 ObjectInstance \"o\"",
    );
    assert_eq!((s.shapes.len(), s.prototypes.len()), (1, 2));
    assert_eq!((&*s.prototypes[0].name, s.prototypes[0].shapes.len()), ("o", 1));
    assert_eq!(
        s.instances.iter().map(|i| i.prototype.0).collect::<Vec<_>>(),
        [0, 0],
        "of nothing there is none"
    );
    let placed = |i: usize| {
        let p = s.prototypes[0].shapes[0].to_world.point(Default::default());
        s.instances[i].to_world.point(p).to_f32().to_array()
    };
    assert_eq!(placed(0), [10.0, 1.0, 0.0]);
    assert_eq!(placed(1), [10.0, 2.0, 0.0], "the instance's transform goes over the shape's");
}

#[test]
fn materials_may_be_named_before_they_are_made() {
    let s = scene(
        "WorldBegin NamedMaterial \"m\" Shape \"sphere\" Shape \"sphere\" \
         MakeNamedMaterial \"m\" \"string type\" \"dielectric\" \"float eta\" 1.3",
    );
    let m = &s.materials[s.shapes[1].material.0 as usize];
    assert_eq!((m.name.as_deref(), m.model), (Some("m"), Some(SurfaceKind::Dielectric.into())));
}

/// The constant that a parameter of a material holds.
fn constant(s: &SceneDesc, p: &RealParam) -> f32 {
    let (RealParam::Texture(id) | RealParam::RoughnessToAlpha(id)) = p else { return f32::NAN };
    if let FloatTexture::Constant(v) = s.float_textures[id.0 as usize] { v } else { f32::NAN }
}

fn real<'a>(m: &'a MaterialDesc, name: &str) -> &'a RealParam {
    let reals = m.model.unwrap().params().iter().filter(|p| p.kind == ParamKind::Real);
    &m.reals[reals.map(|p| p.name).position(|n| n == name).unwrap()]
}

fn spectral<'a>(m: &'a MaterialDesc, name: &str) -> &'a SpectrumParam {
    let spectra = m.model.unwrap().params().iter().filter(|p| p.kind != ParamKind::Real);
    &m.spectra[spectra.map(|p| p.name).position(|n| n == name).unwrap()]
}

fn spectrum<'a>(s: &'a SceneDesc, p: &SpectrumParam) -> &'a SpectrumDesc {
    let (SpectrumParam::Texture(id) | SpectrumParam::ReflectanceToK(id)) = p;
    let texture = &s.spectrum_textures[id.0 as usize];
    if let SpectrumTexture::Constant(d) = texture { d } else { panic!("{texture:?}") }
}

#[test]
fn conductors_are_copper_unless_told_otherwise() {
    let s = scene("WorldBegin Material \"conductor\" \"float roughness\" 0.25 \"float vroughness\" 0.5");
    let m = &s.materials[1];
    assert_eq!(spectrum(&s, spectral(m, "eta")), &SpectrumDesc::Named("metal-Cu-eta".into()));
    assert_eq!(spectrum(&s, spectral(m, "k")), &SpectrumDesc::Named("metal-Cu-k".into()));
    assert!(matches!(real(m, "alpha_x"), RealParam::RoughnessToAlpha(_)), "roughness is remapped");
    assert_eq!((constant(&s, real(m, "alpha_x")), constant(&s, real(m, "alpha_y"))), (0.25, 0.5));
}

#[test]
fn conductors_by_reflectance_have_the_index_one() {
    let s = scene(
        "WorldBegin Material \"conductor\" \"rgb reflectance\" [.1 .2 .3] \"bool remaproughness\" false",
    );
    let m = &s.materials[1];
    assert_eq!(spectrum(&s, spectral(m, "eta")), &SpectrumDesc::Constant(1.0));
    assert!(matches!(spectral(m, "k"), SpectrumParam::ReflectanceToK(_)));
    assert_eq!(spectrum(&s, spectral(m, "k")), &SpectrumDesc::Rgb([0.1, 0.2, 0.3], ColorSpace::Srgb));
    assert!(matches!(real(m, "alpha_x"), RealParam::Texture(_)));
}

#[test]
fn glass_disperses_only_by_a_spectrum_that_varies() {
    let eta = |param: &str| {
        let s = scene(&format!("WorldBegin Material \"dielectric\" {param}"));
        let p = real(&s.materials[1], "eta").clone();
        (constant(&s, &p), p)
    };
    assert_eq!(eta("").0, 1.5);
    assert_eq!(eta("\"float eta\" 1.7").0, 1.7);
    assert_eq!(eta("\"spectrum eta\" [360 1.2 830 1.2]").0, 1.2);
    let RealParam::Dispersive(glass) = eta("\"spectrum eta\" \"glass-BK7\"").1 else { panic!() };
    assert_eq!(glass, SpectrumDesc::Named("glass-BK7".into()));
    assert!(matches!(eta("\"spectrum eta\" [400 1.5 700 1.4]").1, RealParam::Dispersive(_)));
}

#[test]
fn diffuse_transmission_takes_a_scale() {
    let s = scene("WorldBegin Material \"diffusetransmission\" \"float scale\" 2");
    let m = &s.materials[1];
    assert_eq!(m.model, Some(SurfaceKind::DiffuseTransmission.into()));
    let SpectrumParam::Texture(id) = spectral(m, "reflectance") else { panic!() };
    let SpectrumTexture::Scale(tex, by) = s.spectrum_textures[id.0 as usize] else { panic!() };
    let (tex, by) = (&s.spectrum_textures[tex.0 as usize], &s.float_textures[by.0 as usize]);
    assert!(matches!(tex, SpectrumTexture::Constant(SpectrumDesc::Constant(v)) if *v == 0.25));
    assert!(matches!(by, FloatTexture::Constant(v) if *v == 2.0));
}

#[test]
fn every_model_of_the_registry_is_a_material_with_its_own_parameters() {
    for kind in ModelKind::all() {
        let text = format!("WorldBegin Material \"{}\" Shape \"sphere\"", kind.name());
        let s = scene(&text);
        let m = &s.materials[1];
        assert_eq!(m.model, Some(kind));
        let count = |of: fn(&ParamKind) -> bool| kind.params().iter().filter(|p| of(&p.kind)).count();
        let n_reals = count(|k| matches!(k, ParamKind::Real));
        let n_choices = count(|k| matches!(k, ParamKind::Choice(_)));
        let n_spectra = kind.params().len() - n_reals - n_choices;
        assert_eq!(
            (m.reals.len(), m.spectra.len(), m.choices.len()),
            (n_reals, n_spectra, n_choices),
            "{text}"
        );
    }
    let s = scene("WorldBegin Material \"thin_dielectric\" \"float eta\" 1.25");
    assert_eq!(constant(&s, real(&s.materials[1], "eta")), 1.25);
}

#[test]
fn hair_absorbs_as_pbrt_says() {
    let hair = |params: &str| scene(&format!("WorldBegin Material \"hair\" {params}"));
    // Eumelanin 1.3 unless something is said.
    let absorption = |s: &SceneDesc| {
        let m = &s.materials[1];
        assert_eq!(m.model, Some(FibreKind::Hair.into()));
        (rgb(s, m), m.choices[0])
    };
    let brown = [0.419, 0.697, 1.37].map(|v| (f64::from(1.3_f32) * v) as f32);
    assert_eq!(absorption(&hair("")), (Some(brown), 0));
    assert_eq!(absorption(&hair("\"float eumelanin\" 1.3")), (Some(brown), 0));
    let red = [0.187, 0.4, 1.05].map(|v: f64| v as f32);
    assert_eq!(absorption(&hair("\"float pheomelanin\" 1")), (Some(red), 0));
    assert_eq!(absorption(&hair("\"rgb sigma_a\" [1 2 3]")), (Some([1.0, 2.0, 3.0]), 0));
    assert_eq!(hair("\"rgb color\" [.1 .2 .3]").materials[1].choices[0], 1);
    assert_eq!(hair("\"rgb reflectance\" [.1 .2 .3]").materials[1].choices[0], 1);
}

/// The absorption of a hair, where it is an RGB.
fn rgb(s: &SceneDesc, m: &MaterialDesc) -> Option<[f32; 3]> {
    let SpectrumParam::Texture(id) = m.spectra.first()? else { return None };
    let SpectrumTexture::Constant(SpectrumDesc::Rgb(rgb, _)) = s.spectrum_textures.get(id.0 as usize)? else {
        return None;
    };
    Some(*rgb)
}

#[test]
fn stand_ins_keep_what_they_can() {
    let s = scene(
        "WorldBegin MakeNamedMaterial \"a\" \"string type\" \"interface\" \
         MakeNamedMaterial \"b\" \"string type\" \"dielectric\" \"float eta\" 1.25 \
         Material \"mix\" \"string materials\" [\"a\" \"b\"] Material \"measured\" \"string filename\" \"x\"",
    );
    let mix = &s.materials[3];
    assert_eq!((mix.type_name.as_str(), mix.model), ("mix", Some(SurfaceKind::Dielectric.into())));
    assert_eq!(constant(&s, real(mix, "eta")), 1.25);
    assert_eq!(spectrum(&s, spectral(&s.materials[4], "reflectance")), &SpectrumDesc::Constant(0.5));
}

#[test]
fn coated_materials_have_the_parameters_and_defaults_of_pbrt() {
    let s = scene(
        "WorldBegin Material \"coateddiffuse\" Material \"coatedconductor\" \
         Material \"coateddiffuse\" \"rgb reflectance\" [.1 .2 .3] \"float roughness\" 0.25 \"float thickness\" 2 \
         \"float eta\" 1.25 \"bool remaproughness\" false \
         Material \"coatedconductor\" \"float conductor.roughness\" 0.5 \"float interface.uroughness\" 0.25 \
         \"float interface.eta\" 1.75 \"spectrum conductor.k\" \"metal-Au-k\" \
         Material \"coatedconductor\" \"rgb reflectance\" [.1 .2 .3]",
    );
    let values = |m: usize, names: &[&str]| -> Vec<f32> {
        names.iter().map(|n| constant(&s, real(&s.materials[m], n))).collect()
    };
    assert_eq!(s.materials[1].model, Some(SurfaceKind::CoatedDiffuse.into()));
    let of_diffuse = ["alpha_x", "alpha_y", "eta", "thickness"];
    assert_eq!(values(1, &of_diffuse), [0.0, 0.0, 1.5, 0.01]);
    assert_eq!(spectrum(&s, spectral(&s.materials[1], "reflectance")), &SpectrumDesc::Constant(0.5));
    assert!(matches!(real(&s.materials[1], "alpha_x"), RealParam::RoughnessToAlpha(_)));

    assert_eq!(s.materials[2].model, Some(SurfaceKind::CoatedConductor.into()));
    let of_conductor = ["alpha_x", "alpha_y", "alpha_base_x", "alpha_base_y", "eta", "thickness"];
    assert_eq!(values(2, &of_conductor), [0.0, 0.0, 0.0, 0.0, 1.5, 0.01]);
    let k = |m: usize| spectrum(&s, spectral(&s.materials[m], "k_base"));
    assert_eq!(k(2), &SpectrumDesc::Named("metal-Cu-k".into()));

    assert_eq!(values(3, &of_diffuse), [0.25, 0.25, 1.25, 2.0]);
    assert!(matches!(real(&s.materials[3], "alpha_x"), RealParam::Texture(_)));
    let rgb = SpectrumDesc::Rgb([0.1, 0.2, 0.3], ColorSpace::Srgb);
    assert_eq!(spectrum(&s, spectral(&s.materials[3], "reflectance")), &rgb);

    assert_eq!(values(4, &of_conductor), [0.25, 0.0, 0.5, 0.5, 1.75, 0.01]);
    assert_eq!(k(4), &SpectrumDesc::Named("metal-Au-k".into()));
    assert!(matches!(spectral(&s.materials[5], "k_base"), SpectrumParam::ReflectanceToK(_)));
}

#[test]
fn an_empty_world_has_the_defaults_of_pbrt() {
    let s = scene("WorldBegin");
    assert_eq!(s.camera.projection, Projection::Perspective { fov: 90.0 });
    assert_eq!((s.camera.lens_radius, s.camera.focal_distance, s.camera.shutter), (0.0, 1e6, [0.0, 1.0]));
    assert_eq!((s.film.resolution, s.film.pixel_bounds), ([1280, 720], [0, 1280, 0, 720]));
    assert_eq!((s.film.iso, s.film.exposure_time, s.film.diagonal), (100.0, 1.0, 35.0));
    assert_eq!((s.film.sensor.as_str(), s.film.save_fp16, s.film.white_balance), ("cie1931", true, None));
    assert_eq!(s.film.max_component_value, f32::INFINITY);
    assert_eq!(s.filter, FilterDesc::Gaussian { radius: [1.5, 1.5], sigma: 0.5 });
    assert_eq!((s.sampler.name, s.sampler.samples_per_pixel), (SamplerName::ZSobol, 16));
    assert_eq!(s.sampler.randomize, RandomizeName::FastOwen);
    assert_eq!((s.integrator.name, s.integrator.max_depth), (IntegratorName::Path, 5));
    assert_eq!((s.integrator.light_sampler, s.integrator.regularize), (LightSamplerName::Bvh, false));
    assert_eq!((s.seed, s.materials.len(), s.materials[0].model), (0, 1, Some(SurfaceKind::Lambert.into())));
    assert_eq!(spectrum(&s, &s.materials[0].spectra[0]), &SpectrumDesc::Constant(0.5));
}

#[test]
fn film_windows_round_up_at_both_ends() {
    let bounds = |film: &str| scene(&format!("Film \"rgb\" {film} WorldBegin")).film.pixel_bounds;
    let size = "\"integer xresolution\" 10 \"integer yresolution\" 5";
    assert_eq!(bounds(&format!("{size} \"float cropwindow\" [.25 .75 0 .5]")), [3, 8, 0, 3]);
    assert_eq!(bounds(&format!("{size} \"float cropwindow\" [.75 .25 -1 7]")), [3, 8, 0, 5]);
    assert_eq!(bounds(&format!("{size} \"integer pixelbounds\" [2 20 1 4]")), [2, 10, 1, 4]);
}

#[test]
fn exposure_is_the_time_the_shutter_is_open() {
    let s = scene(
        "Film \"rgb\" Camera \"perspective\" \"float shutteropen\" 0.5 \"float shutterclose\" 0.75 WorldBegin",
    );
    assert_eq!((s.film.exposure_time, s.camera.shutter), (0.25, [0.5, 0.75]));
}

#[test]
fn samplers_have_their_own_defaults() {
    let sampler = |text: &str| scene(&format!("Sampler {text} WorldBegin")).sampler;
    assert_eq!(sampler("\"independent\"").samples_per_pixel, 4);
    let s = sampler("\"stratified\" \"integer xsamples\" 2 \"integer ysamples\" 3 \"bool jitter\" false");
    assert_eq!((s.samples_per_pixel, s.strata, s.jitter), (6, [2, 3], false));
    assert_eq!(sampler("\"halton\"").randomize, RandomizeName::PermuteDigits);
    assert_eq!(sampler("\"sobol\" \"integer seed\" 7").seed, Some(7));
}

#[test]
fn integrators_resolve_to_ours() {
    let integrator = |text: &str| scene(&format!("Integrator {text} WorldBegin")).integrator;
    assert_eq!(integrator("\"volpath\" \"integer maxdepth\" 9").max_depth, 9);
    let i = integrator("\"directlighting\" \"string mis\" \"power:1.5\" \"string lightsampler\" \"power\"");
    assert_eq!(
        (i.name, i.mis.to_string().as_str(), i.light_sampler),
        (IntegratorName::DirectLighting, "power:1.5", LightSamplerName::Power)
    );
    assert_eq!(integrator("\"reference\"").name, IntegratorName::Reference);
    let i = integrator("\"simplepath\" \"bool samplelights\" false");
    assert_eq!(i.mis.to_string(), "bsdf-only");
}

#[test]
fn lights_carry_the_numbers_of_the_file() {
    let s = scene(
        "ColorSpace \"rec2020\" WorldBegin Translate 1 0 0 LightSource \"point\" \"float scale\" 3 \"float power\" 60 \
         LightSource \"distant\" \"blackbody L\" 5000 \"float illuminance\" -1 LightSource \"infinite\" \
         LightSource \"spot\" \"rgb I\" [1 2 3] \"point3 from\" [1 1 1]",
    );
    let LightKind::Point { intensity, power, .. } = &s.lights[0].kind else { panic!() };
    assert_eq!((intensity.scale, *power), (3.0, Some(60.0)));
    assert_eq!(
        intensity.spectrum,
        SpectrumDesc::Rgb([1.0; 3], ColorSpace::Rec2020),
        "white of the colour space"
    );
    let LightKind::Distant { radiance, illuminance, from, to } = &s.lights[1].kind else { panic!() };
    assert_eq!((&radiance.spectrum, *illuminance), (&SpectrumDesc::Blackbody(5000.0), None));
    assert!(near(*from, [0.0; 3]) && near(*to, [0.0, 0.0, 1.0]));
    assert!(
        matches!(&s.lights[2].kind, LightKind::Infinite { radiance, illuminance: None } if radiance.scale == 1.0)
    );
    let LightKind::Spot { from, cone_angle, cone_delta, .. } = &s.lights[3].kind else { panic!() };
    assert!(near(*from, [1.0; 3]) && (*cone_angle, *cone_delta) == (30.0, 5.0));
    assert!(near(s.lights[0].to_world.point(Vec3::default()), [1.0, 0.0, 0.0]));
}

#[test]
fn a_portal_is_a_rectangle_in_world_space() {
    let s = scene(
        "WorldBegin Translate 5 0 0 LightSource \"infinite\" \"point3 portal\" [ 0 0 0  0 2 0  1 2 0  1 0 0 ] LightSource \"infinite\"",
    );
    let Some([p0, p1, p2, p3]) = s.lights[0].portal else { panic!() };
    assert!(
        near(p0, [0.0; 3])
            && near(p1, [0.0, 2.0, 0.0])
            && near(p2, [1.0, 2.0, 0.0])
            && near(p3, [1.0, 0.0, 0.0])
    );
    assert!(s.lights[1].portal.is_none());
}

#[test]
fn area_lights_are_shared_by_the_shapes_behind_them() {
    let s = scene(
        "WorldBegin AreaLightSource \"diffuse\" \"rgb L\" [1 2 3] \"bool twosided\" \"true\" Shape \"sphere\" \
         Shape \"disk\" AreaLightSource \"\" Shape \"sphere\"",
    );
    assert_eq!(s.area_lights.len(), 1);
    assert!(s.area_lights[0].two_sided);
    let lights: Vec<_> = s.shapes.iter().map(|s| s.area_light).collect();
    assert_eq!(lights, [Some(AreaLightId(0)), Some(AreaLightId(0)), None]);
}

#[test]
fn textures_refer_to_textures_before_them() {
    let s = scene(
        "WorldBegin Scale 2 2 2 Texture \"f\" \"float\" \"constant\" \"float value\" 0.3 \
         Texture \"s\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [1 0 0] \"float uscale\" 4 \"string mapping\" \"planar\" \
         \"vector3 v1\" [0 0 1] Texture \"m\" \"spectrum\" \"mix\" \"texture tex1\" \"s\" \"texture amount\" \"f\" \
         Material \"diffuse\" \"texture reflectance\" \"m\" Shape \"sphere\" \"texture alpha\" \"f\" Shape \"sphere\" \"float alpha\" 1",
    );
    let SpectrumParam::Texture(id) = spectral(&s.materials[1], "reflectance") else { panic!() };
    let SpectrumTexture::Mix { a, b, amount } = s.spectrum_textures[id.0 as usize] else { panic!() };
    assert!(matches!(s.float_textures[amount.0 as usize], FloatTexture::Constant(v) if v == 0.3));
    assert!(
        matches!(&s.spectrum_textures[b.0 as usize], SpectrumTexture::Constant(SpectrumDesc::Constant(v)) if *v == 1.0)
    );
    let SpectrumTexture::Checkerboard { dimension: 2, mapping, to_texture, tex } =
        &s.spectrum_textures[a.0 as usize]
    else {
        panic!()
    };
    assert!(matches!(mapping, Mapping::Planar { vs: [0.0, 0.0, 1.0], vt: [0.0, 1.0, 0.0], .. }));
    assert!(near(to_texture.point(vec3(2.0, 0.0, 0.0)), [1.0, 0.0, 0.0]));
    assert!(
        matches!(&s.spectrum_textures[tex[1].0 as usize], SpectrumTexture::Constant(SpectrumDesc::Constant(v)) if *v == 0.0)
    );
    assert_eq!((s.shapes[0].alpha, s.shapes[1].alpha), (Some(amount), None));
}

#[test]
fn meshes_and_quadrics_are_as_given() {
    let s = scene(
        "WorldBegin Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0] \"integer indices\" [0 1 2 1 3 2] \
         \"point2 uv\" [0 0 1 0 0 1 1 1] \"integer faceIndices\" [4 5] \
         Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0] \
         Shape \"sphere\" \"float radius\" 2 \"float zmin\" 1 \"float zmax\" -9 \"float phimax\" 400 \
         Shape \"cylinder\" \"float zmin\" 3",
    );
    let ShapeKind::Mesh(m) = &s.shapes[0].kind else { panic!() };
    assert_eq!(
        (m.triangles.as_slice(), m.uv.len(), m.p[3]),
        ([[0, 1, 2], [1, 3, 2]].as_slice(), 4, [1.0, 1.0, 0.0])
    );
    let ShapeKind::Mesh(m) = &s.shapes[1].kind else { panic!() };
    assert_eq!((m.patches.as_slice(), m.triangles.len()), ([[0, 1, 2, 3]].as_slice(), 0));
    let ShapeKind::Sphere { radius, z_min, z_max, phi_max } = s.shapes[2].kind else { panic!() };
    assert_eq!(
        [radius, z_min, z_max, phi_max],
        [2.0, -2.0, 1.0, 360.0],
        "sorted and brought onto the sphere"
    );
    let ShapeKind::Cylinder { z_min, z_max, .. } = s.shapes[3].kind else { panic!() };
    assert_eq!([z_min, z_max], [1.0, 3.0]);
}

#[test]
fn statements_are_counted_by_type() {
    let s = scene("WorldBegin Shape \"sphere\" Shape \"sphere\" Shape \"disk\" Translate 1 1 1");
    let counts: Vec<_> = s.statements.iter().map(|(n, c)| (n.as_str(), *c)).collect();
    assert_eq!(counts, [("Shape disk", 1), ("Shape sphere", 2), ("Translate", 1), ("WorldBegin", 1)]);
}

#[test]
fn a_material_from_outside_takes_the_place_of_a_named_one() {
    let dir = std::env::temp_dir().join(format!("sparrow-replace-{}", std::process::id()));
    std::fs::create_dir_all(&dir).expect("a folder");
    let path = dir.join("scene.pbrt");
    let text = "WorldBegin MakeNamedMaterial \"look\" \"string type\" \"diffuse\" \
        NamedMaterial \"look\" Shape \"sphere\"";
    std::fs::write(&path, text).expect("a file");
    let with = |m: &str| sparrow_scene::read_with_materials(&path, &[m.to_string()]);

    let s = with("\"look\" \"string type\" \"phong\" \"float exponent\" 7").expect("a scene");
    assert_eq!(s.materials[s.shapes[0].material.0 as usize].type_name, "phong");
    let said = |m: &str| with(m).expect_err("a fault").to_string();
    let unknown = said("\"lok\" \"string type\" \"phong\"");
    assert!(unknown.ends_with("no named material \"lok\" to replace; did you mean \"look\"?"), "{unknown}");
    let wrong = said("\"look\" \"string type\" \"phong\" \"float exponnt\" 7");
    assert!(wrong.starts_with("--material:1:30: "), "{wrong}");
    let more = said("\"look\" \"string type\" \"phong\" Shape \"sphere\"");
    assert!(more.contains("remove this"), "{more}");
    std::fs::remove_dir_all(&dir).expect("our own folder");
}
