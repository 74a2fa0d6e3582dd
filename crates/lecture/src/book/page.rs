//! The page of a topic.

use core::fmt::Write;

use super::html::{document, escaped, number, paragraphs, rich};
use super::{Book, Made};
use crate::check::{Bound, Check};
use crate::entry::Topic;
use crate::figure::{Content, Figure};
use crate::mathml::mathml;

/// The document.
pub(super) fn html(book: &Book, topic: &Topic) -> String {
    let mut out = format!(
        "<header>\n{}<h1>{}</h1>\n{}</header>\n<main>\n",
        navigation(book, topic),
        escaped(topic.title),
        paragraphs(topic.about)
    );
    for made in book.figures.iter().filter(|m| m.topic.id == topic.id) {
        out.push_str(&section(made));
    }
    let _ = write!(out, "</main>\n<footer>\n{}</footer>\n", navigation(book, topic));
    document(&format!("{} · Reflection models", topic.title), out)
}

fn navigation(book: &Book, topic: &Topic) -> String {
    let topics = book.topics();
    let at = topics.iter().position(|t| t.id == topic.id).unwrap_or(0);
    let link = |t: Option<&&Topic>, before: &str, after: &str| {
        t.map_or(String::new(), |t| {
            format!("<a href=\"{}.html\">{before}{}{after}</a>\n", t.id, escaped(t.title))
        })
    };
    let last = at.checked_sub(1).and_then(|i| topics.get(i));
    format!(
        "<nav>\n{}<a href=\"index.html\">Contents</a>\n{}</nav>\n",
        link(last, "← ", ""),
        link(topics.get(at + 1), "", " →")
    )
}

fn section(made: &Made) -> String {
    let figure = &made.figure;
    let mut out = format!(
        "<section id=\"{}\">\n<h2>{}{}</h2>\n<figure>\n",
        made.entry.id,
        escaped(made.entry.title),
        slides(made.entry.rows)
    );
    out.push_str(&pictures(made));
    let _ = write!(out, "<figcaption>\n{}</figcaption>\n</figure>\n", paragraphs(&figure.caption));
    out.push_str(&formulas(figure));
    out.push_str(&verdict(figure));
    out.push_str(&origin(made));
    out.push_str("</section>\n");
    out
}

fn slides(rows: &[u8]) -> String {
    let numbers: Vec<String> = rows.iter().map(u8::to_string).collect();
    match rows {
        [] => String::new(),
        [one] => format!(" <span class=\"slide\">slide {one}</span>"),
        _ => format!(" <span class=\"slide\">slides {}</span>", numbers.join(", ")),
    }
}

fn pictures(made: &Made) -> String {
    let n = made.figure.pictures.len();
    let class = match n {
        1 => " one",
        _ if n.is_multiple_of(3) => " three",
        _ => "",
    };
    let mut out = format!("<div class=\"pictures{class}\">\n");
    for (i, picture) in made.figure.pictures.iter().enumerate() {
        let file = made.picture_file(i);
        let class = match picture.content {
            Content::Svg(_) => "plot",
            Content::Png(_) => "render",
        };
        let _ = write!(out, "<div><img class=\"{class}\" src=\"{file}\" alt=\"{}\">", escaped(&picture.alt));
        if !picture.label.is_empty() {
            let _ = write!(out, "<div class=\"label\">{}</div>", escaped(&picture.label));
        }
        out.push_str("</div>\n");
    }
    out + "</div>\n"
}

fn formulas(figure: &Figure) -> String {
    let mut out = String::new();
    for f in &figure.formulas {
        let _ = writeln!(
            out,
            "<div class=\"formula\">\n<div class=\"wide\">{}</div>\n<div class=\"soft\">{} · <code>{}</code></div>\n</div>",
            mathml(f.text),
            escaped(f.source),
            escaped(f.code)
        );
    }
    out
}

fn verdict(figure: &Figure) -> String {
    let held = figure.checks.iter().filter(|c| c.holds()).count();
    let n = figure.checks.len();
    let (class, word) = if figure.passed() { ("passed", "Passed") } else { ("failed", "Failed") };
    if n == 0 {
        return "<p class=\"verdict failed\"><b>Not checked.</b></p>\n".to_owned();
    }
    let first = figure.checks.iter().find(|c| !c.holds()).or(figure.checks.first());
    let said =
        first.map_or(String::new(), |c| format!("{}: {}, {}.", rich(&c.what), number(c.measured), bound(c)));
    let mut out = format!("<p class=\"verdict {class}\"><b>{word}</b>, {held} of {n} checks. {said}</p>\n");
    if n == 1 {
        return out;
    }
    let _ = write!(
        out,
        "<details{}>\n<summary>All checks</summary>\n<div class=\"wide\">\n<table>\n<thead><tr><th>what</th><th>number</th>\
         <th>expected</th><th></th></tr></thead>\n<tbody>\n",
        if n <= 6 { " open" } else { "" }
    );
    for c in &figure.checks {
        let (class, word) = if c.holds() { ("passed", "holds") } else { ("failed", "fails") };
        let _ = writeln!(
            out,
            "<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"{class}\">{word}</td></tr>",
            rich(&c.what),
            number(c.measured),
            bound(c)
        );
    }
    out + "</tbody>\n</table>\n</div>\n</details>\n"
}

fn bound(c: &Check) -> String {
    match c.bound {
        Bound::Near { expected, tolerance } => format!("{} ± {}", number(expected), number(tolerance)),
        Bound::AtMost(v) => format!("at most {}", number(v)),
        Bound::AtLeast(v) => format!("at least {}", number(v)),
    }
}

/// Commands, parameters, numbers.
fn origin(made: &Made) -> String {
    let mut out = "<dl class=\"origin\">\n".to_owned();
    let own = format!("sparrow lecture --only {}", made.entry.id);
    let lines: Vec<String> = core::iter::once(&own)
        .chain(&made.figure.commands)
        .map(|c| format!("<code>{}</code>", escaped(c)))
        .collect();
    let _ = writeln!(out, "<dt>Command</dt><dd>{}</dd>", lines.join("<br>"));
    if !made.figure.parameters.is_empty() {
        let all: Vec<String> = made
            .figure
            .parameters
            .iter()
            .map(|(name, value)| format!("{} = {}", rich(name), rich(value)))
            .collect();
        let _ = writeln!(out, "<dt>Parameters</dt><dd>{}</dd>", all.join("; "));
    }
    if made.figure.table.is_some() {
        let file = made.table_file();
        let _ = writeln!(out, "<dt>Numbers</dt><dd><a href=\"{file}\">{file}</a></dd>");
    }
    out + "</dl>\n"
}
