//! Scalar code within lanes: [`per_lane`].

use sparrow_math::{MAX_WIDTH, Real};

/// `f` of the numbers of every lane in turn.
#[inline(always)]
pub(crate) fn per_lane<R: Real, const N: usize, const M: usize>(
    x: [R; N],
    f: impl Fn([f64; N]) -> [f64; M],
) -> [R; M] {
    let (mut columns, mut results) = ([[0.0; MAX_WIDTH]; N], [[0.0; MAX_WIDTH]; M]);
    for (column, x) in columns.iter_mut().zip(x) {
        *column = x.to_doubles();
    }
    for lane in 0..R::WIDTH {
        let mut arguments = [0.0; N];
        for (argument, column) in arguments.iter_mut().zip(&columns) {
            *argument = column[lane];
        }
        for (result, value) in results.iter_mut().zip(f(arguments)) {
            result[lane] = value;
        }
    }
    let mut out = [R::ZERO; M];
    for (out, result) in out.iter_mut().zip(&results) {
        *out = R::from_doubles(result);
    }
    out
}
