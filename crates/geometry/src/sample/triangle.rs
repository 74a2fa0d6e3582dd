//! Uniform directions to a triangle. [Arvo1995]

use sparrow_math::{Real, Vec3};

/// A triangle projected to the unit sphere around an observer. In double precision, because small angles cancel.
pub(crate) struct SphericalTriangle {
    /// Corners, seen from the observer.
    p: [Vec3<f64>; 3],
    /// Directions to the corners.
    dir: [Vec3<f64>; 3],
    pub(crate) solid_angle: f64,
}

/// Solid angle between three unit vectors. [VanOosteromStrackee1983, eq. 8]
fn solid_angle(a: Vec3<f64>, b: Vec3<f64>, c: Vec3<f64>) -> f64 {
    let volume = a.dot(b.cross(c)).abs();
    let angle = 2.0 * Real::atan2(volume, 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
    angle.max(0.0)
}

/// The part of `v` perpendicular to the unit vector `n`, of unit length.
fn perpendicular(v: Vec3<f64>, n: Vec3<f64>) -> Vec3<f64> {
    (v - n * n.dot(v)).normalized()
}

impl SphericalTriangle {
    /// `None` where the observer stands on a corner.
    pub(crate) fn new(p: [Vec3<f32>; 3], from: Vec3<f32>) -> Option<SphericalTriangle> {
        let p = p.map(|p| p.to_f64() - from.to_f64());
        let dir = p.map(Vec3::normalized);
        let solid_angle = solid_angle(dir[0], dir[1], dir[2]);
        solid_angle.is_finite().then_some(SphericalTriangle { p, dir, solid_angle })
    }

    /// Weights of the corners of the point in a uniformly drawn direction.
    pub(crate) fn sample(&self, u: [f64; 2]) -> Option<[f32; 3]> {
        let w = self.direction(u);
        // The point of the plane in that direction, by Cramer's rule.
        let (e1, e2) = (self.p[1] - self.p[0], self.p[2] - self.p[0]);
        let s1 = w.cross(e2);
        let inv = 1.0 / s1.dot(e1);
        let s = -self.p[0];
        let b1 = Real::clamp(s.dot(s1) * inv, 0.0, 1.0);
        let b2 = Real::clamp(w.dot(s.cross(e1)) * inv, 0.0, 1.0 - b1);
        inv.is_finite().then_some([(1.0 - b1 - b2) as f32, b1 as f32, b2 as f32])
    }

    /// The corners as the unit square has them: the whole sides at `u[1] = 0` are the second one.
    pub(crate) fn square(&self) -> [Vec3<f64>; 4] {
        let [a, b, c] = self.dir;
        [b, b, a, c]
    }

    /// The place of the unit square that [`sample`](Self::sample) maps to that direction, which need not be a unit vector.
    pub(crate) fn invert(&self, w: Vec3<f64>) -> [f64; 2] {
        let ([a, b, c], w) = (self.dir, w.normalized());
        // Where the great circle through `b` and `w` meets the opposite side.
        let met = b.cross(w).cross(c.cross(a));
        let met = (if met.dot(a + c) < 0.0 { -met } else { met }).normalized();
        if !met.x.is_finite() {
            return [0.5, 0.0];
        }
        // 1 - cos is half of the squared distance.
        let beside = solid_angle(a, b, met) / self.solid_angle;
        [beside, (w - b).length2() / (met - b).length2()]
    }

    /// Maps the unit square to directions, preserving area: `u[0]` chooses the area of the part of the triangle
    /// beside a great circle through the second corner, `u[1]` the place on that circle.
    fn direction(&self, u: [f64; 2]) -> Vec3<f64> {
        let [a, b, c] = self.dir;
        // The angle at `a` lies between the planes through its two sides.
        let (n_ab, n_ac) = (a.cross(b), a.cross(c));
        let scale = 1.0 / (n_ab.length() * n_ac.length());
        let cos_alpha = n_ab.dot(n_ac) * scale;
        let sin_alpha = n_ab.cross(n_ac).length() * scale;
        let (sin_area, cos_area) = Real::sin_cos(u[0] * self.solid_angle);
        // [Arvo1995, algorithm 1]; s and t are the sine and cosine of the chosen area less alpha.
        let s = sin_area * cos_alpha - cos_area * sin_alpha;
        let t = cos_area * cos_alpha + sin_area * sin_alpha;
        let k1 = t - cos_alpha;
        let k2 = s + sin_alpha * a.dot(b);
        let cos_side = ((k2 * t - k1 * s) * cos_alpha - k2) / ((k2 * s + k1 * t) * sin_alpha);
        // Not a number only for an area of zero, which ends at `a` itself.
        let cos_side = if cos_side.is_nan() { 1.0 } else { Real::clamp(cos_side, -1.0, 1.0) };
        let c = a * cos_side + perpendicular(c, a) * (1.0 - cos_side * cos_side).sqrt();
        let one_minus_cos = u[1] * (1.0 - c.dot(b));
        let sin = (one_minus_cos * (2.0 - one_minus_cos)).max(0.0).sqrt();
        let side = perpendicular(c, b);
        if sin > 0.0 && side.x.is_finite() { b * (1.0 - one_minus_cos) + side * sin } else { b }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_math::vec3;

    /// What is drawn is found again, in small triangles as in large ones.
    #[test]
    fn inverse() {
        for p in [
            [vec3(1.0, 0.0, 0.2), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.3, 1.0)],
            [vec3(-8.0, -5.0, 0.2), vec3(9.0, -4.0, 0.1), vec3(0.0, 7.0, 0.2)],
            [vec3(0.0, 0.0, 9.0), vec3(1.0, 0.1, 9.0), vec3(0.0, 1.0, 9.5)],
        ] {
            let t = SphericalTriangle::new(p, Vec3::splat(0.0)).unwrap();
            for u in [[0.1, 0.9], [0.5, 0.5], [0.83, 0.02], [0.999, 0.4]] {
                let v = t.invert(t.direction(u));
                assert!((u[0] - v[0]).abs() + (u[1] - v[1]).abs() < 1e-7, "{p:?}: {v:?} for {u:?}");
            }
        }
    }
    /// An octant fills pi/2; a far small triangle its area over the distance squared.
    #[test]
    fn solid_angles() {
        let octant = [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)];
        let t = SphericalTriangle::new(octant, Vec3::splat(0.0)).unwrap();
        assert!((t.solid_angle - core::f64::consts::FRAC_PI_2).abs() < 1e-14);
        let small = [vec3(0.0, 0.0, 1000.0), vec3(0.01, 0.0, 1000.0), vec3(0.0, 0.01, 1000.0)];
        let t = SphericalTriangle::new(small, Vec3::splat(0.0)).unwrap();
        assert!((t.solid_angle / 0.5e-10 - 1.0).abs() < 1e-6, "{}", t.solid_angle);
    }
}
