//! Choosing one of many lights.

use sparrow_math::{Aabb, Vec3};

use super::LitPoint;
use crate::distribution::Discrete;

/// Most lights for which every choice weighs each of them.
pub(super) const WEIGH_ALL: usize = 64;

/// What is known of a light before it is sampled.
#[derive(Clone, Copy, Debug)]
pub(super) struct LightBounds {
    /// Radiant power, up to a factor common to all lights.
    pub(super) power: f32,
    /// Where it is; empty for infinite lights.
    pub(super) bounds: Aabb,
    /// Direction of emission, for lights that emit on one side of a plane.
    pub(super) facing: Option<Vec3<f32>>,
}

impl LightBounds {
    /// About how much light it sends to a point. [ContyKulla2018, eq. 3], for a leaf with a flat emitter
    ///
    /// Not zero where light may arrive: a bound, not an estimate.
    fn importance(&self, at: &LitPoint) -> f32 {
        let center = self.bounds.center();
        let r = self.bounds.radius();
        let to = center - at.p;
        let d2 = to.length2();
        // Within the bounds nothing is known of distance and angle.
        let far2 = d2.max(r * r);
        let sin2 = r * r / far2.max(1e-30);
        if d2 <= r * r {
            return self.power / far2.max(1e-30);
        }
        let d = to * (1.0 / d2.sqrt());
        let (sin_b, cos_b) = (sin2.sqrt(), (1.0 - sin2).max(0.0).sqrt());
        let widen = |cos: f32| {
            if cos >= cos_b {
                1.0
            } else {
                (cos * cos_b + (1.0 - cos * cos).max(0.0).sqrt() * sin_b).max(0.0)
            }
        };
        let emits = self.facing.map_or(1.0, |n| widen(-n.dot(d)));
        let receives = widen(at.n.dot(d).abs());
        self.power * emits * receives / far2
    }
}

/// A way to choose a light.
#[derive(Debug)]
pub enum LightSelection {
    /// By a fixed distribution: uniform, or in proportion to power.
    Fixed(Discrete),
    /// Each bounded light by its importance at the point, infinite lights with equal shares.
    ///
    /// The flat form of a light hierarchy, exact and quick for few lights.
    Weighed(WeighedLights),
    /// There is nothing to choose.
    Empty,
}

/// Lights for [`LightSelection::Weighed`].
#[derive(Debug)]
pub struct WeighedLights {
    bounds: Vec<LightBounds>,
    infinite: Vec<u32>,
    bounded: Vec<u32>,
}

impl LightSelection {
    pub(super) fn weighed(bounds: Vec<LightBounds>, usable: &[bool]) -> LightSelection {
        let pick = |infinite: bool| -> Vec<u32> {
            (0..bounds.len() as u32)
                .filter(|&i| {
                    let b = &bounds[i as usize];
                    usable[i as usize] && b.power > 0.0 && b.bounds.is_empty() == infinite
                })
                .collect()
        };
        let (infinite, bounded) = (pick(true), pick(false));
        if infinite.is_empty() && bounded.is_empty() {
            return LightSelection::Empty;
        }
        LightSelection::Weighed(WeighedLights { bounds, infinite, bounded })
    }

    pub(super) fn fixed(weights: &[f32]) -> LightSelection {
        if weights.iter().all(|&w| w <= 0.0) {
            return LightSelection::Empty;
        }
        Discrete::new(weights).map_or(LightSelection::Empty, LightSelection::Fixed)
    }

    /// A light and its probability.
    #[inline]
    pub fn choose(&self, at: &LitPoint, u: f32) -> Option<(u32, f32)> {
        match self {
            LightSelection::Fixed(d) => {
                let c = d.sample(u);
                (c.probability > 0.0).then_some((c.index as u32, c.probability))
            }
            LightSelection::Weighed(w) => w.choose(at, u),
            LightSelection::Empty => None,
        }
    }

    /// Probability of a light.
    #[inline]
    pub fn probability(&self, at: &LitPoint, light: u32) -> f32 {
        match self {
            LightSelection::Fixed(d) => d.probability(light as usize),
            LightSelection::Weighed(w) => w.probability(at, light),
            LightSelection::Empty => 0.0,
        }
    }
}

impl WeighedLights {
    /// Probability that any one infinite light is chosen: all bounded lights together count as one.
    fn infinite_share(&self) -> f32 {
        1.0 / (self.infinite.len() + usize::from(!self.bounded.is_empty())) as f32
    }

    fn choose(&self, at: &LitPoint, u: f32) -> Option<(u32, f32)> {
        let share = self.infinite_share();
        let n = self.infinite.len() as f32;
        if u < n * share {
            let i = ((u / share) as usize).min(self.infinite.len() - 1);
            return Some((self.infinite[i], share));
        }
        let rest = 1.0 - n * share;
        if let [only] = self.bounded[..] {
            return Some((only, rest));
        }
        let total: f32 = self.bounded.iter().map(|&i| self.bounds[i as usize].importance(at)).sum();
        let mut left = (u - n * share) / rest * total;
        let mut last = None;
        for &i in &self.bounded {
            let w = self.bounds[i as usize].importance(at);
            if w > 0.0 {
                last = Some((i, rest * w / total));
                if left < w {
                    break;
                }
                left -= w;
            }
        }
        last
    }

    fn probability(&self, at: &LitPoint, light: u32) -> f32 {
        let share = self.infinite_share();
        if self.infinite.contains(&light) {
            return share;
        }
        let rest = 1.0 - self.infinite.len() as f32 * share;
        if let [only] = self.bounded[..] {
            return if only == light { rest } else { 0.0 };
        }
        let own = self.bounds[light as usize].importance(at);
        if !(own > 0.0) {
            return 0.0;
        }
        let total: f32 = self.bounded.iter().map(|&i| self.bounds[i as usize].importance(at)).sum();
        rest * own / total
    }
}
