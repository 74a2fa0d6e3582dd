//! What names of pbrt-v3 and earlier are called now, for messages.

use super::Category;

const TYPES: &[(Category, &str, &str)] = &[
    (Category::Material, "matte", "diffuse"),
    (Category::Material, "plastic", "coateddiffuse"),
    (Category::Material, "substrate", "coateddiffuse"),
    (Category::Material, "uber", "coateddiffuse"),
    (Category::Material, "metal", "conductor"),
    (Category::Material, "mirror", "conductor"),
    (Category::Material, "glass", "dielectric"),
    (Category::Material, "translucent", "diffusetransmission"),
    (Category::Film, "image", "rgb"),
    (Category::Camera, "environment", "spherical"),
    (Category::Sampler, "random", "independent"),
    (Category::Sampler, "lowdiscrepancy", "paddedsobol"),
    (Category::Sampler, "02sequence", "paddedsobol"),
    (Category::Sampler, "maxmindist", "pmj02bn"),
    (Category::Light, "exinfinite", "infinite"),
    (Category::AreaLight, "area", "diffuse"),
    (Category::Medium, "heterogeneous", "uniformgrid"),
    (Category::Accelerator, "grid", "bvh"),
];

const PARAMETERS: &[(Category, &str, &str)] = &[
    (Category::Material, "Kd", "reflectance"),
    (Category::Material, "Kr", "reflectance"),
    (Category::Material, "index", "eta"),
    (Category::Material, "bumpmap", "displacement"),
    (Category::Filter, "xwidth", "xradius"),
    (Category::Filter, "ywidth", "yradius"),
    (Category::Filter, "alpha", "sigma"),
    (Category::Film, "maxsampleluminance", "maxcomponentvalue"),
    (Category::Film, "scale", "iso"),
    (Category::Shape, "st", "uv"),
    (Category::Light, "mapname", "filename"),
    (Category::Light, "imagefile", "filename"),
    (Category::AreaLight, "imagefile", "filename"),
    (Category::Integrator, "lightsamplestrategy", "lightsampler"),
    (Category::FloatTexture, "trilinear", "filter"),
    (Category::SpectrumTexture, "trilinear", "filter"),
];

fn look_up(table: &[(Category, &str, &'static str)], category: Category, old: &str) -> Option<&'static str> {
    table.iter().find(|(c, o, _)| *c == category && *o == old).map(|&(_, _, new)| new)
}

/// The present name of an old type (`parameter` false) or parameter (true).
pub(crate) fn successor(category: Category, old: &str, parameter: bool) -> Option<&'static str> {
    look_up(if parameter { PARAMETERS } else { TYPES }, category, old)
}
