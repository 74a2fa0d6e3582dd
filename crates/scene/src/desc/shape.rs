//! Shapes: meshes, quadrics, and what they are made of.

use std::sync::Arc;

use sparrow_math::Transform;

use super::{AreaLightId, Curves, FloatTextureId, MaterialId};
use crate::diagnostic::Span;

/// Triangle and patch vertices, in object space.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Positions.
    pub p: Vec<[f32; 3]>,
    /// Normals, one per position, or none.
    pub n: Vec<[f32; 3]>,
    /// Tangents, one per position, or none.
    pub s: Vec<[f32; 3]>,
    /// Texture coordinates, one per position, or none.
    pub uv: Vec<[f32; 2]>,
    /// Positions where motion ends, one per position, or none: then they stand still.
    pub p_end: Vec<[f32; 3]>,
    /// Normals where motion ends, one per normal, or none: then they stay as they are.
    pub n_end: Vec<[f32; 3]>,
    /// Corners of triangles.
    pub triangles: Vec<[u32; 3]>,
    /// Corners of bilinear patches, in the order p00, p10, p01, p11.
    pub patches: Vec<[u32; 4]>,
}

/// The form of a shape in its own space; angles in degrees as in the file.
#[derive(Clone, Debug)]
pub enum ShapeKind {
    /// Triangles and bilinear patches.
    Mesh(Arc<Mesh>),
    /// Curves.
    Curves(Arc<Curves>),
    /// A sphere or part of one, about the z axis.
    Sphere {
        /// Radius.
        radius: f32,
        /// Cut below this height.
        z_min: f32,
        /// Cut above this height.
        z_max: f32,
        /// Sweep, in degrees.
        phi_max: f32,
    },
    /// A disk or ring at right angles to z.
    Disk {
        /// Place along z.
        height: f32,
        /// Outer radius.
        radius: f32,
        /// Inner radius.
        inner_radius: f32,
        /// Sweep, in degrees.
        phi_max: f32,
    },
    /// An open cylinder about z.
    Cylinder {
        /// Radius.
        radius: f32,
        /// Lower end.
        z_min: f32,
        /// Upper end.
        z_max: f32,
        /// Sweep, in degrees.
        phi_max: f32,
    },
}

impl ShapeKind {
    /// Points of the shape move, each by itself.
    pub fn deforms(&self) -> bool {
        match self {
            ShapeKind::Mesh(mesh) => !mesh.p_end.is_empty(),
            ShapeKind::Curves(curves) => !curves.points_end.is_empty(),
            ShapeKind::Sphere { .. } | ShapeKind::Disk { .. } | ShapeKind::Cylinder { .. } => false,
        }
    }
}

/// A shape in the scene.
#[derive(Clone, Debug)]
pub struct ShapeDesc {
    /// Its form.
    pub kind: ShapeKind,
    /// Its own space to world; of a shape of a prototype, to the prototype's space.
    pub to_world: Transform,
    /// The same where its motion ends, if it moves. What emits light or belongs to a prototype does not.
    pub moves_to: Option<Transform>,
    /// `ReverseOrientation` was in force.
    pub reverse_orientation: bool,
    /// What it is made of.
    pub material: MaterialId,
    /// What it emits.
    pub area_light: Option<AreaLightId>,
    /// Cut-out: the surface is there with this probability.
    pub alpha: Option<FloatTextureId>,
    /// Where the statement stands.
    pub at: Span,
}
