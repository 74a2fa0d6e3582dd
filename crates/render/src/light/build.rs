//! From light descriptions to lights.

use std::collections::HashMap;
use std::path::Path;

use sparrow_geometry::{Geometry, ShapeSample};
use sparrow_image::Image;
use sparrow_math::{Aabb, Frame, Real, Transform, Vec3, vec3};
use sparrow_mis::Mis;
use sparrow_scene::{AreaLightId, Emission, LightDesc, LightKind, LightSamplerName, SceneDesc};
use sparrow_spectra::{ColorSpace, photometric};

use super::bounds::{Cone, LightBounds};
use super::bulbs::Bulbs;
use super::portal::Portal;
use super::{
    Emitters, Environment, EnvironmentColour, EnvironmentMap, Light, LightSelection, Lights, NO_LIGHT,
};
use crate::colour::{Carrier, converted};
use crate::spectrum::SceneSpectrum;
use crate::texture::to_equal_area;

/// What the lights of a scene are built from.
#[derive(Debug)]
pub struct LightBuild<'a> {
    /// The description.
    pub desc: &'a SceneDesc,
    /// The geometry, one shape per entry of `emitters`.
    pub geometry: &'a Geometry,
    /// Emission of each shape of the geometry.
    pub emitters: &'a [Option<AreaLightId>],
    /// Environment densities are sharpened.
    pub compensate: bool,
}

impl LightBuild<'_> {
    /// Builds all lights. Images that cannot be read go to `faults`.
    pub fn build(&self, faults: &mut Vec<String>) -> Lights {
        let mut out = Parts {
            lights: Vec::new(),
            carrier: Carrier::new(&self.desc.film),
            emissions: Vec::new(),
            known: HashMap::new(),
            bounds: Vec::new(),
            infinite: Vec::new(),
        };
        let scene_bounds = self.geometry.bounds();
        let radius = scene_bounds.radius().max(1e-6);
        let mut first_of_shape = vec![NO_LIGHT; self.emitters.len()];
        for (shape, id) in self.emitters.iter().enumerate() {
            if let Some(id) = id {
                first_of_shape[shape] = out.lights.len() as u32;
                self.area_lights(shape as u32, *id, &mut out);
            }
        }
        for light in &self.desc.lights {
            if let Err(e) = self.other_light(light, radius, &mut out) {
                faults.push(e);
            }
        }
        let selection = self.selection(&out);
        // Light from all around is met by every ray that leaves the scene.
        let around = !out.infinite.is_empty();
        let shining = self.emitters.iter().zip(0..).filter_map(|(of, shape)| of.map(|_| shape));
        let emitters = if around { None } else { Emitters::new(self.geometry, shining) };
        Lights {
            emitters,
            bulbs: Bulbs::new(self.geometry, &out.lights, &out.emissions),
            lights: out.lights,
            emissions: out.emissions,
            first_of_shape,
            infinite: out.infinite,
            selection,
            bounds_radius: radius,
        }
    }

    fn selection(&self, parts: &Parts) -> LightSelection {
        let usable: Vec<bool> =
            parts.lights.iter().map(|l| !matches!(l, Light::Uniform { left_to_bsdf: true, .. })).collect();
        let powers = || -> Vec<f32> {
            parts.bounds.iter().zip(&usable).map(|(b, &u)| if u { b.power } else { 0.0 }).collect()
        };
        match self.desc.integrator.light_sampler {
            LightSamplerName::Uniform => {
                let ones: Vec<f32> = powers().iter().map(|&p| if p > 0.0 { 1.0 } else { 0.0 }).collect();
                LightSelection::fixed(&ones)
            }
            LightSamplerName::Power => LightSelection::fixed(&powers()),
            LightSamplerName::Bvh => LightSelection::by_place(&parts.bounds, &usable),
        }
    }

    /// The corners of a light's portal. Where light sampling is alone it has to find what does not come through it too.
    fn portal(&self, light: &LightDesc) -> Option<[Vec3<f64>; 4]> {
        light.portal.filter(|_| self.desc.integrator.mis != Mis::LightOnly)
    }

    /// One light per primitive of an emitting shape.
    fn area_lights(&self, shape: u32, id: AreaLightId, out: &mut Parts) {
        let desc = &self.desc.area_lights[id.0 as usize];
        let emission = out.emission(&desc.radiance);
        let n = self.geometry.n_prims(shape as usize) as u32;
        let sides = if desc.two_sided { 2.0 } else { 1.0 };
        let mut scale = desc.radiance.scale;
        if let Some(power) = desc.power.filter(|p| *p > 0.0) {
            // The whole shape sends out that power.
            let area: f32 = (0..n).map(|prim| self.geometry.area(shape, prim)).sum();
            scale *= power / (sides * area * core::f32::consts::PI).max(1e-30);
        }
        let brightness = out.brightness(emission) * scale;
        for prim in 0..n {
            let (bounds, facing) = self.primitive_bounds(shape, prim);
            out.lights.push(Light::Area { shape, prim, emission, scale, two_sided: desc.two_sided });
            out.bounds.push(LightBounds {
                power: brightness * sides * self.geometry.area(shape, prim) * core::f32::consts::PI,
                bounds,
                cone: facing.map_or(Cone::ALL, |n| Cone::facing(n, desc.two_sided)),
            });
        }
    }

    /// Where a primitive lies, from a grid of its points, and its normal where that is the same everywhere.
    fn primitive_bounds(&self, shape: u32, prim: u32) -> (Aabb, Option<Vec3<f32>>) {
        let grid = [0.0, 0.25, 0.5, 0.75, 0.999_999];
        let samples: Vec<ShapeSample> = grid
            .iter()
            .flat_map(|&u| grid.map(|v| [u, v]))
            .filter_map(|u| self.geometry.sample_area(shape, prim, u))
            .collect();
        let bounds = samples.iter().fold(Aabb::EMPTY, |b, s| b.grow(s.p));
        let bounds = if bounds.is_empty() { Aabb::EMPTY.grow(vec3(0.0, 0.0, 0.0)) } else { bounds };
        let first = samples.first().map(|s| s.n);
        let flat = first.filter(|n| samples.iter().all(|s| s.n.dot(*n) > 0.9999));
        (bounds, flat)
    }

    fn other_light(&self, light: &LightDesc, radius: f32, out: &mut Parts) -> Result<(), String> {
        let four_pi = 4.0 * core::f32::consts::PI;
        let disk = core::f32::consts::PI * radius * radius;
        match &light.kind {
            LightKind::Point { intensity, power, from } => {
                let emission = out.emission(intensity);
                let scale = with_power(intensity.scale, *power, four_pi);
                let p = light.to_world.point(*from).to_f32();
                let strength = out.brightness(emission) * scale * four_pi;
                out.push(Light::Point { p, emission, scale }, strength, Aabb::EMPTY.grow(p), Cone::ALL);
            }
            LightKind::Spot { intensity, power, from, to, cone_angle, cone_delta } => {
                let emission = out.emission(intensity);
                let cos = |deg: f32| Real::cos(f64::from(deg).to_radians()) as f32;
                let (cos_end, cos_start) = (cos(*cone_angle), cos(cone_angle - cone_delta));
                let solid_angle = core::f32::consts::TAU * ((1.0 - cos_start) + (cos_start - cos_end) / 2.0);
                let scale = with_power(intensity.scale, *power, solid_angle);
                let (p, to_light) = spot_frame(&light.to_world, *from, *to);
                let strength = out.brightness(emission) * scale * solid_angle;
                let cone = spot_cone(&to_light, *cone_angle, cone_angle - cone_delta);
                let to_light = Box::new(to_light);
                out.push(
                    Light::Spot { p, to_light, cos_end, cos_start, emission, scale },
                    strength,
                    Aabb::EMPTY.grow(p),
                    cone,
                );
            }
            LightKind::Distant { radiance, illuminance, from, to } => {
                let emission = out.emission(radiance);
                let scale = with_power(radiance.scale, *illuminance, 1.0);
                let wi = light.to_world.vector(*from - *to).normalized().to_f32();
                let strength = out.brightness(emission) * scale * disk;
                out.push(Light::Distant { wi, emission, scale }, strength, Aabb::EMPTY, Cone::ALL);
            }
            LightKind::Infinite { radiance, illuminance } => {
                let emission = out.emission(radiance);
                let scale = with_power(radiance.scale, *illuminance, core::f32::consts::PI);
                let strength = out.brightness(emission) * scale * four_pi * disk;
                out.infinite.push(out.lights.len() as u32);
                let portal = self.portal(light).and_then(|p| Portal::new(p, 32, |_| 1.0)).map(Box::new);
                out.push(
                    Light::Uniform {
                        emission,
                        scale,
                        left_to_bsdf: self.compensate && portal.is_none(),
                        portal,
                    },
                    strength,
                    Aabb::EMPTY,
                    Cone::ALL,
                );
            }
            LightKind::InfiniteImage { path, scale, illuminance, color_space } => {
                let image =
                    EnvironmentImage { path, scale: *scale, illuminance: *illuminance, space: *color_space };
                let map = image.load(out.carrier)?;
                let env = Environment::new(map, &light.to_world, self.compensate, self.portal(light));
                out.infinite.push(out.lights.len() as u32);
                let strength = env.mean() * four_pi * disk;
                out.push(Light::Environment(Box::new(env)), strength, Aabb::EMPTY, Cone::ALL);
            }
        }
        Ok(())
    }
}

/// An environment map as the scene names it.
struct EnvironmentImage<'a> {
    path: &'a Path,
    scale: f32,
    illuminance: Option<f32>,
    space: ColorSpace,
}

impl EnvironmentImage<'_> {
    fn load(&self, carrier: Carrier) -> Result<EnvironmentMap, String> {
        let image = Image::read(self.path, None).map_err(|e| e.to_string())?;
        if image.width != image.height && image.width != 2 * image.height {
            return Err(format!(
                "{}: an environment map is square (equal-area) or twice as wide as high (latitude-longitude), \
                 not {} x {}; convert it",
                self.path.display(),
                image.width,
                image.height
            ));
        }
        let (n, mut rgb) = to_equal_area(&image);
        let scale = match self.illuminance.filter(|e| *e > 0.0) {
            Some(e) => self.scale * e / upper_illuminance(n, &rgb).max(1e-30),
            None => self.scale,
        };
        let colour = match carrier {
            Carrier::Rgb(space) => {
                rgb.iter_mut().for_each(|c| *c = converted(*c, self.space, space).map(|c| c.max(0.0)));
                EnvironmentColour::Rgb
            }
            Carrier::Wavelengths => {
                let illuminant = self.space.illuminant();
                let illuminant = illuminant.scaled(1.0 / photometric(illuminant));
                EnvironmentColour::Spectral { space: self.space, illuminant }
            }
        };
        Ok(EnvironmentMap { n, rgb, scale, colour })
    }
}

/// Lights in the making.
struct Parts {
    lights: Vec<Light>,
    carrier: Carrier,
    emissions: Vec<SceneSpectrum>,
    known: HashMap<String, u32>,
    bounds: Vec<LightBounds>,
    infinite: Vec<u32>,
}

impl Parts {
    /// The table of an emission; equal colours share one.
    fn emission(&mut self, e: &Emission) -> u32 {
        let key = format!("{:?}", e.spectrum);
        *self.known.entry(key).or_insert_with(|| {
            self.emissions.push(self.carrier.emission(&e.spectrum));
            self.emissions.len() as u32 - 1
        })
    }
    /// Luminance of a table.
    fn brightness(&self, emission: u32) -> f32 {
        self.carrier.luminance(&self.emissions[emission as usize])
    }
    fn push(&mut self, light: Light, power: f32, bounds: Aabb, cone: Cone) {
        self.lights.push(light);
        self.bounds.push(LightBounds { power, bounds, cone });
    }
}

/// The scale with which a light of unit scale, which sends out `unit`, sends out `power`.
fn with_power(scale: f32, power: Option<f32>, unit: f32) -> f32 {
    match power.filter(|p| *p > 0.0) {
        Some(p) => scale * p / unit.max(1e-30),
        None => scale,
    }
}

/// Place of a spot light and world to light space, where it shines along z.
fn spot_frame(to_world: &Transform, from: Vec3<f64>, to: Vec3<f64>) -> (Vec3<f32>, Transform) {
    let axis = (to - from).normalized();
    let f = Frame::from_z(axis);
    let rows = [
        [f.x.x, f.y.x, f.z.x, from.x],
        [f.x.y, f.y.y, f.z.y, from.y],
        [f.x.z, f.y.z, f.z.z, from.z],
        [0.0, 0.0, 0.0, 1.0],
    ];
    let placed = to_world.then_first(&Transform::from_rows(rows).unwrap_or_default());
    (placed.point(vec3(0.0, 0.0, 0.0)).to_f32(), placed.inverse())
}

/// Where a spot light shines: fully up to one angle, in degrees, and nowhere beyond the other.
fn spot_cone(to_light: &Transform, end: f32, start: f32) -> Cone {
    let to_world = to_light.inverse();
    let axes = [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)].map(|a| to_world.vector(a));
    let [x, y, z] = axes.map(Vec3::normalized);
    let lengths = axes.map(Vec3::length);
    let even = lengths.iter().all(|l| (l / lengths[2] - 1.0).abs() < 1e-4);
    // A map that stretches or shears bends the cone.
    if !even || [x.dot(y), y.dot(z), z.dot(x)].iter().any(|c| c.abs() > 1e-4) {
        return Cone::ALL;
    }
    let [end, start] = [end, start.max(0.0)].map(|deg| f64::from(deg).to_radians());
    Cone { axis: z, normals: start, emission: (end - start).max(0.0), two_sided: false }
}

/// Illuminance on a surface facing +z of the map, for an image of unit scale.
fn upper_illuminance(n: usize, rgb: &[[f32; 3]]) -> f32 {
    let mut sum = 0.0;
    for (i, c) in rgb.iter().enumerate() {
        let st = [((i % n) as f32 + 0.5) / n as f32, ((i / n) as f32 + 0.5) / n as f32];
        let d = sparrow_math::warp::equal_area_square_to_sphere(st);
        if d.z > 0.0 {
            sum += f64::from(d.z) * f64::from(0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]);
        }
    }
    (sum * 4.0 * core::f64::consts::PI / (n * n) as f64) as f32
}
