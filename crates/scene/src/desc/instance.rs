//! Objects, and the places where they stand.

use std::sync::Arc;

use sparrow_math::Transform;

use super::{PrototypeId, ShapeDesc};
use crate::diagnostic::Span;

/// An object: shapes that stand nowhere until instances place them. None of them emits light.
#[derive(Clone, Debug)]
pub struct PrototypeDesc {
    /// Its name.
    pub name: Arc<str>,
    /// Its shapes, in file order. Their `to_world` leads to the object's space.
    pub shapes: Vec<ShapeDesc>,
    /// Where `ObjectBegin` stands.
    pub at: Span,
}

/// A prototype at a place.
#[derive(Clone, Debug)]
pub struct InstanceDesc {
    /// Which.
    pub prototype: PrototypeId,
    /// The object's space to world.
    pub to_world: Transform,
    /// The same where its motion ends, if it moves.
    pub moves_to: Option<Transform>,
}
