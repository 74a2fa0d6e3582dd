//! Materials: from a point on a surface to a reflection model with its parameters bound.

use std::sync::Arc;

use sparrow_models::{MAX_CHOICES, MAX_REALS, MAX_SPECTRA, ModelKind, ParamBlock, ParamKind};
use sparrow_scene::{FloatTextureId, MaterialDesc, RealParam, SceneDesc, SpectrumParam, SpectrumTextureId};
use sparrow_spectra::{DenseSpectrum, RgbRole, Spectrum, Wavelengths};

use crate::colour::Carrier;
use crate::scatter::LocalModel;
use crate::spectrum::SceneSpectrum;
use crate::texture::{TextureContext, Textures};

mod columns;

pub(crate) use columns::{MaterialColumns, Points};

/// Fraunhofer's d line, at which indices of refraction are given, in nm.
const HELIUM_D: f32 = 587.6;

#[derive(Clone, Debug)]
enum RealSource {
    Constant(f32),
    Texture(FloatTextureId),
    SqrtOfTexture(FloatTextureId),
    AtHero(Arc<DenseSpectrum>),
}

#[derive(Clone, Debug)]
enum SpectrumSource {
    Value(SceneSpectrum),
    Texture(SpectrumTextureId),
    /// `2 sqrt(r) / sqrt(1 - r)` of a texture's reflectance r.
    KOfTexture(SpectrumTextureId),
}

impl RealSource {
    #[inline]
    fn at(&self, textures: &Textures, ctx: &TextureContext, w: &Wavelengths) -> f32 {
        match self {
            RealSource::Constant(v) => *v,
            RealSource::Texture(id) => textures.float(*id, ctx),
            RealSource::SqrtOfTexture(id) => textures.float(*id, ctx).max(0.0).sqrt(),
            RealSource::AtHero(d) => d.at(w)[0],
        }
    }
}

impl SpectrumSource {
    /// It varies neither over the surface nor with a path's wavelengths.
    fn is_constant(&self) -> bool {
        matches!(self, SpectrumSource::Value(SceneSpectrum::Constant(_) | SceneSpectrum::Channels(_)))
    }
    #[inline]
    fn at(&self, textures: &Textures, ctx: &TextureContext, w: &Wavelengths) -> Spectrum<f32> {
        match self {
            SpectrumSource::Value(s) => s.at(w),
            SpectrumSource::Texture(id) => textures.value(*id, ctx, w),
            SpectrumSource::KOfTexture(id) => textures.value(*id, ctx, w).map(k_of_reflectance),
        }
    }
}

/// A material of a compiled scene.
#[derive(Clone, Debug)]
pub(crate) struct Material {
    pub(crate) kind: ModelKind,
    reals: Vec<RealSource>,
    spectra: Vec<SpectrumSource>,
    choices: [u8; MAX_CHOICES],
    /// The index of refraction varies with wavelength: paths keep only their hero.
    pub(crate) dispersive: bool,
    /// Some parameter varies over the surface.
    pub(crate) textured: bool,
}

impl Material {
    /// Compiles a description; none for `interface`, which rays pass unchanged.
    pub(crate) fn new(
        desc: &MaterialDesc,
        scene: &SceneDesc,
        textures: &mut Textures,
        faults: &mut Vec<String>,
    ) -> Option<Material> {
        let kind = desc.model?;
        let carrier = Carrier::new(&scene.film);
        let reals: Vec<RealSource> = desc.reals.iter().map(|r| real_source(r, textures, carrier)).collect();
        let is_spectral = |k: ParamKind| matches!(k, ParamKind::Albedo | ParamKind::Unbounded);
        let spectral = kind.params().iter().filter(|p| is_spectral(p.kind));
        let spectra: Vec<SpectrumSource> = spectral
            .zip(&desc.spectra)
            .map(|(info, param)| spectrum_source(info.kind, param, scene, textures, faults))
            .collect();
        let textured =
            reals.iter().any(|r| matches!(r, RealSource::Texture(_) | RealSource::SqrtOfTexture(_)))
                || spectra.iter().any(|s| !matches!(s, SpectrumSource::Value(_)));
        let dispersive = reals.iter().any(|r| matches!(r, RealSource::AtHero(_)));
        debug_assert!(
            reals.len() <= MAX_REALS && spectra.len() <= MAX_SPECTRA,
            "tables are checked by a test"
        );
        let mut choices = [0; MAX_CHOICES];
        for (slot, &place) in choices.iter_mut().zip(&desc.choices) {
            *slot = place;
        }
        Some(Material { kind, reals, spectra, choices, dispersive, textured })
    }

    /// Evaluates the parameters at a point and binds them; `h` is the ray's offset from the axis, should the point lie on a fibre.
    #[inline]
    pub(crate) fn bind(
        &self,
        textures: &Textures,
        ctx: &TextureContext,
        h: f32,
        w: &Wavelengths,
    ) -> LocalModel {
        let mut block =
            ParamBlock { choices: self.choices, lambda: Spectrum(w.lambda), h, ..ParamBlock::default() };
        for (slot, source) in block.reals.iter_mut().zip(&self.reals) {
            *slot = source.at(textures, ctx, w);
        }
        for (slot, source) in block.spectra.iter_mut().zip(&self.spectra) {
            *slot = source.at(textures, ctx, w);
        }
        match self.kind {
            ModelKind::Surface(kind) => LocalModel::Surface(kind.bind(&block)),
            ModelKind::Fibre(kind) => LocalModel::Fibre(kind.bind(&block)),
        }
    }
}

/// The absorption with which a conductor of eta = 1 reflects `r` at normal incidence.
fn k_of_reflectance(r: f32) -> f32 {
    let r = r.clamp(0.0, 0.9999);
    2.0 * r.sqrt() / (1.0 - r).sqrt()
}

fn real_source(param: &RealParam, textures: &Textures, carrier: Carrier) -> RealSource {
    match param {
        RealParam::Texture(id) => match textures.constant_float(*id) {
            Some(v) => RealSource::Constant(v),
            None => RealSource::Texture(*id),
        },
        RealParam::RoughnessToAlpha(id) => match textures.constant_float(*id) {
            Some(v) => RealSource::Constant(v.max(0.0).sqrt()),
            None => RealSource::SqrtOfTexture(*id),
        },
        RealParam::Dispersive(s) => {
            let table = SceneSpectrum::new(s, RgbRole::Unbounded).to_dense();
            match carrier {
                Carrier::Wavelengths => RealSource::AtHero(Arc::new(table)),
                // Three channels cannot be bent apart: all take the index of the yellow helium line.
                Carrier::Rgb(_) => RealSource::Constant(table.value(HELIUM_D)),
            }
        }
    }
}

fn spectrum_source(
    kind: ParamKind,
    param: &SpectrumParam,
    scene: &SceneDesc,
    textures: &mut Textures,
    faults: &mut Vec<String>,
) -> SpectrumSource {
    match param {
        SpectrumParam::Texture(id) => {
            let role = if kind == ParamKind::Albedo { RgbRole::Albedo } else { RgbRole::Unbounded };
            let id = textures.spectrum(scene, *id, role, faults);
            match textures.constant_spectrum(id) {
                Some(s) => SpectrumSource::Value(within(kind, s)),
                None => SpectrumSource::Texture(id),
            }
        }
        SpectrumParam::ReflectanceToK(id) => {
            let id = textures.spectrum(scene, *id, RgbRole::Albedo, faults);
            match textures.constant_spectrum(id) {
                Some(s) => SpectrumSource::Value(s.map(k_of_reflectance)),
                None => SpectrumSource::KOfTexture(id),
            }
        }
    }
}

/// Reflectances above one would make light: tables are clamped, as pbrt-v4 clamps them.
fn within(kind: ParamKind, s: SceneSpectrum) -> SceneSpectrum {
    match (kind, s) {
        // What stands for RGB lies within by its making.
        (ParamKind::Albedo, s @ (SceneSpectrum::Constant(_) | SceneSpectrum::Dense(_))) => {
            s.map(|v| v.clamp(0.0, 1.0))
        }
        (_, s) => s,
    }
}
