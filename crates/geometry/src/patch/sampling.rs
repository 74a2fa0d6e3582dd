//! Drawing points of patches.

use sparrow_math::Vec3;

use super::flat::Flat;
use super::surface::Place;
use super::{Bilinear, Kind, Patches};
use crate::point::ShapeSample;
use crate::sample::{Bilinear as Density, Draw, PdfColumns, Rectangle, SampleColumns, Viewpoint, seen_from};

/// Close to uniform by area: the area elements at the corners.
fn by_area(p: &Bilinear) -> Density<f64> {
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
        let [u, v] = density.sample(u.map(f64::from));
        let pdf = density.pdf([u, v]) / patch.stretch(u, v);
        pdf.is_finite().then(|| self.sample_at(prim, [u as f32, v as f32], pdf))
    }
    /// The rectangle to which directions are drawn, if the patch is one.
    #[inline]
    fn rectangle(&self, prim: u32) -> Option<(&Flat, &Rectangle)> {
        let flat = self.flat(prim)?;
        Some((flat, flat.rectangle.as_ref()?))
    }
    pub(crate) fn is_rectangle(&self, prim: u32) -> bool {
        self.rectangle(prim).is_some()
    }
    /// The normal of a rectangle at a point of it.
    #[inline]
    fn normal_at(&self, prim: u32, flat: &Flat, p: Vec3<f32>) -> Vec3<f32> {
        if self.mesh.n.is_empty() {
            return flat.n;
        }
        let [u, v] = flat.parameters_of(p);
        self.shading_normal(prim, u, v).map_or(flat.n, |ns| flat.n.facing(ns))
    }
    #[inline]
    pub(crate) fn sample_from(&self, prim: u32, from: &Viewpoint, u: [f32; 2]) -> Option<ShapeSample> {
        let Some((flat, r)) = self.rectangle(prim) else {
            return seen_from(self.sample_area(prim, u)?, from.p);
        };
        let drawn = r.draw_one(from, u);
        drawn.sample(flat.p_error_of_samples(), self.normal_at(prim, flat, drawn.p))
    }
    /// [`sample_from`](Self::sample_from) from each of `n` viewpoints: the error of the points, or none where the patch is no
    /// rectangle.
    pub(crate) fn sample_from_many(
        &self,
        prim: u32,
        columns: &mut SampleColumns<'_>,
        n: usize,
    ) -> Option<Vec3<f32>> {
        let (flat, r) = self.rectangle(prim)?;
        columns.draw(r, n);
        if self.mesh.n.is_empty() {
            columns.set_normal(n, flat.n);
        } else {
            columns.set_normals(n, |p| self.normal_at(prim, flat, p));
        }
        Some(flat.p_error_of_samples())
    }
    /// [`pdf_from`](Self::pdf_from) of `n` directions; false where the patch is no rectangle.
    pub(crate) fn pdf_from_many(&self, prim: u32, columns: &mut PdfColumns<'_>, n: usize) -> bool {
        self.rectangle(prim).map(|(_, r)| columns.fill(r, n)).is_some()
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
        if let Some((_, r)) = self.rectangle(prim) {
            return r.pdf_one(from, hit_p);
        }
        if let Some(flat) = self.flat(prim) {
            return per_area(1.0 / flat.area);
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
