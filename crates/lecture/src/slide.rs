//! The slides of the lecture, as far as its text names them: [`SLIDES`].

/// A slide.
#[derive(Clone, Copy, Debug)]
pub struct Slide {
    /// Its number, from 1.
    pub row: u8,
    /// Its title.
    pub title: &'static str,
    /// What it shows, as far as title and sources tell.
    pub shows: &'static str,
}

const fn slide(row: u8, title: &'static str, shows: &'static str) -> Slide {
    Slide { row, title, shows }
}

/// The only slide without title and text, of which nothing can be shown.
pub(crate) const UNTITLED: u8 = 26;

/// All slides that show something, in their order.
pub const SLIDES: [Slide; 29] = [
    slide(1, "Microfacet Model, Torrance-Sparrow Model", "D = cosˢ α over 4 cos cos"),
    slide(2, "Torrance-Sparrow Theory", "with Fresnel and shadowing"),
    slide(3, "Torrance-Sparrow Theory", "Fig. 6: Fresnel reflectance"),
    slide(4, "Torrance-Sparrow Theory", "Fig. 7: G/cos θ in the plane of incidence"),
    slide(5, "Torrance-Sparrow Comparison", "aluminium"),
    slide(6, "Torrance-Sparrow Comparison", "magnesium oxide"),
    slide(7, "“Diffuse” Reflection", "no microfacet distribution is diffuse"),
    slide(8, "Anisotropic Reflection", "brushed bodies"),
    slide(9, "Quarterhorse", "a coat's highlight"),
    slide(10, "Reflection from a Cylinder", "parallel rays that meet a cylinder"),
    slide(11, "Reflection from a Cylinder", "reflected rays form a cone"),
    slide(12, "Reflection from a Cylinder", "the cone on the sphere of directions"),
    slide(13, "Reflection from a Cylinder", "how light is spread over the cone"),
    slide(14, "Reflection from a Cylinder", "the rule of the half vector"),
    slide(15, "Shape of Anisotropic Highlights", "fibres on sphere and cylinder"),
    slide(16, "Shape of Anisotropic Highlights", "grooves on cylinder and disc"),
    slide(17, "Anisotropic Reflection", "three models on the same body"),
    slide(18, "Kajiya-Kay Model", "diffuse and specular term"),
    slide(19, "Herbert", "a furry character"),
    slide(20, "Fiber Model", "paths R, TT and TRT"),
    slide(21, "Fiber Model", "longitudinal scattering"),
    slide(22, "Fiber Model", "azimuthal scattering"),
    slide(23, "Caustics", "where TRT turns back"),
    slide(24, "Hair Appearance", "colours and models"),
    slide(25, "Hair Appearance", "directions of the light"),
    slide(UNTITLED, "(no title)", "nothing is known of its picture"),
    slide(27, "Multiple Importance Sampling", "a circular light over a rough surface"),
    slide(28, "Multiple Importance Sampling", "two techniques and their weights"),
    slide(29, "Multiple Importance Sampling", "the plate scene of Veach and Guibas"),
];
