//! What lies between the start and the end of a motion: [`Lerp`].

/// Weights of start and end. Rounding keeps order: what lies between two numbers at start and end stays between them, so
/// boxes need no room for it; and at the ends of the motion numbers are exact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lerp {
    pub(crate) start: f32,
    pub(crate) end: f32,
}

impl Lerp {
    /// At a time in [0, 1]; others count as the nearer end, and what is no number as the start.
    #[inline(always)]
    pub(crate) fn at(time: f32) -> Lerp {
        // Written so that NaN becomes 0.
        let end = if time > 0.0 { time.min(1.0) } else { 0.0 };
        Lerp { start: 1.0 - end, end }
    }
    #[inline(always)]
    pub(crate) fn array<const N: usize>(self, start: [f32; N], end: [f32; N]) -> [f32; N] {
        let mut out = start;
        for (out, end) in out.iter_mut().zip(end) {
            *out = *out * self.start + end * self.end;
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_exact_and_order_stays() {
        let (a, b) = ([0.1, -7.3e4, 1e-30], [0.3, 2.9e-3, 5.0]);
        let bits = |time: f32| Lerp::at(time).array(a, b).map(f32::to_bits);
        for (time, end) in [(0.0, a), (1.0, b), (-3.0, a), (9.0, b), (f32::NAN, a)] {
            assert_eq!(bits(time), end.map(f32::to_bits), "{time}");
        }
        // Neighbours among the numbers never change places.
        for i in 0..10_000 {
            let at = Lerp::at(i as f32 / 9_999.0);
            let low = at.array(a, b);
            let high = at.array(a.map(f32::next_up), b.map(f32::next_up));
            assert!(low.iter().zip(&high).all(|(l, h)| l <= h), "{at:?}");
        }
    }
}
