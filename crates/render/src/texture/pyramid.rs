//! An image in memory, with the coarser levels that filters need: [`Pyramid`].

use sparrow_image::{Encoding, Image};
use sparrow_math::{MAX_WIDTH, Mask, Real};
use sparrow_scene::{ImageMap, TextureEncoding, TextureFilter, WrapMode};

use super::texels::Texels;

/// Levels of half the size each, down to one texel; only the first where no filter asks for more.
#[derive(Debug)]
pub(crate) struct Pyramid {
    levels: Vec<Texels>,
}

/// A place on a level, in texels from the middle of the first, for each lane.
struct Place<R> {
    /// The texel to the left and below, and the way from it to the next.
    whole: [[f32; MAX_WIDTH]; 2],
    part: [R; 2],
}

impl<R: Real> Place<R> {
    #[inline(always)]
    fn new(x: [R; 2]) -> Place<R> {
        let mut whole = [[0.0; MAX_WIDTH]; 2];
        let mut part = [R::ZERO; 2];
        for axis in 0..2 {
            x[axis].store(&mut whole[axis], 0);
            for v in &mut whole[axis][..R::WIDTH] {
                *v = v.floor();
            }
            // Infinity has no part, nor has what is no number.
            part[axis] = (x[axis] - R::load(&whole[axis], 0)).max(R::ZERO);
        }
        Place { whole, part }
    }
}

impl Pyramid {
    /// Reads the image of a map; `matrix` brings its colours to another space.
    ///
    /// # Errors
    /// A message that names the file and the fault.
    pub(crate) fn read(map: &ImageMap, matrix: Option<&[[f32; 3]; 3]>) -> Result<Pyramid, String> {
        let encoding = match map.encoding {
            TextureEncoding::Default => None,
            TextureEncoding::Linear => Some(Encoding::Linear),
            TextureEncoding::Srgb => Some(Encoding::Srgb),
            TextureEncoding::Gamma(g) => Some(Encoding::Gamma(g)),
        };
        let image = Image::read(&map.path, encoding).map_err(|e| e.to_string())?;
        let texels = Texels::new(&image, matrix);
        drop(image);
        Ok(Pyramid::new(texels, Pyramid::is_asked_for(map.filter)))
    }

    /// Over texels, alone or with the coarser levels.
    pub(super) fn new(texels: Texels, coarser: bool) -> Pyramid {
        let mut levels = vec![texels];
        while let Some(last) = levels.last().filter(|l| coarser && (l.width > 1 || l.height > 1)) {
            let half = last.halved();
            levels.push(half);
        }
        Pyramid { levels }
    }

    /// A filter needs the coarser levels.
    pub(crate) fn is_asked_for(filter: TextureFilter) -> bool {
        matches!(filter, TextureFilter::Trilinear | TextureFilter::Ewa)
    }

    /// Memory, in bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.levels.iter().map(Texels::bytes).sum()
    }

    /// The number of the coarsest level.
    pub(super) fn last(&self) -> usize {
        self.levels.len() - 1
    }

    /// Width and height of a level.
    pub(super) fn size(&self, level: usize) -> [f32; 2] {
        [self.levels[level].width as f32, self.levels[level].height as f32]
    }

    /// The texel at a place of a level, which may lie beyond its edges.
    #[inline]
    pub(super) fn texel(&self, level: usize, x: i64, y: i64, wrap: WrapMode) -> [f32; 3] {
        let texels = &self.levels[level];
        match wrapped(x, y, texels.width as i64, texels.height as i64, wrap) {
            Some((x, y)) => texels.rgb(x, y),
            None => [0.0; 3],
        }
    }

    /// The level whose texels are `width` wide, as a fraction.
    #[inline(always)]
    pub(super) fn level_of<R: Real>(&self, width: R) -> R {
        let ln = width.max(R::of(1e-8)).ln();
        R::of(self.last() as f64) + ln * R::of(f64::from(core::f32::consts::LOG2_E))
    }

    /// Linear between four texels of the finest level, for the first `n` lanes.
    #[inline(always)]
    pub(super) fn bilinear<R: Real>(&self, st: [R; 2], n: usize, wrap: WrapMode) -> [R; 3] {
        self.on_levels(&[0; MAX_WIDTH], st, n, wrap)
    }

    /// Linear between four texels of a level.
    pub(super) fn bilinear_on(&self, level: usize, st: [f32; 2], wrap: WrapMode) -> [f32; 3] {
        self.on_levels(&[level; MAX_WIDTH], st, 1, wrap)
    }

    /// Linear between the four texels of the two levels next to a fraction of a level.
    #[inline(always)]
    pub(super) fn trilinear<R: Real>(&self, width: R, st: [R; 2], n: usize, wrap: WrapMode) -> [R; 3] {
        let last = self.last();
        let level = self.level_of(width).max(R::ZERO).min(R::of(last as f64));
        let mut fine = [0.0; MAX_WIDTH];
        level.store(&mut fine, 0);
        let (mut finer, mut coarser) = ([0; MAX_WIDTH], [0; MAX_WIDTH]);
        for k in 0..R::WIDTH {
            fine[k] = fine[k].floor();
            finer[k] = fine[k] as usize;
            coarser[k] = (finer[k] + 1).min(last);
        }
        let t = level - R::load(&fine, 0);
        let a = self.on_levels(&finer, st, n, wrap);
        if !t.gt(R::ZERO).any() {
            return a;
        }
        let b = self.on_levels(&coarser, st, n, wrap);
        let mut rgb = a;
        for c in 0..3 {
            rgb[c] = R::select(t.gt(R::ZERO), a[c] * (R::ONE - t) + b[c] * t, a[c]);
        }
        rgb
    }

    /// Bilinear on a level of its own in each lane.
    #[inline(always)]
    fn on_levels<R: Real>(
        &self,
        levels: &[usize; MAX_WIDTH],
        st: [R; 2],
        n: usize,
        wrap: WrapMode,
    ) -> [R; 3] {
        let mut size = [[1.0; MAX_WIDTH]; 2];
        for k in 0..R::WIDTH {
            let [w, h] = self.size(levels[k]);
            (size[0][k], size[1][k]) = (w, h);
        }
        let half = R::of(0.5);
        let place = Place::new([st[0] * R::load(&size[0], 0) - half, st[1] * R::load(&size[1], 0) - half]);
        let mut texels = [[[0.0; MAX_WIDTH]; 3]; 4];
        for k in 0..n.min(R::WIDTH) {
            let [x, y] = [place.whole[0][k] as i64, place.whole[1][k] as i64];
            for (corner, (dx, dy)) in texels.iter_mut().zip([(0, 0), (1, 0), (0, 1), (1, 1)]) {
                let texel = self.texel(levels[k], x.saturating_add(dx), y.saturating_add(dy), wrap);
                (corner[0][k], corner[1][k], corner[2][k]) = (texel[0], texel[1], texel[2]);
            }
        }
        let [dx, dy] = place.part;
        let mut rgb = [R::ZERO; 3];
        for c in 0..3 {
            let (p, q) = (R::load(&texels[0][c], 0), R::load(&texels[1][c], 0));
            let (r, s) = (R::load(&texels[2][c], 0), R::load(&texels[3][c], 0));
            rgb[c] = (p * (R::ONE - dx) + q * dx) * (R::ONE - dy) + (r * (R::ONE - dx) + s * dx) * dy;
        }
        rgb
    }
}

/// The texel that stands for (x, y); none beyond a black edge.
#[inline]
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
                x = if x < 0 { -1 - x } else { (2 * w - 1).saturating_sub(x) };
                y = h - 1 - y.clamp(-h, 2 * h);
            }
            if y < 0 || y >= h {
                y = if y < 0 { -1 - y } else { (2 * h - 1).saturating_sub(y) };
                x = w - 1 - x.clamp(-w, 2 * w);
            }
            (x.clamp(0, w - 1), y.clamp(0, h - 1))
        }
    };
    Some((x as usize, y as usize))
}
