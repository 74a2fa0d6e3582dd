//! Against NVIDIA's `flip-evaluator` 1.7, for pictures that a line of arithmetic makes.

use super::*;
use crate::metrics::tests::{WIDTH, pictures};

fn mean(map: &[f64]) -> f64 {
    map.iter().sum::<f64>() / map.len() as f64
}

/// The evaluator works in single precision: 1e-4 at a pixel, where a root takes the difference of two gradients, and 1e-5 of
/// the mean.
fn agrees(map: &[f64], want_mean: f64, want_at: [f64; 4]) {
    assert!((mean(map) - want_mean).abs() < 1e-5, "{} against {want_mean}", mean(map));
    for ([x, y], want) in [[0, 0], [24, 12], [40, 20], [47, 35]].into_iter().zip(want_at) {
        let got = map[y * WIDTH + x];
        assert!((got - want).abs() < 1e-4, "at {x}, {y}: {got} against {want}");
    }
}

#[test]
fn ldr_flip_agrees_with_the_evaluator() {
    let [p, r] = pictures();
    let map = flip_map(&Pair::new(WIDTH, &p, &r).unwrap());
    agrees(&map, 0.265_324_3, [0.489_069_7, 0.238_896_6, 0.444_046_8, 0.445_980_5]);
}

#[test]
fn hdr_flip_agrees_with_the_evaluator() {
    let [p, r] = pictures();
    let map = flip_hdr_map(&Pair::new(WIDTH, &p, &r).unwrap());
    agrees(&map, 0.384_571_0, [0.686_798_4, 0.403_458_8, 0.606_647_4, 0.436_023_4]);
}

#[test]
fn equal_pictures_do_not_differ_and_opposite_ones_do() {
    let [_, r] = pictures();
    for map in [flip_map, flip_hdr_map] {
        assert!(map(&Pair::new(WIDTH, &r, &r).unwrap()).iter().all(|e| *e <= 0.0));
    }
    let (green, blue) = (vec![[0.0, 1.0, 0.0]; 64], vec![[0.0, 0.0, 1.0]; 64]);
    let most = flip_map(&Pair::new(8, &green, &blue).unwrap());
    assert!(most.iter().all(|e| (e - 1.0).abs() < 1e-9), "the largest colour difference is 1");
}

#[test]
fn a_nan_is_not_hidden() {
    let [p, mut r] = pictures();
    r[100] = [f32::NAN; 3];
    for map in [flip_map, flip_hdr_map] {
        assert!(map(&Pair::new(WIDTH, &p, &r).unwrap())[100].is_nan());
    }
}
