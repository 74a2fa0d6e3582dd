//! An environment map: an image of radiance from all around, importance sampled.

use core::f32::consts::PI;

use sparrow_math::{Transform, Vec3, warp};
use sparrow_spectra::{ColorSpace, DenseSpectrum, Spectrum, Wavelengths, rgb_to_sigmoid};

use super::portal::Portal;
use crate::colour::four;
use crate::distribution::{Draw2, Piecewise2};

/// Cells along a side of a portal's view of a map: 8 MiB.
const MOST_PORTAL_CELLS: usize = 1024;

/// What the pixels of an environment map stand for.
#[derive(Debug)]
pub enum EnvironmentColour {
    /// Spectra: RGB of that space, lit by its illuminant, which is brought to unit luminance.
    Spectral {
        /// The space of the pixels.
        space: ColorSpace,
        /// Its illuminant.
        illuminant: DenseSpectrum,
    },
    /// The channels that paths carry.
    Rgb,
}

/// An environment map in pbrt-v4's square equal-area layout, looked up at the nearest pixel.
#[derive(Debug)]
pub struct Environment {
    n: usize,
    /// Linear RGB, row by row.
    rgb: Vec<[f32; 3]>,
    scale: f32,
    colour: EnvironmentColour,
    density: Piecewise2,
    /// The opening through which it is sampled.
    portal: Option<Box<Portal>>,
    /// Rotation of the map, by columns: map to world.
    axes: [Vec3<f32>; 3],
}

impl Environment {
    /// Takes an `n` by `n` image.
    ///
    /// With `compensate` the sampling density is sharpened: what lies below the mean is left to BSDF
    /// sampling. [Karlik2019]
    pub fn new(
        n: usize,
        rgb: Vec<[f32; 3]>,
        scale: f32,
        colour: EnvironmentColour,
        to_world: &Transform,
        compensate: bool,
    ) -> Environment {
        let mut brightness: Vec<f32> = rgb.iter().map(|c| ((c[0] + c[1] + c[2]) / 3.0).max(0.0)).collect();
        if compensate {
            let mean = brightness.iter().map(|&b| f64::from(b)).sum::<f64>() / brightness.len().max(1) as f64;
            let sharpened: Vec<f32> = brightness.iter().map(|&b| (b - mean as f32).max(0.0)).collect();
            // An even sky has nothing above its mean; then the plain density serves.
            if sharpened.iter().any(|&b| b > 0.0) {
                brightness = sharpened;
            }
        }
        let axis = |v| to_world.vector(v).to_f32().normalized();
        let e = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)];
        Environment {
            n,
            rgb,
            scale,
            colour,
            density: Piecewise2::new(&brightness, n, n),
            portal: None,
            axes: e.map(|(x, y, z)| axis(sparrow_math::vec3(x, y, z))),
        }
    }

    /// The same, sampled through a rectangle with these corners.
    #[must_use]
    pub(super) fn through(mut self, corners: Option<[Vec3<f64>; 4]>) -> Environment {
        let brightness = |wi| {
            let c = self.pixel(wi);
            (c[0] + c[1] + c[2]) / 3.0
        };
        let side = self.n.clamp(64, MOST_PORTAL_CELLS);
        self.portal = corners.and_then(|c| Portal::new(c, side, brightness)).map(Box::new);
        self
    }

    /// A direction for the point `from`, and its density in 1/sr.
    pub fn sample(&self, from: Vec3<f32>, u: [f32; 2]) -> Option<(Vec3<f32>, f32)> {
        if let Some(portal) = &self.portal {
            return portal.sample(from, u);
        }
        let Draw2 { p: st, pdf, .. } = self.density.sample(u);
        if !(pdf > 0.0) {
            return None;
        }
        let d = warp::equal_area_square_to_sphere(st);
        Some((self.axes[0] * d.x + self.axes[1] * d.y + self.axes[2] * d.z, pdf / (4.0 * PI)))
    }

    /// Density of a direction for the point `from`, in 1/sr.
    pub fn pdf(&self, from: Vec3<f32>, wi: Vec3<f32>) -> f32 {
        match &self.portal {
            Some(portal) => portal.pdf(from, wi),
            None => self.density.pdf(self.square(wi)) / (4.0 * PI),
        }
    }

    /// The pixel that a direction falls into.
    fn pixel(&self, wi: Vec3<f32>) -> [f32; 3] {
        let st = self.square(wi);
        let at = |v: f32| ((v * self.n as f32) as usize).min(self.n - 1);
        self.rgb[at(st[1]) * self.n + at(st[0])]
    }

    /// Radiance from a direction.
    pub fn radiance(&self, wi: Vec3<f32>, w: &Wavelengths) -> Spectrum<f32> {
        let rgb = self.pixel(wi);
        let EnvironmentColour::Spectral { space, illuminant } = &self.colour else {
            return Spectrum(four(rgb)) * self.scale;
        };
        let m = 2.0 * rgb[0].max(rgb[1]).max(rgb[2]);
        if !(m > 0.0) {
            return Spectrum::ZERO;
        }
        let s = rgb_to_sigmoid(rgb.map(|c| (c / m).max(0.0)), *space);
        s.at(w) * illuminant.at(w) * (m * self.scale)
    }

    /// Mean of the image times the scale: for estimates of power.
    pub fn mean(&self) -> f32 {
        let sum: f64 = self.rgb.iter().map(|c| f64::from(c[0] + c[1] + c[2]) / 3.0).sum();
        (sum / self.rgb.len().max(1) as f64) as f32 * self.scale
    }

    /// Memory, in bytes.
    pub fn bytes(&self) -> usize {
        self.rgb.len() * 12 + self.density.bytes() + self.portal.as_ref().map_or(0, |p| p.bytes())
    }

    fn square(&self, wi: Vec3<f32>) -> [f32; 2] {
        let d = sparrow_math::vec3(wi.dot(self.axes[0]), wi.dot(self.axes[1]), wi.dot(self.axes[2]));
        warp::equal_area_sphere_to_square(d)
    }
}
