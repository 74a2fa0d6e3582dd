//! Weights that follow from densities alone: [`Heuristic`]. [VeachGuibas1995], [Veach1997, sec. 9.2]

use std::fmt;
use std::str::FromStr;

use sparrow_math::{Mask, Real};

/// What a heuristic knows of a technique at one place.
#[derive(Clone, Copy, Debug)]
pub struct Technique<R> {
    /// Samples that it takes.
    pub count: R,
    /// Its density there; infinite where only it can find the place (a delta), exactly zero where it cannot.
    pub pdf: R,
}

impl<R: Real> Technique<R> {
    /// `q = n p`
    #[inline(always)]
    fn q(&self) -> R {
        self.count * self.pdf
    }
}

/// How the techniques that can find the same place share it, by `q_k = n_k p_k`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Heuristic {
    /// `q_k / sum q`
    Balance,
    /// `q_k^b / sum q^b`
    Power(f32),
    /// As balance among those with `q_k >= a max q`.
    Cutoff(f32),
    /// All to the largest `q_k`, of equal ones to the first.
    Maximum,
    /// `n_k / sum n` of the techniques that can find the place, whatever their densities.
    Average,
}

impl Heuristic {
    /// The weight of the technique `k` among `all`.
    ///
    /// Zero where its density is. Exact for densities up to infinity: quotients are formed before powers.
    #[inline(always)]
    pub fn weight<R: Real>(self, all: &[Technique<R>], k: usize) -> R {
        let own = all[k];
        let q_k = own.q();
        let mut largest = R::ZERO;
        for t in all {
            largest = largest.max(t.q());
        }
        // Sums over the other techniques, in units of this one.
        let (mut sum, mut beaten) = (R::ONE, R::Mask::of(false));
        for (j, t) in all.iter().enumerate() {
            if j == k {
                continue;
            }
            let q = t.q();
            let ratio = q / q_k;
            // Two infinite densities are equal.
            let ratio = R::select(ratio.le(ratio), ratio, R::ONE).only_where(q.gt(R::ZERO));
            sum = sum
                + match self {
                    Heuristic::Balance => ratio,
                    Heuristic::Power(b) => power(ratio, b),
                    Heuristic::Cutoff(a) => ratio.only_where(q.ge(R::of(f64::from(a)) * largest)),
                    Heuristic::Maximum => R::ZERO,
                    Heuristic::Average => (t.count / own.count).only_where(q.gt(R::ZERO)),
                };
            beaten = beaten | if j < k { q.ge(q_k) } else { q.gt(q_k) };
        }
        let out = match self {
            Heuristic::Balance | Heuristic::Power(_) | Heuristic::Average => R::Mask::of(false),
            Heuristic::Cutoff(a) => q_k.lt(R::of(f64::from(a)) * largest),
            Heuristic::Maximum => beaten,
        };
        (R::ONE / sum).only_where(q_k.gt(R::ZERO) & !out)
    }
}

/// `x^b`, zero for zero, infinite for infinite.
#[inline(always)]
#[allow(clippy::float_cmp, reason = "exactly 2 is the usual case and needs no logarithm")]
fn power<R: Real>(x: R, b: f32) -> R {
    if b == 2.0 {
        return x * x;
    }
    let (least, most) = (R::of(1e-30), R::of(1e30));
    let p = x.clamp(least, most).pow(R::of(f64::from(b)));
    // The largest number that the exponential gives stands for what is beyond it.
    R::select(x.gt(most), x, p.only_where(x.ge(least)))
}

/// A heuristic that nobody knows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParseError(String);

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` is no heuristic; there are {}", self.0, Heuristic::FORMS)
    }
}
impl std::error::Error for ParseError {}

impl Heuristic {
    /// How heuristics are written.
    pub const FORMS: &'static str =
        "balance, power, power:BETA with BETA above 0, cutoff:A with A from 0 to 1, maximum and average";
}

impl FromStr for Heuristic {
    type Err = ParseError;
    fn from_str(s: &str) -> Result<Heuristic, ParseError> {
        let number = |text: &str, most: f32| {
            text.parse::<f32>()
                .ok()
                .filter(|v| *v >= 0.0 && *v <= most)
                .ok_or_else(|| ParseError(s.to_owned()))
        };
        match s.split_once(':') {
            None => match s {
                "balance" => Ok(Heuristic::Balance),
                "power" => Ok(Heuristic::Power(2.0)),
                "maximum" => Ok(Heuristic::Maximum),
                "average" => Ok(Heuristic::Average),
                _ => Err(ParseError(s.to_owned())),
            },
            Some(("power", b)) => match number(b, 1e3)? {
                b if b > 0.0 => Ok(Heuristic::Power(b)),
                _ => Err(ParseError(s.to_owned())),
            },
            Some(("cutoff", a)) => Ok(Heuristic::Cutoff(number(a, 1.0)?)),
            Some(_) => Err(ParseError(s.to_owned())),
        }
    }
}

impl fmt::Display for Heuristic {
    #[allow(clippy::float_cmp, reason = "2 is the default exponent, set as a literal")]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Heuristic::Balance => write!(f, "balance"),
            Heuristic::Power(b) if *b == 2.0 => write!(f, "power"),
            Heuristic::Power(b) => write!(f, "power:{b}"),
            Heuristic::Cutoff(a) => write!(f, "cutoff:{a}"),
            Heuristic::Maximum => write!(f, "maximum"),
            Heuristic::Average => write!(f, "average"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_math::Lanes;

    const ALL: [Heuristic; 7] = [
        Heuristic::Balance,
        Heuristic::Power(2.0),
        Heuristic::Power(3.5),
        Heuristic::Cutoff(0.1),
        Heuristic::Cutoff(1.0),
        Heuristic::Maximum,
        Heuristic::Average,
    ];

    /// Densities of all sizes, zeros and infinities among them, from a small generator.
    fn densities() -> Vec<[Technique<f32>; 3]> {
        let mut state = 3u64;
        let mut next = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f32 / (1u64 << 24) as f32
        };
        (0..4000)
            .map(|_| {
                [(); 3].map(|()| {
                    let pdf = match next() {
                        x if x < 0.2 => 0.0,
                        x if x < 0.25 => f32::INFINITY,
                        _ => Real::exp(120.0 * next() - 60.0),
                    };
                    Technique { count: 1.0 + (4.0 * next()).floor(), pdf }
                })
            })
            .collect()
    }

    #[test]
    fn weights_sum_to_one_wherever_a_technique_can_go() {
        for all in densities() {
            for h in ALL {
                let w: Vec<f32> = (0..3).map(|k| h.weight(&all, k)).collect();
                let sum: f32 = w.iter().sum();
                let lost = all.iter().all(|t| t.pdf <= 0.0);
                let want = if lost { 0.0 } else { 1.0 };
                assert!((sum - want).abs() < 1e-5, "{h}: {all:?} {w:?}");
                assert!(
                    w.iter().zip(&all).all(|(w, t)| *w >= 0.0 && (t.pdf > 0.0 || *w <= 0.0)),
                    "{h}: {all:?} {w:?}"
                );
            }
        }
    }

    #[test]
    fn only_a_delta_finds_its_place() {
        let all = [Technique { count: 4.0, pdf: 1e30f64 }, Technique { count: 1.0, pdf: f64::INFINITY }];
        for h in [Heuristic::Balance, Heuristic::Power(2.0), Heuristic::Cutoff(0.2), Heuristic::Maximum] {
            assert_eq!((h.weight(&all, 0), h.weight(&all, 1)), (0.0, 1.0), "{h}");
        }
    }

    #[test]
    fn lanes_equal_scalars_bit_for_bit() {
        let all = densities();
        for block in all.chunks_exact(8) {
            let lanes = [0, 1, 2].map(|k| Technique {
                count: Lanes::<8>(core::array::from_fn(|i| block[i][k].count)),
                pdf: Lanes::<8>(core::array::from_fn(|i| block[i][k].pdf)),
            });
            for h in ALL {
                for k in 0..3 {
                    let w = h.weight(&lanes, k);
                    for (i, one) in block.iter().enumerate() {
                        assert_eq!(w.0[i].to_bits(), h.weight(one, k).to_bits(), "{h} {one:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn names_are_read_back_and_nonsense_is_refused() {
        for h in ALL {
            assert_eq!(h.to_string().parse(), Ok(h));
        }
        for bad in [
            "",
            "blance",
            "power:",
            "power:0",
            "power:-1",
            "power:nan",
            "cutoff",
            "cutoff:2",
            "cutoff:-1",
            "maximum:1",
        ] {
            assert!(bad.parse::<Heuristic>().is_err(), "{bad}");
        }
    }
}
