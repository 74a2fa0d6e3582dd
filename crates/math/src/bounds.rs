//! Axis-aligned boxes.

use crate::vec3::{Vec3, vec3};

/// An axis-aligned box; empty where `lo > hi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Smallest corner.
    pub lo: Vec3<f32>,
    /// Largest corner.
    pub hi: Vec3<f32>,
}

impl Default for Aabb {
    fn default() -> Self {
        Aabb::EMPTY
    }
}

impl Aabb {
    /// The box without points.
    pub const EMPTY: Aabb = Aabb {
        lo: vec3(f32::INFINITY, f32::INFINITY, f32::INFINITY),
        hi: vec3(f32::NEG_INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY),
    };
    /// No point lies in it.
    #[inline]
    pub fn is_empty(&self) -> bool {
        !(self.lo.x <= self.hi.x && self.lo.y <= self.hi.y && self.lo.z <= self.hi.z)
    }
    /// The smallest box around this one and the point `p`.
    #[inline]
    #[must_use]
    pub fn grow(self, p: Vec3<f32>) -> Aabb {
        Aabb { lo: self.lo.min(p), hi: self.hi.max(p) }
    }
    /// The smallest box around both.
    #[inline]
    #[must_use]
    pub fn union(self, o: Aabb) -> Aabb {
        Aabb { lo: self.lo.min(o.lo), hi: self.hi.max(o.hi) }
    }
    /// Centre.
    #[inline]
    pub fn center(&self) -> Vec3<f32> {
        self.lo * 0.5 + self.hi * 0.5
    }
    /// Edge lengths.
    #[inline]
    pub fn extent(&self) -> Vec3<f32> {
        self.hi - self.lo
    }
    /// Half of the surface area; 0 for the empty box.
    #[inline]
    pub fn half_area(&self) -> f32 {
        if self.is_empty() {
            return 0.0;
        }
        let d = self.extent();
        d.x * d.y + d.y * d.z + d.z * d.x
    }
    /// Radius of the sphere around the centre that holds the box; 0 for the empty box.
    pub fn radius(&self) -> f32 {
        if self.is_empty() { 0.0 } else { self.extent().length() * 0.5 }
    }
}
