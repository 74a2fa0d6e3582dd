//! Cameras: from a point on the film and one on the lens to a ray.

use sparrow_geometry::Ray;
use sparrow_math::{Motion, Real, Transform, Vec3, vec3, warp};
use sparrow_scene::{CameraDesc, Projection};

/// A perspective or orthographic camera with a thin lens.
#[derive(Clone, Debug)]
pub struct Camera {
    to_world: Transform,
    /// Where it stands while nothing moves.
    frame: CameraFrame,
    motion: Option<Motion>,
    /// Motion time when the shutter opens and closes.
    shutter: [f32; 2],
    /// Film position to the plane z = 1 (perspective) or z = 0 (orthographic): offset and step per pixel.
    corner: [f32; 2],
    step: [f32; 2],
    perspective: bool,
    lens_radius: f32,
    focal_distance: f32,
}

/// Columns of the camera-to-world map, in single precision.
#[derive(Clone, Copy, Debug)]
struct CameraFrame {
    axes: [Vec3<f32>; 3],
    origin: Vec3<f32>,
}

impl CameraFrame {
    /// From rows, the translation in the fourth column.
    fn new(rows: &[[f64; 4]]) -> CameraFrame {
        let column = |j: usize| vec3(rows[0][j], rows[1][j], rows[2][j]).to_f32();
        CameraFrame { axes: [column(0), column(1), column(2)], origin: column(3) }
    }
    #[inline(always)]
    fn turn<R: Real>(&self, v: Vec3<R>) -> Vec3<R> {
        let [x, y, z] = self.axes;
        constant::<R>(x) * v.x + constant::<R>(y) * v.y + constant::<R>(z) * v.z
    }
}

/// The same number in every lane.
#[inline(always)]
fn of<R: Real>(x: f32) -> R {
    R::of(f64::from(x))
}

/// The same vector in every lane.
#[inline(always)]
fn constant<R: Real>(v: Vec3<f32>) -> Vec3<R> {
    vec3(of(v.x), of(v.y), of(v.z))
}

impl Camera {
    /// Builds the camera for a picture of `resolution` pixels. [pbrt-v4 conventions: camera x right, y up, z ahead]
    pub fn new(desc: &CameraDesc, resolution: [u32; 2]) -> Camera {
        let [width, height] = resolution.map(|r| r.max(1) as f32);
        let aspect = desc.frame_aspect.unwrap_or(width / height);
        let [x0, x1, y0, y1] = desc.screen_window.unwrap_or(if aspect > 1.0 {
            [-aspect, aspect, -1.0, 1.0]
        } else {
            [-1.0, 1.0, -1.0 / aspect, 1.0 / aspect]
        });
        let (perspective, scale) = match desc.projection {
            Projection::Perspective { fov } => (true, Real::tan(f64::from(fov).to_radians() / 2.0) as f32),
            Projection::Orthographic => (false, 1.0),
        };
        let [start, end] = desc.motion_times;
        let motion_time = |t: f32| ((f64::from(t) - start) / (end - start)).clamp(0.0, 1.0) as f32;
        Camera {
            to_world: desc.to_world,
            frame: CameraFrame::new(desc.to_world.rows()),
            motion: desc.moves_to.and_then(|end| Motion::new(&desc.to_world, &end)),
            shutter: desc.shutter.map(motion_time),
            corner: [x0 * scale, y1 * scale],
            step: [(x1 - x0) * scale / width, (y0 - y1) * scale / height],
            perspective,
            lens_radius: desc.lens_radius,
            focal_distance: desc.focal_distance,
        }
    }

    /// Camera space to world, where motion starts.
    pub fn to_world(&self) -> &Transform {
        &self.to_world
    }

    /// Camera space to the film, for column vectors (`m[row][column]`): divided by the fourth coordinate, x and y are
    /// pixels from the top left corner. z grows with depth, from 0 to 1 between 0.01 and 1000 as in pbrt-v4.
    ///
    /// Points in the plane of focus land where [`ray`](Self::ray) came from; a lens blurs the others.
    pub fn film_from_camera(&self) -> [[f64; 4]; 4] {
        let ([cx, cy], [sx, sy]) = (self.corner.map(f64::from), self.step.map(f64::from));
        let (near, far) = (1e-2, 1e3);
        let (depth, shift) = (1.0 / (far - near), near / (far - near));
        if self.perspective {
            [
                [1.0 / sx, 0.0, -cx / sx, 0.0],
                [0.0, 1.0 / sy, -cy / sy, 0.0],
                [0.0, 0.0, far * depth, -far * shift],
                [0.0, 0.0, 1.0, 0.0],
            ]
        } else {
            [
                [1.0 / sx, 0.0, 0.0, -cx / sx],
                [0.0, 1.0 / sy, 0.0, -cy / sy],
                [0.0, 0.0, depth, -shift],
                [0.0, 0.0, 0.0, 1.0],
            ]
        }
    }

    /// The motion time that a uniform number chooses while the shutter is open: 0 where motion starts, 1 where it ends.
    pub fn time(&self, u: f32) -> f32 {
        let [open, close] = self.shutter;
        open + (close - open) * u
    }

    /// The ray through `film`, in pixels from the top left corner, and the point of the lens that `lens` chooses, at a motion time.
    pub fn ray(&self, film: [f32; 2], lens: [f32; 2], time: f32) -> Ray {
        let frame = self.motion.as_ref().map(|m| CameraFrame::new(&m.at(f64::from(time))));
        let (o, d) = self.through(frame.as_ref().unwrap_or(&self.frame), film, lens);
        Ray { time, ..Ray::new(o, d) }
    }

    /// Origins and directions of [`ray`](Self::ray) for several rays, where the camera stands still.
    #[inline(always)]
    pub(crate) fn at_rest<R: Real>(&self, film: [R; 2], lens: [R; 2]) -> (Vec3<R>, Vec3<R>) {
        self.through(&self.frame, film, lens)
    }

    /// Rays depend on where they pass the lens.
    pub(crate) fn has_lens(&self) -> bool {
        self.lens_radius > 0.0
    }

    /// The camera moves.
    pub(crate) fn moves(&self) -> bool {
        self.motion.is_some()
    }

    #[inline(always)]
    fn through<R: Real>(&self, frame: &CameraFrame, film: [R; 2], lens: [R; 2]) -> (Vec3<R>, Vec3<R>) {
        let x = of::<R>(self.corner[0]) + film[0] * of(self.step[0]);
        let y = of::<R>(self.corner[1]) + film[1] * of(self.step[1]);
        let (mut o, mut d) = if self.perspective {
            (Vec3::splat(R::ZERO), vec3(x, y, R::ONE).normalized())
        } else {
            (vec3(x, y, R::ZERO), vec3(R::ZERO, R::ZERO, R::ONE))
        };
        if self.lens_radius > 0.0 {
            let [u, v] = warp::concentric_disk(lens);
            let focus = o + d * (of::<R>(self.focal_distance) / d.z);
            o += vec3(u, v, R::ZERO) * of(self.lens_radius);
            d = (focus - o).normalized();
        }
        (constant::<R>(frame.origin) + frame.turn(o), frame.turn(d).normalized())
    }

    /// How far the point `p` with normal `n` moves on its tangent plane for one pixel along x and y of the film.
    ///
    /// An estimate for points seen through any number of bounces: the pinhole camera is turned to look at `p`, as in
    /// pbrt-v4. `spacing` is the distance between samples, in pixels.
    pub fn footprint(&self, p: Vec3<f32>, n: Vec3<f32>, spacing: f32) -> [Vec3<f32>; 2] {
        let CameraFrame { axes, origin } = &self.frame;
        let to_p = p - *origin;
        let distance = to_p.length();
        let slant = (to_p.dot(n) / distance.max(1e-20)).abs().max(0.05);
        let pixel = |axis: Vec3<f32>, step: f32| {
            let size = if self.perspective { step * distance } else { step } * spacing;
            // The step in the picture plane, carried along the view direction onto the tangent plane.
            let s = axis * size;
            let view = to_p * (1.0 / distance.max(1e-20));
            s - view * (s.dot(n) / (slant * view.dot(n).signum()))
        };
        [pixel(axes[0], self.step[0]), pixel(axes[1], self.step[1])]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn desc(projection: Projection) -> CameraDesc {
        CameraDesc {
            projection,
            to_world: Transform::IDENTITY,
            moves_to: None,
            motion_times: [0.0, 1.0],
            screen_window: None,
            frame_aspect: None,
            lens_radius: 0.0,
            focal_distance: 1e6,
            shutter: [0.0, 1.0],
        }
    }

    #[test]
    fn field_of_view_spans_the_shorter_side() {
        let c = Camera::new(&desc(Projection::Perspective { fov: 90.0 }), [200, 100]);
        let top = c.ray([100.0, 0.0], [0.5; 2], 0.0);
        assert!((top.d.y - top.d.z).abs() < 1e-6 && top.d.x.abs() < 1e-6);
        let left = c.ray([0.0, 50.0], [0.5; 2], 0.0);
        assert!((left.d.x + 2.0 * left.d.z).abs() < 1e-6);
    }

    #[test]
    fn points_on_a_ray_project_back_to_its_pixel() {
        for projection in [Projection::Perspective { fov: 35.0 }, Projection::Orthographic] {
            let c = Camera::new(&desc(projection), [320, 200]);
            let m = c.film_from_camera();
            let ray = c.ray([31.5, 170.25], [0.5; 2], 0.0);
            let p = (ray.o + ray.d * 7.0).to_f64();
            let h = m.map(|r| r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3]);
            let [x, y, z] = [0, 1, 2].map(|i| h[i] / h[3]);
            assert!((x - 31.5).abs() < 1e-3 && (y - 170.25).abs() < 1e-3, "{projection:?}: {x} {y}");
            assert!(0.0 < z && z < 1.0, "{projection:?}: {z}");
        }
    }

    #[test]
    fn a_moving_camera_is_where_its_time_says() {
        let d = CameraDesc {
            moves_to: Some(Transform::translate(vec3(4.0, 0.0, 0.0))),
            motion_times: [1.0, 3.0],
            shutter: [0.0, 2.0],
            ..desc(Projection::Orthographic)
        };
        let c = Camera::new(&d, [64, 64]);
        let x = |u| c.ray([32.0, 32.0], [0.5; 2], c.time(u)).o.x;
        // Motion starts when the shutter has been open for half of its time, and is half done when it closes.
        assert!(x(0.0).abs() < 1e-6 && (x(0.5) - 1.0).abs() < 1e-6 && (x(1.0) - 2.0).abs() < 1e-6);
    }

    #[test]
    fn all_lens_points_meet_in_the_plane_of_focus() {
        let d = CameraDesc {
            lens_radius: 0.3,
            focal_distance: 4.0,
            ..desc(Projection::Perspective { fov: 50.0 })
        };
        let c = Camera::new(&d, [64, 64]);
        let at = |u| {
            let r = c.ray([10.0, 20.0], u, 0.0);
            r.o + r.d * ((4.0 - r.o.z) / r.d.z)
        };
        let p = at([0.5, 0.5]);
        for u in [[0.1, 0.2], [0.9, 0.4], [0.3, 0.99]] {
            assert!((at(u) - p).length() < 1e-5);
        }
    }
}
