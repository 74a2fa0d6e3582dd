//! Textures: `FloatTexture::Create` and `SpectrumTexture::Create` of pbrt-v4.

use super::{Entity, Kind, Row, row};

/// Coordinates on the surface.
const MAPPING: &[Row] = &[
    row("mapping", Kind::Text),
    row("uscale", Kind::Float),
    row("vscale", Kind::Float),
    row("udelta", Kind::Float),
    row("vdelta", Kind::Float),
    row("v1", Kind::Vector3),
    row("v2", Kind::Vector3),
];
const IMAGE: &[Row] = &[
    row("filename", Kind::Text),
    row("filter", Kind::Text),
    row("wrap", Kind::Text),
    row("maxanisotropy", Kind::Float),
    row("encoding", Kind::Text),
    row("scale", Kind::Float),
    row("invert", Kind::Bool),
];
const PTEX: &[Row] = &[row("filename", Kind::Text), row("encoding", Kind::Text), row("scale", Kind::Float)];
const NOISE: &[Row] = &[row("octaves", Kind::Int), row("roughness", Kind::Float)];
const STAND_IN: &str = "a constant of 1 stands for it";
const MEAN: &str = "a constant of 0.5 stands for it";

pub(super) static FLOAT_TEXTURES: [Entity; 12] = [
    Entity::new("constant", &[&[row("value", Kind::Float)]]),
    Entity::new("scale", &[&[row("tex", Kind::FloatTexture), row("scale", Kind::FloatTexture)]]),
    Entity::new(
        "mix",
        &[&[
            row("tex1", Kind::FloatTexture),
            row("tex2", Kind::FloatTexture),
            row("amount", Kind::FloatTexture),
        ]],
    ),
    Entity::new("imagemap", &[MAPPING, IMAGE]),
    Entity::new(
        "checkerboard",
        &[
            MAPPING,
            &[row("dimension", Kind::Int), row("tex1", Kind::FloatTexture), row("tex2", Kind::FloatTexture)],
        ],
    ),
    Entity::new(
        "bilerp",
        &[
            MAPPING,
            &[
                row("v00", Kind::Float),
                row("v01", Kind::Float),
                row("v10", Kind::Float),
                row("v11", Kind::Float),
            ],
        ],
    )
    .instead(MEAN),
    Entity::new(
        "directionmix",
        &[&[row("tex1", Kind::FloatTexture), row("tex2", Kind::FloatTexture), row("dir", Kind::Vector3)]],
    )
    .instead(MEAN),
    Entity::new("dots", &[MAPPING, &[row("inside", Kind::FloatTexture), row("outside", Kind::FloatTexture)]])
        .instead(MEAN),
    Entity::new("fbm", &[NOISE]).instead(MEAN),
    Entity::new("ptex", &[PTEX]).instead(STAND_IN),
    Entity::new("windy", &[]).instead(MEAN),
    Entity::new("wrinkled", &[NOISE]).instead(MEAN),
];

pub(super) static SPECTRUM_TEXTURES: [Entity; 10] = [
    Entity::new("constant", &[&[row("value", Kind::Spectrum)]]),
    Entity::new("scale", &[&[row("tex", Kind::SpectrumTexture), row("scale", Kind::FloatTexture)]]),
    Entity::new(
        "mix",
        &[&[
            row("tex1", Kind::SpectrumTexture),
            row("tex2", Kind::SpectrumTexture),
            row("amount", Kind::FloatTexture),
        ]],
    ),
    Entity::new("imagemap", &[MAPPING, IMAGE]),
    Entity::new(
        "checkerboard",
        &[
            MAPPING,
            &[
                row("dimension", Kind::Int),
                row("tex1", Kind::SpectrumTexture),
                row("tex2", Kind::SpectrumTexture),
            ],
        ],
    ),
    Entity::new(
        "bilerp",
        &[
            MAPPING,
            &[
                row("v00", Kind::Spectrum),
                row("v01", Kind::Spectrum),
                row("v10", Kind::Spectrum),
                row("v11", Kind::Spectrum),
            ],
        ],
    )
    .instead(MEAN),
    Entity::new(
        "directionmix",
        &[&[
            row("tex1", Kind::SpectrumTexture),
            row("tex2", Kind::SpectrumTexture),
            row("dir", Kind::Vector3),
        ]],
    )
    .instead(MEAN),
    Entity::new(
        "dots",
        &[MAPPING, &[row("inside", Kind::SpectrumTexture), row("outside", Kind::SpectrumTexture)]],
    )
    .instead(MEAN),
    Entity::new("marble", &[NOISE, &[row("scale", Kind::Float), row("variation", Kind::Float)]])
        .instead(MEAN),
    Entity::new("ptex", &[PTEX]).instead(STAND_IN),
];
