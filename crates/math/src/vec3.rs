//! Three-component vectors over any [`Real`].

use core::ops::{Add, AddAssign, Div, Index, Mul, Neg, Sub};

use crate::real::Real;

/// A vector, point or direction in three dimensions.
///
/// One type for all three: what a value means is said by its name (`p`, `wo`, `n`), and the one
/// distinction that goes wrong silently, world against local, has its own type, [`LocalDir`](crate::LocalDir).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Vec3<R> {
    /// First component.
    pub x: R,
    /// Second component.
    pub y: R,
    /// Third component.
    pub z: R,
}

/// The vector (`x`, `y`, `z`).
#[inline(always)]
pub const fn vec3<R>(x: R, y: R, z: R) -> Vec3<R> {
    Vec3 { x, y, z }
}

impl<R: Real> Vec3<R> {
    /// The same number three times.
    #[inline(always)]
    pub fn splat(v: R) -> Self {
        vec3(v, v, v)
    }
    /// Scalar product.
    #[inline(always)]
    pub fn dot(self, o: Self) -> R {
        self.x * o.x + self.y * o.y + self.z * o.z
    }
    /// Vector product.
    #[inline(always)]
    pub fn cross(self, o: Self) -> Self {
        vec3(self.y * o.z - self.z * o.y, self.z * o.x - self.x * o.z, self.x * o.y - self.y * o.x)
    }
    /// Squared length.
    #[inline(always)]
    pub fn length2(self) -> R {
        self.dot(self)
    }
    /// Length.
    #[inline(always)]
    pub fn length(self) -> R {
        self.dot(self).sqrt()
    }
    /// The unit vector of the same direction; not finite for the null vector.
    #[inline(always)]
    pub fn normalized(self) -> Self {
        self * (R::ONE / self.length())
    }
    /// Componentwise magnitude.
    #[inline(always)]
    pub fn abs(self) -> Self {
        vec3(self.x.abs(), self.y.abs(), self.z.abs())
    }
    /// Componentwise minimum.
    #[inline(always)]
    pub fn min(self, o: Self) -> Self {
        vec3(self.x.min(o.x), self.y.min(o.y), self.z.min(o.z))
    }
    /// Componentwise maximum.
    #[inline(always)]
    pub fn max(self, o: Self) -> Self {
        vec3(self.x.max(o.x), self.y.max(o.y), self.z.max(o.z))
    }
    /// The largest component.
    #[inline(always)]
    pub fn max_component(self) -> R {
        self.x.max(self.y).max(self.z)
    }
    /// `self` where the mask is true, else `o`.
    #[inline(always)]
    pub fn select(m: R::Mask, a: Self, b: Self) -> Self {
        vec3(R::select(m, a.x, b.x), R::select(m, a.y, b.y), R::select(m, a.z, b.z))
    }
    /// `self`, turned so that it lies on the side of `n`.
    #[inline(always)]
    pub fn facing(self, n: Self) -> Self {
        Self::select(self.dot(n).lt(R::ZERO), -self, self)
    }
}

impl Vec3<f32> {
    /// In double precision.
    #[inline]
    pub fn to_f64(self) -> Vec3<f64> {
        vec3(f64::from(self.x), f64::from(self.y), f64::from(self.z))
    }
    /// As an array.
    #[inline]
    pub fn to_array(self) -> [f32; 3] {
        [self.x, self.y, self.z]
    }
    /// No component is NaN or infinite.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }
}

impl Vec3<f64> {
    /// Rounded to single precision.
    #[inline]
    pub fn to_f32(self) -> Vec3<f32> {
        vec3(self.x as f32, self.y as f32, self.z as f32)
    }
}

impl From<[f32; 3]> for Vec3<f32> {
    #[inline]
    fn from(a: [f32; 3]) -> Self {
        vec3(a[0], a[1], a[2])
    }
}

impl<R: Real> Add for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        vec3(self.x + o.x, self.y + o.y, self.z + o.z)
    }
}
impl<R: Real> AddAssign for Vec3<R> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl<R: Real> Sub for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        vec3(self.x - o.x, self.y - o.y, self.z - o.z)
    }
}
impl<R: Real> Neg for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        vec3(-self.x, -self.y, -self.z)
    }
}
impl<R: Real> Mul<R> for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: R) -> Self {
        vec3(self.x * o, self.y * o, self.z * o)
    }
}
impl<R: Real> Div<R> for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: R) -> Self {
        vec3(self.x / o, self.y / o, self.z / o)
    }
}
impl<R> Index<usize> for Vec3<R> {
    type Output = R;
    #[inline(always)]
    fn index(&self, i: usize) -> &R {
        match i {
            0 => &self.x,
            1 => &self.y,
            _ => &self.z,
        }
    }
}
