//! Drawing points of quadrics.

use sparrow_math::Vec3;

use super::{Quadric, p_error};
use crate::point::ShapeSample;
use crate::sample::{self, Draw, PdfColumns, SampleColumns, Viewpoint, seen_from};

/// Points an axis of the rule that measures areas under maps that stretch unevenly.
const AREA_STEPS: u32 = 64;

impl Quadric {
    /// World-space area of a unit of object-space area with object-space unit normal `n`.
    fn stretch(&self, n: Vec3<f64>) -> f64 {
        self.volume * self.to_object.transposed(n).length()
    }
    /// Exact where the map stretches the surface evenly, else by the midpoint rule, to some 1e-3.
    pub(super) fn world_area(&self) -> f64 {
        let area = self.form.area();
        let mid = |i: u32| (f64::from(i) + 0.5) / f64::from(AREA_STEPS);
        let at = |u: [f64; 2]| self.stretch(self.form.local(self.form.sample(u)).n);
        let first = at([0.5, 0.5]);
        if self.to_world.uniform_scale().is_some() {
            return area * first;
        }
        let cells = (0..AREA_STEPS).flat_map(|i| (0..AREA_STEPS).map(move |j| [mid(i), mid(j)]));
        area * cells.map(at).sum::<f64>() / f64::from(AREA_STEPS * AREA_STEPS)
    }
    pub(crate) fn area(&self) -> f32 {
        self.area as f32
    }
    /// Density per world-space area of a point drawn uniformly in object space, with world-space normal `n`.
    fn pdf_area(&self, n: Vec3<f64>) -> f64 {
        // The transposed map of points brings the normal back; its length undoes the stretch.
        self.to_world.transposed(n).length() / (self.volume * self.form.area())
    }
    pub(crate) fn sample_area(&self, u: [f32; 2]) -> Option<ShapeSample> {
        let l = self.form.local(self.form.sample(u.map(f64::from)));
        let (p, n) = (self.to_world.point(l.p), self.world_normal(l.n));
        Some(ShapeSample {
            p: p.to_f32(),
            p_error: p_error(p),
            n: n.to_f32(),
            wi: Vec3::splat(0.0),
            distance: 0.0,
            pdf: self.pdf_area(n) as f32,
        })
    }

    /// Whole balls: uniform in the cone they fill, or over all directions from inside. Others: by area.
    #[inline]
    pub(crate) fn sample_from(&self, from: &Viewpoint, u: [f32; 2]) -> Option<ShapeSample> {
        match &self.ball {
            Some(ball) => {
                let drawn = ball.single.draw_one(from, u);
                drawn.sample(ball.single.p_error(), if self.flip { -drawn.n } else { drawn.n })
            }
            None => seen_from(self.sample_area(u)?, from.p),
        }
    }
    /// The whole ball that this is, if it is one, and whether its normals point inwards.
    pub(crate) fn drawn_ball(&self) -> Option<(&sample::Ball, bool)> {
        self.ball.as_ref().map(|ball| (&ball.single, self.flip))
    }
    /// [`sample_from`](Self::sample_from) from each of `n` viewpoints: the error of the points, or none where this is no whole ball.
    pub(crate) fn sample_from_many(&self, columns: &mut SampleColumns<'_>, n: usize) -> Option<Vec3<f32>> {
        let ball = self.ball.as_ref()?;
        columns.draw(&ball.single, n);
        if self.flip {
            columns.on.iter_mut().flat_map(|c| &mut c[..n]).for_each(|x| *x = -*x);
        }
        Some(ball.single.p_error())
    }
    /// Density per steradian of [`sample_from`](Self::sample_from) for a direction that met the surface with world
    /// normal `n`; `per_area` turns densities per area into it.
    pub(crate) fn pdf_from(&self, from: &Viewpoint, n: Vec3<f32>, per_area: impl Fn(f64) -> f32) -> f32 {
        match &self.ball {
            Some(ball) => ball.single.pdf_one(from, from.p),
            None => per_area(self.pdf_area(n.to_f64())),
        }
    }
    /// [`pdf_from`](Self::pdf_from) of `n` directions; false where this is no whole ball.
    pub(crate) fn pdf_from_many(&self, columns: &mut PdfColumns<'_>, n: usize) -> bool {
        self.ball.as_ref().map(|ball| columns.fill(&ball.single, n)).is_some()
    }
}
