//! What a perceptual roughness in 0 to 1 means for the lobes. [Chiang2016]

use sparrow_math::Real;

/// Longitudinal variance of R in rad^2. [Chiang2016, eq. 7]
#[inline(always)]
pub fn variance<R: Real>(beta_m: R) -> R {
    let b4 = beta_m.sqr().sqr();
    let b20 = b4.sqr().sqr() * b4;
    (R::of(0.726) * beta_m + R::of(0.812) * beta_m.sqr() + R::of(3.7) * b20).sqr()
}

/// Azimuthal scale in rad. [Chiang2016, eq. 8]
#[inline(always)]
pub fn logistic_scale<R: Real>(beta_n: R) -> R {
    let b2 = beta_n.sqr();
    let b6 = b2 * b2 * b2;
    let b22 = (b6 * b2).sqr() * b6;
    // sqrt(pi / 8)
    R::of(0.626_657_068_657_750_1) * (R::of(0.265) * beta_n + R::of(1.194) * b2 + R::of(5.372) * b22)
}
