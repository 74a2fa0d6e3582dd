//! One model with its parameters and a view: [`Series`].

use sparrow_math::LocalDir;
use sparrow_models::{ParamBlock, ParamKind, Surface, SurfaceKind};
use sparrow_spectra::Spectrum;

/// A model, its parameters, and the direction it is seen from.
#[derive(Clone, Debug)]
pub struct Series {
    /// The model.
    pub kind: SurfaceKind,
    /// All parameters, in the ranges of the model's table.
    pub params: ParamBlock<f64>,
    /// What was asked for by name: parameter and value as written, in that order.
    pub pins: Vec<(String, String)>,
    /// Polar angle and azimuth of `wo`, in degrees.
    pub wo_deg: [f64; 2],
}

impl Series {
    /// A model with every parameter at its default, seen from 45 degrees.
    pub fn new(kind: SurfaceKind) -> Series {
        Series { kind, params: ParamBlock::defaults(kind.params()), pins: Vec::new(), wo_deg: [45.0, 0.0] }
    }
    /// The model in double precision.
    pub fn model(&self) -> Surface<f64> {
        self.kind.bind(&self.params)
    }
    /// Towards the viewer.
    pub fn wo(&self) -> LocalDir<f64> {
        direction(self.wo_deg)
    }
    /// Seen from the same direction.
    pub(crate) fn same_view(&self, o: &Series) -> bool {
        self.wo_deg.map(f64::to_bits) == o.wo_deg.map(f64::to_bits)
    }
    /// Sets a parameter; a number for a spectrum holds at all wavelengths, one for a choice is the place of its name.
    ///
    /// False where the model has no such parameter; `NAME` alone then means both `NAME_x` and `NAME_y`, where they exist.
    pub fn set(&mut self, name: &str, value: f64) -> bool {
        let targets = targets(self.kind, name);
        for target in &targets {
            let table = self.kind.params();
            let same = |p: &ParamKind| core::mem::discriminant(p);
            let kind = table[*target].kind;
            let spectral = |p: &ParamKind| matches!(p, ParamKind::Albedo | ParamKind::Unbounded);
            let alike = |p: &ParamKind| same(p) == same(&kind) || (spectral(p) && spectral(&kind));
            let slot = table[..*target].iter().filter(|p| alike(&p.kind)).count();
            match kind {
                ParamKind::Real => self.params.reals[slot] = value,
                ParamKind::Albedo | ParamKind::Unbounded => {
                    self.params.spectra[slot] = Spectrum::splat(value);
                }
                ParamKind::Choice(_) => self.params.choices[slot] = value as u8,
            }
        }
        !targets.is_empty()
    }
    /// The model's name and what was asked for: `conductor alpha=0.1`.
    pub fn name(&self) -> String {
        let pins = self.pins.iter().map(|(n, v)| format!(" {n}={v}"));
        core::iter::once(self.kind.name().to_owned()).chain(pins).collect()
    }
}

/// The direction of polar angle and azimuth in degrees.
pub(crate) fn direction([theta, phi]: [f64; 2]) -> LocalDir<f64> {
    LocalDir::from_angles(theta.to_radians(), phi.to_radians())
}

/// Places in the model's table of the parameters that a name means: one, or those along and across the grain.
pub(crate) fn targets(kind: SurfaceKind, name: &str) -> Vec<usize> {
    let at = |n: &str| kind.params().iter().position(|p| p.name == n);
    match at(name) {
        Some(i) => vec![i],
        None => match (at(&format!("{name}_x")), at(&format!("{name}_y"))) {
            (Some(x), Some(y)) => vec![x, y],
            _ => Vec::new(),
        },
    }
}

/// How a figure names its series.
pub(crate) struct Labels {
    /// The names of all models, each once.
    pub(crate) models: Vec<&'static str>,
    /// What all series have in common: `eta = 0.2`, and so on.
    pub(crate) shared: Vec<String>,
    /// What sets each apart; empty for a single one.
    pub(crate) own: Vec<String>,
}

impl Labels {
    pub(crate) fn new(series: &[Series]) -> Labels {
        let mut models: Vec<&'static str> = Vec::new();
        for s in series {
            if !models.contains(&s.kind.name()) {
                models.push(s.kind.name());
            }
        }
        let common = |pin: &(String, String)| series.iter().all(|s| s.pins.contains(pin));
        let view = series.iter().all(|s| s.same_view(&series[0]));
        let say = |(n, v): &(String, String)| format!("{n} = {v}");
        let shared =
            series.first().map_or(Vec::new(), |s| s.pins.iter().filter(|p| common(p)).map(say).collect());
        let own = |s: &Series| {
            let mut parts = Vec::new();
            if models.len() > 1 {
                parts.push(s.kind.name().to_owned());
            }
            parts.extend(s.pins.iter().filter(|p| !common(p)).map(say));
            if !view {
                parts.push(format!("θ_{{o}} = {}°", s.wo_deg[0]));
            }
            parts.join(", ")
        };
        let own = if series.len() > 1 { series.iter().map(own).collect() } else { vec![String::new()] };
        Labels { models, shared, own }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_find_their_slots() {
        let near = |a: f64, b: f64| (a - b).abs() < 1e-15;
        let mut s = Series::new(SurfaceKind::CookTorrance);
        assert!(s.set("alpha", 0.7) && s.set("k", 1.5) && s.set("diffuse", 0.25) && s.set("form", 1.0));
        assert!(near(s.params.reals[0], 0.7) && near(s.params.reals[1], 1.0));
        assert!(s.params.spectra[1].0.iter().all(|v| near(*v, 1.5)));
        assert!(near(s.params.spectra[2][3], 0.25) && s.params.choices[0] == 1);
        let mut s = Series::new(SurfaceKind::Conductor);
        assert!(s.set("alpha", 0.3) && s.params.reals[..2].iter().all(|v| near(*v, 0.3)));
        assert!(!s.set("alph", 0.3));
    }
}
