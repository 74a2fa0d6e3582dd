//! The axis of a strand, before it is wound.

use sparrow_math::{Real, Vec3};
use sparrow_stats::Random;

use crate::surface::Root;
use crate::{Style, unit_or_up};

/// Points from root to tip.
pub(crate) struct Axis(Vec<Vec3<f64>>);

impl Axis {
    /// Steps of equal length, each turned a little by gravity and noise.
    pub(crate) fn grow(root: &Root, style: &Style, random: &mut Random) -> Axis {
        let n = f64::from(style.n_segments);
        let step = style.length * (1.0 - style.length_spread * random.uniform()) / n;
        let [a, b] = [random.direction().v(), random.direction().v()];
        let (sin_lean, cos_lean) = Real::sin_cos(style.lean_deg.to_radians());
        let mut d = match root.flow {
            Some(flow) => root.n * cos_lean + flow * sin_lean,
            None => root.n,
        };
        let mut p = root.p;
        let mut points = Vec::with_capacity(usize::from(style.n_segments) + 1);
        points.push(p);
        for k in 0..style.n_segments {
            let (s, c) = Real::sin_cos(core::f64::consts::PI * (f64::from(k) + 0.5) / n);
            d = unit_or_up(d + (style.gravity + (a * c + b * s) * style.noise) / n);
            p += d * step;
            points.push(p);
        }
        Axis(points)
    }

    pub(crate) fn root(&self) -> Vec3<f64> {
        self.0[0]
    }

    pub(crate) fn points(&self) -> &[Vec3<f64>] {
        &self.0
    }

    /// Moved towards `guide`, by nothing at the root and by `amount` of the way at the tip.
    pub(crate) fn drawn_to(&self, guide: &Axis, amount: f64) -> Axis {
        let last = (self.0.len() - 1) as f64;
        let pairs = self.0.iter().zip(&guide.0).enumerate();
        Axis(pairs.map(|(k, (&p, &q))| p + (q - p) * (amount * k as f64 / last)).collect())
    }
}
