//! The image files that a scene names, and where.

use std::path::Path;

use sparrow_scene::{FloatTexture, LightKind, SceneDesc, Span, SpectrumTexture};

/// Every image of a scene, once each, with the place of its first use.
pub(crate) fn of(desc: &SceneDesc) -> Vec<(&Path, Span)> {
    let floats = desc.float_textures.iter().filter_map(|t| match t {
        FloatTexture::Image(map) => Some((map.path.as_path(), map.at)),
        FloatTexture::Constant(_)
        | FloatTexture::Scale(..)
        | FloatTexture::Mix { .. }
        | FloatTexture::Checkerboard { .. } => None,
    });
    let spectra = desc.spectrum_textures.iter().filter_map(|t| match t {
        SpectrumTexture::Image(map, _) => Some((map.path.as_path(), map.at)),
        SpectrumTexture::Constant(_)
        | SpectrumTexture::Scale(..)
        | SpectrumTexture::Mix { .. }
        | SpectrumTexture::Checkerboard { .. } => None,
    });
    let lights = desc.lights.iter().filter_map(|l| match &l.kind {
        LightKind::InfiniteImage { path, .. } => Some((path.as_path(), l.at)),
        LightKind::Point { .. }
        | LightKind::Spot { .. }
        | LightKind::Distant { .. }
        | LightKind::Infinite { .. } => None,
    });
    let mut found: Vec<(&Path, Span)> = Vec::new();
    for (path, at) in floats.chain(spectra).chain(lights) {
        match found.iter_mut().find(|f| f.0 == path) {
            Some(f) => f.1 = f.1.min(at),
            None => found.push((path, at)),
        }
    }
    found
}
