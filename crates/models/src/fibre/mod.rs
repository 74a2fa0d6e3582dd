//! Models of fibres. Adding one takes a file here and a line in the table below.

use crate::registry::models;

mod banks_fibre;
mod deon;
mod elliptical_hair;
mod fur;
mod hair;
mod kajiya_kay;
mod lambert_fibre;
mod marschner;
mod microfacet_hair;
mod mirror_cylinder;
mod zinke_weber;

models! {
    /// Every fibre model, by value: `Copy`, exhaustive, without allocation.
    Fibre, FibreKind: Bcsdf {
        KajiyaKay = kajiya_kay::KajiyaKay, "kajiya_kay";
        BanksFibre = banks_fibre::BanksFibre, "banks_fibre";
        LambertFibre = lambert_fibre::LambertFibre, "lambert_fibre";
        MirrorCylinder = mirror_cylinder::MirrorCylinder, "mirror_cylinder";
        Marschner = marschner::Marschner, "marschner";
        ZinkeWeber = zinke_weber::ZinkeWeber, "zinke_weber";
        DEon = deon::DEon, "deon";
        EllipticalHair = elliptical_hair::EllipticalHair, "elliptical_hair";
        MicrofacetHair = microfacet_hair::MicrofacetHair, "microfacet_hair";
        Fur = fur::Fur, "fur";
        Hair = hair::Hair, "hair";
    }
}
