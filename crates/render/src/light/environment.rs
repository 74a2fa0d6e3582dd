//! An environment map: an image of radiance from all around, importance sampled.

use core::f32::consts::PI;

use rayon::prelude::*;
use sparrow_math::{InLanes, Real, Transform, Vec3, in_lanes, vec3, warp};
use sparrow_spectra::{ColorSpace, DenseSpectrum, N_LAMBDA, Sigmoid, Spectrum, Wavelengths, rgb_to_sigmoid};

use super::portal::Portal;
use crate::colour::{CHANNEL, four};
use crate::distribution::{Draw2, Piecewise2};
use crate::integrator::Column;
use crate::spectrum::dense_at;

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

/// An environment map as it is read: `n` by `n` pixels of linear RGB, row by row, in pbrt-v4's square equal-area layout.
#[derive(Debug)]
pub struct EnvironmentMap {
    /// Pixels along each side.
    pub n: usize,
    /// The pixels.
    pub rgb: Vec<[f32; 3]>,
    /// Factor on them.
    pub scale: f32,
    /// What they stand for.
    pub colour: EnvironmentColour,
}

/// An environment map, looked up at the nearest pixel.
#[derive(Debug)]
pub struct Environment {
    n: usize,
    /// Row by row: coefficients of a [`Sigmoid`] and a factor, or the channels that paths carry and a factor.
    texels: Vec<[f32; 4]>,
    /// None where paths carry channels.
    illuminant: Option<DenseSpectrum>,
    mean: f32,
    density: Piecewise2,
    /// The opening through which it is sampled.
    portal: Option<Box<Portal>>,
    /// Rotation of the map, by columns: map to world.
    axes: [Vec3<f32>; 3],
}

/// A direction that was drawn.
#[derive(Clone, Copy, Debug)]
pub struct EnvironmentDraw {
    /// The direction, unit.
    pub wi: Vec3<f32>,
    /// Its density in 1/sr.
    pub pdf: f32,
    texel: usize,
}

impl Environment {
    /// Prepares a map that stands in the world as `to_world` says.
    ///
    /// With `compensate` the sampling density is sharpened: what lies below the mean is left to BSDF
    /// sampling. [Karlik2019] Where there are `corners` of a rectangle, it is sampled through that.
    pub fn new(
        map: EnvironmentMap,
        to_world: &Transform,
        compensate: bool,
        corners: Option<[Vec3<f64>; 4]>,
    ) -> Environment {
        let EnvironmentMap { n, rgb, scale, colour } = map;
        let mut brightness: Vec<f32> =
            rgb.par_iter().map(|c| ((c[0] + c[1] + c[2]) / 3.0).max(0.0)).collect();
        if compensate {
            let mean = brightness.iter().map(|&b| f64::from(b)).sum::<f64>() / brightness.len().max(1) as f64;
            let mean = mean as f32;
            // An even sky has nothing above its mean; then the plain density serves.
            if brightness.iter().any(|&b| b > mean) {
                brightness.par_iter_mut().for_each(|b| *b = (*b - mean).max(0.0));
            }
        }
        let axis = |v| to_world.vector(v).to_f32().normalized();
        let e = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)];
        let sum = || rgb.iter().map(|c| f64::from(c[0] + c[1] + c[2]) / 3.0).sum::<f64>();
        let (sum, density) = rayon::join(sum, || Piecewise2::new(&brightness, n, n));
        let mut environment = Environment {
            n,
            texels: Vec::new(),
            illuminant: None,
            mean: (sum / rgb.len().max(1) as f64) as f32 * scale,
            density,
            portal: None,
            axes: e.map(|(x, y, z)| axis(vec3(x, y, z))),
        };
        let through = corners.and_then(|c| {
            let brightness = |wi| {
                let c = rgb[environment.texel(environment.place(wi))];
                (c[0] + c[1] + c[2]) / 3.0
            };
            Portal::new(c, n.clamp(64, MOST_PORTAL_CELLS), brightness)
        });
        environment.portal = through.map(Box::new);
        let texels = rgb.par_iter();
        (environment.texels, environment.illuminant) = match colour {
            EnvironmentColour::Rgb => (texels.map(|[r, g, b]| [*r, *g, *b, scale]).collect(), None),
            EnvironmentColour::Spectral { space, illuminant } => {
                (texels.map(|c| coefficients(*c, scale, space)).collect(), Some(illuminant))
            }
        };
        environment
    }

    /// A direction for the point `from`.
    #[inline]
    pub fn sample(&self, from: Vec3<f32>, u: [f32; 2]) -> Option<EnvironmentDraw> {
        if let Some(portal) = &self.portal {
            let (wi, pdf) = portal.sample(from, u)?;
            return Some(EnvironmentDraw { wi, pdf, texel: self.texel(self.place(wi)) });
        }
        let Draw2 { p, pdf, index: [x, y] } = self.density.sample(u);
        let wi = self.to_world(warp::equal_area_square_to_sphere(p));
        (pdf > 0.0).then(|| EnvironmentDraw { wi, pdf: pdf / (4.0 * PI), texel: y * self.n + x })
    }
    /// Radiance from a direction that was drawn.
    #[inline]
    pub fn drawn(&self, draw: &EnvironmentDraw, w: &Wavelengths) -> Spectrum<f32> {
        self.at(draw.texel, w)
    }
    /// [`sample_many`](Self::sample_many) has lanes for it.
    pub(super) fn samples_in_lanes(&self) -> bool {
        self.portal.is_none()
    }
    /// [`sample`](Self::sample) and [`drawn`](Self::drawn) by `u` for `n` points, to the bit; the density is zero where nothing is
    /// drawn. Not for maps with a portal.
    pub(super) fn sample_many(
        &self,
        n: usize,
        u: [&[f32]; 2],
        (wi, pdf): (&mut [&mut [f32]; 3], &mut [f32]),
        nm: [&[f32]; N_LAMBDA],
        radiance: [&mut [f32]; N_LAMBDA],
    ) {
        let mut drawn = Drawn::default();
        for k in 0..n {
            let Draw2 { p, pdf: density, index: [x, y] } = self.density.sample([u[0][k], u[1][k]]);
            pdf[k] = if density > 0.0 { density / (4.0 * PI) } else { 0.0 };
            let row = self.texels[y * self.n + x];
            drawn.p.iter_mut().zip(p).for_each(|(column, x)| column[k] = x);
            drawn.texel.iter_mut().zip(row).for_each(|(column, x)| column[k] = x);
        }
        in_lanes(Directions { environment: self, p: &drawn.p, n, wi });
        in_lanes(Shine { environment: self, texel: &drawn.texel, n, nm, radiance });
    }
    /// [`radiance`](Self::radiance) from the directions `d` of `n` rays, and [`pdf`](Self::pdf) of these, to the bit. Not for maps with a
    /// portal.
    pub(crate) fn escaped_many(
        &self,
        n: usize,
        d: [&[f32]; 3],
        nm: [&[f32]; N_LAMBDA],
        radiance: [&mut [f32]; N_LAMBDA],
        pdf: &mut [f32],
    ) {
        let mut found = Drawn::default();
        in_lanes(Places { environment: self, d, n, p: &mut found.p });
        for (k, pdf) in pdf[..n].iter_mut().enumerate() {
            let place = [found.p[0][k], found.p[1][k]];
            let row = self.texels[self.texel(place)];
            found.texel.iter_mut().zip(row).for_each(|(column, x)| column[k] = x);
            *pdf = self.density.pdf(place) / (4.0 * PI);
        }
        in_lanes(Shine { environment: self, texel: &found.texel, n, nm, radiance });
    }

    /// Density of a direction for the point `from`, in 1/sr; the map has it at `place`.
    #[inline]
    pub fn pdf(&self, from: Vec3<f32>, wi: Vec3<f32>, place: [f32; 2]) -> f32 {
        match &self.portal {
            Some(portal) => portal.pdf(from, wi),
            None => self.density.pdf(place) / (4.0 * PI),
        }
    }

    /// Where the map has a direction, in the unit square.
    #[inline]
    pub fn place(&self, wi: Vec3<f32>) -> [f32; 2] {
        self.place_of(wi)
    }
    #[inline(always)]
    fn place_of<R: Real>(&self, wi: Vec3<R>) -> [R; 2] {
        let [x, y, z] = self.spread_axes();
        warp::equal_area_sphere_to_square(vec3(wi.dot(x), wi.dot(y), wi.dot(z)))
    }
    /// Radiance from a place.
    #[inline]
    pub fn radiance(&self, place: [f32; 2], w: &Wavelengths) -> Spectrum<f32> {
        self.at(self.texel(place), w)
    }
    #[inline]
    fn texel(&self, [s, t]: [f32; 2]) -> usize {
        let at = |v: f32| ((v * self.n as f32) as usize).min(self.n - 1);
        at(t) * self.n + at(s)
    }
    #[inline]
    fn at(&self, texel: usize, w: &Wavelengths) -> Spectrum<f32> {
        let [a, b, c, scale] = self.texels[texel];
        match &self.illuminant {
            Some(illuminant) => Sigmoid { c: [a, b, c] }.at(w) * illuminant.at(w) * scale,
            None => Spectrum(four([a, b, c])) * scale,
        }
    }
    #[inline(always)]
    fn to_world<R: Real>(&self, d: Vec3<R>) -> Vec3<R> {
        let [x, y, z] = self.spread_axes();
        x * d.x + y * d.y + z * d.z
    }
    #[inline(always)]
    fn spread_axes<R: Real>(&self) -> [Vec3<R>; 3] {
        let spread = |v: Vec3<f32>| vec3(R::of(v.x.into()), R::of(v.y.into()), R::of(v.z.into()));
        [spread(self.axes[0]), spread(self.axes[1]), spread(self.axes[2])]
    }

    /// Mean of the image times the scale: for estimates of power.
    pub fn mean(&self) -> f32 {
        self.mean
    }

    /// Memory, in bytes.
    pub fn bytes(&self) -> usize {
        self.texels.len() * 16 + self.density.bytes() + self.portal.as_ref().map_or(0, |p| p.bytes())
    }
}

/// A pixel as the coefficients of a reflectance and a factor on the illuminant.
fn coefficients(rgb: [f32; 3], scale: f32, space: ColorSpace) -> [f32; 4] {
    let m = 2.0 * rgb[0].max(rgb[1]).max(rgb[2]);
    if !(m > 0.0) {
        return [0.0; 4];
    }
    let [a, b, c] = rgb_to_sigmoid(rgb.map(|c| (c / m).max(0.0)), space).c;
    [a, b, c, m * scale]
}

/// Places and texels, in columns.
#[derive(Default)]
struct Drawn {
    p: [Column; 2],
    texel: [Column; 4],
}

/// Directions of places.
struct Directions<'a, 'b> {
    environment: &'a Environment,
    p: &'a [Column; 2],
    n: usize,
    wi: &'a mut [&'b mut [f32]; 3],
}

impl InLanes for Directions<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Directions { environment, p, n, wi } = self;
        for k in (0..n).step_by(R::WIDTH) {
            let p = [R::load(&p[0][..], k), R::load(&p[1][..], k)];
            let d = environment.to_world(warp::equal_area_square_to_sphere(p));
            d.x.store(wi[0], k);
            d.y.store(wi[1], k);
            d.z.store(wi[2], k);
        }
    }
}

/// Places of directions.
struct Places<'a> {
    environment: &'a Environment,
    d: [&'a [f32]; 3],
    n: usize,
    p: &'a mut [Column; 2],
}

impl InLanes for Places<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Places { environment, d, n, p } = self;
        for k in (0..n).step_by(R::WIDTH) {
            let d = vec3(R::load(d[0], k), R::load(d[1], k), R::load(d[2], k));
            let [s, t] = environment.place_of(d);
            s.store(&mut p[0][..], k);
            t.store(&mut p[1][..], k);
        }
    }
}

/// Radiances of texels.
struct Shine<'a> {
    environment: &'a Environment,
    texel: &'a [Column; 4],
    n: usize,
    nm: [&'a [f32]; N_LAMBDA],
    radiance: [&'a mut [f32]; N_LAMBDA],
}

impl InLanes for Shine<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Shine { environment, texel: [a, b, c, scale], n, nm, radiance } = self;
        for k in (0..n).step_by(R::WIDTH) {
            let rgb = [R::load(&a[..], k), R::load(&b[..], k), R::load(&c[..], k)];
            let scale = R::load(&scale[..], k);
            for i in 0..N_LAMBDA {
                let value = match &environment.illuminant {
                    Some(illuminant) => {
                        let nm = R::load(nm[i], k);
                        Sigmoid::eval(rgb, nm) * dense_at(illuminant.values(), nm)
                    }
                    None => rgb[CHANNEL[i]],
                };
                (value * scale).store(radiance[i], k);
            }
        }
    }
}
