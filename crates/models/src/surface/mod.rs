//! Models of surfaces. Adding one takes a file here and a line in the table below.

use crate::registry::models;

mod blinn_phong;
mod conductor;
mod dielectric;
mod diffuse_transmission;
mod eon;
mod lambert;
mod oren_nayar;
mod phong;
mod thin_dielectric;
mod torrance_sparrow;

models! {
    /// Every surface model, by value: `Copy`, exhaustive, without allocation.
    Surface, SurfaceKind: Bsdf {
        Lambert = lambert::Lambert, "lambert";
        OrenNayar = oren_nayar::OrenNayar, "oren_nayar";
        Eon = eon::Eon, "eon";
        Phong = phong::Phong, "phong";
        BlinnPhong = blinn_phong::BlinnPhong, "blinn_phong";
        TorranceSparrow = torrance_sparrow::TorranceSparrow, "torrance_sparrow";
        DiffuseTransmission = diffuse_transmission::DiffuseTransmission, "diffuse_transmission";
        Conductor = conductor::Conductor, "conductor";
        Dielectric = dielectric::Dielectric, "dielectric";
        ThinDielectric = thin_dielectric::ThinDielectric, "thin_dielectric";
    }
}
