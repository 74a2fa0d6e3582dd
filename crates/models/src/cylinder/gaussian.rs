//! Lobes that Gaussian roughness makes of the smooth cylinder's: what models of the near and of the far field share.

use core::f64::consts::PI;

use sparrow_math::{LocalDir, Real};

use super::azimuthal::WrappedGauss;
use super::longitudinal::{Longitudinal, tilted};
use super::{FibreDir, LobeChoice};
use crate::{N_LOBES, ParamInfo};

/// Parameters of the lobes: standard deviations and tilt, in degrees.
pub const WIDTHS: [ParamInfo; 3] = [
    ParamInfo::real("width_m")
        .unit("deg")
        .default(7.5)
        .range(0.5, 60.0)
        .soft(1.0, 30.0)
        .doc("Standard deviation of R along the fibre; TT has half of it, TRT twice."),
    ParamInfo::real("width_n")
        .unit("deg")
        .default(10.0)
        .range(0.5, 30.0)
        .soft(1.0, 25.0)
        .doc("Standard deviation of R and TT around the fibre; TRT has twice of it."),
    ParamInfo::real("alpha")
        .unit("deg")
        .default(3.0)
        .range(-20.0, 20.0)
        .soft(0.0, 10.0)
        .doc("Tilt of the scales, positive as in pbrt-v4."),
];

const DEGREE: f64 = PI / 180.0;

/// Longitudinal and azimuthal lobes of R, TT, TRT.
#[derive(Clone, Copy, Debug)]
pub struct GaussianLobes<R> {
    longitudinal: [Longitudinal<R>; 3],
    /// Around the fibre.
    pub azimuthal: [WrappedGauss<R>; 3],
    /// Sine and cosine of the tilts.
    tilts: [[R; 2]; 3],
}

impl<R: Real> GaussianLobes<R> {
    /// From the three [`WIDTHS`].
    #[inline(always)]
    pub fn new(width_m: R, width_n: R, alpha: R) -> Self {
        let v = (width_m * R::of(DEGREE)).sqr();
        let std = width_n * R::of(DEGREE);
        let alpha = alpha * R::of(DEGREE);
        let (s1, c1) = alpha.sin_cos();
        let (s2, c2) = (alpha + alpha).sin_cos();
        let (s4, c4) = (R::of(4.0) * alpha).sin_cos();
        GaussianLobes {
            longitudinal: [
                Longitudinal::new(v),
                Longitudinal::new(R::of(0.25) * v),
                Longitudinal::new(R::of(4.0) * v),
            ],
            azimuthal: [WrappedGauss::new(std), WrappedGauss::new(std), WrappedGauss::new(std + std)],
            tilts: [[-s2, c2], [s1, c1], [s4, c4]],
        }
    }
    /// `M_p` of every lobe.
    #[inline(always)]
    pub fn longitudinal(&self, o: &FibreDir<R>, i: &FibreDir<R>) -> [R; N_LOBES] {
        let (theta_o, theta_i) = ([o.sin, o.cos], [i.sin, i.cos]);
        let [m0, m1, m2] = &self.longitudinal;
        let [t0, t1, t2] = self.tilts;
        [
            m0.value(theta_i, tilted(theta_o, t0)),
            m1.value(theta_i, tilted(theta_o, t1)),
            m2.value(theta_i, tilted(theta_o, t2)),
            m2.value(theta_i, theta_o),
        ]
    }
    /// `sin theta_i` of a chosen lobe.
    #[inline(always)]
    pub fn draw_inclination(&self, o: &FibreDir<R>, lobe: &LobeChoice<R>, u: [R; 2]) -> R {
        let theta_o = [o.sin, o.cos];
        let [m0, m1, m2] = &self.longitudinal;
        let [t0, t1, t2] =
            [tilted(theta_o, self.tilts[0]), tilted(theta_o, self.tilts[1]), tilted(theta_o, self.tilts[2])];
        let m = Longitudinal::select(lobe.from[1], m2, &Longitudinal::select(lobe.from[0], m1, m0));
        m.sample([lobe.pick([t0[0], t1[0], t2[0], o.sin]), lobe.pick([t0[1], t1[1], t2[1], o.cos])], u)
    }
    /// The turn away from the exit azimuth in a chosen lobe; anywhere for what is reflected inside more than once.
    #[inline(always)]
    pub fn draw_turn(&self, lobe: &LobeChoice<R>, u: R) -> R {
        let [a, b, c] =
            [self.azimuthal[0].sample(u), self.azimuthal[1].sample(u), self.azimuthal[2].sample(u)];
        lobe.pick([a, b, c, R::of(2.0 * PI) * u])
    }
    /// A direction in a chosen lobe whose light leaves at the azimuth `exit`.
    #[inline(always)]
    pub fn draw(&self, o: &FibreDir<R>, lobe: &LobeChoice<R>, exit: R, [u0, u1, u2]: [R; 3]) -> LocalDir<R> {
        o.turned(self.draw_inclination(o, lobe, [u0, u1]), exit + self.draw_turn(lobe, u2))
    }
}
