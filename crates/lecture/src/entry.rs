//! The table of figures: [`Topic`]s and their [`Entry`]s.

use crate::error::LectureError;
use crate::figure::Figure;
use crate::slide::{SLIDES, UNTITLED};
use crate::studio::Studio;
use crate::topic::TOPICS;

/// A figure that can be made.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Its name in files and links, unique: `off-specular-aluminium`.
    pub id: &'static str,
    /// Its title.
    pub title: &'static str,
    /// Slides that it stands for; none for what goes beyond the lecture.
    pub rows: &'static [u8],
    /// Makes it.
    pub make: fn(&Studio<'_>) -> Result<Figure, LectureError>,
}

/// A page of the book.
#[derive(Clone, Copy, Debug)]
pub struct Topic {
    /// Its name in files: `microfacets`.
    pub id: &'static str,
    /// Its title.
    pub title: &'static str,
    /// What it is about; plain text, a line feed parts paragraphs.
    pub about: &'static str,
    /// Its figures.
    pub figures: &'static [Entry],
}

/// The entries that `only` names, by number of a slide or by id; all for none.
///
/// # Errors
/// Where there is no such slide or figure.
pub fn select(only: Option<&str>) -> Result<Vec<(&'static Topic, &'static Entry)>, LectureError> {
    let all = TOPICS.iter().flat_map(|t| t.figures.iter().map(move |e| (t, e)));
    let Some(name) = only else { return Ok(all.collect()) };
    let row = name.parse::<u8>().ok();
    let chosen: Vec<_> =
        all.clone().filter(|(_, e)| e.id == name || row.is_some_and(|r| e.rows.contains(&r))).collect();
    if !chosen.is_empty() {
        return Ok(chosen);
    }
    let remedy = match row {
        Some(UNTITLED) => "it has neither title nor text, so nothing is known of it".to_owned(),
        Some(r) if SLIDES.iter().any(|s| s.row == r) => "its figure is not made yet".to_owned(),
        _ => {
            let ids: Vec<&str> = all.map(|(_, e)| e.id).collect();
            let near = sparrow_models::suggest::nearest(name, ids.iter().copied());
            let near = near.map_or(String::new(), |n| format!("did you mean `{n}`? "));
            format!("{near}slides go from 1 to {}; --list shows all figures", SLIDES.len())
        }
    };
    Err(LectureError::Unknown { name: name.to_owned(), remedy })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_named_by_slide_and_by_id() {
        let ids = |only| select(Some(only)).map(|all| all.iter().map(|(_, e)| e.id).collect::<Vec<_>>());
        assert_eq!(ids("18").unwrap(), ["kajiya-kay-terms"]);
        assert_eq!(ids("fresnel").unwrap(), ["fresnel"]);
        let said = |only| ids(only).unwrap_err().to_string();
        assert!(said("26").contains("neither title nor text"));
        assert!(said("fresnell").contains("did you mean `fresnel`?"));
        assert!(said("30").contains("slides go from 1 to 29"));
    }
}
