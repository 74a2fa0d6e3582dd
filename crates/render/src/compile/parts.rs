//! Shapes and instances as the geometry takes them: [`Parts`].

use core::mem::take;
use std::sync::Arc;

use sparrow_geometry::{
    BilinearMesh, CurveSet, GeometryParts, Instance, MovingInstance, Shape, ShapeInstance, TriangleMesh,
};
use sparrow_math::{Motion, Real, Transform, Vec3};
use sparrow_scene::{
    AreaLightId, CurveBasis, CurveKind, Curves, FloatTextureId, InstanceDesc, MaterialId, Mesh, SceneDesc,
    ShapeDesc, ShapeKind,
};

/// What the geometry is built from, and what belongs to each of its shapes, those of the world before those of prototypes.
#[derive(Default)]
pub(super) struct Parts {
    pub(super) geometry: GeometryParts,
    pub(super) materials: Vec<MaterialId>,
    pub(super) emitters: Vec<Option<AreaLightId>>,
    pub(super) alpha: Vec<Option<FloatTextureId>>,
    /// Points of some shape move.
    pub(super) deforms: bool,
}

impl Parts {
    /// Moves shapes, prototypes and instances out of a description. What stands in one place only becomes shapes of the world,
    /// where a ray finds it without a change of space; what stands nowhere is left out.
    pub(super) fn new(desc: &mut SceneDesc, is_seen: impl Fn(&ShapeDesc) -> bool) -> Parts {
        let (mut prototypes, instances) = (take(&mut desc.prototypes), take(&mut desc.instances));
        let mut n_places = vec![0_usize; prototypes.len()];
        instances.iter().for_each(|i| n_places[i.prototype.0 as usize] += 1);

        let mut parts = Parts::default();
        let (moving, standing): (Vec<ShapeDesc>, Vec<ShapeDesc>) =
            take(&mut desc.shapes).into_iter().filter(&is_seen).partition(|s| s.moves_to.is_some());
        standing.into_iter().for_each(|s| parts.push(s));
        // A quadric that is mirrored with its prototype keeps its outside, one that is mirrored as a shape does not.
        let is_single = |i: &InstanceDesc| {
            let alone = n_places[i.prototype.0 as usize] == 1;
            alone && !i.to_world.swaps_handedness() && i.moves_to.is_none()
        };
        let (single, placed): (Vec<InstanceDesc>, Vec<InstanceDesc>) =
            instances.into_iter().partition(is_single);
        for InstanceDesc { prototype, to_world, .. } in single {
            let shapes = take(&mut prototypes[prototype.0 as usize].shapes);
            let in_world = |s: ShapeDesc| ShapeDesc { to_world: to_world.then_first(&s.to_world), ..s };
            shapes.into_iter().filter(&is_seen).for_each(|s| parts.push(in_world(s)));
        }
        let n_world = parts.geometry.shapes.len();
        for (prototype, &n) in prototypes.into_iter().zip(&n_places) {
            let shapes = if n > 0 { prototype.shapes } else { Vec::new() };
            shapes.into_iter().filter(&is_seen).for_each(|s| parts.push(s));
            let shapes = parts.geometry.shapes.split_off(n_world);
            parts.geometry.prototypes.push(shapes);
        }
        for i in placed {
            // An instance of nothing has no box, and would count as dropped.
            if parts.geometry.prototypes[i.prototype.0 as usize].is_empty() {
                continue;
            }
            match i.moves_to {
                None => parts.geometry.instances.push(instance(&i)),
                Some(end) => parts.push_moving(&i.to_world, &end, i.prototype.0),
            }
        }
        parts.push_moving_shapes(moving, n_world);
        parts
    }

    fn push_moving(&mut self, start: &Transform, end: &Transform, prototype: u32) {
        let motion = Motion::new(start, end);
        self.geometry.moving.extend(motion.map(|motion| MovingInstance { motion, prototype }));
    }

    /// Shapes that move, as prototypes of their own: one for each run of shapes that move alike.
    fn push_moving_shapes(&mut self, shapes: Vec<ShapeDesc>, n_world: usize) {
        let mut last = None;
        for s in shapes {
            let Some(end) = s.moves_to else { continue };
            if last != Some((s.to_world, end)) {
                last = Some((s.to_world, end));
                self.push_moving(&s.to_world, &end, self.geometry.prototypes.len() as u32);
                self.geometry.prototypes.push(Vec::new());
            }
            self.push(ShapeDesc { to_world: Transform::IDENTITY, ..s });
            let pushed = self.geometry.shapes.split_off(n_world);
            if let Some(prototype) = self.geometry.prototypes.last_mut() {
                prototype.extend(pushed);
            }
        }
    }

    /// Adds a shape, in the space that its `to_world` leads to.
    fn push(&mut self, mut s: ShapeDesc) {
        self.deforms |= s.kind.deforms();
        let flip = s.reverse_orientation != s.to_world.swaps_handedness();
        let radians = f32::to_radians;
        let kind = core::mem::replace(&mut s.kind, ShapeKind::Mesh(Arc::default()));
        match kind {
            ShapeKind::Mesh(mesh) => self.push_mesh(mesh, &s, flip),
            ShapeKind::Curves(curves) => {
                let curves = Shape::Curves(curve_set(curves, &s.to_world));
                self.push_shape(curves, Transform::IDENTITY, flip, &s);
            }
            ShapeKind::Sphere { radius, z_min, z_max, phi_max } => {
                let shape = Shape::Sphere { radius, z_min, z_max, phi_max: radians(phi_max) };
                self.push_shape(shape, s.to_world, flip, &s);
            }
            ShapeKind::Disk { height, radius, inner_radius, phi_max } => {
                let shape = Shape::Disk { height, radius, inner_radius, phi_max: radians(phi_max) };
                self.push_shape(shape, s.to_world, flip, &s);
            }
            ShapeKind::Cylinder { radius, z_min, z_max, phi_max } => {
                let shape = Shape::Cylinder { radius, z_min, z_max, phi_max: radians(phi_max) };
                self.push_shape(shape, s.to_world, flip, &s);
            }
        }
    }

    fn push_shape(&mut self, shape: Shape, to_world: Transform, flip_normal: bool, of: &ShapeDesc) {
        self.geometry.shapes.push(ShapeInstance { shape, to_world, flip_normal });
        self.materials.push(of.material);
        self.emitters.push(of.area_light);
        self.alpha.push(of.alpha);
    }

    /// A mesh in the space that shapes stand in: triangles and patches apart.
    fn push_mesh(&mut self, mesh: Arc<Mesh>, s: &ShapeDesc, flip: bool) {
        // The last holder of a mesh gives its memory away.
        let mut mesh = Arc::try_unwrap(mesh).unwrap_or_else(|shared| (*shared).clone());
        if !s.to_world.is_identity() {
            let map = |v: &mut [f32; 3], f: &dyn Fn(Vec3<f64>) -> Vec3<f64>| {
                *v = f(Vec3::from(*v).to_f64()).to_f32().to_array();
            };
            let (p, n) = (mesh.p.iter_mut().chain(&mut mesh.p_end), mesh.n.iter_mut().chain(&mut mesh.n_end));
            p.for_each(|v| map(v, &|p| s.to_world.point(p)));
            n.for_each(|v| map(v, &|n| s.to_world.normal(n).normalized()));
            mesh.s.iter_mut().for_each(|v| map(v, &|t| s.to_world.vector(t).normalized()));
        }
        if s.reverse_orientation {
            mesh.n.iter_mut().chain(&mut mesh.n_end).for_each(|n| *n = n.map(|c| -c));
        }
        let Mesh { p, n, s: tangents, uv, triangles, patches, p_end, n_end } = mesh;
        let patches = BilinearMesh { p, indices: patches, n, uv, p_end, n_end };
        let patches = if triangles.is_empty() {
            patches
        } else {
            let (rest, BilinearMesh { p, n, uv, p_end, n_end, .. }) = if patches.indices.is_empty() {
                (BilinearMesh::default(), patches)
            } else {
                (patches.clone(), patches)
            };
            let tri = TriangleMesh { p, indices: triangles, n, s: tangents, uv, p_end, n_end };
            self.push_shape(Shape::Triangles(tri), Transform::IDENTITY, flip, s);
            rest
        };
        if !patches.indices.is_empty() {
            self.push_shape(Shape::Patches(patches), Transform::IDENTITY, flip, s);
        }
    }
}

/// An instance in single precision.
fn instance(i: &InstanceDesc) -> Instance {
    let [x, y, z, _] = i.to_world.rows().map(|row| row.map(|v| v as f32));
    Instance { to_world: [x, y, z], prototype: i.prototype.0 }
}

/// Curves in the space that shapes stand in. Of an uneven scaling radii get the mean, so that sections stay round.
fn curve_set(curves: Arc<Curves>, to_world: &Transform) -> CurveSet {
    let Curves {
        mut points,
        strands,
        basis,
        kind,
        mut normals,
        split_depth,
        mut points_end,
        mut normals_end,
    } = Arc::try_unwrap(curves).unwrap_or_else(|shared| (*shared).clone());
    if !to_world.is_identity() {
        let scale = Real::pow(to_world.determinant().abs(), 1.0 / 3.0) as f32;
        for [x, y, z, r] in points.iter_mut().chain(&mut points_end) {
            let p = to_world.point(Vec3 { x: *x, y: *y, z: *z }.to_f64()).to_f32();
            [*x, *y, *z, *r] = [p.x, p.y, p.z, *r * scale];
        }
        for n in normals.iter_mut().chain(&mut normals_end) {
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
    CurveSet { points, strands, basis, kind, normals, split_depth, points_end, normals_end }
}
