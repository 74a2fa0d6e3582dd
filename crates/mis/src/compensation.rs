//! Tables that leave to the other technique what it does anyway. [Karlik2019]

/// The best density of a tabulated technique, chosen with probability `chance`, where another has the density `other`:
/// `max(0, f / nu - (1 - chance) other) / chance`, with nu such that it integrates to one. [Karlik2019]
///
/// All slices hold one number a cell; `measure` is that of the cells, `f` what the product of the whole integrand is thought to
/// be, `other` a density over them. Where nothing is bright the other density is returned. Zeros are safe only beside
/// a technique that reaches those cells.
pub fn compensate(f: &[f64], other: &[f64], measure: &[f64], chance: f64) -> Vec<f64> {
    let density = |scale: f64| -> Vec<f64> {
        let cell = |(f, other): (&f64, &f64)| ((scale * f - (1.0 - chance) * other) / chance).max(0.0);
        f.iter().zip(other).map(cell).collect()
    };
    let total = |p: &[f64]| -> f64 { p.iter().zip(measure).map(|(p, m)| p * m).sum() };
    let bright = total(f);
    if !(bright > 0.0 && bright.is_finite() && chance > 0.0) {
        return other.to_vec();
    }
    // The integral grows with 1 / nu, from nothing at zero to at least one at 1 / I.
    let (mut low, mut high) = (0.0, 1.0 / bright);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if total(&density(middle)) < 1.0 { low = middle } else { high = middle }
    }
    density(high)
}

/// `max(0, L - mean)`, scaled to a density: what [`compensate`] comes to where half the samples go to a technique that knows
/// nothing of the light. [Karlik2019]
///
/// A light that is the same everywhere keeps its uniform density.
pub fn sharpen(light: &[f64], measure: &[f64]) -> Vec<f64> {
    let sum = |v: &[f64]| -> f64 { v.iter().zip(measure).map(|(v, m)| v * m).sum() };
    let mean = sum(light) / measure.iter().sum::<f64>();
    let above: Vec<f64> = light.iter().map(|l| (l - mean).max(0.0)).collect();
    // What stands out is rounding where it is so little.
    let (total, all) = (sum(&above), sum(light));
    let (table, total) = if total > 1e-6 * all { (above, total) } else { (light.to_vec(), all) };
    if total > 0.0 { table.iter().map(|v| v / total).collect() } else { table }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mixture_follows_the_integrand_where_it_can() {
        let f = [10.0, 4.0, 1.0, 0.2];
        let (other, measure) = ([1.0; 4], [0.25; 4]);
        let p = compensate(&f, &other, &measure, 0.5);
        let total: f64 = p.iter().map(|p| 0.25 * p).sum();
        assert!((total - 1.0).abs() < 1e-12);
        // Where the table is not zero, its half and the other's together are in proportion to f.
        let mixed: Vec<f64> = p.iter().map(|p| 0.5 * (p + 1.0)).collect();
        assert!((mixed[0] / mixed[1] - 2.5).abs() < 1e-9, "{mixed:?}");
        assert!(p[2] < 1e-12 && p[3] < 1e-12, "{p:?}");
        assert_eq!(compensate(&[0.0; 4], &other, &measure, 0.5), other);
    }

    #[test]
    fn a_uniform_light_stays_uniform() {
        assert!(sharpen(&[3.0; 5], &[0.2; 5]).iter().all(|p| (p - 1.0).abs() < 1e-12));
        assert_eq!(sharpen(&[0.0; 5], &[0.2; 5]), [0.0; 5]);
    }
}
