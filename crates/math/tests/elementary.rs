//! The elementary functions against the platform's, in units in the last place.

#![allow(clippy::disallowed_methods, reason = "the platform's functions are the oracle here")]
#![allow(clippy::print_stdout, clippy::type_complexity, reason = "figures for the reader of the test")]

use sparrow_math::{Lanes, Real};

/// Largest error of `ours` against the `f64` oracle over `xs`, in ulp of f32 at the true value.
fn worst_f32(ours: impl Fn(f32) -> f32, truth: impl Fn(f64) -> f64, xs: impl Iterator<Item = f32>) -> f64 {
    xs.map(|x| {
        let t = truth(f64::from(x));
        let ulp = f64::from((t.abs() as f32).max(1e-30)) * f64::from(f32::EPSILON) / 2.0;
        (f64::from(ours(x)) - t).abs() / ulp.max(1e-38)
    })
    .fold(0.0, f64::max)
}

fn steps(a: f64, b: f64, n: usize) -> impl Iterator<Item = f32> {
    (0..n).map(move |i| (a + (b - a) * (i as f64 + 0.37) / n as f64) as f32)
}

fn check(name: &str, err: f64, bound: f64) {
    println!("{name}: {err:.2} ulp (bound {bound})");
    assert!(err <= bound, "{name}: {err} ulp, stated {bound}");
}

#[test]
fn single_precision_keeps_its_stated_errors() {
    check("exp", worst_f32(Real::exp, f64::exp, steps(-80.0, 80.0, 200_000)), 3.0);
    // Around 1 the logarithm passes through zero, where ulps of the result are not attainable.
    check("ln", worst_f32(Real::ln, f64::ln, steps(1e-6, 0.7, 100_000)), 3.0);
    check("ln large", worst_f32(Real::ln, f64::ln, steps(1.5, 1e6, 100_000)), 3.0);
    let abs = |f: fn(f32) -> f32, g: fn(f64) -> f64, xs: Vec<f32>| {
        xs.iter().map(|&x| (f64::from(f(x)) - g(f64::from(x))).abs()).fold(0.0, f64::max)
    };
    let angles: Vec<f32> = steps(-7.0, 7.0, 200_000).collect();
    assert!(abs(Real::sin, f64::sin, angles.clone()) < 1.2e-7);
    assert!(abs(Real::cos, f64::cos, angles) < 1.2e-7);
    check("asin", worst_f32(Real::asin, f64::asin, steps(0.001, 0.9999, 100_000)), 8.0);
    check("atan", worst_f32(|x| Real::atan2(x, 1.0), f64::atan, steps(-50.0, 50.0, 200_000)), 8.0);
}

#[test]
fn the_coarse_exponential_is_as_exact_as_its_argument() {
    for x in steps(-87.0, 87.0, 200_000) {
        let (got, want) = (f64::from(x.exp_coarse()), f64::exp(f64::from(x)));
        let bound = 2e-7 + 1e-7 * f64::from(x.abs());
        assert!((got / want - 1.0).abs() < bound, "{x}: {got} against {want}");
    }
    assert_eq!(0.0_f32.exp_coarse().to_bits(), 1.0_f32.to_bits());
    for x in [-88.5, -1e4, f32::MIN, f32::NEG_INFINITY] {
        assert_eq!(x.exp_coarse().to_bits(), 0, "{x}");
    }
    assert_eq!(0.3_f64.exp_coarse().to_bits(), Real::exp(0.3_f64).to_bits());
}

#[test]
fn double_precision_is_double_precision() {
    let mut worst = [0.0f64; 5];
    for i in 0..200_000 {
        let x = -30.0 + 60.0 * (f64::from(i) + 0.37) / 200_000.0;
        let rel = |a: f64, b: f64| (a - b).abs() / b.abs().max(1e-3);
        let p = x.abs() + 1e-3;
        for (w, e) in worst.iter_mut().zip([
            rel(Real::exp(x), f64::exp(x)),
            rel(Real::ln(p), f64::ln(p)),
            (Real::sin_cos(x).0 - f64::sin(x)).abs(),
            (Real::sin_cos(x).1 - f64::cos(x)).abs(),
            rel(Real::atan2(x, 1.3), f64::atan2(x, 1.3)),
        ]) {
            *w = w.max(e);
        }
    }
    println!("{worst:?}");
    assert!(worst.iter().all(|&w| w < 1e-15), "{worst:?}");
}

#[test]
fn bessel_agrees_with_double_precision() {
    for x in steps(0.0, 60.0, 5000) {
        let (a, b) = (f64::from(x.i0e()), f64::from(x).i0e());
        assert!((a - b).abs() < 2e-6 * b, "{x}: {a} against {b}");
    }
}

#[test]
fn lanes_equal_scalars_bit_for_bit() {
    type L = Lanes<8>;
    for block in 0..2000 {
        let xs: [f32; 8] = core::array::from_fn(|i| ((block * 8 + i) as f32 - 8000.0) * 0.0007 + 0.0001);
        let x = Lanes(xs);
        let cases: [(L, fn(f32) -> f32); 6] = [
            (x.exp(), Real::exp),
            (x.exp_coarse(), Real::exp_coarse),
            (x.abs().ln(), |v| Real::ln(v.abs())),
            (x.sin(), Real::sin),
            (x.cos(), Real::cos),
            (x.atan2(L::of(0.3)), |v| Real::atan2(v, 0.3)),
        ];
        for (lanes, scalar) in cases {
            for (lane, x) in lanes.0.iter().zip(xs) {
                assert_eq!(lane.to_bits(), scalar(x).to_bits(), "at {x}");
            }
        }
    }
}
