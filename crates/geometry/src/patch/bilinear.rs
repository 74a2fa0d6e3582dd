//! The bilinear surface through four points, in double precision: [`Bilinear`].

use sparrow_math::Vec3;

/// `p00 + u e10 + v e01 + u v twist`
pub(super) struct Bilinear {
    p00: Vec3<f64>,
    e10: Vec3<f64>,
    e01: Vec3<f64>,
    twist: Vec3<f64>,
}

/// Where a line meets the surface, extended beyond its edges.
pub(super) struct Root {
    pub(super) t: f64,
    pub(super) u: f64,
    pub(super) v: f64,
}

impl Root {
    pub(super) fn is_inside(&self) -> bool {
        (0.0..=1.0).contains(&self.u) && (0.0..=1.0).contains(&self.v)
    }
}

impl Bilinear {
    /// Corners in the order p00, p10, p01, p11.
    pub(super) fn new(p: [Vec3<f32>; 4]) -> Bilinear {
        let [a, b, c, d] = p.map(Vec3::to_f64);
        Bilinear { p00: a, e10: b - a, e01: c - a, twist: d - b - (c - a) }
    }
    pub(super) fn at(&self, u: f64, v: f64) -> Vec3<f64> {
        self.p00 + self.e10 * u + (self.e01 + self.twist * u) * v
    }
    /// Derivatives by `u` and `v`.
    pub(super) fn derivatives(&self, u: f64, v: f64) -> (Vec3<f64>, Vec3<f64>) {
        (self.e10 + self.twist * v, self.e01 + self.twist * u)
    }
    /// Area element `|dp/du x dp/dv|`.
    pub(super) fn stretch(&self, u: f64, v: f64) -> f64 {
        let (du, dv) = self.derivatives(u, v);
        du.cross(dv).length()
    }
    /// Unit normal. Where an edge has shrunk to a point, that of the surface nearby.
    pub(super) fn normal(&self, u: f64, v: f64) -> Vec3<f64> {
        let (du, dv) = self.derivatives(u, v);
        let n = du.cross(dv);
        if n.length2() > 0.0 {
            return n.normalized();
        }
        let (du, dv) = self.derivatives(0.999 * u + 0.0005, 0.999 * v + 0.0005);
        du.cross(dv).normalized()
    }
    /// Derivatives of the unit normal: those of `du x dv`, less their change of length.
    pub(super) fn normal_derivatives(&self, u: f64, v: f64) -> (Vec3<f32>, Vec3<f32>) {
        let (du, dv) = self.derivatives(u, v);
        let n = du.cross(dv);
        let len = n.length();
        if len <= 0.0 {
            return (Vec3::splat(0.0), Vec3::splat(0.0));
        }
        let n = n / len;
        let unit = |d: Vec3<f64>| ((d - n * n.dot(d)) / len).to_f32();
        (unit(du.cross(self.twist)), unit(self.twist.cross(dv)))
    }
    /// Area, by Gauss's rule with five points an axis; exact where the patch is flat and does not fold.
    pub(super) fn area(&self) -> f64 {
        const X: [f64; 5] =
            [0.046_910_077_030_668, 0.230_765_344_947_158, 0.5, 0.769_234_655_052_842, 0.953_089_922_969_332];
        const W: [f64; 5] = [
            0.118_463_442_528_095,
            0.239_314_335_249_683,
            0.284_444_444_444_444,
            0.239_314_335_249_683,
            0.118_463_442_528_095,
        ];
        let row = |u: f64| X.iter().zip(W).map(|(&v, w)| w * self.stretch(u, v)).sum::<f64>();
        X.iter().zip(W).map(|(&u, w)| w * row(u)).sum()
    }

    /// Where the line `o + t d` meets the surface, the nearer point first. [Reshetov2019]
    ///
    /// The line is coplanar with the surface's straight line of fixed `u` where a quadratic in `u` vanishes; `v` and
    /// `t` then follow from the points in which these two lines come closest.
    pub(super) fn roots(&self, o: Vec3<f64>, d: Vec3<f64>) -> [Option<Root>; 2] {
        let q = self.p00 - o;
        let (q_d, e_d) = (q.cross(d), self.e10.cross(d));
        let a = q_d.dot(self.e01);
        let b = q_d.dot(self.twist) + e_d.dot(self.e01);
        let c = e_d.dot(self.twist);
        let disc = b * b - 4.0 * a * c;
        if disc < 0.0 || disc.is_nan() {
            return [None, None];
        }
        let s = -0.5 * (b + disc.sqrt().copysign(b));
        let at = |u: f64| {
            let along = self.e01 + self.twist * u;
            let start = q + self.e10 * u;
            let n = d.cross(along);
            let m = n.cross(start);
            let inv = 1.0 / n.length2();
            let root = Root { t: m.dot(along) * inv, u, v: m.dot(d) * inv };
            (root.t.is_finite() && root.v.is_finite()).then_some(root)
        };
        let (r1, r2) = (at(s / c), at(a / s));
        match (&r1, &r2) {
            (Some(x), Some(y)) if y.t < x.t => [r2, r1],
            _ => [r1, r2],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_math::vec3;

    fn saddle() -> Bilinear {
        Bilinear::new([vec3(0.0, 0.0, 0.0), vec3(1.0, 0.0, 1.0), vec3(0.0, 1.0, 1.0), vec3(1.0, 1.0, 0.0)])
    }
    /// A line through two points of the surface gives back their parameters.
    #[test]
    fn line_through_two_points() {
        let s = saddle();
        let (p, q) = (s.at(0.2, 0.7), s.at(0.9, 0.1));
        let o = p + (p - q);
        let roots: Vec<Root> = s.roots(o, q - p).into_iter().flatten().collect();
        assert_eq!(roots.len(), 2);
        for (r, [t, u, v]) in roots.iter().zip([[1.0, 0.2, 0.7], [2.0, 0.9, 0.1]]) {
            assert!(
                (r.t - t).abs() < 1e-6 && (r.u - u).abs() < 1e-6 && (r.v - v).abs() < 1e-6,
                "{} {} {}",
                r.t,
                r.u,
                r.v
            );
        }
    }
    /// The derivative of the normal is what differences of normals say.
    #[test]
    fn normal_changes() {
        let s = saddle();
        let (du, dv) = s.normal_derivatives(0.3, 0.6);
        let h = 1e-5;
        let by_u = (s.normal(0.3 + h, 0.6) - s.normal(0.3 - h, 0.6)) / (2.0 * h);
        let by_v = (s.normal(0.3, 0.6 + h) - s.normal(0.3, 0.6 - h)) / (2.0 * h);
        assert!((by_u - du.to_f64()).length() < 1e-5 && (by_v - dv.to_f64()).length() < 1e-5);
    }
    /// z = x + y - 2xy over the unit square; area from 200 x 200 midpoints.
    #[test]
    fn saddle_area() {
        let s = saddle();
        let n = 200;
        let mid = |i: i32| (f64::from(i) + 0.5) / f64::from(n);
        let sum: f64 =
            (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).map(|(i, j)| s.stretch(mid(i), mid(j))).sum();
        assert!((s.area() / (sum / f64::from(n * n)) - 1.0).abs() < 1e-4);
    }
}
