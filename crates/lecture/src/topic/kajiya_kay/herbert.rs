//! Slide 19: a furry character by two models of fur.

use sparrow_plot::draw::table::Table;

use crate::{Check, Figure, Formula, LectureError, Photo, Picture, Studio};

const SCENES: [(&str, &str); 2] = [("kajiya-kay", "Kajiya-Kay"), ("chiang", "Chiang et al.")];
/// Part of the picture's width over which profiles are averaged: the hind part, whose upper rim has the rear lamp behind it.
const COLUMNS: [f64; 2] = [0.14, 0.26];

/// Brightness down the picture, in parts of its height.
fn down(photo: &Photo) -> Vec<[f64; 2]> {
    let [w, h] = photo.size;
    let [first, end] = COLUMNS.map(|c| (c * w as f64) as usize);
    (0..h).map(|y| [(y as f64 + 0.5) / h as f64, photo.mean(first..end, y..y + 1)]).collect()
}

/// The mean of a profile between two heights.
fn mean(profile: &[[f64; 2]], from: f64, to: f64) -> f64 {
    let part: Vec<f64> = profile.iter().filter(|p| p[0] >= from && p[0] < to).map(|p| p[1]).collect();
    part.iter().sum::<f64>() / part.len() as f64
}

/// Brightness of a tuft of hair over that of what surrounds it, where light comes from everywhere.
fn furnace(studio: &Studio<'_>, material: &str) -> Result<f64, LectureError> {
    let side = studio.pick(16, 48);
    let photo = studio.render_with("lecture/furnace.pbrt", material, [side; 2], studio.pick(64, 128))?;
    let n = side as usize;
    // The tuft fills the middle third; the first columns show the light itself.
    Ok(photo.mean(n * 3 / 8..n * 5 / 8, 0..n) / photo.mean(0..n / 8, 0..n))
}

/// Slide 19.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let size = studio.pick([110, 88], [500, 400]);
    let mut table = Table::new(["model", "height_from_top", "brightness"]);
    let (mut pictures, mut commands, mut rims) = (Vec::new(), Vec::new(), Vec::new());
    for (id, name) in SCENES {
        let scene = format!("lecture/herbert-{id}.pbrt");
        let photo = studio.render(&scene, size, studio.pick(10, 96))?;
        let profile = down(&photo);
        profile.iter().for_each(|p| table.named(id, *p));
        rims.push(mean(&profile, 0.29, 0.38) / mean(&profile, 0.45, 0.7));
        let alt = format!("A round animal in long fur on a grey floor, its fur by {name}.");
        pictures.push(Picture::png(id, alt, photo.png(0.8)?).labelled(name));
        commands.push(format!("sparrow render scenes/{scene}"));
    }
    commands.push(
        r#"sparrow render scenes/lecture/herbert-chiang.pbrt --material '"fur" "string type" "hair" "float eumelanin" 0.05 "float pheomelanin" 0.1'"#
            .to_owned(),
    );
    let chiang = furnace(
        studio,
        r#""hair" "string type" "hair" "rgb sigma_a" [ 0 0 0 ] "float beta_m" 0.3 "float beta_n" 0.3 "float alpha" 0"#,
    )?;
    let kay = furnace(
        studio,
        r#""hair" "string type" "kajiya_kay" "rgb diffuse" [ 0.5 0.5 0.5 ] "rgb specular" [ 0.5 0.5 0.5 ]"#,
    )?;
    let figure = Figure {
        caption: "The same strands and lamps, one in front and one behind at the upper left. Kajiya and Kay's hair is matt with a highlight: coloured like paint, with shadows between tufts. In \
            the fibre of Chiang and others light passes through and from hair to hair: the rim before the rear lamp glows, the body is darker and deeper in colour.\n\
            In a furnace, light from everywhere and no absorption, the fibre must vanish; Kajiya and Kay's loses light where it grazes, as its highlight is normalised \
            for light from the side alone."
            .to_owned(),
        formulas: vec![
            Formula::new("S = k_d frac{1}{π^2} + k_s frac{cos^s (θ_o + θ_i)}{2 π B}", "[KajiyaKay1989]", "models/src/fibre/kajiya_kay.rs: f_cos_pdf"),
            Formula::new("S = sum_p M_p (θ_i, θ_o) A_p N_p (φ)", "[Chiang2016]", "models/src/fibre/hair.rs: f_cos_pdf"),
        ],
        commands,
        pictures,
        table: Some(table),
        checks: vec![
            Check::at_least("Chiang: brightness of the rim before the rear lamp over that of the body", rims[1], 1.0),
            Check::at_least("the same ratio over that of Kajiya-Kay", rims[1] / rims[0], 1.4),
            Check::near("Chiang in a furnace: brightness of the tuft over that of what surrounds it", chiang, 1.0, 0.02),
            Check::at_most("Kajiya-Kay in a furnace, kd = ks = 0.5", kay, 1.0),
        ],
        ..Figure::default()
    };
    Ok(figure.with("hairs", 16_000))
}
