//! What stands before `WorldBegin`: camera, film, filter, sampler, integrator, accelerator, options.

use super::{Entity, Kind, Row, moot, not_yet, row};

const SHUTTER: &[Row] = &[row("shutteropen", Kind::Float), row("shutterclose", Kind::Float)];
const PROJECTIVE: &[Row] = &[
    row("frameaspectratio", Kind::Float),
    row("screenwindow", Kind::FloatList),
    row("lensradius", Kind::Float),
    row("focaldistance", Kind::Float),
];

pub(super) static CAMERAS: [Entity; 4] = [
    Entity::new("perspective", &[SHUTTER, PROJECTIVE, &[row("fov", Kind::Float)]]),
    Entity::new("orthographic", &[SHUTTER, PROJECTIVE]),
    Entity::new(
        "realistic",
        &[
            SHUTTER,
            &[
                row("lensfile", Kind::Text),
                row("aperturediameter", Kind::Float),
                row("focusdistance", Kind::Float),
                row("aperture", Kind::Text),
            ],
        ],
    )
    .refused("use a \"perspective\" camera"),
    Entity::new("spherical", &[SHUTTER, PROJECTIVE, &[row("mapping", Kind::Text)]])
        .refused("use a \"perspective\" camera"),
];

const FILM: &[Row] = &[
    row("filename", Kind::Text),
    row("xresolution", Kind::Int),
    row("yresolution", Kind::Int),
    row("pixelbounds", Kind::IntList),
    row("cropwindow", Kind::FloatList),
    row("diagonal", Kind::Float),
    row("savefp16", Kind::Bool),
    row("maxcomponentvalue", Kind::Float),
    row("sensor", Kind::Text),
    row("iso", Kind::Float),
    row("whitebalance", Kind::Float),
    // Early versions took the exposure from here instead of the camera's shutter.
    row("exposuretime", Kind::Float),
    not_yet("fnumber", Kind::Float),
    not_yet("c", Kind::Float),
];

pub(super) static FILMS: [Entity; 3] = [
    Entity::new("rgb", &[FILM]),
    Entity::new("gbuffer", &[FILM, &[moot("coordinatesystem", Kind::Text)]])
        .instead("it is rendered as \"rgb\", without the auxiliary channels"),
    Entity::new(
        "spectral",
        &[
            FILM,
            &[moot("nbuckets", Kind::Int), moot("lambdamin", Kind::Float), moot("lambdamax", Kind::Float)],
        ],
    )
    .instead("it is rendered as \"rgb\", without the spectral channels"),
];

const RADIUS: &[Row] = &[row("xradius", Kind::Float), row("yradius", Kind::Float)];

pub(super) static FILTERS: [Entity; 5] = [
    Entity::new("box", &[RADIUS]),
    Entity::new("triangle", &[RADIUS]),
    Entity::new("gaussian", &[RADIUS, &[row("sigma", Kind::Float)]]),
    Entity::new("mitchell", &[RADIUS, &[row("B", Kind::Float), row("C", Kind::Float)]]),
    Entity::new("sinc", &[RADIUS, &[row("tau", Kind::Float)]]),
];

const SAMPLES: &[Row] = &[row("pixelsamples", Kind::Int)];
const SEED: &[Row] = &[row("seed", Kind::Int)];
const RANDOMIZATION: &[Row] = &[row("randomization", Kind::Text)];

pub(super) static SAMPLERS: [Entity; 7] = [
    Entity::new("independent", &[SAMPLES, SEED]),
    Entity::new(
        "stratified",
        &[SEED, &[row("xsamples", Kind::Int), row("ysamples", Kind::Int), row("jitter", Kind::Bool)]],
    ),
    Entity::new("halton", &[SAMPLES, SEED, RANDOMIZATION]),
    Entity::new("sobol", &[SAMPLES, SEED, RANDOMIZATION]),
    Entity::new("paddedsobol", &[SAMPLES, SEED, RANDOMIZATION]),
    Entity::new("zsobol", &[SAMPLES, SEED, RANDOMIZATION]),
    Entity::new("pmj02bn", &[SAMPLES, SEED]),
];

const DEPTH: &[Row] = &[row("maxdepth", Kind::Int)];
const LIGHTS: &[Row] = &[row("lightsampler", Kind::Text), row("regularize", Kind::Bool)];
const STRATEGIES: &[Row] = &[row("samplelights", Kind::Bool), row("samplebsdf", Kind::Bool)];
/// Sparrow's own.
const OURS: &[Row] = &[
    row("mis", Kind::Text),
    row("miscompensation", Kind::Bool),
    row("roulette", Kind::Text),
    row("splits", Kind::Int),
];
const SAME_LIGHT: &str = "\"path\" is used, which finds the same light with other noise";

pub(super) static INTEGRATORS: [Entity; 13] = [
    Entity::new("path", &[DEPTH, LIGHTS, STRATEGIES, OURS]),
    Entity::new("volpath", &[DEPTH, LIGHTS, STRATEGIES, OURS]),
    Entity::new("simplepath", &[DEPTH, LIGHTS, STRATEGIES, OURS]),
    // Sparrow's own: paths one at a time.
    Entity::new("reference", &[DEPTH, LIGHTS, STRATEGIES, OURS]),
    // Sparrow's own: one bounce of light and specular chains.
    Entity::new("directlighting", &[DEPTH, LIGHTS, STRATEGIES, OURS]),
    Entity::new("simplevolpath", &[DEPTH]).instead("\"path\" is used, which also scatters at surfaces"),
    Entity::new("lightpath", &[DEPTH]).instead(SAME_LIGHT),
    Entity::new("randomwalk", &[DEPTH]).instead(SAME_LIGHT),
    Entity::new(
        "bdpt",
        &[DEPTH, LIGHTS, &[moot("visualizestrategies", Kind::Bool), moot("visualizeweights", Kind::Bool)]],
    )
    .instead(SAME_LIGHT),
    Entity::new(
        "mlt",
        &[
            DEPTH,
            LIGHTS,
            &[
                moot("bootstrapsamples", Kind::Int),
                moot("chains", Kind::Int),
                moot("mutationsperpixel", Kind::Int),
                moot("largestepprobability", Kind::Float),
                moot("sigma", Kind::Float),
            ],
        ],
    )
    .instead(SAME_LIGHT),
    Entity::new(
        "sppm",
        &[
            DEPTH,
            &[moot("photonsperiteration", Kind::Int), moot("radius", Kind::Float), moot("seed", Kind::Int)],
        ],
    )
    .instead(SAME_LIGHT),
    Entity::new("ambientocclusion", &[&[moot("cossample", Kind::Bool), moot("maxdistance", Kind::Float)]])
        .instead("\"path\" is used, and the picture is another one"),
    Entity::new(
        "function",
        &[&[moot("function", Kind::Text), moot("filename", Kind::Text), moot("skipbad", Kind::Bool)]],
    )
    .refused("use \"path\""),
];

pub(super) static ACCELERATORS: [Entity; 2] = [
    Entity::new("bvh", &[&[moot("maxnodeprims", Kind::Int), moot("splitmethod", Kind::Text)]]),
    Entity::new(
        "kdtree",
        &[&[
            moot("intersectcost", Kind::Int),
            moot("traversalcost", Kind::Int),
            moot("emptybonus", Kind::Float),
            moot("maxprims", Kind::Int),
            moot("maxdepth", Kind::Int),
        ]],
    ),
];

/// What the value of an `Option` is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OptionValue {
    /// The seed, a whole number.
    Seed,
    /// What paths carry, "spectral" or "rgb".
    Colour,
    /// `true` changes the picture in a way that is not supported yet.
    Flag,
    /// `true` or `false` without effect on the picture.
    MootFlag,
    /// A number without effect on what is supported.
    MootNumber,
    /// A quoted string without effect on the picture.
    MootText,
}

/// The options, by their names without `-` and `_`.
pub(crate) const OPTIONS: [(&str, OptionValue); 16] = [
    ("seed", OptionValue::Seed),
    ("colour", OptionValue::Colour),
    ("color", OptionValue::Colour),
    ("disablepixeljitter", OptionValue::Flag),
    ("disabletexturefiltering", OptionValue::Flag),
    ("disablewavelengthjitter", OptionValue::Flag),
    ("forcediffuse", OptionValue::Flag),
    ("pixelstats", OptionValue::MootFlag),
    ("wavefront", OptionValue::MootFlag),
    ("quiet", OptionValue::MootFlag),
    ("gpu", OptionValue::MootFlag),
    ("interactive", OptionValue::MootFlag),
    ("displacementedgescale", OptionValue::MootNumber),
    ("msereferenceimage", OptionValue::MootText),
    ("msereferenceout", OptionValue::MootText),
    ("rendercoordsys", OptionValue::MootText),
];
