//! Textures: values that vary over a surface.

mod image_map;
mod mapping;
mod pyramid;
#[cfg(test)]
mod tests;
mod texels;

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use sparrow_math::{Transform, Vec3};
use sparrow_scene::{
    FloatTexture, FloatTextureId, ImageMap, Mapping, SceneDesc, SpectrumTexture, SpectrumTextureId,
};
use sparrow_spectra::{ColorSpace, N_LAMBDA, RgbRole, Spectrum, Wavelengths};

use image_map::ImageTexture;
pub(crate) use image_map::to_equal_area;
use mapping::TexCoord;
use pyramid::Pyramid;

use crate::colour::Carrier;
use crate::integrator::Column;
use crate::spectrum::SceneSpectrum;

/// Where a texture is evaluated.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TextureContext {
    /// Point, in world space.
    pub(crate) p: Vec3<f32>,
    /// The shape's own coordinates.
    pub(crate) uv: [f32; 2],
    /// Change of the point for one step along x and y of the film.
    pub(crate) dp: [Vec3<f32>; 2],
    /// Change of (u, v) for one step along x and y of the film.
    pub(crate) duv: [[f32; 2]; 2],
}

#[derive(Debug)]
enum FloatNode {
    Constant(f32),
    Scale(FloatTextureId, FloatTextureId),
    Mix([FloatTextureId; 3]),
    Image(ImageTexture),
    Checkerboard(Checkerboard, [FloatTextureId; 2]),
}

#[derive(Debug)]
enum SpectrumNode {
    Constant(SceneSpectrum),
    Scale(SpectrumTextureId, FloatTextureId),
    Mix(SpectrumTextureId, SpectrumTextureId, FloatTextureId),
    Image(ImageTexture, ColorSpace, RgbRole),
    Checkerboard(Checkerboard, [SpectrumTextureId; 2]),
}

/// Which of two textures shows at a point.
#[derive(Debug)]
enum Checkerboard {
    Plane(Mapping),
    Space(Transform),
}

impl Checkerboard {
    /// 0 or 1: the parity of the cell.
    fn cell(&self, ctx: &TextureContext) -> usize {
        let odd = match self {
            Checkerboard::Plane(mapping) => {
                let st = TexCoord::new(mapping, ctx).st;
                (st[0].floor() as i64).wrapping_add(st[1].floor() as i64)
            }
            Checkerboard::Space(to_texture) => {
                let p = to_texture.point(ctx.p.to_f64());
                (p.x.floor() as i64).wrapping_add(p.y.floor() as i64).wrapping_add(p.z.floor() as i64)
            }
        };
        (odd & 1) as usize
    }
}

/// All textures of a scene, in flat arrays.
#[derive(Debug)]
pub(crate) struct Textures {
    carrier: Carrier,
    floats: Vec<FloatNode>,
    spectra: Vec<SpectrumNode>,
    /// Copies of spectral textures that a second role needed: (texture, role) to index.
    roles: HashMap<(u32, RgbRole), SpectrumTextureId>,
    images: HashMap<ImageKey, Arc<Pyramid>>,
}

/// What tells images in memory apart: the file, its encoding in words, whether there are coarser levels, and the space that its colours
/// were brought from.
type ImageKey = (PathBuf, String, bool, Option<ColorSpace>);

impl Textures {
    /// Builds the scalar textures; spectral ones follow on demand, because what RGB means depends on their use.
    ///
    /// # Errors
    /// Images that cannot be read, one message each.
    pub(crate) fn new(desc: &SceneDesc, faults: &mut Vec<String>) -> Textures {
        let mut t = Textures {
            carrier: Carrier::new(&desc.film),
            floats: Vec::new(),
            spectra: Vec::new(),
            roles: HashMap::new(),
            images: HashMap::new(),
        };
        for tex in &desc.float_textures {
            let node = match tex {
                FloatTexture::Constant(v) => FloatNode::Constant(*v),
                FloatTexture::Scale(a, b) => FloatNode::Scale(*a, *b),
                FloatTexture::Mix { a, b, amount } => FloatNode::Mix([*a, *b, *amount]),
                FloatTexture::Image(map) => match t.image(map, None) {
                    Ok(image) => FloatNode::Image(image),
                    Err(e) => {
                        faults.push(e);
                        FloatNode::Constant(0.0)
                    }
                },
                FloatTexture::Checkerboard { dimension, mapping, to_texture, tex } => {
                    FloatNode::Checkerboard(checkerboard(*dimension, mapping, to_texture), *tex)
                }
            };
            t.floats.push(node);
        }
        t
    }

    /// Builds the spectral texture `id` for the given meaning of RGB values and returns where it lies.
    pub(crate) fn spectrum(
        &mut self,
        desc: &SceneDesc,
        id: SpectrumTextureId,
        role: RgbRole,
        faults: &mut Vec<String>,
    ) -> SpectrumTextureId {
        if let Some(&done) = self.roles.get(&(id.0, role)) {
            return done;
        }
        let node = match &desc.spectrum_textures[id.0 as usize] {
            SpectrumTexture::Constant(s) => SpectrumNode::Constant(self.carrier.spectrum(s, role)),
            SpectrumTexture::Scale(a, f) => SpectrumNode::Scale(self.spectrum(desc, *a, role, faults), *f),
            SpectrumTexture::Mix { a, b, amount } => SpectrumNode::Mix(
                self.spectrum(desc, *a, role, faults),
                self.spectrum(desc, *b, role, faults),
                *amount,
            ),
            SpectrumTexture::Image(map, space) => {
                // What is taken from one is not the same in another space.
                let carried = self.carrier.space().filter(|own| own != space && !map.invert);
                match self.image(map, carried.map(|own| (*space, own))) {
                    Ok(image) => SpectrumNode::Image(image, carried.unwrap_or(*space), role),
                    Err(e) => {
                        faults.push(e);
                        SpectrumNode::Constant(SceneSpectrum::Constant(0.0))
                    }
                }
            }
            SpectrumTexture::Checkerboard { dimension, mapping, to_texture, tex } => {
                let pair = tex.map(|t| self.spectrum(desc, t, role, faults));
                SpectrumNode::Checkerboard(checkerboard(*dimension, mapping, to_texture), pair)
            }
        };
        let here = SpectrumTextureId(self.spectra.len() as u32);
        self.spectra.push(node);
        self.roles.insert((id.0, role), here);
        here
    }

    /// Reads the image of a map, or takes it from those read before; `spaces` are those of its colours and those wanted.
    ///
    /// # Errors
    /// A message that names the file and the fault.
    fn image(
        &mut self,
        map: &ImageMap,
        spaces: Option<(ColorSpace, ColorSpace)>,
    ) -> Result<ImageTexture, String> {
        let (encoding, coarser) = (format!("{:?}", map.encoding), Pyramid::is_asked_for(map.filter));
        let key = (map.path.clone(), encoding, coarser, spaces.map(|(from, _)| from));
        let image = match self.images.get(&key) {
            Some(image) => image.clone(),
            None => {
                let matrix = spaces.map(|(from, to)| from.to_space(to));
                let image = Arc::new(Pyramid::read(map, matrix.as_ref())?);
                self.images.insert(key, image.clone());
                image
            }
        };
        Ok(ImageTexture::new(map, image))
    }

    /// Value of the scalar texture `id`.
    pub(crate) fn float(&self, id: FloatTextureId, ctx: &TextureContext) -> f32 {
        match &self.floats[id.0 as usize] {
            FloatNode::Constant(v) => *v,
            FloatNode::Scale(a, b) => self.float(*a, ctx) * self.float(*b, ctx),
            FloatNode::Mix([a, b, amount]) => {
                let t = self.float(*amount, ctx);
                (1.0 - t) * self.float(*a, ctx) + t * self.float(*b, ctx)
            }
            FloatNode::Image(image) => image.float(ctx),
            FloatNode::Checkerboard(board, tex) => self.float(tex[board.cell(ctx)], ctx),
        }
    }

    /// Value of the spectral texture `id`, as [`Textures::spectrum`] returned it.
    pub(crate) fn value(
        &self,
        id: SpectrumTextureId,
        ctx: &TextureContext,
        w: &Wavelengths,
    ) -> Spectrum<f32> {
        match &self.spectra[id.0 as usize] {
            SpectrumNode::Constant(s) => s.at(w),
            SpectrumNode::Scale(a, f) => self.value(*a, ctx, w) * self.float(*f, ctx),
            SpectrumNode::Mix(a, b, amount) => {
                let t = self.float(*amount, ctx);
                self.value(*a, ctx, w) * (1.0 - t) + self.value(*b, ctx, w) * t
            }
            SpectrumNode::Image(image, space, role) => {
                self.carrier.of_image(image.rgb(ctx), *space, *role, w)
            }
            SpectrumNode::Checkerboard(board, tex) => self.value(tex[board.cell(ctx)], ctx, w),
        }
    }

    /// [`float`](Self::float) at many points; images that filter linearly are looked up in lanes.
    pub(crate) fn float_many(&self, id: FloatTextureId, contexts: &[TextureContext], out: &mut Column) {
        match &self.floats[id.0 as usize] {
            FloatNode::Image(image) => image.float_many(contexts, out),
            FloatNode::Constant(_)
            | FloatNode::Scale(..)
            | FloatNode::Mix(_)
            | FloatNode::Checkerboard(..) => {
                contexts.iter().enumerate().for_each(|(k, ctx)| out[k] = self.float(id, ctx));
            }
        }
    }

    /// [`value`](Self::value) at many points; images that filter linearly are looked up in lanes.
    pub(crate) fn value_many(
        &self,
        id: SpectrumTextureId,
        contexts: &[TextureContext],
        w: &[Wavelengths],
        out: &mut [Column; N_LAMBDA],
    ) {
        let mut put = |k: usize, s: Spectrum<f32>| out.iter_mut().zip(s.0).for_each(|(c, v)| c[k] = v);
        if let SpectrumNode::Image(image, space, role) = &self.spectra[id.0 as usize] {
            let mut rgb = [Column::default(); 3];
            image.rgb_many(contexts, &mut rgb);
            for (k, w) in w.iter().enumerate() {
                put(k, self.carrier.of_image([rgb[0][k], rgb[1][k], rgb[2][k]], *space, *role, w));
            }
            return;
        }
        contexts.iter().zip(w).enumerate().for_each(|(k, (ctx, w))| put(k, self.value(id, ctx, w)));
    }

    /// The number of a texture that is the same everywhere.
    pub(crate) fn constant_float(&self, id: FloatTextureId) -> Option<f32> {
        match &self.floats[id.0 as usize] {
            FloatNode::Constant(v) => Some(*v),
            FloatNode::Scale(a, b) => Some(self.constant_float(*a)? * self.constant_float(*b)?),
            FloatNode::Mix(_) | FloatNode::Image(_) | FloatNode::Checkerboard(..) => None,
        }
    }

    /// The spectrum of a texture that is the same everywhere.
    pub(crate) fn constant_spectrum(&self, id: SpectrumTextureId) -> Option<SceneSpectrum> {
        match &self.spectra[id.0 as usize] {
            SpectrumNode::Constant(s) => Some(s.clone()),
            SpectrumNode::Scale(a, f) => Some(self.constant_spectrum(*a)?.scaled(self.constant_float(*f)?)),
            SpectrumNode::Mix(..) | SpectrumNode::Image(..) | SpectrumNode::Checkerboard(..) => None,
        }
    }

    /// Memory of all images, in bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.images.values().map(|i| i.bytes()).sum()
    }
}

fn checkerboard(dimension: u32, mapping: &Mapping, to_texture: &Transform) -> Checkerboard {
    if dimension == 3 { Checkerboard::Space(*to_texture) } else { Checkerboard::Plane(*mapping) }
}
