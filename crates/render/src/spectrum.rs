//! Spectra of a compiled scene: the description's many forms, brought to four that are quick to look up.

use std::sync::Arc;

use sparrow_math::{InLanes, Real, in_lanes};
use sparrow_scene::SpectrumDesc;
use sparrow_spectra::{
    DenseSpectrum, N_LAMBDA, RgbRole, Sigmoid, Spectrum, Wavelengths, blackbody_normalized, named_spectrum,
    photometric, rgb_spectrum_exact, table_index,
};

/// A spectrum ready for lookup at a path's wavelengths.
#[derive(Clone, Debug)]
pub(crate) enum SceneSpectrum {
    /// The same value everywhere.
    Constant(f32),
    /// A scaled sigmoid polynomial: upsampled RGB.
    Sigmoid(f32, Sigmoid),
    /// A table at 1 nm.
    Dense(Arc<DenseSpectrum>),
    /// Red, green, blue and green, where paths carry these.
    Channels(Spectrum<f32>),
}

impl From<DenseSpectrum> for SceneSpectrum {
    fn from(table: DenseSpectrum) -> SceneSpectrum {
        SceneSpectrum::Dense(Arc::new(table))
    }
}

impl SceneSpectrum {
    /// Resolves a description; `role` says what RGB values mean. Names the reader has not checked are black.
    pub(crate) fn new(desc: &SpectrumDesc, role: RgbRole) -> SceneSpectrum {
        match desc {
            SpectrumDesc::Constant(v) => SceneSpectrum::Constant(*v),
            SpectrumDesc::Rgb(rgb, space) => {
                let s = rgb_spectrum_exact(*rgb, role, *space);
                match (role, rgb) {
                    (RgbRole::Illuminant, _) => SceneSpectrum::Dense(Arc::new(s.to_dense())),
                    #[allow(clippy::float_cmp, reason = "grey is written as three equal numbers")]
                    (_, [r, g, b]) if r == g && g == b => SceneSpectrum::Constant(*r),
                    _ => SceneSpectrum::Sigmoid(s.scale, s.sigmoid),
                }
            }
            SpectrumDesc::Blackbody(kelvin) => SceneSpectrum::Dense(Arc::new(blackbody_normalized(*kelvin))),
            SpectrumDesc::Named(name) => {
                SceneSpectrum::Dense(Arc::new(named_spectrum(name).unwrap_or(DenseSpectrum::constant(0.0))))
            }
            SpectrumDesc::Samples(s) => SceneSpectrum::Dense(Arc::new(DenseSpectrum::from_samples(s))),
        }
    }

    /// Values at a path's wavelengths.
    #[inline]
    pub(crate) fn at(&self, w: &Wavelengths) -> Spectrum<f32> {
        match self {
            SceneSpectrum::Constant(v) => Spectrum::splat(*v),
            SceneSpectrum::Sigmoid(scale, s) => s.at(w) * *scale,
            SceneSpectrum::Dense(d) => d.at(w),
            SceneSpectrum::Channels(c) => *c,
        }
    }

    /// Values times `scale` at the wavelengths of `n` paths, in lanes: [`at`](Self::at) to the bit.
    pub(crate) fn fill(&self, scale: f32, nm: [&[f32]; N_LAMBDA], n: usize, mut out: [&mut [f32]; N_LAMBDA]) {
        let constant = |c: &Spectrum<f32>, out: [&mut [f32]; N_LAMBDA]| {
            out.into_iter().zip(c.0).for_each(|(column, v)| column[..n].fill(v * scale));
        };
        match self {
            SceneSpectrum::Constant(v) => constant(&Spectrum::splat(*v), out),
            SceneSpectrum::Channels(c) => constant(c, out),
            SceneSpectrum::Sigmoid(own, s) => {
                for (nm, out) in nm.iter().zip(&mut out) {
                    in_lanes(FillSigmoid { c: s.c, scales: [*own, scale], nm, out, n });
                }
            }
            SceneSpectrum::Dense(table) => {
                for (nm, out) in nm.iter().zip(&mut out) {
                    in_lanes(FillDense { table: table.values(), scale, nm, out, n });
                }
            }
        }
    }

    /// Multiplied by a number.
    #[must_use]
    pub(crate) fn scaled(&self, s: f32) -> SceneSpectrum {
        match self {
            SceneSpectrum::Constant(v) => SceneSpectrum::Constant(v * s),
            SceneSpectrum::Sigmoid(scale, g) => SceneSpectrum::Sigmoid(scale * s, *g),
            SceneSpectrum::Dense(d) => SceneSpectrum::from(d.scaled(s)),
            SceneSpectrum::Channels(c) => SceneSpectrum::Channels(*c * s),
        }
    }

    /// `f` of each value.
    #[must_use]
    pub(crate) fn map(&self, f: impl Fn(f32) -> f32) -> SceneSpectrum {
        match self {
            SceneSpectrum::Constant(v) => SceneSpectrum::Constant(f(*v)),
            SceneSpectrum::Channels(c) => SceneSpectrum::Channels(c.map(f)),
            SceneSpectrum::Sigmoid(..) | SceneSpectrum::Dense(_) => {
                SceneSpectrum::from(self.to_dense().map(f))
            }
        }
    }

    /// As a table.
    pub(crate) fn to_dense(&self) -> DenseSpectrum {
        match self {
            SceneSpectrum::Constant(v) => DenseSpectrum::constant(*v),
            SceneSpectrum::Sigmoid(scale, s) => DenseSpectrum::from_fn(|l| scale * s.value(l)),
            SceneSpectrum::Dense(d) => (**d).clone(),
            // Blue, green and red thirds of what is seen.
            SceneSpectrum::Channels(c) => {
                DenseSpectrum::from_fn(|l| c[if l < 490.0 { 2 } else { usize::from(l < 580.0) }])
            }
        }
    }
}

struct FillSigmoid<'a> {
    c: [f32; 3],
    scales: [f32; 2],
    nm: &'a [f32],
    out: &'a mut [f32],
    n: usize,
}

impl InLanes for FillSigmoid<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let [a, b, c] = self.c;
        let c = [R::of(a.into()), R::of(b.into()), R::of(c.into())];
        let [own, scale] = self.scales;
        for k in (0..self.n).step_by(R::WIDTH) {
            let v = Sigmoid::eval(c, R::load(self.nm, k)) * R::of(own.into()) * R::of(scale.into());
            v.store(self.out, k);
        }
    }
}

/// The value of a [`DenseSpectrum`] at `nm`: that of the nearest whole nanometre, as [`Wavelengths`] has it.
#[inline(always)]
pub(crate) fn dense_at<R: Real>(table: &[f32], nm: R) -> R {
    table_index(nm).look_up(table)
}

struct FillDense<'a> {
    table: &'a [f32],
    scale: f32,
    nm: &'a [f32],
    out: &'a mut [f32],
    n: usize,
}

impl InLanes for FillDense<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        for k in (0..self.n).step_by(R::WIDTH) {
            (dense_at(self.table, R::load(self.nm, k)) * R::of(self.scale.into())).store(self.out, k);
        }
    }
}

/// The emission of a light, as a table, brought to unit luminous output before its scale, as pbrt-v4 does.
///
/// For RGB the illuminant of the colour space is what is normalised, not the colour: RGB (1, 1, 1) has luminance 1.
pub(crate) fn light_table(desc: &SpectrumDesc) -> DenseSpectrum {
    let (table, reference) = match desc {
        SpectrumDesc::Rgb(_, space) => {
            (SceneSpectrum::new(desc, RgbRole::Illuminant).to_dense(), photometric(space.illuminant()))
        }
        SpectrumDesc::Constant(_)
        | SpectrumDesc::Blackbody(_)
        | SpectrumDesc::Named(_)
        | SpectrumDesc::Samples(_) => {
            let t = SceneSpectrum::new(desc, RgbRole::Illuminant).to_dense();
            let y = photometric(&t);
            (t, y)
        }
    };
    if reference > 0.0 { table.scaled(1.0 / reference) } else { table }
}
