//! Images as textures: how they are looked up.

use std::sync::Arc;

use rayon::prelude::*;
use sparrow_image::Image;
use sparrow_math::{InLanes, Real, in_lanes, warp};
use sparrow_scene::{ImageMap, Mapping, TextureFilter, WrapMode};

use super::TextureContext;
use super::mapping::TexCoord;
use super::pyramid::Pyramid;
use crate::integrator::{Column, pad};

/// An image with the way it is looked up.
#[derive(Debug)]
pub(crate) struct ImageTexture {
    image: Arc<Pyramid>,
    filter: TextureFilter,
    wrap: WrapMode,
    max_anisotropy: f32,
    scale: f32,
    invert: bool,
    mapping: Mapping,
}

impl ImageTexture {
    /// How a map looks at its image.
    pub(crate) fn new(map: &ImageMap, image: Arc<Pyramid>) -> ImageTexture {
        ImageTexture {
            image,
            filter: map.filter,
            wrap: map.wrap,
            max_anisotropy: map.max_anisotropy,
            scale: map.scale,
            invert: map.invert,
            mapping: map.mapping,
        }
    }

    /// Linear RGB at a point.
    pub(crate) fn rgb(&self, ctx: &TextureContext) -> [f32; 3] {
        let c = self.coordinates(ctx);
        let rgb = match self.filter {
            TextureFilter::Point => {
                let size = self.image.size(0);
                let [x, y] = [0, 1].map(|i| (c.st[i] * size[i]).floor() as i64);
                self.image.texel(0, x, y, self.wrap)
            }
            TextureFilter::Bilinear => self.image.bilinear(c.st, 1, self.wrap),
            TextureFilter::Trilinear => self.image.trilinear(c.width(), c.st, 1, self.wrap),
            TextureFilter::Ewa => self.ewa(&c),
        };
        rgb.map(|v| self.adjusted(v))
    }

    /// [`rgb`](Self::rgb) at many points, by channels; what filters linearly does so in lanes, with the same bits.
    pub(crate) fn rgb_many(&self, contexts: &[TextureContext], rgb: &mut [Column; 3]) {
        if matches!(self.filter, TextureFilter::Point | TextureFilter::Ewa) {
            for (k, ctx) in contexts.iter().enumerate() {
                rgb.iter_mut().zip(self.rgb(ctx)).for_each(|(column, v)| column[k] = v);
            }
            return;
        }
        let mut places = Places::default();
        for (k, ctx) in contexts.iter().enumerate() {
            let c = self.coordinates(ctx);
            (places.s[k], places.t[k], places.width[k]) = (c.st[0], c.st[1], c.width());
        }
        for column in [&mut places.s, &mut places.t, &mut places.width] {
            pad(column, contexts.len());
        }
        in_lanes(Filtered { texture: self, n: contexts.len(), places: &places, rgb });
    }

    /// The mean of the channels at a point.
    pub(crate) fn float(&self, ctx: &TextureContext) -> f32 {
        mean(self.rgb(ctx))
    }

    /// [`float`](Self::float) at many points.
    pub(crate) fn float_many(&self, contexts: &[TextureContext], out: &mut Column) {
        let mut rgb = [Column::default(); 3];
        self.rgb_many(contexts, &mut rgb);
        (0..contexts.len()).for_each(|k| out[k] = mean([rgb[0][k], rgb[1][k], rgb[2][k]]));
    }

    /// Images have their first row at the top, texture coordinates grow upwards.
    fn coordinates(&self, ctx: &TextureContext) -> TexCoord {
        let mut c = TexCoord::new(&self.mapping, ctx);
        c.st[1] = 1.0 - c.st[1];
        c
    }

    /// A number of the image with the map's scale and inversion.
    #[inline(always)]
    fn adjusted<R: Real>(&self, v: R) -> R {
        let v = v * R::of(f64::from(self.scale));
        if self.invert { (R::ONE - v).max(R::ZERO) } else { v }
    }

    /// Elliptically weighted average. [Heckbert1989, sec. 3.5.8]
    fn ewa(&self, c: &TexCoord) -> [f32; 3] {
        let [mut major, mut minor] = c.dst;
        let len2 = |d: [f32; 2]| d[0] * d[0] + d[1] * d[1];
        if len2(major) < len2(minor) {
            core::mem::swap(&mut major, &mut minor);
        }
        let (long, mut short) = (len2(major).sqrt(), len2(minor).sqrt());
        if short * self.max_anisotropy < long && short > 0.0 {
            let s = long / (short * self.max_anisotropy);
            minor = minor.map(|v| v * s);
            short *= s;
        }
        if short <= 0.0 {
            return self.image.bilinear(c.st, 1, self.wrap);
        }
        let level = self.image.level_of(short).max(0.0);
        let last = self.image.last();
        if level >= last as f32 {
            return self.image.bilinear_on(last, c.st, self.wrap);
        }
        let (whole, t) = (level.floor() as usize, level - level.floor());
        let (a, b) = (self.ellipse(whole, c.st, major, minor), self.ellipse(whole + 1, c.st, major, minor));
        core::array::from_fn(|k| a[k] * (1.0 - t) + b[k] * t)
    }

    /// Gaussian average over the ellipse with the half axes `d0` and `d1` on one level.
    fn ellipse(&self, level: usize, st: [f32; 2], d0: [f32; 2], d1: [f32; 2]) -> [f32; 3] {
        let size = self.image.size(level);
        let p = [st[0] * size[0] - 0.5, st[1] * size[1] - 0.5];
        let d0 = [d0[0] * size[0], d0[1] * size[1]];
        let d1 = [d1[0] * size[0], d1[1] * size[1]];
        let a = d0[1] * d0[1] + d1[1] * d1[1] + 1.0;
        let b = -2.0 * (d0[0] * d0[1] + d1[0] * d1[1]);
        let cc = d0[0] * d0[0] + d1[0] * d1[0] + 1.0;
        let inv_f = 1.0 / (a * cc - b * b * 0.25);
        let (a, b, cc) = (a * inv_f, b * inv_f, cc * inv_f);
        let det = 4.0 * a * cc - b * b;
        let (ru, rv) = (2.0 * (det * cc).sqrt() / det, 2.0 * (a * det).sqrt() / det);
        let (mut sum, mut total) = ([0.0; 3], 0.0);
        // e^-2 at the rim, taken off so that the weight falls to zero there.
        let rim = Real::exp(-2.0f32);
        for y in (p[1] - rv).ceil() as i64..=(p[1] + rv).floor() as i64 {
            for x in (p[0] - ru).ceil() as i64..=(p[0] + ru).floor() as i64 {
                let (s, t) = (x as f32 - p[0], y as f32 - p[1]);
                let r2 = a * s * s + b * s * t + cc * t * t;
                if r2 < 1.0 {
                    let weight = Real::exp(-2.0 * r2) - rim;
                    let texel = self.image.texel(level, x, y, self.wrap);
                    for k in 0..3 {
                        sum[k] += weight * texel[k];
                    }
                    total += weight;
                }
            }
        }
        if total > 0.0 { sum.map(|v| v / total) } else { self.image.bilinear_on(level, st, self.wrap) }
    }
}

/// The grey of a colour: the mean of its channels.
fn mean([r, g, b]: [f32; 3]) -> f32 {
    (r + g + b) / 3.0
}

/// Texture coordinates of many points, and how wide a texel may be there.
#[derive(Default)]
struct Places {
    s: Column,
    t: Column,
    width: Column,
}

/// Looks up `n` places of a texture that filters linearly.
struct Filtered<'a> {
    texture: &'a ImageTexture,
    n: usize,
    places: &'a Places,
    rgb: &'a mut [Column; 3],
}

impl InLanes for Filtered<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Filtered { texture, n, places: Places { s, t, width }, rgb } = self;
        let (image, wrap) = (&*texture.image, texture.wrap);
        for k in (0..n).step_by(R::WIDTH) {
            let st = [R::load(&s[..], k), R::load(&t[..], k)];
            let found = match texture.filter {
                TextureFilter::Trilinear => image.trilinear(R::load(&width[..], k), st, n - k, wrap),
                TextureFilter::Point | TextureFilter::Bilinear | TextureFilter::Ewa => {
                    image.bilinear(st, n - k, wrap)
                }
            };
            for c in 0..3 {
                texture.adjusted(found[c]).store(&mut rgb[c][..], k);
            }
        }
    }
}

/// Radiance image of an environment, in the square equal-area layout.
///
/// Latitude-longitude panoramas (twice as wide as high, z up) are resampled to it, `n` by `n`.
pub(crate) fn to_equal_area(image: &Image) -> (usize, Vec<[f32; 3]>) {
    let n = if image.width == image.height { image.width } else { image.height.max(1) };
    let pixel = |i: usize| {
        if image.width == image.height {
            image.rgb(i % n, i / n)
        } else {
            from_panorama(image, n, [i % n, i / n])
        }
    };
    (n, (0..n * n).into_par_iter().map(pixel).collect())
}

/// A pixel of the square layout from a panorama: four points, so that small bright spots are not lost.
fn from_panorama(image: &Image, n: usize, [x, y]: [usize; 2]) -> [f32; 3] {
    let mut sum = [0.0; 3];
    for (dx, dy) in [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)] {
        let st = [(x as f32 + dx) / n as f32, (y as f32 + dy) / n as f32];
        let d = warp::equal_area_square_to_sphere(st);
        let u = Real::atan2(d.y, d.x) / (2.0 * core::f32::consts::PI);
        let u = if u < 0.0 { u + 1.0 } else { u };
        let v = Real::acos(d.z) * core::f32::consts::FRAC_1_PI;
        let x = ((u * image.width as f32) as usize).min(image.width - 1);
        let y = ((v * image.height as f32) as usize).min(image.height - 1);
        let t = image.rgb(x, y);
        for k in 0..3 {
            sum[k] += 0.25 * t[k];
        }
    }
    sum
}
