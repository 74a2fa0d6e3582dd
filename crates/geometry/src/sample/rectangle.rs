//! Uniform directions to a rectangle. [Urena2013]

use sparrow_math::{Real, Vec3};

/// An angle, held as its cosine and sine times any positive factor: sums of angles are products, which need no arc
/// function.
type Turn = (f64, f64);

#[inline(always)]
fn times(a: Turn, b: Turn) -> Turn {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}

#[inline(always)]
fn back(a: Turn) -> Turn {
    (a.0, -a.1)
}

/// A parallelogram: a corner and the two edges from it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edges {
    pub(crate) corner: Vec3<f64>,
    /// Unit vectors along the edges.
    pub(crate) axes: [Vec3<f64>; 2],
    pub(crate) lengths: [f64; 2],
}

impl Edges {
    pub(crate) fn new(corner: Vec3<f64>, ex: Vec3<f64>, ey: Vec3<f64>) -> Edges {
        let (lx, ly) = (ex.length(), ey.length());
        Edges { corner, axes: [ex / lx, ey / ly], lengths: [lx, ly] }
    }
    /// The point that lies so far along the edges.
    #[inline(always)]
    pub(crate) fn at(&self, [x, y]: [f64; 2]) -> Vec3<f64> {
        self.corner + self.axes[0] * x + self.axes[1] * y
    }
    pub(crate) fn area(&self) -> f64 {
        self.lengths[0] * self.lengths[1] * self.axes[0].cross(self.axes[1]).length()
    }
}

/// A rectangle projected to the unit sphere around an observer.
pub(crate) struct SphericalRectangle {
    /// The rectangle in the frame along its edges, the observer at the origin.
    x: [f64; 2],
    y: [f64; 2],
    /// Distance of the observer from the plane.
    z: f64,
    /// `z` times the distances of the corners (x0, y0) and (x0, y1).
    at_x0: [f64; 2],
    pub(crate) solid_angle: f64,
}

impl SphericalRectangle {
    /// The rectangle with these edges, which are perpendicular.
    #[inline]
    pub(crate) fn new(edges: &Edges, from: Vec3<f64>) -> SphericalRectangle {
        let [ax, ay] = edges.axes;
        let [lx, ly] = edges.lengths;
        let d = edges.corner - from;
        let (x0, y0, z) = (d.dot(ax), d.dot(ay), d.dot(ax.cross(ay)).abs());
        SphericalRectangle::within([x0, x0 + lx], [y0, y0 + ly], z)
    }

    /// The rectangle with these sides, seen from the origin at distance `z` of its plane.
    #[inline]
    fn within([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], z: f64) -> SphericalRectangle {
        // [Urena2013, section 3.3] measures the inner angles of the rectangle's corners on the sphere. Here they are
        // taken less pi/2, as atan(x y / (z r)), which needs no normals: opposite corners add, neighbours subtract.
        let zr = |x: f64, y: f64| z * (x * x + y * y + z * z).sqrt();
        let (zr00, zr01, zr10, zr11) = (zr(x0, y0), zr(x0, y1), zr(x1, y0), zr(x1, y1));
        let adding = times((zr00, x0 * y0), (zr11, x1 * y1));
        let subtracting = times((zr01, x0 * y1), (zr10, x1 * y0));
        let (c, s) = times(adding, back(subtracting));
        // The solid angle lies in [0, 2 pi]. Beyond pi the rectangle has to lie around the foot of the observer;
        // elsewhere only rounding makes it negative.
        let a = Real::atan2(s, c);
        let below = x0 < 0.0 && x1 > 0.0 && y0 < 0.0 && y1 > 0.0 && z < (x1 - x0).max(y1 - y0);
        let solid_angle = if a < 0.0 && below { a + core::f64::consts::TAU } else { a.max(0.0) };
        SphericalRectangle { x: [x0, x1], y: [y0, y1], z, at_x0: [zr00, zr01], solid_angle }
    }

    /// Place on the rectangle, as lengths along its edges, in a uniformly drawn direction.
    #[inline]
    pub(crate) fn sample(&self, u: [f64; 2]) -> [f64; 2] {
        let ([x0, x1], [y0, y1], z) = (self.x, self.y, self.z);
        let z2 = z * z;
        // One over the distances of the edges at x0, y0 and y1.
        let (wx0, wy0, wy1) =
            (1.0 / (x0 * x0 + z2).sqrt(), 1.0 / (y0 * y0 + z2).sqrt(), 1.0 / (y1 * y1 + z2).sqrt());
        // z components of the normals of the planes through the observer and the edges at y0 and y1.
        let (b0, b1) = (-y0 * wy0, y1 * wy1);
        // The inner angles at the corners (x0, y1) and (x0, y0), and their sum.
        let (w01, w00) = (wx0 * wy1, wx0 * wy0);
        let last = times((x0 * y1 * w01, self.at_x0[1] * w01), (-x0 * y0 * w00, self.at_x0[0] * w00));
        let (sin, cos) = Real::sin_cos(u[0] * self.solid_angle);
        let (cos_au, sin_au) = times((cos, sin), back(last));
        // [Urena2013, figure 4], with fu, cu and xu put together into one fraction; 1 - b0^2 is z^2 wy0^2.
        let f = cos_au * b0 - b1;
        let g2 = f * f - z2 * (wy0 * sin_au).sqr();
        let xu = Real::clamp(z * (sin_au * 1.0_f64.copysign(f)) / g2.max(0.0).sqrt(), x0, x1);
        let d2 = xu * xu + z2;
        // The sine of the angle to the plane of x and z runs evenly from that of y0 to that of y1; it is n / d.
        let (r0, r1) = ((d2 + y0 * y0).sqrt(), (d2 + y1 * y1).sqrt());
        let d = r0 * r1;
        let n = y0 * r1 + u[1] * (y1 * r0 - y0 * r1);
        let yv = Real::clamp(n * (d2 / (d * d - n * n)).sqrt(), y0, y1);
        [xu - x0, yv - y0]
    }

    /// The place of the unit square that [`sample`](Self::sample) maps to that place on the rectangle.
    #[inline]
    pub(crate) fn invert(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let ([x0, x1], [y0, y1], z) = (self.x, self.y, self.z);
        let (x, y) = (Real::clamp(x0 + x, x0, x1), Real::clamp(y0 + y, y0, y1));
        let part = SphericalRectangle::within([x0, x], self.y, z);
        let sine = |y: f64| y / (x * x + y * y + z * z).sqrt();
        [part.solid_angle / self.solid_angle, (sine(y) - sine(y0)) / (sine(y1) - sine(y0))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_math::vec3;

    fn rectangle(corner: Vec3<f64>, lengths: [f64; 2]) -> SphericalRectangle {
        let edges = Edges::new(corner, vec3(lengths[0], 0.0, 0.0), vec3(0.0, lengths[1], 0.0));
        SphericalRectangle::new(&edges, Vec3::splat(0.0))
    }
    /// One face of a cube, seen from its centre, fills a sixth of the sphere.
    #[test]
    fn face_of_a_cube() {
        let r = rectangle(vec3(-1.0, -1.0, 1.0), [2.0; 2]);
        assert!((r.solid_angle - 4.0 * core::f64::consts::PI / 6.0).abs() < 1e-12, "{}", r.solid_angle);
    }
    /// Half of the directions lie in half of a symmetric rectangle.
    #[test]
    fn middle_of_a_face() {
        let [x, y] = rectangle(vec3(-1.0, -1.0, 0.3), [2.0; 2]).sample([0.5, 0.5]);
        assert!((x - 1.0).abs() < 1e-9 && (y - 1.0).abs() < 1e-9, "{x} {y}");
    }
    /// What is drawn is found again.
    #[test]
    fn inverse() {
        for (corner, lengths) in [
            (vec3(-1.0, -1.0, 0.3), [2.0, 2.0]),
            (vec3(0.5, -3.0, 1.0), [0.7, 4.0]),
            (vec3(-9.0, 2.0, 0.01), [20.0, 0.5]),
        ] {
            let r = rectangle(corner, lengths);
            for u in [[0.1, 0.9], [0.5, 0.5], [0.83, 0.02], [0.999, 0.4]] {
                let v = r.invert(r.sample(u));
                assert!((u[0] - v[0]).abs() + (u[1] - v[1]).abs() < 1e-7, "{corner:?}: {v:?} for {u:?}");
            }
        }
    }
    /// The part of the rectangle before the drawn x fills the part `u[0]` of its solid angle, wherever the observer
    /// stands: beside, behind, close to the plane, far away.
    #[test]
    fn parts_of_the_solid_angle() {
        for (x, y) in [(-0.7, -0.4), (0.3, -2.0), (-5.0, -0.1), (-1.0, -9.0), (0.2, 0.3), (0.0, -1.0)] {
            for z in [0.01, -0.5, 3.0, 40.0] {
                let [lx, ly] = [1.3, 2.1];
                let whole = rectangle(vec3(x, y, z), [lx, ly]);
                for u in [0.01, 0.3, 0.8, 0.99] {
                    let part = rectangle(vec3(x, y, z), [whole.sample([u, 0.5])[0], ly]);
                    let said = part.solid_angle / whole.solid_angle;
                    assert!((said - u).abs() < 1e-7, "{x} {y} {z}: {said} for {u}");
                }
            }
        }
    }
}
