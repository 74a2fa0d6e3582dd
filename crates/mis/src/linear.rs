//! Small symmetric systems: [`solve`].

/// Rotations after which a matrix counts as diagonal; a handful of rows needs a handful of sweeps.
const SWEEPS: usize = 60;

/// The shortest `x` that makes `|A x - b|` least, for a symmetric matrix `a` of `b.len()` rows: its eigenvalues below `tiny` times
/// the largest count as zero.
///
/// By Jacobi's rotations. [GolubVanLoan2013, sec. 8.5]
pub(crate) fn solve(a: &[f64], b: &[f64], tiny: f64) -> Vec<f64> {
    let n = b.len();
    let mut a = a.to_vec();
    // Columns are eigenvectors.
    let mut v = vec![0.0; n * n];
    for i in 0..n {
        v[i * n + i] = 1.0;
    }
    for _ in 0..SWEEPS {
        for p in 0..n {
            for q in p + 1..n {
                rotate(&mut a, &mut v, n, p, q);
            }
        }
    }
    let largest = (0..n).fold(0.0, |m: f64, i| m.max(a[i * n + i].abs()));
    let mut x = vec![0.0; n];
    for k in 0..n {
        let value = a[k * n + k];
        if value.abs() > tiny * largest {
            let along: f64 = (0..n).map(|i| v[i * n + k] * b[i]).sum();
            for i in 0..n {
                x[i] += v[i * n + k] * along / value;
            }
        }
    }
    x
}

/// Makes `a[p][q]` zero by a rotation of both axes.
fn rotate(a: &mut [f64], v: &mut [f64], n: usize, p: usize, q: usize) {
    let off = a[p * n + q];
    if off.abs() < f64::MIN_POSITIVE {
        return;
    }
    let theta = (a[q * n + q] - a[p * n + p]) / (2.0 * off);
    let t = 1.0f64.copysign(theta) / (theta.abs() + (theta * theta + 1.0).sqrt());
    let c = 1.0 / (t * t + 1.0).sqrt();
    let s = t * c;
    let turn = |m: &mut [f64], i: usize, j: usize| {
        let (x, y) = (m[i], m[j]);
        (m[i], m[j]) = (c * x - s * y, s * x + c * y);
    };
    for k in 0..n {
        turn(a, k * n + p, k * n + q);
    }
    for k in 0..n {
        turn(a, p * n + k, q * n + k);
        turn(v, k * n + p, k * n + q);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regular_systems_are_solved_and_singular_ones_shortest() {
        let a = [4.0, 1.0, -2.0, 1.0, 3.0, 0.5, -2.0, 0.5, 5.0];
        let want = [1.0, -2.0, 0.25];
        let b: Vec<f64> = (0..3).map(|i| (0..3).map(|j| a[3 * i + j] * want[j]).sum()).collect();
        for (x, w) in solve(&a, &b, 1e-12).iter().zip(want) {
            assert!((x - w).abs() < 1e-12, "{x} {w}");
        }
        // Two equal techniques share what one would take.
        let x = solve(&[2.0, 2.0, 2.0, 2.0], &[1.0, 1.0], 1e-9);
        assert!((x[0] - 0.25).abs() < 1e-12 && (x[1] - 0.25).abs() < 1e-12, "{x:?}");
        assert_eq!(solve(&[0.0; 4], &[0.0; 2], 1e-9), [0.0; 2]);
    }
}
