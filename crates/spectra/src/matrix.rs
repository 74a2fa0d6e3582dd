//! 3 by 3 matrices in double precision, as colour conversion needs them.

/// Rows of a 3 by 3 matrix.
pub(crate) type Mat3 = [[f64; 3]; 3];

pub(crate) const IDENTITY: Mat3 = diagonal([1.0; 3]);

pub(crate) const fn diagonal(d: [f64; 3]) -> Mat3 {
    [[d[0], 0.0, 0.0], [0.0, d[1], 0.0], [0.0, 0.0, d[2]]]
}

pub(crate) fn apply(m: &Mat3, v: [f64; 3]) -> [f64; 3] {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

pub(crate) fn product(a: &Mat3, b: &Mat3) -> Mat3 {
    a.map(|row| [0, 1, 2].map(|j| row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j]))
}

pub(crate) fn transpose(m: &Mat3) -> Mat3 {
    [0, 1, 2].map(|j| [m[0][j], m[1][j], m[2][j]])
}

/// The inverse by cofactors; `None` where the determinant is zero or not finite.
pub(crate) fn inverse(m: &Mat3) -> Option<Mat3> {
    let minor = |r: usize, c: usize| {
        let (r1, r2, c1, c2) = ((r + 1) % 3, (r + 2) % 3, (c + 1) % 3, (c + 2) % 3);
        m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1]
    };
    let det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
    if !det.is_normal() {
        return None;
    }
    Some([0, 1, 2].map(|i| [0, 1, 2].map(|j| minor(j, i) / det)))
}

/// The same matrix in single precision.
pub(crate) fn to_f32(m: &Mat3) -> [[f32; 3]; 3] {
    m.map(|row| row.map(|v| v as f32))
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "these values are exact")]
mod tests {
    use super::*;

    #[test]
    fn inverse_undoes() {
        let m = [[2.0, 1.0, 0.5], [-1.0, 3.0, 0.25], [0.0, 0.5, 4.0]];
        let p = product(&m, &inverse(&m).unwrap());
        for i in 0..3 {
            for j in 0..3 {
                assert!((p[i][j] - IDENTITY[i][j]).abs() < 1e-14, "{p:?}");
            }
        }
        assert!(inverse(&[[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [0.0, 1.0, 1.0]]).is_none());
        assert_eq!(apply(&m, [1.0, 0.0, 0.0]), [2.0, -1.0, 0.0]);
        assert_eq!(transpose(&m)[0], [2.0, -1.0, 0.0]);
    }
}
