//! Fibre models that are sums over many rays or ways: [`Summed`]. They are computed one by one, in double precision, whatever the number type.
//!
//! Where a ray inside meets the surface near the critical angle, its exit turns by the root of a rounding: single precision would put it
//! elsewhere. Lanes would gain little, since what each can leave out differs, and cost much time to build.

use sparrow_math::{LocalDir, Mask, Real, vec3};
use sparrow_spectra::{N_LAMBDA, Spectrum};

use crate::per_lane::per_lane;
use crate::{About, Bcsdf, BsdfSample, MAX_REALS, Model, N_LOBES, ParamBlock, ParamInfo, Uniforms};

/// Spectra that such a model may take.
const SPECTRA: usize = 2;
/// Numbers that a model is made of: parameters, and h.
const NUMBERS: usize = MAX_REALS + SPECTRA * N_LAMBDA + 1;
/// And of two triples besides.
const ALL: usize = NUMBERS + 6;

/// A fibre model whose work depends on the viewer alone, up to a last step.
pub trait Sum: Copy {
    /// What is known once the viewer is.
    type Seen: Seen;
    /// As of [`Model`].
    const ABOUT: About;
    /// As of [`Model`], with two spectra at most.
    const PARAMS: &'static [ParamInfo];
    /// As of [`Model`].
    fn new(params: &ParamBlock<f64>) -> Self;
    /// Seen from `wo`.
    fn seen_from(&self, wo: LocalDir<f64>) -> Self::Seen;
}

/// A fibre with its viewer.
pub trait Seen {
    /// As of [`Bcsdf`].
    fn f_cos_pdf(&self, wi: LocalDir<f64>) -> (Spectrum<f64>, f64);
    /// As of [`Bcsdf`].
    fn lobes(&self, wi: LocalDir<f64>) -> [Spectrum<f64>; N_LOBES];
    /// Draws a direction with the density of `f_cos_pdf`; none where the path ends.
    fn draw(&self, u: Uniforms<f64>) -> Option<LocalDir<f64>>;
}

/// A [`Sum`] as a model of any number type.
#[derive(Clone, Copy, Debug)]
pub struct Summed<R, M> {
    numbers: [R; NUMBERS],
    choices: [u8; crate::MAX_CHOICES],
    model: core::marker::PhantomData<M>,
}

/// A direction of unit length in spite of its rounding.
#[inline(always)]
fn unit([x, y, z]: [f64; 3]) -> LocalDir<f64> {
    LocalDir::new(vec3(x, y, z).normalized())
}

/// As the number type holds it.
#[inline(always)]
fn rounded<R: Real>(x: f64) -> f64 {
    R::of(x).to_doubles()[0]
}

impl<R: Real, M: Sum> Model<R> for Summed<R, M> {
    const ABOUT: About = M::ABOUT;
    const PARAMS: &'static [ParamInfo] = M::PARAMS;

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        let mut numbers = [p.h; NUMBERS];
        numbers[..MAX_REALS].copy_from_slice(&p.reals);
        for (slot, spectrum) in numbers[MAX_REALS..].chunks_exact_mut(N_LAMBDA).zip(&p.spectra) {
            slot.copy_from_slice(&spectrum.0);
        }
        Summed { numbers, choices: p.choices, model: core::marker::PhantomData }
    }
}

impl<R: Real, M: Sum> Summed<R, M> {
    /// `f` of the model of every lane, seen from `wo`, and of further numbers.
    #[inline(always)]
    fn each<const K: usize>(
        &self,
        wo: LocalDir<R>,
        further: [R; 3],
        f: impl Fn(M::Seen, [f64; 3]) -> [f64; K],
    ) -> [R; K] {
        let mut all = [R::ZERO; ALL];
        all[..NUMBERS].copy_from_slice(&self.numbers);
        all[NUMBERS..NUMBERS + 3].copy_from_slice(&[wo.x(), wo.y(), wo.z()]);
        all[NUMBERS + 3..].copy_from_slice(&further);
        per_lane(
            all,
            #[inline(always)]
            |all| {
                let (numbers, dirs) = all.split_at(NUMBERS);
                let mut p =
                    ParamBlock { choices: self.choices, h: numbers[NUMBERS - 1], ..ParamBlock::default() };
                p.reals.copy_from_slice(&numbers[..MAX_REALS]);
                for (slot, spectrum) in p.spectra.iter_mut().zip(numbers[MAX_REALS..].chunks_exact(N_LAMBDA))
                {
                    slot.0.copy_from_slice(spectrum);
                }
                let seen = M::new(&p).seen_from(unit([dirs[0], dirs[1], dirs[2]]));
                f(seen, [dirs[3], dirs[4], dirs[5]])
            },
        )
    }
}

impl<R: Real, M: Sum> Bcsdf<R> for Summed<R, M> {
    #[inline(always)]
    fn f_cos_pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (Spectrum<R>, R) {
        let [a, b, c, d, pdf] = self.each(
            wo,
            [wi.x(), wi.y(), wi.z()],
            #[inline(always)]
            |seen, wi| {
                let (Spectrum([a, b, c, d]), pdf) = seen.f_cos_pdf(unit(wi));
                [a, b, c, d, pdf]
            },
        );
        (Spectrum([a, b, c, d]), pdf)
    }

    #[inline(always)]
    fn lobes(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> [Spectrum<R>; N_LOBES] {
        let all = self.each(
            wo,
            [wi.x(), wi.y(), wi.z()],
            #[inline(always)]
            |seen, wi| {
                let mut all = [0.0; N_LOBES * N_LAMBDA];
                for (slot, lobe) in all.chunks_exact_mut(N_LAMBDA).zip(seen.lobes(unit(wi))) {
                    slot.copy_from_slice(&lobe.0);
                }
                all
            },
        );
        let mut lobes = [Spectrum::ZERO; N_LOBES];
        for (lobe, values) in lobes.iter_mut().zip(all.chunks_exact(N_LAMBDA)) {
            lobe.0.copy_from_slice(values);
        }
        lobes
    }

    #[inline(always)]
    fn sample(&self, wo: LocalDir<R>, u: Uniforms<R>) -> BsdfSample<R> {
        let [x, y, z, a, b, c, d, density] = self.each(
            wo,
            [u.lobe, u.dir[0], u.dir[1]],
            #[inline(always)]
            |seen, [lobe, u0, u1]| {
                let Some(wi) = seen.draw(Uniforms { lobe, dir: [u0, u1] }) else {
                    return [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
                };
                let wi = [rounded::<R>(wi.x()), rounded::<R>(wi.y()), rounded::<R>(wi.z())];
                let (q, density) = seen.f_cos_pdf(unit(wi));
                let Spectrum([a, b, c, d]) = if density > 0.0 { q / density } else { Spectrum::ZERO };
                [wi[0], wi[1], wi[2], a, b, c, d, density]
            },
        );
        BsdfSample {
            wi: LocalDir::new(vec3(x, y, z)),
            weight: Spectrum([a, b, c, d]),
            density,
            eta: R::ONE,
            delta: R::Mask::of(false),
            valid: density.gt(R::ZERO),
        }
    }
}
