//! The camera.

use sparrow_math::{Motion, Transform};

use super::Builder;
use crate::desc::{CameraDesc, Projection};
use crate::params::Params;

impl Builder {
    /// The camera, with pbrt-v4's defaults for what is not said.
    pub(super) fn make_camera(&mut self) -> CameraDesc {
        let Some(statement) = self.setup.camera.take() else {
            return CameraDesc {
                projection: Projection::Perspective { fov: 90.0 },
                to_world: Transform::IDENTITY,
                moves_to: None,
                motion_times: [0.0, 1.0],
                screen_window: None,
                frame_aspect: None,
                lens_radius: 0.0,
                focal_distance: 1e6,
                shutter: [0.0, 1.0],
            };
        };
        let p = &statement.params;
        let [start, end] = statement.ctm;
        if Motion::new(&start, &end).is_none() {
            self.report
                .error(p.at, "the camera moves from one hand to the other; mirror both transforms or none");
        }
        let projection = match statement.entity.name {
            "orthographic" => Projection::Orthographic,
            _ => Projection::Perspective { fov: self.fov(p) },
        };
        CameraDesc {
            projection,
            // The current transform takes the world to the camera.
            to_world: start.inverse(),
            moves_to: (end != start).then(|| end.inverse()),
            motion_times: self.setup.transform_times,
            screen_window: self.screen_window(p),
            frame_aspect: self.above_zero(p, "frameaspectratio"),
            lens_radius: self.lens_radius(p),
            focal_distance: self.above_zero(p, "focaldistance").unwrap_or(1e6),
            shutter: self.shutter(p),
        }
    }

    fn fov(&mut self, p: &Params) -> f32 {
        let fov = p.float_or("fov", 90.0);
        if !(fov > 0.0 && fov < 180.0) {
            self.report.error(p.place("fov"), format!("\"fov\" is {fov}; give degrees between 0 and 180"));
        }
        fov
    }

    fn screen_window(&mut self, p: &Params) -> Option<[f32; 4]> {
        let v = p.floats("screenwindow");
        if v.is_empty() {
            return None;
        }
        match *v {
            [x0, x1, y0, y1] if x0 < x1 && y0 < y1 => Some([x0, x1, y0, y1]),
            _ => {
                let message = "\"screenwindow\" is no rectangle; give x0 x1 y0 y1, ascending";
                self.report.error(p.place("screenwindow"), message);
                None
            }
        }
    }

    fn lens_radius(&mut self, p: &Params) -> f32 {
        let radius = p.float_or("lensradius", 0.0);
        if radius < 0.0 {
            self.report.error(p.place("lensradius"), format!("\"lensradius\" is {radius}; give one from 0"));
        }
        radius
    }

    fn shutter(&mut self, p: &Params) -> [f32; 2] {
        let (open, close) = (p.float_or("shutteropen", 0.0), p.float_or("shutterclose", 1.0));
        if close <= open {
            let message = format!("the shutter opens at {open} and closes at {close}; let it close later");
            let name = if p.has("shutterclose") { "shutterclose" } else { "shutteropen" };
            self.report.error(p.place(name), message);
        }
        [open, close]
    }

    /// A number above zero, where it is given.
    pub(super) fn above_zero(&mut self, p: &Params, name: &str) -> Option<f32> {
        let v = p.float(name)?;
        if v <= 0.0 {
            self.report.error(p.place(name), format!("\"{name}\" is {v}; give one above zero"));
        }
        Some(v)
    }
}
