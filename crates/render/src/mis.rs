//! Multiple importance sampling of direct light: how light sampling and BSDF sampling share the work.

use std::fmt;
use std::str::FromStr;

use sparrow_math::Real;

/// How two techniques that can find the same light are weighted. [Veach1997, sec. 9.2]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mis {
    /// In proportion to the densities.
    Balance,
    /// In proportion to a power of the densities.
    Power(f32),
    /// Lights are sampled, directions from the BSDF do not look for them.
    LightOnly,
    /// Only directions from the BSDF find lights.
    BsdfOnly,
}

impl Mis {
    /// Weight of a light sample: density `p_light` against `p_bsdf`, both per steradian.
    #[inline]
    pub fn light_weight(self, p_light: f32, p_bsdf: f32) -> f32 {
        match self {
            Mis::Balance => share(p_light, p_bsdf),
            Mis::Power(beta) => power_share(p_light, p_bsdf, beta),
            Mis::LightOnly => 1.0,
            Mis::BsdfOnly => 0.0,
        }
    }
    /// Weight of a light that a direction from the BSDF found: density `p_bsdf` against `p_light`.
    #[inline]
    pub fn bsdf_weight(self, p_bsdf: f32, p_light: f32) -> f32 {
        match self {
            Mis::Balance => share(p_bsdf, p_light),
            Mis::Power(beta) => power_share(p_bsdf, p_light, beta),
            Mis::LightOnly => 0.0,
            Mis::BsdfOnly => 1.0,
        }
    }
    /// Lights are to be sampled.
    #[inline]
    pub fn samples_lights(self) -> bool {
        self != Mis::BsdfOnly
    }
}

/// `a / (a + b)`, for densities up to the largest float; `a > 0`.
#[inline]
fn share(a: f32, b: f32) -> f32 {
    1.0 / (1.0 + b / a)
}

/// `a^beta / (a^beta + b^beta)` by the ratio, which does not overflow.
#[inline]
fn power_share(a: f32, b: f32, beta: f32) -> f32 {
    if b <= 0.0 {
        return 1.0;
    }
    let r = b / a;
    #[allow(clippy::float_cmp, reason = "exactly 2 is the usual case and needs no logarithm")]
    let p = if beta == 2.0 { r * r } else { Real::pow(r, beta) };
    1.0 / (1.0 + p)
}

impl FromStr for Mis {
    type Err = String;
    fn from_str(s: &str) -> Result<Mis, String> {
        match s {
            "balance" => Ok(Mis::Balance),
            "power" => Ok(Mis::Power(2.0)),
            "light-only" => Ok(Mis::LightOnly),
            "bsdf-only" => Ok(Mis::BsdfOnly),
            _ => match s.strip_prefix("power:").map(str::parse::<f32>) {
                Some(Ok(beta)) if beta.is_finite() && beta > 0.0 => Ok(Mis::Power(beta)),
                _ => Err(format!(
                    "`{s}` is no MIS heuristic; use balance, power, power:BETA, light-only or bsdf-only"
                )),
            },
        }
    }
}

impl fmt::Display for Mis {
    #[allow(clippy::float_cmp, reason = "2 is the default exponent, set as a literal")]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Mis::Balance => write!(f, "balance"),
            Mis::Power(beta) if *beta == 2.0 => write!(f, "power"),
            Mis::Power(beta) => write!(f, "power:{beta}"),
            Mis::LightOnly => write!(f, "light-only"),
            Mis::BsdfOnly => write!(f, "bsdf-only"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_of_the_two_techniques_sum_to_one() {
        for mis in [Mis::Balance, Mis::Power(2.0), Mis::Power(3.5)] {
            for (a, b) in [(1.0, 2.0), (1e-20, 1e20), (1e30, 1e30), (0.3, 1e-30)] {
                let sum = mis.light_weight(a, b) + mis.bsdf_weight(b, a);
                assert!((sum - 1.0).abs() < 1e-5, "{mis} {a} {b}: {sum}");
            }
        }
        assert!((Mis::Balance.light_weight(3.0, 1.0) - 0.75).abs() < 1e-7);
        assert!((Mis::Power(2.0).light_weight(3.0, 1.0) - 0.9).abs() < 1e-7);
        assert!((Mis::Power(2.0).bsdf_weight(1.0, 0.0) - 1.0).abs() < 1e-7);
    }

    #[test]
    fn names_parse_back() {
        for mis in [Mis::Balance, Mis::Power(2.0), Mis::Power(1.5), Mis::LightOnly, Mis::BsdfOnly] {
            assert_eq!(mis.to_string().parse(), Ok(mis));
        }
        for bad in ["", "blance", "power:", "power:-1", "power:nan"] {
            assert!(bad.parse::<Mis>().is_err(), "{bad}");
        }
    }
}
