//! Materials: `Material::Create` of pbrt-v4. Sparrow's own models are read by their own tables.

use super::{Entity, Kind, Row, moot, not_yet, row};

/// Bump and normal maps, taken by all materials that have a surface.
const BUMPS: &[Row] = &[not_yet("displacement", Kind::FloatTexture), not_yet("normalmap", Kind::Text)];
const ROUGHNESS: &[Row] = &[
    row("roughness", Kind::FloatTexture),
    row("uroughness", Kind::FloatTexture),
    row("vroughness", Kind::FloatTexture),
    row("remaproughness", Kind::Bool),
];
/// Of a coating. Sparrow's coats absorb but do not scatter within, and need no random walk.
const LAYERS: &[Row] = &[
    row("thickness", Kind::FloatTexture),
    // Means nothing without an albedo.
    moot("g", Kind::FloatTexture),
    not_yet("albedo", Kind::SpectrumTexture),
    moot("maxdepth", Kind::Int),
    moot("nsamples", Kind::Int),
];

pub(super) static MATERIALS: [Entity; 14] = [
    Entity::new(
        "diffuse",
        &[
            BUMPS,
            &[
                row("reflectance", Kind::SpectrumTexture),
                // Early versions had Oren-Nayar here.
                not_yet("sigma", Kind::FloatTexture),
            ],
        ],
    ),
    Entity::new(
        "diffusetransmission",
        &[
            BUMPS,
            &[
                row("reflectance", Kind::SpectrumTexture),
                row("transmittance", Kind::SpectrumTexture),
                row("scale", Kind::Float),
                moot("remaproughness", Kind::Bool),
                not_yet("sigma", Kind::FloatTexture),
            ],
        ],
    ),
    Entity::new(
        "conductor",
        &[
            BUMPS,
            ROUGHNESS,
            &[
                row("eta", Kind::SpectrumTexture),
                row("k", Kind::SpectrumTexture),
                row("reflectance", Kind::SpectrumTexture),
            ],
        ],
    ),
    Entity::new("dielectric", &[BUMPS, ROUGHNESS, &[row("eta", Kind::FloatOrSpectrum)]]),
    Entity::new("thindielectric", &[BUMPS, &[row("eta", Kind::FloatOrSpectrum)]]),
    Entity::new("interface", &[BUMPS]),
    // pbrt-v4's other spelling of "interface".
    Entity::new("", &[BUMPS]),
    Entity::new("none", &[BUMPS]),
    Entity::new(
        "coateddiffuse",
        &[
            BUMPS,
            ROUGHNESS,
            LAYERS,
            &[row("reflectance", Kind::SpectrumTexture), row("eta", Kind::FloatOrSpectrum)],
        ],
    ),
    Entity::new(
        "coatedconductor",
        &[
            BUMPS,
            LAYERS,
            &[
                row("interface.roughness", Kind::FloatTexture),
                row("interface.uroughness", Kind::FloatTexture),
                row("interface.vroughness", Kind::FloatTexture),
                row("interface.eta", Kind::FloatOrSpectrum),
                row("conductor.roughness", Kind::FloatTexture),
                row("conductor.uroughness", Kind::FloatTexture),
                row("conductor.vroughness", Kind::FloatTexture),
                row("conductor.eta", Kind::SpectrumTexture),
                row("conductor.k", Kind::SpectrumTexture),
                row("reflectance", Kind::SpectrumTexture),
                row("remaproughness", Kind::Bool),
            ],
        ],
    ),
    Entity::new("mix", &[&[row("materials", Kind::TextList), row("amount", Kind::FloatTexture)]])
        .instead("the first of its materials that has a surface stands for both"),
    Entity::new("measured", &[BUMPS, &[row("filename", Kind::Text)]])
        .instead("it is rendered as \"diffuse\" with reflectance 0.5"),
    Entity::new(
        "hair",
        &[&[
            row("sigma_a", Kind::SpectrumTexture),
            row("reflectance", Kind::SpectrumTexture),
            row("color", Kind::SpectrumTexture),
            row("eumelanin", Kind::FloatTexture),
            row("pheomelanin", Kind::FloatTexture),
            row("eta", Kind::FloatTexture),
            row("beta_m", Kind::FloatTexture),
            row("beta_n", Kind::FloatTexture),
            row("alpha", Kind::FloatTexture),
            row("field", Kind::Text),
        ]],
    ),
    Entity::new(
        "subsurface",
        &[
            BUMPS,
            ROUGHNESS,
            &[
                row("name", Kind::Text),
                row("sigma_a", Kind::SpectrumTexture),
                row("sigma_s", Kind::SpectrumTexture),
                row("reflectance", Kind::SpectrumTexture),
                row("mfp", Kind::SpectrumTexture),
                row("scale", Kind::Float),
                row("eta", Kind::Float),
                row("g", Kind::Float),
            ],
        ],
    )
    .instead("it is rendered as \"diffuse\" with reflectance 0.5"),
];
