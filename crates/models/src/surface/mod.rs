//! Models of surfaces. Adding one takes a file here and a line in the table below.

use crate::registry::models;

mod conductor;
mod dielectric;
mod diffuse_transmission;
mod lambert;
mod thin_dielectric;

models! {
    /// Every surface model, by value: `Copy`, exhaustive, without allocation.
    Surface, SurfaceKind: Bsdf {
        Lambert = lambert::Lambert, "lambert";
        DiffuseTransmission = diffuse_transmission::DiffuseTransmission, "diffuse_transmission";
        Conductor = conductor::Conductor, "conductor";
        Dielectric = dielectric::Dielectric, "dielectric";
        ThinDielectric = thin_dielectric::ThinDielectric, "thin_dielectric";
    }
}
