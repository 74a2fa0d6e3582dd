//! Choosing one of many lights.

use sparrow_math::{InLanes, Real, in_lanes};

use super::LitPoint;
use super::bounds::LightBounds;
use super::eight::{EIGHT, Eight, pick};
use super::tree::LightTree;
use crate::distribution::Discrete;

/// Most lights for which every choice weighs each of them.
pub(super) const WEIGH_ALL: usize = 64;

/// A way to choose a light.
#[derive(Debug)]
pub enum LightSelection {
    /// By a fixed distribution: uniform, or in proportion to power.
    Fixed(Discrete),
    /// By about how much light each sends to the point.
    ByPlace(ByPlace),
    /// There is nothing to choose.
    Empty,
}

/// Bounded lights chosen by place; infinite lights with equal shares, beside which all bounded ones together count as one.
#[derive(Debug)]
pub struct ByPlace {
    bounded: Bounded,
    infinite: Vec<u32>,
}

/// How bounded lights are weighed.
#[derive(Debug)]
enum Bounded {
    None,
    One(u32),
    Few(FewLights),
    Many(LightTree),
}

impl LightSelection {
    pub(super) fn by_place(bounds: &[LightBounds], usable: &[bool]) -> LightSelection {
        let lights = bounds.iter().enumerate().filter(|(i, b)| usable[*i] && b.power > 0.0);
        let (infinite, bounded): (Vec<_>, Vec<_>) =
            lights.map(|(i, b)| (i as u32, *b)).partition(|(_, b)| b.bounds.is_empty());
        if infinite.is_empty() && bounded.is_empty() {
            return LightSelection::Empty;
        }
        let bounded = match &bounded[..] {
            [] => Bounded::None,
            [(light, _)] => Bounded::One(*light),
            few if few.len() <= WEIGH_ALL => Bounded::Few(FewLights::new(few)),
            many => Bounded::Many(LightTree::new(many, bounds.len())),
        };
        LightSelection::ByPlace(ByPlace { bounded, infinite: infinite.into_iter().map(|l| l.0).collect() })
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
            LightSelection::ByPlace(w) => w.choose(at, u),
            LightSelection::Empty => None,
        }
    }

    /// Probability of a light.
    #[inline]
    pub fn probability(&self, at: &LitPoint, light: u32) -> f32 {
        match self {
            LightSelection::Fixed(d) => d.probability(light as usize),
            LightSelection::ByPlace(w) => w.probability(at, light),
            LightSelection::Empty => 0.0,
        }
    }
}

impl ByPlace {
    /// Probability that any one infinite light is chosen.
    fn infinite_share(&self) -> f32 {
        1.0 / (self.infinite.len() + usize::from(!matches!(self.bounded, Bounded::None))) as f32
    }

    #[inline]
    fn choose(&self, at: &LitPoint, u: f32) -> Option<(u32, f32)> {
        let share = self.infinite_share();
        let n = self.infinite.len() as f32;
        if u < n * share {
            let i = ((u / share) as usize).min(self.infinite.len() - 1);
            return Some((self.infinite[i], share));
        }
        let rest = 1.0 - n * share;
        let u = f64::from((u - n * share) / rest);
        let (light, probability) = match &self.bounded {
            Bounded::None => return None,
            Bounded::One(light) => (*light, 1.0),
            Bounded::Few(few) => few.choose(at, u)?,
            Bounded::Many(tree) => tree.choose(at, u)?,
        };
        Some((light, rest * probability))
    }

    #[inline]
    fn probability(&self, at: &LitPoint, light: u32) -> f32 {
        let share = self.infinite_share();
        if self.infinite.contains(&light) {
            return share;
        }
        let among = match &self.bounded {
            Bounded::None => 0.0,
            Bounded::One(only) => f32::from(u8::from(*only == light)),
            Bounded::Few(few) => few.probability(at, light),
            Bounded::Many(tree) => tree.probability(at, light),
        };
        (1.0 - self.infinite.len() as f32 * share) * among
    }
}

/// Few lights, each weighed for every point: exact and quick.
#[derive(Debug)]
struct FewLights {
    lights: Vec<u32>,
    bounds: Vec<Eight>,
}

/// Weights of few lights.
type Weights = [f32; WEIGH_ALL];

impl FewLights {
    /// At most [`WEIGH_ALL`] lights.
    fn new(lights: &[(u32, LightBounds)]) -> FewLights {
        let mut bounds = vec![Eight::default(); lights.len().div_ceil(EIGHT)];
        for (i, (_, b)) in lights.iter().enumerate() {
            bounds[i / EIGHT].set(i % EIGHT, b);
        }
        FewLights { lights: lights.iter().map(|l| l.0).collect(), bounds }
    }

    /// Their weights, and the sum.
    #[inline]
    fn weigh(&self, at: &LitPoint) -> (Weights, f32) {
        let mut weights = [0.0; WEIGH_ALL];
        in_lanes(Weigh(&self.bounds, at, &mut weights));
        let total = weights[..self.lights.len()].iter().sum();
        (weights, total)
    }

    fn choose(&self, at: &LitPoint, u: f64) -> Option<(u32, f32)> {
        let (weights, total) = self.weigh(at);
        let (i, share, _) = pick(&weights[..self.lights.len()], total, u)?;
        Some((self.lights[i], share))
    }

    fn probability(&self, at: &LitPoint, light: u32) -> f32 {
        let Some(own) = self.lights.iter().position(|&l| l == light) else { return 0.0 };
        let (weights, total) = self.weigh(at);
        if weights[own] > 0.0 { weights[own] / total } else { 0.0 }
    }
}

/// Writes the importances of all of them.
struct Weigh<'a>(&'a [Eight], &'a LitPoint, &'a mut Weights);

impl InLanes for Weigh<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        for (eight, out) in self.0.iter().zip(self.2.chunks_exact_mut(EIGHT)) {
            out.copy_from_slice(&eight.importances::<R>(self.1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::bounds::Cone;
    use sparrow_math::{Aabb, vec3};

    fn lights() -> LightSelection {
        let at = |x: f32, power: f32, r: f32| LightBounds {
            power,
            bounds: Aabb::EMPTY.grow(vec3(x - r, -r, 3.0 - r)).grow(vec3(x + r, r, 3.0 + r)),
            cone: if x > 0.0 { Cone::facing(vec3(0.0, 0.0, -1.0), false) } else { Cone::ALL },
        };
        let sky = LightBounds { power: 5.0, bounds: Aabb::EMPTY, cone: Cone::ALL };
        LightSelection::by_place(&[at(-2.0, 1.0, 0.1), sky, at(1.0, 4.0, 0.5), at(9.0, 0.0, 1.0)], &[true; 4])
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
