//! Circular and elliptical sections: [`Section`].

use sparrow_math::Real;

/// A point or direction in the plane across the fibre, by its components along y and z of the fibre's frame.
pub type Flat<R> = [R; 2];

/// An ellipse with the semi-axes 1 along y and `b` along z.
#[derive(Clone, Copy, Debug)]
pub struct Section<R> {
    /// Semi-axis along z, above zero.
    pub b: R,
}

/// Scalar product.
#[inline(always)]
pub fn dot<R: Real>(a: Flat<R>, b: Flat<R>) -> R {
    a[0] * b[0] + a[1] * b[1]
}

/// The azimuth of `d` from that of the unit vector `phi`.
#[inline(always)]
pub fn turn<R: Real>(phi: Flat<R>, d: Flat<R>) -> R {
    (phi[0] * d[1] - phi[1] * d[0]).atan2(dot(phi, d))
}

impl<R: Real> Section<R> {
    /// Half of the width seen from the azimuth `[cos, sin]`.
    #[inline(always)]
    pub fn half_width(&self, [cos, sin]: Flat<R>) -> R {
        (sin.sqr() + (self.b * cos).sqr()).sqrt()
    }
    /// The lit point of the ray at the offset `h` of the half width, seen from the azimuth `phi`; h above zero lies before `phi`.
    #[inline(always)]
    pub fn entry(&self, phi: Flat<R>, h: R) -> Flat<R> {
        let w = self.half_width(phi);
        let far = [phi[1] * h * w, -phi[0] * h * w];
        // Along phi from there to the ellipse: y^2 + z^2 / b^2 = 1.
        let inv = R::ONE / w;
        let along = -(self.b.sqr() - R::ONE) * far[0] * phi[0] * inv.sqr();
        let t = along + self.b * inv * ((R::ONE - h) * (R::ONE + h)).safe_sqrt();
        [far[0] + t * phi[0], far[1] + t * phi[1]]
    }
    /// Outward unit normal at a point of the ellipse.
    #[inline(always)]
    pub fn normal(&self, p: Flat<R>) -> Flat<R> {
        let n = [p[0] * self.b.sqr(), p[1]];
        let scale = R::ONE / dot(n, n).sqrt().max(R::of(1e-12));
        [n[0] * scale, n[1] * scale]
    }
    /// Radius of curvature where the unit normal is `n`.
    #[inline(always)]
    pub fn radius(&self, n: Flat<R>) -> R {
        let s = n[0].sqr() + (self.b * n[1]).sqr();
        self.b.sqr() / (s * s.sqrt())
    }
    /// How far, in units of `d`, the opposite point lies from the point `p` of the ellipse; not above zero outwards.
    #[inline(always)]
    pub fn across(&self, p: Flat<R>, d: Flat<R>) -> R {
        let b2 = self.b.sqr();
        let (h, a) = (b2 * p[0] * d[0] + p[1] * d[1], b2 * d[0].sqr() + d[1].sqr());
        R::of(-2.0) * h / a.max(R::of(1e-18))
    }
}
