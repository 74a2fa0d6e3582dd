//! Spectra given as parameters.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use sparrow_spectra::{named_spectrum, spectrum_names};

use super::Builder;
use crate::desc::SpectrumDesc;
use crate::diagnostic::Span;
use crate::params::{Param, Params, Values};
use crate::spd;
use crate::suggest::nearest;
use crate::tables::Type;

/// Sampled spectra by file; `None` for those that could not be read.
pub(super) type Cache = HashMap<PathBuf, Option<Arc<[(f32, f32)]>>>;

/// What a spectrum describes, which bounds its RGB values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// A reflectance: RGB in 0..1.
    Albedo,
    /// Without an upper bound.
    Unbounded,
    /// Light.
    Illuminant,
}

pub(super) const SPECTRUM_TYPES: [Type; 3] = [Type::Rgb, Type::Spectrum, Type::Blackbody];

impl Builder {
    /// The spectrum a parameter gives; `None` where it is not given or faulty.
    pub(super) fn spectrum(&mut self, params: &Params, name: &str, role: Role) -> Option<SpectrumDesc> {
        let param = params.find(name, &SPECTRUM_TYPES)?;
        self.spectrum_of(param, role)
    }

    /// The spectrum of a parameter that has one of [`SPECTRUM_TYPES`].
    pub(super) fn spectrum_of(&mut self, param: &Param, role: Role) -> Option<SpectrumDesc> {
        match (&param.values, param.ty) {
            (Values::Triples(v), _) => self.rgb(param, *v.first()?, role),
            (Values::Floats(v), Type::Blackbody) => {
                let kelvin = *v.first()?;
                if kelvin > 0.0 {
                    return Some(SpectrumDesc::Blackbody(kelvin));
                }
                let message =
                    format!("\"{}\" has a temperature of {kelvin} K; give one above zero", param.name);
                self.report.error(param.at, message);
                None
            }
            (Values::Floats(v), _) => self.samples(param, v),
            (Values::Texts(v), _) => {
                let (name, at) = v.first()?;
                self.named(name, *at)
            }
            _ => None,
        }
    }

    fn rgb(&mut self, param: &Param, rgb: [f32; 3], role: Role) -> Option<SpectrumDesc> {
        let problem = if rgb.iter().any(|&v| v < 0.0) {
            "has a negative component; give values from 0"
        } else if role == Role::Albedo && rgb.iter().any(|&v| v > 1.0) {
            "is a reflectance with a component above 1; give values from 0 to 1"
        } else {
            return Some(SpectrumDesc::Rgb(rgb, param.color_space));
        };
        self.report.error(param.at, format!("\"rgb {}\" {problem}", param.name));
        None
    }

    fn samples(&mut self, param: &Param, v: &[f32]) -> Option<SpectrumDesc> {
        let name = &param.name;
        let (pairs, rest) = v.as_chunks::<2>();
        if !rest.is_empty() {
            let message = format!(
                "\"spectrum {name}\" has {} numbers; give pairs of wavelength in nm and value",
                v.len()
            );
            self.report.error(param.at, message);
            return None;
        }
        if let Some(w) = pairs.windows(2).find(|w| w[1][0] <= w[0][0]) {
            let message = format!(
                "\"spectrum {name}\" goes from {} nm to {} nm; list the wavelengths in ascending order",
                w[0][0], w[1][0]
            );
            self.report.error(param.at, message);
            return None;
        }
        if let [_] = pairs {
            let message = format!(
                "\"spectrum {name}\" has one sample and is zero elsewhere; was \"float\" or \"rgb\" meant?"
            );
            self.report.warn(param.at, message);
        }
        Some(sampled(pairs.iter().map(|&[l, v]| (l, v)).collect()))
    }

    fn named(&mut self, name: &str, at: Span) -> Option<SpectrumDesc> {
        if named_spectrum(name).is_some() {
            return Some(SpectrumDesc::Named(name.to_string()));
        }
        let path = self.resolve(name);
        if !path.is_file() {
            let remedy = match nearest(name, spectrum_names().iter().copied()) {
                Some(n) => format!("did you mean \"{n}\"?"),
                None => format!("name one of pbrt-v4's spectra, or a file (looked for {})", path.display()),
            };
            self.report.error(at, format!("there is no spectrum \"{name}\"; {remedy}"));
            return None;
        }
        if let Some(known) = self.spectra.get(&path) {
            return known.clone().map(SpectrumDesc::Samples);
        }
        let read = match spd::read(&path) {
            Ok(samples) => {
                self.report.add_file(path.clone());
                Some(sampled(samples))
            }
            Err(e) => {
                self.report.error(at, format!("the spectrum \"{name}\" cannot be read: {e}"));
                None
            }
        };
        if let Some(SpectrumDesc::Samples(s)) = &read {
            self.spectra.insert(path, Some(Arc::clone(s)));
        } else if read.is_none() {
            self.spectra.insert(path, None);
        }
        read
    }
}

/// Samples that hold one value over the visible range are that value.
fn sampled(samples: Vec<(f32, f32)>) -> SpectrumDesc {
    if let (Some(&(first, value)), Some(&(last, _))) = (samples.first(), samples.last()) {
        let same = samples.iter().all(|s| s.1.to_bits() == value.to_bits());
        if same && first <= sparrow_spectra::LAMBDA_MIN && last >= sparrow_spectra::LAMBDA_MAX {
            return SpectrumDesc::Constant(value);
        }
    }
    SpectrumDesc::Samples(samples.into())
}
