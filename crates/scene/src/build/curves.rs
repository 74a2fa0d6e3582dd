//! Curves: from parameters and from files of strands.

use std::path::Path;

use super::Builder;
use crate::curve_files::{self, CurveFile};
use crate::desc::{CurveBasis, CurveKind, Curves, ShapeKind};
use crate::diagnostic::Span;
use crate::params::Params;
use crate::suggest::remedy;
use crate::tables::Type;

const KINDS: [(&str, CurveKind); 4] = [
    ("flat", CurveKind::Flat),
    ("cylinder", CurveKind::Cylinder),
    ("ribbon", CurveKind::Ribbon),
    ("round", CurveKind::Round),
];

/// Bases of files: those of curves that take nothing but points.
const BASES: [(&str, CurveBasis); 4] = [
    ("linear", CurveBasis::Linear),
    ("bezier", CurveBasis::Bezier),
    ("bspline", CurveBasis::BSpline),
    ("catmull-rom", CurveBasis::CatmullRom),
];

/// Of the groom's size: the width of strands that nothing is said about.
const WIDTH_OF_SIZE: f32 = 1e-3;
/// Where the file says nothing: a fifth faster than none, for 1.5 times the memory.
const DEFAULT_SPLIT: i32 = 1;
/// Deeper splits cost memory and gain nothing.
const MAX_SPLIT: i32 = 2;

type Point = [f32; 3];

/// The Bezier points of a curve of degree 2: each segment is raised to degree 3.
fn raised(p: &[Point]) -> Vec<Point> {
    let mix = |a: Point, b: Point| [0, 1, 2].map(|i| (a[i] + 2.0 * b[i]) / 3.0);
    let mut out = Vec::with_capacity(p.len() / 2 * 3 + 1);
    out.extend(p.first());
    for s in p.windows(3).step_by(2) {
        out.extend([mix(s[0], s[1]), mix(s[2], s[1]), s[2]]);
    }
    out
}

/// The quadratic Bezier points of a uniform quadratic B-spline: its knots halve the sides.
fn quadratic_bezier(p: &[Point]) -> Vec<Point> {
    let half = |a: Point, b: Point| [0, 1, 2].map(|i| 0.5 * (a[i] + b[i]));
    let mut out = Vec::with_capacity(2 * p.len());
    for s in p.windows(2) {
        out.extend([half(s[0], s[1]), s[1]]);
    }
    out.pop();
    out
}

/// The Bezier points of a curve through `p` with tangents `t`.
fn hermite(p: &[Point], t: &[Point]) -> Vec<Point> {
    let mut out = Vec::with_capacity(3 * p.len());
    for (i, (p, t)) in p.iter().zip(t).enumerate() {
        let off = |s: f32| [0, 1, 2].map(|k| p[k] + s * t[k] / 3.0);
        if i > 0 {
            out.push(off(-1.0));
        }
        out.extend([*p, off(1.0)]);
    }
    out.pop();
    out
}

impl Builder {
    /// The strand of a `curve`.
    pub(super) fn curve(&mut self, params: &mut Params) -> Option<Curves> {
        let kind = self.curve_kind(params, CurveKind::Flat)?;
        let (basis, p) = self.control_points(params)?;
        let n = basis.n_segments(p.len());
        let widths = self.widths(params)?.unwrap_or([1.0; 2]);
        let normals = params.take_triples("N", Type::Normal);
        let normals_at = params.place("N");
        if kind == CurveKind::Ribbon && normals.len() != n + 1 {
            let message = format!(
                "the ribbon has {n} segments and {} normals; give {} in \"normal N\", one for each end of a segment",
                normals.len(),
                n + 1
            );
            self.report.error(normals_at, message);
            return None;
        }
        if kind != CurveKind::Ribbon && !normals.is_empty() {
            self.report.warn(normals_at, "only curves of type \"ribbon\" take normals; \"N\" is ignored");
        }
        let points =
            p.iter().enumerate().map(|(j, &[x, y, z])| [x, y, z, taper(widths, basis, j, n)]).collect();
        Some(Curves {
            points,
            strands: vec![0],
            basis,
            kind,
            normals: if kind == CurveKind::Ribbon { normals } else { Vec::new() },
            split_depth: self.split_depth(params),
        })
    }

    /// The strands of a `hair`.
    pub(super) fn strands(&mut self, params: &Params) -> Option<Curves> {
        let kind = self.curve_kind(params, CurveKind::Cylinder)?;
        let Some((name, at)) = params.text("filename") else {
            self.report.error(params.at, "the hair names no file; add \"string filename\" \"...\"");
            return None;
        };
        if kind == CurveKind::Ribbon {
            self.report
                .error(at, "files of strands hold no normals; write \"string type\" \"flat\" or \"round\"");
            return None;
        }
        let widths = self.widths(params)?;
        let path = self.existing(name, at)?;
        let file = self.read_strands(name, &path, at)?;
        let basis = match params.text("basis") {
            Some((text, at)) => self.one_of("basis", text, at, &BASES)?,
            None => file.basis,
        };
        let strand_width = match widths {
            Some(w) => StrandWidth::Taper(w),
            None => StrandWidth::File { default: self.default_width(name, &file, at) },
        };
        let curves = gather(file, basis, kind, strand_width, self.split_depth(params));
        let (curves, n_left) = curves;
        if n_left > 0 {
            let least = basis.least();
            let message = format!(
                "\"{name}\": {n_left} strands of fewer than {least} points are too short for the basis; they are left out"
            );
            self.report.warn(at, message);
        }
        Some(curves)
    }

    fn read_strands(&mut self, name: &str, path: &Path, at: Span) -> Option<CurveFile> {
        let file = match curve_files::read(path) {
            Ok(file) => file,
            Err(e) => {
                self.report.error(at, format!("\"{name}\" cannot be read: {e}"));
                return None;
            }
        };
        self.report.add_file(path.to_path_buf());
        for note in &file.notes {
            self.report.warn(at, format!("\"{name}\": {note}"));
        }
        if file.strands.is_empty() {
            self.report.error(at, format!("\"{name}\" holds no strands; check that it is the right file"));
            return None;
        }
        if file.points.len() > crate::desc::MAX_POINTS {
            self.report
                .error(at, format!("\"{name}\" holds more than 2^28 points; split it into several files"));
            return None;
        }
        Some(file)
    }

    /// The width of points whose file gives none; said where there are such.
    fn default_width(&mut self, name: &str, file: &CurveFile, at: Span) -> f32 {
        let (mut lo, mut hi) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for p in &file.points {
            for i in 0..3 {
                (lo[i], hi[i]) = (lo[i].min(p[i]), hi[i].max(p[i]));
            }
        }
        let diagonal = (0..3).map(|i| (hi[i] - lo[i]) * (hi[i] - lo[i])).sum::<f32>().sqrt();
        let width = WIDTH_OF_SIZE * diagonal;
        if file.points.iter().any(|p| p[3] < 0.0) {
            let message = format!(
                "\"{name}\" gives no widths; {width} is taken, a thousandth of its size; set \"float width\" for another"
            );
            self.report.warn(at, message);
        }
        width
    }

    fn curve_kind(&mut self, params: &Params, default: CurveKind) -> Option<CurveKind> {
        match params.text("type") {
            Some((text, at)) => self.one_of("type", text, at, &KINDS),
            None => Some(default),
        }
    }

    fn one_of<T: Copy>(&mut self, what: &str, text: &str, at: Span, all: &[(&'static str, T)]) -> Option<T> {
        let found = all.iter().find(|(name, _)| *name == text).map(|&(_, value)| value);
        if found.is_none() {
            let remedy = remedy(text, all.iter().map(|a| a.0));
            self.report.error(at, format!("curves have no {what} \"{text}\"; {remedy}"));
        }
        found
    }

    /// Widths at the root and the tip, if any is given.
    fn widths(&mut self, params: &Params) -> Option<Option<[f32; 2]>> {
        let all = params.float("width");
        let ends = ["width0", "width1"].map(|name| params.float(name));
        for (name, v) in [("width", all), ("width0", ends[0]), ("width1", ends[1])] {
            if let Some(v) = v.filter(|v| !(*v >= 0.0 && v.is_finite())) {
                self.report
                    .error(params.place(name), format!("\"{name}\" is {v}; give one that is not negative"));
                return None;
            }
        }
        if all.is_none() && ends == [None; 2] {
            return Some(None);
        }
        Some(Some(ends.map(|w| w.or(all).unwrap_or(1.0))))
    }

    fn split_depth(&mut self, params: &Params) -> u8 {
        params.int("splitdepth").unwrap_or(DEFAULT_SPLIT).clamp(0, MAX_SPLIT) as u8
    }

    /// The basis that the points are kept in, and the points.
    fn control_points(&mut self, params: &mut Params) -> Option<(CurveBasis, Vec<Point>)> {
        let p = params.take_triples("P", Type::Point3);
        let tangents = params.take_triples("T", Type::Vector3);
        let at = params.place("P");
        if let Some(i) = p.iter().position(|p| p.iter().any(|v| !v.is_finite())) {
            self.report.error(at, format!("control point {i} is not finite; repair or remove it"));
            return None;
        }
        let (name, name_at) = params.text("basis").unwrap_or(("bezier", params.at));
        let degree = params.int("degree").unwrap_or(3);
        if !matches!((name, degree), ("bezier" | "bspline", 2) | (_, 3)) {
            let message = format!("\"degree\" is {degree}; give 3, or 2 for the bases bezier and bspline");
            self.report.error(params.place("degree"), message);
            return None;
        }
        let n = p.len();
        let d = degree as usize;
        let (fits, needs) = match name {
            "bezier" => (n > d && (n - 1).is_multiple_of(d), format!("{} + k * {d}", d + 1)),
            "bspline" => (n > d, format!("at least {}", d + 1)),
            _ => (n >= 2, "at least 2".to_string()),
        };
        if name != "hermite" && self.one_of("basis", name, name_at, &BASES).is_none() {
            return None;
        }
        if !fits {
            let message = format!(
                "\"P\" holds {n} points; the basis {name} of degree {d} takes {needs}: add or remove points"
            );
            self.report.error(at, message);
            return None;
        }
        Some(match (name, degree) {
            ("bezier", 2) => (CurveBasis::Bezier, raised(&p)),
            ("bspline", 2) => (CurveBasis::Bezier, raised(&quadratic_bezier(&p))),
            ("hermite", _) if tangents.len() == n => (CurveBasis::Bezier, hermite(&p, &tangents)),
            ("hermite", _) => {
                let message = format!(
                    "the hermite curve has {n} points and {} tangents; give one for each point in \"vector3 T\"",
                    tangents.len()
                );
                self.report.error(params.place("T"), message);
                return None;
            }
            _ => (self.one_of("basis", name, name_at, &BASES)?, p),
        })
    }
}

/// The radius of control point `j` where the width changes evenly over `n` segments.
fn taper([w0, w1]: [f32; 2], basis: CurveBasis, j: usize, n: usize) -> f32 {
    0.5 * (w0 + (w1 - w0) * (basis.parameter(j) / n.max(1) as f32))
}

/// How wide strands of a file are.
#[derive(Clone, Copy)]
enum StrandWidth {
    /// From root to tip, whatever the file says.
    Taper([f32; 2]),
    /// As the file says, or the default.
    File { default: f32 },
}

/// Strands of a file as curves; and how many are too short for the basis. Bezier chains lose points that begin no
/// whole segment.
fn gather(
    file: CurveFile,
    basis: CurveBasis,
    kind: CurveKind,
    width: StrandWidth,
    split_depth: u8,
) -> (Curves, usize) {
    let mut curves = Curves { basis, kind, split_depth, points: file.points, ..Curves::default() };
    let ends = file.strands.iter().skip(1).copied().chain([curves.points.len() as u32]);
    let mut n_left = 0;
    let mut next = 0;
    for (&a, b) in file.strands.iter().zip(ends) {
        let (a, n) = (a as usize, b.saturating_sub(a) as usize);
        if n < basis.least() {
            n_left += 1;
            continue;
        }
        let n_segments = basis.n_segments(n);
        let kept = if basis == CurveBasis::Bezier { 3 * n_segments + 1 } else { n };
        curves.strands.push(next as u32);
        for j in 0..kept {
            let mut p = curves.points[a + j];
            p[3] = match width {
                StrandWidth::Taper(w) => taper(w, basis, j, n_segments),
                StrandWidth::File { default } => 0.5 * if p[3] < 0.0 { default } else { p[3] },
            };
            curves.points[next] = p;
            next += 1;
        }
    }
    curves.points.truncate(next);
    (curves, n_left)
}

/// A `curve` joins the shape before it where both are made of the same, so that a groom of single strands is one shape.
pub(super) fn joined(last: &mut ShapeKind, new: &ShapeKind) -> bool {
    match (last, new) {
        (ShapeKind::Curves(a), ShapeKind::Curves(b)) => {
            std::sync::Arc::get_mut(a).is_some_and(|a| a.append(b))
        }
        _ => false,
    }
}
