//! Rough diffuse reflection that keeps all energy: EON. [Portsmouth2024]
//!
//! Fujii's form of the qualitative Oren-Nayar model (FON) for the first reflection, and a lobe that returns what it
//! lost: a white surface of any roughness is white. The roughness r is that of the paper, in 0..1, and no slope angle.
//! Sampled by a linearly transformed cosine, clipped at the horizon, mixed with uniform directions.

use core::f64::consts::{FRAC_1_PI, PI};

use sparrow_math::{LocalDir, Real, Vec3, vec3};
use sparrow_spectra::Spectrum;

use crate::opaque::Opaque;
use crate::{About, Model, ParamBlock, ParamInfo, Uniforms};

/// `1/2 - 2/(3 pi)`
const K1: f64 = 0.5 - 2.0 / (3.0 * PI);
/// `2/3 - 28/(15 pi)`
const K2: f64 = 2.0 / 3.0 - 28.0 / (15.0 * PI);

/// Energy-preserving Oren-Nayar.
#[derive(Clone, Copy, Debug)]
pub struct Eon<R> {
    pub(super) reflectance: Spectrum<R>,
    pub(super) r: R,
}

impl<R: Real> Model<R> for Eon<R> {
    const ABOUT: About =
        About::new("rough diffuse reflection that keeps all energy", "Portsmouth2024, OrenNayar1994");
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::albedo("reflectance").default(0.5).doc("Share of the light that one reflection returns."),
        ParamInfo::real("roughness").default(0.5).doc("Roughness r of the paper; 0 is Lambert's law."),
    ];

    #[inline(always)]
    fn new(p: &ParamBlock<R>) -> Self {
        Eon { reflectance: p.spectra[0], r: p.reals[0] }
    }
}

/// `G(mu)` of the albedo, in the form that stays finite at grazing angles. [Portsmouth2024]
#[allow(non_snake_case, reason = "names of the formula")]
#[inline(always)]
fn fujii_g<R: Real>(w: LocalDir<R>) -> R {
    let mu = w.cos_theta();
    let S = w.sin2_theta().sqrt().min(R::ONE);
    // (S / mu)(1 - S^3), with 1 - S = mu^2 / (1 + S).
    let tail = S * mu * (R::ONE + S + S.sqr()) / (R::ONE + S);
    S * (S.atan2(mu) - S * mu) + R::of(2.0 / 3.0) * (tail - S)
}

/// Clipped linear transformation of the cosine lobe, for one viewer. [Portsmouth2024]
struct Clipped<R> {
    a: R,
    b: R,
    c: R,
    d: R,
    /// Share of the unit disk's half that the clipped lobe fills.
    s: R,
    /// Cosine and sine of the azimuth of the viewer.
    along: [R; 2],
    /// Probability of a uniform direction instead.
    uniform: R,
}

impl<R: Real> Clipped<R> {
    #[inline(always)]
    fn new(o: LocalDir<R>, r: R) -> Self {
        let k = R::of;
        let mu = o.cos_theta().min(R::ONE);
        let a = k(0.303392) + (k(-0.518982) + k(0.111709) * mu) * mu + (k(-0.276266) + k(0.335918) * mu) * r;
        let b = k(-1.16407) + k(1.15859) * mu + (k(0.150815) - k(0.150105) * mu) * r;
        let c = k(0.20013) + (k(-0.506373) + k(0.261777) * mu) * mu;
        let d = k(0.540852) + (k(-1.01625) + k(0.475392) * mu) * mu;
        let d = d * r / (k(-1.0743) + mu * (k(0.0725628) + mu));
        let uniform = k(0.162925) + mu * (k(-0.372058) + (k(0.538233) - k(0.290822) * mu) * mu);
        let sin = o.sin2_theta().sqrt();
        let slanted = sin.gt(k(1e-9));
        let scale = R::ONE / R::select(slanted, sin, R::ONE);
        Clipped {
            a: R::ONE + r * a,
            b: r * b / (mu * mu * mu - k(1.43545)),
            c: R::ONE + r * c,
            d,
            s: k(0.5) * (R::ONE + R::ONE / (d * d + R::ONE).sqrt()),
            along: [R::select(slanted, o.x() * scale, R::ONE), R::select(slanted, o.y() * scale, R::ZERO)],
            uniform: r.max(k(1e-30)).pow(k(0.1)) * uniform,
        }
    }

    /// Density of the mixture.
    #[inline(always)]
    fn pdf(&self, i: LocalDir<R>) -> R {
        let [c, s] = self.along;
        let (x, y, z) = (c * i.x() + s * i.y(), c * i.y() - s * i.x(), i.z());
        // The inverse of [[a, 0, b], [0, c, 0], [d, 0, 1]].
        let det2 = self.a - self.b * self.d;
        let w = vec3((x - self.b * z) / det2, y / self.c, (self.a * z - self.d * x) / det2);
        let len2 = w.length2();
        let lobe = w.z.max(R::ZERO) / (R::of(PI) * self.s * self.c * det2 * len2 * len2);
        self.uniform * R::of(0.5 * FRAC_1_PI) + (R::ONE - self.uniform) * lobe
    }

    /// A direction of the transformed lobe. [Portsmouth2024]
    #[inline(always)]
    fn draw_lobe(&self, u: [R; 2]) -> Vec3<R> {
        let radius = u[0].sqrt();
        let (sin, cos) = (R::of(2.0 * PI) * u[1]).sin_cos();
        let y = radius * sin;
        let x = -((R::ONE - self.s) * (R::ONE - y * y).safe_sqrt() + self.s * radius * cos);
        let z = (R::ONE - x * x - y * y).safe_sqrt();
        vec3(self.a * x + self.b * z, self.c * y, self.d * x + z).normalized()
    }

    #[inline(always)]
    fn draw(&self, u: Uniforms<R>) -> LocalDir<R> {
        let lobe = self.draw_lobe(u.dir);
        let sin = (u.dir[0] * (R::of(2.0) - u.dir[0])).safe_sqrt();
        let (s, c) = (R::of(2.0 * PI) * u.dir[1]).sin_cos();
        let uniform = vec3(sin * c, sin * s, R::ONE - u.dir[0]);
        let w = Vec3::select(u.lobe.lt(self.uniform), uniform, lobe);
        let [c, s] = self.along;
        LocalDir::new(vec3(c * w.x - s * w.y, s * w.x + c * w.y, w.z))
    }
}

impl<R: Real> Eon<R> {
    /// First reflection, for unit reflectance, times pi. [Portsmouth2024]
    #[inline(always)]
    fn fon(&self, o: LocalDir<R>, i: LocalDir<R>) -> R {
        let s = o.x() * i.x() + o.y() * i.y();
        let s_over_t = R::select(s.gt(R::ZERO), s / o.cos_theta().max(i.cos_theta()), s);
        (R::ONE + self.r * s_over_t) / (R::ONE + R::of(K1) * self.r)
    }

    /// The lobe of later reflections, times pi. [Portsmouth2024]
    ///
    /// `1 - E` and `1 - <E>` are in proportion to r; the common factor is taken out, so that nothing cancels and a smooth
    /// surface needs no branch.
    #[allow(non_snake_case, reason = "names of the formula")]
    #[inline(always)]
    fn multiple(&self, o: LocalDir<R>, i: LocalDir<R>) -> Spectrum<R> {
        let A = R::ONE / (R::ONE + R::of(K1) * self.r);
        let lost_o = R::of(K1) - fujii_g(o) * R::of(FRAC_1_PI);
        let lost_i = R::of(K1) - fujii_g(i) * R::of(FRAC_1_PI);
        let shape = A * self.r * lost_o.max(R::ZERO) * lost_i.max(R::ZERO) * R::of(1.0 / (K1 - K2));
        let E_avg = A * (R::ONE + R::of(K2) * self.r);
        self.reflectance.map(
            #[inline(always)]
            |rho| rho * rho * E_avg / (R::ONE - rho * (R::ONE - E_avg)) * shape,
        )
    }
}

impl<R: Real> Opaque for Eon<R> {
    type R = R;

    #[inline(always)]
    fn eval(&self, o: LocalDir<R>, i: LocalDir<R>) -> (Spectrum<R>, R) {
        let f = (self.reflectance * self.fon(o, i) + self.multiple(o, i)) * R::of(FRAC_1_PI);
        (f, Clipped::new(o, self.r).pdf(i))
    }

    #[inline(always)]
    fn draw(&self, o: LocalDir<R>, u: Uniforms<R>) -> LocalDir<R> {
        Clipped::new(o, self.r).draw(u)
    }
}
