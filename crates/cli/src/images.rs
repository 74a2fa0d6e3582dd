//! The image files that a scene names.

use std::path::Path;

use sparrow_scene::{FloatTexture, LightKind, SceneDesc, SpectrumTexture};

/// Every image of a scene, once each, in order of first use.
pub(crate) fn of(desc: &SceneDesc) -> Vec<&Path> {
    let floats = desc.float_textures.iter().filter_map(|t| match t {
        FloatTexture::Image(map) => Some(map.path.as_path()),
        FloatTexture::Constant(_)
        | FloatTexture::Scale(..)
        | FloatTexture::Mix { .. }
        | FloatTexture::Checkerboard { .. } => None,
    });
    let spectra = desc.spectrum_textures.iter().filter_map(|t| match t {
        SpectrumTexture::Image(map, _) => Some(map.path.as_path()),
        SpectrumTexture::Constant(_)
        | SpectrumTexture::Scale(..)
        | SpectrumTexture::Mix { .. }
        | SpectrumTexture::Checkerboard { .. } => None,
    });
    let lights = desc.lights.iter().filter_map(|l| match &l.kind {
        LightKind::InfiniteImage { path, .. } => Some(path.as_path()),
        LightKind::Point { .. }
        | LightKind::Spot { .. }
        | LightKind::Distant { .. }
        | LightKind::Infinite { .. } => None,
    });
    let mut found: Vec<&Path> = Vec::new();
    for path in floats.chain(spectra).chain(lights) {
        if !found.contains(&path) {
            found.push(path);
        }
    }
    found
}
