//! Media: `Medium::Create` of pbrt-v4. None is rendered yet; their parameters are checked all the same.

use super::{Entity, Kind, Row, row};

const TYPE: &[Row] = &[row("type", Kind::Text)];
const SCATTERING: &[Row] = &[
    row("sigma_a", Kind::Spectrum),
    row("sigma_s", Kind::Spectrum),
    row("scale", Kind::Float),
    row("g", Kind::Float),
];
const GRID: &[Row] = &[
    row("nx", Kind::Int),
    row("ny", Kind::Int),
    row("nz", Kind::Int),
    row("p0", Kind::Point3),
    row("p1", Kind::Point3),
];
const TEMPERATURE: &[Row] = &[
    row("temperaturecutoff", Kind::Float),
    row("temperatureoffset", Kind::Float),
    row("temperaturescale", Kind::Float),
];

pub(super) static MEDIA: [Entity; 5] = [
    Entity::new(
        "homogeneous",
        &[
            TYPE,
            SCATTERING,
            &[row("preset", Kind::Text), row("Le", Kind::Spectrum), row("Lescale", Kind::Float)],
        ],
    ),
    Entity::new(
        "uniformgrid",
        &[
            TYPE,
            SCATTERING,
            GRID,
            TEMPERATURE,
            &[
                row("preset", Kind::Text),
                row("density", Kind::FloatList),
                row("temperature", Kind::FloatList),
                row("Le", Kind::Spectrum),
                row("Lescale", Kind::FloatList),
            ],
        ],
    ),
    Entity::new(
        "rgbgrid",
        &[
            TYPE,
            GRID,
            &[
                row("sigma_a", Kind::RgbList),
                row("sigma_s", Kind::RgbList),
                row("Le", Kind::RgbList),
                row("scale", Kind::Float),
                row("Lescale", Kind::Float),
                row("g", Kind::Float),
            ],
        ],
    ),
    Entity::new(
        "cloud",
        &[
            TYPE,
            SCATTERING,
            &[
                row("p0", Kind::Point3),
                row("p1", Kind::Point3),
                row("density", Kind::Float),
                row("wispiness", Kind::Float),
                row("frequency", Kind::Float),
            ],
        ],
    ),
    Entity::new(
        "nanovdb",
        &[
            TYPE,
            SCATTERING,
            TEMPERATURE,
            &[row("filename", Kind::Text), row("preset", Kind::Text), row("Lescale", Kind::Float)],
        ],
    ),
];
