//! What one facet reflects, by one of several Fresnel terms.

use sparrow_math::Real;
use sparrow_spectra::Spectrum;

use crate::fresnel;

/// Names a Fresnel term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReflectanceKind {
    /// Exact, complex index `a + i b`.
    Conductor,
    /// Exact, real index `a`; what is not reflected is lost.
    Dielectric,
    /// Schlick's approximation from `f0`.
    Schlick,
    /// Schlick's lowered near 82 degrees.
    F82,
    /// `f0` at every angle.
    Constant,
}

impl ReflectanceKind {
    /// Names in the order of [`from_choice`](Self::from_choice).
    pub const NAMES: &'static [&'static str] = &["conductor", "dielectric", "schlick", "f82", "constant"];
    /// The kind at a place of [`NAMES`](Self::NAMES).
    #[inline(always)]
    pub fn from_choice(i: u8) -> Self {
        match i {
            0 => ReflectanceKind::Conductor,
            1 => ReflectanceKind::Dielectric,
            2 => ReflectanceKind::Schlick,
            3 => ReflectanceKind::F82,
            _ => ReflectanceKind::Constant,
        }
    }
}

/// A Fresnel term with its two spectra: index and absorption, or reflectance at normal incidence and tint.
#[derive(Clone, Copy, Debug)]
pub struct Reflectance<R> {
    kind: ReflectanceKind,
    a: Spectrum<R>,
    b: Spectrum<R>,
}

impl<R: Real> Reflectance<R> {
    /// Takes the two spectra its kind needs: `eta` and `k`, or `f0` and `f82`.
    #[inline(always)]
    pub fn new(
        kind: ReflectanceKind,
        eta: Spectrum<R>,
        k: Spectrum<R>,
        f0: Spectrum<R>,
        f82: Spectrum<R>,
    ) -> Self {
        match kind {
            ReflectanceKind::Conductor | ReflectanceKind::Dielectric => {
                // An index of zero has no meaning.
                let eta = eta.map(
                    #[inline(always)]
                    |n| n.max(R::of(1e-3)),
                );
                Reflectance { kind, a: eta, b: k }
            }
            ReflectanceKind::Schlick | ReflectanceKind::F82 | ReflectanceKind::Constant => {
                Reflectance { kind, a: f0, b: f82 }
            }
        }
    }

    /// What it was made of: kind and the two spectra that this kind needs.
    #[inline(always)]
    pub(crate) fn parts(&self) -> (ReflectanceKind, Spectrum<R>, Spectrum<R>) {
        (self.kind, self.a, self.b)
    }
    /// The opposite of [`parts`](Self::parts).
    #[inline(always)]
    pub(crate) fn from_parts(kind: ReflectanceKind, a: Spectrum<R>, b: Spectrum<R>) -> Self {
        Reflectance { kind, a, b }
    }

    /// `F(cos)`, `cos` in [0, 1].
    #[inline(always)]
    pub fn at(&self, cos: R) -> Spectrum<R> {
        let (a, b) = (self.a, self.b);
        match self.kind {
            ReflectanceKind::Conductor => a.zip(
                b,
                #[inline(always)]
                |eta, k| fresnel::conductor(cos, eta, k),
            ),
            ReflectanceKind::Dielectric => a.map(
                #[inline(always)]
                |eta| fresnel::dielectric(cos, eta).0,
            ),
            ReflectanceKind::Schlick => a.map(
                #[inline(always)]
                |f0| fresnel::schlick(cos, f0),
            ),
            ReflectanceKind::F82 => a.zip(
                b,
                #[inline(always)]
                |f0, tint| fresnel::f82_tint(cos, f0, tint),
            ),
            ReflectanceKind::Constant => a,
        }
    }

    /// The mean of [`at`](Self::at) over the hemisphere, weighted with the cosine; closed where it can be, else by
    /// Gauss's rule with 12 points (error 1e-3 for dielectrics, whose curve has a root at grazing angles).
    #[inline(always)]
    pub fn average(&self) -> Spectrum<R> {
        let (a, b) = (self.a, self.b);
        match self.kind {
            ReflectanceKind::Conductor => a.zip(
                b,
                #[inline(always)]
                |eta, k| {
                    fresnel::average(
                        #[inline(always)]
                        |c| fresnel::conductor(c, eta, k),
                    )
                },
            ),
            ReflectanceKind::Dielectric => a.map(
                #[inline(always)]
                |eta| {
                    fresnel::average(
                        #[inline(always)]
                        |c| fresnel::dielectric(c, eta).0,
                    )
                },
            ),
            ReflectanceKind::Schlick => a.map(
                #[inline(always)]
                |f0| fresnel::schlick_average(f0),
            ),
            ReflectanceKind::F82 => a.zip(
                b,
                #[inline(always)]
                |f0, tint| fresnel::f82_average(f0, tint),
            ),
            ReflectanceKind::Constant => a,
        }
    }
}
