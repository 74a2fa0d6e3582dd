//! Parameter tables: what a model can be told, written once and read by everything else.

use sparrow_math::Real;
use sparrow_spectra::Spectrum;

/// What kind of number a parameter takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParamKind {
    /// One number.
    Real,
    /// A reflectance or another spectrum that stays in 0..1; RGB values are upsampled as reflectances.
    Albedo,
    /// A spectrum without an upper bound, such as a refractive index; RGB values are upsampled with a scale.
    Unbounded,
    /// One of several names; its place among them is what the model gets.
    Choice(&'static [&'static str]),
}

/// One parameter of a model.
///
/// The scene reader's checks, the command's help and the random parameters of the tests read this
/// table; nobody writes a range twice.
#[derive(Clone, Copy, Debug)]
pub struct ParamInfo {
    /// Name in scenes and on the command line, snake case.
    pub name: &'static str,
    /// What it takes.
    pub kind: ParamKind,
    /// Unit; "1" for pure numbers.
    pub unit: &'static str,
    /// Value where the user gives none; for a spectrum, the same at every wavelength.
    pub default: f64,
    /// What is accepted.
    pub range: [f64; 2],
    /// What a slider offers.
    pub soft: [f64; 2],
    /// One sentence.
    pub doc: &'static str,
}

impl ParamInfo {
    const fn new(name: &'static str, kind: ParamKind, range: [f64; 2]) -> Self {
        ParamInfo { name, kind, unit: "1", default: 0.5, range, soft: range, doc: "" }
    }
    /// A number, in 0..1 unless [`range`](Self::range) says otherwise.
    pub const fn real(name: &'static str) -> Self {
        Self::new(name, ParamKind::Real, [0.0, 1.0])
    }
    /// A spectrum in 0..1.
    pub const fn albedo(name: &'static str) -> Self {
        Self::new(name, ParamKind::Albedo, [0.0, 1.0])
    }
    /// A spectrum without an upper bound.
    pub const fn unbounded(name: &'static str) -> Self {
        Self::new(name, ParamKind::Unbounded, [0.0, f64::INFINITY])
    }
    /// One of several names, the first unless [`default`](Self::default) gives the place of another.
    pub const fn choice(name: &'static str, names: &'static [&'static str]) -> Self {
        let p = Self::new(name, ParamKind::Choice(names), [0.0, (names.len() - 1) as f64]);
        ParamInfo { default: 0.0, ..p }
    }
    /// Sets the unit.
    pub const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = unit;
        self
    }
    /// Sets the default.
    pub const fn default(mut self, v: f64) -> Self {
        self.default = v;
        self
    }
    /// Sets what is accepted, and what a slider offers.
    pub const fn range(mut self, lo: f64, hi: f64) -> Self {
        self.range = [lo, hi];
        self.soft = [lo, hi];
        self
    }
    /// Sets what a slider offers.
    pub const fn soft(mut self, lo: f64, hi: f64) -> Self {
        self.soft = [lo, hi];
        self
    }
    /// Sets the sentence.
    pub const fn doc(mut self, doc: &'static str) -> Self {
        self.doc = doc;
        self
    }
}

/// Most numbers a model may take.
pub const MAX_REALS: usize = 12;
/// Most spectra a model may take.
pub const MAX_SPECTRA: usize = 5;
/// Most choices a model may take.
pub const MAX_CHOICES: usize = 6;
/// The wavelength in nm that stands for all where none are given.
pub const DEFAULT_NM: f64 = 550.0;

/// The values of a model's parameters at one point and one set of wavelengths: numbers, spectra and choices, each
/// in the order in which the model's table lists them. Choices are the same in all lanes.
#[derive(Clone, Copy, Debug)]
pub struct ParamBlock<R> {
    /// Values of the `Real` parameters.
    pub reals: [R; MAX_REALS],
    /// Values of the `Albedo` and `Unbounded` parameters.
    pub spectra: [Spectrum<R>; MAX_SPECTRA],
    /// Places of the `Choice` parameters among their names.
    pub choices: [u8; MAX_CHOICES],
    /// Wavelengths of the path in nm, in the order of a spectrum's values; [`DEFAULT_NM`] where nobody says. No parameter:
    /// whoever binds a model fills them in, and only models of interference or diffraction read them.
    pub lambda: Spectrum<R>,
    /// Offset of the ray from the axis of a fibre, in radii, -1 to 1: the sine of the angle from the normal's azimuth to the viewer's,
    /// `-wo.y / sqrt(wo.y^2 + wo.z^2)` on a cylinder; `2 v - 1` across a curve. No parameter either; surfaces do not read it.
    pub h: R,
}

impl<R: Real> Default for ParamBlock<R> {
    fn default() -> Self {
        ParamBlock {
            reals: [R::ZERO; MAX_REALS],
            spectra: [Spectrum::ZERO; MAX_SPECTRA],
            choices: [0; MAX_CHOICES],
            lambda: Spectrum::splat(R::of(DEFAULT_NM)),
            h: R::ZERO,
        }
    }
}

impl<R: Real> ParamBlock<R> {
    /// Every parameter of `table` at its default.
    pub fn defaults(table: &[ParamInfo]) -> Self {
        let mut block = Self::default();
        let (mut r, mut s, mut c) = (0, 0, 0);
        for p in table {
            match p.kind {
                ParamKind::Real => {
                    block.reals[r] = R::of(p.default);
                    r += 1;
                }
                ParamKind::Albedo | ParamKind::Unbounded => {
                    block.spectra[s] = Spectrum::splat(R::of(p.default));
                    s += 1;
                }
                ParamKind::Choice(_) => {
                    block.choices[c] = p.default as u8;
                    c += 1;
                }
            }
        }
        block
    }
}
