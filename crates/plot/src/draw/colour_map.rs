//! A perceptual colour map: equal steps of a value are about equal steps of lightness.

/// The map viridis at sixteen places [SmithWalt2015]: from dark violet over green to yellow. Its lightness grows
/// evenly, and it reads the same with any kind of colour vision, and in grey.
const VIRIDIS: [[u8; 3]; 16] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x1a, 0x6c],
    [0x47, 0x2f, 0x7d],
    [0x41, 0x44, 0x87],
    [0x39, 0x56, 0x8c],
    [0x31, 0x68, 0x8e],
    [0x2a, 0x78, 0x8e],
    [0x23, 0x88, 0x8e],
    [0x1f, 0x98, 0x8b],
    [0x22, 0xa8, 0x84],
    [0x35, 0xb7, 0x79],
    [0x54, 0xc5, 0x68],
    [0x7a, 0xd1, 0x51],
    [0xa5, 0xdb, 0x36],
    [0xd2, 0xe2, 0x1b],
    [0xfd, 0xe7, 0x25],
];

/// The colour at `t` in 0..1, as red, green and blue in 0..255; what lies outside gets the colour of the nearer end.
pub fn rgb(t: f64) -> [f64; 3] {
    let last = VIRIDIS.len() - 1;
    let x = t.clamp(0.0, 1.0) * last as f64;
    let i = (x as usize).min(last - 1);
    let u = x - i as f64;
    core::array::from_fn(|c| (1.0 - u) * f64::from(VIRIDIS[i][c]) + u * f64::from(VIRIDIS[i + 1][c]))
}

/// `#rrggbb`, each component brought into 0..255.
pub fn hex(rgb: [f64; 3]) -> String {
    let [r, g, b] = rgb.map(|c| c.round().clamp(0.0, 255.0) as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use sparrow_math::Real;

    /// CIE lightness of an sRGB colour.
    fn lightness(rgb: [f64; 3]) -> f64 {
        let linear = rgb.map(|c| {
            let c = c / 255.0;
            if c <= 0.04045 { c / 12.92 } else { Real::pow((c + 0.055) / 1.055, 2.4) }
        });
        let y = 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
        116.0 * Real::pow(y, 1.0 / 3.0) - 16.0
    }

    #[test]
    fn lightness_grows_evenly() {
        let at: Vec<f64> = (0..=30).map(|i| lightness(rgb(f64::from(i) / 30.0))).collect();
        let mean = (at[30] - at[0]) / 30.0;
        for pair in at.windows(2) {
            let step = pair[1] - pair[0];
            assert!(step > 0.6 * mean && step < 1.4 * mean, "{step} against {mean}");
        }
        assert_eq!((hex(rgb(-1.0)), hex(rgb(2.0))), ("#440154".into(), "#fde725".into()));
    }
}
