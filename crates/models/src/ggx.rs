//! The GGX (Trowbridge-Reitz) distribution of microfacet normals with Smith's masking.
//!
//! Shared by every microfacet model. Symbols as in [Heitz2014]: `D` the distribution, `Lambda` the
//! masking integral, `G1 = 1 / (1 + Lambda)`, `G2` height-correlated.

use core::f64::consts::PI;

use sparrow_math::{LocalDir, Real, vec3};

/// Below this slope width a surface counts as a mirror: single precision cannot resolve the lobe.
pub const ALPHA_SMOOTH: f64 = 1e-3;
/// Smallest slope width the formulas are evaluated with where only one axis is that narrow.
const ALPHA_MIN: f64 = 1e-4;

/// GGX with slope widths along x (the grain) and y.
#[derive(Clone, Copy, Debug)]
pub struct Ggx<R> {
    alpha_x: R,
    alpha_y: R,
}

impl<R: Real> Ggx<R> {
    /// Slope widths along the tangent and across it.
    #[inline(always)]
    pub fn new(alpha_x: R, alpha_y: R) -> Self {
        Ggx { alpha_x: alpha_x.max(R::of(ALPHA_MIN)), alpha_y: alpha_y.max(R::of(ALPHA_MIN)) }
    }
    /// The widths that the formulas are evaluated with.
    #[inline(always)]
    pub(crate) fn alphas(&self) -> [R; 2] {
        [self.alpha_x, self.alpha_y]
    }
    /// The surface is a mirror in both directions.
    #[inline(always)]
    pub fn is_smooth(&self) -> R::Mask {
        self.alpha_x.max(self.alpha_y).lt(R::of(ALPHA_SMOOTH))
    }
    /// Widened as pbrt-v4 regularises: doubled and brought into [0.1, 0.3] where it was below 0.3.
    #[inline(always)]
    #[must_use]
    pub fn regularized(self) -> Self {
        let wider = |a: R| {
            let w = (a + a).clamp(R::of(0.1), R::of(0.3));
            R::select(a.lt(R::of(0.3)), w, a)
        };
        Ggx { alpha_x: wider(self.alpha_x), alpha_y: wider(self.alpha_y) }
    }

    /// `D(m)`, per steradian; integrates to one with the weight `cos theta_m`. [Heitz2014, eq. 85]
    ///
    /// In vector form, which keeps its digits at grazing normals, times powers of the widths, which leaves one division.
    #[inline(always)]
    pub fn d(&self, m: LocalDir<R>) -> R {
        let a = self.alpha_x * self.alpha_y;
        let s = (m.x() * self.alpha_y).sqr() + (m.y() * self.alpha_x).sqr() + (m.z() * a).sqr();
        a * (a / s).sqr() * R::of(1.0 / PI)
    }
    /// `|cos theta| (1 + 2 Lambda(w))`, free of divisions. [Heitz2014, eq. 86]
    #[inline(always)]
    pub fn stretched(&self, w: LocalDir<R>) -> R {
        ((self.alpha_x * w.x()).sqr() + (self.alpha_y * w.y()).sqr() + w.z().sqr()).sqrt()
    }
    /// `G2(wo, wi) / (4 |cos theta_o| |cos theta_i|)` for reflection. [Heitz2014, eq. 99]
    #[inline(always)]
    pub fn g2_over_4cos(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> R {
        R::of(0.5) / self.crossed(wo, wi)
    }
    /// [`g2_over_4cos`](Self::g2_over_4cos), and the density of the direction mirrored at a visible normal over `D`, which
    /// is [`visible_over_cos`](Self::visible_over_cos) over `4 D`: together they take one division.
    #[inline(always)]
    pub fn g2_over_4cos_and_density(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> (R, R) {
        let (crossed, seen) = (self.crossed(wo, wi), self.seen(wo));
        let half = R::of(0.5) / (crossed * seen);
        (half * seen, half * crossed)
    }
    /// `G2(wo, wi) / G1(wo)`
    #[inline(always)]
    pub fn g2_over_g1(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> R {
        wi.abs_cos_theta() * self.seen(wo) / self.crossed(wo, wi)
    }
    /// `2 |cos theta| / G1`
    #[inline(always)]
    fn seen(&self, w: LocalDir<R>) -> R {
        w.abs_cos_theta() + self.stretched(w)
    }
    /// `2 |cos_o| |cos_i| / G2`: the denominator that the correlated forms share.
    #[inline(always)]
    fn crossed(&self, wo: LocalDir<R>, wi: LocalDir<R>) -> R {
        wo.abs_cos_theta() * self.stretched(wi) + wi.abs_cos_theta() * self.stretched(wo)
    }
    /// Density of the visible normals over `wo.m`: `D_w(m) / (wo.m) = G1(wo) D(m) / |cos theta_o|`. [Heitz2018, eq. 1]
    ///
    /// Divided by four it is the density of the reflected direction.
    #[inline(always)]
    pub fn visible_over_cos(&self, wo: LocalDir<R>, m: LocalDir<R>) -> R {
        R::of(2.0) * self.d(m) / self.seen(wo)
    }
    /// A normal among those visible from `wo`, on the upper side. [DupuyBenyoub2023, listing 3]
    ///
    /// `wo` must lie above.
    #[inline(always)]
    pub fn sample_visible(&self, wo: LocalDir<R>, u: [R; 2]) -> LocalDir<R> {
        let w = vec3(self.alpha_x * wo.x(), self.alpha_y * wo.y(), wo.z()).normalized();
        let (sin_phi, cos_phi) = (R::of(2.0 * PI) * u[0]).sin_cos();
        let z = (R::ONE - u[1]) * (R::ONE + w.z) - w.z;
        let s = ((R::ONE - z) * (R::ONE + z)).safe_sqrt();
        let n = vec3(s * cos_phi, s * sin_phi, z) + w;
        // Rounding may take z to zero or below at grazing views.
        LocalDir::new(vec3(self.alpha_x * n.x, self.alpha_y * n.y, n.z.max(R::of(1e-7))).normalized())
    }

    /// [`sample_visible`](Self::sample_visible) by the older construction: a disk seen from `wo`, its lower half
    /// squeezed. `u[0]` is the squared radius, `u[1]` the angle. [Heitz2018, sec. 4]
    #[inline(always)]
    pub fn sample_visible_disk(&self, wo: LocalDir<R>, u: [R; 2]) -> LocalDir<R> {
        let w = vec3(self.alpha_x * wo.x(), self.alpha_y * wo.y(), wo.z()).normalized();
        let len2 = w.x.sqr() + w.y.sqr();
        // Any frame serves where the view is along the normal.
        let tilted = len2.gt(R::of(1e-14));
        let inv = R::ONE / R::select(tilted, len2, R::ONE).sqrt();
        let t1 = vec3(R::select(tilted, -w.y * inv, R::ONE), R::select(tilted, w.x * inv, R::ZERO), R::ZERO);
        let t2 = w.cross(t1);
        let (sin_phi, cos_phi) = (R::of(2.0 * PI) * u[1]).sin_cos();
        let r = u[0].sqrt();
        let a = r * cos_phi;
        let s = R::of(0.5) * (R::ONE + w.z);
        let chord = ((R::ONE - a) * (R::ONE + a)).safe_sqrt();
        let b = (R::ONE - s) * chord + s * (r * sin_phi);
        let n = t1 * a + t2 * b + w * (R::ONE - a * a - b * b).safe_sqrt();
        LocalDir::new(vec3(self.alpha_x * n.x, self.alpha_y * n.y, n.z.max(R::of(1e-7))).normalized())
    }

    /// `k` of the bound on reflected directions, from the narrower width. [EtoTokuyoshi2023, eq. 6]
    #[inline(always)]
    fn bound(&self, wo: LocalDir<R>) -> R {
        let a2 = self.alpha_x.min(self.alpha_y).min(R::ONE).sqr();
        let s2 = (R::ONE + wo.sin2_theta().sqrt()).sqr();
        (R::ONE - a2) * s2 / (s2 + a2 * wo.z().sqr())
    }
    /// A normal among those visible from `wo` whose mirror direction is likely to lie above: the cap of
    /// [`sample_visible`](Self::sample_visible) cut from below. `wo` must lie above. [EtoTokuyoshi2023, listing 1]
    #[inline(always)]
    pub fn sample_bounded(&self, wo: LocalDir<R>, u: [R; 2]) -> LocalDir<R> {
        let w = vec3(self.alpha_x * wo.x(), self.alpha_y * wo.y(), wo.z()).normalized();
        let b = self.bound(wo) * w.z;
        let (sin_phi, cos_phi) = (R::of(2.0 * PI) * u[0]).sin_cos();
        let z = (R::ONE - u[1]) * (R::ONE + b) - b;
        let s = ((R::ONE - z) * (R::ONE + z)).safe_sqrt();
        let n = vec3(s * cos_phi, s * sin_phi, z) + w;
        LocalDir::new(vec3(self.alpha_x * n.x, self.alpha_y * n.y, n.z.max(R::of(1e-7))).normalized())
    }
    /// Density of the directions mirrored at [`sample_bounded`](Self::sample_bounded), over `D(m)`.
    /// [EtoTokuyoshi2023, eq. 8]
    #[inline(always)]
    pub fn bounded_over_d(&self, wo: LocalDir<R>) -> R {
        R::of(0.5) / (self.bound(wo) * wo.abs_cos_theta() + self.stretched(wo))
    }
}
