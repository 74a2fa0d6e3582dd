//! Directions to a rectangle. [Urena2013]

use sparrow_math::{Real, Vec3, vec3};

use super::{Bilinear, Draw, Drawn, WARPED, spread, spread_all};

/// Rectangles are drawn by area where they fill less of the sphere than this: the solid angle is a sum of angles that
/// nearly cancel, of which single precision keeps a ten-thousandth here, and all of the rectangle is nearly as far.
const MIN_SOLID_ANGLE: f64 = 3e-3;

/// An angle, held as its cosine and sine times any positive factor: sums of angles are products, which need no arc
/// function.
type Turn<R> = (R, R);

#[inline(always)]
fn times<R: Real>(a: Turn<R>, b: Turn<R>) -> Turn<R> {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}

#[inline(always)]
fn back<R: Real>(a: Turn<R>) -> Turn<R> {
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

/// A rectangle to which directions are drawn: uniformly by solid angle where it is seen large enough, else by area.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rectangle {
    corner: Vec3<f32>,
    /// Unit vectors along the edges, and their vector product.
    axes: [Vec3<f32>; 3],
    lengths: [f32; 2],
}

impl Rectangle {
    /// Of edges that are perpendicular.
    pub(crate) fn new(edges: &Edges) -> Rectangle {
        let [x, y] = edges.axes;
        Rectangle {
            corner: edges.corner.to_f32(),
            axes: [x, y, x.cross(y)].map(Vec3::to_f32),
            lengths: edges.lengths.map(|l| l as f32),
        }
    }
}

impl Draw for Rectangle {
    /// The rectangle in its frame, and the density by which its directions follow the cosine.
    type View<R: Real> = (Seen<R>, Bilinear<R>);

    #[inline(always)]
    fn view<R: Real>(&self, from: Vec3<R>, n: Option<Vec3<R>>) -> Self::View<R> {
        let seen = Seen::new(self, from);
        (seen, seen.follow_cosine(self, n))
    }
    #[inline(always)]
    fn pdf<R: Real>(&self, (seen, warp): &Self::View<R>, p: Vec3<R>) -> R {
        let at = p - spread(self.corner);
        let along = |axis: Vec3<f32>| at.dot(spread(axis)) * seen.scale;
        seen.pdf_at(warp, [along(self.axes[0]), along(self.axes[1])])
    }
    #[inline(always)]
    fn draw<R: Real>(&self, (seen, warp): &Self::View<R>, u: [R; 2]) -> Drawn<R> {
        let warped = warp.sample(u);
        let [ax, ay, az] = spread_all(self.axes);
        let (r, large) = (&seen.rectangle, seen.is_large());
        let angle = r.sample(warped);
        let area = [u[0] * (r.x[1] - r.x[0]), u[1] * (r.y[1] - r.y[0])];
        let [x, y] = [R::select(large, angle[0], area[0]), R::select(large, angle[1], area[1])];
        let d = vec3(r.x[0] + x, r.y[0] + y, seen.height);
        let (distance, unit) = (d.length(), R::ONE / seen.scale);
        let pdf = R::select(large, warp.pdf(warped) / r.solid_angle, seen.pdf_of_area(distance));
        let wi = d * (R::ONE / distance);
        Drawn {
            p: spread(self.corner) + ax * (x * unit) + ay * (y * unit),
            wi: ax * wi.x + ay * wi.y + az * wi.z,
            // The side of the vector product; its owner turns it.
            n: az,
            distance: distance * unit,
            pdf,
        }
    }
}

/// A rectangle in the frame along its edges, an observer at the origin, scaled so that no coordinate exceeds 1.
#[derive(Clone, Copy)]
pub(crate) struct Seen<R> {
    rectangle: SphericalRectangle<R>,
    /// Of the plane above the observer, signed.
    height: R,
    /// By which lengths are multiplied.
    scale: R,
}

impl<R: Real> Seen<R> {
    #[inline(always)]
    fn new(r: &Rectangle, from: Vec3<R>) -> Seen<R> {
        let axes = spread_all(r.axes);
        let [lx, ly] = [R::of(r.lengths[0].into()), R::of(r.lengths[1].into())];
        let d = spread::<R>(r.corner) - from;
        let (x0, y0, height) = (d.dot(axes[0]), d.dot(axes[1]), d.dot(axes[2]));
        let (x1, y1) = (x0 + lx, y0 + ly);
        let scale = R::ONE / x0.abs().max(x1.abs()).max(y0.abs()).max(y1.abs()).max(height.abs());
        let (x, y, height) = ([x0 * scale, x1 * scale], [y0 * scale, y1 * scale], height * scale);
        let rectangle = SphericalRectangle::new(x, y, height.abs());
        Seen { rectangle, height, scale }
    }

    /// Large enough to be drawn by solid angle.
    #[inline(always)]
    fn is_large(&self) -> R::Mask {
        self.rectangle.solid_angle.ge(R::of(MIN_SOLID_ANGLE))
    }

    /// Density per steradian at that distance where the rectangle is drawn by area.
    #[inline(always)]
    fn pdf_of_area(&self, distance: R) -> R {
        let SphericalRectangle { x, y, z, .. } = self.rectangle;
        distance * distance * distance / ((x[1] - x[0]) * (y[1] - y[0]) * z)
    }

    /// Density per steradian of a place on the rectangle.
    #[inline(always)]
    fn pdf_at(&self, warp: &Bilinear<R>, [x, y]: [R; 2]) -> R {
        let r = &self.rectangle;
        let by_angle = warp.pdf(r.invert([x, y])) / r.solid_angle;
        let distance = vec3(r.x[0] + x, r.y[0] + y, r.z).length();
        R::select(self.is_large(), by_angle, self.pdf_of_area(distance))
    }

    /// The density on the unit square by which directions follow the cosine to `n`; uniform where they need not.
    #[inline(always)]
    fn follow_cosine(&self, of: &Rectangle, n: Option<Vec3<R>>) -> Bilinear<R> {
        let Some(n) = n else { return Bilinear::new([R::ONE; 4]) };
        let s = self.rectangle.solid_angle;
        let warped = s.ge(R::of(*WARPED.start())) & s.le(R::of(*WARPED.end()));
        let [ax, ay, az] = spread_all(of.axes);
        let n = vec3(n.dot(ax), n.dot(ay), n.dot(az));
        let (c00, c10) = (self.cosine(n, 0, 0), self.cosine(n, 1, 0));
        let (c01, c11) = (self.cosine(n, 0, 1), self.cosine(n, 1, 1));
        Bilinear::of_cosines([
            R::select(warped, c00, R::ONE),
            R::select(warped, c10, R::ONE),
            R::select(warped, c01, R::ONE),
            R::select(warped, c11, R::ONE),
        ])
    }

    /// Between the direction to a corner and `n`, in the frame.
    #[inline(always)]
    fn cosine(&self, n: Vec3<R>, i: usize, j: usize) -> R {
        let r = &self.rectangle;
        vec3(r.x[i], r.y[j], self.height).dot(n) / r.corner[i][j]
    }
}

/// One over the distance of a line from the origin.
#[inline(always)]
fn inverse_distance<R: Real>(x: R, z2: R) -> R {
    R::ONE / (x * x + z2).sqrt()
}

/// A rectangle projected to the unit sphere around the origin.
#[derive(Clone, Copy)]
struct SphericalRectangle<R> {
    x: [R; 2],
    y: [R; 2],
    /// Distance of its plane.
    z: R,
    /// Distances of the corners, by x and y.
    corner: [[R; 2]; 2],
    solid_angle: R,
}

impl<R: Real> SphericalRectangle<R> {
    /// The rectangle with these sides, at distance `z`.
    #[inline(always)]
    fn new([x0, x1]: [R; 2], [y0, y1]: [R; 2], z: R) -> SphericalRectangle<R> {
        // [Urena2013, section 3.3] measures the inner angles of the rectangle's corners on the sphere. Here they are
        // taken less pi/2, as atan(x y / (z r)), which needs no normals: opposite corners add, neighbours subtract.
        let (r00, r01) = (vec3(x0, y0, z).length(), vec3(x0, y1, z).length());
        let (r10, r11) = (vec3(x1, y0, z).length(), vec3(x1, y1, z).length());
        let adding = times((z * r00, x0 * y0), (z * r11, x1 * y1));
        let subtracting = times((z * r01, x0 * y1), (z * r10, x1 * y0));
        let (c, s) = times(adding, back(subtracting));
        // The solid angle lies in [0, 2 pi]. Beyond pi the rectangle has to lie around the foot of the observer;
        // elsewhere only rounding makes it negative.
        let a = s.atan2(c);
        let zero = R::ZERO;
        let around = x0.lt(zero) & x1.gt(zero) & y0.lt(zero) & y1.gt(zero) & z.lt((x1 - x0).max(y1 - y0));
        let beyond = a.lt(zero) & around;
        let solid_angle = R::select(beyond, a + R::of(core::f64::consts::TAU), a.max(zero));
        SphericalRectangle { x: [x0, x1], y: [y0, y1], z, corner: [[r00, r01], [r10, r11]], solid_angle }
    }

    /// Place on the rectangle, as lengths along its edges, in a uniformly drawn direction.
    #[inline(always)]
    fn sample(&self, u: [R; 2]) -> [R; 2] {
        let ([x0, x1], [y0, y1], z) = (self.x, self.y, self.z);
        let ([[r00, r01], _], z2) = (self.corner, z * z);
        // One over the distances of the edges at x0, y0 and y1.
        let wx0 = inverse_distance(x0, z2);
        let (wy0, wy1) = (inverse_distance(y0, z2), inverse_distance(y1, z2));
        // z components of the normals of the planes through the observer and the edges at y0 and y1.
        let (b0, b1) = (-y0 * wy0, y1 * wy1);
        // The inner angles at the corners (x0, y1) and (x0, y0), and their sum.
        let (w01, w00) = (wx0 * wy1, wx0 * wy0);
        let last = times((x0 * y1 * w01, z * r01 * w01), (-x0 * y0 * w00, z * r00 * w00));
        let (sin, cos) = (u[0] * self.solid_angle).sin_cos();
        let (cos_au, sin_au) = times((cos, sin), back(last));
        // [Urena2013, figure 4], with fu, cu and xu put together into one fraction; 1 - b0^2 is z^2 wy0^2.
        let f = cos_au * b0 - b1;
        let g2 = f * f - z2 * (wy0 * sin_au).sqr();
        let xu = (z * (sin_au * R::ONE.copysign(f)) / g2.safe_sqrt()).clamp(x0, x1);
        let d2 = xu * xu + z2;
        // The sine of the angle to the plane of x and z runs evenly from that of y0 to that of y1; it is n / d.
        let (r0, r1) = ((d2 + y0 * y0).sqrt(), (d2 + y1 * y1).sqrt());
        let d = r0 * r1;
        let n = y0 * r1 + u[1] * (y1 * r0 - y0 * r1);
        let yv = (n * (d2 / ((d - n) * (d + n))).sqrt()).clamp(y0, y1);
        [xu - x0, yv - y0]
    }

    /// The place of the unit square that [`sample`](Self::sample) maps to that place on the rectangle.
    #[inline(always)]
    fn invert(&self, [x, y]: [R; 2]) -> [R; 2] {
        let ([x0, x1], [y0, y1], z) = (self.x, self.y, self.z);
        let (x, y) = ((x0 + x).clamp(x0, x1), (y0 + y).clamp(y0, y1));
        let part = SphericalRectangle::new([x0, x], self.y, z);
        let sine = |y: R| y / (x * x + y * y + z * z).sqrt();
        [part.solid_angle / self.solid_angle, (sine(y) - sine(y0)) / (sine(y1) - sine(y0))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle([x, y, z]: [f64; 3], [lx, ly]: [f64; 2]) -> SphericalRectangle<f64> {
        SphericalRectangle::new([x, x + lx], [y, y + ly], z.abs())
    }
    /// One face of a cube, seen from its centre, fills a sixth of the sphere.
    #[test]
    fn face_of_a_cube() {
        let r = rectangle([-1.0, -1.0, 1.0], [2.0; 2]);
        assert!((r.solid_angle - 4.0 * core::f64::consts::PI / 6.0).abs() < 1e-12, "{}", r.solid_angle);
    }
    /// Half of the directions lie in half of a symmetric rectangle.
    #[test]
    fn middle_of_a_face() {
        let [x, y] = rectangle([-1.0, -1.0, 0.3], [2.0; 2]).sample([0.5, 0.5]);
        assert!((x - 1.0).abs() < 1e-9 && (y - 1.0).abs() < 1e-9, "{x} {y}");
    }
    /// What is drawn is found again.
    #[test]
    fn inverse() {
        for (corner, lengths) in [
            ([-1.0, -1.0, 0.3], [2.0, 2.0]),
            ([0.5, -3.0, 1.0], [0.7, 4.0]),
            ([-9.0, 2.0, 0.01], [20.0, 0.5]),
        ] {
            let r = rectangle(corner, lengths);
            for u in [[0.1, 0.9], [0.5, 0.5], [0.83, 0.02], [0.999, 0.4]] {
                let v = r.invert(r.sample(u));
                assert!((u[0] - v[0]).abs() + (u[1] - v[1]).abs() < 1e-7, "{corner:?}: {v:?} for {u:?}");
            }
        }
    }
    /// Observers beside, behind, close to the plane, far away.
    const PLACES: [(f64, f64); 6] =
        [(-0.7, -0.4), (0.3, -2.0), (-5.0, -0.1), (-1.0, -9.0), (0.2, 0.3), (0.0, -1.0)];
    const HEIGHTS: [f64; 4] = [0.01, -0.5, 3.0, 40.0];

    /// The part of the rectangle before the drawn x fills the part `u[0]` of its solid angle.
    #[test]
    fn parts_of_the_solid_angle() {
        let [lx, ly] = [1.3, 2.1];
        for (x, y) in PLACES {
            for z in HEIGHTS {
                let whole = rectangle([x, y, z], [lx, ly]);
                for u in [0.01, 0.3, 0.8, 0.99] {
                    let part = rectangle([x, y, z], [whole.sample([u, 0.5])[0], ly]);
                    let said = part.solid_angle / whole.solid_angle;
                    assert!((said - u).abs() < 1e-7, "{x} {y} {z}: {said} for {u}");
                }
            }
        }
    }
    /// Single precision, as rendered, against double: densities to a thousandth of the least solid angle that is drawn
    /// by, and both find what they drew.
    #[test]
    fn single_precision() {
        let lengths = [1.3_f32, 2.1];
        let edges = Edges::new(
            vec3(0.0, 0.0, 0.0),
            vec3(f64::from(lengths[0]), 0.0, 0.0),
            vec3(0.0, f64::from(lengths[1]), 0.0),
        );
        let r = Rectangle::new(&edges);
        let mut n_large = 0;
        for (x, y) in PLACES {
            for z in HEIGHTS {
                let from = vec3(-x as f32, -y as f32, z as f32);
                let exact = rectangle([x, y, z], lengths.map(f64::from));
                for u in [[0.1_f32, 0.9], [0.5, 0.5], [0.83, 0.02], [0.999, 0.4]] {
                    let s = r.draw(&r.view(from, None), u);
                    let again = r.pdf(&r.view(from, None), s.p);
                    assert!((s.pdf / again - 1.0).abs() < 1e-5, "{from:?} {u:?}: {} and {again}", s.pdf);
                    let off = (from + s.wi * s.distance - s.p).length();
                    assert!(off < 1e-6 * from.length() && s.p.z.abs() < 1e-6, "{from:?} {u:?}: {off}");
                    if exact.solid_angle < 1.01 * MIN_SOLID_ANGLE {
                        continue;
                    }
                    n_large += 1;
                    assert!((f64::from(s.pdf) * exact.solid_angle - 1.0).abs() < 3e-4, "{from:?}: {}", s.pdf);
                    let v = exact.invert([s.p.x.into(), s.p.y.into()]);
                    let off = (v[0] - f64::from(u[0])).abs() + (v[1] - f64::from(u[1])).abs();
                    assert!(off < 1e-3, "{from:?}: {v:?} for {u:?}");
                }
            }
        }
        assert!(n_large >= 60, "{n_large}");
    }
}
