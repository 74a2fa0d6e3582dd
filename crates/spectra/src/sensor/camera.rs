//! Cameras among the sensors: their responses, and their matrix to XYZ.

use crate::matrix::{self, Mat3};
use crate::named::tables;
use crate::{ColorSpace, DenseSpectrum, cie};

/// The responses of a camera.
///
/// Those that pbrt-v4 knows, too, were measured for PhysLight [Langlands2020], from 380 to 720 nm; the response
/// is zero beyond.
pub(super) fn responses(name: &str) -> Option<[DenseSpectrum; 3]> {
    let mut all = tables(include_str!("../data/physlight.txt"));
    all.extend(tables(include_str!("../data/cameras.txt")));
    let find = |channel: &str| {
        let found = all.iter().find(|t| t.0.strip_suffix(channel).is_some_and(|n| n == name));
        found.map(|t| DenseSpectrum::from_samples(&t.1))
    };
    Some([find("_r")?, find("_g")?, find("_b")?])
}

/// The matrix from camera RGB to XYZ that fits the patches of a colour chart best, in least squares.
///
/// The camera sees the chart under `light`, the observer under the illuminant of `space`.
pub(super) fn fitted_to_swatches(
    bars: &[DenseSpectrum; 3],
    light: &DenseSpectrum,
    space: ColorSpace,
) -> Option<Mat3> {
    let observer = [cie::x(), cie::y(), cie::z()];
    let bars = [&bars[0], &bars[1], &bars[2]];
    let gain = light.inner_product(observer[1]) / light.inner_product(bars[1]);
    let mut seen_seen = [[0.0; 3]; 3];
    let mut wanted_seen = [[0.0; 3]; 3];
    for (_, samples) in tables(include_str!("../data/swatches.txt")) {
        let patch = DenseSpectrum::from_samples(&samples);
        let seen = projected(&patch, light, bars);
        let wanted = projected(&patch, space.illuminant(), observer);
        for i in 0..3 {
            for j in 0..3 {
                seen_seen[i][j] += seen[i] * seen[j];
                wanted_seen[i][j] += gain * wanted[i] * seen[j];
            }
        }
    }
    Some(matrix::product(&wanted_seen, &matrix::inverse(&seen_seen)?))
}

/// Three responses to a reflectance under a light, relative to the second response to the light itself.
fn projected(patch: &DenseSpectrum, light: &DenseSpectrum, bars: [&DenseSpectrum; 3]) -> [f64; 3] {
    let lit = patch.mul(light);
    let white = bars[1].inner_product(light);
    bars.map(|b| b.inner_product(&lit) / white)
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "parsing is exact")]
mod tests {
    use super::*;

    /// The cameras of pbrt-v4, and the sums over the 35 tabulated wavelengths of each response. The sums were
    /// taken from a second transcription of the source, in six decimals, not from the table.
    const SUMS: [(&str, [f32; 3]); 17] = [
        ("canon_eos_100d", [4.8199, 9.8569, 7.0990]),
        ("canon_eos_1dx_mkii", [5.3418, 10.1997, 6.9946]),
        ("canon_eos_200d", [5.5944, 10.2132, 6.8855]),
        ("canon_eos_200d_mkii", [5.3967, 10.2846, 6.9371]),
        ("canon_eos_5d", [4.3824, 8.8097, 6.2833]),
        ("canon_eos_5d_mkii", [4.2143, 9.2514, 6.1687]),
        ("canon_eos_5d_mkiii", [4.4841, 9.6257, 6.2999]),
        ("canon_eos_5d_mkiv", [4.9922, 10.2194, 7.4784]),
        ("canon_eos_5ds", [4.4480, 9.8410, 6.1725]),
        ("canon_eos_m", [4.7469, 9.7640, 7.0607]),
        ("hasselblad_l1d_20c", [3.4862, 9.7508, 5.9067]),
        ("nikon_d810", [4.6570, 9.2394, 7.4631]),
        ("nikon_d850", [4.4282, 8.6217, 6.6499]),
        ("sony_ilce_6400", [3.9283, 10.3973, 6.5228]),
        ("sony_ilce_7m3", [3.9616, 9.5224, 6.6713]),
        ("sony_ilce_7rm3", [3.7708, 9.5699, 6.6112]),
        ("sony_ilce_9", [4.0904, 9.5995, 7.2028]),
    ];

    #[test]
    fn responses_sum_to_what_the_source_sums_to() {
        for (name, sums) in SUMS {
            assert!(crate::Sensor::names().contains(&name), "{name} is not listed");
            for (bar, sum) in responses(name).unwrap().iter().zip(sums) {
                let ours: f32 = (0..35).map(|i| bar.value((380 + 10 * i) as f32)).sum();
                assert!((ours - sum).abs() < 1e-4, "{name}: {ours} against {sum}");
            }
        }
    }

    #[test]
    fn responses_peak_where_their_colour_is() {
        for (name, _) in SUMS {
            let bars = responses(name).unwrap();
            for (bar, colour) in bars.iter().zip([580.0..=610.0, 520.0..=520.0, 440.0..=480.0]) {
                let values = bar.values();
                assert!(values.iter().all(|v| (0.0..=1.0).contains(v)), "{name}");
                let peak = (0..values.len()).max_by(|&a, &b| values[a].total_cmp(&values[b])).unwrap();
                assert!(colour.contains(&(360.0 + peak as f32)), "{name}: peak {peak}");
                assert_eq!([bar.value(379.0), bar.value(721.0)], [0.0, 0.0], "{name}");
            }
            // Responses are relative to the highest of the camera, which is always the green one.
            assert_eq!(bars[1].value(520.0), 1.0, "{name}");
        }
    }

    #[test]
    fn a_name_is_whole() {
        for name in ["", "canon_eos", "canon_eos_5d_mki", "canon_eos_5d_r"] {
            assert!(responses(name).is_none(), "{name}");
        }
    }
}
