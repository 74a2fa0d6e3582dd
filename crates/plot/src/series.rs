//! One model with its parameters and a view: [`Series`].

use sparrow_math::{LocalDir, Real, vec3};
use sparrow_models::{Fibre, FibreKind, Kind, ParamBlock, ParamInfo, ParamKind, Surface, SurfaceKind};
use sparrow_spectra::Spectrum;

/// A table of models that a figure can show.
pub trait Family: Kind {
    /// Models are those of fibres: the polar angle of a view is its inclination, and offsets across the fibre are told apart.
    const FIBRES: bool;
    /// Polar angle or inclination of the view where none is given, in degrees.
    const VIEW: f64;
}

impl Family for SurfaceKind {
    const FIBRES: bool = false;
    const VIEW: f64 = 45.0;
}

impl Family for FibreKind {
    const FIBRES: bool = true;
    const VIEW: f64 = 20.0;
}

/// The offset of the ray, which is set like a parameter of a fibre.
const OFFSET: ParamInfo = ParamInfo::real("h").range(-1.0, 1.0);

/// A model, its parameters, and the direction it is seen from.
#[derive(Clone, Debug)]
pub struct Series<K = SurfaceKind> {
    /// The model.
    pub kind: K,
    /// All parameters, in the ranges of the model's table.
    pub params: ParamBlock<f64>,
    /// Where rays meet a fibre, in radii from its axis; none for the mean over its width.
    pub h: Option<f64>,
    /// What was asked for by name: parameter and value as written, in that order.
    pub pins: Vec<(String, String)>,
    /// Polar angle and azimuth of `wo`, in degrees; of fibres inclination and azimuth.
    pub wo_deg: [f64; 2],
}

impl Series {
    /// The model in double precision.
    pub fn model(&self) -> Surface<f64> {
        self.kind.bind(&self.params)
    }
    /// Towards the viewer.
    pub fn wo(&self) -> LocalDir<f64> {
        direction(self.wo_deg)
    }
}

impl Series<FibreKind> {
    /// The model in double precision at the offset `h`.
    pub fn model_at(&self, h: f64) -> Fibre<f64> {
        self.kind.bind(&ParamBlock { h, ..self.params })
    }
    /// Towards the viewer.
    pub fn wo(&self) -> LocalDir<f64> {
        inclined(self.wo_deg)
    }
}

impl<K: Family> Series<K> {
    /// A model with every parameter at its default, seen from its family's view.
    pub fn new(kind: K) -> Series<K> {
        let params = ParamBlock::defaults(kind.params());
        Series { kind, params, h: None, pins: Vec::new(), wo_deg: [K::VIEW, 0.0] }
    }
    /// Seen from the same direction.
    pub(crate) fn same_view(&self, o: &Series<K>) -> bool {
        self.wo_deg.map(f64::to_bits) == o.wo_deg.map(f64::to_bits)
    }
    /// Sets a parameter; a number for a spectrum holds at all wavelengths, one for a choice is the place of its name.
    ///
    /// False where the model has no such parameter; `NAME` alone then means both `NAME_x` and `NAME_y`, where they exist.
    pub fn set(&mut self, name: &str, value: f64) -> bool {
        if is_offset::<K>(name) {
            self.h = Some(value);
            return true;
        }
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

/// The direction of inclination and azimuth in degrees, in a fibre's frame.
pub(crate) fn inclined([theta, phi]: [f64; 2]) -> LocalDir<f64> {
    let ((s, c), (t, d)) = (Real::sin_cos(theta.to_radians()), Real::sin_cos(phi.to_radians()));
    LocalDir::new(vec3(s, c * d, c * t))
}

fn is_offset<K: Family>(name: &str) -> bool {
    K::FIBRES && name == OFFSET.name
}

/// What a name means: the entry of the model's table, or the offset.
pub(crate) fn meaning<K: Family>(kind: K, name: &str) -> Option<&'static ParamInfo> {
    if is_offset::<K>(name) {
        return Some(const { &OFFSET });
    }
    targets(kind, name).first().map(|i| &kind.params()[*i])
}

/// Places in the model's table of the parameters that a name means: one, or those along and across the grain.
pub(crate) fn targets<K: Kind>(kind: K, name: &str) -> Vec<usize> {
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
    pub(crate) fn new<K: Family>(series: &[Series<K>]) -> Labels {
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
        let own = |s: &Series<K>| {
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
        assert!(!s.set("alph", 0.3) && !s.set("h", 0.3));
        let mut s = Series::new(FibreKind::Hair);
        assert!(s.set("h", 0.5) && s.h == Some(0.5) && s.set("beta_m", 0.1) && near(s.params.reals[1], 0.1));
    }
}
