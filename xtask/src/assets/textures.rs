//! Images that tile.

use sparrow_math::Real;

use super::Colour;

/// File name, width and height, colours.
pub(super) const ALL: [(&str, u32, Colour); 3] =
    [("bricks.png", 128, bricks), ("glaze.png", 192, glaze), ("wear.png", 128, wear)];

/// Four courses of two bricks, every other one shifted by half a brick.
fn bricks(x: u32, y: u32) -> [u8; 3] {
    const MORTAR: u32 = 3;
    let (w, h) = (64, 32);
    let course = y / h;
    let x = (x + course % 2 * w / 2) % 128;
    let grain = hash(x, y, 1) % 4 * 5;
    if y % h < MORTAR || x % w < MORTAR {
        return [176, 170, 160].map(|c: u32| (c + grain) as u8);
    }
    let tone = hash(x / w, course, 2) % 48;
    [128 + tone, 62 + tone / 2, 46 + tone / 3].map(|c| (c + grain) as u8)
}

/// White porcelain with blue bands and a row of leaves between them.
fn glaze(x: u32, y: u32) -> [u8; 3] {
    let (u, v) = (f64::from(x) / 192.0, f64::from(y) / 192.0);
    let band = |at: f64, width: f64| (v - at).abs() < width;
    let leaf = {
        let along = (u * 4.0).fract() - 0.5;
        let lean = (v - 0.5) * 0.8;
        (v - 0.5).abs() < 0.2 && (along - lean).abs() < 0.22 * (1.0 - ((v - 0.5) / 0.2).sqr())
    };
    if band(0.14, 0.035) || band(0.86, 0.035) || leaf {
        [28, 56, 128]
    } else if band(0.215, 0.008) || band(0.785, 0.008) {
        [176, 58, 40]
    } else {
        [232, 230, 222]
    }
}

/// Polished ground with dull blotches: three octaves of smooth noise, made steep.
fn wear(x: u32, y: u32) -> [u8; 3] {
    let noise: f64 =
        [(4, 0.55), (8, 0.3), (16, 0.15)].iter().map(|&(cells, weight)| weight * smooth(x, y, cells)).sum();
    let t = ((noise - 0.4) / 0.2).clamp(0.0, 1.0);
    // 64 levels keep the file small.
    let level = (t * t * (3.0 - 2.0 * t) * 63.0).round() as u8;
    [24 + 2 * level; 3]
}

/// Random numbers in [0, 1] on a grid of `cells` by `cells`, interpolated over 128 pixels.
fn smooth(x: u32, y: u32, cells: u32) -> f64 {
    let step = 128 / cells;
    let corner = |i: u32, j: u32| f64::from(hash(i % cells, j % cells, cells) % 1024) / 1023.0;
    let fade = |p: u32| {
        let t = f64::from(p % step) / f64::from(step);
        t * t * (3.0 - 2.0 * t)
    };
    let (i, j, s, t) = (x / step, y / step, fade(x), fade(y));
    let top = corner(i, j).lerp(corner(i + 1, j), s);
    top.lerp(corner(i, j + 1).lerp(corner(i + 1, j + 1), s), t)
}

/// Well mixed bits of three numbers.
fn hash(x: u32, y: u32, seed: u32) -> u32 {
    let mut h = x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77) ^ seed.wrapping_mul(0xC2B2_AE3D);
    h = (h ^ (h >> 15)).wrapping_mul(0x2C1B_3C6D);
    h = (h ^ (h >> 12)).wrapping_mul(0x297A_2D39);
    h ^ (h >> 15)
}
