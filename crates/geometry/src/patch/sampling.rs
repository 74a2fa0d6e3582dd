//! Drawing points of patches.

use sparrow_math::Vec3;

use super::flat::Flat;
use super::surface::Place;
use super::{Bilinear, Kind, Patches};
use crate::point::ShapeSample;
use crate::sample::{Bilinear as Density, SphericalRectangle, Viewpoint, WARPED, direction, seen_from};

/// Rectangles are drawn by area where they fill less of the sphere than this; value of pbrt-v4.
const MIN_SOLID_ANGLE: f64 = 1e-4;

/// Close to uniform by area: the area elements at the corners.
fn by_area(p: &Bilinear) -> Density {
    Density::new([p.stretch(0.0, 0.0), p.stretch(1.0, 0.0), p.stretch(0.0, 1.0), p.stretch(1.0, 1.0)])
}

impl Patches {
    fn usable(&self, prim: u32) -> Option<Kind> {
        self.kinds.get(prim as usize).copied().filter(|k| *k != Kind::Dropped)
    }
    /// The patch as a parallelogram, if it is one.
    #[inline]
    fn flat(&self, prim: u32) -> Option<&Flat> {
        match self.kinds.get(prim as usize) {
            Some(&Kind::Flat(i)) => self.flats.get(i as usize),
            Some(Kind::Curved | Kind::Dropped) | None => None,
        }
    }
    pub(crate) fn area(&self, prim: u32) -> f32 {
        let curved = || self.usable(prim).map_or(0.0, |_| self.bilinear(prim).area());
        self.flat(prim).map_or_else(curved, |f| f.area) as f32
    }
    #[inline]
    fn sample_at(&self, prim: u32, [u, v]: [f32; 2], pdf: f64) -> ShapeSample {
        let Place { p, p_error, n, .. } = self.place(prim, u, v);
        ShapeSample {
            p,
            p_error,
            n: self.shading_normal(prim, u, v).map_or(n, |ns| n.facing(ns)),
            wi: Vec3::splat(0.0),
            distance: 0.0,
            pdf: pdf as f32,
        }
    }
    pub(crate) fn sample_area(&self, prim: u32, u: [f32; 2]) -> Option<ShapeSample> {
        if let Some(flat) = self.flat(prim) {
            return Some(self.sample_at(prim, u, 1.0 / flat.area));
        }
        self.usable(prim)?;
        let patch = self.bilinear(prim);
        let density = by_area(&patch);
        let [u, v] = density.sample(u);
        let pdf = density.pdf([u, v]) / patch.stretch(u, v);
        pdf.is_finite().then(|| self.sample_at(prim, [u as f32, v as f32], pdf))
    }
    #[inline]
    pub(crate) fn sample_from(&self, prim: u32, from: &Viewpoint, u: [f32; 2]) -> Option<ShapeSample> {
        let Some((flat, r)) = self.flat(prim).and_then(|f| Some((f, by_solid_angle(f, from.p)?))) else {
            return seen_from(self.sample_area(prim, u)?, from.p);
        };
        let (u, density) = match follow_cosine(flat, &r, from) {
            Some(warp) => {
                let u = warp.sample(u);
                (u, warp.pdf(u))
            }
            None => (u.map(f64::from), 1.0),
        };
        let s = self.sample_at(prim, flat.parameters(r.sample(u)), density / r.solid_angle);
        let (wi, distance) = direction(from.p, s.p)?;
        Some(ShapeSample { wi, distance, ..s })
    }
    /// Density per steradian of [`sample_from`](Self::sample_from) for a direction that met the patch at `hit_p`
    /// with normal `hit_n`; `per_area` turns densities per area into it.
    pub(crate) fn pdf_from(
        &self,
        prim: u32,
        from: &Viewpoint,
        hit_p: Vec3<f32>,
        hit_n: Vec3<f32>,
        per_area: impl Fn(f64) -> f32,
    ) -> f32 {
        if let Some(flat) = self.flat(prim) {
            let Some(r) = by_solid_angle(flat, from.p) else { return per_area(1.0 / flat.area) };
            let at = hit_p.to_f64() - flat.edges.corner;
            let density = follow_cosine(flat, &r, from)
                .map_or(1.0, |warp| warp.pdf(r.invert(flat.edges.axes.map(|a| at.dot(a)))));
            return (density / r.solid_angle) as f32;
        }
        if self.usable(prim).is_none() {
            return 0.0;
        }
        let patch = self.bilinear(prim);
        // The line through the point along the normal finds the parameters again.
        let roots = patch.roots(hit_p.to_f64(), hit_n.to_f64()).into_iter().flatten();
        let nearest = roots.min_by(|a, b| a.t.abs().total_cmp(&b.t.abs()));
        nearest.map_or(0.0, |r| {
            let (u, v) = (r.u.clamp(0.0, 1.0), r.v.clamp(0.0, 1.0));
            per_area(by_area(&patch).pdf([u, v]) / patch.stretch(u, v))
        })
    }
}

/// The rectangle on the sphere around `from`, if it is to be drawn by solid angle.
#[inline]
fn by_solid_angle(flat: &Flat, from: Vec3<f32>) -> Option<SphericalRectangle> {
    if !flat.is_rectangle {
        return None;
    }
    let r = SphericalRectangle::new(&flat.edges, from.to_f64());
    (r.solid_angle >= MIN_SOLID_ANGLE).then_some(r)
}

/// The density of the unit square by which directions to a rectangle follow the cosine at the viewpoint.
#[inline]
fn follow_cosine(flat: &Flat, r: &SphericalRectangle, from: &Viewpoint) -> Option<Density> {
    let n = from.n.filter(|_| WARPED.contains(&r.solid_angle))?;
    let [lx, ly] = flat.edges.lengths;
    let corners = [[0.0, 0.0], [lx, 0.0], [0.0, ly], [lx, ly]];
    Some(Density::of_cosines(n, corners.map(|at| flat.edges.at(at) - from.p.to_f64())))
}
