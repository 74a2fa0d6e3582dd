//! A dielectric coat over something else: what its surface reflects, lets in, and keeps inside.
//!
//! The surface of the coat is the GGX interface of [`crate::ggx`] with single scattering. Its directional albedo
//! `E(mu)` is tabulated once, by quadrature over the visible normals; everything it does not reflect counts as let in,
//! `T = 1 - E`, so that no light is lost at the interface. Light inside is taken to be diffuse where it matters for
//! what comes out: reciprocity and the second law give `T_avg / eta^2` as the share that leaves at each
//! arrival, without a further table.
//!
//! Sources: the balance of diffuse light under an interface [Kortum1969, sec. III c], [Saunderson1942]; masking and
//! sampling as in [`crate::ggx`].

use std::sync::OnceLock;

use sparrow_math::{LocalDir, Real, Vec3, vec3};

use crate::fresnel;
use crate::ggx::{ALPHA_SMOOTH, Ggx};
use crate::table::{Place, interpolate};

/// The coat at one point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coat<R> {
    /// Index of the coat over that outside.
    pub(crate) eta: R,
    alpha: [R; 2],
    ggx: Ggx<R>,
    /// Optical depth along the normal.
    thickness: R,
    /// Cosine-weighted mean of `T` from outside.
    pub(crate) t_avg: R,
}

impl<R: Real> Coat<R> {
    #[inline(always)]
    pub(crate) fn new(alpha: [R; 2], eta: R, thickness: R) -> Self {
        let ggx = Ggx::new(alpha[0], alpha[1]);
        let t_avg = R::ONE - table().mean(width(alpha), eta);
        Coat { eta, alpha, ggx, thickness, t_avg }
    }

    /// A coat of which only the surface is asked for: no light comes back from below.
    #[inline(always)]
    pub(crate) fn surface(alpha: [R; 2], eta: R) -> Self {
        Coat { eta, alpha, ggx: Ggx::new(alpha[0], alpha[1]), thickness: R::ZERO, t_avg: R::ZERO }
    }

    /// The surface of the coat is a mirror.
    #[inline(always)]
    pub(crate) fn is_smooth(&self) -> R::Mask {
        self.ggx.is_smooth()
    }

    /// Slope widths along the grain and across it.
    #[inline(always)]
    pub(crate) fn alphas(&self) -> [R; 2] {
        self.alpha
    }

    /// Geometric mean of the slope widths.
    #[inline(always)]
    fn alpha(&self) -> R {
        width(self.alpha)
    }

    /// The share that the surface reflects of light from `cos_theta`, above zero.
    #[inline(always)]
    pub(crate) fn albedo(&self, cos_theta: R) -> R {
        let alpha = self.alpha();
        let cos_d = R::select(self.is_smooth(), cos_theta, facet_cosine(cos_theta, alpha));
        let ratio = table().ratio(cos_theta, alpha, self.eta);
        let ratio = R::select(self.is_smooth(), R::ONE, ratio);
        (fresnel::dielectric(cos_d, self.eta).0 * ratio).min(R::ONE)
    }

    /// `f` of the surface alone, both directions above; zero where it is a mirror.
    #[inline(always)]
    pub(crate) fn f(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> R {
        let m = wo.half(wi);
        let fresnel = fresnel::dielectric(wo.dot(m).clamp(R::ZERO, R::ONE), self.eta).0;
        (fresnel * self.ggx.d(m) * self.ggx.g2_over_4cos(wo, wi)).only_where(!self.is_smooth())
    }

    /// Density of [`sample`](Self::sample), both directions above; zero where the surface is a mirror.
    #[inline(always)]
    pub(crate) fn pdf(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> R {
        let visible = self.ggx.visible_over_cos(wo, wo.half(wi));
        (visible * R::of(0.25)).only_where(!self.is_smooth())
    }

    /// A direction that the surface reflects `wo` into; it may lie below.
    #[inline(always)]
    pub(crate) fn sample(&self, wo: LocalDir<R>, u: [R; 2]) -> LocalDir<R> {
        let rough = self.ggx.sample_visible(wo, u);
        let up = vec3(R::ZERO, R::ZERO, R::ONE);
        wo.reflect(LocalDir::new(Vec3::select(self.is_smooth(), up, rough.v())))
    }

    /// The direction inside the coat, by Snell's law at the mean plane; it stays on the side of `w`.
    #[inline(always)]
    pub(crate) fn inside(&self, w: LocalDir<R>) -> LocalDir<R> {
        let v = w.v() * (R::ONE / self.eta);
        // z^2 = 1 - x^2 - y^2, without the cancellation at grazing angles under a coat of nearly no index.
        let bent = (self.eta - R::ONE) * (self.eta + R::ONE) / self.eta.sqr();
        let z = (v.z.sqr() + bent).safe_sqrt();
        LocalDir::new(Vec3 { z, ..v })
    }

    /// Of the light that enters from `cos_theta`, the share that facets of width `alpha_base` keep inside at first.
    #[inline(always)]
    pub(crate) fn kept(&self, cos_theta: R, alpha_base: R) -> R {
        kept_table().ratio(cos_theta, alpha_base, self.eta)
    }

    /// `int 2 mu T kept dmu`, of a smooth coat.
    #[inline(always)]
    pub(crate) fn kept_avg(&self, alpha_base: R) -> R {
        kept_table().mean(alpha_base, self.eta)
    }

    /// The share of light that passes the coat once at `cos_inside`.
    #[inline(always)]
    pub(crate) fn passes(&self, cos_inside: R) -> R {
        (-self.thickness / cos_inside.max(R::of(1e-3))).exp()
    }

    /// The share of diffuse light from the base that comes back to the base, dimmed by the coat on the way.
    ///
    /// Beyond the critical angle all is reflected: `int 2 mu exp(-2 t / mu)` by Gauss's rule for the weight `2 mu`.
    /// Within it the surface reflects `E_avg / eta^2`, taken along one mean direction.
    #[inline(always)]
    pub(crate) fn returns(&self) -> R {
        let inv2 = R::ONE / self.eta.sqr();
        let critical2 = (R::ONE - inv2).max(R::ZERO);
        let critical = critical2.sqrt();
        let depth = R::of(-2.0) * self.thickness;
        let mut beyond = R::ZERO;
        for (node, weight) in GAUSS {
            beyond = beyond + (depth / (critical * R::of(node)).max(R::of(1e-3))).exp() * R::of(weight);
        }
        let mean = R::of(0.5) * (R::ONE + critical);
        critical2 * beyond + (R::ONE - self.t_avg) * inv2 * (depth / mean).exp()
    }

    #[inline(always)]
    pub(crate) fn regularized(self) -> Self {
        Coat::new(self.alpha.map(wider), self.eta, self.thickness)
    }

    /// As [`regularized`](Self::regularized), of a [`surface`](Self::surface).
    #[inline(always)]
    pub(crate) fn regularized_surface(self) -> Self {
        Coat::surface([wider(self.alpha[0]), wider(self.alpha[1])], self.eta)
    }
}

/// Gauss's rule of three nodes for the weight `2 u` on [0, 1], nodes and weights.
const GAUSS: [(f64, f64); 3] = [
    (0.212_340_538_239_153_35, 0.139_653_959_802_908_23),
    (0.590_533_135_559_267_1, 0.458_482_212_719_171_9),
    (0.911_412_040_487_298_4, 0.401_863_827_477_919_43),
];

/// As [`Ggx::regularized`], on the numbers that the tables are read with.
#[inline(always)]
pub(crate) fn wider<R: Real>(alpha: R) -> R {
    let w = (alpha + alpha).clamp(R::of(0.1), R::of(0.3));
    R::select(alpha.lt(R::of(0.3)), w, alpha)
}

/// One slope width for two.
#[inline(always)]
fn width<R: Real>(alpha: [R; 2]) -> R {
    (alpha[0] * alpha[1]).sqrt()
}

/// The cosine at which Fresnel's reflectance comes near the albedo: facets face grazing views.
#[inline(always)]
fn facet_cosine<R: Real>(cos_theta: R, alpha: R) -> R {
    (cos_theta + R::of(0.5) * alpha * (R::ONE - cos_theta).sqr()).clamp(R::ZERO, R::ONE)
}

const N_MU: usize = 24;
const N_ALPHA: usize = 16;
const N_ETA: usize = 10;
/// Largest index of the tables; beyond it the values of this one hold.
const ETA_MAX: f64 = 3.0;
/// `(eta - 1) / (eta + 1)` there.
const S_MAX: f64 = (ETA_MAX - 1.0) / (ETA_MAX + 1.0);

/// Albedo of the GGX interface over Fresnel's reflectance at [`facet_cosine`], and its mean.
///
/// Axes: cosine, as `mu (1 + c) / (mu + c)` with `c = alpha + 0.02`, which resolves the grazing range that
/// shrinks with the slope width; `sqrt(alpha)`; `(eta - 1) / (eta + 1)`. Linear between nodes: against the integral the
/// albedo errs by 0.0007 root mean square and at most 0.006, near grazing views of `eta < 1.1` and of `alpha < 0.05`.
struct Table {
    ratio: [[[f32; N_ETA]; N_ALPHA]; N_MU],
    mean: [[f32; N_ETA]; N_ALPHA],
}

fn table() -> &'static Table {
    static TABLE: OnceLock<Table> = OnceLock::new();
    TABLE.get_or_init(Table::compute)
}

/// [`Coat::kept`] under a smooth coat and its mean, on the same axes.
fn kept_table() -> &'static Table {
    static TABLE: OnceLock<Table> = OnceLock::new();
    TABLE.get_or_init(Table::compute_kept)
}

/// The place of a slope width on its axis.
#[inline(always)]
fn alpha_place<R: Real>(alpha: R) -> Place<R> {
    Place::unit(N_ALPHA, alpha.sqrt())
}

/// The place of an index on its axis.
#[inline(always)]
fn eta_place<R: Real>(eta: R) -> Place<R> {
    Place::unit(N_ETA, (eta - R::ONE) / ((eta + R::ONE) * R::of(S_MAX)))
}

fn eta_of(k: usize) -> f64 {
    let s = S_MAX * k as f64 / (N_ETA - 1) as f64;
    (1.0 + s) / (1.0 - s)
}

impl Table {
    #[inline(always)]
    fn ratio<R: Real>(&self, cos_theta: R, alpha: R, eta: R) -> R {
        let c = alpha + R::of(0.02);
        let mu = Place::unit(N_MU, cos_theta * (R::ONE + c) / (cos_theta + c));
        interpolate(self.ratio.as_flattened().as_flattened(), [mu, alpha_place(alpha), eta_place(eta)])
    }

    #[inline(always)]
    fn mean<R: Real>(&self, alpha: R, eta: R) -> R {
        interpolate(self.mean.as_flattened(), [alpha_place(alpha), eta_place(eta)])
    }

    fn compute() -> Table {
        let mut table = Table { ratio: [[[1.0; N_ETA]; N_ALPHA]; N_MU], mean: [[0.0; N_ETA]; N_ALPHA] };
        for j in 0..N_ALPHA {
            let alpha = (j as f64 / (N_ALPHA - 1) as f64).powi(2);
            let c = alpha + 0.02;
            for i in 0..N_MU {
                let x = i as f64 / (N_MU - 1) as f64;
                let mu = (x * c / (1.0 + c - x)).clamp(1e-5, 1.0);
                let albedo = albedos(mu, alpha);
                let row = &mut table.ratio[i][j];
                for (k, (ratio, albedo)) in row.iter_mut().zip(albedo).enumerate().skip(1) {
                    let fresnel = fresnel::dielectric(facet_cosine(mu, alpha), eta_of(k)).0;
                    *ratio = (albedo / fresnel) as f32;
                }
                // Without a difference of index nothing is reflected; the ratio keeps its limit.
                row[0] = row[1];
            }
            for k in 1..N_ETA {
                table.mean[j][k] = table.mean_at(alpha, eta_of(k));
            }
        }
        table
    }

    fn compute_kept() -> Table {
        let mut table = Table { ratio: [[[0.0; N_ETA]; N_ALPHA]; N_MU], mean: [[0.0; N_ETA]; N_ALPHA] };
        for j in 1..N_ALPHA {
            let alpha = (j as f64 / (N_ALPHA - 1) as f64).powi(2);
            let c = alpha + 0.02;
            for i in 0..N_MU {
                let x = i as f64 / (N_MU - 1) as f64;
                let mu = (x * c / (1.0 + c - x)).clamp(1e-5, 1.0);
                for k in 0..N_ETA {
                    table.ratio[i][j][k] = kept_by_facets(mu, alpha, eta_of(k)) as f32;
                }
            }
        }
        for (j, k) in (0..N_ALPHA * N_ETA).map(|n| (n / N_ETA, n % N_ETA)) {
            let alpha = (j as f64 / (N_ALPHA - 1) as f64).powi(2);
            let n = 256;
            let sum: f64 = (0..n)
                .map(|i| {
                    let mu = (f64::from(i) + 0.5) / f64::from(n);
                    let kept = table.ratio(mu, alpha, eta_of(k));
                    2.0 * mu * (1.0 - fresnel::dielectric(mu, eta_of(k)).0) * kept
                })
                .sum();
            table.mean[j][k] = (sum / f64::from(n)) as f32;
        }
        table
    }

    /// `int 2 mu E dmu` by the midpoint rule, of what is read from the table.
    fn mean_at(&self, alpha: f64, eta: f64) -> f32 {
        let n = 256;
        let sum: f64 = (0..n)
            .map(|i| {
                let mu = (f64::from(i) + 0.5) / f64::from(n);
                let ratio = self.ratio(mu, alpha, eta);
                let fresnel = fresnel::dielectric(facet_cosine(mu, alpha), eta).0;
                2.0 * mu * (ratio * fresnel).min(1.0)
            })
            .sum();
        (sum / f64::from(n)) as f32
    }
}

/// Directional albedo at every index of the table, by the midpoint rule over visible normals of one half.
fn albedos(mu: f64, alpha: f64) -> [f64; N_ETA] {
    const N: usize = 48;
    if alpha < ALPHA_SMOOTH {
        return core::array::from_fn(|k| fresnel::dielectric(mu, eta_of(k)).0);
    }
    let ggx = Ggx::new(alpha, alpha);
    let wo = LocalDir::new(vec3((1.0 - mu * mu).max(0.0).sqrt(), 0.0, mu));
    let mut sum = [0.0; N_ETA];
    for a in 0..N / 2 {
        for b in 0..N {
            let m = ggx.sample_visible(wo, [(a as f64 + 0.5) / N as f64, (b as f64 + 0.5) / N as f64]);
            let wi = wo.reflect(m);
            if wi.z() <= 0.0 {
                continue;
            }
            let weight = ggx.g2_over_g1(wo, wi) / (N * N / 2) as f64;
            let cos_d = wo.dot(m).clamp(0.0, 1.0);
            for (k, s) in sum.iter_mut().enumerate().skip(1) {
                *s += weight * fresnel::dielectric(cos_d, eta_of(k)).0;
            }
        }
    }
    sum
}

/// What white facets under a smooth coat of index `eta` do not send out again at first.
fn kept_by_facets(mu: f64, alpha: f64, eta: f64) -> f64 {
    const N: usize = 32;
    let ggx = Ggx::new(alpha, alpha);
    let sin = (1.0 - mu * mu).max(0.0).sqrt() / eta;
    let o = LocalDir::new(vec3(sin, 0.0, (1.0 - sin * sin).sqrt()));
    let reflected_o = fresnel::dielectric(mu, eta).0;
    let mut leaves = 0.0;
    for a in 0..N / 2 {
        for b in 0..N {
            let m = ggx.sample_visible(o, [(a as f64 + 0.5) / N as f64, (b as f64 + 0.5) / N as f64]);
            let i = o.reflect(m);
            if i.z() > 0.0 {
                // From inside: 1 beyond the critical angle.
                let reflected_i = fresnel::dielectric(i.z(), 1.0 / eta).0;
                let passes = (1.0 - reflected_i) / (1.0 - reflected_o.min(reflected_i)).max(1e-9);
                leaves += ggx.g2_over_g1(o, i) * passes;
            }
        }
    }
    (1.0 - leaves / (N * N / 2) as f64).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn integral(coat: &Coat<f64>, mu: f64) -> f64 {
        let wo = LocalDir::new(vec3((1.0 - mu * mu).sqrt(), 0.0, mu));
        let n = 400;
        let mut sum = 0.0;
        for i in 0..n * n {
            let u = [((i % n) as f64 + 0.5) / f64::from(n), (f64::from(i / n) + 0.5) / f64::from(n)];
            let wi = coat.sample(wo, u);
            if wi.z() > 0.0 {
                sum += coat.f(wo, wi) * wi.z() / coat.pdf(wo, wi);
            }
        }
        sum / f64::from(n * n)
    }

    #[test]
    fn the_table_matches_the_integral_between_its_nodes() {
        for (alpha, eta, mu) in
            [(0.07, 1.33, 0.9), (0.07, 1.5, 0.1), (0.23, 1.5, 0.3), (0.5, 1.8, 0.05), (0.9, 2.5, 0.6)]
        {
            let coat = Coat::new([alpha; 2], eta, 0.0);
            let (got, want) = (coat.albedo(mu), integral(&coat, mu));
            assert!((got - want).abs() < 2e-3, "alpha {alpha} eta {eta} mu {mu}: {got}, integral {want}");
        }
    }

    #[test]
    fn a_smooth_coat_is_fresnels_and_its_mean_is_the_known_one() {
        let coat = Coat::<f64>::new([0.0; 2], 1.5, 0.0);
        assert!((coat.albedo(0.5) - fresnel::dielectric(0.5, 1.5).0).abs() < 1e-12);
        // Diffuse Fresnel reflectance of n = 1.5: 0.0918 from outside, 0.5963 from inside. [Kortum1969]
        assert!((coat.t_avg - (1.0 - 0.0918)).abs() < 1e-3, "{}", coat.t_avg);
        assert!((coat.returns() - 0.5963).abs() < 1e-3, "{}", coat.returns());
    }

    #[test]
    fn absorption_dims_what_returns_to_the_base() {
        // int 2 mu R(mu) exp(-2 t / mu) by the midpoint rule, R of a smooth interface seen from inside.
        for t in [0.01, 0.1, 0.5] {
            let n = 20_000;
            let want: f64 = (0..n)
                .map(|i| {
                    let mu = (f64::from(i) + 0.5) / f64::from(n);
                    2.0 * mu * fresnel::dielectric(mu, 1.0 / 1.5).0 * Real::exp(-2.0 * t / mu)
                })
                .sum::<f64>()
                / f64::from(n);
            let got = Coat::<f64>::new([0.0; 2], 1.5, t).returns();
            assert!((got - want).abs() < 2e-3, "depth {t}: {got}, integral {want}");
        }
    }
}
