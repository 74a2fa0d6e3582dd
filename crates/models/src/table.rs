//! Tables over evenly spaced nodes, linear between them, looked up in lanes.

use sparrow_math::Real;

/// A place along one axis of a table: a cell and how far into it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<R> {
    cell: R,
    t: R,
    nodes: usize,
}

impl<R: Real> Place<R> {
    /// At `x` among nodes at 0, 1, ... `nodes - 1`; beyond either end the end.
    #[inline(always)]
    pub(crate) fn among(nodes: usize, x: R) -> Self {
        let cell = (x - R::of(0.5)).round().clamp(R::ZERO, R::of((nodes - 2) as f64));
        Place { cell, t: (x - cell).clamp(R::ZERO, R::ONE), nodes }
    }
    /// At `x` of an axis that leads from 0 to 1.
    #[inline(always)]
    pub(crate) fn unit(nodes: usize, x: R) -> Self {
        Place::among(nodes, x * R::of((nodes - 1) as f64))
    }
}

/// Corners of a cell of the largest table: three axes.
const CORNERS: usize = 8;

/// What a table holds at a place; its last axis is contiguous.
#[inline(always)]
pub(crate) fn interpolate<R: Real, const AXES: usize>(values: &[f32], at: [Place<R>; AXES]) -> R {
    const { assert!(1 << AXES <= CORNERS, "a table of more axes needs more corners") };
    let (mut cell, mut strides, mut stride) = (R::ZERO, [0; AXES], 1);
    for axis in (0..AXES).rev() {
        strides[axis] = stride;
        cell = cell + at[axis].cell * R::of(stride as f64);
        stride *= at[axis].nodes;
    }
    let mut corners = [R::ZERO; CORNERS];
    for (k, corner) in corners.iter_mut().enumerate().take(1 << AXES) {
        let mut offset = 0;
        for (axis, stride) in strides.iter().enumerate() {
            offset += (k >> axis & 1) * stride;
        }
        *corner = (cell + R::of(offset as f64)).look_up(values);
    }
    for axis in (0..AXES).rev() {
        for k in 0..1 << axis {
            corners[k] = corners[k].lerp(corners[k | 1 << axis], at[axis].t);
        }
    }
    corners[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_math::Lanes;

    #[test]
    fn linear_functions_are_reproduced_and_ends_hold() {
        let values: Vec<f32> = (0..24).map(|k| (100 * (k / 12) + 10 * (k / 4 % 3) + k % 4) as f32).collect();
        let at = |x: f64, y: f64, z: f64| {
            interpolate(&values, [Place::among(2, x), Place::among(3, y), Place::among(4, z)])
        };
        assert!((at(0.25, 1.5, 2.75) - 42.75).abs() < 1e-9);
        assert!((at(1.0, 2.0, 3.0) - 123.0).abs() < 1e-9);
        assert!((at(-4.0, 7.0, 9.0) - 23.0).abs() < 1e-9);
    }

    #[test]
    fn lanes_look_up_what_scalars_do() {
        let values: Vec<f32> = (0..20u8).map(|k| 1.0 / (f32::from(k) + 0.7)).collect();
        let x = [0.0, 0.01, 0.2, 0.4, 0.5, 0.77, 0.9, 1.0];
        let y = [0.3, 1.0, 0.0, 0.4, 0.9, 0.2, 0.61, 0.11];
        let lanes = interpolate(&values, [Place::unit(4, Lanes::<8>(x)), Place::unit(5, Lanes::<8>(y))]);
        for i in 0..8 {
            let one = interpolate(&values, [Place::unit(4, x[i]), Place::unit(5, y[i])]);
            assert_eq!(lanes.0[i].to_bits(), one.to_bits());
        }
    }
}
