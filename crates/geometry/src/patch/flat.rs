//! Patches that are parallelograms: [`Flat`].

use sparrow_math::Vec3;

use super::Bilinear;
use crate::bvh::gamma;
use crate::point::SurfacePoint;
use crate::ray::Hit;
use crate::sample::{Edges, Rectangle};

/// A parallelogram, with what its points have in common worked out once.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flat {
    pub(super) edges: Edges,
    pub(super) area: f64,
    /// Unit normal, turned as the orientation says.
    pub(super) n: Vec3<f32>,
    /// Derivatives of the point by the parameters.
    pub(super) derivatives: [Vec3<f32>; 2],
    /// Bound of the rounding error of a point.
    pub(super) p_error: Vec3<f32>,
    /// The same for directions drawn to it, if its angles are right ones.
    pub(super) rectangle: Option<Rectangle>,
}

/// Bound of the rounding error of a point, which covers what a parallelogram is taken to be flat.
pub(super) fn p_error([a, b, c, d]: [Vec3<f32>; 4]) -> Vec3<f32> {
    a.abs().max(b.abs()).max(c.abs().max(d.abs())) * gamma(6)
}

impl Flat {
    /// The parallelogram closest to a patch whose fourth corner misses by rounding only.
    pub(super) fn new(p: [Vec3<f32>; 4], flip: bool) -> Flat {
        let [a, b, c, d] = p.map(Vec3::to_f64);
        let (e, f) = ((b - a + (d - c)) * 0.5, (c - a + (d - b)) * 0.5);
        // The miss is spread over all corners, a quarter each.
        let corner = (a + b + c + d) * 0.25 - (e + f) * 0.5;
        let edges = Edges::new(corner, e, f);
        let n = Bilinear::new(p).normal(0.5, 0.5);
        Flat {
            edges,
            area: edges.area(),
            n: if flip { -n } else { n }.to_f32(),
            derivatives: [0, 1].map(|i: usize| (edges.axes[i] * edges.lengths[i]).to_f32()),
            p_error: p_error(p),
            rectangle: (e.dot(f).abs() <= 1e-5 * e.length() * f.length()).then(|| Rectangle::new(&edges)),
        }
    }
    /// The point at parameters of the patch.
    #[inline(always)]
    pub(super) fn at(&self, u: f32, v: f32) -> Vec3<f32> {
        let [lx, ly] = self.edges.lengths;
        self.edges.at([f64::from(u) * lx, f64::from(v) * ly]).to_f32()
    }
    /// The parameters of a point of the parallelogram.
    pub(super) fn parameters_of(&self, p: Vec3<f32>) -> [f32; 2] {
        let Edges { corner, axes: [ax, ay], lengths: [lx, ly] } = self.edges;
        let at = p.to_f64() - corner;
        [(at.dot(ax) / lx) as f32, (at.dot(ay) / ly) as f32]
    }
    /// Bound of the rounding error of a point that is drawn in single precision: thirteen roundings of the largest coordinate,
    /// and what [`p_error`] covers.
    #[inline(always)]
    pub(super) fn p_error_of_samples(&self) -> Vec3<f32> {
        self.p_error * 4.0
    }
    /// The surface at a hit, where the mesh says nothing of shading and textures.
    #[inline(always)]
    pub(super) fn surface(&self, hit: &Hit) -> SurfacePoint {
        let [dpdu, dpdv] = self.derivatives;
        SurfacePoint {
            p: self.at(hit.u, hit.v),
            p_error: self.p_error,
            ng: self.n,
            ns: self.n,
            dpdu,
            dpdv,
            uv: [hit.u, hit.v],
            tangent: dpdu,
            shape: hit.shape,
            prim: hit.prim,
            time: 0.0,
        }
    }
}
