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

/// A bounded light as the choice looks at it: the ball around it, and where it shines.
#[derive(Clone, Copy, Debug)]
struct Emitter {
    light: u32,
    power: f32,
    center: Vec3<f32>,
    radius: f32,
    facing: Option<Vec3<f32>>,
}

impl Emitter {
    fn new(light: u32, b: &LightBounds) -> Emitter {
        Emitter {
            light,
            power: b.power,
            center: b.bounds.center(),
            radius: b.bounds.radius(),
            facing: b.facing,
        }
    }

    /// About how much light it sends to a point. [ContyKulla2018, eq. 3], for a leaf with a flat emitter
    ///
    /// Not zero where light may arrive: a bound, not an estimate.
    #[inline]
    fn importance(&self, at: &LitPoint) -> f32 {
        let to = self.center - at.p;
        let (d2, r2) = (to.length2(), self.radius * self.radius);
        // Within the ball nothing is known of distance and angle.
        if d2 <= r2 {
            return self.power / r2.max(1e-30);
        }
        let inv = 1.0 / d2.sqrt();
        let d = to * inv;
        let sin_b = self.radius * inv;
        let cos_b = (1.0 - sin_b * sin_b).max(0.0).sqrt();
        // The largest cosine towards any point of the ball.
        let widen = |cos: f32| {
            if cos >= cos_b {
                1.0
            } else {
                (cos * cos_b + (1.0 - cos * cos).max(0.0).sqrt() * sin_b).max(0.0)
            }
        };
        let emits = self.facing.map_or(1.0, |n| widen(-n.dot(d)));
        let receives = widen(at.n.dot(d).abs());
        self.power * emits * receives * (inv * inv)
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
    bounded: Vec<Emitter>,
    infinite: Vec<u32>,
    /// Where each light stands among the bounded ones.
    place: Vec<u32>,
}

impl LightSelection {
    pub(super) fn weighed(bounds: &[LightBounds], usable: &[bool]) -> LightSelection {
        let (mut bounded, mut infinite) = (Vec::new(), Vec::new());
        let mut place = vec![u32::MAX; bounds.len()];
        for (i, b) in bounds.iter().enumerate().filter(|(i, b)| usable[*i] && b.power > 0.0) {
            if b.bounds.is_empty() {
                infinite.push(i as u32);
            } else {
                place[i] = bounded.len() as u32;
                bounded.push(Emitter::new(i as u32, b));
            }
        }
        // Choices keep their weights on the stack.
        bounded.truncate(WEIGH_ALL);
        if infinite.is_empty() && bounded.is_empty() {
            return LightSelection::Empty;
        }
        LightSelection::Weighed(WeighedLights { bounded, infinite, place })
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
        if let [only] = &self.bounded[..] {
            return Some((only.light, rest));
        }
        let mut weights = [0.0; WEIGH_ALL];
        let mut total = 0.0;
        for (w, e) in weights.iter_mut().zip(&self.bounded) {
            *w = e.importance(at);
            total += *w;
        }
        let mut left = (u - n * share) / rest * total;
        let mut last = None;
        for (&w, e) in weights.iter().zip(&self.bounded) {
            if w > 0.0 {
                last = Some((e.light, rest * w / total));
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
        let rest = 1.0 - self.infinite.len() as f32 * share;
        let Some(own) = self.place.get(light as usize).and_then(|&p| self.bounded.get(p as usize)) else {
            return if self.infinite.contains(&light) { share } else { 0.0 };
        };
        if self.bounded.len() == 1 {
            return rest;
        }
        let own = own.importance(at);
        if !(own > 0.0) {
            return 0.0;
        }
        let total: f32 = self.bounded.iter().map(|e| e.importance(at)).sum();
        rest * own / total
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_math::vec3;

    fn lights() -> LightSelection {
        let at = |x: f32, power: f32, r: f32| LightBounds {
            power,
            bounds: Aabb::EMPTY.grow(vec3(x - r, -r, 3.0 - r)).grow(vec3(x + r, r, 3.0 + r)),
            facing: (x > 0.0).then_some(vec3(0.0, 0.0, -1.0)),
        };
        let sky = LightBounds { power: 5.0, bounds: Aabb::EMPTY, facing: None };
        LightSelection::weighed(&[at(-2.0, 1.0, 0.1), sky, at(1.0, 4.0, 0.5), at(9.0, 0.0, 1.0)], &[true; 4])
    }

    #[test]
    fn choices_have_the_probability_that_is_told_and_sum_to_one() {
        let s = lights();
        for at in [
            LitPoint { p: vec3(0.0, 0.0, 0.0), n: vec3(0.0, 0.0, 1.0) },
            LitPoint { p: vec3(1.0, 0.1, 3.0), n: vec3(1.0, 0.0, 0.0) },
            LitPoint { p: vec3(5.0, 0.0, 9.0), n: vec3(0.0, 0.6, 0.8) },
        ] {
            let sum: f32 = (0..4).map(|i| s.probability(&at, i)).sum();
            assert!((sum - 1.0).abs() < 1e-6, "{sum}");
            let n = 10_000;
            let mut counts = [0.0f32; 4];
            for i in 0..n {
                let (light, p) = s.choose(&at, (i as f32 + 0.5) / n as f32).expect("there are lights");
                assert!((p - s.probability(&at, light)).abs() < 1e-6);
                counts[light as usize] += 1.0 / n as f32;
            }
            for (i, c) in counts.iter().enumerate() {
                assert!((c - s.probability(&at, i as u32)).abs() < 2e-3, "{i}: {counts:?}");
            }
        }
    }

    #[test]
    fn a_one_sided_light_seen_from_behind_is_not_chosen() {
        let behind = LitPoint { p: vec3(1.0, 0.0, 30.0), n: vec3(0.0, 0.0, 1.0) };
        assert!(lights().probability(&behind, 2) <= 0.0);
    }
}
