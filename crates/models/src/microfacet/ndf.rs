//! Distributions of microfacet normals: `D(m)`, drawing from it, and Smith's `Lambda`.
//!
//! | name | `D` | with | masking |
//! | --- | --- | --- | --- |
//! | `ggx` | `1 / (pi ax ay (S + z^2)^2)` | widths | exact |
//! | `beckmann` | `e^(-S/z^2) / (pi ax ay z^4)` | widths | exact |
//! | `blinn` | `(s + 2) / (2 pi) z^s` | exponent `s`, isotropic | Beckmann's of width `sqrt(2 / (s + 2))` |
//! | `gtr` | Burley's, `(1 + (a^2 - 1) z^2)^-g` | mean width below 1, `gamma` | GGX's of the same width; exact at `gamma = 2` |
//! | `student_t` | `z^(2g-4) / (pi ax ay (z^2 + S / (g - 1))^g)` | widths, `gamma` above 1.5 | exact, by quadrature |
//!
//! `S = (x / ax)^2 + (y / ay)^2`. All satisfy `int D(m) m.n dm = 1`. [Walter2007, eq. 25 to 33], [Burley2012, app. B],
//! [Ribardiere2017]. `gtr` and `blinn` are not shape-invariant and have no closed masking: the approximations are
//! those of their authors [Burley2012], [Walter2007, sec. 5.2], and may let through a little too much light.

use core::f64::consts::{FRAC_1_PI, PI};

use sparrow_math::{LocalDir, Real, vec3};

use super::special::{exp_m1_over, ln_1p_over, ln_cos};
use super::{beckmann, smith};
use crate::ggx::{ALPHA_SMOOTH, Ggx};

/// Names a distribution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NdfKind {
    /// Trowbridge-Reitz.
    Ggx,
    /// Gaussian slopes.
    Beckmann,
    /// A power of the cosine.
    Blinn,
    /// Generalised Trowbridge-Reitz.
    Gtr,
    /// Student's t of the slopes.
    StudentT,
}

impl NdfKind {
    /// Names in the order of [`from_choice`](Self::from_choice).
    pub const NAMES: &'static [&'static str] = &["ggx", "beckmann", "blinn", "gtr", "student_t"];
    /// The kind at a place of [`NAMES`](Self::NAMES).
    #[inline(always)]
    pub fn from_choice(i: u8) -> Self {
        match i {
            0 => NdfKind::Ggx,
            1 => NdfKind::Beckmann,
            2 => NdfKind::Blinn,
            3 => NdfKind::Gtr,
            _ => NdfKind::StudentT,
        }
    }
}

/// A distribution of normals.
#[derive(Clone, Copy, Debug)]
pub struct Ndf<R> {
    kind: NdfKind,
    alpha_x: R,
    alpha_y: R,
    /// Blinn's exponent, or the exponent of `gtr` and `student_t`.
    shape: R,
}

impl<R: Real> Ndf<R> {
    /// Slope widths along the tangent and across it, and the shape: the exponent of `blinn`, or `gamma`.
    ///
    /// Brought into what the formulas can hold: widths at least 1e-3; for `gtr` one width, the geometric mean, below 1
    /// and `gamma` in 0.2..6; for `student_t` `gamma` in 1.6..40.
    #[inline(always)]
    pub fn new(kind: NdfKind, alpha_x: R, alpha_y: R, shape: R) -> Self {
        let smallest = R::of(ALPHA_SMOOTH);
        let (x, y) = (alpha_x.max(smallest), alpha_y.max(smallest));
        match kind {
            NdfKind::Ggx | NdfKind::Beckmann => Ndf { kind, alpha_x: x, alpha_y: y, shape },
            NdfKind::Blinn => {
                let s = shape.clamp(R::ZERO, R::of(2e6));
                let a = (R::of(2.0) / (s + R::of(2.0))).sqrt();
                Ndf { kind, alpha_x: a, alpha_y: a, shape: s }
            }
            NdfKind::Gtr => {
                let a = (x * y).sqrt().min(R::of(0.9999));
                Ndf { kind, alpha_x: a, alpha_y: a, shape: shape.clamp(R::of(0.2), R::of(6.0)) }
            }
            NdfKind::StudentT => {
                Ndf { kind, alpha_x: x, alpha_y: y, shape: shape.clamp(R::of(1.6), R::of(40.0)) }
            }
        }
    }
    /// Which distribution it is.
    #[inline(always)]
    pub fn kind(&self) -> NdfKind {
        self.kind
    }
    /// GGX of the same widths.
    #[inline(always)]
    pub fn ggx(&self) -> Ggx<R> {
        Ggx::new(self.alpha_x, self.alpha_y)
    }
    /// The geometric mean of the widths.
    #[inline(always)]
    pub fn mean_width(&self) -> R {
        (self.alpha_x * self.alpha_y).sqrt()
    }
    /// Slope widths `times` as large, up to one.
    #[inline(always)]
    #[must_use]
    pub(crate) fn widened(self, times: f64) -> Self {
        let wider = |a: R| (a * R::of(times)).min(R::ONE).max(a);
        Ndf { alpha_x: wider(self.alpha_x), alpha_y: wider(self.alpha_y), ..self }
    }
    /// With narrow widths widened as pbrt-v4 regularises: doubled and brought into [0.1, 0.3] where below 0.3.
    #[inline(always)]
    #[must_use]
    pub fn regularized(self) -> Self {
        let wider = |a: R| {
            let w = (a + a).clamp(R::of(0.1), R::of(0.3));
            R::select(a.lt(R::of(0.3)), w, a)
        };
        match self.kind {
            NdfKind::Blinn => {
                let a = wider(self.alpha_x);
                Self::new(self.kind, a, a, R::of(2.0) / a.sqr() - R::of(2.0))
            }
            NdfKind::Ggx | NdfKind::Beckmann | NdfKind::Gtr | NdfKind::StudentT => {
                Ndf { alpha_x: wider(self.alpha_x), alpha_y: wider(self.alpha_y), ..self }
            }
        }
    }

    /// `D(m)`, per steradian; `m` above.
    #[inline(always)]
    pub fn d(&self, m: LocalDir<R>) -> R {
        match self.kind {
            NdfKind::Ggx => self.ggx().d(m),
            NdfKind::Beckmann | NdfKind::Blinn | NdfKind::Gtr | NdfKind::StudentT => self.d_other(m),
        }
    }
    /// [`d`](Self::d) of all but GGX: not inlined, to keep builds short.
    #[inline(always)]
    fn d_other(&self, m: LocalDir<R>) -> R {
        let z2 = m.z().sqr().max(R::of(1e-12));
        let s = (m.x() / self.alpha_x).sqr() + (m.y() / self.alpha_y).sqr();
        let front = R::of(FRAC_1_PI) / (self.alpha_x * self.alpha_y);
        match self.kind {
            NdfKind::Ggx => self.ggx().d(m),
            NdfKind::Beckmann => {
                let x = s / z2;
                // Past 80 single precision ends, and what follows may divide by small cosines.
                front * ((-x).exp().only_where(x.lt(R::of(80.0)))) / z2.sqr()
            }
            NdfKind::Blinn => {
                let lobe = (self.shape * ln_cos(m.z(), m.sin2_theta())).exp();
                (self.shape + R::of(2.0)) * R::of(0.5 / PI) * lobe
            }
            NdfKind::Gtr => {
                let q = self.alpha_x.sqr();
                let l = q.ln();
                let base = q + (R::ONE - q) * m.sin2_theta().min(R::ONE);
                let norm = R::of(FRAC_1_PI) * (q - R::ONE) / (l * exp_m1_over((R::ONE - self.shape) * l));
                norm * (-(self.shape * base.ln())).exp()
            }
            NdfKind::StudentT => {
                let g = self.shape;
                let base = z2 + s / (g - R::ONE);
                front * ((g - R::of(2.0)) * z2.ln() - g * base.ln()).exp()
            }
        }
    }

    /// `|cos theta| Lambda(w)` by Smith.
    #[inline(always)]
    pub fn mu_lambda(&self, w: LocalDir<R>) -> R {
        let mu = w.abs_cos_theta();
        let s = ((self.alpha_x * w.x()).sqr() + (self.alpha_y * w.y()).sqr()).sqrt();
        match self.kind {
            NdfKind::Ggx | NdfKind::Gtr => smith::ggx(mu, s),
            NdfKind::Beckmann | NdfKind::Blinn => smith::beckmann(mu, s),
            NdfKind::StudentT => smith::student_t(mu, s, self.shape),
        }
    }
    /// Smith's `Lambda(w)`.
    #[inline(always)]
    pub fn lambda(&self, w: LocalDir<R>) -> R {
        self.mu_lambda(w) / w.abs_cos_theta()
    }
    /// Smith's `G_1(w)`: the share of facets turned to `w` that is visible from there.
    #[inline(always)]
    pub fn g1(&self, w: LocalDir<R>) -> R {
        let mu = w.abs_cos_theta();
        mu / (mu + self.mu_lambda(w))
    }

    /// A normal with density `D(m) cos theta_m`; `u[0]` for the polar angle.
    #[inline(always)]
    pub fn sample(&self, u: [R; 2]) -> LocalDir<R> {
        let (sin_phi, cos_phi) = (R::of(2.0 * PI) * u[1]).sin_cos();
        let rest = (R::ONE - u[0]).max(R::of(1e-12));
        match self.kind {
            NdfKind::Ggx => self.of_slope((u[0] / rest).sqrt(), cos_phi, sin_phi),
            NdfKind::Beckmann => self.of_slope((-rest.ln()).safe_sqrt(), cos_phi, sin_phi),
            NdfKind::StudentT => {
                let x = -rest.ln() / (self.shape - R::ONE);
                let r2 = (self.shape - R::ONE) * x * exp_m1_over(x);
                self.of_slope(r2.safe_sqrt(), cos_phi, sin_phi)
            }
            NdfKind::Blinn => {
                let x = R::of(2.0) * rest.ln() / (self.shape + R::of(2.0));
                from_sin2(-(x * exp_m1_over(x)), cos_phi, sin_phi)
            }
            NdfKind::Gtr => {
                let q = self.alpha_x.sqr();
                let l = q.ln();
                let x = (R::ONE - self.shape) * l;
                let y = rest * exp_m1_over(x);
                let z = l * (y * ln_1p_over(x * y) - R::ONE);
                from_sin2(q * z * exp_m1_over(z) / (R::ONE - q), cos_phi, sin_phi)
            }
        }
    }
    /// The normal of the slope `r` widths long.
    #[inline(always)]
    fn of_slope(&self, r: R, cos_phi: R, sin_phi: R) -> LocalDir<R> {
        LocalDir::new(vec3(self.alpha_x * r * cos_phi, self.alpha_y * r * sin_phi, R::ONE).normalized())
    }
    /// Normals visible from one side can be drawn.
    #[inline(always)]
    pub fn has_visible(&self) -> bool {
        matches!(self.kind, NdfKind::Ggx | NdfKind::Beckmann)
    }
    /// A normal with density `G_1(wo) (wo.m) D(m) / cos theta_o`, for `wo` above; any normal where
    /// [`has_visible`](Self::has_visible) is false.
    #[inline(always)]
    pub fn sample_visible(&self, wo: LocalDir<R>, u: [R; 2]) -> LocalDir<R> {
        match self.kind {
            NdfKind::Ggx => self.ggx().sample_visible(wo, u),
            NdfKind::Beckmann => beckmann::sample_visible(self.alpha_x, self.alpha_y, wo, u),
            NdfKind::Blinn | NdfKind::Gtr | NdfKind::StudentT => self.sample(u),
        }
    }
}

/// The normal of `sin^2 theta`.
#[inline(always)]
fn from_sin2<R: Real>(sin2: R, cos_phi: R, sin_phi: R) -> LocalDir<R> {
    let sin2 = sin2.clamp(R::ZERO, R::of(1.0 - 1e-7));
    let sin = sin2.sqrt();
    LocalDir::new(vec3(sin * cos_phi, sin * sin_phi, (R::ONE - sin2).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> Vec<Ndf<f64>> {
        let mut list = vec![];
        for (ax, ay) in [(0.3, 0.3), (0.1, 0.6), (1.0, 1.0)] {
            for (kind, shape) in [
                (NdfKind::Ggx, 0.0),
                (NdfKind::Beckmann, 0.0),
                (NdfKind::Blinn, 2.0 / (ax * ay) - 2.0),
                (NdfKind::Gtr, 1.0),
                (NdfKind::Gtr, 0.5),
                (NdfKind::Gtr, 3.0),
                (NdfKind::StudentT, 1.7),
                (NdfKind::StudentT, 4.0),
            ] {
                list.push(Ndf::new(kind, ax, ay, shape));
            }
        }
        list
    }

    #[test]
    fn mean_over_samples_is_the_mean_over_the_density() {
        // The share of D cos within a cone, by quadrature in t = sin^2, against the share of samples.
        for ndf in all() {
            for cos_max in [0.99_f64, 0.8, 0.3] {
                let n = 400;
                let mut want = 0.0;
                for i in 0..n {
                    let sin2 = (1.0 - cos_max * cos_max) * ((f64::from(i) + 0.5) / f64::from(n)).powi(2);
                    let dsin2 = (1.0 - cos_max * cos_max) * 2.0 * (f64::from(i) + 0.5) / f64::from(n * n);
                    for j in 0..64 {
                        let (s, c) = Real::sin_cos(2.0 * PI * (f64::from(j) + 0.5) / 64.0);
                        let m = LocalDir::new(vec3(sin2.sqrt() * c, sin2.sqrt() * s, (1.0 - sin2).sqrt()));
                        // dm cos = dsin2 dphi / 2
                        want += ndf.d(m) * 0.5 * dsin2 * 2.0 * PI / 64.0;
                    }
                }
                let k = 200;
                let mut got = 0.0;
                for i in 0..k * k {
                    let u =
                        [(f64::from(i % k) + 0.5) / f64::from(k), (f64::from(i / k) + 0.5) / f64::from(k)];
                    got += if ndf.sample(u).z() >= cos_max { 1.0 / f64::from(k * k) } else { 0.0 };
                }
                assert!((got - want).abs() < 6e-3, "{ndf:?} within {cos_max}: {got} {want}");
            }
        }
    }

    #[test]
    fn visible_facets_fill_the_projected_area() {
        // int G_1(w) max(0, w.m) D(m) dm = cos theta, over samples of D cos.
        for ndf in all() {
            if ndf.kind == NdfKind::Gtr || ndf.kind == NdfKind::Blinn {
                continue; // Their masking is approximate.
            }
            for theta in [0.3_f64, 0.8, 1.2] {
                let w = LocalDir::from_angles(theta, 0.5);
                let n = 600;
                let mut sum = 0.0;
                for i in 0..n * n {
                    let u =
                        [(f64::from(i % n) + 0.5) / f64::from(n), (f64::from(i / n) + 0.5) / f64::from(n)];
                    let m = ndf.sample(u);
                    sum += w.dot(m).max(0.0) / m.z() / f64::from(n * n);
                }
                let got = ndf.g1(w) * sum / w.z();
                // Rare steep facets of heavy tails are missed by the grid.
                let tol = if ndf.kind == NdfKind::StudentT && ndf.shape < 2.0 { 0.1 } else { 0.015 };
                assert!((got - 1.0).abs() < tol, "{ndf:?} at {theta}: {got}");
            }
        }
    }
}
