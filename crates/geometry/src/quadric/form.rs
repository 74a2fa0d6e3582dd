//! The quadrics in object space: [`Form`].

use core::f64::consts::TAU;

use sparrow_math::{Real, Vec3, vec3};

use crate::shape::Shape;

/// A quadric around the z axis.
#[derive(Clone, Copy, Debug)]
pub(super) enum Form {
    Sphere { r: f64, z: [f64; 2], theta: [f64; 2], phi_max: f64 },
    Disk { height: f64, r: f64, inner: f64, phi_max: f64 },
    Cylinder { r: f64, z: [f64; 2], phi_max: f64 },
}

/// A point of the surface, in object space.
#[derive(Clone, Copy)]
pub(super) struct Local {
    pub(super) p: Vec3<f64>,
    /// Unit normal, `dpdu x dpdv`.
    pub(super) n: Vec3<f64>,
    pub(super) uv: [f32; 2],
    pub(super) dpdu: Vec3<f64>,
    pub(super) dpdv: Vec3<f64>,
}

/// Azimuth from x towards y, in [0, 2 pi).
fn azimuth(p: Vec3<f64>) -> f64 {
    let phi = Real::atan2(p.y, p.x);
    if phi < 0.0 { phi + TAU } else { phi }
}

/// The same as a share of `phi_max`, in single precision.
#[inline(always)]
fn share_of_turn(p: Vec3<f64>, phi_max: f64) -> f32 {
    let phi = Real::atan2(p.y as f32, p.x as f32);
    let phi = if phi < 0.0 { phi + core::f32::consts::TAU } else { phi };
    phi / phi_max as f32
}

/// The derivative of a point by that share.
#[inline(always)]
fn around(p: Vec3<f64>, phi_max: f64) -> Vec3<f64> {
    vec3(-p.y, p.x, 0.0) * phi_max
}

/// A point of a sphere, or beside it where that is a pole: there the azimuth is anyone's choice, and this is pbrt-v4's.
#[inline(always)]
fn off_pole(p: Vec3<f64>, r: f64) -> Vec3<f64> {
    let pole = p.x == 0.0 && p.y == 0.0;
    let [x, y] = if pole { [1e-5 * r, 0.0] } else { [p.x, p.y] };
    vec3(x, y, p.z)
}

/// The derivative by the first texture coordinate at a point of a whole sphere.
#[inline(always)]
pub(super) fn around_sphere(p: Vec3<f64>, r: f64) -> Vec3<f64> {
    around(off_pole(p, r), TAU)
}

/// The angle where a shape ends; whole turns are exact, so that no seam stays open.
fn full(phi_max: f32) -> f64 {
    let phi = f64::from(phi_max).clamp(0.0, TAU);
    if phi > TAU - 1e-6 { TAU } else { phi }
}

/// Solutions of `a t^2 + 2 b t + c = 0` for a quadric of radius `r`; `off2` is the squared distance of the line's
/// nearest point from the centre or axis, which keeps its digits where `b^2 - a c` does not.
fn solve(a: f64, b: f64, c: f64, r: f64, off2: f64) -> [f64; 2] {
    let disc = a * (r * r - off2);
    if disc < 0.0 || disc.is_nan() || a <= 0.0 {
        return [f64::NAN; 2];
    }
    let q = -(b + disc.sqrt().copysign(b));
    let (t0, t1) = (q / a, c / q);
    // A line through the surface along a tangent at the origin has q = 0 and both roots there.
    let t1 = if q == 0.0 { t0 } else { t1 };
    if t0 < t1 { [t0, t1] } else { [t1, t0] }
}

impl Form {
    /// `None` for meshes and where the numbers leave nothing.
    pub(super) fn of(shape: &Shape) -> Option<Form> {
        let sorted = |a: f32, b: f32| [f64::from(a.min(b)), f64::from(a.max(b))];
        let (form, extents) = match *shape {
            Shape::Triangles(_) | Shape::Patches(_) | Shape::Curves(_) => return None,
            Shape::Sphere { radius, z_min, z_max, phi_max } => {
                let (r, phi_max) = (f64::from(radius).abs(), full(phi_max));
                let z = sorted(z_min, z_max).map(|z| z.max(-r).min(r));
                let theta = z.map(|z| Real::acos(z / r));
                (Form::Sphere { r, z, theta, phi_max }, [r, z[1] - z[0], phi_max])
            }
            Shape::Disk { height, radius, inner_radius, phi_max } => {
                let (r, inner, phi_max) =
                    (f64::from(radius).abs(), f64::from(inner_radius).max(0.0), full(phi_max));
                (Form::Disk { height: height.into(), r, inner, phi_max }, [r, r - inner, phi_max])
            }
            Shape::Cylinder { radius, z_min, z_max, phi_max } => {
                let (r, z, phi_max) = (f64::from(radius).abs(), sorted(z_min, z_max), full(phi_max));
                (Form::Cylinder { r, z, phi_max }, [r, z[1] - z[0], phi_max])
            }
        };
        extents.iter().all(|e| *e > 0.0 && e.is_finite()).then_some(form)
    }
    /// The radius, if this is a sphere without cuts.
    pub(super) fn whole_radius(&self) -> Option<f64> {
        match *self {
            Form::Sphere { r, z, phi_max, .. } if z[0] <= -r && z[1] >= r && phi_max >= TAU => Some(r),
            Form::Sphere { .. } | Form::Disk { .. } | Form::Cylinder { .. } => None,
        }
    }
    pub(super) fn bounds(&self) -> (Vec3<f64>, Vec3<f64>) {
        let (r, z) = match *self {
            Form::Sphere { r, z, .. } | Form::Cylinder { r, z, .. } => (r, z),
            Form::Disk { height, r, .. } => (r, [height; 2]),
        };
        (vec3(-r, -r, z[0]), vec3(r, r, z[1]))
    }
    pub(super) fn area(&self) -> f64 {
        match *self {
            Form::Sphere { r, z, phi_max, .. } | Form::Cylinder { r, z, phi_max } => {
                phi_max * r * (z[1] - z[0])
            }
            Form::Disk { r, inner, phi_max, .. } => phi_max * 0.5 * (r * r - inner * inner),
        }
    }

    /// Where the line meets the surface without its cuts, in order; NaN where it does not.
    #[inline]
    pub(super) fn roots(&self, o: Vec3<f64>, d: Vec3<f64>) -> [f64; 2] {
        match *self {
            Form::Sphere { r, .. } => {
                let (a, b) = (d.length2(), o.dot(d));
                let off2 = (o - d * (b / a)).length2();
                let l = o.length();
                solve(a, b, (l - r) * (l + r), r, off2)
            }
            Form::Cylinder { r, .. } => {
                let (o, d) = (vec3(o.x, o.y, 0.0), vec3(d.x, d.y, 0.0));
                let (a, b) = (d.length2(), o.dot(d));
                let off2 = (o - d * (b / a)).length2();
                let l = o.length();
                solve(a, b, (l - r) * (l + r), r, off2)
            }
            Form::Disk { height, .. } => [(height - o.z) / d.z, f64::NAN],
        }
    }
    /// The cuts leave this point.
    #[inline]
    pub(super) fn covers(&self, p: Vec3<f64>) -> bool {
        let turned = |phi_max: f64| phi_max >= TAU || azimuth(p) <= phi_max;
        match *self {
            Form::Sphere { r, z, phi_max, .. } => {
                (z[0] <= -r || p.z >= z[0]) && (z[1] >= r || p.z <= z[1]) && turned(phi_max)
            }
            Form::Cylinder { z, phi_max, .. } => p.z >= z[0] && p.z <= z[1] && turned(phi_max),
            Form::Disk { r, inner, phi_max, .. } => {
                let d2 = p.x * p.x + p.y * p.y;
                d2 <= r * r && d2 >= inner * inner && turned(phi_max)
            }
        }
    }

    /// What is known of a point on the surface, or near it: it is first moved onto it, on a sphere from anywhere.
    #[inline]
    pub(super) fn local(&self, p: Vec3<f64>) -> Local {
        match *self {
            Form::Sphere { .. } => self.local_of_normal(p.normalized()),
            Form::Cylinder { r, z, phi_max } => {
                let rho = (p.x * p.x + p.y * p.y).sqrt();
                let n = vec3(p.x / rho, p.y / rho, 0.0);
                let p = vec3(n.x * r, n.y * r, p.z);
                let range = z[1] - z[0];
                let uv = [share_of_turn(p, phi_max), ((p.z - z[0]) / range) as f32];
                Local { p, n, uv, dpdu: around(p, phi_max), dpdv: vec3(0.0, 0.0, range) }
            }
            Form::Disk { height, r, inner, phi_max } => {
                let p = vec3(p.x, p.y, height);
                let rho = (p.x * p.x + p.y * p.y).sqrt();
                // In the middle the azimuth is anyone's choice.
                let out = if rho > 0.0 { vec3(p.x / rho, p.y / rho, 0.0) } else { vec3(1.0, 0.0, 0.0) };
                let u = share_of_turn(p, phi_max);
                let dpdu = vec3(-out.y, out.x, 0.0) * (phi_max * if rho > 0.0 { rho } else { 1e-5 * r });
                let uv = [u, ((r - rho) / (r - inner)) as f32];
                Local { p, n: vec3(0.0, 0.0, 1.0), uv, dpdu, dpdv: out * (inner - r) }
            }
        }
    }

    /// What is known of the point of a sphere with that unit normal; meaningless for other forms.
    #[inline]
    pub(super) fn local_of_normal(&self, n: Vec3<f64>) -> Local {
        let Form::Sphere { r, theta, phi_max, .. } = *self else {
            return Local { p: n, n, uv: [0.0; 2], dpdu: n, dpdv: n };
        };
        let p = n * r;
        let near = off_pole(p, r);
        let range = theta[1] - theta[0];
        let rho = (near.x * near.x + near.y * near.y).sqrt();
        let v = (Real::atan2(rho as f32, p.z as f32) - theta[0] as f32) / range as f32;
        let slope = p.z / rho;
        Local {
            p,
            n,
            uv: [share_of_turn(near, phi_max), v],
            dpdu: around(near, phi_max),
            dpdv: vec3(slope * near.x, slope * near.y, -rho) * range,
        }
    }

    /// Derivatives of the object-space normal by the texture coordinates.
    pub(super) fn normal_derivatives(&self, l: &Local) -> (Vec3<f64>, Vec3<f64>) {
        match *self {
            Form::Sphere { r, .. } => (l.dpdu / r, l.dpdv / r),
            Form::Cylinder { r, .. } => (l.dpdu / r, Vec3::splat(0.0)),
            Form::Disk { .. } => Default::default(),
        }
    }

    /// A point drawn uniformly by object-space area.
    pub(super) fn sample(&self, u: [f64; 2]) -> Vec3<f64> {
        let polar = |rho: f64, phi: f64| {
            let (s, c) = Real::sin_cos(phi);
            (rho * c, rho * s)
        };
        match *self {
            Form::Sphere { r, z, phi_max, .. } => {
                let z = z[0] + u[0] * (z[1] - z[0]);
                let (x, y) = polar(((r - z) * (r + z)).max(0.0).sqrt(), u[1] * phi_max);
                vec3(x, y, z)
            }
            Form::Cylinder { r, z, phi_max } => {
                let (x, y) = polar(r, u[1] * phi_max);
                vec3(x, y, z[0] + u[0] * (z[1] - z[0]))
            }
            Form::Disk { height, r, inner, phi_max } => {
                let rho = (inner * inner + u[0] * (r * r - inner * inner)).sqrt();
                let (x, y) = polar(rho.min(r), u[1] * phi_max);
                vec3(x, y, height)
            }
        }
    }
}
