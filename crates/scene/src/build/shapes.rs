//! Shapes, and the objects that collect them.

use std::sync::Arc;

use sparrow_math::Transform;

use super::Builder;
use super::curves::joined;
use super::materials::MaterialRef;
use super::mesh::{MeshFiles, PendingMesh};
use crate::desc::{AreaLightId, ShapeKind};
use crate::diagnostic::Span;
use crate::params::Params;
use crate::tables::{Entity, Support};

/// What a shape's `alpha` says.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Alpha {
    Opaque,
    Constant(f32),
    Texture(String, Span),
}

/// A shape whose material and textures are still names.
#[derive(Clone, Debug)]
pub(super) struct PendingShape {
    pub(super) kind: ShapeKind,
    pub(super) to_world: Transform,
    pub(super) moves_to: Option<Transform>,
    pub(super) reverse_orientation: bool,
    pub(super) material: MaterialRef,
    pub(super) area_light: Option<AreaLightId>,
    pub(super) alpha: Alpha,
    pub(super) at: Span,
}

impl PendingShape {
    /// Joins a shape of curves to this one, if both are made of the same.
    fn takes(&mut self, other: &PendingShape) -> bool {
        self.material == other.material
            && self.area_light == other.area_light
            && self.alpha == other.alpha
            && self.reverse_orientation == other.reverse_orientation
            && self.to_world == other.to_world
            && self.moves_to == other.moves_to
            && joined(&mut self.kind, &other.kind)
    }
}

/// An object: shapes to be instanced.
#[derive(Debug)]
pub(super) struct Object {
    pub(super) name: Arc<str>,
    pub(super) at: Span,
    pub(super) shapes: Vec<PendingShape>,
}

/// An instance whose object is still a name.
#[derive(Debug)]
pub(super) struct PendingInstance {
    pub(super) name: String,
    pub(super) at: Span,
    pub(super) to_world: Transform,
    pub(super) moves_to: Option<Transform>,
}

impl Builder {
    /// A shape; its parameters have been checked.
    pub(super) fn shape(&mut self, entity: &Entity, mut params: Params) {
        if entity.support != Support::Yes {
            return;
        }
        let Some((mut kind, files)) = self.kind_or_files(entity.name, &mut params) else { return };
        let deforms = kind.deforms() || files.as_ref().is_some_and(MeshFiles::deforms);
        let mut area_light = self.graphics.area_light;
        if area_light.is_some() && self.open_object.is_some() {
            self.no_light_in_objects(params.at);
            area_light = None;
        }
        if area_light.is_some() && matches!(kind, ShapeKind::Curves(_)) {
            self.report.warn(params.at, "curves do not emit light; the area light is ignored for them");
            area_light = None;
        }
        let stands = area_light.is_some() && deforms;
        if stands {
            let message = "a shape that emits light cannot deform; it keeps its form where motion starts";
            self.report.warn(params.at, message);
            kind = standing(kind);
        }
        let (to_world, moves_to) = if area_light.is_some() {
            (self.standing("a shape that emits light", params.at), None)
        } else if self.open_object.is_some() {
            (self.standing("a shape within an object", params.at), None)
        } else {
            self.moving(params.at)
        };
        let shape = PendingShape {
            kind,
            to_world,
            moves_to,
            reverse_orientation: self.graphics.reverse_orientation,
            material: self.graphics.material.clone(),
            area_light,
            alpha: alpha(&params),
            at: params.at,
        };
        let shapes = match self.open_object.and_then(|i| self.objects.get_mut(i)) {
            Some(object) => &mut object.shapes,
            None => &mut self.shapes,
        };
        if !shapes.last_mut().is_some_and(|last| last.takes(&shape)) {
            shapes.push(shape);
        }
        if let Some(files) = files {
            let (object, shape) = (self.open_object, shapes.len() - 1);
            self.meshes.pending.push(PendingMesh { files, object, shape, stands });
        }
    }

    /// What a shape is; or, of a mesh in files, these, and a mesh without faces that keeps its place.
    fn kind_or_files(&mut self, name: &str, params: &mut Params) -> Option<(ShapeKind, Option<MeshFiles>)> {
        if name == "plymesh" {
            let files = self.mesh_files(params)?;
            return Some((ShapeKind::Mesh(Arc::default()), Some(files)));
        }
        Some((self.shape_kind(name, params)?, None))
    }

    fn shape_kind(&mut self, name: &str, params: &mut Params) -> Option<ShapeKind> {
        match name {
            "trianglemesh" => self.triangle_mesh(params).map(ShapeKind::Mesh),
            "bilinearmesh" => self.bilinear_mesh(params).map(ShapeKind::Mesh),
            "curve" => self.curve(params).map(|c| ShapeKind::Curves(Arc::new(c))),
            "hair" => self.strands(params).map(|c| ShapeKind::Curves(Arc::new(c))),
            "sphere" => {
                let radius = self.radius(params)?;
                let [a, b] = [params.float_or("zmin", -radius), params.float_or("zmax", radius)];
                let (z_min, z_max) = (a.min(b).clamp(-radius, radius), a.max(b).clamp(-radius, radius));
                Some(ShapeKind::Sphere { radius, z_min, z_max, phi_max: phi_max(params) })
            }
            "disk" => {
                let radius = self.radius(params)?;
                let height = params.float_or("height", 0.0);
                let inner_radius = params.float_or("innerradius", 0.0);
                Some(ShapeKind::Disk { height, radius, inner_radius, phi_max: phi_max(params) })
            }
            _ => {
                let radius = self.radius(params)?;
                let [a, b] = [params.float_or("zmin", -1.0), params.float_or("zmax", 1.0)];
                Some(ShapeKind::Cylinder {
                    radius,
                    z_min: a.min(b),
                    z_max: a.max(b),
                    phi_max: phi_max(params),
                })
            }
        }
    }

    fn radius(&mut self, params: &Params) -> Option<f32> {
        let radius = params.float_or("radius", 1.0);
        if radius > 0.0 {
            return Some(radius);
        }
        self.report.error(params.place("radius"), format!("\"radius\" is {radius}; give one above zero"));
        None
    }
}

/// A mesh as it is where motion starts.
fn standing(mut kind: ShapeKind) -> ShapeKind {
    if let ShapeKind::Mesh(mesh) = &mut kind {
        let still = Arc::make_mut(mesh);
        (still.p_end, still.n_end) = (Vec::new(), Vec::new());
    }
    kind
}

/// Beyond a full turn pbrt-v4 takes a full turn.
fn phi_max(params: &Params) -> f32 {
    params.float_or("phimax", 360.0).clamp(0.0, 360.0)
}

fn alpha(params: &Params) -> Alpha {
    // A texture goes before a number, whichever comes last.
    if let Some((name, at)) = params.texture("alpha") {
        return Alpha::Texture(name.to_string(), at);
    }
    match params.float("alpha") {
        Some(a) if a < 1.0 => Alpha::Constant(a.max(0.0)),
        Some(_) | None => Alpha::Opaque,
    }
}
