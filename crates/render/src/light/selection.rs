//! Choosing one of many lights.

use super::bounds::LightBounds;
use super::few::{FewLights, LitPoints, WEIGH_ALL};
use super::tree::LightTree;
use super::{LitPoint, NO_LIGHT};
use crate::distribution::Discrete;

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

    /// [`choose`](Self::choose) for each of `points`, to the bit: the index, or [`NO_LIGHT`], and the probability, else zero. In lanes,
    /// where lights are few and have places. The columns are as long as those of the points.
    pub(crate) fn choose_many(&self, points: &LitPoints<'_>, light: &mut [u32], probability: &mut [f32]) {
        match self {
            LightSelection::ByPlace(ByPlace { bounded: Bounded::Few(few), infinite })
                if infinite.is_empty() =>
            {
                few.choose_many(points, light, probability);
            }
            LightSelection::ByPlace(_) | LightSelection::Fixed(_) | LightSelection::Empty => {
                for (k, to) in light.iter_mut().zip(probability).take(points.n_points).enumerate() {
                    let chosen = self.choose(&points.get(k), points.u[k]);
                    (*to.0, *to.1) = chosen.unwrap_or((NO_LIGHT, 0.0));
                }
            }
        }
    }

    /// The light that is chosen everywhere, where there is no other.
    pub(crate) fn only(&self) -> Option<u32> {
        let LightSelection::ByPlace(ByPlace { bounded: Bounded::One(light), infinite }) = self else {
            return None;
        };
        infinite.is_empty().then_some(*light)
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

impl LightSelection {
    /// [`probability`](Self::probability) of one light for each of `points`, to the bit; in lanes, where lights are few and have
    /// places. The column is as long as theirs.
    pub(crate) fn probability_many(&self, points: &LitPoints<'_>, light: u32, out: &mut [f32]) {
        match self {
            LightSelection::ByPlace(ByPlace { bounded: Bounded::Few(few), infinite })
                if infinite.is_empty() =>
            {
                few.probability_many(points, light, out);
            }
            LightSelection::ByPlace(_) | LightSelection::Fixed(_) | LightSelection::Empty => {
                for (k, out) in out.iter_mut().take(points.n_points).enumerate() {
                    *out = self.probability(&points.get(k), light);
                }
            }
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
        let u = (u - n * share) / rest;
        let (light, probability) = match &self.bounded {
            Bounded::None => return None,
            Bounded::One(light) => (*light, 1.0),
            Bounded::Few(few) => few.choose(at, u)?,
            Bounded::Many(tree) => tree.choose(at, u.into())?,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::bounds::Cone;
    use sparrow_math::{Aabb, Real, vec3};

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
    fn lanes_choose_what_is_chosen_one_by_one() {
        let LightSelection::ByPlace(ByPlace { bounded, .. }) = lights() else { unreachable!() };
        let s = LightSelection::ByPlace(ByPlace { bounded, infinite: Vec::new() });
        let column = |f: &dyn Fn(f32) -> f32| -> Vec<f32> { (0..48).map(|k| f(k as f32)).collect() };
        let p = [column(&|k| 0.3 * k - 5.0), column(&|k| 0.01 * k), column(&|k| 0.2 * k)];
        let n = [column(&|k| Real::sin(0.3 * k)), column(&|_| 0.0), column(&|k| Real::cos(0.3 * k))];
        let u = column(&|k| (0.618 * k).fract());
        let points = LitPoints {
            p: p.each_ref().map(|c| &c[..]),
            n: n.each_ref().map(|c| &c[..]),
            u: &u,
            n_points: 37,
        };
        let (mut light, mut probability) = ([NO_LIGHT; 48], [0.0; 48]);
        s.choose_many(&points, &mut light, &mut probability);
        let alone: Vec<_> = (0..37).map(|k| s.choose(&points.get(k), u[k])).collect();
        let chosen = light.iter().zip(&probability).take(37);
        let chosen: Vec<_> = chosen.map(|(&l, &share)| (share > 0.0).then_some((l, share))).collect();
        assert_eq!(chosen, alone);
        let mut told = [0.0; 48];
        s.probability_many(&points, 2, &mut told);
        assert!((0..37).all(|k| told[k].to_bits() == s.probability(&points.get(k), 2).to_bits()), "{told:?}");
        let of = |light: u32| chosen.iter().filter(|c| c.is_some_and(|c| c.0 == light)).count();
        assert!(of(0) > 3 && of(2) > 3, "{chosen:?}");
    }

    #[test]
    fn a_one_sided_light_seen_from_behind_is_not_chosen() {
        let behind = LitPoint { p: vec3(1.0, 0.0, 30.0), n: vec3(0.0, 0.0, 1.0) };
        assert!(lights().probability(&behind, 2) <= 0.0);
    }
}
