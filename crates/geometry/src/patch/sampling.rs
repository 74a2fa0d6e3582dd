//! Drawing points of patches.

use sparrow_math::Vec3;

use super::{Bilinear, Kind, Patches};
use crate::point::ShapeSample;
use crate::sample::{SphericalRectangle, seen_from};

/// Rectangles are drawn by area where they fill less of the sphere than this; value of pbrt-v4.
const MIN_SOLID_ANGLE: f64 = 1e-4;

/// A density on the unit square that is bilinear between its values at the corners.
struct Density([f64; 4]);

/// Draws from the density on [0, 1] that runs from `a` to `b`.
fn sample_linear(u: f64, a: f64, b: f64) -> f64 {
    let x = u * (a + b) / (a + (a * a + u * (b * b - a * a)).sqrt());
    if x.is_finite() { x.min(1.0) } else { u }
}

impl Density {
    /// Close to uniform by area: the area elements at the corners.
    fn of(p: &Bilinear) -> Density {
        let w = [p.stretch(0.0, 0.0), p.stretch(1.0, 0.0), p.stretch(0.0, 1.0), p.stretch(1.0, 1.0)];
        Density(if w.iter().sum::<f64>() > 0.0 { w } else { [1.0; 4] })
    }
    fn sample(&self, u: [f32; 2]) -> [f64; 2] {
        let [w00, w10, w01, w11] = self.0;
        let y = sample_linear(u[1].into(), w00 + w10, w01 + w11);
        let x = sample_linear(u[0].into(), w00 + y * (w01 - w00), w10 + y * (w11 - w10));
        [x, y]
    }
    fn pdf(&self, u: f64, v: f64) -> f64 {
        let [w00, w10, w01, w11] = self.0;
        let at = (w00 * (1.0 - v) + w01 * v) * (1.0 - u) + (w10 * (1.0 - v) + w11 * v) * u;
        4.0 * at / (w00 + w10 + w01 + w11)
    }
}

impl Patches {
    fn usable(&self, prim: u32) -> Option<Kind> {
        self.kinds.get(prim as usize).copied().filter(|k| *k != Kind::Dropped)
    }
    pub(crate) fn area(&self, prim: u32) -> f32 {
        self.usable(prim).map_or(0.0, |_| self.bilinear(prim).area() as f32)
    }
    fn sample_at(&self, prim: u32, [u, v]: [f64; 2], pdf: f64) -> ShapeSample {
        let (u32, v32) = (u as f32, v as f32);
        let p = self.corners(prim);
        let patch = Bilinear::new(p);
        ShapeSample {
            p: patch.at(u, v).to_f32(),
            p_error: Self::p_error(p),
            n: self.oriented(patch.normal(u, v), self.shading_normal(prim, u32, v32)),
            uv: self.uv(prim, u32, v32),
            wi: Vec3::splat(0.0),
            distance: 0.0,
            pdf: pdf as f32,
        }
    }
    pub(crate) fn sample_area(&self, prim: u32, u: [f32; 2]) -> Option<ShapeSample> {
        self.usable(prim)?;
        let patch = self.bilinear(prim);
        let density = Density::of(&patch);
        let [u, v] = density.sample(u);
        let pdf = density.pdf(u, v) / patch.stretch(u, v);
        pdf.is_finite().then(|| self.sample_at(prim, [u, v], pdf))
    }
    pub(crate) fn sample_from(&self, prim: u32, from: Vec3<f32>, u: [f32; 2]) -> Option<ShapeSample> {
        let Some(r) = self.by_solid_angle(prim, from) else {
            return seen_from(self.sample_area(prim, u)?, from);
        };
        let s = self.sample_at(prim, r.sample(u), 0.0);
        let pdf = (1.0 / r.solid_angle) as f32;
        seen_from(s, from).map(|s| ShapeSample { pdf, ..s })
    }
    /// Density per steradian of [`sample_from`](Self::sample_from) for a direction that met the patch at `hit_p`
    /// with normal `hit_n`; `per_area` turns densities per area into it.
    pub(crate) fn pdf_from(
        &self,
        prim: u32,
        from: Vec3<f32>,
        hit_p: Vec3<f32>,
        hit_n: Vec3<f32>,
        per_area: impl Fn(f64) -> f32,
    ) -> f32 {
        match self.usable(prim) {
            None => 0.0,
            Some(Kind::Curved) => {
                let patch = self.bilinear(prim);
                // The line through the point along the normal finds the parameters again.
                let roots = patch.roots(hit_p.to_f64(), hit_n.to_f64()).into_iter().flatten();
                let nearest = roots.min_by(|a, b| a.t.abs().total_cmp(&b.t.abs()));
                nearest.map_or(0.0, |r| {
                    let (u, v) = (r.u.clamp(0.0, 1.0), r.v.clamp(0.0, 1.0));
                    per_area(Density::of(&patch).pdf(u, v) / patch.stretch(u, v))
                })
            }
            Some(_) => match self.by_solid_angle(prim, from) {
                Some(r) => (1.0 / r.solid_angle) as f32,
                None => per_area(1.0 / self.bilinear(prim).area()),
            },
        }
    }
    /// The rectangle on the sphere around `from`, if it is to be drawn by solid angle.
    fn by_solid_angle(&self, prim: u32, from: Vec3<f32>) -> Option<SphericalRectangle> {
        if self.usable(prim)? != Kind::Rectangle {
            return None;
        }
        let [a, b, c, _] = self.corners(prim).map(Vec3::to_f64);
        let r = SphericalRectangle::new(a, b - a, c - a, from.to_f64());
        (r.solid_angle >= MIN_SOLID_ANGLE).then_some(r)
    }
}
