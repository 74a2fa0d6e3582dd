//! Camera, film and filter.

use std::path::PathBuf;

use sparrow_math::Transform;
use sparrow_spectra::ColorSpace;

/// Projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Central; the field of view, in degrees, spans the shorter side of the picture.
    Perspective {
        /// Field of view, in degrees.
        fov: f32,
    },
    /// Parallel.
    Orthographic,
}

/// A camera.
#[derive(Clone, Debug)]
pub struct CameraDesc {
    /// Projection.
    pub projection: Projection,
    /// Camera space to world: camera x right, y up, z ahead, left-handed as in pbrt-v4.
    pub to_world: Transform,
    /// The same where motion ends, if the camera moves.
    pub moves_to: Option<Transform>,
    /// When motion starts and ends, in scene time; before and after everything stands still.
    pub motion_times: [f64; 2],
    /// `x0 x1 y0 y1` on the image plane; from the picture's aspect unless given.
    pub screen_window: Option<[f32; 4]>,
    /// Width over height; from the resolution unless given.
    pub frame_aspect: Option<f32>,
    /// Radius of the lens; 0 for a pinhole.
    pub lens_radius: f32,
    /// Distance of the plane in focus.
    pub focal_distance: f32,
    /// Shutter opens and closes, in scene time.
    pub shutter: [f32; 2],
}

/// What paths carry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ColourMode {
    /// Values at wavelengths of their own.
    #[default]
    Spectral,
    /// Red, green and blue of the film's colour space: quicker and less noisy, but not what light does.
    Rgb,
}

/// A film.
#[derive(Clone, Debug)]
pub struct FilmDesc {
    /// Width and height of the whole picture, in pixels.
    pub resolution: [u32; 2],
    /// The part that is rendered, `x0 x1 y0 y1` in pixels, ends excluded; from `pixelbounds` or `cropwindow`.
    pub pixel_bounds: [u32; 4],
    /// Output file named in the scene.
    pub filename: Option<PathBuf>,
    /// Half floats in the output.
    pub save_fp16: bool,
    /// Sensor name; `cie1931` unless given.
    pub sensor: String,
    /// Sensitivity.
    pub iso: f32,
    /// Exposure time, in seconds.
    pub exposure_time: f32,
    /// Colour temperature of the white point, in kelvin; none for no white balance.
    pub white_balance: Option<f32>,
    /// Samples are scaled down so that no component exceeds this.
    pub max_component_value: f32,
    /// Diagonal of the sensor, in millimetres.
    pub diagonal: f32,
    /// Colour space of the output.
    pub color_space: ColorSpace,
    /// What paths carry, from `Option "colour"`.
    pub colour: ColourMode,
}

/// A pixel filter, with its radius in pixels along x and y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FilterDesc {
    /// Constant.
    Box {
        /// Half widths.
        radius: [f32; 2],
    },
    /// Falls linearly to the edge.
    Triangle {
        /// Half widths.
        radius: [f32; 2],
    },
    /// A Gaussian, lowered to zero at the edge.
    Gaussian {
        /// Half widths.
        radius: [f32; 2],
        /// Standard deviation, in pixels.
        sigma: f32,
    },
    /// Mitchell and Netravali's cubic.
    Mitchell {
        /// Half widths.
        radius: [f32; 2],
        /// Blur.
        b: f32,
        /// Ringing.
        c: f32,
    },
    /// Sinc, windowed by the central lobe of a wider sinc.
    Sinc {
        /// Half widths.
        radius: [f32; 2],
        /// Cycles before the window ends.
        tau: f32,
    },
}
