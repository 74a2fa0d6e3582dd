//! The circle that fits points best: [`Circle`].

/// A circle in a plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle {
    /// Its middle.
    pub(crate) centre: [f64; 2],
    /// Its radius.
    pub(crate) radius: f64,
}

impl Circle {
    /// The least squares of `x^2 + y^2 - 2 a x - 2 b y - c`, which is linear in a, b and c; none for points on a line.
    pub(crate) fn fit(points: &[[f64; 2]]) -> Option<Circle> {
        let n = points.len() as f64;
        let mean = |f: &dyn Fn(f64, f64) -> f64| points.iter().map(|p| f(p[0], p[1])).sum::<f64>() / n;
        let (x0, y0) = (mean(&|x, _| x), mean(&|_, y| y));
        // About the mean of the points, where c falls out of the other two equations.
        let about = |f: &dyn Fn(f64, f64) -> f64| mean(&|x, y| f(x - x0, y - y0));
        let (xx, xy, yy) = (about(&|x, _| x * x), about(&|x, y| x * y), about(&|_, y| y * y));
        let (xz, yz) = (about(&|x, y| x * (x * x + y * y)), about(&|x, y| y * (x * x + y * y)));
        let det = xx * yy - xy * xy;
        let (a, b) = ((0.5 * xz * yy - 0.5 * yz * xy) / det, (0.5 * yz * xx - 0.5 * xz * xy) / det);
        let radius = (a * a + b * b + xx + yy).sqrt();
        (radius.is_finite() && det > 0.0).then_some(Circle { centre: [x0 + a, y0 + b], radius })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_math::Real;

    #[test]
    fn an_arc_gives_its_circle() {
        let arc: Vec<[f64; 2]> = (0..20)
            .map(|k| Real::sin_cos(0.1 * f64::from(k)))
            .map(|(s, c)| [2.0 + 3.0 * c, -1.0 + 3.0 * s])
            .collect();
        let Circle { centre: [x, y], radius } = Circle::fit(&arc).unwrap();
        assert!((x - 2.0).abs() < 1e-9 && (y + 1.0).abs() < 1e-9 && (radius - 3.0).abs() < 1e-9);
        assert!(Circle::fit(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]).is_none());
    }
}
