//! How stored 8-bit and 16-bit values map to linear ones: [`Encoding`].

use std::fmt;
use std::str::FromStr;
use std::sync::OnceLock;

/// The transfer curve of integer samples; floating-point samples are linear already.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Encoding {
    /// The stored fraction of full scale is the value.
    Linear,
    /// The curve of IEC 61966-2-1.
    Srgb,
    /// The stored fraction, raised to this power.
    Gamma(f32),
}

/// A name that [`Encoding`] does not know.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown encoding `{0}`; use `sRGB`, `linear` or `gamma` and a positive number, e.g. `gamma 2.2`")]
pub struct EncodingError(String);

impl FromStr for Encoding {
    type Err = EncodingError;

    /// Reads the names pbrt-v4 uses: `sRGB`, `linear`, `gamma 2.2`.
    fn from_str(s: &str) -> Result<Self, EncodingError> {
        let mut words = s.split_whitespace();
        let found = match (words.next(), words.next(), words.next()) {
            (Some("sRGB"), None, None) => Some(Encoding::Srgb),
            (Some("linear"), None, None) => Some(Encoding::Linear),
            (Some("gamma"), Some(g), None) => {
                g.parse().ok().filter(|g: &f32| g.is_finite() && *g > 0.0).map(Encoding::Gamma)
            }
            _ => None,
        };
        found.ok_or_else(|| EncodingError(s.to_owned()))
    }
}

impl fmt::Display for Encoding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Encoding::Linear => f.write_str("linear"),
            Encoding::Srgb => f.write_str("sRGB"),
            Encoding::Gamma(g) => write!(f, "gamma {g}"),
        }
    }
}

impl Encoding {
    /// The linear value of a stored fraction of full scale, which lies in [0, 1].
    pub(crate) fn to_linear(self, v: f64) -> f64 {
        match self {
            Encoding::Linear => v,
            Encoding::Srgb if v <= 0.04045 => v / 12.92,
            Encoding::Srgb => power((v + 0.055) / 1.055, 2.4),
            Encoding::Gamma(g) => power(v, f64::from(g)),
        }
    }

    /// The linear value of every 8-bit code.
    pub fn table(self) -> Box<[f32; 256]> {
        let mut t = Box::new([0.0; 256]);
        for (code, v) in t.iter_mut().enumerate() {
            *v = self.to_linear(code as f64 / 255.0) as f32;
        }
        t
    }
}

/// `x` to the power `p`, for `x` in [0, 1] and `p > 0`, from square roots and products alone.
///
/// The platform's own power function differs between platforms, and this crate stands alone. Some 60
/// square roots a value are affordable, since callers fill tables. The relative error is below 1e-13 for
/// powers up to 10.
fn power(x: f64, p: f64) -> f64 {
    let mut result = 1.0;
    let (mut whole, mut square) = (p.floor().min(1e6) as u32, x);
    while whole > 0 {
        if whole & 1 == 1 {
            result *= square;
        }
        square *= square;
        whole >>= 1;
    }
    let (mut rest, mut root) = (p - p.floor(), x);
    for _ in 0..60 {
        rest *= 2.0;
        root = root.sqrt();
        if rest >= 1.0 {
            rest -= 1.0;
            result *= root;
        }
    }
    result
}

/// The 8-bit sRGB code nearest to a linear value; 0 for NaN and below, 255 for 1 and above.
pub(crate) fn to_srgb8(linear: f32) -> u8 {
    static STEPS: OnceLock<[f32; 255]> = OnceLock::new();
    // Entry i is where the code changes from i to i + 1: the curve's value at i + 1/2.
    let steps = STEPS.get_or_init(|| {
        let mut s = [0.0; 255];
        for (i, v) in s.iter_mut().enumerate() {
            *v = Encoding::Srgb.to_linear((i as f64 + 0.5) / 255.0) as f32;
        }
        s
    });
    // At most 255 of the steps lie below, so nothing is cut off.
    steps.partition_point(|s| *s <= linear) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_pbrt() {
        assert_eq!("sRGB".parse(), Ok(Encoding::Srgb));
        assert_eq!("linear".parse(), Ok(Encoding::Linear));
        assert_eq!("gamma  2.2".parse(), Ok(Encoding::Gamma(2.2)));
        for bad in
            ["", "srgb", "gamma", "gamma x", "gamma -1", "gamma 0", "gamma inf", "linear 2", "gamma 2 2"]
        {
            let e = bad.parse::<Encoding>().unwrap_err();
            assert!(e.to_string().contains("gamma 2.2"), "{e}");
        }
        for e in [Encoding::Srgb, Encoding::Linear, Encoding::Gamma(1.8)] {
            assert_eq!(e.to_string().parse(), Ok(e));
        }
    }

    #[test]
    fn power_meets_known_values() {
        // 0.5^2.4 and 0.2^(1/2.2), to 15 digits (Python's decimal).
        for (x, p, want) in
            [(0.5, 2.4, 0.189464570813800), (0.2, 1.0 / 2.2, 0.481156505052286), (0.25, 0.5, 0.5)]
        {
            let got = power(x, p);
            assert!((got / want - 1.0).abs() < 1e-13, "{x}^{p} = {got}, want {want}");
        }
        assert!(power(0.0, 2.2).abs() < 1e-300 && (power(1.0, 2.2) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn srgb_curve_is_continuous_and_its_codes_come_back() {
        let (a, b) = (Encoding::Srgb.to_linear(0.04045), Encoding::Srgb.to_linear(0.040450001));
        assert!((a - b).abs() < 1e-7, "{a} {b}");
        let t = Encoding::Srgb.table();
        for code in 0..=255u8 {
            assert_eq!(to_srgb8(t[usize::from(code)]), code);
        }
        assert_eq!(
            [to_srgb8(f32::NAN), to_srgb8(-1.0), to_srgb8(f32::INFINITY), to_srgb8(2.0)],
            [0, 0, 255, 255]
        );
        assert_eq!(to_srgb8(0.18), 118, "middle grey: 117.6");
    }
}
