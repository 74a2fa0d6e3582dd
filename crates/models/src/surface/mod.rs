//! Models of surfaces. Adding one takes a file here and a line in the table below.

use crate::registry::models;

mod ashikhmin_shirley;
mod banks;
mod blinn_phong;
mod bouguer;
mod charlie;
mod coated_conductor;
mod coated_diffuse;
mod conductor;
mod cook_torrance;
mod dielectric;
mod diffuse_transmission;
mod eon;
mod lambert;
mod microfacet_dielectric;
mod microfacet_reflection;
mod minnaert;
mod oren_nayar;
mod phong;
mod poulin_fournier;
mod principled;
mod sheen;
mod thin_dielectric;
mod thin_film;
mod torrance_sparrow;
mod torrance_sparrow_1967;
mod v_groove;
mod velvet;
mod ward;

models! {
    /// Every surface model, by value: `Copy`, exhaustive, without allocation.
    Surface, SurfaceKind: Bsdf {
        Lambert = lambert::Lambert, "lambert";
        OrenNayar = oren_nayar::OrenNayar, "oren_nayar";
        Eon = eon::Eon, "eon";
        Minnaert = minnaert::Minnaert, "minnaert";
        Phong = phong::Phong, "phong";
        BlinnPhong = blinn_phong::BlinnPhong, "blinn_phong";
        TorranceSparrow = torrance_sparrow::TorranceSparrow, "torrance_sparrow";
        TorranceSparrow1967 = torrance_sparrow_1967::TorranceSparrow1967, "torrance_sparrow_1967";
        VGroove = v_groove::VGroove, "v_groove";
        CookTorrance = cook_torrance::CookTorrance, "cook_torrance";
        AshikhminShirley = ashikhmin_shirley::AshikhminShirley, "ashikhmin_shirley";
        Ward = ward::Ward, "ward";
        PoulinFournier = poulin_fournier::PoulinFournier, "poulin_fournier";
        Banks = banks::Banks, "banks";
        Bouguer = bouguer::Bouguer, "bouguer";
        Velvet = velvet::Velvet, "velvet";
        Charlie = charlie::Charlie, "charlie";
        Sheen = sheen::Sheen, "sheen";
        DiffuseTransmission = diffuse_transmission::DiffuseTransmission, "diffuse_transmission";
        CoatedDiffuse = coated_diffuse::CoatedDiffuse, "coated_diffuse";
        CoatedConductor = coated_conductor::CoatedConductor, "coated_conductor";
        Conductor = conductor::Conductor, "conductor";
        ThinFilm = thin_film::ThinFilm, "thin_film";
        Dielectric = dielectric::Dielectric, "dielectric";
        MicrofacetReflection = microfacet_reflection::MicrofacetReflection, "microfacet_reflection";
        MicrofacetDielectric = microfacet_dielectric::MicrofacetDielectric, "microfacet_dielectric";
        Principled = principled::Principled, "principled";
        ThinDielectric = thin_dielectric::ThinDielectric, "thin_dielectric";
    }
}
