//! Hair of elliptical section: Gaussian lobes about the rays through a smooth ellipse, near or far field. [KhungurnMarschner2017]
//!
//! `q = sum_p M_p(theta_i, theta_o + shift_p) A_p(h) D(phi - Phi_p(h))` as in [`zinke_weber`](super::zinke_weber), with `A_p` and `Phi_p` of
//! rays traced through the ellipse (`cylinder::elliptic`); far field: the mean over h. The section has the semi-axes 1 along y and `aspect`
//! along z of the fibre's frame: turning the frame along the fibre turns its glints. The light inside goes by the viewer's inclination,
//! which keeps energy exactly. Where the ellipse holds TRT back by total reflection, it joins what leaves evenly around the fibre.
//!
//! The paper finds the rays of a pair of directions by adaptive quadrature; ours are [`SEGMENTS`] segments of the width, within which
//! `A_p` and `Phi_p` run evenly.

use core::f64::consts::PI;

use sparrow_math::LocalDir;
use sparrow_spectra::Spectrum;

use crate::cylinder::azimuthal::{Azimuthal, WrappedGauss, wrapped};
use crate::cylinder::elliptic::Elliptic;
use crate::cylinder::gaussian::{GaussianLobes, WIDTHS};
use crate::cylinder::section::{Flat, Section};
use crate::cylinder::{FibreDir, LobeChoice};
use crate::summed::{Seen, Sum, Summed};
use crate::{About, Lack, N_LOBES, ParamBlock, ParamInfo, Uniforms};

/// Segments across a fibre of the far field.
const SEGMENTS: usize = 32;

/// A hair of elliptical section.
pub(super) type EllipticalHair<R> = Summed<R, Ellipse>;

/// The model in double precision.
#[derive(Clone, Copy, Debug)]
pub struct Ellipse {
    sigma_a: Spectrum<f64>,
    eta: f64,
    lobes: GaussianLobes<f64>,
    section: Section<f64>,
    h: f64,
    far: bool,
}

impl Sum for Ellipse {
    type Seen = SeenEllipse;

    const ABOUT: About = About::new("dielectric fibre of elliptical section, Gaussian lobes, near or far field", "KhungurnMarschner2017, dEon2011")
        .anisotropic()
        .transmits()
        .lacks(&[
            Lack::reciprocity("the tilt and the angle inside know the viewer's inclination alone"),
            Lack::energy("no view is brighter than uniform light, but a lamp near the axis may be given back more than it sent"),
        ]);
    const PARAMS: &'static [ParamInfo] = &[
        ParamInfo::unbounded("sigma_a").unit("1/radius").default(0.5).soft(0.0, 10.0).doc("Absorption."),
        ParamInfo::real("eta")
            .default(1.55)
            .range(1.0, 3.0)
            .soft(1.3, 1.9)
            .doc("Relative index of refraction."),
        WIDTHS[0],
        WIDTHS[1],
        WIDTHS[2],
        ParamInfo::real("aspect")
            .default(0.7)
            .range(0.3, 2.0)
            .soft(0.5, 1.0)
            .doc("Semi-axis of the section along z of the frame over that along y."),
        ParamInfo::choice("field", &["near", "far"])
            .doc("Where the ray met the fibre, or the mean over its width."),
    ];

    fn new(p: &ParamBlock<f64>) -> Self {
        Ellipse {
            sigma_a: p.spectra[0],
            eta: p.reals[0],
            lobes: GaussianLobes::new(p.reals[1], p.reals[2], p.reals[3]),
            section: Section { b: p.reals[4] },
            h: p.h,
            far: p.choices[0] != 0,
        }
    }

    fn seen_from(&self, wo: LocalDir<f64>) -> SeenEllipse {
        let o = FibreDir::new(wo);
        let rays =
            Elliptic { section: self.section, theta: [o.sin, o.cos], eta: self.eta, sigma_a: self.sigma_a };
        let rays = if self.far {
            Rays::across(&rays, o.across)
        } else {
            Rays::At(End::new(&rays, o.across, self.h))
        };
        SeenEllipse { o, shares: rays.shares(), rays, lobes: self.lobes }
    }
}

/// One ray: the azimuths from the viewer's at which R, TT, TRT leave, and `A_p`.
#[derive(Clone, Copy, Debug)]
struct End {
    exits: [f64; 3],
    a: [Spectrum<f64>; N_LOBES],
}

impl End {
    const NONE: End = End { exits: [0.0; 3], a: [Spectrum([0.0; 4]); N_LOBES] };

    fn new(rays: &Elliptic, from: Flat<f64>, h: f64) -> End {
        let e = rays.exits(from, h);
        End { exits: e.azimuths(from), a: e.a }
    }
}

/// Light between two rays.
struct Segment<'a> {
    /// Share of the width.
    share: f64,
    ends: [&'a End; 2],
}

impl Segment<'_> {
    /// The light of lobe `p`, as a share of all.
    fn light(&self, p: usize) -> Spectrum<f64> {
        (self.ends[0].a[p] + self.ends[1].a[p]) * (0.5 * self.share)
    }
    /// Exit of lobe `p` at the first ray, and by how much it turns to the other.
    fn exit(&self, p: usize) -> [f64; 2] {
        let [a, b] = self.ends.map(|e| e.exits[p]);
        [a, wrapped(b - a)]
    }
    /// The blurred density of lobe `p` at the azimuth `phi`.
    fn density(&self, p: usize, phi: f64, d: &WrappedGauss<f64>) -> f64 {
        let [exit, turn] = self.exit(p);
        d.mean(wrapped(phi - exit - 0.5 * turn), turn.abs())
    }
}

/// Offset of the `k`-th ray of the far field: dense at the rims.
fn offset(k: usize) -> f64 {
    let x = 2.0 * k as f64 / SEGMENTS as f64 - 1.0;
    0.5 * x * (3.0 - x * x)
}

/// The rays that a view looks at.
#[allow(clippy::large_enum_variant, reason = "lives on the stack for one call")]
enum Rays {
    /// One.
    At(End),
    /// The ends of the segments.
    Across([End; SEGMENTS + 1]),
}

impl Rays {
    fn across(rays: &Elliptic, from: Flat<f64>) -> Rays {
        let mut ends = [End::NONE; SEGMENTS + 1];
        for (k, end) in ends.iter_mut().enumerate() {
            *end = End::new(rays, from, offset(k));
        }
        Rays::Across(ends)
    }
    fn segments(ends: &[End; SEGMENTS + 1]) -> impl Iterator<Item = Segment<'_>> {
        (0..SEGMENTS)
            .map(|k| Segment { share: 0.5 * (offset(k + 1) - offset(k)), ends: [&ends[k], &ends[k + 1]] })
    }
    /// `A_p`, or its mean over the width.
    fn shares(&self) -> [Spectrum<f64>; N_LOBES] {
        match self {
            Rays::At(end) => end.a,
            Rays::Across(ends) => {
                let mut sum = [Spectrum::ZERO; N_LOBES];
                for s in Rays::segments(ends) {
                    for (p, sum) in sum.iter_mut().enumerate() {
                        *sum += s.light(p);
                    }
                }
                sum
            }
        }
    }
    /// `A_p N_p` of R, TT or TRT at the azimuth `phi` from the viewer's.
    fn around(&self, p: usize, phi: f64, d: &WrappedGauss<f64>) -> Spectrum<f64> {
        match self {
            Rays::At(end) => end.a[p] * d.value(wrapped(phi - end.exits[p])),
            Rays::Across(ends) => {
                let mut sum = Spectrum::ZERO;
                for s in Rays::segments(ends) {
                    let density = s.density(p, phi, d);
                    if density > 0.0 {
                        sum += s.light(p) * density;
                    }
                }
                sum
            }
        }
    }
    /// An exit azimuth of lobe `p`, whose light is `total`, and a uniform number that is left of `u`.
    fn draw(&self, p: usize, total: f64, u: f64) -> [f64; 2] {
        match self {
            Rays::At(end) => [end.exits[p], u],
            Rays::Across(ends) => {
                let mut x = u * total;
                let mut last = [0.0, 0.5];
                for s in Rays::segments(ends) {
                    let chance = s.light(p).average();
                    let [exit, turn] = s.exit(p);
                    let within = (x / chance.max(1e-300)).min(1.0);
                    // Coarse steps along the segment, which D blurs; the rest of the number is left over.
                    let fine = within * STEPS;
                    let whole = fine.floor().min(STEPS - 1.0);
                    last = [exit + (whole + 0.5) / STEPS * turn, fine - whole];
                    if x < chance {
                        break;
                    }
                    x -= chance;
                }
                last
            }
        }
    }
}

/// Steps along a segment.
const STEPS: f64 = 256.0;

/// A hair with its viewer.
pub struct SeenEllipse {
    o: FibreDir<f64>,
    lobes: GaussianLobes<f64>,
    rays: Rays,
    shares: [Spectrum<f64>; N_LOBES],
}

impl Seen for SeenEllipse {
    fn f_cos_pdf(&self, wi: LocalDir<f64>) -> (Spectrum<f64>, f64) {
        let [r, tt, trt, rest] = self.lobes(wi);
        let [a, b, c, d] = self.shares;
        let q = (r + tt) + (trt + rest);
        (q, q.average() / ((a + b) + (c + d)).average().max(1e-300))
    }

    fn lobes(&self, wi: LocalDir<f64>) -> [Spectrum<f64>; N_LOBES] {
        let i = FibreDir::new(wi);
        let (m, phi) = (self.lobes.longitudinal(&self.o, &i), self.o.azimuth_to(&i));
        let mut q = [Spectrum::ZERO, Spectrum::ZERO, Spectrum::ZERO, self.shares[3] * (m[3] * 0.5 / PI)];
        for (p, d) in self.lobes.azimuthal.iter().enumerate() {
            if m[p] > 0.0 {
                q[p] = self.rays.around(p, phi, d) * m[p];
            }
        }
        q
    }

    fn draw(&self, u: Uniforms<f64>) -> Option<LocalDir<f64>> {
        let lobe = LobeChoice::of(u.lobe, &self.shares);
        let p = lobe.from.iter().filter(|f| **f).count();
        let [exit, left] =
            if p < 3 { self.rays.draw(p, self.shares[p].average(), lobe.left) } else { [0.0, lobe.left] };
        Some(self.lobes.draw(&self.o, &lobe, exit, [u.dir[0], left, u.dir[1]]))
    }
}
