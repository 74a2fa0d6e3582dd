//! Cases: parameters and a view, pinned by the user or drawn from the model's table.

use std::fmt::Write;

use sparrow_math::{LocalDir, Real};
use sparrow_models::{ParamBlock, ParamInfo, ParamKind};
use sparrow_spectra::{N_LAMBDA, Spectrum};
use sparrow_stats::Random;

use crate::pins::{Pin, Pins};

/// Narrowest roughness that is drawn.
const LEAST_ROUGHNESS: f64 = 1e-3;
/// Largest value drawn for what has no upper bound.
const LARGEST: f64 = 8.0;
/// Cosines of the views that are drawn, from the normal to grazing.
const COSINES: [f64; 8] = [1.0, 0.5, 1e-3, 0.9, 0.1, 0.01, 0.7, 0.3];

/// Parameters and a view.
#[derive(Clone, Debug)]
pub struct Case {
    /// Parameters, each exactly an `f32`.
    pub params: ParamBlock<f64>,
    /// Polar angle and azimuth of `wo`, in degrees.
    pub view: [f64; 2],
    table: &'static [ParamInfo],
    fibre: bool,
}

/// How the numbers of a case are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Style {
    /// Within the soft ranges; roughness and ranges over two decades by the logarithm.
    Common,
    /// At an end of the ranges as often as not.
    Ends,
    /// At an end as well, and nothing absorbs: one albedo is one, the others are zero, indices of refraction are zero.
    White,
}

/// Wavelengths of every case, in nm: four over the visible range, for models of interference.
const WAVELENGTHS: [f64; 4] = [420.0, 510.0, 600.0, 690.0];

impl Case {
    /// The `index`-th case: what is pinned stays; what is not is drawn, or at its default where anything is pinned.
    pub(crate) fn draw(
        table: &'static [ParamInfo],
        fibre: bool,
        pins: &Pins,
        index: usize,
        style: Style,
        rng: &mut Random,
    ) -> Case {
        let mut params = ParamBlock::<f64>::defaults(table);
        params.lambda = Spectrum(WAVELENGTHS);
        let shares = table.iter().filter(|p| p.kind == ParamKind::Albedo).count().max(1);
        let white = (style == Style::White).then(|| rng.below(shares));
        let mut albedos = 0;
        let (mut r, mut s, mut c) = (0, 0, 0);
        for (place, info) in table.iter().enumerate() {
            let pinned = pins.values.get(place).copied().flatten();
            let free = pins.is_empty() && (index > 0 || style == Style::Ends);
            match info.kind {
                ParamKind::Real => {
                    params.reals[r] = match pinned {
                        Some(Pin::Real(v)) => v,
                        _ if free => real(info, index, style, rng),
                        _ => params.reals[r],
                    };
                    r += 1;
                }
                ParamKind::Albedo | ParamKind::Unbounded => {
                    params.spectra[s] = match pinned {
                        Some(Pin::Spectrum(v)) => Spectrum(v),
                        _ if free => match white {
                            Some(of) => {
                                let one = info.kind == ParamKind::Albedo && of == albedos;
                                Spectrum::splat(if one { 1.0 } else { info.range[0] })
                            }
                            None => spectrum(info, shares as f64, style, rng),
                        },
                        _ => params.spectra[s],
                    };
                    albedos += usize::from(info.kind == ParamKind::Albedo);
                    s += 1;
                }
                ParamKind::Choice(names) => {
                    params.choices[c] = match pinned {
                        Some(Pin::Choice(k)) => k,
                        _ if free => turn(index, c, names.len()),
                        _ => params.choices[c],
                    };
                    c += 1;
                }
            }
        }
        params.reals = params.reals.map(|v| f64::from(v as f32));
        params.spectra = params.spectra.map(|v| Spectrum(v.0.map(|v| f64::from(v as f32))));
        let view = pins.view.unwrap_or_else(|| view(index, rng));
        if fibre {
            params.h = f64::from(pins.h.unwrap_or_else(|| offset(index, rng)) as f32);
        }
        Case { params, view, table, fibre }
    }

    /// Sets a choice by its name; a name that is not there changes nothing.
    pub(crate) fn choose(&mut self, parameter: &str, name: &str) {
        let choices = self.table.iter().filter_map(|p| match p.kind {
            ParamKind::Choice(names) => Some((p.name, names)),
            ParamKind::Real | ParamKind::Albedo | ParamKind::Unbounded => None,
        });
        for (slot, (of, names)) in self.params.choices.iter_mut().zip(choices) {
            let place = names.iter().position(|n| *n == name).filter(|_| of == parameter);
            *slot = place.and_then(|p| u8::try_from(p).ok()).unwrap_or(*slot);
        }
    }

    /// The view as a direction.
    pub fn wo(&self) -> LocalDir<f64> {
        if self.view[0].abs() < 1e-12 {
            return LocalDir::from_angles(0.0, 0.0);
        }
        LocalDir::from_angles(self.view[0].to_radians(), self.view[1].to_radians())
    }

    /// As arguments of `sparrow verify`, after the name of the model.
    pub fn words(&self) -> String {
        let mut out = String::new();
        let (mut r, mut s, mut c) = (0, 0, 0);
        for p in self.table {
            // Writing to a string cannot fail.
            let _ = match p.kind {
                ParamKind::Real => {
                    r += 1;
                    write!(out, "{}={} ", p.name, self.params.reals[r - 1] as f32)
                }
                ParamKind::Albedo | ParamKind::Unbounded => {
                    s += 1;
                    let [a, b, c, d] = self.params.spectra[s - 1].0.map(|v| v as f32);
                    let same = [b, c, d].iter().all(|v| v.to_bits() == a.to_bits());
                    if same {
                        write!(out, "{}={a} ", p.name)
                    } else {
                        write!(out, "{}={a},{b},{c},{d} ", p.name)
                    }
                }
                ParamKind::Choice(names) => {
                    c += 1;
                    let k = usize::from(self.params.choices[c - 1]);
                    write!(out, "{}={} ", p.name, names.get(k).unwrap_or(&""))
                }
            };
        }
        if self.fibre {
            let _ = write!(out, "h={} ", self.params.h as f32);
        }
        let _ = write!(out, "wo={},{}", self.view[0], self.view[1]);
        out
    }
}

/// The `index`-th choice among `n`: multiples of irrational numbers reach every name soon, and pair each with each.
fn turn(index: usize, parameter: usize, n: usize) -> u8 {
    const STEPS: [f64; 6] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0];
    let x = 0.5 + index as f64 * STEPS[parameter % STEPS.len()].sqrt();
    ((x.fract() * n as f64) as usize).min(n - 1) as u8
}

fn is_roughness(info: &ParamInfo) -> bool {
    let name = info.name;
    (name.starts_with("alpha") || name.starts_with("beta") || name.contains("roughness")) && info.unit == "1"
}

/// The offset of the ray across a fibre: along the axis and at the rim as well.
fn offset(index: usize, rng: &mut Random) -> f64 {
    let ends = [0.0, 0.999, -0.6, -1.0];
    if index < ends.len() { ends[index] } else { rng.within(-1.0, 1.0) }
}

fn real(info: &ParamInfo, index: usize, style: Style, rng: &mut Random) -> f64 {
    let [lo, hi] = [info.soft[0].max(info.range[0]), info.soft[1].min(info.range[1])];
    let bounded = |v: f64| if v.is_finite() { v } else { LARGEST };
    if style != Style::Common {
        let ends = [bounded(info.range[0]), bounded(info.range[1]), LEAST_ROUGHNESS.max(info.range[0])];
        match rng.below(5) {
            k @ 0..2 => return ends[k],
            2 if is_roughness(info) => return ends[2],
            _ => {}
        }
    }
    if is_roughness(info) {
        let least = LEAST_ROUGHNESS.max(info.range[0]);
        // The narrowest has cases of its own.
        return match index {
            1 | 5 => least,
            _ => Real::exp(rng.within(Real::ln(least), Real::ln(bounded(info.range[1]).max(least)))),
        };
    }
    let (lo, hi) = (bounded(lo), bounded(hi));
    // Exponents and their like, whose small values matter as much as the large ones.
    if lo > 0.0 && hi >= 100.0 * lo {
        return Real::exp(rng.within(Real::ln(lo), Real::ln(hi)));
    }
    rng.within(lo, hi)
}

fn spectrum(info: &ParamInfo, shares: f64, style: Style, rng: &mut Random) -> Spectrum<f64> {
    if info.kind == ParamKind::Albedo {
        // Models with several shares promise energy only where their sum stays below one.
        if style == Style::Ends && rng.below(2) == 0 {
            return Spectrum::splat([0.0, 1.0 / shares][rng.below(2)]);
        }
        return Spectrum([(); N_LAMBDA].map(|()| rng.uniform() / shares));
    }
    let hi = info.soft[1].min(LARGEST);
    let lo = info.soft[0].max(0.1).min(hi);
    if style == Style::Ends && rng.below(3) == 0 {
        return Spectrum::splat([info.range[0], hi][rng.below(2)]);
    }
    Spectrum([(); N_LAMBDA].map(|()| rng.within(lo, hi)))
}

fn view(index: usize, rng: &mut Random) -> [f64; 2] {
    let round = |v: f64| (v * 1e4).round() / 1e4;
    let cosine = if index < COSINES.len() { COSINES[index] } else { rng.within(1e-3, 1.0) };
    let theta = round(Real::acos(cosine).to_degrees());
    // Every third from below.
    let theta = if index % 3 == 2 { 180.0 - theta } else { theta };
    [round(theta), round(rng.within(-180.0, 180.0))]
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &[ParamInfo] = &[
        ParamInfo::real("alpha").default(0.2),
        ParamInfo::albedo("rho"),
        ParamInfo::choice("kind", &["one", "two"]),
    ];

    #[test]
    fn words_of_a_case_give_the_case() {
        let mut rng = Random::new(1);
        for index in 0..20 {
            let case = Case::draw(TABLE, false, &Pins::default(), index, Style::Common, &mut rng);
            let words = case.words();
            let words: Vec<&str> = words.split(' ').collect();
            let pins = Pins::parse(TABLE, &words).unwrap();
            let again = Case::draw(TABLE, false, &pins, 3, Style::Common, &mut rng);
            assert_eq!(case.words(), again.words());
            assert_eq!(case.params.reals.map(f64::to_bits), again.params.reals.map(f64::to_bits));
            assert_eq!(case.wo(), again.wo());
        }
    }

    #[test]
    fn roughness_and_angles_reach_their_ends_and_every_choice_is_met() {
        let mut rng = Random::new(2);
        let cases: Vec<_> =
            (0..8).map(|i| Case::draw(TABLE, false, &Pins::default(), i, Style::Common, &mut rng)).collect();
        assert!(cases.iter().any(|c| c.params.reals[0] < 1.01e-3));
        assert!(cases.iter().any(|c| c.wo().z().abs() < 1.01e-3));
        assert!(cases.iter().any(|c| c.wo().z() < 0.0));
        assert!((0..2).all(|k| cases.iter().any(|c| c.params.choices[0] == k)));
    }
}
