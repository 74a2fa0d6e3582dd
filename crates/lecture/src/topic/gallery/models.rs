//! Every registered model on one scene, its parameters varied after its own table.

use sparrow_models::{ModelKind, ParamInfo, ParamKind};
use sparrow_plot::draw::table::{Field, Table};

use crate::overlay::{Mark, over};
use crate::sheet::Sheet;
use crate::{Check, Figure, LectureError, Picture, Studio};

/// Pictures in a row.
const COLUMNS: usize = 6;
/// Pixels above each picture, for its name.
const HEAD: usize = 14;
/// What a parameter without an upper bound is raised to.
const UNBOUNDED: f64 = 4.0;

/// The material of a scene with one parameter of a model set, and what stands over its picture.
fn variations(kind: ModelKind) -> Vec<(String, String)> {
    let start = format!(r#""look" "string type" "{}""#, kind.name());
    let mut all = vec![("default".to_owned(), start.clone())];
    for p in kind.params().iter().filter(|p| (kind.name(), p.name) != ("hair", "absorption")) {
        for (value, words) in settings(p, scene_word(kind, p.name)) {
            all.push((format!("{} {value}", p.name), format!("{start} {words}")));
        }
    }
    all
}

/// The word of a scene for a parameter: pbrt-v4's own materials have pbrt-v4's words, with which hair needs no choice of `absorption`.
fn scene_word(kind: ModelKind, name: &'static str) -> &'static str {
    match (kind.name(), name) {
        ("conductor" | "dielectric", "alpha_x") => "uroughness",
        ("conductor" | "dielectric", "alpha_y") => "vroughness",
        ("hair", "color") => "reflectance",
        _ => name,
    }
}

/// Values of a parameter other than its default, with the words of a scene: the ends of what a slider offers, or the other choices.
fn settings(p: &ParamInfo, word: &str) -> Vec<(String, String)> {
    if let ParamKind::Choice(names) = p.kind {
        let others = names.iter().enumerate().filter(|(i, _)| *i != p.default as usize);
        return others.map(|(_, n)| ((*n).to_owned(), format!(r#""string {word}" "{n}""#))).collect();
    }
    let high = if p.soft[1].is_finite() { p.soft[1] } else { UNBOUNDED.max(2.0 * p.default) };
    let ends = [p.soft[0], high].into_iter().filter(|v| (v - p.default).abs() > 1e-9);
    ends.map(|v| {
        let words = match p.kind {
            ParamKind::Real if word.ends_with("roughness") && word != p.name => {
                format!(r#""float {word}" {v} "bool remaproughness" false"#)
            }
            ParamKind::Real => format!(r#""float {word}" {v}"#),
            ParamKind::Albedo | ParamKind::Unbounded | ParamKind::Choice(_) => {
                format!(r#""rgb {word}" [ {v} {v} {v} ]"#)
            }
        };
        (v.to_string(), words)
    })
    .collect()
}

/// The gallery of models of surfaces.
pub(super) fn surfaces(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    gallery(studio, "lecture/model-surface.pbrt", |k| matches!(k, ModelKind::Surface(_)))
}

/// The gallery of models of fibres.
pub(super) fn fibres(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    gallery(studio, "lecture/model-fibre.pbrt", |k| matches!(k, ModelKind::Fibre(_)))
}

fn gallery(
    studio: &Studio<'_>,
    scene: &str,
    belongs: impl Fn(&ModelKind) -> bool,
) -> Result<Figure, LectureError> {
    let (side, spp) = (studio.pick(32, 96), studio.pick(4, 32));
    let mut table = Table::new(["model", "setting", "brightness"]);
    let mut figure = Figure {
        caption: "The first picture of each model has the defaults of its table; the others have one parameter at either end of what a slider offers, or at another of its choices. Parameters that \
            matter only beside a choice that is not the default change nothing here."
            .to_owned(),
        ..Figure::default()
    };
    let (mut shown, mut faults) = (0_u32, 0_u32);
    let models: Vec<ModelKind> = ModelKind::all().filter(belongs).collect();
    for &kind in &models {
        let all = variations(kind);
        let n = side as usize;
        let mut sheet = Sheet::new([n, n], all.len(), COLUMNS, HEAD * n / 96);
        let mut photos = Vec::new();
        for (i, (setting, material)) in all.iter().enumerate() {
            let photo = studio.render_with(scene, material, [side; 2], spp)?;
            let brightness = photo.brightness();
            faults += u32::from(!(brightness.is_finite() && brightness > 0.0));
            table.rows.push(vec![
                Field::Text(kind.name().to_owned()),
                Field::Text(setting.clone()),
                Field::Number(brightness),
            ]);
            sheet.put(i, &photo, 1.0);
            photos.push(photo);
        }
        shown += u32::from(photos.iter().any(|p| p.rgb != photos[0].rgb));
        let scale = 96.0 / f64::from(side);
        let words: Vec<([f64; 2], &str)> = all
            .iter()
            .enumerate()
            .map(|(i, (setting, _))| (sheet.corner(i).map(|v| v as f64), setting.as_str()))
            .map(|([x, y], s)| ([x + 2.0 / scale, y + 11.0 / scale], s))
            .collect();
        let marks: Vec<Mark<'_>> = words.iter().map(|(at, s)| Mark::Word(*at, s, 96.0)).collect();
        let svg = over(&sheet.png()?, sheet.size, scale, &marks);
        let alt = format!(
            "{} pictures of a ball of {}, each with another parameter changed.",
            all.len(),
            kind.name()
        );
        figure.pictures.push(Picture::svg(kind.name(), alt, svg).labelled(format!(
            "{}: {}",
            kind.name(),
            kind.about().summary
        )));
    }
    let what = "models whose parameters change their picture";
    figure.checks.push(Check::at_least(what, f64::from(shown), models.len() as f64));
    figure.checks.push(Check::at_most("pictures that are black or no numbers", f64::from(faults), 0.0));
    figure.commands.push(format!(
        r#"sparrow render scenes/{scene} --material '"look" "string type" "{}"'"#,
        if scene.contains("fibre") { "hair" } else { "charlie" }
    ));
    figure.table = Some(table);
    Ok(figure)
}
