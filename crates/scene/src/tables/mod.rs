//! What pbrt-v4's format knows, as tables: statements, the types each takes, their parameters.
//!
//! Names and types are facts of pbrt-v4 (its parser, its `Create` functions and its file format page);
//! a row also says whether Sparrow renders it. The reader checks every parameter against these rows, so
//! that one it does not know is an error and one it knows but cannot render is a warning.

mod lights;
mod materials;
mod media;
mod render;
mod shapes;
mod textures;
mod v3;

use sparrow_models::ModelKind;

pub(crate) use render::{OPTIONS, OptionValue};
pub(crate) use v3::successor;

/// The declared type of a parameter in a scene file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Type {
    Bool,
    Integer,
    Float,
    Point2,
    Vector2,
    Point3,
    Vector3,
    Normal,
    Text,
    Texture,
    Rgb,
    Blackbody,
    Spectrum,
}

/// All spellings of the types; those that pbrt-v4 writes itself come first.
pub(crate) const TYPES: [(&str, Type); 16] = [
    ("bool", Type::Bool),
    ("integer", Type::Integer),
    ("float", Type::Float),
    ("point2", Type::Point2),
    ("vector2", Type::Vector2),
    ("point3", Type::Point3),
    ("vector3", Type::Vector3),
    ("normal", Type::Normal),
    ("string", Type::Text),
    ("texture", Type::Texture),
    ("rgb", Type::Rgb),
    ("blackbody", Type::Blackbody),
    ("spectrum", Type::Spectrum),
    ("point", Type::Point3),
    ("vector", Type::Vector3),
    ("normal3", Type::Normal),
];

impl Type {
    /// The type a file spells so.
    pub(crate) fn from_name(name: &str) -> Option<Type> {
        TYPES.iter().find(|(n, _)| *n == name).map(|&(_, t)| t)
    }
    /// pbrt-v4's spelling.
    pub(crate) fn name(self) -> &'static str {
        TYPES.iter().find(|&&(_, t)| t == self).map_or("", |&(n, _)| n)
    }
    /// Numbers per item.
    pub(crate) fn width(self) -> usize {
        match self {
            Type::Point2 | Type::Vector2 => 2,
            Type::Point3 | Type::Vector3 | Type::Normal | Type::Rgb => 3,
            Type::Bool | Type::Integer | Type::Float | Type::Text => 1,
            Type::Texture | Type::Blackbody | Type::Spectrum => 1,
        }
    }
}

/// What a parameter takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Bool,
    Int,
    IntList,
    Float,
    FloatList,
    Point2List,
    Point3,
    Point3List,
    Vector3,
    Vector3List,
    NormalList,
    Text,
    TextList,
    /// A number or the name of a float texture.
    FloatTexture,
    /// Only the name of a texture.
    Texture,
    /// A spectrum, in any spelling.
    Spectrum,
    /// A spectrum or the name of a spectrum texture.
    SpectrumTexture,
    /// A number or a spectrum.
    FloatOrSpectrum,
    /// A number, the name of a float texture, or a spectrum.
    FloatTextureOrSpectrum,
    RgbList,
}

impl Kind {
    /// The types it may be declared with.
    pub(crate) fn types(self) -> &'static [Type] {
        match self {
            Kind::Bool => &[Type::Bool],
            Kind::Int | Kind::IntList => &[Type::Integer],
            Kind::Float | Kind::FloatList => &[Type::Float],
            Kind::Point2List => &[Type::Point2],
            Kind::Point3 | Kind::Point3List => &[Type::Point3],
            Kind::Vector3 | Kind::Vector3List => &[Type::Vector3],
            Kind::NormalList => &[Type::Normal],
            Kind::Text | Kind::TextList => &[Type::Text],
            Kind::FloatTexture => &[Type::Float, Type::Texture],
            Kind::Texture => &[Type::Texture],
            Kind::Spectrum => &[Type::Rgb, Type::Spectrum, Type::Blackbody],
            Kind::SpectrumTexture => &[Type::Rgb, Type::Spectrum, Type::Blackbody, Type::Texture],
            Kind::FloatOrSpectrum => &[Type::Float, Type::Spectrum, Type::Rgb, Type::Blackbody],
            Kind::FloatTextureOrSpectrum => {
                &[Type::Float, Type::Texture, Type::Spectrum, Type::Rgb, Type::Blackbody]
            }
            Kind::RgbList => &[Type::Rgb],
        }
    }
    /// Any number of items may follow, not just one.
    pub(crate) fn is_list(self) -> bool {
        match self {
            Kind::IntList | Kind::FloatList | Kind::Point2List | Kind::Point3List => true,
            Kind::Vector3List | Kind::NormalList | Kind::TextList | Kind::RgbList => true,
            Kind::Bool | Kind::Int | Kind::Float | Kind::Point3 | Kind::Vector3 | Kind::Text => false,
            Kind::FloatTexture | Kind::Texture | Kind::Spectrum => false,
            Kind::SpectrumTexture | Kind::FloatOrSpectrum | Kind::FloatTextureOrSpectrum => false,
        }
    }
    /// The types in words, such as "float or texture".
    pub(crate) fn describe(self) -> String {
        self.types().iter().map(|t| t.name()).collect::<Vec<_>>().join(" or ")
    }
}

/// What becomes of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Use {
    /// It is used.
    Yes,
    /// Known, but not rendered yet: a warning.
    NotYet,
    /// Has no bearing on what Sparrow renders; silently passed over.
    Moot,
}

/// The row of a material's `type`, which `MakeNamedMaterial` takes as a parameter.
pub(crate) static TYPE_ROW: Row = row("type", Kind::Text);

/// One parameter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    pub(crate) name: &'static str,
    pub(crate) kind: Kind,
    pub(crate) used: Use,
}

const fn row(name: &'static str, kind: Kind) -> Row {
    Row { name, kind, used: Use::Yes }
}
const fn not_yet(name: &'static str, kind: Kind) -> Row {
    Row { name, kind, used: Use::NotYet }
}
const fn moot(name: &'static str, kind: Kind) -> Row {
    Row { name, kind, used: Use::Moot }
}

/// What becomes of a statement with a type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Support {
    /// Rendered as pbrt-v4 does.
    Yes,
    /// Not supported yet: a warning with what is done instead.
    Instead(&'static str),
    /// Cannot be rendered at all: an error with what to do.
    Refused(&'static str),
}

/// One type of a statement, such as the shape `sphere`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entity {
    pub(crate) name: &'static str,
    pub(crate) support: Support,
    /// Groups of rows; groups are shared between types.
    pub(crate) params: &'static [&'static [Row]],
}

impl Entity {
    const fn new(name: &'static str, params: &'static [&'static [Row]]) -> Self {
        Entity { name, support: Support::Yes, params }
    }
    const fn instead(mut self, what: &'static str) -> Self {
        self.support = Support::Instead(what);
        self
    }
    const fn refused(mut self, remedy: &'static str) -> Self {
        self.support = Support::Refused(remedy);
        self
    }
    /// All its parameters.
    pub(crate) fn rows(&self) -> impl Iterator<Item = &'static Row> + Clone {
        self.params.iter().flat_map(|group| group.iter())
    }
}

/// The statements that take a type and parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Category {
    Shape,
    Light,
    AreaLight,
    Material,
    FloatTexture,
    SpectrumTexture,
    Medium,
    Camera,
    Film,
    Filter,
    Sampler,
    Integrator,
    Accelerator,
}

impl Category {
    /// All types of the statement.
    pub(crate) fn entities(self) -> &'static [Entity] {
        match self {
            Category::Shape => &shapes::SHAPES,
            Category::Light => &lights::LIGHTS,
            Category::AreaLight => &lights::AREA_LIGHTS,
            Category::Material => &materials::MATERIALS,
            Category::FloatTexture => &textures::FLOAT_TEXTURES,
            Category::SpectrumTexture => &textures::SPECTRUM_TEXTURES,
            Category::Medium => &media::MEDIA,
            Category::Camera => &render::CAMERAS,
            Category::Film => &render::FILMS,
            Category::Filter => &render::FILTERS,
            Category::Sampler => &render::SAMPLERS,
            Category::Integrator => &render::INTEGRATORS,
            Category::Accelerator => &render::ACCELERATORS,
        }
    }
    /// The type of that name.
    pub(crate) fn find(self, name: &str) -> Option<&'static Entity> {
        self.entities().iter().find(|e| e.name == name)
    }
    /// All names of types; materials have the registry's models beside pbrt-v4's.
    pub(crate) fn names(self) -> impl Iterator<Item = &'static str> + Clone {
        let own = ModelKind::all().filter(move |_| self == Category::Material);
        let own = own.map(ModelKind::name).filter(move |n| self.find(n).is_none());
        self.entities().iter().map(|e| e.name).chain(own)
    }
    /// In words, for messages.
    pub(crate) fn noun(self) -> &'static str {
        match self {
            Category::Shape => "shape",
            Category::Light => "light",
            Category::AreaLight => "area light",
            Category::Material => "material",
            Category::FloatTexture => "float texture",
            Category::SpectrumTexture => "spectrum texture",
            Category::Medium => "medium",
            Category::Camera => "camera",
            Category::Film => "film",
            Category::Filter => "pixel filter",
            Category::Sampler => "sampler",
            Category::Integrator => "integrator",
            Category::Accelerator => "accelerator",
        }
    }
}

/// Every directive. Those with a type and parameters share a form; the others are read one by one.
pub(crate) const DIRECTIVES: [&str; 44] = [
    "Accelerator",
    "ActiveTransform",
    "AreaLightSource",
    "Attribute",
    "AttributeBegin",
    "AttributeEnd",
    "Camera",
    "ColorSpace",
    "ConcatTransform",
    "CoordSysTransform",
    "CoordinateSystem",
    "Film",
    "Identity",
    "Import",
    "Include",
    "Integrator",
    "LightSource",
    "LookAt",
    "MakeNamedMaterial",
    "MakeNamedMedium",
    "Material",
    "MediumInterface",
    "NamedMaterial",
    "ObjectBegin",
    "ObjectEnd",
    "ObjectInstance",
    "Option",
    "PixelFilter",
    "ReverseOrientation",
    "Rotate",
    "Sampler",
    "Scale",
    "Shape",
    "Texture",
    "Transform",
    "TransformBegin",
    "TransformEnd",
    "TransformTimes",
    "Translate",
    "WorldBegin",
    "WorldEnd",
    // Of pbrt-v3 and earlier; they are recognised so that reading can go on behind them.
    "Renderer",
    "SurfaceIntegrator",
    "VolumeIntegrator",
];

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Category; 13] = [
        Category::Shape,
        Category::Light,
        Category::AreaLight,
        Category::Material,
        Category::FloatTexture,
        Category::SpectrumTexture,
        Category::Medium,
        Category::Camera,
        Category::Film,
        Category::Filter,
        Category::Sampler,
        Category::Integrator,
        Category::Accelerator,
    ];

    #[test]
    fn no_name_stands_twice() {
        for category in ALL {
            for (i, e) in category.entities().iter().enumerate() {
                assert!(category.entities()[..i].iter().all(|o| o.name != e.name), "{category:?} {}", e.name);
                let rows: Vec<_> = e.rows().collect();
                for (j, r) in rows.iter().enumerate() {
                    assert!(rows[..j].iter().all(|o| o.name != r.name), "{category:?} {} {}", e.name, r.name);
                }
            }
        }
    }

    #[test]
    fn types_are_known_by_all_spellings() {
        assert_eq!(Type::from_name("point"), Some(Type::Point3));
        assert_eq!(Type::from_name("color"), None);
        for (_, t) in TYPES {
            assert_eq!(Type::from_name(t.name()), Some(t));
        }
    }

    #[test]
    fn tables_hold_all_of_pbrt() {
        // Counts of the types that pbrt-v4's Create functions tell apart, and of Sparrow's own.
        let counts = ALL.map(|c| c.entities().iter().filter(|e| !e.name.is_empty()).count());
        assert_eq!(counts, [9, 6, 1, 13, 12, 10, 5, 4, 3, 5, 7, 13, 2]);
    }
}
