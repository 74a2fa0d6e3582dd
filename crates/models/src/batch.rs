//! The batch form of every model: many points of one model at once, in lanes, from columns of numbers.
//!
//! The same text as for one ray, run in lanes inside a kernel that is compiled for the vector unit
//! found at run time. With fused multiply-add off, which is the case here, the results equal those of `f32` bit for bit,
//! on every machine. What does not fill the lanes, and all where there are none, is computed one by one.

use core::marker::PhantomData;
use core::ops::Range;

use sparrow_math::{InLanes, LocalDir, Real, only_in_lanes, vec3, widest};
use sparrow_spectra::{N_LAMBDA, Spectrum};

use crate::{
    BsdfSample, Kind, MAX_CHOICES, MAX_REALS, MAX_SPECTRA, Model, ParamBlock, ParamInfo, ParamKind, Uniforms,
};

/// Directions, one column per component; all of one length.
#[derive(Clone, Copy, Debug)]
pub struct DirColumns<'a> {
    /// Components along the tangent.
    pub x: &'a [f32],
    /// Components along the bitangent.
    pub y: &'a [f32],
    /// Components along the normal.
    pub z: &'a [f32],
}

/// Parameters, one column each; a column of one number holds for all points. Unused columns stay empty.
#[derive(Clone, Copy, Debug, Default)]
pub struct ParamColumns<'a> {
    /// Values of the `Real` parameters.
    pub reals: [&'a [f32]; MAX_REALS],
    /// Values of the spectral parameters, per wavelength.
    pub spectra: [[&'a [f32]; N_LAMBDA]; MAX_SPECTRA],
    /// Places of the `Choice` parameters, the same for all points.
    pub choices: [u8; MAX_CHOICES],
    /// Wavelengths in nm; where empty, those of [`ParamBlock::default`].
    pub lambda: [&'a [f32]; N_LAMBDA],
    /// Offsets of the rays across a fibre; 0 where empty.
    pub h: &'a [f32],
}

/// Where values and densities go.
#[derive(Debug)]
pub struct EvalColumns<'a> {
    /// `f |cos theta_i|`, per wavelength.
    pub f_cos: [&'a mut [f32]; N_LAMBDA],
    /// Density in 1/sr.
    pub pdf: &'a mut [f32],
}

/// Where samples go.
#[derive(Debug)]
pub struct SampleColumns<'a> {
    /// Components of `wi`.
    pub wi: [&'a mut [f32]; 3],
    /// Value times cosine over density, per wavelength; zero where the path ends.
    pub weight: [&'a mut [f32]; N_LAMBDA],
    /// Density in 1/sr, or the probability of a delta lobe; zero where the path ends.
    pub density: &'a mut [f32],
    /// Relative index that was crossed.
    pub eta: &'a mut [f32],
    /// 1 for delta lobes, else 0.
    pub delta: &'a mut [f32],
}

/// `f_cos` and `pdf` of one model at many points.
///
/// Panics where columns differ in length.
pub fn f_cos_pdf(
    kind: impl Kind,
    params: &ParamColumns<'_>,
    wo: &DirColumns<'_>,
    wi: &DirColumns<'_>,
    out: &mut EvalColumns<'_>,
) {
    kind.eval_columns(params, wo, wi, out);
}

/// Samples of one model at many points; `u` holds the columns of [`Uniforms`]: lobe, then direction.
///
/// Panics where columns differ in length.
pub fn sample(
    kind: impl Kind,
    params: &ParamColumns<'_>,
    wo: &DirColumns<'_>,
    u: &[&[f32]; 3],
    out: &mut SampleColumns<'_>,
) {
    kind.sample_columns(params, wo, u, out);
}

/// A model without its number type.
pub(crate) trait Family {
    /// The model over `R`.
    type Of<R: Real>: Model<R>;
    /// Value times cosine, and density.
    fn f_cos_pdf<R: Real>(m: &Self::Of<R>, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R);
    /// Draws a direction.
    fn sample<R: Real>(m: &Self::Of<R>, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R>;
    /// The first of one point, by way of the enum, whose code in `f32` is there in any case.
    fn f_cos_pdf_alone(p: &ParamBlock<f32>, wo: LocalDir<f32>, wi: LocalDir<f32>) -> (Spectrum<f32>, f32);
    /// The second of one point, likewise.
    fn sample_alone(p: &ParamBlock<f32>, wo: LocalDir<f32>, u: Uniforms<f32>) -> BsdfSample<f32>;
}

#[inline(always)]
fn dir<R: Real>(c: &DirColumns<'_>, i: usize) -> LocalDir<R> {
    LocalDir::new(vec3(R::load(c.x, i), R::load(c.y, i), R::load(c.z, i)))
}

/// Reads a parameter column: one number for all, one each, or none.
#[inline(always)]
fn value<R: Real>(column: &[f32], i: usize) -> R {
    match column {
        [] => R::ZERO,
        [one] => R::of(f64::from(*one)),
        all => R::load(all, i),
    }
}

/// How many numbers and spectra a table holds.
const fn counts(table: &[ParamInfo]) -> (usize, usize) {
    let (mut i, mut reals, mut spectra) = (0, 0, 0);
    while i < table.len() {
        match table[i].kind {
            ParamKind::Real => reals += 1,
            ParamKind::Albedo | ParamKind::Unbounded => spectra += 1,
            ParamKind::Choice(_) => {}
        }
        i += 1;
    }
    (reals, spectra)
}

impl ParamColumns<'_> {
    /// No parameter differs between points; the offset `h` may.
    fn constant(&self) -> bool {
        let spectra = self.spectra.iter().flatten();
        self.reals.iter().chain(spectra).chain(&self.lambda).all(|column| column.len() <= 1)
    }
    /// Points from the first of `range` on that surely share their parameters: whole lanes.
    fn shared(&self, range: &Range<usize>, lanes: usize) -> usize {
        if self.constant() { range.len().max(lanes) } else { lanes }
    }
}

/// Reads the columns that the model's table names; others cost nothing.
#[inline(always)]
fn block<R: Real, M: Model<R>>(p: &ParamColumns<'_>, i: usize) -> ParamBlock<R> {
    let (reals, spectra) = const { counts(M::PARAMS) };
    let mut block = ParamBlock { choices: p.choices, h: value(p.h, i), ..ParamBlock::default() };
    for (slot, column) in block.reals.iter_mut().zip(&p.reals).take(reals) {
        *slot = value(column, i);
    }
    for (slot, columns) in block.spectra.iter_mut().zip(&p.spectra).take(spectra) {
        *slot = Spectrum([
            value(columns[0], i),
            value(columns[1], i),
            value(columns[2], i),
            value(columns[3], i),
        ]);
    }
    for (slot, column) in block.lambda.0.iter_mut().zip(&p.lambda) {
        if !column.is_empty() {
            *slot = value(column, i);
        }
    }
    block
}

#[inline(always)]
fn uniforms<R: Real>(u: &[&[f32]; 3], i: usize) -> Uniforms<R> {
    Uniforms { lobe: R::load(u[0], i), dir: [R::load(u[1], i), R::load(u[2], i)] }
}

#[inline(always)]
fn put<R: Real>(s: Spectrum<R>, columns: &mut [&mut [f32]; N_LAMBDA], i: usize) {
    let [a, b, c, d] = columns;
    s.0[0].store(a, i);
    s.0[1].store(b, i);
    s.0[2].store(c, i);
    s.0[3].store(d, i);
}

impl EvalColumns<'_> {
    #[inline(always)]
    fn put<R: Real>(&mut self, (f_cos, pdf): (Spectrum<R>, R), i: usize) {
        put(f_cos, &mut self.f_cos, i);
        pdf.store(self.pdf, i);
    }
}

impl SampleColumns<'_> {
    #[inline(always)]
    fn put<R: Real>(&mut self, s: BsdfSample<R>, i: usize) {
        let v = s.wi.v();
        v.x.store(self.wi[0], i);
        v.y.store(self.wi[1], i);
        v.z.store(self.wi[2], i);
        put(s.weight.only_where(s.valid), &mut self.weight, i);
        s.density.only_where(s.valid).store(self.density, i);
        s.eta.store(self.eta, i);
        R::ONE.only_where(s.delta).store(self.delta, i);
    }
}

/// The loop of [`f_cos_pdf`] over `range`, whose length is a multiple of the lanes.
struct Eval<'a, 'b, F> {
    p: &'a ParamColumns<'a>,
    wo: &'a DirColumns<'a>,
    wi: &'a DirColumns<'a>,
    out: &'a mut EvalColumns<'b>,
    range: Range<usize>,
    family: PhantomData<F>,
}
impl<F: Family> InLanes for Eval<'_, '_, F> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let shared = self.p.shared(&self.range, R::WIDTH);
        for first in self.range.step_by(shared) {
            // What depends on shared parameters alone is computed before this loop.
            let block = block::<R, F::Of<R>>(self.p, first);
            for i in (first..first + shared).step_by(R::WIDTH) {
                let model = F::Of::<R>::new(&ParamBlock { h: value(self.p.h, i), ..block });
                self.out.put(F::f_cos_pdf(&model, dir(self.wo, i), dir(self.wi, i)), i);
            }
        }
    }
}

/// The loop of [`sample`] over `range`, whose length is a multiple of the lanes.
struct Draw<'a, 'b, F> {
    p: &'a ParamColumns<'a>,
    wo: &'a DirColumns<'a>,
    u: &'a [&'a [f32]; 3],
    out: &'a mut SampleColumns<'b>,
    range: Range<usize>,
    family: PhantomData<F>,
}
impl<F: Family> InLanes for Draw<'_, '_, F> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let (u, out) = (self.u, self.out);
        let shared = self.p.shared(&self.range, R::WIDTH);
        for first in self.range.step_by(shared) {
            let block = block::<R, F::Of<R>>(self.p, first);
            for i in (first..first + shared).step_by(R::WIDTH) {
                let model = F::Of::<R>::new(&ParamBlock { h: value(self.p.h, i), ..block });
                out.put(F::sample(&model, dir(self.wo, i), uniforms(u, i)), i);
            }
        }
    }
}

/// Evaluates one model, in lanes as far as they are filled.
#[inline(never)]
pub(crate) fn eval<F: Family>(
    p: &ParamColumns<'_>,
    wo: &DirColumns<'_>,
    wi: &DirColumns<'_>,
    out: &mut EvalColumns<'_>,
) {
    let n = out.pdf.len();
    let whole = n - n % widest();
    let lanes = Eval::<F> { p, wo, wi, out, range: 0..whole, family: PhantomData };
    let done = if only_in_lanes(lanes).is_ok() { whole } else { 0 };
    for i in done..n {
        out.put(F::f_cos_pdf_alone(&block::<f32, F::Of<f32>>(p, i), dir(wo, i), dir(wi, i)), i);
    }
}

/// Samples one model, in lanes as far as they are filled.
#[inline(never)]
pub(crate) fn draw<F: Family>(
    p: &ParamColumns<'_>,
    wo: &DirColumns<'_>,
    u: &[&[f32]; 3],
    out: &mut SampleColumns<'_>,
) {
    let n = out.density.len();
    let whole = n - n % widest();
    let lanes = Draw::<F> { p, wo, u, out, range: 0..whole, family: PhantomData };
    let done = if only_in_lanes(lanes).is_ok() { whole } else { 0 };
    for i in done..n {
        out.put(F::sample_alone(&block::<f32, F::Of<f32>>(p, i), dir(wo, i), uniforms(u, i)), i);
    }
}
