//! Texture coordinates.

use core::f32::consts::{FRAC_1_PI, PI};

use sparrow_math::{Real, Vec3};
use sparrow_scene::Mapping;

use super::TextureContext;

/// Texture coordinates and how they change along x and y of the film.
#[derive(Clone, Copy, Debug)]
pub(super) struct TexCoord {
    pub(super) st: [f32; 2],
    pub(super) dst: [[f32; 2]; 2],
}

impl TexCoord {
    /// The width that a texel of the level fit for them has, as a share of the image.
    pub(super) fn width(&self) -> f32 {
        let [a, b] = self.dst;
        2.0 * a[0].abs().max(a[1].abs()).max(b[0].abs()).max(b[1].abs())
    }

    pub(super) fn new(mapping: &Mapping, ctx: &TextureContext) -> TexCoord {
        match mapping {
            Mapping::Uv { scale, delta } => {
                let along = |d: [f32; 2]| [d[0] * scale[0], d[1] * scale[1]];
                TexCoord {
                    st: [ctx.uv[0] * scale[0] + delta[0], ctx.uv[1] * scale[1] + delta[1]],
                    dst: ctx.duv.map(along),
                }
            }
            Mapping::Spherical(to_texture) => by_differences(ctx, |p| {
                let v = to_texture.point(p.to_f64()).to_f32().normalized();
                [Real::acos(v.z) * FRAC_1_PI, turn(v.y, v.x)]
            }),
            Mapping::Cylindrical(to_texture) => by_differences(ctx, |p| {
                let v = to_texture.point(p.to_f64()).to_f32();
                [turn(v.y, v.x), v.z]
            }),
            Mapping::Planar { to_texture, vs, vt, delta } => by_differences(ctx, |p| {
                let v = to_texture.point(p.to_f64()).to_f32();
                [v.dot((*vs).into()) + delta[0], v.dot((*vt).into()) + delta[1]]
            }),
        }
    }
}

/// Angle of (x, y), as a share of a full turn in [0, 1).
fn turn(y: f32, x: f32) -> f32 {
    let t = Real::atan2(y, x) / (2.0 * PI);
    if t < 0.0 { t + 1.0 } else { t }
}

/// Coordinates of the point and, by differences, their change; a jump at a seam counts as none.
fn by_differences(ctx: &TextureContext, st: impl Fn(Vec3<f32>) -> [f32; 2]) -> TexCoord {
    let here = st(ctx.p);
    let step = |dp: Vec3<f32>| {
        let there = st(ctx.p + dp);
        let wrap = |d: f32| {
            if d > 0.5 {
                1.0 - d
            } else if d < -0.5 {
                -d - 1.0
            } else {
                d
            }
        };
        [wrap(there[0] - here[0]), wrap(there[1] - here[1])]
    };
    TexCoord { st: here, dst: ctx.dp.map(step) }
}
