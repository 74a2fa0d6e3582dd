//! The shape of a bright patch by its second moments: [`Moments`].

use sparrow_math::Real;

/// Second moments of a bright patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moments {
    /// Its length over its width: the root of the ratio of the moments' eigenvalues, 1 or more.
    pub(crate) aspect: f64,
    /// Direction of its length, in degrees from the horizontal, in [0, 180).
    pub(crate) direction_deg: f64,
}

impl Moments {
    /// Of places with their brightness; none where all is dark or on one spot.
    pub(crate) fn of(places: impl Iterator<Item = ([f64; 2], f64)> + Clone) -> Option<Moments> {
        let sum: f64 = places.clone().map(|(_, w)| w).sum();
        let mean = |k: usize| places.clone().map(|(p, w)| p[k] * w).sum::<f64>() / sum;
        let (x, y) = (mean(0), mean(1));
        let moment =
            |f: &dyn Fn(f64, f64) -> f64| places.clone().map(|(p, w)| f(p[0] - x, p[1] - y) * w).sum::<f64>();
        let (xx, xy, yy) = (moment(&|x, _| x * x), moment(&|x, y| x * y), moment(&|_, y| y * y));
        let (half, root) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        let direction = 0.5 * Real::atan2(xy, 0.5 * (xx - yy));
        (half > root).then(|| Moments {
            aspect: ((half + root) / (half - root)).sqrt(),
            direction_deg: direction.to_degrees().rem_euclid(180.0),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slanted_bell_shows_its_axes() {
        let (s, c) = Real::sin_cos(30f64.to_radians());
        let places =
            (-60..=60).flat_map(|i| (-60..=60).map(move |j| (f64::from(i), f64::from(j)))).map(|(x, y)| {
                let (u, v) = (c * x + s * y, c * y - s * x);
                ([x, y], Real::exp(-0.5 * ((u / 12.0).powi(2) + (v / 4.0).powi(2))))
            });
        let m = Moments::of(places).unwrap();
        assert!((m.aspect - 3.0).abs() < 1e-3 && (m.direction_deg - 30.0).abs() < 1e-2, "{m:?}");
        assert!(Moments::of(core::iter::empty()).is_none());
    }
}
