//! The batch form of every model: many points of one model at once, in lanes, from columns of numbers.
//!
//! The same text as for one ray, run as [`Lanes`] of eight inside a kernel that is compiled for the vector unit
//! found at run time. With fused multiply-add off, which is the case here, the results equal those of `f32` bit for bit,
//! on every machine. What does not fill eight lanes is computed one by one.

use sparrow_math::{Lanes, LocalDir, Real, vec3};
use sparrow_spectra::{N_LAMBDA, Spectrum};

use crate::{Bsdf, MAX_CHOICES, MAX_REALS, MAX_SPECTRA, Model, ParamBlock, SurfaceKind, Uniforms};

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
    kind: SurfaceKind,
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
    kind: SurfaceKind,
    params: &ParamColumns<'_>,
    wo: &DirColumns<'_>,
    u: &[&[f32]; 3],
    out: &mut SampleColumns<'_>,
) {
    kind.sample_columns(params, wo, u, out);
}

/// Lanes of the batch form.
const WIDTH: usize = 8;
pub(crate) type L = Lanes<WIDTH>;
type Range = core::ops::Range<usize>;

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

#[inline(always)]
fn bind<R: Real, M: Model<R>>(p: &ParamColumns<'_>, i: usize) -> M {
    let mut block = ParamBlock { choices: p.choices, ..ParamBlock::default() };
    for (slot, column) in block.reals.iter_mut().zip(&p.reals) {
        *slot = value(column, i);
    }
    for (slot, columns) in block.spectra.iter_mut().zip(&p.spectra) {
        *slot = Spectrum([
            value(columns[0], i),
            value(columns[1], i),
            value(columns[2], i),
            value(columns[3], i),
        ]);
    }
    M::new(&block)
}

#[inline(always)]
fn put<R: Real>(s: Spectrum<R>, columns: &mut [&mut [f32]; N_LAMBDA], i: usize) {
    let [a, b, c, d] = columns;
    s.0[0].store(a, i);
    s.0[1].store(b, i);
    s.0[2].store(c, i);
    s.0[3].store(d, i);
}

/// The loop of [`f_cos_pdf`] for one model and one number type.
#[inline(always)]
fn eval_model<R: Real, M: Model<R> + Bsdf<R>>(
    p: &ParamColumns<'_>,
    wo: &DirColumns<'_>,
    wi: &DirColumns<'_>,
    out: &mut EvalColumns<'_>,
    range: Range,
) {
    for i in range.step_by(R::WIDTH) {
        let (f_cos, pdf) = bind::<R, M>(p, i).f_cos_pdf(dir(wo, i), dir(wi, i));
        put(f_cos, &mut out.f_cos, i);
        pdf.store(out.pdf, i);
    }
}

/// The loop of [`sample`] for one model and one number type.
#[inline(always)]
fn sample_model<R: Real, M: Model<R> + Bsdf<R>>(
    p: &ParamColumns<'_>,
    wo: &DirColumns<'_>,
    u: &[&[f32]; 3],
    out: &mut SampleColumns<'_>,
    range: Range,
) {
    for i in range.step_by(R::WIDTH) {
        let u = Uniforms { lobe: R::load(u[0], i), dir: [R::load(u[1], i), R::load(u[2], i)] };
        let s = bind::<R, M>(p, i).sample(dir(wo, i), u);
        let v = s.wi.v();
        v.x.store(out.wi[0], i);
        v.y.store(out.wi[1], i);
        v.z.store(out.wi[2], i);
        put(s.weight.only_where(s.valid), &mut out.weight, i);
        s.density.only_where(s.valid).store(out.density, i);
        s.eta.store(out.eta, i);
        R::ONE.only_where(s.delta).store(out.delta, i);
    }
}

/// Evaluates one model, in lanes as far as they are filled. `S` and `V` are the model over `f32` and over lanes.
///
/// A function of its own for each model: all of them in one would take the compiler minutes.
#[inline(never)]
pub(crate) fn eval<S: Model<f32> + Bsdf<f32>, V: Model<L> + Bsdf<L>>(
    p: &ParamColumns<'_>,
    wo: &DirColumns<'_>,
    wi: &DirColumns<'_>,
    out: &mut EvalColumns<'_>,
) {
    let n = out.pdf.len();
    let whole = n - n % WIDTH;
    kernel::eval::<V>(p, wo, wi, out, 0..whole);
    eval_model::<f32, S>(p, wo, wi, out, whole..n);
}

/// Samples one model, in lanes as far as they are filled. `S` and `V` are the model over `f32` and over lanes.
#[inline(never)]
pub(crate) fn draw<S: Model<f32> + Bsdf<f32>, V: Model<L> + Bsdf<L>>(
    p: &ParamColumns<'_>,
    wo: &DirColumns<'_>,
    u: &[&[f32]; 3],
    out: &mut SampleColumns<'_>,
) {
    let n = out.density.len();
    let whole = n - n % WIDTH;
    kernel::draw::<V>(p, wo, u, out, 0..whole);
    sample_model::<f32, S>(p, wo, u, out, whole..n);
}

/// Kernels for the vector units, chosen at run time: the only place of this crate that needs `unsafe`.
mod kernel {
    use super::{
        Bsdf, DirColumns, EvalColumns, L, Model, ParamColumns, Range, SampleColumns, eval_model, sample_model,
    };

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn eval_avx2<V: Model<L> + Bsdf<L>>(
        p: &ParamColumns<'_>,
        wo: &DirColumns<'_>,
        wi: &DirColumns<'_>,
        out: &mut EvalColumns<'_>,
        range: Range,
    ) {
        eval_model::<L, V>(p, wo, wi, out, range);
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn draw_avx2<V: Model<L> + Bsdf<L>>(
        p: &ParamColumns<'_>,
        wo: &DirColumns<'_>,
        u: &[&[f32]; 3],
        out: &mut SampleColumns<'_>,
        range: Range,
    ) {
        sample_model::<L, V>(p, wo, u, out, range);
    }

    pub(super) fn eval<V: Model<L> + Bsdf<L>>(
        p: &ParamColumns<'_>,
        wo: &DirColumns<'_>,
        wi: &DirColumns<'_>,
        out: &mut EvalColumns<'_>,
        range: Range,
    ) {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has AVX2, which is all that the kernel asks for.
            #[allow(unsafe_code, reason = "calling a kernel compiled for a feature found at run time")]
            return unsafe { eval_avx2::<V>(p, wo, wi, out, range) };
        }
        eval_model::<L, V>(p, wo, wi, out, range);
    }

    pub(super) fn draw<V: Model<L> + Bsdf<L>>(
        p: &ParamColumns<'_>,
        wo: &DirColumns<'_>,
        u: &[&[f32]; 3],
        out: &mut SampleColumns<'_>,
        range: Range,
    ) {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has AVX2, which is all that the kernel asks for.
            #[allow(unsafe_code, reason = "calling a kernel compiled for a feature found at run time")]
            return unsafe { draw_avx2::<V>(p, wo, u, out, range) };
        }
        sample_model::<L, V>(p, wo, u, out, range);
    }
}
