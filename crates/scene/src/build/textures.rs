//! Textures, made once all statements are read.

use std::collections::HashMap;

use sparrow_math::{Transform, vec3};

use super::Builder;
use super::spectrum::{Role, SPECTRUM_TYPES};
use crate::desc::{
    FloatTexture, FloatTextureId, ImageMap, Mapping, SpectrumDesc, SpectrumTexture, SpectrumTextureId,
    TextureEncoding, TextureFilter, WrapMode,
};
use crate::diagnostic::Span;
use crate::params::Params;
use crate::suggest::remedy;
use crate::tables::{Category, Entity, Support, Type};

/// A `Texture` statement, its parameters checked.
#[derive(Debug)]
pub(super) struct PendingTexture {
    pub(super) name: String,
    pub(super) name_at: Span,
    pub(super) category: Category,
    pub(super) entity: &'static Entity,
    pub(super) params: Params,
    pub(super) to_world: Transform,
}

/// The textures made so far, and their names; `None` for those that could not be made.
#[derive(Debug, Default)]
pub(super) struct Textures {
    pub(super) floats: Vec<FloatTexture>,
    pub(super) spectra: Vec<SpectrumTexture>,
    float_names: HashMap<String, Option<FloatTextureId>>,
    spectrum_names: HashMap<String, Option<SpectrumTextureId>>,
    /// Constants by their bits, so that equal ones are stored once.
    constants: HashMap<u32, FloatTextureId>,
}

impl Textures {
    /// Notes a texture that could not be made, so that its uses bring no second message.
    pub(super) fn failed(&mut self, category: Category, name: String) {
        if category == Category::FloatTexture {
            self.float_names.insert(name, None);
        } else {
            self.spectrum_names.insert(name, None);
        }
    }
    fn add_float(&mut self, t: FloatTexture) -> FloatTextureId {
        self.floats.push(t);
        FloatTextureId(self.floats.len() as u32 - 1)
    }
    /// Adds a spectral texture.
    pub(super) fn add_spectrum(&mut self, t: SpectrumTexture) -> SpectrumTextureId {
        self.spectra.push(t);
        SpectrumTextureId(self.spectra.len() as u32 - 1)
    }
    /// A constant scalar texture.
    pub(super) fn constant(&mut self, v: f32) -> FloatTextureId {
        match self.constants.get(&v.to_bits()) {
            Some(&id) => id,
            None => {
                let id = self.add_float(FloatTexture::Constant(v));
                self.constants.insert(v.to_bits(), id);
                id
            }
        }
    }
    /// A spectral texture with one value at all wavelengths.
    pub(super) fn grey(&mut self, v: f32) -> SpectrumTextureId {
        self.add_spectrum(SpectrumTexture::Constant(SpectrumDesc::Constant(v)))
    }
}

impl Builder {
    /// Makes all textures: images first, then the others in file order, each seeing those before it.
    pub(super) fn make_textures(&mut self) {
        let (images, others): (Vec<_>, Vec<_>) =
            std::mem::take(&mut self.textures).into_iter().partition(|t| t.entity.name == "imagemap");
        for t in images.into_iter().chain(others) {
            if t.category == Category::FloatTexture {
                let id = self.float_texture(&t).map(|made| self.made.add_float(made));
                self.made.float_names.insert(t.name, id);
            } else {
                let id = self.spectrum_texture(&t).map(|made| self.made.add_spectrum(made));
                self.made.spectrum_names.insert(t.name, id);
            }
        }
    }

    fn float_texture(&mut self, t: &PendingTexture) -> Option<FloatTexture> {
        if t.entity.support != Support::Yes {
            return Some(FloatTexture::Constant(stand_in(t.entity)));
        }
        let p = &t.params;
        Some(match t.entity.name {
            "constant" => FloatTexture::Constant(p.float_or("value", 1.0)),
            "scale" => {
                FloatTexture::Scale(self.float_param(p, "tex", 1.0), self.float_param(p, "scale", 1.0))
            }
            "mix" => FloatTexture::Mix {
                a: self.float_param(p, "tex1", 0.0),
                b: self.float_param(p, "tex2", 1.0),
                amount: self.float_param(p, "amount", 0.5),
            },
            "imagemap" => FloatTexture::Image(self.image_map(t)?),
            _ => FloatTexture::Checkerboard {
                dimension: self.dimension(p)?,
                mapping: self.mapping(t)?,
                to_texture: t.to_world.inverse(),
                tex: [self.float_param(p, "tex1", 1.0), self.float_param(p, "tex2", 0.0)],
            },
        })
    }

    fn spectrum_texture(&mut self, t: &PendingTexture) -> Option<SpectrumTexture> {
        if t.entity.support != Support::Yes {
            return Some(SpectrumTexture::Constant(SpectrumDesc::Constant(stand_in(t.entity))));
        }
        let p = &t.params;
        Some(match t.entity.name {
            "constant" => {
                let value = self.spectrum(p, "value", Role::Unbounded);
                SpectrumTexture::Constant(value.unwrap_or(SpectrumDesc::Constant(1.0)))
            }
            "scale" => {
                let tex = self.spectrum_param(p, "tex", Role::Unbounded, 1.0);
                SpectrumTexture::Scale(tex, self.float_param(p, "scale", 1.0))
            }
            "mix" => SpectrumTexture::Mix {
                a: self.spectrum_param(p, "tex1", Role::Unbounded, 0.0),
                b: self.spectrum_param(p, "tex2", Role::Unbounded, 1.0),
                amount: self.float_param(p, "amount", 0.5),
            },
            "imagemap" => SpectrumTexture::Image(self.image_map(t)?, p.color_space),
            _ => SpectrumTexture::Checkerboard {
                dimension: self.dimension(p)?,
                mapping: self.mapping(t)?,
                to_texture: t.to_world.inverse(),
                tex: [
                    self.spectrum_param(p, "tex1", Role::Unbounded, 1.0),
                    self.spectrum_param(p, "tex2", Role::Unbounded, 0.0),
                ],
            },
        })
    }

    fn dimension(&mut self, p: &Params) -> Option<u32> {
        match p.int("dimension").unwrap_or(2) {
            d @ (2 | 3) => Some(d as u32),
            d => {
                self.report.error(p.place("dimension"), format!("\"dimension\" is {d}; give 2 or 3"));
                None
            }
        }
    }

    fn mapping(&mut self, t: &PendingTexture) -> Option<Mapping> {
        const NAMES: [&str; 4] = ["uv", "spherical", "cylindrical", "planar"];
        let p = &t.params;
        let (name, at) = p.text("mapping").unwrap_or(("uv", t.params.at));
        let to_texture = t.to_world.inverse();
        let delta = [p.float_or("udelta", 0.0), p.float_or("vdelta", 0.0)];
        let vector = |name, default| {
            let v = p.triple(name).unwrap_or(default);
            [v.x as f32, v.y as f32, v.z as f32]
        };
        match name {
            "uv" => {
                Some(Mapping::Uv { scale: [p.float_or("uscale", 1.0), p.float_or("vscale", 1.0)], delta })
            }
            "spherical" => Some(Mapping::Spherical(to_texture)),
            "cylindrical" => Some(Mapping::Cylindrical(to_texture)),
            "planar" => Some(Mapping::Planar {
                to_texture,
                vs: vector("v1", vec3(1.0, 0.0, 0.0)),
                vt: vector("v2", vec3(0.0, 1.0, 0.0)),
                delta,
            }),
            _ => {
                self.report.error(at, format!("there is no mapping \"{name}\"; {}", remedy(name, NAMES)));
                None
            }
        }
    }

    fn image_map(&mut self, t: &PendingTexture) -> Option<ImageMap> {
        let p = &t.params;
        let Some((file, file_at)) = p.text("filename") else {
            self.report.error(p.at, "the image texture names no file; add \"string filename\" \"...\"");
            return None;
        };
        let path = self.existing(file, file_at);
        let filters = [
            ("point", TextureFilter::Point),
            ("bilinear", TextureFilter::Bilinear),
            ("trilinear", TextureFilter::Trilinear),
            ("ewa", TextureFilter::Ewa),
            ("EWA", TextureFilter::Ewa),
        ];
        let wraps = [
            ("repeat", WrapMode::Repeat),
            ("black", WrapMode::Black),
            ("clamp", WrapMode::Clamp),
            ("octahedralsphere", WrapMode::Octahedral),
        ];
        let (filter, wrap) =
            (self.choice(p, "filter", &filters, "bilinear"), self.choice(p, "wrap", &wraps, "repeat"));
        let (mapping, encoding) = (self.mapping(t), self.encoding(p));
        Some(ImageMap {
            path: path?,
            filter: filter?,
            wrap: wrap?,
            max_anisotropy: p.float_or("maxanisotropy", 8.0),
            encoding: encoding?,
            scale: p.float_or("scale", 1.0),
            invert: p.bool_or("invert", false),
            mapping: mapping?,
            at: p.at,
        })
    }

    /// One of a list of names.
    pub(super) fn choice<T: Copy>(
        &mut self,
        p: &Params,
        param: &str,
        names: &[(&'static str, T)],
        default: &'static str,
    ) -> Option<T> {
        let (name, at) = p.text(param).unwrap_or((default, p.at));
        let found = names.iter().find(|(n, _)| *n == name).map(|&(_, v)| v);
        if found.is_none() {
            let remedy = remedy(name, names.iter().map(|n| n.0));
            self.report.error(at, format!("\"{param}\" cannot be \"{name}\"; {remedy}"));
        }
        found
    }

    fn encoding(&mut self, p: &Params) -> Option<TextureEncoding> {
        let Some((name, at)) = p.text("encoding") else { return Some(TextureEncoding::Default) };
        match name.split_once(' ') {
            None if name.eq_ignore_ascii_case("srgb") => return Some(TextureEncoding::Srgb),
            None if name == "linear" => return Some(TextureEncoding::Linear),
            Some(("gamma", g)) => {
                if let Some(g) = g.trim().parse().ok().filter(|g: &f32| *g > 0.0 && g.is_finite()) {
                    return Some(TextureEncoding::Gamma(g));
                }
            }
            _ => {}
        }
        let message =
            format!("\"encoding\" cannot be \"{name}\"; write \"sRGB\", \"linear\" or \"gamma 2.2\"");
        self.report.error(at, message);
        None
    }

    /// A scalar parameter: a texture, or a constant.
    pub(super) fn float_param(&mut self, p: &Params, name: &str, default: f32) -> FloatTextureId {
        match self.float_param_given(p, name) {
            Some(id) => id,
            None => self.made.constant(default),
        }
    }

    /// A scalar parameter, where it is given.
    pub(super) fn float_param_given(&mut self, p: &Params, name: &str) -> Option<FloatTextureId> {
        let values = &p.find(name, &[Type::Float, Type::Texture])?.values;
        if let Some((texture, at)) = values.texts().first() {
            return self.float_named(texture, *at);
        }
        values.floats().first().map(|&v| self.made.constant(v))
    }

    /// The scalar texture of a name.
    pub(super) fn float_named(&mut self, name: &str, at: Span) -> Option<FloatTextureId> {
        if let Some(id) = self.made.float_names.get(name) {
            return *id;
        }
        let remedy = if self.made.spectrum_names.contains_key(name) {
            "it is a spectrum texture; a float texture is needed here".into()
        } else {
            remedy(name, self.made.float_names.keys().map(String::as_str))
        };
        self.report.error(at, format!("there is no float texture \"{name}\"; {remedy}"));
        None
    }

    /// A spectral parameter: a texture, or a spectrum that is the same everywhere.
    pub(super) fn spectrum_param(
        &mut self,
        p: &Params,
        name: &str,
        role: Role,
        default: f32,
    ) -> SpectrumTextureId {
        match self.spectrum_param_given(p, name, role) {
            Some(id) => id,
            None => self.made.grey(default),
        }
    }

    /// A spectral parameter, where it is given.
    pub(super) fn spectrum_param_given(
        &mut self,
        p: &Params,
        name: &str,
        role: Role,
    ) -> Option<SpectrumTextureId> {
        let [rgb, spectrum, blackbody] = SPECTRUM_TYPES;
        let param = p.find(name, &[rgb, spectrum, blackbody, Type::Texture])?;
        if let (Type::Texture, Some((texture, at))) = (param.ty, param.values.texts().first()) {
            return self.spectrum_named(texture, *at);
        }
        let spectrum = self.spectrum_of(param, role)?;
        Some(self.made.add_spectrum(SpectrumTexture::Constant(spectrum)))
    }

    fn spectrum_named(&mut self, name: &str, at: Span) -> Option<SpectrumTextureId> {
        if let Some(id) = self.made.spectrum_names.get(name) {
            return *id;
        }
        let remedy = if self.made.float_names.contains_key(name) {
            "it is a float texture; a spectrum texture is needed here".into()
        } else {
            remedy(name, self.made.spectrum_names.keys().map(String::as_str))
        };
        self.report.error(at, format!("there is no spectrum texture \"{name}\"; {remedy}"));
        None
    }
}

/// The constant that stands for a texture that is not supported, as its table says.
fn stand_in(entity: &Entity) -> f32 {
    if entity.name == "ptex" { 1.0 } else { 0.5 }
}
