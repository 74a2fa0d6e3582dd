//! Lights: what they send towards a point, and how likely a direction is to be sampled.

mod bounds;
mod build;
mod bulbs;
mod eight;
mod emitters;
mod environment;
mod few;
mod group;
mod portal;
mod selection;
#[cfg(test)]
mod tests;
mod tree;

use sparrow_geometry::{Geometry, PdfColumns, SampleColumns, ShapeSample, SurfacePoint, Viewpoint};
use sparrow_math::{InLanes, Real, Transform, Vec3, in_lanes, vec3};
use sparrow_spectra::{N_LAMBDA, Spectrum, Wavelengths};

use crate::spectrum::SceneSpectrum;

use bulbs::Bulbs;
use portal::Portal;

pub use build::LightBuild;
pub(crate) use emitters::Emitters;
pub use environment::{Environment, EnvironmentColour, EnvironmentDraw, EnvironmentMap};
pub(crate) use few::LitPoints;
pub use selection::LightSelection;

/// Marks shapes that emit nothing.
pub const NO_LIGHT: u32 = u32::MAX;

/// One light.
#[derive(Debug)]
pub enum Light {
    /// One primitive of an emitting shape.
    Area {
        /// Shape in the geometry.
        shape: u32,
        /// Primitive in the shape.
        prim: u32,
        /// Table of emission.
        emission: u32,
        /// Factor on the table.
        scale: f32,
        /// Emits on both sides.
        two_sided: bool,
    },
    /// A point.
    Point {
        /// Place.
        p: Vec3<f32>,
        /// Table of emission.
        emission: u32,
        /// Factor on the table.
        scale: f32,
    },
    /// A cone of light from a point.
    Spot {
        /// Place.
        p: Vec3<f32>,
        /// World to light space, where z is the axis.
        to_light: Box<Transform>,
        /// Cosine where the light ends.
        cos_end: f32,
        /// Cosine up to which it is full.
        cos_start: f32,
        /// Table of emission.
        emission: u32,
        /// Factor on the table.
        scale: f32,
    },
    /// Parallel light.
    Distant {
        /// Direction towards the light.
        wi: Vec3<f32>,
        /// Table of emission.
        emission: u32,
        /// Factor on the table.
        scale: f32,
    },
    /// One radiance from all around.
    Uniform {
        /// Table of emission.
        emission: u32,
        /// Factor on the table.
        scale: f32,
        /// Light sampling leaves it to the BSDF: the sharpened density of MIS compensation is zero everywhere.
        left_to_bsdf: bool,
        /// The opening through which it is sampled.
        portal: Option<Box<Portal>>,
    },
    /// An image of radiance from all around.
    Environment(Box<Environment>),
}

/// Light from a sampled direction.
#[derive(Clone, Copy, Debug)]
pub struct LightSample {
    /// Towards the light, unit.
    pub wi: Vec3<f32>,
    /// What it sends, unoccluded. For a light that is a point or a direction: over the square of the distance.
    pub radiance: Spectrum<f32>,
    /// Density in 1/sr; 1 for lights that no other technique can find.
    pub pdf: f32,
    /// No other technique can find it.
    pub delta: bool,
    /// How far a shadow ray has to go.
    pub target: Target,
}

/// Where a shadow ray ends.
#[derive(Clone, Copy, Debug)]
pub enum Target {
    /// On a surface.
    Surface(ShapeSample),
    /// At a point in space.
    Point(Vec3<f32>),
    /// Nowhere.
    Infinity,
}

/// Where the shadow rays of many samples of one light end.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Ends {
    /// On a surface, at points with that bound of rounding errors.
    OnSurface {
        /// The bound.
        p_error: Vec3<f32>,
    },
    /// Nowhere.
    Nowhere,
}

/// The point that is lit, as far as the choice of a light depends on it.
#[derive(Clone, Copy, Debug)]
pub struct LitPoint {
    /// Point.
    pub p: Vec3<f32>,
    /// Shading normal.
    pub n: Vec3<f32>,
}

impl LitPoint {
    /// From where lights are sampled.
    #[inline]
    fn viewpoint(&self) -> Viewpoint {
        Viewpoint { p: self.p, n: Some(self.n) }
    }
}

/// All lights of a scene.
#[derive(Debug)]
pub struct Lights {
    lights: Vec<Light>,
    emissions: Vec<SceneSpectrum>,
    /// First light of each shape, or [`NO_LIGHT`].
    first_of_shape: Vec<u32>,
    /// Lights that rays meet where they leave the scene.
    infinite: Vec<u32>,
    /// Where alone rays meet light; `None` where it comes from all around, or where that takes too long to ask.
    emitters: Option<Emitters>,
    selection: LightSelection,
    bulbs: Bulbs,
    bounds_radius: f32,
}

impl Lights {
    /// The number of lights, each primitive of an emitting shape counted.
    pub fn len(&self) -> usize {
        self.lights.len()
    }
    /// There is no light.
    pub fn is_empty(&self) -> bool {
        self.lights.is_empty()
    }
    /// The lights.
    pub fn as_slice(&self) -> &[Light] {
        &self.lights
    }
    /// Indices of the lights around the scene.
    pub fn infinite(&self) -> &[u32] {
        &self.infinite
    }
    /// The light around the scene, where that is one environment map without a portal.
    pub(crate) fn only_environment(&self) -> Option<(u32, &Environment)> {
        let &[light] = &self.infinite[..] else { return None };
        let Light::Environment(e) = &self.lights[light as usize] else { return None };
        e.samples_in_lanes().then_some((light, e))
    }
    /// Where alone rays may meet light, if that is known and quick to ask.
    pub(crate) fn emitters(&self) -> Option<&Emitters> {
        self.emitters.as_ref()
    }
    /// Radius of the scene, with which powers of infinite lights were estimated.
    pub fn bounds_radius(&self) -> f32 {
        self.bounds_radius
    }
    /// The light of that primitive.
    #[inline]
    pub fn of_primitive(&self, shape: u32, prim: u32) -> Option<u32> {
        let first = self.first_of_shape[shape as usize];
        (first != NO_LIGHT).then(|| first + prim)
    }

    /// Chooses a light for the point `at`: its index, the probability, and `u` made uniform again.
    #[inline]
    pub fn choose(&self, at: &LitPoint, u: f32) -> Option<(u32, f32)> {
        self.selection.choose(at, u)
    }
    /// [`choose`](Self::choose) for each of `points`, to the bit: the index, or [`NO_LIGHT`], and the probability, else zero.
    #[inline]
    pub(crate) fn choose_many(&self, points: &LitPoints<'_>, light: &mut [u32], probability: &mut [f32]) {
        self.selection.choose_many(points, light, probability);
    }
    /// The light that [`choose`](Self::choose) picks everywhere, where there is no other.
    pub(crate) fn only(&self) -> Option<u32> {
        self.selection.only()
    }
    /// The probability with which [`choose`](Self::choose) picks that light.
    #[inline]
    pub fn probability(&self, at: &LitPoint, light: u32) -> f32 {
        self.selection.probability(at, light)
    }

    /// [`probability`](Self::probability) of one light for each of `points`, to the bit. The column is as long as theirs.
    pub(crate) fn probability_many(&self, points: &LitPoints<'_>, light: u32, out: &mut [f32]) {
        self.selection.probability_many(points, light, out);
    }

    /// [`sample_many`](Self::sample_many) and [`met_many`](Self::met_many) have lanes for that light.
    pub(crate) fn samples_in_lanes(&self, geometry: &Geometry, light: u32) -> bool {
        match &self.lights[light as usize] {
            Light::Area { shape, prim, .. } => geometry.samples_in_lanes(*shape, *prim),
            Light::Environment(e) => e.samples_in_lanes(),
            Light::Point { .. } | Light::Spot { .. } | Light::Distant { .. } | Light::Uniform { .. } => false,
        }
    }

    /// [`sample`](Self::sample) from each of the first `n` points of `columns`, in lanes, to the bit: the density is zero where that
    /// gives none. Says where these samples lie; `None`, and nothing done, where such lights are drawn one by one.
    pub(crate) fn sample_many(
        &self,
        geometry: &Geometry,
        light: u32,
        columns: &mut SampleColumns<'_>,
        n: usize,
        nm: [&[f32]; N_LAMBDA],
        radiance: [&mut [f32]; N_LAMBDA],
    ) -> Option<Ends> {
        match &self.lights[light as usize] {
            Light::Area { shape, prim, emission, scale, two_sided } => {
                let p_error = geometry.sample_from_many(*shape, *prim, columns, n)?;
                if !two_sided {
                    in_lanes(OneSided { columns, n });
                }
                self.emissions[*emission as usize].fill(*scale, nm, n, radiance);
                Some(Ends::OnSurface { p_error })
            }
            Light::Environment(e) if e.samples_in_lanes() => {
                e.sample_many(n, columns.u, (&mut columns.wi, columns.pdf), nm, radiance);
                Some(Ends::Nowhere)
            }
            Light::Point { .. }
            | Light::Spot { .. }
            | Light::Distant { .. }
            | Light::Uniform { .. }
            | Light::Environment(_) => None,
        }
    }

    /// Lights on whole balls have lanes together: [`sample_bulbs`](Self::sample_bulbs).
    #[inline(always)]
    pub(crate) fn is_bulb(&self, light: u32) -> bool {
        self.bulbs.has(light)
    }
    /// [`sample`](Self::sample) of the bulb that `which` names from each of the first `n` points of `columns`, in lanes, to the bit: the
    /// density is zero where that gives none. Writes the errors of points to `p_error`. All lists are as long as `n`, rounded up to whole
    /// registers, and name bulbs.
    pub(crate) fn sample_bulbs(
        &self,
        which: &[u32],
        columns: &mut SampleColumns<'_>,
        p_error: [&mut [f32]; 3],
        n: usize,
        nm: [&[f32]; N_LAMBDA],
        radiance: [&mut [f32]; N_LAMBDA],
    ) {
        self.bulbs.sample_many(which, columns, p_error, n, nm, radiance);
    }

    /// What the light of a primitive sends from each of the first `n` points on it, and the
    /// [density](Self::pdf_of_point) with which they are found, in lanes, to the bit. True where both sides shine; nothing is done for
    /// lights that have no lanes.
    pub(crate) fn met_many(
        &self,
        geometry: &Geometry,
        light: u32,
        columns: &mut PdfColumns<'_>,
        n: usize,
        nm: [&[f32]; N_LAMBDA],
        radiance: [&mut [f32]; N_LAMBDA],
    ) -> bool {
        let Light::Area { shape, prim, emission, scale, two_sided } = &self.lights[light as usize] else {
            return false;
        };
        geometry.pdf_from_many(*shape, *prim, columns, n);
        self.emissions[*emission as usize].fill(*scale, nm, n, radiance);
        *two_sided
    }

    /// What the light of a primitive sends from a point drawn on it; none to the side that does not shine.
    #[inline]
    fn of_surface(&self, light: u32, s: ShapeSample, w: &Wavelengths) -> Option<LightSample> {
        let Light::Area { emission, scale, two_sided, .. } = &self.lights[light as usize] else {
            return None;
        };
        (s.pdf > 0.0 && (*two_sided || s.n.dot(s.wi) < 0.0)).then(|| LightSample {
            wi: s.wi,
            radiance: self.emissions[*emission as usize].at(w) * *scale,
            pdf: s.pdf,
            delta: false,
            target: Target::Surface(s),
        })
    }

    /// Draws a direction towards the light; none where it sends nothing to that point.
    pub fn sample(
        &self,
        geometry: &Geometry,
        light: u32,
        at: &LitPoint,
        u: [f32; 2],
        w: &Wavelengths,
    ) -> Option<LightSample> {
        match &self.lights[light as usize] {
            Light::Area { shape, prim, .. } => {
                self.of_surface(light, geometry.sample_from(*shape, *prim, at.viewpoint(), u)?, w)
            }
            Light::Point { p, emission, scale } => self.point_sample(*p, at, *emission, *scale, w),
            Light::Spot { p, to_light, cos_end, cos_start, emission, scale } => {
                let back = to_light.vector((at.p - *p).to_f64()).to_f32().normalized();
                let falloff = smooth_step(*cos_end, *cos_start, back.z);
                if falloff <= 0.0 {
                    return None;
                }
                self.point_sample(*p, at, *emission, *scale * falloff, w)
            }
            Light::Distant { wi, emission, scale } => Some(LightSample {
                wi: *wi,
                radiance: self.emissions[*emission as usize].at(w) * *scale,
                pdf: 1.0,
                delta: true,
                target: Target::Infinity,
            }),
            Light::Uniform { emission, scale, left_to_bsdf, portal } => {
                if *left_to_bsdf {
                    return None;
                }
                let (wi, pdf) = match portal {
                    Some(portal) => portal.sample(at.p, u)?,
                    None => (sparrow_math::warp::uniform_sphere(u), UNIFORM_SPHERE),
                };
                Some(LightSample {
                    wi,
                    radiance: self.emissions[*emission as usize].at(w) * *scale,
                    pdf,
                    delta: false,
                    target: Target::Infinity,
                })
            }
            Light::Environment(e) => {
                let draw = e.sample(at.p, u)?;
                Some(LightSample {
                    wi: draw.wi,
                    radiance: e.drawn(&draw, w),
                    pdf: draw.pdf,
                    delta: false,
                    target: Target::Infinity,
                })
            }
        }
    }

    fn point_sample(
        &self,
        p: Vec3<f32>,
        at: &LitPoint,
        emission: u32,
        scale: f32,
        w: &Wavelengths,
    ) -> Option<LightSample> {
        let d = p - at.p;
        let d2 = d.length2();
        if !(d2 > 0.0) {
            return None;
        }
        Some(LightSample {
            wi: d * (1.0 / d2.sqrt()),
            radiance: self.emissions[emission as usize].at(w) * (scale / d2),
            pdf: 1.0,
            delta: true,
            target: Target::Point(p),
        })
    }

    /// Radiance that leaves the surface `point` of that light in direction `wo`.
    #[inline]
    pub fn emitted(&self, light: u32, point: &SurfacePoint, wo: Vec3<f32>, w: &Wavelengths) -> Spectrum<f32> {
        match &self.lights[light as usize] {
            Light::Area { emission, scale, two_sided, .. } if *two_sided || point.ng.dot(wo) > 0.0 => {
                self.emissions[*emission as usize].at(w) * *scale
            }
            Light::Area { .. }
            | Light::Point { .. }
            | Light::Spot { .. }
            | Light::Distant { .. }
            | Light::Uniform { .. }
            | Light::Environment(_) => Spectrum::ZERO,
        }
    }

    /// Density with which [`sample`](Self::sample) finds the surface `point` of that light from `at`, in 1/sr.
    #[inline]
    pub fn pdf_of_point(&self, geometry: &Geometry, at: &LitPoint, point: &SurfacePoint) -> f32 {
        geometry.pdf_from(point.shape, point.prim, at.viewpoint(), point.p, point.ng)
    }

    /// Where an environment map has direction `wi`; of no meaning for other lights.
    #[inline]
    pub fn place_of(&self, light: u32, wi: Vec3<f32>) -> [f32; 2] {
        match &self.lights[light as usize] {
            Light::Environment(e) => e.place(wi),
            Light::Area { .. }
            | Light::Point { .. }
            | Light::Spot { .. }
            | Light::Distant { .. }
            | Light::Uniform { .. } => [0.0; 2],
        }
    }
    /// Radiance of an infinite light from the direction at that [place](Self::place_of).
    #[inline]
    pub fn escaped(&self, light: u32, place: [f32; 2], w: &Wavelengths) -> Spectrum<f32> {
        match &self.lights[light as usize] {
            Light::Uniform { emission, scale, .. } => self.emissions[*emission as usize].at(w) * *scale,
            Light::Environment(e) => e.radiance(place, w),
            Light::Area { .. } | Light::Point { .. } | Light::Spot { .. } | Light::Distant { .. } => {
                Spectrum::ZERO
            }
        }
    }

    /// Density with which [`sample`](Self::sample) finds direction `wi` of an infinite light from `at`, in 1/sr; an environment map
    /// has it at `place`.
    #[inline]
    pub fn pdf_of_escape(&self, light: u32, at: &LitPoint, wi: Vec3<f32>, place: [f32; 2]) -> f32 {
        match &self.lights[light as usize] {
            Light::Uniform { left_to_bsdf: true, .. } => 0.0,
            Light::Uniform { portal, .. } => portal.as_ref().map_or(UNIFORM_SPHERE, |p| p.pdf(at.p, wi)),
            Light::Environment(e) => e.pdf(at.p, wi, place),
            Light::Area { .. } | Light::Point { .. } | Light::Spot { .. } | Light::Distant { .. } => 0.0,
        }
    }
}

/// Takes points away whose side does not shine.
struct OneSided<'a, 'b> {
    columns: &'a mut SampleColumns<'b>,
    n: usize,
}

impl InLanes for OneSided<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let SampleColumns { on, wi, pdf, .. } = self.columns;
        for k in (0..self.n).step_by(R::WIDTH) {
            let n = vec3(R::load(on[0], k), R::load(on[1], k), R::load(on[2], k));
            let wi = vec3(R::load(wi[0], k), R::load(wi[1], k), R::load(wi[2], k));
            R::load(pdf, k).only_where(n.dot(wi).lt(R::ZERO)).store(pdf, k);
        }
    }
}

/// Density of directions drawn over the whole sphere, in 1/sr.
const UNIFORM_SPHERE: f32 = 0.25 * core::f32::consts::FRAC_1_PI;

/// Hermite's step from 0 at `a` to 1 at `b`.
fn smooth_step(a: f32, b: f32, x: f32) -> f32 {
    if b <= a {
        return if x < a { 0.0 } else { 1.0 };
    }
    let t = Real::clamp((x - a) / (b - a), 0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
