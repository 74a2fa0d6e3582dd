//! The reference fibre that a model's parameters mean, and its light along or around: [`fibre_like`], [`section`].

use core::f64::consts::{FRAC_1_SQRT_2, PI};

use sparrow_math::{LocalDir, Real};
use sparrow_models::cylinder::roughness::{logistic_scale, variance};
use sparrow_models::{FibreKind, N_LOBES, ParamBlock, ParamKind};
use sparrow_stats::Random;

use super::boundary::Surface;
use super::section::Section;
use super::trace::{Core, ReferenceFibre};

/// The fibre that a model with these parameters stands for; none for models that tell no lobes apart.
///
/// A lobe's standard deviation means facets of `alpha = std / sqrt(2)`, as in [`against`](super::against). Fibres of
/// [`Marschner`](FibreKind::Marschner) are smooth around.
pub fn fibre_like(kind: FibreKind, p: &ParamBlock<f64>) -> Option<ReferenceFibre> {
    let numbers = kind.params().iter().filter(|i| i.kind == ParamKind::Real).map(|i| i.name);
    let numbers: Vec<(&str, f64)> = numbers.zip(p.reals).collect();
    let get = |name: &str| numbers.iter().find(|(n, _)| *n == name).map(|(_, v)| *v);
    let of_std = |std: f64| std * FRAC_1_SQRT_2;
    let degrees = |name: &str| get(name).map_or(0.0, f64::to_radians);
    let (alpha, tilt) = match kind {
        FibreKind::Hair | FibreKind::Fur => {
            let around = logistic_scale(get("beta_n")?) * PI / 3.0_f64.sqrt();
            ([of_std(variance(get("beta_m")?).sqrt()), of_std(around)], degrees("alpha"))
        }
        FibreKind::ZinkeWeber | FibreKind::DEon | FibreKind::EllipticalHair => {
            (["width_m", "width_n"].map(|name| of_std(degrees(name))), degrees("alpha"))
        }
        FibreKind::MicrofacetHair => ([get("alpha_m")?, get("alpha_n")?], degrees("tilt")),
        // His width and tilt are told in the half angle.
        FibreKind::Marschner => ([of_std(2.0 * degrees("beta_r")), 0.0], degrees("alpha_r")),
        FibreKind::KajiyaKay
        | FibreKind::BanksFibre
        | FibreKind::LambertFibre
        | FibreKind::MirrorCylinder => return None,
    };
    let core = || {
        let sigma_a = p.spectra[1].average();
        Some(Core { kappa: get("kappa")?, sigma_s: get("sigma_m_s")?, sigma_a, g: get("g")? })
    };
    Some(ReferenceFibre {
        section: Section { b: get("aspect").unwrap_or(1.0) },
        surface: Surface { alpha, eta: get("eta")? },
        tilt,
        sigma_a: p.spectra[0].0,
        core: if kind == FibreKind::Fur { core() } else { None },
    })
}

/// Which angle a section runs over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over {
    /// The inclination: light over `sin theta_i`.
    Inclination,
    /// The azimuth from the viewer's: light over `phi`.
    Azimuth,
}

impl ReferenceFibre {
    /// Light by lobe, the mean over the wavelengths, in `cells` of equal angle from -90 to 90 or from -180 to 180 degrees, per unit of
    /// what [`Over`] says. From `n` rays at the offset `h`, or over the whole width.
    pub fn section(
        &self,
        wo: LocalDir<f64>,
        h: Option<f64>,
        over: Over,
        cells: usize,
        n: usize,
        seed: u64,
    ) -> Vec<[f64; N_LOBES]> {
        let mut rng = Random::named(seed, "section");
        let mut sum = vec![[0.0; N_LOBES]; cells];
        let from = Real::atan2(wo.z(), wo.y());
        for _ in 0..n {
            let at = h.unwrap_or_else(|| rng.within(-1.0, 1.0));
            let Some(photon) = self.send(wo, at, &mut rng) else { continue };
            let w = photon.wi;
            let place = match over {
                Over::Inclination => Real::asin(w.x().clamp(-1.0, 1.0)) / PI + 0.5,
                Over::Azimuth => {
                    let turn = (Real::atan2(w.z(), w.y()) - from) / (2.0 * PI) + 0.5;
                    turn - turn.floor()
                }
            };
            let cell = ((place * cells as f64) as usize).min(cells - 1);
            sum[cell][photon.lobe] += photon.weight.iter().sum::<f64>() / photon.weight.len() as f64;
        }
        let width = |cell: usize| match over {
            Over::Azimuth => 2.0 * PI / cells as f64,
            Over::Inclination => {
                let sin = |k: usize| Real::sin(PI * (k as f64 / cells as f64 - 0.5));
                sin(cell + 1) - sin(cell)
            }
        };
        sum.iter().enumerate().map(|(k, light)| light.map(|v| v / (n as f64 * width(k)))).collect()
    }
}
