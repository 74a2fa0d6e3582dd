//! The highest point of a sampled curve: [`peak`].

/// Place and height of the maximum of `points`, which stand at equal steps, by the parabola through the highest three; none where the
/// highest is the first or the last.
pub(crate) fn peak(points: &[[f64; 2]]) -> Option<[f64; 2]> {
    let (i, _) = points.iter().enumerate().max_by(|a, b| a.1[1].total_cmp(&b.1[1]))?;
    if i == 0 || i + 1 >= points.len() {
        return None;
    }
    let [a, b, c] = [points[i - 1], points[i], points[i + 1]];
    let (slope, bend) = (0.5 * (c[1] - a[1]), a[1] - 2.0 * b[1] + c[1]);
    // A plateau has its peak where it begins.
    let t = if bend < 0.0 { -slope / bend } else { 0.0 };
    Some([b[0] + t * 0.5 * (c[0] - a[0]), b[1] + 0.5 * slope * t])
}

/// Each value as the mean of itself and `radius` neighbours on either side, fewer at the ends.
pub(crate) fn smoothed(points: &[[f64; 2]], radius: usize) -> Vec<[f64; 2]> {
    let mean = |i: usize| {
        let part = &points[i.saturating_sub(radius)..(i + radius + 1).min(points.len())];
        [points[i][0], part.iter().map(|p| p[1]).sum::<f64>() / part.len() as f64]
    };
    (0..points.len()).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_has_its_peak_between_the_samples() {
        let points: Vec<[f64; 2]> =
            (0..9).map(|k| f64::from(k) * 0.5).map(|x| [x, 3.0 - (x - 1.87).powi(2)]).collect();
        let [x, y] = peak(&points).unwrap();
        assert!((x - 1.87).abs() < 1e-12 && (y - 3.0).abs() < 1e-12);
        assert!(peak(&points[..3]).is_none(), "it rises to its end");
    }

    #[test]
    fn smoothing_keeps_a_line() {
        let line: Vec<[f64; 2]> = (0..7).map(|k| [f64::from(k), 2.0 * f64::from(k)]).collect();
        assert!(smoothed(&line, 1)[1..6].iter().zip(&line[1..6]).all(|(a, b)| (a[1] - b[1]).abs() < 1e-12));
    }
}
