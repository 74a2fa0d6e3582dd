//! The axis of a strand, before it is wound.

use sparrow_math::{Real, Vec3};
use sparrow_stats::Random;

use crate::body::Body;
use crate::surface::Root;
use crate::{Style, unit_or_up};

/// Points from root to tip.
pub(crate) struct Axis(Vec<Vec3<f64>>);

/// How often a step that was pushed out of the body is given its length again.
const N_TURNS: u32 = 4;

/// How a strand keeps away from a body.
pub(crate) struct Space<'a> {
    pub(crate) body: &'a Body,
    /// Distance that the strand keeps, from its first quarter on; less before, nothing at the root.
    pub(crate) keep: f64,
}

impl Space<'_> {
    /// Point `k` of `n` and the root, moved out of the body.
    pub(crate) fn free(&self, p: Vec3<f64>, k: usize, n: usize) -> Option<Vec3<f64>> {
        let grown = (4.0 * k as f64 / n as f64).min(1.0);
        if k == 0 { None } else { self.body.pushed_out(p, self.keep * grown) }
    }
}

impl Axis {
    /// Steps of equal length, each turned a little by gravity and noise, and then along the body where it would enter it.
    pub(crate) fn grow(root: &Root, style: &Style, space: &Space<'_>, random: &mut Random) -> Axis {
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
            let next =
                along_body(p, d * step, |q| space.free(q, usize::from(k) + 1, usize::from(style.n_segments)));
            if let Some(next) = next {
                d = unit_or_up(next - p);
                p = next;
            } else {
                p += d * step;
            }
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

/// Where a step from `p` ends that is turned until `free` moves it no more; none where it need not turn. In a corner, where turning
/// does not help, the step is shortened.
fn along_body(
    p: Vec3<f64>,
    step: Vec3<f64>,
    free: impl Fn(Vec3<f64>) -> Option<Vec3<f64>>,
) -> Option<Vec3<f64>> {
    let mut out = free(p + step)?;
    for _ in 0..N_TURNS {
        let turned = p + unit_or_up(out - p) * step.length();
        match free(turned) {
            Some(moved) => out = moved,
            None => return Some(turned),
        }
    }
    Some(out)
}
