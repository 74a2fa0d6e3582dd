//! Look-ups against sums written out.

use sparrow_image::{Encoding, Image, Pixels};
use sparrow_math::Real;
use sparrow_scene::{Mapping, Span, TextureEncoding, TextureFilter, WrapMode};

use super::texels::Texels;
use super::*;
use crate::integrator::Column;

const WRAPS: [WrapMode; 4] = [WrapMode::Repeat, WrapMode::Black, WrapMode::Clamp, WrapMode::Octahedral];

fn image(w: usize, h: usize) -> Image {
    let codes = (0..w * h * 3).map(|i| (i * i * 31 + i * 7) as u8).collect();
    Image::new(w, h, ["R", "G", "B"].map(str::to_owned).to_vec(), Pixels::U8(codes), Encoding::Srgb)
        .expect("an image")
}

fn texture(image: &Image, filter: TextureFilter, wrap: WrapMode) -> ImageTexture {
    let map = ImageMap {
        path: PathBuf::new(),
        filter,
        wrap,
        max_anisotropy: 8.0,
        scale: 0.7,
        invert: true,
        encoding: TextureEncoding::Default,
        mapping: Mapping::Uv { scale: [1.3, 2.1], delta: [0.4, -0.2] },
        at: Span::default(),
    };
    ImageTexture::new(&map, Arc::new(Pyramid::new(Texels::new(image, None), Pyramid::is_asked_for(filter))))
}

/// Points in and around the image, with footprints from nothing to all of it.
fn contexts(n: usize) -> Vec<TextureContext> {
    let part = |k: usize, step: f32| (k as f32 * step).fract();
    let context = |k: usize| {
        let width = if k.is_multiple_of(5) { 0.0 } else { Real::exp(-7.0 * part(k, 0.377)) };
        TextureContext {
            uv: [4.0 * part(k, 0.618_034) - 2.0, 4.0 * part(k, 0.754_878) - 2.0],
            duv: [[width, 0.3 * width], [-0.2 * width, 0.5 * width]],
            ..TextureContext::default()
        }
    };
    (0..n).map(context).collect()
}

#[test]
fn lanes_give_the_bits_of_single_points() {
    let image = image(13, 6);
    for filter in
        [TextureFilter::Point, TextureFilter::Bilinear, TextureFilter::Trilinear, TextureFilter::Ewa]
    {
        for wrap in WRAPS {
            let texture = texture(&image, filter, wrap);
            for n in [1, 7, 8, 203] {
                let (contexts, mut rgb) = (contexts(n), [Column::default(); 3]);
                texture.rgb_many(&contexts, &mut rgb);
                for (k, ctx) in contexts.iter().enumerate() {
                    let many = rgb.each_ref().map(|c| c[k].to_bits());
                    assert_eq!(many, texture.rgb(ctx).map(f32::to_bits), "{filter:?} {wrap:?} {k} of {n}");
                }
            }
        }
    }
}

#[test]
fn bilinear_is_the_mean_of_four_by_area() {
    let image = image(13, 6);
    let texture = texture(&image, TextureFilter::Bilinear, WrapMode::Repeat);
    for ctx in contexts(100) {
        let x = f64::from(ctx.uv[0] * 1.3 + 0.4) * 13.0 - 0.5;
        let y = (1.0 - f64::from(ctx.uv[1] * 2.1 - 0.2)) * 6.0 - 0.5;
        let texel = |dx: i64, dy: i64| {
            let (x, y) = (x.floor() as i64 + dx, y.floor() as i64 + dy);
            image.rgb(x.rem_euclid(13) as usize, y.rem_euclid(6) as usize).map(f64::from)
        };
        let (u, v) = (x - x.floor(), y - y.floor());
        for (c, found) in texture.rgb(&ctx).into_iter().enumerate() {
            let below = texel(0, 0)[c] * (1.0 - u) + texel(1, 0)[c] * u;
            let above = texel(0, 1)[c] * (1.0 - u) + texel(1, 1)[c] * u;
            let expected = 1.0 - 0.7 * (below * (1.0 - v) + above * v);
            // A place in single precision is off by 2e-6 of a texel, whose neighbours differ by at most one.
            assert!((f64::from(found) - expected).abs() < 2e-5, "{ctx:?}: {found} {expected}");
        }
    }
}

#[test]
fn a_footprint_of_everything_sees_the_mean() {
    let image = image(16, 16);
    let mean: f32 = image.to_rgb().iter().map(|t| t[1]).sum::<f32>() / 256.0;
    for filter in [TextureFilter::Trilinear, TextureFilter::Ewa] {
        let texture = texture(&image, filter, WrapMode::Repeat);
        let ctx = TextureContext { duv: [[9.0, 0.0], [0.0, 9.0]], ..TextureContext::default() };
        // Four levels of means, each rounded to 2^-16.
        assert!((texture.rgb(&ctx)[1] - (1.0 - 0.7 * mean)).abs() < 4e-5, "{filter:?}");
    }
}

#[test]
fn colours_of_another_space_are_brought_over_once() {
    let image = image(8, 8);
    let matrix = ColorSpace::Rec2020.to_space(ColorSpace::Srgb);
    let converted = Pyramid::new(Texels::new(&image, Some(&matrix)), true);
    let plain = Pyramid::new(Texels::new(&image, None), true);
    for (x, y) in (0..8).flat_map(|y| (0..8).map(move |x| (x, y))) {
        let at = |p: &Pyramid| p.texel(0, x, y, WrapMode::Clamp);
        let expected = crate::colour::converted(at(&plain), ColorSpace::Rec2020, ColorSpace::Srgb);
        for (c, e) in at(&converted).into_iter().zip(expected) {
            // Half floats have eleven places.
            assert!((c - e).abs() <= e.abs() * (1.0 / 2048.0) + 1e-7, "{c} {e}");
        }
    }
    // Blocks of the four levels: 4, 1, 1, 1. Half floats, against bytes and their means in 16 bits.
    assert_eq!((converted.bytes(), plain.bytes()), (7 * 16 * 6, 4 * 16 * 3 + 3 * 16 * 6));
}

#[test]
fn places_far_outside_are_places_inside() {
    let image = image(5, 3);
    for wrap in WRAPS {
        for filter in [TextureFilter::Bilinear, TextureFilter::Trilinear] {
            let texture = texture(&image, filter, wrap);
            for far in [1e9, -1e9, 1e30, -1e30, f32::MAX] {
                let ctx = TextureContext { uv: [far, -far], ..TextureContext::default() };
                assert!(texture.rgb(&ctx).iter().all(|v| v.is_finite()), "{filter:?} {wrap:?} {far}");
            }
        }
    }
}
