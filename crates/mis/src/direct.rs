//! Direct light, by light sampling and BSDF sampling: how both share the work, [`Mis`].

use std::fmt;
use std::str::FromStr;

use sparrow_math::Real;

use crate::{Heuristic, Technique};

/// How two techniques that can find the same light are joined. [Veach1997, sec. 9.2]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mis {
    /// Both at every vertex, weighted by their densities.
    Both(Heuristic),
    /// Both at every vertex, by the balance heuristic and a control variate that is learned: the least variance. [Kondapaneni2019]
    ///
    /// Weights are those of balance; the rest is [`PairMoments`](crate::PairMoments), from all samples of a pixel.
    Optimal,
    /// One of both at every vertex, by the toss of a coin, with the balance heuristic: the best for one sample.
    OneSample,
    /// Lights are sampled, directions from the BSDF do not look for them.
    LightOnly,
    /// Only directions from the BSDF find lights.
    BsdfOnly,
}

/// Whose turn it is at a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// A light is sampled.
    pub light: bool,
    /// The direction from the BSDF looks for lights.
    pub bsdf: bool,
    /// What is left of the uniform number that decided.
    pub u: f32,
}

impl Mis {
    /// Decides by the uniform number `u`.
    #[inline]
    pub fn turn(self, u: f32) -> Turn {
        let both = Turn { light: true, bsdf: true, u };
        match self {
            Mis::Both(_) | Mis::Optimal => both,
            Mis::OneSample if u < 0.5 => Turn { bsdf: false, u: 2.0 * u, ..both },
            Mis::OneSample => Turn { light: false, u: 2.0 * u - 1.0, ..both },
            Mis::LightOnly => Turn { bsdf: false, ..both },
            Mis::BsdfOnly => Turn { light: false, ..both },
        }
    }
    /// Whether [`turn`](Self::turn) asks the uniform number.
    #[inline]
    pub fn takes_turns(self) -> bool {
        self == Mis::OneSample
    }
    /// Weight of a light sample, over the chance of its turn: density `p_light` against `p_bsdf`, both per steradian.
    #[inline(always)]
    pub fn light_weight<R: Real>(self, p_light: R, p_bsdf: R) -> R {
        self.weight(p_light, p_bsdf, 0)
    }
    /// Weight of a light that a direction from the BSDF found, over the chance of its turn: density `p_bsdf` against `p_light`.
    #[inline(always)]
    pub fn bsdf_weight<R: Real>(self, p_bsdf: R, p_light: R) -> R {
        self.weight(p_light, p_bsdf, 1)
    }
    /// Weight of a sample of a light that no direction can find by chance, a point or a sun, over the chance of its turn.
    #[inline]
    pub fn delta_weight(self) -> f32 {
        if self == Mis::OneSample { 2.0 } else { 1.0 }
    }
    #[inline(always)]
    fn weight<R: Real>(self, p_light: R, p_bsdf: R, k: usize) -> R {
        let both = [Technique { count: R::ONE, pdf: p_light }, Technique { count: R::ONE, pdf: p_bsdf }];
        match self {
            Mis::Both(heuristic) => heuristic.weight(&both, k),
            Mis::Optimal => Heuristic::Balance.weight(&both, k),
            Mis::OneSample => R::of(2.0) * Heuristic::Balance.weight(&both, k),
            Mis::LightOnly | Mis::BsdfOnly => R::ONE,
        }
    }
}

impl Mis {
    /// One word of every form that is read.
    pub const EXAMPLES: [&'static str; 10] = [
        "balance",
        "power",
        "power:3.5",
        "cutoff:0.1",
        "maximum",
        "average",
        "one-sample",
        "light-only",
        "bsdf-only",
        "optimal",
    ];
}

impl FromStr for Mis {
    type Err = String;
    fn from_str(s: &str) -> Result<Mis, String> {
        match s {
            "optimal" => Ok(Mis::Optimal),
            "one-sample" => Ok(Mis::OneSample),
            "light-only" => Ok(Mis::LightOnly),
            "bsdf-only" => Ok(Mis::BsdfOnly),
            _ => s.parse().map(Mis::Both).map_err(|_| {
                let known = Heuristic::FORMS.replace(" and ", ", ");
                format!(
                    "`{s}` is no MIS heuristic; use {known}, optimal, one-sample, light-only or bsdf-only"
                )
            }),
        }
    }
}

impl fmt::Display for Mis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Mis::Both(heuristic) => heuristic.fmt(f),
            Mis::Optimal => write!(f, "optimal"),
            Mis::OneSample => write!(f, "one-sample"),
            Mis::LightOnly => write!(f, "light-only"),
            Mis::BsdfOnly => write!(f, "bsdf-only"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_light_that_both_find_counts_once() {
        for word in Mis::EXAMPLES {
            let mis: Mis = word.parse().unwrap();
            assert_eq!(mis.to_string(), word);
            for (l, b) in [(1.0, 2.0), (1e-20, 1e20), (1e30, 1e30), (0.3, 1e-30), (3.0, 1.0)] {
                // The mean over turns of the weights of those whose turn it is.
                let sum: f32 = [0.2, 0.7].iter().fold(0.0, |sum, u| {
                    let turn = mis.turn(*u);
                    let light = if turn.light { mis.light_weight(l, b) } else { 0.0 };
                    let bsdf = if turn.bsdf { mis.bsdf_weight(b, l) } else { 0.0 };
                    sum + 0.5 * (light + bsdf)
                });
                assert!((sum - 1.0).abs() < 1e-5, "{mis} {l} {b}: {sum}");
            }
        }
        assert_eq!(Mis::OneSample.turn(0.75), Turn { light: false, bsdf: true, u: 0.5 });
    }

    #[test]
    fn there_is_an_example_of_every_form() {
        let told = "".parse::<Mis>().unwrap_err();
        let (_, forms) = told.split_once("; use ").unwrap();
        for form in forms.split(", ").flat_map(|f| f.split(" or ")) {
            let word = form.split(' ').next().unwrap_or_default();
            let alike = |e: &str| match word.split_once(':') {
                Some((name, _)) => e.split_once(':').is_some_and(|(n, _)| n == name),
                None => e == word,
            };
            assert!(Mis::EXAMPLES.into_iter().any(alike), "no example of {form}");
        }
    }

    #[test]
    fn nonsense_is_refused_with_what_there_is() {
        for bad in ["", "blance", "power:", "power:-1", "power:nan", "cutoff:7"] {
            let told = bad.parse::<Mis>().unwrap_err();
            assert!(told.contains("cutoff:A") && told.contains("one-sample"), "{told}");
        }
    }
}
