//! Uniform directions to a rectangle. [Urena2013]

use sparrow_math::{Real, Vec3};

/// An angle, held as its cosine and sine: sums of angles are products, which need no arc function.
type Turn = (f64, f64);

fn times(a: Turn, b: Turn) -> Turn {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}

/// The angle in [0, pi] with this cosine.
fn with_cos(c: f64) -> Turn {
    (c, ((1.0 - c) * (1.0 + c)).max(0.0).sqrt())
}

/// A rectangle projected to the unit sphere around an observer.
pub(crate) struct SphericalRectangle {
    /// The rectangle in the frame along its edges, the observer at the origin.
    x: [f64; 2],
    y: [f64; 2],
    z: f64,
    /// z component of the normals of the planes through the observer and the edges at y0 and y1.
    b: [f64; 2],
    /// The sum of the last two inner angles.
    last: Turn,
    pub(crate) solid_angle: f64,
}

impl SphericalRectangle {
    /// The rectangle at `corner` with edges `ex` and `ey`, which are perpendicular.
    pub(crate) fn new(
        corner: Vec3<f64>,
        ex: Vec3<f64>,
        ey: Vec3<f64>,
        from: Vec3<f64>,
    ) -> SphericalRectangle {
        let d = corner - from;
        let (lx, ly) = (ex.length(), ey.length());
        let (x0, y0) = (d.dot(ex) / lx, d.dot(ey) / ly);
        let z = -d.dot(ex.cross(ey)).abs() / (lx * ly);
        let (x1, y1) = (x0 + lx, y0 + ly);
        let slope = |a: f64| a / (a * a + z * z).sqrt();
        // [Urena2013, section 3.3]: the normals' z components, and from them the inner angles.
        let n = [-slope(y0), slope(x1), slope(y1), -slope(x0)];
        let angle = |i: usize| with_cos(-n[i] * n[(i + 1) % 4]);
        let last = times(angle(2), angle(3));
        let (c, s) = times(times(angle(0), angle(1)), last);
        // The solid angle is the sum of the angles less 2 pi, in [0, 2 pi]. Beyond pi it has to lie around the foot
        // of the observer; elsewhere only rounding makes it negative.
        let a = Real::atan2(s, c);
        let below = x0 < 0.0 && x1 > 0.0 && y0 < 0.0 && y1 > 0.0 && -z < lx.max(ly);
        let solid_angle = if a < 0.0 && below { a + core::f64::consts::TAU } else { a.max(0.0) };
        SphericalRectangle { x: [x0, x1], y: [y0, y1], z, b: [n[0], n[2]], last, solid_angle }
    }

    /// Place on the rectangle, along its edges in [0, 1], in a uniformly drawn direction.
    pub(crate) fn sample(&self, u: [f32; 2]) -> [f64; 2] {
        let ([x0, x1], [y0, y1], z) = (self.x, self.y, self.z);
        let (sin, cos) = Real::sin_cos(f64::from(u[0]) * self.solid_angle);
        let (cos_au, sin_au) = times((cos, sin), (self.last.0, -self.last.1));
        let fu = (cos_au * self.b[0] - self.b[1]) / sin_au;
        let cu = (1.0 / (fu * fu + self.b[0] * self.b[0]).sqrt()).copysign(fu);
        let cu = Real::clamp(cu, -1.0, 1.0);
        let xu = Real::clamp(-cu * z / (1.0 - cu * cu).sqrt(), x0, x1);
        let d2 = xu * xu + z * z;
        let h = |y: f64| y / (d2 + y * y).sqrt();
        let (h0, h1) = (h(y0), h(y1));
        let hv = h0 + f64::from(u[1]) * (h1 - h0);
        let yv = Real::clamp(hv * (d2 / (1.0 - hv * hv)).sqrt(), y0, y1);
        [(xu - x0) / (x1 - x0), (yv - y0) / (y1 - y0)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_math::vec3;

    /// One face of a cube, seen from its centre, fills a sixth of the sphere.
    #[test]
    fn face_of_a_cube() {
        let r = SphericalRectangle::new(
            vec3(-1.0, -1.0, 1.0),
            vec3(2.0, 0.0, 0.0),
            vec3(0.0, 2.0, 0.0),
            Vec3::splat(0.0),
        );
        assert!((r.solid_angle - 4.0 * core::f64::consts::PI / 6.0).abs() < 1e-12, "{}", r.solid_angle);
    }
    /// Half of the directions lie in half of a symmetric rectangle.
    #[test]
    fn middle_of_a_face() {
        let r = SphericalRectangle::new(
            vec3(-1.0, -1.0, 0.3),
            vec3(2.0, 0.0, 0.0),
            vec3(0.0, 2.0, 0.0),
            Vec3::splat(0.0),
        );
        let [x, y] = r.sample([0.5, 0.5]);
        assert!((x - 0.5).abs() < 1e-9 && (y - 0.5).abs() < 1e-9, "{x} {y}");
    }
}
