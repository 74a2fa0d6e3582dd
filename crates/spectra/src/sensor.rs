//! What the film measures: [`Sensor`].

mod camera;

use sparrow_math::Real;

use crate::matrix::{self, Mat3};
use crate::{ColorSpace, DenseSpectrum, N_LAMBDA, Spectrum, Wavelengths, cie, daylight};

/// The sensors with data, by the names scenes use.
const NAMES: [&str; 20] = [
    "cie1931",
    "canon_eos_100d",
    "canon_eos_1dx_mkii",
    "canon_eos_200d",
    "canon_eos_200d_mkii",
    "canon_eos_5d",
    "canon_eos_5d_mkii",
    "canon_eos_5d_mkiii",
    "canon_eos_5d_mkiv",
    "canon_eos_5ds",
    "canon_eos_m",
    "hasselblad_l1d_20c",
    "nikon_d5100",
    "nikon_d810",
    "nikon_d850",
    "sigma_sd1_merrill",
    "sony_ilce_6400",
    "sony_ilce_7m3",
    "sony_ilce_7rm3",
    "sony_ilce_9",
];

/// A film sensor: three spectral responses, an exposure, and a matrix to the output colour space.
///
/// The sum over a path's samples of [`to_sensor_rgb`](Self::to_sensor_rgb), averaged, is the pixel in
/// sensor RGB; [`output_rgb_from_sensor`](Self::output_rgb_from_sensor) takes it to the output space.
#[derive(Clone, Debug)]
pub struct Sensor {
    bars: [DenseSpectrum; 3],
    /// The same with their values side by side, and a zero.
    rows: Vec<[f32; 4]>,
    imaging_ratio: f32,
    output_from_sensor: [[f32; 3]; 3],
    xyz_from_sensor: [[f32; 3]; 3],
}

impl Sensor {
    /// The sensor of that name, or `None` where there is no data; see [`names`](Self::names).
    ///
    /// `imaging_ratio` multiplies what is measured: exposure time times ISO / 100, one by default.
    /// `white_balance_kelvin` is the temperature of the CIE daylight that the image shows as white. Without
    /// it `cie1931` does not balance, and cameras take 6500 K; both as in pbrt-v4.
    ///
    /// Source: [PBRT4, sec. 5.4.2].
    pub fn new(
        name: &str,
        space: ColorSpace,
        imaging_ratio: f32,
        white_balance_kelvin: Option<f32>,
    ) -> Option<Self> {
        let white = white_balance_kelvin.filter(|&k| k > 0.0);
        let (bars, to_xyz) = if name == "cie1931" {
            let balance = white.map_or(matrix::IDENTITY, |k| adaptation(&daylight(k), space));
            ([cie::x(), cie::y(), cie::z()].map(Clone::clone), balance)
        } else {
            let bars = camera::responses(name)?;
            let to_xyz = camera::fitted_to_swatches(&bars, &daylight(white.unwrap_or(6500.0)), space)?;
            (bars, to_xyz)
        };
        let to_output = matrix::product(&space.conversions().from_xyz, &to_xyz);
        let [r, g, b] = bars.each_ref().map(DenseSpectrum::values);
        let rows = r.iter().zip(g).zip(b).map(|((r, g), b)| [*r, *g, *b, 0.0]).collect();
        Some(Self {
            bars,
            rows,
            imaging_ratio,
            output_from_sensor: matrix::to_f32(&to_output),
            xyz_from_sensor: matrix::to_f32(&to_xyz),
        })
    }

    /// The names [`new`](Self::new) accepts.
    pub fn names() -> &'static [&'static str] {
        &NAMES
    }

    /// One path's contribution in sensor RGB: radiance over density, weighted by the responses.
    ///
    /// Wavelengths with zero density contribute nothing. There is no division by the integral of y-bar:
    /// lights are scaled by [`photometric`](crate::photometric), so white of luminance one measures one.
    #[inline]
    pub fn to_sensor_rgb(&self, l: Spectrum<f32>, w: &Wavelengths) -> [f32; 3] {
        self.respond(l, w.pdf_spectrum(), w.index.map(f32::from))
    }

    /// [`to_sensor_rgb`](Self::to_sensor_rgb) of one path, or of lanes of them, whose [wavelengths](Wavelengths) have that density and
    /// index.
    #[inline(always)]
    pub fn respond<R: Real>(&self, l: Spectrum<R>, pdf: Spectrum<R>, index: [R; N_LAMBDA]) -> [R; 3] {
        let mut seen = [Spectrum([R::ZERO; N_LAMBDA]); 3];
        for i in 0..N_LAMBDA {
            let [r, g, b, _] = index[i].look_up_fours(&self.rows);
            let there = R::select(pdf[i].gt(R::ZERO), l[i] / pdf[i], R::ZERO);
            (seen[0].0[i], seen[1].0[i], seen[2].0[i]) = (r * there, g * there, b * there);
        }
        let [r, g, b] = seen;
        let ratio = R::of(f64::from(self.imaging_ratio));
        [ratio * r.average(), ratio * g.average(), ratio * b.average()]
    }

    /// Matrix from sensor RGB to linear RGB of the output space, rows first.
    pub fn output_rgb_from_sensor(&self) -> [[f32; 3]; 3] {
        self.output_from_sensor
    }

    /// Matrix from sensor RGB to XYZ, rows first.
    pub fn xyz_from_sensor(&self) -> [[f32; 3]; 3] {
        self.xyz_from_sensor
    }

    /// The spectral responses.
    pub fn responses(&self) -> &[DenseSpectrum; 3] {
        &self.bars
    }

    /// What multiplies every measurement.
    pub fn imaging_ratio(&self) -> f32 {
        self.imaging_ratio
    }

    /// What the sensor measures of a spectrum, by integration: the mean of
    /// [`to_sensor_rgb`](Self::to_sensor_rgb) over all paths.
    pub fn measure(&self, s: &DenseSpectrum) -> [f32; 3] {
        let ratio = f64::from(self.imaging_ratio);
        let [r, g, b] = &self.bars;
        [r, g, b].map(|bar| (ratio * bar.inner_product(s)) as f32)
    }
}

/// Bradford's adaptation of XYZ, from the white of `light` to that of `space` [Lindbloom2017].
fn adaptation(light: &DenseSpectrum, space: ColorSpace) -> Mat3 {
    const LMS_FROM_XYZ: Mat3 =
        [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]];
    let lms = |[x, y]: [f64; 2]| matrix::apply(&LMS_FROM_XYZ, [x / y, 1.0, (1.0 - x - y) / y]);
    let (from, to) = (lms(cie::chromaticity(cie::xyz_of(light))), lms(space.white()));
    let gains = matrix::diagonal([0, 1, 2].map(|i| to[i] / from[i]));
    matrix::inverse(&LMS_FROM_XYZ)
        .map_or(matrix::IDENTITY, |back| matrix::product(&back, &matrix::product(&gains, &LMS_FROM_XYZ)))
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "equal sums of equal terms")]
mod tests {
    use super::*;
    use crate::{named_spectrum, photometric};

    fn output(sensor: &Sensor, light: &DenseSpectrum) -> [f32; 3] {
        let raw = sensor.measure(&light.scaled(1.0 / photometric(light)));
        sensor.output_rgb_from_sensor().map(|m| m[0] * raw[0] + m[1] * raw[1] + m[2] * raw[2])
    }

    fn off_white(rgb: [f32; 3]) -> f32 {
        rgb.into_iter().map(|v| (v - 1.0).abs()).fold(0.0, f32::max)
    }

    #[test]
    fn the_observer_shows_the_illuminant_as_white() {
        for space in ColorSpace::ALL {
            let sensor = Sensor::new("cie1931", space, 1.0, None).unwrap();
            let rgb = output(&sensor, space.illuminant());
            assert!(off_white(rgb) < 1e-5, "{space:?}: {rgb:?}");
        }
    }

    #[test]
    fn white_balance_shows_its_daylight_as_white() {
        for kelvin in [3200.0, 5000.0, 6500.0, 9000.0] {
            let sensor = Sensor::new("cie1931", ColorSpace::Srgb, 1.0, Some(kelvin)).unwrap();
            let rgb = output(&sensor, &daylight(kelvin));
            assert!(off_white(rgb) < 1e-4, "{kelvin}: {rgb:?}");
        }
        let plain = Sensor::new("cie1931", ColorSpace::Srgb, 1.0, Some(0.0)).unwrap();
        assert!(off_white(output(&plain, &daylight(5000.0))) > 0.1);
    }

    #[test]
    fn cameras_show_their_daylight_nearly_white() {
        for name in Sensor::names().iter().filter(|n| **n != "cie1931") {
            for kelvin in [None, Some(4500.0)] {
                let sensor = Sensor::new(name, ColorSpace::Srgb, 1.0, kelvin).unwrap();
                let rgb = output(&sensor, &daylight(kelvin.unwrap_or(6500.0)));
                // The matrix is fitted to 24 patches, not to white alone.
                assert!(off_white(rgb) < 0.04, "{name} {kelvin:?}: {rgb:?}");
            }
        }
    }

    #[test]
    fn samples_average_to_the_integral() {
        let light = named_spectrum("stdillum-A").unwrap();
        let sensor = Sensor::new("cie1931", ColorSpace::Srgb, 2.0, None).unwrap();
        let n = 4000;
        for sample in [Wavelengths::sample_visible, Wavelengths::sample_uniform] {
            let mut sum = [0.0f64; 3];
            for i in 0..n {
                let w = sample((i as f32 + 0.5) / n as f32);
                for (s, v) in sum.iter_mut().zip(sensor.to_sensor_rgb(light.at(&w), &w)) {
                    *s += f64::from(v) / f64::from(n);
                }
            }
            for (s, m) in sum.into_iter().zip(sensor.measure(&light)) {
                assert!((s / f64::from(m) - 1.0).abs() < 1e-3, "{s} against {m}");
            }
        }
    }

    #[test]
    fn a_given_up_wavelength_counts_for_nothing() {
        let sensor = Sensor::new("cie1931", ColorSpace::Srgb, 1.0, None).unwrap();
        let mut w = Wavelengths::sample_visible(0.4);
        w.terminate_secondary();
        let hero_only = sensor.to_sensor_rgb(Spectrum([1.0, 7.0, 7.0, 7.0]), &w);
        assert_eq!(hero_only, sensor.to_sensor_rgb(Spectrum([1.0, 0.0, 0.0, 0.0]), &w));
        assert!(hero_only[1] > 0.0);
    }
}
