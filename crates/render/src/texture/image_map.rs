//! Images as textures: storage, pyramid, edges and filters.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use sparrow_image::{Encoding, Image};
use sparrow_math::{Real, warp};
use sparrow_scene::{ImageMap, Mapping, TextureEncoding, TextureFilter, WrapMode};

use super::TextureContext;
use super::mapping::TexCoord;

/// An image file in memory, with the coarser levels that filters need.
#[derive(Debug)]
pub(crate) struct LoadedImage {
    base: Image,
    /// Levels of half the size each, linear RGB; empty where no filter asks for them.
    levels: Vec<Level>,
}

#[derive(Debug)]
struct Level {
    width: usize,
    height: usize,
    rgb: Vec<[f32; 3]>,
}

impl LoadedImage {
    /// Memory, in bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.base.bytes() + self.levels.iter().map(|l| l.rgb.len() * 12).sum::<usize>()
    }

    fn size(&self, level: usize) -> (usize, usize) {
        match level.checked_sub(1).and_then(|l| self.levels.get(l)) {
            Some(l) => (l.width, l.height),
            None => (self.base.width, self.base.height),
        }
    }

    fn texel(&self, level: usize, x: i64, y: i64, wrap: WrapMode) -> [f32; 3] {
        let (w, h) = self.size(level);
        let Some((x, y)) = wrapped(x, y, w as i64, h as i64, wrap) else { return [0.0; 3] };
        match level.checked_sub(1).and_then(|l| self.levels.get(l)) {
            Some(l) => l.rgb[y * l.width + x],
            None => self.base.rgb(x, y),
        }
    }

    /// Box-filtered halves down to one pixel.
    fn build_levels(&mut self) {
        let (mut w, mut h) = (self.base.width, self.base.height);
        while w > 1 || h > 1 {
            let level = self.levels.len();
            let (nw, nh) = (w.div_ceil(2), h.div_ceil(2));
            let mut rgb = Vec::with_capacity(nw * nh);
            for y in 0..nh as i64 {
                for x in 0..nw as i64 {
                    let four = [(0, 0), (1, 0), (0, 1), (1, 1)]
                        .map(|(dx, dy)| self.texel(level, 2 * x + dx, 2 * y + dy, WrapMode::Clamp));
                    rgb.push(core::array::from_fn(|c| four.iter().map(|t| t[c]).sum::<f32>() * 0.25));
                }
            }
            self.levels.push(Level { width: nw, height: nh, rgb });
            (w, h) = (nw, nh);
        }
    }
}

/// The pixel that stands for (x, y); none beyond a black edge.
fn wrapped(x: i64, y: i64, w: i64, h: i64, wrap: WrapMode) -> Option<(usize, usize)> {
    let inside = x >= 0 && y >= 0 && x < w && y < h;
    let (x, y) = match wrap {
        _ if inside => (x, y),
        WrapMode::Black => return None,
        WrapMode::Repeat => (x.rem_euclid(w), y.rem_euclid(h)),
        WrapMode::Clamp => (x.clamp(0, w - 1), y.clamp(0, h - 1)),
        WrapMode::Octahedral => {
            let (mut x, mut y) = (x, y);
            if x < 0 || x >= w {
                x = if x < 0 { -x - 1 } else { 2 * w - 1 - x };
                y = h - 1 - y;
            }
            if y < 0 || y >= h {
                y = if y < 0 { -y - 1 } else { 2 * h - 1 - y };
                x = w - 1 - x;
            }
            (x.clamp(0, w - 1), y.clamp(0, h - 1))
        }
    };
    Some((x as usize, y as usize))
}

/// An image with the way it is looked up.
#[derive(Debug)]
pub(crate) struct ImageTexture {
    image: Arc<LoadedImage>,
    filter: TextureFilter,
    wrap: WrapMode,
    max_anisotropy: f32,
    scale: f32,
    invert: bool,
    mapping: Mapping,
}

impl ImageTexture {
    /// Reads the image, or takes it from those read before.
    ///
    /// # Errors
    /// A message that names the file and the fault.
    pub(crate) fn load(
        map: &ImageMap,
        loaded: &mut HashMap<(PathBuf, String), Arc<LoadedImage>>,
    ) -> Result<ImageTexture, String> {
        let encoding = match map.encoding {
            TextureEncoding::Default => None,
            TextureEncoding::Linear => Some(Encoding::Linear),
            TextureEncoding::Srgb => Some(Encoding::Srgb),
            TextureEncoding::Gamma(g) => Some(Encoding::Gamma(g)),
        };
        let pyramid = matches!(map.filter, TextureFilter::Trilinear | TextureFilter::Ewa);
        let key = (map.path.clone(), format!("{:?} {pyramid}", map.encoding));
        let image = match loaded.get(&key) {
            Some(i) => i.clone(),
            None => {
                let base = Image::read(&map.path, encoding).map_err(|e| e.to_string())?;
                let mut i = LoadedImage { base, levels: Vec::new() };
                if pyramid {
                    i.build_levels();
                }
                let i = Arc::new(i);
                loaded.insert(key, i.clone());
                i
            }
        };
        Ok(ImageTexture {
            image,
            filter: map.filter,
            wrap: map.wrap,
            max_anisotropy: map.max_anisotropy,
            scale: map.scale,
            invert: map.invert,
            mapping: map.mapping,
        })
    }

    /// Linear RGB at a point.
    pub(crate) fn rgb(&self, ctx: &TextureContext) -> [f32; 3] {
        let mut c = TexCoord::new(&self.mapping, ctx);
        // Images have their first row at the top, texture coordinates grow upwards.
        c.st[1] = 1.0 - c.st[1];
        self.lookup(&c).map(|v| {
            let v = v * self.scale;
            if self.invert { (1.0 - v).max(0.0) } else { v }
        })
    }

    /// The mean of the channels at a point.
    pub(crate) fn float(&self, ctx: &TextureContext) -> f32 {
        let [r, g, b] = self.rgb(ctx);
        (r + g + b) / 3.0
    }

    fn lookup(&self, c: &TexCoord) -> [f32; 3] {
        match self.filter {
            TextureFilter::Point => {
                let (w, h) = self.image.size(0);
                let at = |v: f32, n: usize| (v * n as f32).floor() as i64;
                self.image.texel(0, at(c.st[0], w), at(c.st[1], h), self.wrap)
            }
            TextureFilter::Bilinear => self.bilinear(0, c.st),
            TextureFilter::Trilinear => {
                let [a, b] = c.dst;
                let width = 2.0 * a[0].abs().max(a[1].abs()).max(b[0].abs()).max(b[1].abs());
                self.trilinear(width, c.st)
            }
            TextureFilter::Ewa => self.ewa(c),
        }
    }

    fn bilinear(&self, level: usize, st: [f32; 2]) -> [f32; 3] {
        let (w, h) = self.image.size(level);
        let (x, y) = (st[0] * w as f32 - 0.5, st[1] * h as f32 - 0.5);
        let (xi, yi) = (x.floor() as i64, y.floor() as i64);
        let (dx, dy) = (x - x.floor(), y - y.floor());
        let t = |i, j| self.image.texel(level, xi + i, yi + j, self.wrap);
        let (a, b, c, d) = (t(0, 0), t(1, 0), t(0, 1), t(1, 1));
        core::array::from_fn(|k| {
            (a[k] * (1.0 - dx) + b[k] * dx) * (1.0 - dy) + (c[k] * (1.0 - dx) + d[k] * dx) * dy
        })
    }

    /// The level whose pixels are `width` wide, as a fraction.
    fn level_of(&self, width: f32) -> f32 {
        let n = self.image.levels.len() as f32;
        n + Real::ln(width.max(1e-8)) * core::f32::consts::LOG2_E
    }

    fn trilinear(&self, width: f32, st: [f32; 2]) -> [f32; 3] {
        let last = self.image.levels.len();
        let level = self.level_of(width);
        if level <= 0.0 {
            return self.bilinear(0, st);
        }
        let whole = level.floor() as usize;
        if whole >= last {
            return self.bilinear(last, st);
        }
        let t = level - level.floor();
        let (a, b) = (self.bilinear(whole, st), self.bilinear(whole + 1, st));
        core::array::from_fn(|k| a[k] * (1.0 - t) + b[k] * t)
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
            return self.bilinear(0, c.st);
        }
        let level = self.level_of(short).max(0.0);
        let last = self.image.levels.len();
        if level >= last as f32 {
            return self.bilinear(last, c.st);
        }
        let (whole, t) = (level.floor() as usize, level - level.floor());
        let (a, b) = (self.ellipse(whole, c.st, major, minor), self.ellipse(whole + 1, c.st, major, minor));
        core::array::from_fn(|k| a[k] * (1.0 - t) + b[k] * t)
    }

    /// Gaussian average over the ellipse with the half axes `d0` and `d1` on one level.
    fn ellipse(&self, level: usize, st: [f32; 2], d0: [f32; 2], d1: [f32; 2]) -> [f32; 3] {
        let (w, h) = self.image.size(level);
        let size = [w as f32, h as f32];
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
        if total > 0.0 { sum.map(|v| v / total) } else { self.bilinear(level, st) }
    }
}

/// Radiance image of an environment, in the square equal-area layout.
///
/// Latitude-longitude panoramas (twice as wide as high, z up) are resampled to it, `n` by `n`.
pub(crate) fn to_equal_area(image: &Image) -> (usize, Vec<[f32; 3]>) {
    if image.width == image.height {
        let n = image.width;
        return (n, (0..n * n).map(|i| image.rgb(i % n, i / n)).collect());
    }
    let n = image.height.max(1);
    let mut rgb = Vec::with_capacity(n * n);
    for i in 0..n * n {
        // Four points per pixel, so that small bright spots are not lost.
        let mut sum = [0.0; 3];
        for (dx, dy) in [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)] {
            let st = [((i % n) as f32 + dx) / n as f32, ((i / n) as f32 + dy) / n as f32];
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
        rgb.push(sum);
    }
    (n, rgb)
}
