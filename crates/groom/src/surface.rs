//! What strands grow on: [`Surface`], and places on it.

use sparrow_math::{Vec3, warp};
use sparrow_stats::Random;

use crate::{Flow, GroomError, unit_or_up};

/// A mesh of triangles.
#[derive(Clone, Copy, Debug, Default)]
pub struct Surface<'a> {
    /// Positions.
    pub p: &'a [[f32; 3]],
    /// Normals, one for each position; where there are none, faces are flat.
    pub n: &'a [[f32; 3]],
    /// Texture coordinates, one pair for each position, or none at all.
    pub uv: &'a [[f32; 2]],
    /// Triangles, as positions in `p`, counter-clockwise as seen from outside.
    pub triangles: &'a [[u32; 3]],
}

impl Surface<'_> {
    /// # Errors
    /// A face with a vertex that is missing or not finite.
    pub(crate) fn check(&self) -> Result<(), GroomError> {
        let there = |i: u32| self.p.get(i as usize).is_some_and(|p| p.iter().all(|v| v.is_finite()));
        match self.triangles.iter().position(|t| !t.iter().all(|&i| there(i))) {
            Some(face) => Err(GroomError::BadFace { face }),
            None => Ok(()),
        }
    }

    /// The corners of a triangle whose vertices exist.
    pub(crate) fn corners(&self, t: [u32; 3]) -> [Vec3<f64>; 3] {
        t.map(|i| Vec3::from(self.p[i as usize]).to_f64())
    }
}

/// Where a strand begins.
pub(crate) struct Root {
    pub(crate) p: Vec3<f64>,
    /// Unit normal.
    pub(crate) n: Vec3<f64>,
    /// Unit vector along the surface; none where the flow stands upright on it.
    pub(crate) flow: Option<Vec3<f64>>,
}

/// A surface with its area added up.
pub(crate) struct Scalp<'a> {
    surface: Surface<'a>,
    flow: &'a Flow,
    /// Area of each triangle and of all before it.
    areas: Vec<f64>,
}

impl<'a> Scalp<'a> {
    pub(crate) fn new(surface: &Surface<'a>, flow: &'a Flow) -> Result<Scalp<'a>, GroomError> {
        if surface.triangles.is_empty() {
            return Err(GroomError::NoFaces);
        }
        surface.check()?;
        if matches!(flow, Flow::U | Flow::V) && surface.uv.is_empty() {
            return Err(GroomError::NoCoordinates);
        }
        let mut scalp = Scalp { surface: *surface, flow, areas: Vec::with_capacity(surface.triangles.len()) };
        let mut sum = 0.0;
        for &t in surface.triangles {
            sum += 0.5 * scalp.cross(t).length();
            scalp.areas.push(sum);
        }
        if sum > 0.0 { Ok(scalp) } else { Err(GroomError::NoArea) }
    }

    pub(crate) fn area(&self) -> f64 {
        self.areas.last().copied().unwrap_or(0.0)
    }

    /// Root `i` of `n`, each in a share of the area of its own.
    pub(crate) fn root(&self, i: usize, n: usize, random: &mut Random) -> Root {
        let place = (i as f64 + random.uniform()) / n as f64 * self.area();
        // The first triangle whose sum passes the place has area of its own.
        let found = self.areas.partition_point(|&a| a <= place).min(self.areas.len() - 1);
        let t = self.surface.triangles[found];
        let [b0, b1] = warp::uniform_triangle([random.uniform(), random.uniform()]);
        let b = [b0, b1, 1.0 - b0 - b1];
        let [p0, p1, p2] = self.surface.corners(t);
        let p = p0 * b[0] + p1 * b[1] + p2 * b[2];
        let n = self.normal(t, b);
        Root { p, n, flow: self.flow(t, p, n) }
    }

    /// Vector product of two sides.
    fn cross(&self, t: [u32; 3]) -> Vec3<f64> {
        let [a, b, c] = self.surface.corners(t);
        (b - a).cross(c - a)
    }

    /// The interpolated normal; that of the face where it has no direction.
    fn normal(&self, t: [u32; 3], b: [f64; 3]) -> Vec3<f64> {
        let corner = |k: usize| self.surface.n.get(t[k] as usize).map(|n| Vec3::from(*n).to_f64() * b[k]);
        let n = match (corner(0), corner(1), corner(2)) {
            (Some(x), Some(y), Some(z)) => x + y + z,
            _ => Vec3::splat(0.0),
        };
        if n.length() > 0.0 && n.length().is_finite() { n / n.length() } else { unit_or_up(self.cross(t)) }
    }

    fn flow(&self, t: [u32; 3], p: Vec3<f64>, n: Vec3<f64>) -> Option<Vec3<f64>> {
        let v = match *self.flow {
            Flow::Along(v) => v,
            Flow::From(from) => p - from,
            Flow::Parting([a, b]) => {
                let t = (p - a).dot(b - a) / (b - a).length2();
                p - (a + (b - a) * t.clamp(0.0, 1.0))
            }
            Flow::Around(axis) => axis.cross(p),
            Flow::U => self.gradient(t, 0),
            Flow::V => self.gradient(t, 1),
        };
        let along = v - n * v.dot(n);
        // What is left of a vector along the normal is rounding.
        (along.length() > 1e-9 * v.length()).then(|| along / along.length())
    }

    /// The gradient of a texture coordinate over the face, of any length; its direction is that in which the coordinate grows
    /// fastest.
    fn gradient(&self, t: [u32; 3], k: usize) -> Vec3<f64> {
        let [a, b, c] = self.surface.corners(t);
        let n = self.cross(t);
        let at = |i: usize| self.surface.uv.get(t[i] as usize).map_or(0.0, |uv| f64::from(uv[k]));
        n.cross(c - b) * at(0) + n.cross(a - c) * at(1) + n.cross(b - a) * at(2)
    }
}
