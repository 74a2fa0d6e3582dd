//! Drawing points of quadrics.

use core::f64::consts::{FRAC_1_PI, TAU};

use sparrow_math::{Frame, LocalDir, Vec3, warp};

use super::{Ball, Quadric};
use crate::point::ShapeSample;
use crate::sample::seen_from;

/// Points an axis of the rule that measures areas under maps that stretch unevenly.
const AREA_STEPS: u32 = 64;

/// Density of directions drawn over the whole sphere.
const UNIFORM_SPHERE: f64 = 0.25 * FRAC_1_PI;

/// `1 - cos` of the half angle of the cone around a ball, seen from `distance`; `None` from inside.
fn one_minus_cos(radius: f64, distance: f64) -> Option<f64> {
    let sin = radius / distance;
    (sin < 1.0).then(|| {
        let sin2 = sin * sin;
        sin2 / (1.0 + (1.0 - sin2).sqrt())
    })
}

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
            p_error: Self::p_error(p),
            n: n.to_f32(),
            wi: Vec3::splat(0.0),
            distance: 0.0,
            pdf: self.pdf_area(n) as f32,
        })
    }

    /// Whole balls: uniform in the cone they fill, or over all directions from inside. Others: by area.
    pub(crate) fn sample_from(&self, from: Vec3<f32>, u: [f32; 2]) -> Option<ShapeSample> {
        let Some(ball) = &self.ball else {
            return seen_from(self.sample_area(u)?, from);
        };
        let Ball { center, radius } = *ball;
        let (from, u) = (from.to_f64(), u.map(f64::from));
        let to_center = center - from;
        let distance = to_center.length();
        let cone = one_minus_cos(radius, distance);
        let wi = match cone {
            Some(c) => {
                let frame = Frame::from_z(to_center / distance);
                frame.to_world(LocalDir::new(warp::uniform_cone(u, c)))
            }
            None => warp::uniform_sphere(u),
        };
        let pdf = self.ball_pdf(distance)?;
        let along = to_center.dot(wi);
        let half = (radius * radius - (to_center - wi * along).length2()).max(0.0).sqrt();
        let t = if cone.is_some() { along - half } else { along + half };
        let out = (wi * t - to_center).normalized();
        let (p, n) = self.on_ball(ball, out);
        (t > 0.0 && p.x.is_finite()).then(|| ShapeSample {
            p: p.to_f32(),
            p_error: Self::p_error(p),
            n: n.to_f32(),
            wi: wi.to_f32(),
            distance: t as f32,
            pdf: pdf as f32,
        })
    }
    /// Density of the directions drawn to a ball whose centre is that far; `None` where it is too small a target.
    fn ball_pdf(&self, distance: f64) -> Option<f64> {
        let radius = self.ball.as_ref()?.radius;
        let pdf = one_minus_cos(radius, distance).map_or(UNIFORM_SPHERE, |c| 1.0 / (TAU * c));
        (pdf < f64::from(f32::MAX)).then_some(pdf)
    }
    /// Density per steradian of [`sample_from`](Self::sample_from) for a direction that met the surface with world
    /// normal `n`; `per_area` turns densities per area into it.
    pub(crate) fn pdf_from(&self, from: Vec3<f32>, n: Vec3<f32>, per_area: impl Fn(f64) -> f32) -> f32 {
        match &self.ball {
            Some(ball) => {
                let pdf = self.ball_pdf((ball.center - from.to_f64()).length());
                pdf.map_or(0.0, |p| p as f32)
            }
            None => per_area(self.pdf_area(n.to_f64())),
        }
    }
}
