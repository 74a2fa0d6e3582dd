//! From a scene description to a scene that can be rendered.

mod parts;

use sparrow_geometry::{BuildObserver, Geometry};
use sparrow_mis::Mis;
use sparrow_scene::{FloatTexture, FloatTextureId, SceneDesc, ShapeDesc, SpectrumTexture, TextureFilter};

use crate::camera::Camera;
use crate::light::LightBuild;
use crate::material::Material;
use crate::scene::Scene;
use crate::texture::Textures;

use parts::Parts;

/// A scene cannot be built. Holds every fault that was found.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{}", .0.join("\n"))]
pub struct CompileError(pub Vec<String>);

/// What was compiled, and remarks for the log.
#[derive(Debug)]
pub struct Compiled {
    /// The scene.
    pub scene: Scene,
    /// Remarks: aliases that were taken, primitives that were dropped.
    pub notes: Vec<String>,
}

/// Compiles a description. Its meshes are moved where nobody else holds them.
///
/// # Errors
/// Images that cannot be read and settings that contradict each other, all at once.
pub fn compile(desc: SceneDesc) -> Result<Compiled, CompileError> {
    compile_observed(desc, None)
}

/// The same, and tells how far the hierarchy is, which takes nearly all of the time.
///
/// # Errors
/// As [`compile`].
pub fn compile_observed(
    mut desc: SceneDesc,
    observer: Option<BuildObserver<'_>>,
) -> Result<Compiled, CompileError> {
    let (mut faults, mut notes) = (Vec::new(), Vec::new());
    let mut textures = Textures::new(&desc, &mut faults);
    let (materials, index) = compile_materials(&desc, &mut textures, &mut faults);
    let is_seen = |s: &ShapeDesc| index[s.material.0 as usize].is_some() || s.area_light.is_some();
    let Parts { geometry, materials: shape_materials, emitters, alpha, deforms } =
        Parts::new(&mut desc, is_seen);
    let moves = desc.camera.moves_to.is_some() || !geometry.moving.is_empty() || deforms;
    let geometry = Geometry::build_observed(geometry, observer);
    let dropped = geometry.stats().dropped;
    if dropped > 0 {
        notes.push(format!(
            "{dropped} primitives without area or with coordinates that are no numbers were left out"
        ));
    }

    let compensate = desc.integrator.mis_compensation && desc.integrator.mis != Mis::LightOnly;
    let lights =
        LightBuild { desc: &desc, geometry: &geometry, emitters: &emitters, compensate }.build(&mut faults);
    if !faults.is_empty() {
        return Err(CompileError(faults));
    }
    if lights.is_empty() {
        notes.push(
            "the scene has no light: the picture will be black; add a LightSource or an AreaLightSource"
                .into(),
        );
    }
    let material_of_shape: Vec<Option<u32>> = shape_materials.iter().map(|m| index[m.0 as usize]).collect();
    let opaque = |id: FloatTextureId| textures.constant_float(id).is_some_and(|a| a >= 1.0);
    let alpha: Vec<Option<FloatTextureId>> = alpha.into_iter().map(|a| a.filter(|&id| !opaque(id))).collect();
    let asks_hits = alpha.iter().any(Option::is_some) || material_of_shape.iter().any(Option::is_none);
    let spp = desc.sampler.samples_per_pixel.max(1) as f32;
    let scene = Scene {
        camera: Camera::new(&desc.camera, desc.film.resolution),
        needs_footprint: needs_footprint(&desc),
        sample_spacing: (1.0 / spp.sqrt()).max(0.125),
        geometry,
        material_of_shape,
        alpha_of_shape: alpha,
        materials,
        textures,
        lights,
        asks_hits,
        moves,
    };
    Ok(Compiled { scene, notes })
}

/// Materials, and where each description's lies among them; none for those that rays pass.
fn compile_materials(
    desc: &SceneDesc,
    textures: &mut Textures,
    faults: &mut Vec<String>,
) -> (Vec<Material>, Vec<Option<u32>>) {
    let mut materials = Vec::new();
    let index = desc
        .materials
        .iter()
        .map(|m| {
            let compiled = Material::new(m, desc, textures, faults)?;
            materials.push(compiled);
            Some(materials.len() as u32 - 1)
        })
        .collect();
    (materials, index)
}

fn needs_footprint(desc: &SceneDesc) -> bool {
    let wide = |f: TextureFilter| matches!(f, TextureFilter::Trilinear | TextureFilter::Ewa);
    desc.float_textures.iter().any(|t| matches!(t, FloatTexture::Image(m) if wide(m.filter)))
        || desc.spectrum_textures.iter().any(|t| matches!(t, SpectrumTexture::Image(m, _) if wide(m.filter)))
}
