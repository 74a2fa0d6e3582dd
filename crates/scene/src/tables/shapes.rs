//! Shapes: `Shape::Create` of pbrt-v4, and `hair`. What ends in `_end` is Sparrow's own: the same where motion ends.

use super::{Entity, Kind, Row, moot, not_yet, row};

/// Read for every shape where its primitives are made.
const COMMON: &[Row] = &[row("alpha", Kind::FloatTexture)];

pub(super) static SHAPES: [Entity; 9] = [
    Entity::new(
        "trianglemesh",
        &[
            COMMON,
            &[
                row("P", Kind::Point3List),
                row("indices", Kind::IntList),
                row("N", Kind::NormalList),
                row("S", Kind::Vector3List),
                row("uv", Kind::Point2List),
                row("P_end", Kind::Point3List),
                row("N_end", Kind::NormalList),
                // Only Ptex looks them up.
                moot("faceIndices", Kind::IntList),
            ],
        ],
    ),
    Entity::new(
        "plymesh",
        &[
            COMMON,
            &[
                row("filename", Kind::Text),
                row("filename_end", Kind::Text),
                not_yet("displacement", Kind::Texture),
                moot("edgelength", Kind::Float),
                moot("displacement.edgelength", Kind::Float),
            ],
        ],
    ),
    Entity::new(
        "bilinearmesh",
        &[
            COMMON,
            &[
                row("P", Kind::Point3List),
                row("indices", Kind::IntList),
                row("N", Kind::NormalList),
                row("uv", Kind::Point2List),
                row("P_end", Kind::Point3List),
                row("N_end", Kind::NormalList),
                moot("faceIndices", Kind::IntList),
                // The emission's image only steers where points on the light are taken.
                not_yet("emissionfilename", Kind::Text),
            ],
        ],
    ),
    Entity::new(
        "sphere",
        &[
            COMMON,
            &[
                row("radius", Kind::Float),
                row("zmin", Kind::Float),
                row("zmax", Kind::Float),
                row("phimax", Kind::Float),
            ],
        ],
    ),
    Entity::new(
        "disk",
        &[
            COMMON,
            &[
                row("height", Kind::Float),
                row("radius", Kind::Float),
                row("innerradius", Kind::Float),
                row("phimax", Kind::Float),
            ],
        ],
    ),
    Entity::new(
        "cylinder",
        &[
            COMMON,
            &[
                row("radius", Kind::Float),
                row("zmin", Kind::Float),
                row("zmax", Kind::Float),
                row("phimax", Kind::Float),
            ],
        ],
    ),
    Entity::new(
        "curve",
        &[
            COMMON,
            &[
                row("P", Kind::Point3List),
                row("N", Kind::NormalList),
                row("basis", Kind::Text),
                row("degree", Kind::Int),
                row("type", Kind::Text),
                row("width", Kind::Float),
                row("width0", Kind::Float),
                row("width1", Kind::Float),
                row("splitdepth", Kind::Int),
                // Sparrow's own, for the basis hermite.
                row("T", Kind::Vector3List),
                row("P_end", Kind::Point3List),
                row("N_end", Kind::NormalList),
                row("T_end", Kind::Vector3List),
                row("width_end", Kind::Float),
                row("width0_end", Kind::Float),
                row("width1_end", Kind::Float),
            ],
        ],
    ),
    // Sparrow's own: strands in files of other programs.
    Entity::new(
        "hair",
        &[
            COMMON,
            &[
                row("filename", Kind::Text),
                row("filename_end", Kind::Text),
                row("type", Kind::Text),
                row("basis", Kind::Text),
                row("width", Kind::Float),
                row("width0", Kind::Float),
                row("width1", Kind::Float),
                row("splitdepth", Kind::Int),
            ],
        ],
    ),
    Entity::new(
        "loopsubdiv",
        &[
            COMMON,
            &[
                row("P", Kind::Point3List),
                row("indices", Kind::IntList),
                row("levels", Kind::Int),
                row("scheme", Kind::Text),
            ],
        ],
    )
    .instead("it is left out of the picture"),
];
