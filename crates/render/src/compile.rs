//! From a scene description to a scene that can be rendered.

use std::sync::Arc;

use sparrow_geometry::{BilinearMesh, CurveSet, Geometry, Shape, ShapeInstance, TriangleMesh};
use sparrow_math::{Real, Transform, Vec3};
use sparrow_mis::Mis;
use sparrow_scene::{
    AreaLightId, CurveBasis, CurveKind, Curves, FloatTexture, FloatTextureId, MaterialId, Mesh, SceneDesc,
    ShapeDesc, ShapeKind, SpectrumTexture, TextureFilter,
};

use crate::camera::Camera;
use crate::light::LightBuild;
use crate::material::Material;
use crate::scene::Scene;
use crate::texture::Textures;

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

/// Shapes of the geometry, and what belongs to each.
#[derive(Default)]
struct Parts {
    shapes: Vec<ShapeInstance>,
    materials: Vec<MaterialId>,
    emitters: Vec<Option<AreaLightId>>,
    alpha: Vec<Option<FloatTextureId>>,
}

impl Parts {
    fn push(&mut self, shape: Shape, to_world: Transform, flip_normal: bool, of: &ShapeDesc) {
        self.shapes.push(ShapeInstance { shape, to_world, flip_normal });
        self.materials.push(of.material);
        self.emitters.push(of.area_light);
        self.alpha.push(of.alpha);
    }
}

/// Compiles a description. Its meshes are moved where nobody else holds them.
///
/// # Errors
/// Images that cannot be read and settings that contradict each other, all at once.
pub fn compile(mut desc: SceneDesc) -> Result<Compiled, CompileError> {
    let (mut faults, mut notes) = (Vec::new(), Vec::new());
    let mut textures = Textures::new(&desc, &mut faults);
    let (materials, index) = compile_materials(&desc, &mut textures, &mut faults);
    let shapes = core::mem::take(&mut desc.shapes);
    let passes = |s: &ShapeDesc| index[s.material.0 as usize].is_none() && s.area_light.is_none();
    let parts = compile_shapes(shapes.into_iter().filter(|s| !passes(s)));
    let Parts { shapes, materials: shape_materials, emitters, alpha } = parts;
    let geometry = Geometry::build(shapes);
    let dropped = geometry.stats().dropped;
    if dropped > 0 {
        notes.push(format!(
            "{dropped} primitives without area or with coordinates that are no numbers were left out"
        ));
    }

    let compensate = desc.integrator.mis_compensation && desc.integrator.mis != Mis::LightOnly;
    let lights = LightBuild { desc: &desc, geometry: &geometry, emitters: &emitters, compensate }
        .build(&mut faults, &mut notes);
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

fn compile_shapes(shapes: impl Iterator<Item = ShapeDesc>) -> Parts {
    let mut parts = Parts::default();
    for mut s in shapes {
        let flip = s.reverse_orientation != s.to_world.swaps_handedness();
        let radians = f32::to_radians;
        let kind = core::mem::replace(&mut s.kind, ShapeKind::Mesh(Arc::default()));
        match kind {
            ShapeKind::Mesh(mesh) => mesh_shapes(mesh, &s, flip, &mut parts),
            ShapeKind::Curves(curves) => {
                let curves = Shape::Curves(curve_set(curves, &s.to_world));
                parts.push(curves, Transform::IDENTITY, flip, &s);
            }
            ShapeKind::Sphere { radius, z_min, z_max, phi_max } => {
                let shape = Shape::Sphere { radius, z_min, z_max, phi_max: radians(phi_max) };
                parts.push(shape, s.to_world, flip, &s);
            }
            ShapeKind::Disk { height, radius, inner_radius, phi_max } => {
                let shape = Shape::Disk { height, radius, inner_radius, phi_max: radians(phi_max) };
                parts.push(shape, s.to_world, flip, &s);
            }
            ShapeKind::Cylinder { radius, z_min, z_max, phi_max } => {
                let shape = Shape::Cylinder { radius, z_min, z_max, phi_max: radians(phi_max) };
                parts.push(shape, s.to_world, flip, &s);
            }
        }
    }
    parts
}

/// A mesh in world space: triangles and patches apart.
fn mesh_shapes(mesh: Arc<Mesh>, s: &ShapeDesc, flip: bool, parts: &mut Parts) {
    // The last holder of a mesh gives its memory away.
    let mut mesh = Arc::try_unwrap(mesh).unwrap_or_else(|shared| (*shared).clone());
    if !s.to_world.is_identity() {
        let map = |v: &mut [f32; 3], f: &dyn Fn(Vec3<f64>) -> Vec3<f64>| {
            *v = f(Vec3::from(*v).to_f64()).to_f32().to_array();
        };
        mesh.p.iter_mut().for_each(|v| map(v, &|p| s.to_world.point(p)));
        mesh.n.iter_mut().for_each(|v| map(v, &|n| s.to_world.normal(n).normalized()));
        mesh.s.iter_mut().for_each(|v| map(v, &|t| s.to_world.vector(t).normalized()));
    }
    if s.reverse_orientation {
        mesh.n.iter_mut().for_each(|n| *n = n.map(|c| -c));
    }
    let Mesh { p, n, s: tangents, uv, triangles, patches } = mesh;
    if !patches.is_empty() {
        let patches = if triangles.is_empty() {
            BilinearMesh { p, indices: patches, n, uv }
        } else {
            let both = BilinearMesh { p: p.clone(), indices: patches, n: n.clone(), uv: uv.clone() };
            let tri = TriangleMesh { p, indices: triangles, n, s: tangents, uv };
            parts.push(Shape::Triangles(tri), Transform::IDENTITY, flip, s);
            both
        };
        parts.push(Shape::Patches(patches), Transform::IDENTITY, flip, s);
    } else if !triangles.is_empty() {
        let tri = TriangleMesh { p, indices: triangles, n, s: tangents, uv };
        parts.push(Shape::Triangles(tri), Transform::IDENTITY, flip, s);
    }
}

/// Curves in world space. Of an uneven scaling radii get the mean, so that sections stay round.
fn curve_set(curves: Arc<Curves>, to_world: &Transform) -> CurveSet {
    let Curves { mut points, strands, basis, kind, mut normals, split_depth } =
        Arc::try_unwrap(curves).unwrap_or_else(|shared| (*shared).clone());
    if !to_world.is_identity() {
        let scale = Real::pow(to_world.determinant().abs(), 1.0 / 3.0) as f32;
        for [x, y, z, r] in &mut points {
            let p = to_world.point(Vec3 { x: *x, y: *y, z: *z }.to_f64()).to_f32();
            [*x, *y, *z, *r] = [p.x, p.y, p.z, *r * scale];
        }
        for n in &mut normals {
            *n = to_world.normal(Vec3::from(*n).to_f64()).normalized().to_f32().to_array();
        }
    }
    let basis = match basis {
        CurveBasis::Linear => sparrow_geometry::CurveBasis::Linear,
        CurveBasis::Bezier => sparrow_geometry::CurveBasis::Bezier,
        CurveBasis::BSpline => sparrow_geometry::CurveBasis::BSpline,
        CurveBasis::CatmullRom => sparrow_geometry::CurveBasis::CatmullRom,
    };
    let kind = match kind {
        CurveKind::Flat => sparrow_geometry::CurveKind::Flat,
        CurveKind::Cylinder => sparrow_geometry::CurveKind::Cylinder,
        CurveKind::Ribbon => sparrow_geometry::CurveKind::Ribbon,
        CurveKind::Round => sparrow_geometry::CurveKind::Round,
    };
    CurveSet { points, strands, basis, kind, normals, split_depth }
}

fn needs_footprint(desc: &SceneDesc) -> bool {
    let wide = |f: TextureFilter| matches!(f, TextureFilter::Trilinear | TextureFilter::Ewa);
    desc.float_textures.iter().any(|t| matches!(t, FloatTexture::Image(m) if wide(m.filter)))
        || desc.spectrum_textures.iter().any(|t| matches!(t, SpectrumTexture::Image(m, _) if wide(m.filter)))
}
