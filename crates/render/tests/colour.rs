//! Paths that carry red, green and blue, held against those that carry wavelengths.

mod common;

use common::{describe, mean, picture_of};
use sparrow_render::RenderPlan;
use sparrow_scene::{ColourMode, SceneDesc};

fn scene(film: &str, world: &str) -> SceneDesc {
    describe(&format!(
        "Film \"rgb\" \"integer xresolution\" 24 \"integer yresolution\" 16 {film}
         Sampler \"zsobol\" \"integer pixelsamples\" 256
         Integrator \"path\" \"integer maxdepth\" 4
         LookAt 0 1 4  0 0.5 0  0 1 0
         Camera \"perspective\" \"float fov\" 40
         WorldBegin
         AttributeBegin
           AreaLightSource \"diffuse\" \"rgb L\" [ 8 7 6 ]
           Translate 1 2.5 1
           Shape \"sphere\" \"float radius\" 0.3
         AttributeEnd
         {world}
         Shape \"bilinearmesh\" \"point3 P\" [ -5 0 -5  5 0 -5  -5 0 5  5 0 5 ]"
    ))
}

/// The means of a scene in RGB over those in wavelengths, and how far they may differ by chance.
fn ratios(film: &str, world: &str) -> ([f64; 3], f64) {
    let in_mode = |mode| {
        let mut desc = scene(film, world);
        desc.film.colour = mode;
        mean(&picture_of(desc, 2).0)
    };
    let (rgb, rgb_error) = in_mode(ColourMode::Rgb);
    let (spectral, spectral_error) = in_mode(ColourMode::Spectral);
    let noise = (0..3).map(|c| rgb_error[c].hypot(spectral_error[c]) / spectral[c]).fold(0.0, f64::max);
    ([0, 1, 2].map(|c| rgb[c] / spectral[c]), 4.0 * noise)
}

#[test]
fn grey_surfaces_under_coloured_light_are_the_same() {
    // Nothing multiplies two colours, so three channels lose nothing.
    let (r, noise) = ratios("", "Material \"diffuse\" \"rgb reflectance\" [ 0.5 0.5 0.5 ]");
    assert!(noise < 0.02, "{noise}");
    assert!(r.iter().all(|r| (r - 1.0).abs() < noise + 1e-3), "{r:?} {noise}");
}

#[test]
fn colours_of_surfaces_and_metals_are_nearly_the_same() {
    // Products of colours differ: a few percent for the red of copper between surfaces.
    let copper = "Material \"conductor\" \"spectrum eta\" \"metal-Cu-eta\" \"spectrum k\" \"metal-Cu-k\" \"float roughness\" 0.3
                  AttributeBegin Translate -0.5 0.7 0 Shape \"sphere\" \"float radius\" 0.7 AttributeEnd
                  Material \"diffuse\" \"rgb reflectance\" [ 0.63 0.2 0.1 ]";
    let (r, noise) = ratios("", copper);
    assert!(r.iter().all(|r| (r - 1.0).abs() < noise + 0.03), "{r:?} {noise}");
}

#[test]
fn exposure_balance_and_output_space_act_alike() {
    let film = "\"float iso\" 250 \"float whitebalance\" 4500";
    let (r, noise) = ratios(film, "Material \"diffuse\" \"rgb reflectance\" [ 0.5 0.5 0.5 ]");
    assert!(r.iter().all(|r| (r - 1.0).abs() < noise + 2e-3), "{r:?} {noise}");
}

#[test]
fn glass_that_disperses_takes_one_index() {
    let glass = "Material \"dielectric\" \"spectrum eta\" \"glass-SF11\" \"float roughness\" 0.2
                 AttributeBegin Translate 0 0.7 0 Shape \"sphere\" \"float radius\" 0.7 AttributeEnd
                 Material \"diffuse\" \"rgb reflectance\" [ 0.5 0.5 0.5 ]";
    let (r, noise) = ratios("", glass);
    assert!(r.iter().all(|r| (r - 1.0).abs() < noise + 0.01), "{r:?} {noise}");
}

#[test]
fn a_camera_sensor_needs_wavelengths() {
    let mut desc = scene("\"string sensor\" \"canon_eos_5d\"", "");
    assert!(RenderPlan::new(&desc).is_ok());
    desc.film.colour = ColourMode::Rgb;
    let Err(faults) = RenderPlan::new(&desc) else { panic!("RGB has no wavelengths") };
    assert!(faults[0].contains("spectral"), "{faults:?}");
}
