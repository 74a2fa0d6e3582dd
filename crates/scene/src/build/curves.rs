//! Curves: from parameters and from files of strands.

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

/// What the parameters of one end of the motion are called.
struct Names {
    p: &'static str,
    t: &'static str,
    n: &'static str,
    width: &'static str,
    width0: &'static str,
    width1: &'static str,
}

const START: Names = Names { p: "P", t: "T", n: "N", width: "width", width0: "width0", width1: "width1" };
const END: Names = Names {
    p: "P_end",
    t: "T_end",
    n: "N_end",
    width: "width_end",
    width0: "width0_end",
    width1: "width1_end",
};

impl Names {
    /// One of them is given.
    fn given(&self, params: &Params) -> bool {
        [self.p, self.t, self.n, self.width, self.width0, self.width1].iter().any(|name| params.has(name))
    }
}

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
        let n_given = params.triples("P").len();
        let (basis, p) = self.control_points(params, &START)?;
        let n = basis.n_segments(p.len());
        let widths = self.widths(params, &START, [1.0; 2])?;
        let normals = self.ribbon_normals(params, &START, kind, n)?.unwrap_or_default();
        let with_radii = |p: &[Point], widths: [f32; 2]| {
            let point = |(j, &[x, y, z]): (usize, &Point)| [x, y, z, taper(widths, basis, j, n)];
            p.iter().enumerate().map(point).collect()
        };
        let mut curves = Curves {
            points: with_radii(&p, widths.unwrap_or([1.0; 2])),
            strands: vec![0],
            basis,
            kind,
            normals,
            split_depth: self.split_depth(params),
            ..Curves::default()
        };
        if END.given(params) {
            if !(self.has_start(params, END.t, END.p) && self.has_start(params, END.n, START.n)) {
                return None;
            }
            let n_end = params.triples(END.p).len();
            if n_end != 0 && n_end != n_given {
                let message = format!("\"P_end\" has {n_end} points and \"P\" {n_given}; give one for each");
                self.report.error(params.place(END.p), message);
                return None;
            }
            let p = if n_end == 0 { p } else { self.control_points(params, &END)?.1 };
            let widths = self.widths(params, &END, widths.unwrap_or([1.0; 2]))?.or(widths);
            curves.points_end = with_radii(&p, widths.unwrap_or([1.0; 2]));
            if params.has(END.n) {
                curves.normals_end = self.ribbon_normals(params, &END, kind, n)?.unwrap_or_default();
            }
        }
        Some(curves)
    }

    /// A normal for each end of the `n` segments of a ribbon; none where the curve is no ribbon.
    fn ribbon_normals(
        &mut self,
        params: &mut Params,
        names: &Names,
        kind: CurveKind,
        n: usize,
    ) -> Option<Option<Vec<Point>>> {
        let (normals, at) = (params.take_triples(names.n, Type::Normal), params.place(names.n));
        if kind == CurveKind::Ribbon && normals.len() != n + 1 {
            let message = format!(
                "the ribbon has {n} segments and {} normals; give {} in \"normal {}\", one for each end of a segment",
                normals.len(),
                n + 1,
                names.n
            );
            self.report.error(at, message);
            return None;
        }
        if kind != CurveKind::Ribbon && !normals.is_empty() {
            let message = format!("only curves of type \"ribbon\" take normals; \"{}\" is ignored", names.n);
            self.report.warn(at, message);
        }
        Some((kind == CurveKind::Ribbon).then_some(normals))
    }

    /// The strands of a `hair`, which move where there is a second file.
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
        let widths = self.widths(params, &START, [1.0; 2])?;
        let file = self.read_strands(name, at)?;
        let basis = match params.text("basis") {
            Some((text, at)) => self.one_of("basis", text, at, &BASES)?,
            None => file.basis,
        };
        let width = match widths {
            Some(w) => StrandWidth::Taper(w),
            None => StrandWidth::File { default: self.default_width(name, &file, at) },
        };
        let mut curves = Curves { basis, kind, split_depth: self.split_depth(params), ..Curves::default() };
        let n_left;
        (curves.points, curves.strands, n_left) = gather(file, basis, width);
        if n_left > 0 {
            let least = basis.least();
            let message = format!(
                "\"{name}\": {n_left} strands of fewer than {least} points are too short for the basis; they are left out"
            );
            self.report.warn(at, message);
        }
        if let Some((end_name, at)) = params.text("filename_end") {
            let (points, strands, _) = gather(self.read_strands(end_name, at)?, basis, width);
            if strands != curves.strands || points.len() != curves.points.len() {
                let message = format!(
                    "\"{end_name}\" has {} strands with {} points and \"{name}\" {} with {}, or they are of other lengths; \
                     both ends of a motion have the same strands",
                    strands.len(),
                    points.len(),
                    curves.strands.len(),
                    curves.points.len()
                );
                self.report.error(at, message);
                return None;
            }
            curves.points_end = points;
        }
        Some(curves)
    }

    fn read_strands(&mut self, name: &str, at: Span) -> Option<CurveFile> {
        let path = self.existing(name, at)?;
        let file = match curve_files::read(&path) {
            Ok(file) => file,
            Err(e) => {
                self.report.error(at, format!("\"{name}\" cannot be read: {e}"));
                return None;
            }
        };
        self.report.add_file(path);
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

    /// Widths at the root and the tip, if any is given; what is not takes the default.
    fn widths(&mut self, params: &Params, names: &Names, default: [f32; 2]) -> Option<Option<[f32; 2]>> {
        let given = [names.width, names.width0, names.width1].map(|name| params.float(name));
        for (name, v) in [names.width, names.width0, names.width1].into_iter().zip(given) {
            if let Some(v) = v.filter(|v| !(*v >= 0.0 && v.is_finite())) {
                self.report
                    .error(params.place(name), format!("\"{name}\" is {v}; give one that is not negative"));
                return None;
            }
        }
        let [all, root, tip] = given;
        if given == [None; 3] {
            return Some(None);
        }
        let or = |end: Option<f32>, default: f32| end.or(all).unwrap_or(default);
        Some(Some([or(root, default[0]), or(tip, default[1])]))
    }

    fn split_depth(&mut self, params: &Params) -> u8 {
        params.int("splitdepth").unwrap_or(DEFAULT_SPLIT).clamp(0, MAX_SPLIT) as u8
    }

    /// The basis that the points are kept in, and the points.
    fn control_points(&mut self, params: &mut Params, names: &Names) -> Option<(CurveBasis, Vec<Point>)> {
        let p = params.take_triples(names.p, Type::Point3);
        let tangents = params.take_triples(names.t, Type::Vector3);
        let at = params.place(names.p);
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
                "\"{}\" holds {n} points; the basis {name} of degree {d} takes {needs}: add or remove points",
                names.p
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
                    "the hermite curve has {n} points and {} tangents; give one for each point in \"vector3 {}\"",
                    tangents.len(),
                    names.t
                );
                self.report.error(params.place(names.t), message);
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

/// Control points with radii and the first of each strand, from a file; and how many strands are too short for the basis. Bezier
/// chains lose points that begin no whole segment.
fn gather(file: CurveFile, basis: CurveBasis, width: StrandWidth) -> (Vec<[f32; 4]>, Vec<u32>, usize) {
    let CurveFile { mut points, strands: starts, .. } = file;
    let ends = starts.iter().skip(1).copied().chain([points.len() as u32]);
    let mut strands = Vec::with_capacity(starts.len());
    let mut n_left = 0;
    let mut next = 0;
    for (&a, b) in starts.iter().zip(ends) {
        let (a, n) = (a as usize, b.saturating_sub(a) as usize);
        if n < basis.least() {
            n_left += 1;
            continue;
        }
        let n_segments = basis.n_segments(n);
        let kept = if basis == CurveBasis::Bezier { 3 * n_segments + 1 } else { n };
        strands.push(next as u32);
        for j in 0..kept {
            let mut p = points[a + j];
            p[3] = match width {
                StrandWidth::Taper(w) => taper(w, basis, j, n_segments),
                StrandWidth::File { default } => 0.5 * if p[3] < 0.0 { default } else { p[3] },
            };
            points[next] = p;
            next += 1;
        }
    }
    points.truncate(next);
    (points, strands, n_left)
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
