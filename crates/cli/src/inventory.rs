//! What is in a scene, counted: [`Inventory`].

use std::collections::{BTreeMap, HashSet};
use std::sync::Arc;

use serde::Serialize;
use sparrow_math::{Vec3, vec3};
use sparrow_scene::{
    Curves, FloatTexture, LightKind, Mesh, Projection, SceneDesc, ShapeDesc, ShapeKind, SpectrumTexture,
};

use crate::failure::{self, Remark};
use crate::{images, names};

/// Bytes of the hierarchy for each primitive, measured on our own scenes.
const HIERARCHY_BYTES: u64 = 60;
/// Bytes of an instance with its place in the hierarchy, measured likewise.
const INSTANCE_BYTES: u64 = 101;
/// Bytes of the hierarchy for each segment of a curve, or part of one, measured likewise.
const CURVE_HIERARCHY_BYTES: u64 = 43;
/// Bytes of a sphere, disk or cylinder with its place in the hierarchy, measured likewise.
const QUADRIC_BYTES: u64 = 360;

/// Counts by name.
pub(crate) type Counts = BTreeMap<String, usize>;

/// Everything `sparrow info` tells.
#[derive(Debug, Serialize)]
pub(crate) struct Inventory {
    pub(crate) status: &'static str,
    pub(crate) exit_code: u8,
    pub(crate) version: &'static str,
    pub(crate) scene: String,
    pub(crate) shapes: Shapes,
    pub(crate) instances: Instances,
    pub(crate) materials: Vec<Material>,
    pub(crate) lights: Lights,
    pub(crate) float_textures: Counts,
    pub(crate) spectrum_textures: Counts,
    pub(crate) images: Vec<String>,
    pub(crate) camera: Camera,
    pub(crate) film: Film,
    pub(crate) sampler: Sampler,
    pub(crate) integrator: Integrator,
    pub(crate) geometry_bytes_estimate: u64,
    pub(crate) files: Vec<String>,
    pub(crate) statements: Counts,
    pub(crate) warnings: Vec<Remark>,
}

/// Objects, and how often they are placed.
#[derive(Debug, Serialize)]
pub(crate) struct Instances {
    pub(crate) total: usize,
    pub(crate) prototypes: usize,
    /// Shapes of all prototypes, each counted once.
    pub(crate) shapes: usize,
}

/// Shapes of the world and of prototypes, each counted once however often it is placed.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Shapes {
    pub(crate) total: usize,
    pub(crate) meshes: usize,
    /// Meshes that differ; the others are the same files at other places.
    pub(crate) distinct_meshes: usize,
    pub(crate) triangles: usize,
    pub(crate) bilinear_patches: usize,
    pub(crate) spheres: usize,
    pub(crate) disks: usize,
    pub(crate) cylinders: usize,
    /// Strands of curves.
    pub(crate) strands: usize,
    /// Segments of curves.
    pub(crate) curve_segments: usize,
    /// Control points of curves.
    pub(crate) control_points: usize,
    /// Bytes of their points and lists, without the hierarchy.
    pub(crate) curve_bytes: u64,
    /// Shapes with a cut-out texture.
    pub(crate) with_alpha: usize,
}

/// Materials of one kind.
#[derive(Debug, Serialize)]
pub(crate) struct Material {
    /// The statement's word.
    #[serde(rename = "type")]
    pub(crate) type_name: String,
    /// The reflection model; none where rays pass unchanged.
    pub(crate) model: Option<&'static str>,
    pub(crate) count: usize,
    /// Shapes that use one of them.
    pub(crate) shapes: usize,
}

/// Light sources.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Lights {
    pub(crate) point: usize,
    pub(crate) spot: usize,
    pub(crate) distant: usize,
    pub(crate) infinite: usize,
    pub(crate) infinite_image: usize,
    pub(crate) emitting_shapes: usize,
    /// Each of them is a light of its own when rendered.
    pub(crate) emitting_primitives: usize,
}

/// The camera.
#[derive(Debug, Serialize)]
pub(crate) struct Camera {
    pub(crate) projection: &'static str,
    /// Field of view, in degrees.
    pub(crate) fov: Option<f32>,
    pub(crate) position: [f64; 3],
    pub(crate) direction: [f64; 3],
    pub(crate) lens_radius: f32,
    pub(crate) focal_distance: f32,
}

/// The film, and the filter before it.
#[derive(Debug, Serialize)]
pub(crate) struct Film {
    pub(crate) resolution: [u32; 2],
    pub(crate) pixel_bounds: [u32; 4],
    pub(crate) filename: Option<String>,
    pub(crate) half: bool,
    pub(crate) sensor: String,
    pub(crate) iso: f32,
    pub(crate) exposure_time: f32,
    pub(crate) white_balance: Option<f32>,
    pub(crate) color_space: &'static str,
    pub(crate) filter: &'static str,
    pub(crate) filter_radius: [f32; 2],
}

/// The sampler.
#[derive(Debug, Serialize)]
pub(crate) struct Sampler {
    pub(crate) name: &'static str,
    pub(crate) samples_per_pixel: u32,
    pub(crate) randomization: &'static str,
    pub(crate) seed: u64,
}

/// The integrator.
#[derive(Debug, Serialize)]
pub(crate) struct Integrator {
    pub(crate) name: &'static str,
    pub(crate) max_depth: u32,
    /// As many as are efficient, where there is none.
    pub(crate) splits: Option<u32>,
    pub(crate) mis: String,
    pub(crate) mis_compensation: bool,
    pub(crate) light_sampler: &'static str,
    pub(crate) regularize: bool,
}

impl Inventory {
    /// Counts.
    pub(crate) fn new(scene: &std::path::Path, desc: &SceneDesc) -> Inventory {
        let mut statements = Counts::new();
        for (name, n) in &desc.statements {
            *statements.entry(name.clone()).or_default() += n;
        }
        Inventory {
            status: "done",
            exit_code: failure::DONE,
            version: env!("CARGO_PKG_VERSION"),
            scene: scene.display().to_string(),
            shapes: Shapes::new(desc),
            instances: Instances::new(desc),
            materials: materials(desc),
            lights: Lights::new(desc),
            float_textures: counted(desc.float_textures.iter().map(float_kind)),
            spectrum_textures: counted(desc.spectrum_textures.iter().map(spectrum_kind)),
            images: images::of(desc).iter().map(|i| i.0.display().to_string()).collect(),
            camera: Camera::new(desc),
            film: Film::new(desc),
            sampler: Sampler {
                name: names::sampler(desc.sampler.name),
                samples_per_pixel: desc.sampler.samples_per_pixel,
                randomization: names::randomization(desc.sampler.randomize),
                seed: desc.sampler.seed.unwrap_or(desc.seed),
            },
            integrator: Integrator {
                name: names::integrator(desc.integrator.name),
                max_depth: desc.integrator.max_depth,
                splits: desc.integrator.splits,
                mis: desc.integrator.mis.to_string(),
                mis_compensation: desc.integrator.mis_compensation,
                light_sampler: names::light_sampler(desc.integrator.light_sampler),
                regularize: desc.integrator.regularize,
            },
            geometry_bytes_estimate: geometry_bytes(desc),
            files: desc.files.iter().map(|f| f.display().to_string()).collect(),
            statements,
            warnings: failure::warnings(&desc.warnings, &desc.files),
        }
    }
}

/// Shapes of the world and of prototypes.
fn all_shapes(desc: &SceneDesc) -> impl Iterator<Item = &ShapeDesc> {
    desc.shapes.iter().chain(desc.prototypes.iter().flat_map(|p| &p.shapes))
}

impl Instances {
    fn new(desc: &SceneDesc) -> Instances {
        Instances {
            total: desc.instances.len(),
            prototypes: desc.prototypes.len(),
            shapes: desc.prototypes.iter().map(|p| p.shapes.len()).sum(),
        }
    }
}

impl Shapes {
    fn new(desc: &SceneDesc) -> Shapes {
        let mut s = Shapes::default();
        let mut distinct = HashSet::new();
        for shape in all_shapes(desc) {
            s.total += 1;
            s.with_alpha += usize::from(shape.alpha.is_some());
            match &shape.kind {
                ShapeKind::Mesh(mesh) => {
                    s.meshes += 1;
                    distinct.insert(Arc::as_ptr(mesh));
                    s.triangles += mesh.triangles.len();
                    s.bilinear_patches += mesh.patches.len();
                }
                ShapeKind::Sphere { .. } => s.spheres += 1,
                ShapeKind::Disk { .. } => s.disks += 1,
                ShapeKind::Cylinder { .. } => s.cylinders += 1,
                ShapeKind::Curves(c) => {
                    s.strands += c.strands.len();
                    s.curve_segments += c.n_segments();
                    s.control_points += c.points.len();
                    s.curve_bytes += curve_bytes(c);
                }
            }
        }
        s.distinct_meshes = distinct.len();
        s
    }
}

impl Lights {
    fn new(desc: &SceneDesc) -> Lights {
        let mut l = Lights::default();
        for light in &desc.lights {
            match light.kind {
                LightKind::Point { .. } => l.point += 1,
                LightKind::Spot { .. } => l.spot += 1,
                LightKind::Distant { .. } => l.distant += 1,
                LightKind::Infinite { .. } => l.infinite += 1,
                LightKind::InfiniteImage { .. } => l.infinite_image += 1,
            }
        }
        for shape in desc.shapes.iter().filter(|s| s.area_light.is_some()) {
            l.emitting_shapes += 1;
            l.emitting_primitives += match &shape.kind {
                ShapeKind::Mesh(mesh) => mesh.triangles.len() + mesh.patches.len(),
                ShapeKind::Curves(_) => 0,
                ShapeKind::Sphere { .. } | ShapeKind::Disk { .. } | ShapeKind::Cylinder { .. } => 1,
            };
        }
        l
    }
}

impl Camera {
    fn new(desc: &SceneDesc) -> Camera {
        let c = &desc.camera;
        Camera {
            projection: names::projection(c.projection),
            fov: match c.projection {
                Projection::Perspective { fov } => Some(fov),
                Projection::Orthographic => None,
            },
            position: array(c.to_world.point(vec3(0.0, 0.0, 0.0))),
            direction: array(c.to_world.vector(vec3(0.0, 0.0, 1.0)).normalized()),
            lens_radius: c.lens_radius,
            focal_distance: c.focal_distance,
        }
    }
}

fn array(v: Vec3<f64>) -> [f64; 3] {
    [v.x, v.y, v.z]
}

impl Film {
    fn new(desc: &SceneDesc) -> Film {
        let f = &desc.film;
        let (filter, filter_radius) = names::filter(desc.filter);
        Film {
            resolution: f.resolution,
            pixel_bounds: f.pixel_bounds,
            filename: f.filename.as_ref().map(|p| p.display().to_string()),
            half: f.save_fp16,
            sensor: f.sensor.clone(),
            iso: f.iso,
            exposure_time: f.exposure_time,
            white_balance: f.white_balance,
            color_space: f.color_space.name(),
            filter,
            filter_radius,
        }
    }
}

/// Materials by type and model, in order of first occurrence, with the number of shapes.
fn materials(desc: &SceneDesc) -> Vec<Material> {
    let mut uses = vec![0usize; desc.materials.len()];
    for shape in all_shapes(desc) {
        if let Some(n) = uses.get_mut(shape.material.0 as usize) {
            *n += 1;
        }
    }
    let mut found: Vec<Material> = Vec::new();
    for (i, (m, shapes)) in desc.materials.iter().zip(uses).enumerate() {
        // The default is always there; where no shape has it, nobody asked for it.
        if i == 0 && shapes == 0 {
            continue;
        }
        let model = m.model.map(|k| k.name());
        match found.iter_mut().find(|f| f.type_name == m.type_name && f.model == model) {
            Some(f) => (f.count, f.shapes) = (f.count + 1, f.shapes + shapes),
            None => found.push(Material { type_name: m.type_name.clone(), model, count: 1, shapes }),
        }
    }
    found
}

fn counted(names: impl Iterator<Item = &'static str>) -> Counts {
    let mut counts = Counts::new();
    names.for_each(|n| *counts.entry(n.to_owned()).or_default() += 1);
    counts
}

fn float_kind(t: &FloatTexture) -> &'static str {
    match t {
        FloatTexture::Constant(_) => "constant",
        FloatTexture::Scale(..) => "scale",
        FloatTexture::Mix { .. } => "mix",
        FloatTexture::Image(_) => "imagemap",
        FloatTexture::Checkerboard { .. } => "checkerboard",
    }
}

fn spectrum_kind(t: &SpectrumTexture) -> &'static str {
    match t {
        SpectrumTexture::Constant(_) => "constant",
        SpectrumTexture::Scale(..) => "scale",
        SpectrumTexture::Mix { .. } => "mix",
        SpectrumTexture::Image(..) => "imagemap",
        SpectrumTexture::Checkerboard { .. } => "checkerboard",
    }
}

/// Memory of all shapes and instances when they are rendered.
fn geometry_bytes(desc: &SceneDesc) -> u64 {
    let placed: HashSet<u32> = desc.instances.iter().map(|i| i.prototype.0).collect();
    let prototypes = placed.iter().filter_map(|&i| desc.prototypes.get(i as usize));
    let shapes = desc.shapes.iter().chain(prototypes.flat_map(|p| &p.shapes));
    shapes.map(shape_bytes).sum::<u64>() + INSTANCE_BYTES * desc.instances.len() as u64
}

/// Memory of a shape when it is rendered, with its part of the hierarchy.
fn shape_bytes(s: &ShapeDesc) -> u64 {
    match &s.kind {
        ShapeKind::Mesh(mesh) => {
            let prims = (mesh.triangles.len() + 2 * mesh.patches.len()) as u64;
            mesh_bytes(mesh) + prims * HIERARCHY_BYTES
        }
        ShapeKind::Curves(c) => {
            curve_bytes(c) + ((c.n_segments() as u64) << c.split_depth) * CURVE_HIERARCHY_BYTES
        }
        ShapeKind::Sphere { .. } | ShapeKind::Disk { .. } | ShapeKind::Cylinder { .. } => QUADRIC_BYTES,
    }
}

/// 16 bytes a point, 4 a segment and a strand, 12 a normal.
fn curve_bytes(c: &Curves) -> u64 {
    (16 * c.points.len() + 4 * (c.n_segments() + c.strands.len()) + 12 * c.normals.len()) as u64
}

fn mesh_bytes(m: &Mesh) -> u64 {
    let vectors = m.p.len() + m.n.len() + m.s.len() + m.triangles.len();
    (12 * vectors + 8 * m.uv.len() + 16 * m.patches.len()) as u64
}
