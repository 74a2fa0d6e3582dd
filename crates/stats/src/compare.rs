//! Numbers that ought to be equal: [`Departure`], [`consistency`], [`reciprocity`].

use sparrow_math::LocalDir;

/// The pair of numbers that lay farthest apart, in units of what is allowed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Departure {
    /// Difference over allowance; above 1 the numbers count as different.
    pub worst: f64,
    /// Place of the pair; none where there was none, or all were equal.
    pub at: Option<usize>,
}

impl Departure {
    /// Takes the pair at place `i`. What is not finite is infinitely far from everything.
    pub fn add(&mut self, i: usize, a: f64, b: f64, allowed: f64) {
        let d = (a - b).abs();
        let d = if d <= 0.0 { 0.0 } else { d / allowed };
        let d = if d.is_nan() { f64::INFINITY } else { d };
        if d > self.worst {
            *self = Departure { worst: d, at: Some(i) };
        }
    }
    /// All pairs are equal within what is allowed.
    pub fn holds(&self) -> bool {
        self.worst <= 1.0
    }
}

/// Weights of samples against value over density, `(weight, f_cos, pdf)`, with a relative tolerance.
///
/// Written as `weight * pdf = f_cos`, which is defined where the density is zero.
pub fn consistency(samples: impl IntoIterator<Item = (f64, f64, f64)>, tolerance: f64) -> Departure {
    let mut d = Departure::default();
    for (i, (weight, f_cos, pdf)) in samples.into_iter().enumerate() {
        let lhs = weight * pdf;
        d.add(i, lhs, f_cos, tolerance * lhs.abs().max(f_cos.abs()));
    }
    d
}

/// `scale(o, i) f(o, i)` against `f(i, o)`, with a relative tolerance; `scale` is the squared index that transmission
/// crosses, 1 for reflection.
pub fn reciprocity(
    pairs: impl IntoIterator<Item = (LocalDir<f64>, LocalDir<f64>)>,
    f: impl Fn(LocalDir<f64>, LocalDir<f64>) -> f64,
    scale: impl Fn(LocalDir<f64>, LocalDir<f64>) -> f64,
    tolerance: f64,
) -> Departure {
    let mut d = Departure::default();
    for (n, (o, i)) in pairs.into_iter().enumerate() {
        let (a, b) = (scale(o, i) * f(o, i), f(i, o));
        d.add(n, a, b, tolerance * a.abs().max(b.abs()));
    }
    d
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Random;

    #[test]
    fn a_cosine_on_one_side_is_no_reciprocity() {
        let mut r = Random::new(2);
        let pairs: Vec<_> = (0..50).map(|_| (r.direction(), r.direction())).collect();
        let one = |_, _| 1.0;
        let fair = |o: LocalDir<f64>, i: LocalDir<f64>| o.z() * i.z() + o.dot(i);
        assert!(reciprocity(pairs.clone(), fair, one, 1e-12).holds());
        assert!(!reciprocity(pairs, |o: LocalDir<f64>, _| o.z().abs(), one, 0.01).holds());
    }

    #[test]
    fn weights_are_value_over_density() {
        assert!(consistency([(2.0, 1.0, 0.5), (0.0, 0.0, 0.3)], 1e-12).holds());
        let d = consistency([(2.0, 1.0, 0.5), (2.0, 1.1, 0.5)], 1e-2);
        assert!(!d.holds() && d.at == Some(1));
        assert!(!consistency([(f64::NAN, 1.0, 0.5)], 1e-2).holds());
    }
}
