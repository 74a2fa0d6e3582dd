//! The colour spaces of FLIP, all with the white of sRGB.

use sparrow_math::Real;

/// XYZ of the primaries of sRGB, in columns, for white (0.3127, 0.3290) of luminance 1. [IEC61966, sec. 5.2]
const XYZ_FROM_RGB: [[f64; 3]; 3] = [
    [0.412_390_799_265_959_3, 0.357_584_339_383_877_96, 0.180_480_788_401_834_35],
    [0.212_639_005_871_510_24, 0.715_168_678_767_755_9, 0.072_192_315_360_733_74],
    [0.019_330_818_715_591_82, 0.119_194_779_794_625_96, 0.950_532_152_249_661],
];
/// Its inverse.
const RGB_FROM_XYZ: [[f64; 3]; 3] = [
    [3.240_969_941_904_522_6, -1.537_383_177_570_094, -0.498_610_760_293_003_43],
    [-0.969_243_636_280_879_8, 1.875_967_501_507_720_6, 0.041_555_057_407_175_605],
    [0.055_630_079_696_993_62, -0.203_976_958_888_976_43, 1.056_971_514_242_878],
];
/// XYZ of white.
const WHITE: [f64; 3] = [0.950_455_927_051_671_6, 1.0, 1.089_057_750_759_878_7];

fn times(m: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// XYZ over that of white.
fn relative_xyz(rgb: [f64; 3]) -> [f64; 3] {
    let xyz = times(&XYZ_FROM_RGB, rgb);
    [0, 1, 2].map(|i| xyz[i] / WHITE[i])
}

/// `Y Cx Cz`, lightness and two opponent colours, linear in `rgb`. [Andersson2020]
pub(super) fn opponent(rgb: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = relative_xyz(rgb);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Linear RGB of `Y Cx Cz`.
pub(super) fn linear_from_opponent([y, cx, cz]: [f64; 3]) -> [f64; 3] {
    let y = (y + 16.0) / 116.0;
    times(&RGB_FROM_XYZ, [WHITE[0] * (y + cx / 500.0), WHITE[1] * y, WHITE[2] * (y - cz / 200.0)])
}

/// CIE L*a*b* of linear RGB, with colours of dark pixels faded after Hunt: `a` and `b` times `0.01 L`. [Andersson2020]
pub(super) fn hunt_lab(rgb: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = relative_xyz(rgb).map(cube_root);
    let l = 116.0 * y - 16.0;
    [l, 0.01 * l * 500.0 * (x - y), 0.01 * l * 200.0 * (y - z)]
}

/// The cube root of CIE L*a*b*, with its tangent below `(6/29)³`. [CIE15, sec. 8.2.1]
fn cube_root(t: f64) -> f64 {
    const DELTA: f64 = 6.0 / 29.0;
    if t > DELTA * DELTA * DELTA { Real::pow(t, 1.0 / 3.0) } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 }
}

/// The distance HyAB: city blocks in lightness, Euclid in colour. [Andersson2020]
pub(super) fn hyab(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [l, a, b] = [0, 1, 2].map(|i| a[i] - b[i]);
    l.abs() + (a * a + b * b).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_white_and_colours_come_back() {
        assert!((opponent([1.0; 3])[0] - 100.0).abs() < 1e-12);
        let lab = hunt_lab([1.0; 3]);
        assert!((lab[0] - 100.0).abs() < 1e-12 && lab[1].abs() + lab[2].abs() < 1e-10, "{lab:?}");
        let rgb = [0.2, 0.7, 0.05];
        let back = linear_from_opponent(opponent(rgb));
        (0..3).for_each(|i| assert!((back[i] - rgb[i]).abs() < 1e-13, "{back:?}"));
        assert!(hunt_lab([0.0; 3]).iter().all(|v| v.abs() < 1e-12));
    }

    #[test]
    fn distances_are_known() {
        assert!((hyab([3.0, 1.0, 2.0], [1.0, 4.0, 6.0]) - 7.0).abs() < 1e-15);
        // The linear part meets the root where they are glued.
        let t = (6.0f64 / 29.0) * (6.0 / 29.0) * (6.0 / 29.0);
        assert!((cube_root(t) - cube_root(t * (1.0 + 1e-12))).abs() < 1e-12);
    }
}
