//! Light sources.
//!
//! The description carries the numbers as the file gives them. What is left to the renderer, as pbrt-v4's
//! `lights.cpp` does it:
//!
//! * Every light's scale is divided by the photometric integral of its spectrum, the integral over wavelength of
//!   the spectrum times the CIE luminous efficiency; for an RGB spectrum that of the colour space's illuminant.
//! * `power` P > 0 multiplies the scale by P over the power at scale 1: `4 pi` for a point;
//!   `2 pi ((1 - cos s) + (cos s - cos e) / 2)` for a spot that begins to fall off at s and ends at e;
//!   `pi A` (twice that for two sides) for a shape of area A.
//! * `illuminance` E > 0 multiplies it by E for a distant light, by `E / pi` for a uniform infinite one, and by E
//!   over the image's own illuminance on a surface facing +z of light space for an image.

use sparrow_math::{Vec3, vec3};

use super::Builder;
use super::spectrum::Role;
use crate::desc::{AreaLightDesc, AreaLightId, Emission, LightDesc, LightKind, SpectrumDesc};
use crate::diagnostic::Span;
use crate::params::Params;
use crate::tables::{Entity, Support};

impl Builder {
    /// A light source that is no shape; its parameters have been checked.
    pub(super) fn light(&mut self, entity: &Entity, params: Params) {
        if entity.support != Support::Yes {
            return;
        }
        let kind = match entity.name {
            "point" => Some(LightKind::Point {
                intensity: self.emission(&params, "I"),
                power: positive(&params, "power"),
                from: params.triple("from").unwrap_or_default(),
            }),
            "spot" => self.spot(&params),
            "distant" => self.distant(&params),
            _ => self.infinite(&params),
        };
        let Some(kind) = kind else { return };
        let to_world = self.standing("a light", params.at);
        let portal = self.portal(&params);
        self.lights.push(LightDesc { kind, to_world, portal, at: params.at });
    }

    /// The corners of a portal; an error where they are no rectangle.
    fn portal(&mut self, params: &Params) -> Option<[Vec3<f64>; 4]> {
        let points: Vec<Vec3<f64>> =
            params.triples("portal").iter().map(|p| Vec3::from(*p).to_f64()).collect();
        if points.is_empty() {
            return None;
        }
        let rectangle = <[Vec3<f64>; 4]>::try_from(points).ok().filter(|[p0, p1, p2, p3]| {
            let (e, f) = (*p1 - *p0, *p3 - *p0);
            let size = e.length().min(f.length());
            let closed = (*p0 + *p2 - *p1 - *p3).length() <= 1e-3 * size;
            size > 0.0 && closed && e.dot(f).abs() <= 1e-3 * e.length() * f.length()
        });
        if rectangle.is_none() {
            let message = "a portal is a rectangle: give its four corners in order, in world space";
            self.report.error(params.place("portal"), message);
        }
        rectangle
    }

    /// The spectrum and scale of a light; its colour space's illuminant where no spectrum is given.
    fn emission(&mut self, params: &Params, name: &str) -> Emission {
        let spectrum = self.spectrum(params, name, Role::Illuminant);
        let white = || SpectrumDesc::Rgb([1.0; 3], params.color_space);
        Emission { spectrum: spectrum.unwrap_or_else(white), scale: params.float_or("scale", 1.0) }
    }

    fn spot(&mut self, params: &Params) -> Option<LightKind> {
        let (from, to) = self.axis(params)?;
        let cone_angle = params.float_or("coneangle", 30.0);
        let cone_delta = params.float_or("conedeltaangle", 5.0);
        if !(cone_angle > 0.0 && cone_angle <= 180.0) {
            let message = format!("\"coneangle\" is {cone_angle}; give degrees above 0, up to 180");
            self.report.error(params.place("coneangle"), message);
        }
        Some(LightKind::Spot {
            intensity: self.emission(params, "I"),
            power: positive(params, "power"),
            from,
            to,
            cone_angle,
            cone_delta,
        })
    }

    fn distant(&mut self, params: &Params) -> Option<LightKind> {
        let (from, to) = self.axis(params)?;
        let illuminance = positive(params, "illuminance");
        Some(LightKind::Distant { radiance: self.emission(params, "L"), illuminance, from, to })
    }

    /// `from` and `to`, which differ.
    fn axis(&mut self, params: &Params) -> Option<(Vec3<f64>, Vec3<f64>)> {
        let from = params.triple("from").unwrap_or_default();
        let to = params.triple("to").unwrap_or(vec3(0.0, 0.0, 1.0));
        if from != to {
            return Some((from, to));
        }
        let at = if params.has("to") { params.place("to") } else { params.place("from") };
        self.report.error(at, "\"from\" and \"to\" are the same point; move one of them");
        None
    }

    fn infinite(&mut self, params: &Params) -> Option<LightKind> {
        let illuminance = positive(params, "illuminance");
        let Some((file, file_at)) = params.text("filename").filter(|f| !f.0.is_empty()) else {
            return Some(LightKind::Infinite { radiance: self.emission(params, "L"), illuminance });
        };
        if params.has("L") {
            let message = "an infinite light has either \"L\" or \"filename\"; remove one";
            self.report.error(params.place("L"), message);
        }
        let path = self.existing(file, file_at)?;
        Some(LightKind::InfiniteImage {
            path,
            scale: params.float_or("scale", 1.0),
            illuminance,
            color_space: params.color_space,
        })
    }

    /// `AreaLightSource`: what the shapes behind it emit; its parameters have been checked.
    pub(super) fn area_light(&mut self, params: Params) {
        if params.has("L") && params.has("filename") {
            let message = "an area light has either \"L\" or \"filename\"; remove one";
            self.report.error(params.place("filename"), message);
        }
        let light = AreaLightDesc {
            radiance: self.emission(&params, "L"),
            power: positive(&params, "power"),
            two_sided: params.bool_or("twosided", false),
            at: params.at,
        };
        self.area_lights.push(light);
        self.graphics.area_light = Some(AreaLightId(self.area_lights.len() as u32 - 1));
    }

    /// Says that lights inside an object are ignored.
    pub(super) fn no_light_in_objects(&mut self, at: Span) {
        self.report
            .warn(at, "shapes of an object do not emit light, as in pbrt-v4; the area light is ignored");
    }
}

/// A quantity that counts only where it is positive, as in pbrt-v4.
fn positive(params: &Params, name: &str) -> Option<f32> {
    params.float(name).filter(|&v| v > 0.0)
}
