//! Local frames, and directions that belong to one: [`Frame`], [`LocalDir`].

use crate::real::Real;
use crate::vec3::{Vec3, vec3};

/// A unit direction in a local frame: z is the shading normal, x the tangent.
///
/// A world vector cannot be passed where a local direction is meant: [`Frame::to_local`] is the door
/// in, [`Frame::to_world`] the door out.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct LocalDir<R>(Vec3<R>);

impl<R: Real> LocalDir<R> {
    /// Takes a vector of unit length, given in local coordinates.
    #[inline(always)]
    pub fn new(v: Vec3<R>) -> Self {
        LocalDir(v)
    }
    /// From polar angle and azimuth, in radians.
    #[inline]
    pub fn from_angles(theta: R, phi: R) -> Self {
        let (st, ct) = theta.sin_cos();
        let (sp, cp) = phi.sin_cos();
        LocalDir(vec3(st * cp, st * sp, ct))
    }
    /// The components.
    #[inline(always)]
    pub fn v(self) -> Vec3<R> {
        self.0
    }
    /// Component along the tangent.
    #[inline(always)]
    pub fn x(self) -> R {
        self.0.x
    }
    /// Component along the bitangent.
    #[inline(always)]
    pub fn y(self) -> R {
        self.0.y
    }
    /// Component along the normal, `cos theta`.
    #[inline(always)]
    pub fn z(self) -> R {
        self.0.z
    }
    /// `cos theta`, signed.
    #[inline(always)]
    pub fn cos_theta(self) -> R {
        self.0.z
    }
    /// `|cos theta|`
    #[inline(always)]
    pub fn abs_cos_theta(self) -> R {
        self.0.z.abs()
    }
    /// `sin^2 theta`, not below zero.
    #[inline(always)]
    pub fn sin2_theta(self) -> R {
        self.0.x.sqr() + self.0.y.sqr()
    }
    /// On the side of the normal.
    #[inline(always)]
    pub fn above(self) -> R::Mask {
        self.0.z.gt(R::ZERO)
    }
    /// On the same side of the surface as `o`.
    #[inline(always)]
    pub fn same_side(self, o: Self) -> R::Mask {
        (self.0.z * o.0.z).gt(R::ZERO)
    }
    /// Scalar product.
    #[inline(always)]
    pub fn dot(self, o: Self) -> R {
        self.0.dot(o.0)
    }
    /// The half vector, of unit length; not finite for opposite directions.
    #[inline(always)]
    pub fn half(self, o: Self) -> Self {
        LocalDir((self.0 + o.0).normalized())
    }
    /// Mirrored about the microfacet normal `m`.
    #[inline(always)]
    pub fn reflect(self, m: Self) -> Self {
        LocalDir(m.0 * (R::of(2.0) * self.dot(m)) - self.0)
    }
    /// With the sign of z of `o`: the same point seen from the other side.
    #[inline(always)]
    pub fn flip_to(self, o: Self) -> Self {
        LocalDir(vec3(self.0.x, self.0.y, self.0.z.copysign(o.0.z)))
    }
}

impl<R: Real> core::ops::Neg for LocalDir<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        LocalDir(-self.0)
    }
}

/// A right-handed orthonormal frame.
#[derive(Clone, Copy, Debug)]
pub struct Frame<R> {
    /// Tangent.
    pub x: Vec3<R>,
    /// Bitangent.
    pub y: Vec3<R>,
    /// Normal.
    pub z: Vec3<R>,
}

impl<R: Real> Frame<R> {
    /// Any frame around the unit vector `z`. [Duff2017, listing 3]
    #[inline(always)]
    pub fn from_z(z: Vec3<R>) -> Self {
        let sign = R::ONE.copysign(z.z);
        let a = -R::ONE / (sign + z.z);
        let b = z.x * z.y * a;
        Frame {
            x: vec3(R::ONE + sign * z.x.sqr() * a, sign * b, -sign * z.x),
            y: vec3(b, sign + z.y.sqr() * a, -z.y),
            z,
        }
    }
    /// The frame around the unit vector `z` whose x follows `tangent`; any x where that is parallel to z or null.
    #[inline(always)]
    pub fn from_zx(z: Vec3<R>, tangent: Vec3<R>) -> Self {
        let t = tangent - z * z.dot(tangent);
        let len2 = t.length2();
        let has_x = len2.gt(R::of(1e-12) * tangent.length2()) & len2.gt(R::of(1e-30));
        let x = t * (R::ONE / len2.sqrt());
        Self::select(has_x, Frame { x, y: z.cross(x), z }, Self::from_z(z))
    }
    /// `a` where the mask is true, else `b`.
    #[inline(always)]
    pub fn select(m: R::Mask, a: Self, b: Self) -> Self {
        Frame { x: Vec3::select(m, a.x, b.x), y: Vec3::select(m, a.y, b.y), z: Vec3::select(m, a.z, b.z) }
    }
    /// World to local.
    #[inline(always)]
    pub fn to_local(&self, w: Vec3<R>) -> LocalDir<R> {
        LocalDir(vec3(w.dot(self.x), w.dot(self.y), w.dot(self.z)))
    }
    /// Local to world.
    #[inline(always)]
    pub fn to_world(&self, w: LocalDir<R>) -> Vec3<R> {
        self.x * w.0.x + self.y * w.0.y + self.z * w.0.z
    }
}
