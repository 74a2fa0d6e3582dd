//! Light sources: `Light::Create` and `Light::CreateArea` of pbrt-v4.

use super::{Entity, Kind, Row, not_yet, row};

const COMMON: &[Row] = &[row("scale", Kind::Float)];

pub(super) static LIGHTS: [Entity; 6] = [
    Entity::new(
        "point",
        &[COMMON, &[row("I", Kind::Spectrum), row("from", Kind::Point3), row("power", Kind::Float)]],
    ),
    Entity::new(
        "spot",
        &[
            COMMON,
            &[
                row("I", Kind::Spectrum),
                row("from", Kind::Point3),
                row("to", Kind::Point3),
                row("coneangle", Kind::Float),
                row("conedeltaangle", Kind::Float),
                row("power", Kind::Float),
            ],
        ],
    ),
    Entity::new(
        "distant",
        &[
            COMMON,
            &[
                row("L", Kind::Spectrum),
                row("from", Kind::Point3),
                row("to", Kind::Point3),
                row("illuminance", Kind::Float),
            ],
        ],
    ),
    Entity::new(
        "infinite",
        &[
            COMMON,
            &[
                row("L", Kind::Spectrum),
                row("filename", Kind::Text),
                row("illuminance", Kind::Float),
                row("portal", Kind::Point3List),
            ],
        ],
    ),
    Entity::new(
        "goniometric",
        &[COMMON, &[row("I", Kind::Spectrum), row("filename", Kind::Text), row("power", Kind::Float)]],
    )
    .instead("it gives no light"),
    Entity::new(
        "projection",
        &[
            COMMON,
            &[
                row("I", Kind::Spectrum),
                row("filename", Kind::Text),
                row("fov", Kind::Float),
                row("power", Kind::Float),
            ],
        ],
    )
    .instead("it gives no light"),
];

pub(super) static AREA_LIGHTS: [Entity; 1] = [Entity::new(
    "diffuse",
    &[
        COMMON,
        &[
            row("L", Kind::Spectrum),
            row("power", Kind::Float),
            row("twosided", Kind::Bool),
            not_yet("filename", Kind::Text),
        ],
    ],
)];
