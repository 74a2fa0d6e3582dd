//! Where a function over a picture is zero: [`contour`].

/// Two points in pixels from the top left corner.
pub(crate) type Segment = [[f64; 2]; 2];

/// The zeros of `f`, which takes places in pixels, over a picture of `size`: marching squares between the middles of pixels. Cells in
/// which `f` is not defined everywhere are left out.
pub(crate) fn contour(size: [usize; 2], f: impl Fn([f64; 2]) -> Option<f64>) -> Vec<Segment> {
    let [w, h] = size;
    let middle = |x: usize, y: usize| [x as f64 + 0.5, y as f64 + 0.5];
    let values: Vec<Option<f64>> = (0..w * h).map(|i| f(middle(i % w, i / w))).collect();
    let corner = |x: usize, y: usize| values[y * w + x].map(|v| (middle(x, y), v));
    let mut segments = Vec::new();
    for y in 1..h {
        for x in 1..w {
            let corners = [corner(x - 1, y - 1), corner(x, y - 1), corner(x, y), corner(x - 1, y)];
            let [Some(a), Some(b), Some(c), Some(d)] = corners else { continue };
            let ends: Vec<[f64; 2]> =
                [(a, b), (b, c), (c, d), (d, a)].into_iter().filter_map(|(p, q)| crossing(p, q)).collect();
            // Two sides are crossed, or all four of a saddle.
            segments.extend(ends.chunks_exact(2).map(|e| [e[0], e[1]]));
        }
    }
    segments
}

/// Where a side is crossed, between values of different sign.
fn crossing((p, a): ([f64; 2], f64), (q, b): ([f64; 2], f64)) -> Option<[f64; 2]> {
    let t = a / (a - b);
    ((a < 0.0) != (b < 0.0)).then(|| [p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_is_found_where_it_is() {
        let segments = contour([40, 30], |[x, y]| Some((x - 20.0).hypot(y - 14.0) - 9.3));
        let length: f64 = segments.iter().map(|[a, b]| (a[0] - b[0]).hypot(a[1] - b[1])).sum();
        assert!((length - core::f64::consts::TAU * 9.3).abs() < 0.3, "its length is {length}");
        for [x, y] in segments.iter().flatten() {
            assert!(((x - 20.0).hypot(y - 14.0) - 9.3).abs() < 0.03);
        }
    }

    #[test]
    fn nothing_is_found_where_the_function_is_not_defined() {
        assert!(contour([9, 9], |[x, _]| (x < 3.0).then_some(x - 5.0)).is_empty());
    }
}
