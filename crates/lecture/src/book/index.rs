//! The first page: how the slides stand, and the topics.

use core::fmt::Write;

use super::html::{document, escaped};
use super::{Book, Row, Standing};
use crate::slide::SLIDES;

/// The document.
pub(super) fn html(book: &Book) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write!(
        out,
        "<header>\n<h1>Reflection models</h1>\n<p class=\"lead\">A lecture, runnable: every figure is computed by the code that \
         renders, and checked against numbers that are known.</p>\n</header>\n<main>\n{}",
        summary(book)
    );
    let _ = writeln!(out, "<h2>Topics</h2>\n<ol class=\"topics\">");
    for topic in book.topics() {
        let about = escaped(topic.about.lines().next().unwrap_or_default());
        let title = escaped(topic.title);
        let _ = writeln!(
            out,
            "<li><a href=\"{}.html\">{title}</a><br><span class=\"soft\">{about}</span></li>",
            topic.id
        );
    }
    let _ = writeln!(
        out,
        "</ol>\n<h2>Slides</h2>\n<div class=\"wide\">\n<table class=\"slides\">\n<thead><tr><th>No.</th><th>Slide</th><th>Figures</th>\
         <th>Checks</th></tr></thead>\n<tbody>"
    );
    book.rows().iter().for_each(|row| out.push_str(&line(row)));
    let _ = write!(
        out,
        "</tbody>\n</table>\n</div>\n<p class=\"soft\">The slides are those of CS348B, Lecture 13, Spring 2004, by Pat Hanrahan, of \
         which titles and formulas are known, but not the pictures. What a picture showed is inferred from title and sources.</p>\n\
         <p class=\"soft\">Made by Sparrow {} in {} quality. The numbers of all checks are in <a href=\"book.json\">book.json</a>.</p>\n\
         </main>\n",
        env!("CARGO_PKG_VERSION"),
        book.quality.name()
    );
    document("Reflection models: a lecture, runnable", out)
}

/// Passed and total.
fn summary(book: &Book) -> String {
    let [passed, failed, absent] =
        [Standing::Passed, Standing::Failed, Standing::Absent].map(|s| book.count(s));
    let class = if failed == 0 { "passed" } else { "failed" };
    let mut out = format!("<p class=\"verdict {class}\"><b>{passed} of {}</b> slides passed", SLIDES.len());
    if failed > 0 {
        let _ = write!(out, ", {failed} failed");
    }
    if absent > 0 {
        let _ = write!(out, ", {absent} are not in this book");
    }
    if book.count(Standing::Untitled) > 0 {
        out.push_str(", 1 has neither title nor text, so that there is nothing to check");
    }
    let checks = book.figures.iter().flat_map(|m| &m.figure.checks);
    let (n, held) = (checks.clone().count(), checks.filter(|c| c.holds()).count());
    let _ = writeln!(out, ". {held} of {n} checks hold.</p>");
    out
}

fn line(row: &Row<'_>) -> String {
    let (class, word) = match row.standing {
        Standing::Passed => ("passed", "passed"),
        Standing::Failed => ("failed", "failed"),
        Standing::Absent => ("soft", "not in this book"),
        Standing::Untitled => ("soft", "nothing to check"),
    };
    let link = |m: &&super::Made| {
        format!("<a href=\"{}.html#{}\">{}</a>", m.topic.id, m.entry.id, escaped(m.entry.title))
    };
    let links: Vec<String> = row.figures.iter().map(link).collect();
    format!(
        "<tr><td>{}</td><td>{}<br><span class=\"soft\">{}</span></td><td>{}</td><td class=\"{class}\">{word}</td></tr>\n",
        row.slide.row,
        escaped(row.slide.title),
        escaped(row.slide.shows),
        links.join("<br>")
    )
}
