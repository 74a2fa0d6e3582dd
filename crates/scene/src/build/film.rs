//! The film and the pixel filter.

use std::path::PathBuf;
use std::rc::Rc;

use sparrow_spectra::{ColorSpace, Sensor};

use super::Builder;
use crate::desc::{FilmDesc, FilterDesc};
use crate::diagnostic::Span;
use crate::params::Params;
use crate::suggest::remedy;

/// More pixels than this are taken for a mistake.
const MAX_PIXELS: u64 = 1 << 30;

impl Builder {
    /// The film; its exposure is the time the shutter is open.
    pub(super) fn make_film(&mut self, shutter: [f32; 2]) -> FilmDesc {
        let nothing = || Params {
            own: Vec::new(),
            inherited: Rc::default(),
            color_space: ColorSpace::Srgb,
            broken: false,
            at: Span::default(),
        };
        let p = &self.setup.film.take().map_or_else(nothing, |s| s.params);
        let resolution = self.resolution(p);
        let white_balance = p.float_or("whitebalance", 0.0);
        FilmDesc {
            resolution,
            pixel_bounds: self.pixel_bounds(p, resolution),
            filename: p.text("filename").map(|f| f.0).filter(|f| !f.is_empty()).map(PathBuf::from),
            save_fp16: p.bool_or("savefp16", true),
            sensor: self.sensor(p),
            iso: self.above_zero(p, "iso").unwrap_or(100.0),
            exposure_time: self.above_zero(p, "exposuretime").unwrap_or(shutter[1] - shutter[0]),
            white_balance: (white_balance > 0.0).then_some(white_balance),
            max_component_value: self.above_zero(p, "maxcomponentvalue").unwrap_or(f32::INFINITY),
            diagonal: self.above_zero(p, "diagonal").unwrap_or(35.0),
            color_space: p.color_space,
            colour: self.setup.colour,
        }
    }

    fn resolution(&mut self, p: &Params) -> [u32; 2] {
        let side = |this: &mut Self, name, default| match p.int(name).unwrap_or(default) {
            n @ 1.. => n as u32,
            n => {
                this.report.error(p.place(name), format!("\"{name}\" is {n}; give at least one pixel"));
                1
            }
        };
        let [x, y] = [side(self, "xresolution", 1280), side(self, "yresolution", 720)];
        if u64::from(x) * u64::from(y) > MAX_PIXELS {
            let message = format!("the picture has {x} x {y} pixels; give at most 2^30 in all");
            self.report.error(p.place("xresolution"), message);
        }
        [x, y]
    }

    fn pixel_bounds(&mut self, p: &Params, [width, height]: [u32; 2]) -> [u32; 4] {
        let mut bounds = [0, width, 0, height];
        let name = if p.has("cropwindow") { "cropwindow" } else { "pixelbounds" };
        if p.has("cropwindow") && p.has("pixelbounds") {
            let message = "the film has \"pixelbounds\" and \"cropwindow\"; the crop window counts";
            self.report.warn(p.place("pixelbounds"), message);
        }
        match (p.floats("cropwindow"), p.ints("pixelbounds")) {
            (&[a, b, c, d], _) => {
                // pbrt-v4 rounds up at both ends, so that neighbouring windows neither overlap nor leave a gap.
                let at = |v: f32, n: u32| (v.clamp(0.0, 1.0) * n as f32).ceil() as u32;
                bounds =
                    [at(a.min(b), width), at(a.max(b), width), at(c.min(d), height), at(c.max(d), height)];
            }
            ([], &[a, b, c, d]) => {
                let within = |v: i32, n: u32| v.clamp(0, n.min(i32::MAX as u32) as i32) as u32;
                bounds = [within(a, width), within(b, width), within(c, height), within(d, height)];
                if [a, b, c, d].iter().zip(bounds).any(|(&v, b)| i64::from(v) != i64::from(b)) {
                    let message = "\"pixelbounds\" reach beyond the picture; they are cut to it";
                    self.report.warn(p.place(name), message);
                }
            }
            ([], []) => {}
            _ => self.report.error(p.place(name), format!("\"{name}\" takes four numbers; give x0 x1 y0 y1")),
        }
        if bounds[0] >= bounds[1] || bounds[2] >= bounds[3] {
            let message = format!("\"{name}\" leaves no pixel; give x0 x1 y0 y1 with x0 < x1 and y0 < y1");
            self.report.error(p.place(name), message);
        }
        bounds
    }

    fn sensor(&mut self, p: &Params) -> String {
        let (name, at) = p.text("sensor").unwrap_or(("cie1931", p.at));
        if Sensor::names().contains(&name) {
            return name.to_string();
        }
        let known = Sensor::names().iter().copied();
        self.report.error(at, format!("there is no sensor \"{name}\"; {}", remedy(name, known)));
        "cie1931".to_string()
    }

    /// The pixel filter.
    pub(super) fn make_filter(&mut self) -> FilterDesc {
        let Some(statement) = self.setup.filter.take() else {
            return FilterDesc::Gaussian { radius: [1.5, 1.5], sigma: 0.5 };
        };
        let p = &statement.params;
        let mut radius =
            |default: f32| ["xradius", "yradius"].map(|name| self.above_zero(p, name).unwrap_or(default));
        match statement.entity.name {
            "box" => FilterDesc::Box { radius: radius(0.5) },
            "triangle" => FilterDesc::Triangle { radius: radius(2.0) },
            "mitchell" => FilterDesc::Mitchell {
                radius: radius(2.0),
                b: p.float_or("B", 1.0 / 3.0),
                c: p.float_or("C", 1.0 / 3.0),
            },
            "sinc" => FilterDesc::Sinc { radius: radius(4.0), tau: self.above_zero(p, "tau").unwrap_or(3.0) },
            _ => FilterDesc::Gaussian {
                radius: radius(1.5),
                sigma: self.above_zero(p, "sigma").unwrap_or(0.5),
            },
        }
    }
}
