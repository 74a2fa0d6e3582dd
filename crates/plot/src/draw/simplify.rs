//! Lines with fewer points: [`simplify`].

use super::svg::Point;

/// The points of a line that matter: leaving the others out moves it by at most `tolerance`. [DouglasPeucker1973]
pub fn simplify(points: &[Point], tolerance: f64) -> Vec<Point> {
    let mut keep = vec![false; points.len()];
    let mut open = Vec::new();
    if let Some(last) = points.len().checked_sub(1) {
        keep[0] = true;
        keep[last] = true;
        open.push((0, last));
    }
    while let Some((a, b)) = open.pop() {
        let worst = (a + 1..b).map(|i| (distance(points[i], points[a], points[b]), i));
        if let Some((d, i)) = worst.max_by(|x, y| x.0.total_cmp(&y.0))
            && d > tolerance
        {
            keep[i] = true;
            open.push((a, i));
            open.push((i, b));
        }
    }
    points.iter().zip(keep).filter(|(_, k)| *k).map(|(p, _)| *p).collect()
}

/// From `p` to the stretch from `a` to `b`.
fn distance(p: Point, a: Point, b: Point) -> f64 {
    let (d, q) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let len2 = d[0] * d[0] + d[1] * d[1];
    let t = if len2 > 0.0 { ((q[0] * d[0] + q[1] * d[1]) / len2).clamp(0.0, 1.0) } else { 0.0 };
    let [x, y] = [q[0] - t * d[0], q[1] - t * d[1]];
    (x * x + y * y).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_stay_and_the_rest_goes() {
        let line: Vec<Point> = (0..=20).map(|i| [f64::from(i), (f64::from(i) - 10.0).abs()]).collect();
        assert_eq!(simplify(&line, 0.01), [[0.0, 10.0], [10.0, 0.0], [20.0, 10.0]]);
        assert_eq!(simplify(&[], 1.0).len(), 0);
        assert_eq!(simplify(&[[1.0, 1.0]], 1.0).len(), 1);
    }
}
