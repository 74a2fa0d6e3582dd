//! A model in one number type, behind one face: [`Column`].

use std::fmt::Debug;
use std::marker::PhantomData;

use sparrow_math::{LocalDir, Real, Vec3};
use sparrow_models::batch::{self, DirColumns, EvalColumns, ParamColumns, SampleColumns};
use sparrow_models::{Bcsdf, Bsdf, BsdfSample, Kind, MAX_REALS, MAX_SPECTRA, ParamBlock, Uniforms};
use sparrow_spectra::{N_LAMBDA, Spectrum};

use crate::question::ColumnName;

/// A direction as verification sees it, whatever the column computes with.
pub(crate) type Dir = LocalDir<f64>;

/// One sample, in `f64`.
#[derive(Clone, Copy, Debug)]
pub struct Drawn {
    /// Towards the light.
    pub wi: LocalDir<f64>,
    /// `f_cos / density`.
    pub weight: [f64; N_LAMBDA],
    /// Density in 1/sr, or the probability of a delta lobe.
    pub density: f64,
    /// Relative index that was crossed.
    pub eta: f64,
    /// From a delta lobe.
    pub delta: bool,
    /// The path goes on.
    pub valid: bool,
}

impl Drawn {
    /// `weight eta^2`: radiance is squeezed where the index grows, energy is not.
    pub(crate) fn energy(&self) -> [f64; N_LAMBDA] {
        self.weight.map(|w| w * self.eta * self.eta)
    }
    /// From a lobe with a density.
    pub(crate) fn is_smooth(&self) -> bool {
        self.valid && !self.delta
    }
}

/// Value and density for one pair of directions, in `f64`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Value {
    /// `f |cos theta_i|`
    pub f_cos: [f64; N_LAMBDA],
    /// Density in 1/sr.
    pub pdf: f64,
}

/// A model with bound parameters, computed with one number type.
pub trait Column: Debug {
    /// Which one.
    fn name(&self) -> ColumnName;
    /// One sample for every triple of uniform numbers: lobe, then direction.
    fn sample(&self, wo: LocalDir<f64>, u: &[[f64; 3]], out: &mut Vec<Drawn>);
    /// Value and density for every pair `(wo, wi)`.
    fn eval(&self, pairs: &[[LocalDir<f64>; 2]], out: &mut Vec<Value>);
}

/// How a model is asked: by the contract of surfaces, or by that of fibres.
pub trait Contract<R: Real, M>: Debug {
    /// Value times cosine, and density.
    fn f_cos_pdf(model: &M, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R);
    /// One sample.
    fn sample(model: &M, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R>;
}

/// By [`Bsdf`].
#[derive(Debug)]
pub struct OfSurface;
/// By [`Bcsdf`].
#[derive(Debug)]
pub struct OfFibre;

impl<R: Real, M: Bsdf<R>> Contract<R, M> for OfSurface {
    fn f_cos_pdf(model: &M, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        model.f_cos_pdf(wo, wi)
    }
    fn sample(model: &M, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        model.sample(wo, u)
    }
}
impl<R: Real, M: Bcsdf<R>> Contract<R, M> for OfFibre {
    fn f_cos_pdf(model: &M, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        model.f_cos_pdf(wo, wi)
    }
    fn sample(model: &M, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        model.sample(wo, u)
    }
}

/// A model computed one ray at a time.
#[derive(Debug)]
pub struct Scalar<R, M, C = OfSurface> {
    name: ColumnName,
    model: M,
    number: PhantomData<(R, C)>,
}

impl<M: Bsdf<f64>> Scalar<f64, M> {
    /// In double precision.
    pub fn double(model: M) -> Self {
        Scalar { name: ColumnName::F64, model, number: PhantomData }
    }
}
impl<M: Bsdf<f32>> Scalar<f32, M> {
    /// In single precision.
    pub fn single(model: M) -> Self {
        Scalar { name: ColumnName::F32, model, number: PhantomData }
    }
}
impl<M: Bcsdf<f64>> Scalar<f64, M, OfFibre> {
    /// A fibre in double precision.
    pub fn double_of_fibre(model: M) -> Self {
        Scalar { name: ColumnName::F64, model, number: PhantomData }
    }
}
impl<M: Bcsdf<f32>> Scalar<f32, M, OfFibre> {
    /// A fibre in single precision.
    pub fn single_of_fibre(model: M) -> Self {
        Scalar { name: ColumnName::F32, model, number: PhantomData }
    }
}

fn to<R: Real>(w: Dir) -> LocalDir<R> {
    LocalDir::new(Vec3 { x: R::of(w.x()), y: R::of(w.y()), z: R::of(w.z()) })
}
fn from<R: Real + Into<f64>>(w: LocalDir<R>) -> Dir {
    LocalDir::new(Vec3 { x: w.x().into(), y: w.y().into(), z: w.z().into() })
}

impl<R, M, C> Column for Scalar<R, M, C>
where
    R: Real<Mask = bool> + Into<f64>,
    M: Debug,
    C: Contract<R, M>,
{
    fn name(&self) -> ColumnName {
        self.name
    }
    fn sample(&self, wo: Dir, u: &[[f64; 3]], out: &mut Vec<Drawn>) {
        out.clear();
        let wo = to::<R>(wo);
        out.extend(u.iter().map(|u| {
            let u = u.map(R::of);
            let s = C::sample(&self.model, wo, Uniforms { lobe: u[0], dir: [u[1], u[2]] });
            Drawn {
                wi: from(s.wi),
                weight: s.weight.0.map(Into::into),
                density: s.density.into(),
                eta: s.eta.into(),
                delta: s.delta,
                valid: s.valid,
            }
        }));
    }
    fn eval(&self, pairs: &[[Dir; 2]], out: &mut Vec<Value>) {
        out.clear();
        out.extend(pairs.iter().map(|[wo, wi]| {
            let (f_cos, pdf) = C::f_cos_pdf(&self.model, to::<R>(*wo), to::<R>(*wi));
            Value { f_cos: f_cos.0.map(Into::into), pdf: pdf.into() }
        }));
    }
}

/// A registered model in its batch form, as pictures are rendered from.
#[derive(Debug)]
pub struct Batch<K> {
    kind: K,
    params: ParamBlock<f32>,
}

impl<K: Kind> Batch<K> {
    /// Of a registered model.
    pub fn new(kind: K, params: ParamBlock<f32>) -> Batch<K> {
        Batch { kind, params }
    }
    fn with_params<T>(&self, work: impl FnOnce(&ParamColumns<'_>) -> T) -> T {
        let p = &self.params;
        let mut columns = ParamColumns { choices: p.choices, ..ParamColumns::default() };
        for k in 0..MAX_REALS {
            columns.reals[k] = std::slice::from_ref(&p.reals[k]);
        }
        for k in 0..MAX_SPECTRA {
            for w in 0..N_LAMBDA {
                columns.spectra[k][w] = std::slice::from_ref(&p.spectra[k].0[w]);
            }
        }
        for w in 0..N_LAMBDA {
            columns.lambda[w] = std::slice::from_ref(&p.lambda.0[w]);
        }
        columns.h = std::slice::from_ref(&p.h);
        work(&columns)
    }
}

/// Directions in columns.
struct Dirs([Vec<f32>; 3]);

impl Dirs {
    fn of(dirs: impl Iterator<Item = Dir>) -> Dirs {
        let mut d = Dirs([Vec::new(), Vec::new(), Vec::new()]);
        for w in dirs {
            d.0[0].push(w.x() as f32);
            d.0[1].push(w.y() as f32);
            d.0[2].push(w.z() as f32);
        }
        d
    }
    fn columns(&self) -> DirColumns<'_> {
        DirColumns { x: &self.0[0], y: &self.0[1], z: &self.0[2] }
    }
}

impl<K: Kind> Column for Batch<K> {
    fn name(&self) -> ColumnName {
        ColumnName::Lanes
    }
    fn sample(&self, wo: Dir, u: &[[f64; 3]], out: &mut Vec<Drawn>) {
        let n = u.len();
        let from = Dirs::of(std::iter::repeat_n(wo, n));
        let us: [Vec<f32>; 3] = [0, 1, 2].map(|k| u.iter().map(|u| u[k] as f32).collect());
        let mut columns = [(); 10].map(|()| vec![0.0f32; n]);
        let [x, y, z, a, b, c, d, density, eta, delta] = &mut columns;
        let mut into = SampleColumns { wi: [x, y, z], weight: [a, b, c, d], density, eta, delta };
        self.with_params(|p| {
            batch::sample(self.kind, p, &from.columns(), &[&us[0], &us[1], &us[2]], &mut into);
        });
        out.clear();
        out.extend((0..n).map(|i| {
            let at = |k: usize| f64::from(columns[k][i]);
            Drawn {
                wi: LocalDir::new(Vec3 { x: at(0), y: at(1), z: at(2) }),
                weight: [at(3), at(4), at(5), at(6)],
                density: at(7),
                eta: at(8),
                delta: at(9) > 0.5,
                // What ends leaves no density; what is not a number is no end.
                valid: at(7).abs() > 0.0 || at(7).is_nan(),
            }
        }));
    }
    fn eval(&self, pairs: &[[Dir; 2]], out: &mut Vec<Value>) {
        let n = pairs.len();
        let (wo, wi) = (Dirs::of(pairs.iter().map(|p| p[0])), Dirs::of(pairs.iter().map(|p| p[1])));
        let mut columns = [(); 5].map(|()| vec![0.0f32; n]);
        let [a, b, c, d, pdf] = &mut columns;
        let mut into = EvalColumns { f_cos: [a, b, c, d], pdf };
        self.with_params(|p| batch::f_cos_pdf(self.kind, p, &wo.columns(), &wi.columns(), &mut into));
        out.clear();
        out.extend((0..n).map(|i| {
            let at = |k: usize| f64::from(columns[k][i]);
            Value { f_cos: [at(0), at(1), at(2), at(3)], pdf: at(4) }
        }));
    }
}

/// Parameters in single precision.
pub fn narrow(p: &ParamBlock<f64>) -> ParamBlock<f32> {
    ParamBlock {
        reals: p.reals.map(|v| v as f32),
        spectra: p.spectra.map(|s| Spectrum(s.0.map(|v| v as f32))),
        choices: p.choices,
        lambda: Spectrum(p.lambda.0.map(|v| v as f32)),
        h: p.h as f32,
    }
}
