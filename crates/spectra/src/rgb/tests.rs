#![allow(clippy::float_cmp, reason = "grey spectra and their scale are exact")]

use super::*;
use crate::{matrix, xyz_of};

/// Linear RGB of a reflectance under the illuminant of its space, integrated at every nanometre.
fn rgb_of(s: &Sigmoid, space: ColorSpace) -> [f64; 3] {
    let lit = DenseSpectrum::from_fn(|l| s.value(l)).mul(space.illuminant());
    matrix::apply(&space.conversions().from_xyz, xyz_of(&lit))
}

struct Errors {
    max: f64,
    rms: f64,
    worst: [f32; 3],
}

/// Round trip of a grid of `n`³ colours with components up to `top`.
fn round_trip(n: u16, top: f32, space: ColorSpace, shape: fn([f32; 3], ColorSpace) -> Sigmoid) -> Errors {
    let mut e = Errors { max: 0.0, rms: 0.0, worst: [0.0; 3] };
    for i in 0..n * n * n {
        let rgb = [i / (n * n), i / n % n, i % n].map(|k| top * f32::from(k) / f32::from(n - 1));
        let back = rgb_of(&shape(rgb, space), space);
        for (a, b) in rgb.into_iter().zip(back) {
            let d = (f64::from(a) - b).abs();
            e.rms += d * d;
            if d > e.max {
                (e.max, e.worst) = (d, rgb);
            }
        }
    }
    e.rms = (e.rms / f64::from(3 * n * n * n)).sqrt();
    e
}

#[test]
fn srgb_comes_back_from_the_table() {
    // The figures in the documentation of `rgb_to_sigmoid`; change both.
    for (top, max, rms) in [(1.0, 2.4e-3, 3.1e-4), (0.5, 8.1e-4, 1.6e-4), (0.1, 2.6e-4, 4e-5)] {
        let e = round_trip(14, top, ColorSpace::Srgb, rgb_to_sigmoid);
        assert!(e.max < max && e.rms < rms, "up to {top}: max {:e} at {:?}, rms {:e}", e.max, e.worst, e.rms);
    }
}

#[test]
fn srgb_comes_back_from_the_exact_fit() {
    let e = round_trip(8, 1.0, ColorSpace::Srgb, fit_sigmoid);
    assert!(e.max < 8e-6 && e.rms < 1.2e-6, "max {:e} at {:?}, rms {:e}", e.max, e.worst, e.rms);
}

#[test]
fn wide_spaces_hold_the_srgb_colours() {
    for space in [ColorSpace::DciP3, ColorSpace::Rec2020, ColorSpace::Aces2065_1] {
        let m = ColorSpace::Srgb.to_space(space);
        let mut max = 0.0f64;
        for i in 0..216 {
            let srgb = [i / 36, i / 6 % 6, i % 6].map(|k| 0.02 + 0.15 * k as f32);
            let rgb = m.map(|r| r[0] * srgb[0] + r[1] * srgb[1] + r[2] * srgb[2]);
            let back = rgb_of(&rgb_to_sigmoid(rgb, space), space);
            for (a, b) in rgb.into_iter().zip(back) {
                max = max.max((f64::from(a) - b).abs());
            }
        }
        assert!(max < 8e-3, "{space:?}: {max:e}");
    }
}

#[test]
fn grey_is_constant_and_black_is_black() {
    for space in ColorSpace::ALL {
        for v in [0.0, 0.18, 0.5, 1.0] {
            let s = rgb_to_sigmoid([v; 3], space);
            assert_eq!(s, fit_sigmoid([v; 3], space));
            assert_eq!(s.value(400.0), s.value(700.0));
            assert!((s.value(500.0) - v).abs() <= 1e-7, "{v} {s:?}");
        }
        for role in [RgbRole::Albedo, RgbRole::Unbounded, RgbRole::Illuminant] {
            assert_eq!(rgb_spectrum([0.0; 3], role, space).max_value(), 0.0);
        }
    }
}

#[test]
fn odd_input_stays_within_bounds() {
    let odd = [
        [0.0, 0.0, 1e-30],
        [1e-40, 0.0, 0.0],
        [1e-6, 2e-6, 3e-6],
        [-1.0, 0.5, 2.0],
        [f32::NAN, 1.0, 0.0],
        [f32::INFINITY, f32::NEG_INFINITY, 0.2],
        [1.0, 1.0, 0.999_999_9],
        [1.0, 0.0, 1.0],
    ];
    for rgb in odd {
        for s in [rgb_to_sigmoid(rgb, ColorSpace::Srgb), fit_sigmoid(rgb, ColorSpace::Srgb)] {
            for nm in [360.0, 450.0, 550.0, 650.0, 830.0] {
                assert!((0.0..=1.0).contains(&s.value(nm)), "{rgb:?} at {nm}: {s:?}");
            }
        }
        for role in [RgbRole::Albedo, RgbRole::Unbounded, RgbRole::Illuminant] {
            let v = rgb_spectrum(rgb, role, ColorSpace::Srgb).value(550.0);
            assert!(v.is_finite() && v >= 0.0, "{rgb:?} {role:?}: {v}");
        }
    }
    // Darker than the table's first level, the colour is carried on.
    let dark = rgb_of(&rgb_to_sigmoid([1e-5, 2e-5, 3e-5], ColorSpace::Srgb), ColorSpace::Srgb);
    for (got, want) in dark.into_iter().zip([1e-5, 2e-5, 3e-5]) {
        assert!((got / want - 1.0).abs() < 0.02, "{dark:?}");
    }
}

#[test]
fn roles_scale_as_in_pbrt() {
    let space = ColorSpace::Srgb;
    let w = Wavelengths::sample_visible(0.2);
    // White light is twice the illuminant times one half.
    let light = rgb_spectrum([3.0; 3], RgbRole::Illuminant, space);
    assert_eq!(light.scale, 6.0);
    let expect = space.illuminant().at(&w);
    for i in 0..4 {
        assert!((light.at(&w)[i] / (3.0 * expect[i]) - 1.0).abs() < 1e-6);
    }
    let absorption = rgb_spectrum([5.0, 20.0, 10.0], RgbRole::Unbounded, space);
    assert_eq!((absorption.scale, absorption.illuminant), (40.0, None));
    let lit = absorption.to_dense().mul(space.illuminant());
    let back = matrix::apply(&space.conversions().from_xyz, xyz_of(&lit));
    for (got, want) in back.into_iter().zip([5.0, 20.0, 10.0]) {
        assert!((got - want).abs() < 0.03, "{back:?}");
    }
    let exact = rgb_spectrum_exact([5.0, 20.0, 10.0], RgbRole::Unbounded, space).to_dense();
    let back = matrix::apply(&space.conversions().from_xyz, xyz_of(&exact.mul(space.illuminant())));
    assert!((back[1] - 20.0).abs() < 1e-3, "{back:?}");
    assert_eq!(rgb_spectrum([0.1, 0.2, 0.3], RgbRole::Albedo, space).scale, 1.0);
}

/// Coefficients published with [Jakob2019], computed by the authors' optimiser, with its own quadrature.
#[test]
fn spectra_agree_with_the_authors_table() {
    let root = std::env::var("SPARROW_DATA")
        .unwrap_or_else(|_| concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data").into());
    let Ok(bytes) = std::fs::read(format!("{root}/colour/rgb2spec-srgb-32.coeff")) else {
        println!("skipped: no reference table");
        return;
    };
    let words: Vec<f32> =
        bytes[8..].chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
    let (scale, data) = words.split_at(32);
    let (mut sum, mut worst, mut n) = (0.0, (0.0, [0.0; 3]), 0.0);
    // Every 97th of the brighter entries: a few hundred colours.
    for i in (0..3 * 32 * 32 * 32).step_by(97).filter(|i| (8..28).contains(&(i / 1024 % 32))) {
        let (l, z, y, x) = (i / 32_768, i / 1024 % 32, i / 32 % 32, i % 32);
        let mut rgb = [scale[z]; 3];
        rgb[(l + 1) % 3] *= x as f32 / 31.0;
        rgb[(l + 2) % 3] *= y as f32 / 31.0;
        let theirs = Sigmoid { c: [data[3 * i], data[3 * i + 1], data[3 * i + 2]] };
        let ours = fit_sigmoid(rgb, ColorSpace::Srgb);
        for nm in (400..=700).step_by(10) {
            let d = (ours.value(nm as f32) - theirs.value(nm as f32)).abs();
            sum += d;
            n += 1.0;
            if d > worst.0 {
                worst = (d, rgb);
            }
        }
    }
    assert!(sum / n < 3e-4 && worst.0 < 0.02, "mean difference {}, worst {worst:?}", sum / n);
}
