//! The choice of a lobe by one uniform number: [`LobeChoice`].

use sparrow_math::Real;
use sparrow_spectra::Spectrum;

use crate::N_LOBES;

/// The lobe that was chosen, and what is left of the uniform number.
#[derive(Clone, Copy, Debug)]
pub struct LobeChoice<R: Real> {
    /// The lobe is at least 1, 2, 3.
    pub from: [R::Mask; 3],
    /// Uniform in [0, 1] within the lobe.
    pub left: R,
}

impl<R: Real> LobeChoice<R> {
    /// Chooses with probabilities in proportion to `chances`, whose sum is `sum`.
    #[inline(always)]
    pub fn new(u: R, chances: [R; N_LOBES], sum: R) -> Self {
        let x = u * sum;
        let [a, b, c] = [chances[0], chances[0] + chances[1], chances[0] + chances[1] + chances[2]];
        let mut choice = LobeChoice { from: [x.ge(a), x.ge(b), x.ge(c)], left: x };
        let chance = choice.pick(chances).max(R::of(1e-30));
        choice.left = ((x - choice.pick([R::ZERO, a, b, c])) / chance).clamp(R::ZERO, R::ONE);
        choice
    }
    /// Chooses with probabilities in proportion to the means of `shares` over the wavelengths.
    #[inline(always)]
    pub fn of(u: R, shares: &[Spectrum<R>; N_LOBES]) -> Self {
        let [a, b, c, d] =
            [shares[0].average(), shares[1].average(), shares[2].average(), shares[3].average()];
        Self::new(u, [a, b, c, d], ((a + b) + (c + d)).max(R::of(1e-30)))
    }
    /// The value of the lobe.
    #[inline(always)]
    pub fn pick(&self, v: [R; N_LOBES]) -> R {
        let [one, two, three] = self.from;
        R::select(three, v[3], R::select(two, v[2], R::select(one, v[1], v[0])))
    }
}
