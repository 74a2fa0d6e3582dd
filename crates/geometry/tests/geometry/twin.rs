//! A slow, plain way to find the nearest point: every primitive, in double precision, by other formulas.

use sparrow_geometry::{Ray, Shape, ShapeInstance};
use sparrow_math::{Real, Vec3, vec3};

type V = Vec3<f64>;

/// Where the ray meets the triangle. [MollerTrumbore1997]
fn triangle(o: V, d: V, p: [V; 3]) -> Option<f64> {
    let (e1, e2) = (p[1] - p[0], p[2] - p[0]);
    let q = d.cross(e2);
    let det = e1.dot(q);
    let s = o - p[0];
    let (u, r) = (s.dot(q) / det, s.cross(e1));
    let (v, t) = (d.dot(r) / det, e2.dot(r) / det);
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}

/// Where the ray meets a bilinear patch: signs of the distance along thin strips, then halving.
fn patch(o: V, d: V, p: [V; 4]) -> Option<f64> {
    // Across the ray the patch is a map of the plane; each small cell is flat enough for two triangles.
    const N: usize = 48;
    let at = |i: usize, j: usize| {
        let (u, v) = (i as f64 / N as f64, j as f64 / N as f64);
        (p[0] * (1.0 - u) + p[1] * u) * (1.0 - v) + (p[2] * (1.0 - u) + p[3] * u) * v
    };
    let mut best: Option<f64> = None;
    for i in 0..N {
        for j in 0..N {
            let q = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
            for t in
                [triangle(o, d, [q[0], q[1], q[3]]), triangle(o, d, [q[0], q[3], q[2]])].into_iter().flatten()
            {
                best = Some(best.map_or(t, |b: f64| b.min(t)));
            }
        }
    }
    best
}

fn azimuth(p: V) -> f64 {
    let a = Real::atan2(p.y, p.x);
    if a < 0.0 { a + core::f64::consts::TAU } else { a }
}

/// Where the ray meets a quadric, by the school formula.
fn quadric(o: V, d: V, shape: &Shape) -> Option<f64> {
    let solve = |a: f64, b: f64, c: f64| {
        let q = (b * b - 4.0 * a * c).sqrt();
        [(-b - q) / (2.0 * a), (-b + q) / (2.0 * a)]
    };
    let flat = |v: V| vec3(v.x, v.y, 0.0);
    let (roots, phi_max) = match *shape {
        Shape::Sphere { radius, phi_max, .. } => {
            let r = f64::from(radius);
            (solve(d.dot(d), 2.0 * o.dot(d), o.dot(o) - r * r), phi_max)
        }
        Shape::Cylinder { radius, phi_max, .. } => {
            let (r, o, d) = (f64::from(radius), flat(o), flat(d));
            (solve(d.dot(d), 2.0 * o.dot(d), o.dot(o) - r * r), phi_max)
        }
        Shape::Disk { height, phi_max, .. } => ([(f64::from(height) - o.z) / d.z, f64::NAN], phi_max),
        Shape::Triangles(_) | Shape::Patches(_) | Shape::Curves(_) => return None,
    };
    let inside = |p: V| match *shape {
        Shape::Sphere { radius, z_min, z_max, .. } => {
            (z_min <= -radius || p.z >= z_min.into()) && (z_max >= radius || p.z <= z_max.into())
        }
        Shape::Cylinder { z_min, z_max, .. } => p.z >= z_min.into() && p.z <= z_max.into(),
        Shape::Disk { radius, inner_radius, .. } => {
            let r = flat(p).length();
            r <= radius.into() && r >= inner_radius.into()
        }
        Shape::Triangles(_) | Shape::Patches(_) | Shape::Curves(_) => false,
    };
    let whole = phi_max >= super::TAU;
    let hits =
        |t: &&f64| **t > 0.0 && inside(o + d * **t) && (whole || azimuth(o + d * **t) <= phi_max.into());
    roots.iter().find(hits).copied()
}

/// The nearest point of the ray: its parameter, shape and primitive.
pub(crate) fn nearest(shapes: &[ShapeInstance], ray: &Ray) -> Option<(f64, u32, u32)> {
    let (o, d) = (ray.o.to_f64(), ray.d.to_f64());
    let mut best: Option<(f64, u32, u32)> = None;
    let mut offer = |t: Option<f64>, shape: usize, prim: usize| {
        if let Some(t) = t
            && best.is_none_or(|b| t < b.0)
        {
            best = Some((t, shape as u32, prim as u32));
        }
    };
    for (i, s) in shapes.iter().enumerate() {
        match &s.shape {
            Shape::Triangles(m) => {
                for (j, at) in m.indices.iter().enumerate() {
                    offer(triangle(o, d, at.map(|k| Vec3::from(m.p[k as usize]).to_f64())), i, j);
                }
            }
            Shape::Patches(m) => {
                for (j, at) in m.indices.iter().enumerate() {
                    offer(patch(o, d, at.map(|k| Vec3::from(m.p[k as usize]).to_f64())), i, j);
                }
            }
            // Curves have a twin of their own.
            Shape::Curves(_) => {}
            shape @ (Shape::Sphere { .. } | Shape::Disk { .. } | Shape::Cylinder { .. }) => {
                let back = s.to_world.inverse();
                offer(quadric(back.point(o), back.vector(d), shape), i, 0);
            }
        }
    }
    best
}
