//! Student's t: means of few numbers. [Press2007, sec. 6.4, 14.2]

use sparrow_math::Real;

use crate::Mean;
use crate::special::ln_gamma;

/// Probability that Student's t with `dof` degrees of freedom is at least `|t|` away from zero, on either side.
///
/// `I_x(dof / 2, 1 / 2)` with `x = dof / (dof + t^2)`. 1 where `dof` is not above 0 or `t` is not a number.
pub fn student_tails(t: f64, dof: f64) -> f64 {
    if !(dof > 0.0) || t.is_nan() {
        return 1.0;
    }
    if t.is_infinite() {
        return 0.0;
    }
    beta_i(0.5 * dof, 0.5, dof / (dof + t * t))
}

/// The value that `|t|` exceeds with probability `level`, in (0, 1).
pub fn student_quantile(level: f64, dof: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    while student_tails(high, dof) > level && high < 1e12 {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..60 {
        let mid = 0.5 * (low + high);
        if student_tails(mid, dof) > level { low = mid } else { high = mid }
    }
    0.5 * (low + high)
}

/// Mean of independent numbers, and how far the truth may be from it but for a chance of `level`; infinitely far where there
/// are fewer than two.
pub fn mean_interval(values: &[f64], level: f64) -> (f64, f64) {
    let mut mean = Mean::default();
    values.iter().for_each(|v| mean.add(*v));
    let n = mean.count();
    let reach =
        if n > 1.0 { student_quantile(level, n - 1.0) * (mean.variance() / n).sqrt() } else { f64::INFINITY };
    (mean.value(), reach)
}

/// Probability that two sets of numbers with the same true mean have means at least this different, whatever their variances.
///
/// Welch's test. 1 where either has fewer than two numbers; 0 or 1 where neither varies.
pub fn welch_p(a: &Mean, b: &Mean) -> f64 {
    if a.count() < 2.0 || b.count() < 2.0 {
        return 1.0;
    }
    let [va, vb] = [a, b].map(|m| m.variance() / m.count());
    let (d, v) = (a.value() - b.value(), va + vb);
    if !(v > 0.0) {
        return if d.abs() > 0.0 { 0.0 } else { 1.0 };
    }
    let dof = v * v / (va * va / (a.count() - 1.0) + vb * vb / (b.count() - 1.0));
    student_tails(d / v.sqrt(), dof)
}

/// Regularised incomplete beta function `I_x(a, b)` for `a, b > 0` and `x` in 0..1.
fn beta_i(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return if x <= 0.0 { 0.0 } else { 1.0 };
    }
    // The fraction converges quickly below the mean of the distribution.
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - beta_i(b, a, 1.0 - x);
    }
    let exponent = ln_gamma(a + b) - ln_gamma(a) - ln_gamma(b) + a * Real::ln(x) + b * Real::ln(1.0 - x);
    let front = if exponent < -745.0 { 0.0 } else { Real::exp(exponent) };
    front * fraction(a, b, x) / a
}

/// Continued fraction of the incomplete beta function, after Lentz.
fn fraction(a: f64, b: f64, x: f64) -> f64 {
    const TINY: f64 = 1e-300;
    let away = |v: f64| if v.abs() < TINY { TINY } else { v };
    let (mut c, mut d) = (1.0, 1.0 / away(1.0 - (a + b) * x / (a + 1.0)));
    let mut h = d;
    for m in (1..500).map(f64::from) {
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let mut factor = 1.0;
        for term in [even, odd] {
            d = 1.0 / away(1.0 + term * d);
            c = away(1.0 + term / c);
            factor = c * d;
            h *= factor;
        }
        if (factor - 1.0).abs() < 1e-15 {
            break;
        }
    }
    h
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Random;
    use statrs::distribution::{ContinuousCDF, StudentsT};

    #[test]
    fn tables_and_an_implementation_of_others_agree() {
        // 5 % points, both sides: 12.706 with 1 degree of freedom, 2.3646 with 7.
        assert!((student_quantile(0.05, 1.0) - 12.706_204_736).abs() < 1e-6);
        assert!((student_quantile(0.05, 7.0) - 2.364_624_252).abs() < 1e-8);
        for dof in [1.0, 2.5, 7.0, 30.0, 400.0] {
            let t = StudentsT::new(0.0, 1.0, dof).unwrap();
            for x in [0.0, 0.1, 1.0, 3.0, 10.0] {
                let want = 2.0 * t.cdf(-x);
                assert!((student_tails(x, dof) - want).abs() < 1e-9 * want + 1e-13, "{x} {dof}");
            }
        }
        assert!(student_tails(f64::INFINITY, 3.0) <= 0.0 && student_tails(f64::NAN, 3.0) >= 1.0);
    }

    #[test]
    fn intervals_cover_as_often_as_they_say() {
        let mut r = Random::new(3);
        let covered = (0..2000)
            .filter(|_| {
                let values: Vec<f64> = (0..8).map(|_| (0..6).map(|_| r.uniform()).sum::<f64>()).collect();
                let (mean, reach) = mean_interval(&values, 0.05);
                (mean - 3.0).abs() < reach
            })
            .count();
        // 1900, with a standard deviation of 10.
        assert!((1860..=1940).contains(&covered), "{covered}");
        assert!(mean_interval(&[1.0], 0.05).1.is_infinite());
    }

    #[test]
    fn welch_finds_a_shift_and_no_more() {
        let mut r = Random::new(4);
        let mut sample = |n: usize, width: f64, shift: f64| {
            let mut m = Mean::default();
            (0..n).for_each(|_| m.add(shift + width * (r.uniform() - 0.5)));
            m
        };
        let alarms = (0..1000).filter(|_| welch_p(&sample(8, 1.0, 0.0), &sample(6, 5.0, 0.0)) < 0.05).count();
        // 50, with a standard deviation of 7; uniform numbers are not normal.
        assert!((25..=80).contains(&alarms), "{alarms}");
        assert!(welch_p(&sample(8, 1.0, 0.0), &sample(8, 1.0, 3.0)) < 1e-4);
        assert!(welch_p(&sample(8, 0.0, 1.0), &sample(8, 0.0, 2.0)) <= 0.0);
    }
}
