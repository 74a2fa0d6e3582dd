//! Directions as a fibre sees them: [`FibreDir`].

use sparrow_math::{LocalDir, Real, vec3};

/// A direction by its inclination and its azimuth around the fibre.
#[derive(Clone, Copy, Debug)]
pub struct FibreDir<R> {
    /// `sin theta`, the component along the fibre.
    pub sin: R,
    /// `cos theta`, not below zero.
    pub cos: R,
    /// Cosine and sine of the azimuth; (1, 0) along the fibre.
    pub across: [R; 2],
}

impl<R: Real> FibreDir<R> {
    /// Of a unit direction in the fibre's frame.
    #[inline(always)]
    pub fn new(w: LocalDir<R>) -> Self {
        let cos = (w.y().sqr() + w.z().sqr()).sqrt();
        let slanted = cos.gt(R::of(1e-18));
        let scale = R::ONE / R::select(slanted, cos, R::ONE);
        let across = [R::select(slanted, w.y() * scale, R::ONE), R::select(slanted, w.z() * scale, R::ZERO)];
        FibreDir { sin: w.x(), cos, across }
    }
    /// Sine and cosine of `theta_d = (theta_o - theta_i) / 2`, self being `o`.
    #[inline(always)]
    pub fn difference(&self, i: &Self) -> [R; 2] {
        // The sum of (cos, sin) of theta_o and -theta_i points along theta_d.
        let (cos, sin) = (self.cos + i.cos, self.sin - i.sin);
        let length = (cos * cos + sin * sin).sqrt();
        let some = length.gt(R::of(1e-9));
        let scale = R::ONE / R::select(some, length, R::ONE);
        [R::select(some, sin * scale, R::ZERO), R::select(some, cos * scale, R::ONE)]
    }
    /// Cosine and sine of the azimuth of `i` from `self`.
    #[inline(always)]
    pub fn turn_to(&self, i: &Self) -> [R; 2] {
        let ([c, s], [d, t]) = (self.across, i.across);
        [c * d + s * t, c * t - s * d]
    }
    /// Cosine and sine of the azimuth of `i` from `o`, times the cosines of both inclinations.
    #[inline(always)]
    pub fn scaled_turn(o: LocalDir<R>, i: LocalDir<R>) -> [R; 2] {
        [o.y() * i.y() + o.z() * i.z(), o.y() * i.z() - o.z() * i.y()]
    }
    /// The azimuth of `i` from `self`, in (-pi, pi].
    #[inline(always)]
    pub fn azimuth_to(&self, i: &Self) -> R {
        let [c, s] = self.turn_to(i);
        s.atan2(c)
    }
    /// The direction of the inclination `sin` at the azimuth `phi` from `self`.
    #[inline(always)]
    pub fn turned(&self, sin: R, phi: R) -> LocalDir<R> {
        let (t, d) = phi.sin_cos();
        self.turned_by(sin, [d, t])
    }
    /// The same, from cosine and sine of the azimuth.
    #[inline(always)]
    pub fn turned_by(&self, sin: R, [d, t]: [R; 2]) -> LocalDir<R> {
        let sin = sin.clamp(-R::ONE, R::ONE);
        let cos = ((R::ONE - sin) * (R::ONE + sin)).safe_sqrt();
        let [c, s] = self.across;
        LocalDir::new(vec3(sin, cos * (c * d - s * t), cos * (s * d + c * t)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turning_by_the_azimuth_leads_there() {
        let o = FibreDir::new(LocalDir::from_angles(1.1, 0.4));
        let w = LocalDir::<f64>::from_angles(2.0, -2.3);
        let i = FibreDir::new(w);
        let again = o.turned(i.sin, o.azimuth_to(&i));
        assert!((again.v() - w.v()).length() < 1e-14);
    }

    #[test]
    fn along_the_fibre_the_azimuth_is_zero() {
        let d = FibreDir::new(LocalDir::new(vec3(1.0_f64, 0.0, 0.0)));
        assert!(d.cos < 1e-300 && (d.across[0] - 1.0).abs() < 1e-15 && d.across[1].abs() < 1e-15);
    }
}
