//! A rough surface: its normals, how they hide each other, and how they are drawn.

use sparrow_math::{LocalDir, Real};

use super::ndf::{Ndf, NdfKind};
use super::smith;
use crate::opaque::Half;
use crate::v_cavity;

/// How facets hide each other from the viewer and the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Masking {
    /// Smith, correlated by height: `1 / (1 + Lambda_o + Lambda_i)`. [Heitz2014, eq. 99]
    Smith,
    /// Smith, independent: `G_1(o) G_1(i)`. [Walter2007, eq. 23]
    Separable,
    /// Symmetric V-grooves. [TorranceSparrow1967]
    VCavity,
    /// Facets do not hide each other; more light leaves than arrives.
    None,
}

impl Masking {
    /// Names in the order of [`from_choice`](Self::from_choice).
    pub const NAMES: &'static [&'static str] = &["smith", "separable", "v_cavity", "none"];
    /// The kind at a place of [`NAMES`](Self::NAMES).
    #[inline(always)]
    pub fn from_choice(i: u8) -> Self {
        match i {
            0 => Masking::Smith,
            1 => Masking::Separable,
            2 => Masking::VCavity,
            _ => Masking::None,
        }
    }
}

/// How normals are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// Those visible from the viewer: spherical caps for GGX [DupuyBenyoub2023], inversion for Beckmann [Jakob2014].
    Visible,
    /// Those visible, by Heitz's disk for GGX. [Heitz2018]
    Disk,
    /// All, by the full distribution. [Walter2007, sec. 5.2]
    Full,
    /// Those visible whose mirror direction is likely to lie above, for GGX. [EtoTokuyoshi2023]
    Bounded,
}

impl Sampling {
    /// Names in the order of [`from_choice`](Self::from_choice).
    pub const NAMES: &'static [&'static str] = &["visible", "disk", "full", "bounded"];
    /// The kind at a place of [`NAMES`](Self::NAMES).
    #[inline(always)]
    pub fn from_choice(i: u8) -> Self {
        match i {
            0 => Sampling::Visible,
            1 => Sampling::Disk,
            2 => Sampling::Full,
            _ => Sampling::Bounded,
        }
    }
    /// What a distribution can do: others than GGX know no disk and no bound, and only GGX and Beckmann can be drawn
    /// by what is visible.
    #[inline(always)]
    fn for_ndf(self, kind: NdfKind) -> Self {
        match (kind, self) {
            (NdfKind::Ggx, s) => s,
            (NdfKind::Beckmann, Sampling::Visible | Sampling::Disk | Sampling::Bounded) => Sampling::Visible,
            (NdfKind::Beckmann | NdfKind::Blinn | NdfKind::Gtr | NdfKind::StudentT, _) => Sampling::Full,
        }
    }
}

/// A rough surface.
#[derive(Clone, Copy, Debug)]
pub struct Facets<R> {
    ndf: Ndf<R>,
    masking: Masking,
    sampling: Sampling,
}

impl<R: Real> Facets<R> {
    /// With normals of `ndf`; where a way of drawing does not exist for it, the nearest that does is taken.
    #[inline(always)]
    pub fn new(ndf: Ndf<R>, masking: Masking, sampling: Sampling) -> Self {
        Facets { ndf, masking, sampling: sampling.for_ndf(ndf.kind()) }
    }
    /// The distribution of normals.
    #[inline(always)]
    pub fn ndf(&self) -> &Ndf<R> {
        &self.ndf
    }
    /// How facets hide each other.
    #[inline(always)]
    pub fn masking(&self) -> Masking {
        self.masking
    }
    /// With narrow lobes widened.
    #[inline(always)]
    #[must_use]
    pub fn regularized(self) -> Self {
        Facets { ndf: self.ndf.regularized(), ..self }
    }

    /// A relative three times as wide, from which directions are drawn that light takes after several facets.
    #[inline(always)]
    #[must_use]
    pub(crate) fn for_further(self) -> Self {
        Facets { ndf: self.ndf.widened(3.0), ..self }
    }

    /// `G_2 / (4 cos theta_o cos theta_i)` for reflection; `o` and `i` above.
    #[inline(always)]
    pub fn g2_over_4cos(&self, o: LocalDir<R>, i: LocalDir<R>) -> R {
        let (mu_o, mu_i) = (o.cos_theta(), i.cos_theta());
        let denominator = match self.masking {
            Masking::Smith => mu_o * mu_i + mu_o * self.ndf.mu_lambda(i) + mu_i * self.ndf.mu_lambda(o),
            Masking::Separable => (mu_o + self.ndf.mu_lambda(o)) * (mu_i + self.ndf.mu_lambda(i)),
            Masking::VCavity => return v_cavity::g_over_4cos(o, i, &Half::new(o, i)),
            Masking::None => mu_o * mu_i,
        };
        R::of(0.25) / denominator.max(R::of(1e-30))
    }
    /// `Lambda` of a direction with the cosine `mu`.
    #[inline(always)]
    fn lambda(&self, w: LocalDir<R>, mu: R) -> R {
        self.ndf.mu_lambda(w) / mu.max(R::of(1e-12))
    }
    /// `G_2 / (4 |cos theta_o cos theta_i|)` for transmission, `o` above and `i` below: the correlated form is
    /// `B(1 + Lambda_o, 1 + Lambda_i)` [Heitz2016, eq. 23]; V-grooves count as independent.
    #[inline(always)]
    pub fn transmitted_g2_over_4cos(&self, o: LocalDir<R>, i: LocalDir<R>) -> R {
        let (mu_o, mu_i) = (o.abs_cos_theta(), i.abs_cos_theta());
        let quarter = R::of(0.25);
        match self.masking {
            Masking::Smith => {
                quarter * smith::transmission_g2(self.lambda(o, mu_o), self.lambda(i, mu_i))
                    / (mu_o * mu_i).max(R::of(1e-30))
            }
            Masking::Separable | Masking::VCavity => {
                quarter / ((mu_o + self.ndf.mu_lambda(o)) * (mu_i + self.ndf.mu_lambda(i))).max(R::of(1e-30))
            }
            Masking::None => quarter / (mu_o * mu_i).max(R::of(1e-30)),
        }
    }

    /// Draws a normal for the viewer `o`, above.
    #[inline(always)]
    pub fn sample(&self, o: LocalDir<R>, u: [R; 2]) -> LocalDir<R> {
        match self.sampling {
            Sampling::Visible => self.ndf.sample_visible(o, u),
            Sampling::Disk => self.ndf.ggx().sample_visible_disk(o, u),
            Sampling::Full => self.ndf.sample(u),
            Sampling::Bounded => self.ndf.ggx().sample_bounded(o, u),
        }
    }
    /// The density of [`sample`](Self::sample) over `(o.m) D(m)`: times `D / 4` it is that of the mirrored direction.
    #[inline(always)]
    pub fn density_over_d(&self, o: LocalDir<R>, m: LocalDir<R>, o_dot_m: R) -> R {
        match self.sampling {
            Sampling::Visible | Sampling::Disk => {
                R::ONE / (o.abs_cos_theta() + self.ndf.mu_lambda(o)).max(R::of(1e-30))
            }
            Sampling::Full => m.z() / o_dot_m,
            Sampling::Bounded => R::of(4.0) * self.ndf.ggx().bounded_over_d(o),
        }
    }
    /// Density of the direction that a drawn normal mirrors `o` into. [Walter2007, eq. 14]
    #[inline(always)]
    pub(crate) fn mirrored_density(&self, o: LocalDir<R>, half: &Half<R>) -> R {
        R::of(0.25) * self.ndf.d(half.m) * self.density_over_d(o, half.m, half.cos_d)
    }
}
