//! Where the marks of an axis stand, and what is written there.

use core::f64::consts::LN_10;

use sparrow_math::Real;

/// `10^k`, rounded once for `k` down to -22 and exact up to 22.
pub fn pow10(k: i32) -> f64 {
    let p = (0..k.unsigned_abs()).fold(1.0, |p: f64, _| p * 10.0);
    if k < 0 { 1.0 / p } else { p }
}

/// Decimal logarithm of a positive number.
pub fn log10(x: f64) -> f64 {
    Real::ln(x) / LN_10
}

/// The largest `k` with `10^k <= x`, for `x > 0`; an `x` that misses a power by rounding alone counts as that power.
pub fn decade_below(x: f64) -> i32 {
    (log10(x) + 1e-9).floor() as i32
}
/// The smallest `k` with `10^k >= x`, for `x > 0`.
pub fn decade_above(x: f64) -> i32 {
    (log10(x) - 1e-9).ceil() as i32
}

/// A step of 1, 2 or 5 times a power of ten that divides `span` into at most `n` parts.
pub fn nice_step(span: f64, n: usize) -> f64 {
    let rough = span / n.max(1) as f64;
    if !(rough > 0.0 && rough.is_finite()) {
        return 1.0;
    }
    let p = pow10(decade_below(rough));
    let m = [1.0, 2.0, 5.0, 10.0].into_iter().find(|m| m * p >= rough * (1.0 - 1e-9)).unwrap_or(10.0);
    m * p
}

/// Multiples of `step` in `lo..=hi`.
pub fn multiples(lo: f64, hi: f64, step: f64) -> Vec<f64> {
    let first = (lo / step - 1e-9).ceil() as i64;
    let last = (hi / step + 1e-9).floor() as i64;
    (first..=last.min(first + 1000)).map(|i| i as f64 * step).collect()
}

/// Powers of ten in `lo..=hi`, both positive; every second or third and so on where there are more than `n`.
pub fn decades(lo: f64, hi: f64, n: usize) -> Vec<i32> {
    let (a, b) = (decade_above(lo), decade_below(hi));
    let stride = ((b - a).max(0) as usize / n.max(1) + 1) as i32;
    (a..=b).filter(|k| k.rem_euclid(stride) == 0).collect()
}

/// A tick's number with the decimals that its step needs.
pub fn label(v: f64, step: f64) -> String {
    let v = if v.abs() < 1e-9 * step { 0.0 } else { v };
    if v.abs() >= 1e5 || (step < 1e-4 && v.abs() > 0.0) {
        let k = decade_below(v.abs());
        let mantissa = v / pow10(k);
        let mantissa = (mantissa * 100.0).round() / 100.0;
        return format!("{}·10^{{{k}}}", minus(mantissa.to_string()));
    }
    let decimals = (-decade_below(step)).max(0) as usize;
    minus(format!("{v:.decimals$}"))
}

/// A power of ten, written out where that is short.
pub fn decade_label(k: i32) -> String {
    match k {
        0..=3 => format!("{}", pow10(k)),
        -3..=-1 => format!("{:.*}", k.unsigned_abs() as usize, pow10(k)),
        _ => format!("10^{{{}}}", minus(k.to_string())),
    }
}

/// A number for people: three significant digits, no zeros at the end.
pub fn short(v: f64) -> String {
    if !v.is_finite() {
        return "not finite".to_owned();
    }
    if v.abs() <= 0.0 {
        return "0".to_owned();
    }
    let k = decade_below(v.abs());
    if !(-4..6).contains(&k) {
        return label(v, 1e-9);
    }
    let text = format!("{v:.*}", (2 - k).max(0) as usize);
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    minus(text.to_owned())
}

/// With a true minus sign instead of a hyphen.
fn minus(text: String) -> String {
    text.replacen('-', "\u{2212}", 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_nice_and_few() {
        for span in [1e-7, 0.003, 0.19, 0.2, 1.0, 7.3, 49.9, 50.0, 1234.0, 8e9] {
            for n in 2..9 {
                let step = nice_step(span, n);
                let m = step / pow10(decade_below(step));
                assert!([1.0, 2.0, 5.0].iter().any(|w| (m - w).abs() < 1e-9), "{step}");
                assert!(span / step <= n as f64 * (1.0 + 1e-9), "{span} in {n}: {step}");
                assert!(span / step > n as f64 / 2.6, "{span} in {n}: {step} is too wide");
            }
        }
    }

    #[test]
    fn multiples_include_both_ends() {
        assert_eq!(multiples(-0.2, 0.4, 0.2).len(), 4);
        assert_eq!(multiples(0.1, 0.7, 0.2).len(), 3);
        assert_eq!(decades(1e-3, 10.0, 8), [-3, -2, -1, 0, 1]);
        assert_eq!(decades(0.9e-3, 10.0, 2), [-3, 0]);
        assert_eq!(decades(2.0, 3.0, 8), [0; 0]);
    }

    #[test]
    fn labels_are_short() {
        assert_eq!(label(0.30000000000000004, 0.1), "0.3");
        assert_eq!(label(-40.0, 20.0), "\u{2212}40");
        assert_eq!(label(-1e-18, 0.1), "0.0");
        assert_eq!(label(2e6, 1e6), "2·10^{6}");
        assert_eq!([decade_label(-2), decade_label(2), decade_label(-5)], ["0.01", "100", "10^{\u{2212}5}"]);
        assert_eq!([short(0.1), short(12.345), short(0.0), short(45.0)], ["0.1", "12.3", "0", "45"]);
    }
}
