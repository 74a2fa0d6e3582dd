//! One segment of a curve in the form that every basis is turned into: [`Cubic`].

use sparrow_math::{Vec3, vec3};

use crate::shape::CurveBasis;

/// Coefficients of `1, u, u^2, u^3`, each as weights of the four control points.
type Weights = [[f32; 4]; 4];

const LINEAR: Weights = [[1., 0., 0., 0.], [-1., 1., 0., 0.], [0.; 4], [0.; 4]];
const BEZIER: Weights = [[1., 0., 0., 0.], [-3., 3., 0., 0.], [3., -6., 3., 0.], [-1., 3., -3., 1.]];
const SIXTH: f32 = 1.0 / 6.0;
const B_SPLINE: Weights =
    [[SIXTH, 4.0 * SIXTH, SIXTH, 0.], [-0.5, 0., 0.5, 0.], [0.5, -1., 0.5, 0.], [-SIXTH, 0.5, -0.5, SIXTH]];
const CATMULL_ROM: Weights =
    [[0., 1., 0., 0.], [-0.5, 0., 0.5, 0.], [1., -2.5, 2., -0.5], [-0.5, 1.5, -1.5, 0.5]];

impl CurveBasis {
    fn weights(self) -> &'static Weights {
        match self {
            CurveBasis::Linear => &LINEAR,
            CurveBasis::Bezier => &BEZIER,
            CurveBasis::BSpline => &B_SPLINE,
            CurveBasis::CatmullRom => &CATMULL_ROM,
        }
    }
}

/// `anchor + a[0] + a[1] u + a[2] u^2 + a[3] u^3` for `u` in [0, 1], as `x y z r`.
///
/// Only the anchor lies far from the origin: `a` is as small as the segment, and so are its rounding errors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cubic {
    /// The second control point; its radius is zero.
    pub(super) anchor: [f32; 3],
    pub(super) a: [[f32; 4]; 4],
}

/// A point of a cubic with its derivatives.
#[derive(Clone, Copy, Debug)]
pub(super) struct CubicPoint {
    pub(super) p: Vec3<f64>,
    pub(super) dp: Vec3<f64>,
    pub(super) ddp: Vec3<f64>,
    pub(super) r: f64,
    pub(super) dr: f64,
}

impl Cubic {
    #[inline(always)]
    pub(super) fn new(basis: CurveBasis, p: &[[f32; 4]; 4]) -> Cubic {
        let [x, y, z, _] = p[1];
        let from_anchor = |q: &[f32; 4]| [q[0] - x, q[1] - y, q[2] - z, q[3]];
        let p = [from_anchor(&p[0]), [0.0, 0.0, 0.0, p[1][3]], from_anchor(&p[2]), from_anchor(&p[3])];
        let mut a = [[0.0; 4]; 4];
        for (a, w) in a.iter_mut().zip(basis.weights()) {
            for (p, w) in p.iter().zip(w) {
                for (a, p) in a.iter_mut().zip(p) {
                    *a += w * p;
                }
            }
        }
        Cubic { anchor: [x, y, z], a }
    }

    /// The part from `u[0]` to `u[1]`, with a parameter of its own from 0 to 1.
    pub(super) fn part(&self, u: [f32; 2]) -> Cubic {
        let (s, w) = (f64::from(u[0]), f64::from(u[1] - u[0]));
        let mut part = *self;
        for i in 0..4 {
            let [a, b, c, d] = self.a.map(|a| f64::from(a[i]));
            part.a[0][i] = (a + s * (b + s * (c + s * d))) as f32;
            part.a[1][i] = (w * (b + s * (2.0 * c + 3.0 * s * d))) as f32;
            part.a[2][i] = (w * w * (c + 3.0 * s * d)) as f32;
            part.a[3][i] = (w * w * w * d) as f32;
        }
        part
    }

    /// The Bezier points, whose hull holds the segment; `x y z r`, without the anchor.
    pub(super) fn hull(&self) -> [[f32; 4]; 4] {
        let mut b = [[0.0; 4]; 4];
        for i in 0..4 {
            let [a0, a1, a2, a3] = self.a.map(|a| a[i]);
            let (third, mixed) = (a1 / 3.0, (2.0 * a1 + a2) / 3.0);
            for (b, v) in b.iter_mut().zip([a0, a0 + third, a0 + mixed, a0 + a1 + a2 + a3]) {
                b[i] = v;
            }
        }
        b
    }

    /// A bound of the radius from above; zero where it is nowhere positive.
    #[inline(always)]
    pub(super) fn largest_radius(&self) -> f32 {
        let [[.., a0], [.., a1], [.., a2], [.., a3]] = self.a;
        let ends = a0.max(a0 + a1 + a2 + a3);
        let inner = (a0 + a1 / 3.0).max(a0 + (2.0 * a1 + a2) / 3.0);
        ends.max(inner).max(0.0)
    }

    /// The farthest that the segment reaches from its anchor, at most.
    pub(super) fn reach(&self) -> f32 {
        let far = |b: [f32; 4]| vec3(b[0], b[1], b[2]).length() + b[3].max(0.0);
        self.hull().map(far).into_iter().fold(0.0, f32::max)
    }

    /// The point at `u`.
    pub(super) fn at(&self, u: f64) -> CubicPoint {
        let mut v = [[0.0; 4]; 3];
        for i in 0..4 {
            let [a, b, c, d] = self.a.map(|a| f64::from(a[i]));
            v[0][i] = a + u * (b + u * (c + u * d));
            v[1][i] = b + u * (2.0 * c + 3.0 * u * d);
            v[2][i] = 2.0 * c + 6.0 * u * d;
        }
        let xyz = |v: [f64; 4]| vec3(v[0], v[1], v[2]);
        CubicPoint {
            p: Vec3::from(self.anchor).to_f64() + xyz(v[0]),
            dp: xyz(v[1]),
            ddp: xyz(v[2]),
            r: v[0][3].max(0.0),
            dr: v[1][3],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const P: [[f32; 4]; 4] =
        [[5.0, 0.0, 1.0, 0.1], [6.0, 2.0, 1.5, 0.2], [7.5, 2.5, 0.0, 0.15], [8.0, 1.0, -1.0, 0.05]];

    /// Where each basis begins and ends, from its definition.
    #[test]
    fn bases_interpolate_what_they_should() {
        let mix = |w: [f64; 4]| {
            let mut p = Vec3::splat(0.0);
            for (q, w) in P.iter().zip(w) {
                p += vec3(q[0], q[1], q[2]).to_f64() * w;
            }
            p
        };
        let cases = [
            (CurveBasis::Linear, [1., 0., 0., 0.], [0., 1., 0., 0.]),
            (CurveBasis::Bezier, [1., 0., 0., 0.], [0., 0., 0., 1.]),
            (CurveBasis::CatmullRom, [0., 1., 0., 0.], [0., 0., 1., 0.]),
            (CurveBasis::BSpline, [1. / 6., 4. / 6., 1. / 6., 0.], [0., 1. / 6., 4. / 6., 1. / 6.]),
        ];
        for (basis, first, last) in cases {
            let c = Cubic::new(basis, &P);
            for (u, w) in [(0.0, first), (1.0, last)] {
                let miss = (c.at(u).p - mix(w)).length();
                assert!(miss < 2e-6, "{basis:?} misses its end at {u} by {miss}");
            }
        }
    }

    #[test]
    fn parts_are_parts_of_the_whole() {
        let c = Cubic::new(CurveBasis::BSpline, &P);
        let part = c.part([0.25, 0.5]);
        for u in [0.0, 0.3, 1.0] {
            let (a, b) = (part.at(u), c.at(0.25 + 0.25 * u));
            assert!((a.p - b.p).length() < 1e-6 && (a.dp - b.dp * 0.25).length() < 1e-6);
            assert!((a.r - b.r).abs() < 1e-7);
        }
    }

    #[test]
    fn hulls_hold_the_curve() {
        let c = Cubic::new(CurveBasis::CatmullRom, &P);
        let hull = c.hull();
        for i in 0..=20 {
            let (u, p) = (f64::from(i) / 20.0, c.at(f64::from(i) / 20.0));
            assert!(p.r <= f64::from(c.largest_radius()));
            let rel = p.p - Vec3::from(c.anchor).to_f64();
            for axis in 0..3 {
                let lo = hull.iter().map(|b| f64::from(b[axis])).fold(f64::INFINITY, f64::min);
                let hi = hull.iter().map(|b| f64::from(b[axis])).fold(f64::NEG_INFINITY, f64::max);
                assert!((lo - 1e-6..=hi + 1e-6).contains(&rel[axis]), "axis {axis} at {u}");
            }
        }
    }
}
