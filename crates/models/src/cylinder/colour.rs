//! Translation of what a fibre is told: colour and melanin to absorption.
//!
//! | quantity | convention |
//! | --- | --- |
//! | `sigma_a` | per fibre radius (per diameter in some papers: halve theirs) |
//! | `beta_m`, `beta_n` | Chiang's perceptual roughness, 0 to 1 |
//! | standard deviations | radians inside, degrees where a table says so |
//! | tilt `alpha` | degrees, as in pbrt-v4: R lies at `theta_i + theta_o = 2 alpha`, so Marschner's `alpha_R`, told in `theta_h`, equals it; his usual -7.5 has x from root to tip |

use sparrow_math::Real;
use sparrow_spectra::Spectrum;

/// Absorption per radius of eumelanin at concentration 1, in linear sRGB. [dEon2011]
pub const EUMELANIN: [f64; 3] = [0.419, 0.697, 1.37];
/// Absorption per radius of pheomelanin at concentration 1, in linear sRGB. [dEon2011]
pub const PHEOMELANIN: [f64; 3] = [0.187, 0.4, 1.05];

/// Absorption per radius of the two melanins at these concentrations, in linear sRGB. [dEon2011]
pub fn absorption_of_melanin(eumelanin: f64, pheomelanin: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| eumelanin * EUMELANIN[k] + pheomelanin * PHEOMELANIN[k])
}

/// Absorption per radius with which a dense tuft of Chiang's fibres has the albedo `colour`, clamped to 0.001..0.999.
/// [Chiang2016, eq. 9]
#[inline(always)]
pub fn absorption_of_tuft<R: Real>(colour: Spectrum<R>, beta_n: R) -> Spectrum<R> {
    let mut fit = R::of(0.245);
    for c in [5.574, -10.73, 2.532, -0.215, 5.969] {
        fit = fit * beta_n + R::of(c);
    }
    colour.map(
        #[inline(always)]
        |c| (c.clamp(R::of(1e-3), R::of(0.999)).ln() / fit).sqr(),
    )
}
