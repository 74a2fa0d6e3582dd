//! What curves of scenes mean, and what is refused of them.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests stop where something is missing")]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use sparrow_scene::*;

fn scene(text: &str) -> SceneDesc {
    read_str(&format!("WorldBegin {text}"), "t", Path::new("")).map_err(|e| e.to_string()).unwrap()
}

fn curves(s: &SceneDesc, i: usize) -> Arc<Curves> {
    let ShapeKind::Curves(c) = &s.shapes[i].kind else { panic!("{:?}", s.shapes[i].kind) };
    Arc::clone(c)
}

fn one(text: &str) -> Arc<Curves> {
    curves(&scene(text), 0)
}

fn fault(text: &str) -> String {
    let e = read_str(&format!("WorldBegin Shape {text}"), "t", Path::new("")).unwrap_err().to_string();
    assert!(e.starts_with("t:1:") && e.contains("; "), "{e}");
    e
}

const P4: &str = "\"point3 P\" [0 0 0  1 0 0  2 1 0  3 1 0]";

fn near(a: [f32; 4], b: [f32; 4]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6)
}

/// pbrt-v4's defaults: a flat Bezier curve of width 1.
#[test]
fn defaults_are_those_of_pbrt() {
    let c = one(&format!("Shape \"curve\" {P4}"));
    assert_eq!((c.basis, c.kind, c.split_depth), (CurveBasis::Bezier, CurveKind::Flat, 1));
    assert_eq!((c.strands.as_slice(), c.n_segments()), ([0].as_slice(), 1));
    assert!(near(c.points[2], [2.0, 1.0, 0.0, 0.5]));
}

/// The width changes evenly from the first to the last point of the curve, which for B-splines are no control points.
#[test]
fn widths_taper() {
    let c = one("Shape \"curve\" \"float width0\" 8 \"float width1\" 2 \
        \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0 4 0 0 5 0 0 6 0 0]");
    assert_eq!(c.n_segments(), 2);
    assert!(near(c.points[0], [0.0, 0.0, 0.0, 4.0]) && near(c.points[6], [6.0, 0.0, 0.0, 1.0]));
    let c = one(&format!(
        "Shape \"curve\" \"string basis\" \"bspline\" \"float width\" 2 \"float width1\" 0 {P4}"
    ));
    // One segment, which begins at the second point's parameter and ends at the third's.
    let radii: Vec<f32> = c.points.iter().map(|p| p[3]).collect();
    assert_eq!(radii, [2.0, 1.0, 0.0, -1.0]);
}

#[test]
fn curves_of_degree_two_are_raised() {
    let c = one("Shape \"curve\" \"integer degree\" 2 \"point3 P\" [0 0 0  3 0 0  3 3 0]");
    let expected = [[0.0, 0.0], [2.0, 0.0], [3.0, 1.0], [3.0, 3.0]];
    assert!(c.points.iter().zip(expected).all(|(p, e)| near(*p, [e[0], e[1], 0.0, 0.5])), "{:?}", c.points);
    let c = one(
        "Shape \"curve\" \"string basis\" \"bspline\" \"integer degree\" 2 \"point3 P\" [0 0 0  2 0 0  2 2 0  4 2 0]",
    );
    // Two segments, which meet half way between the middle points.
    assert_eq!((c.points.len(), c.n_segments()), (7, 2));
    assert!(near(c.points[0], [1.0, 0.0, 0.0, 0.5]) && near(c.points[3], [2.0, 1.0, 0.0, 0.5]));
}

#[test]
fn hermite_curves_become_bezier_curves() {
    let c = one(
        "Shape \"curve\" \"string basis\" \"hermite\" \"point3 P\" [0 0 0  1 0 0] \"vector3 T\" [0 3 0  0 -3 0]",
    );
    assert_eq!(c.basis, CurveBasis::Bezier);
    assert!(near(c.points[1], [0.0, 1.0, 0.0, 0.5]) && near(c.points[2], [1.0, 1.0, 0.0, 0.5]));
}

/// Curves of one sort that follow each other are one shape; others are not.
#[test]
fn neighbours_join() {
    let curve = format!("Shape \"curve\" {P4} ");
    let s = scene(&format!("{curve}{curve}{curve}"));
    assert_eq!((s.shapes.len(), curves(&s, 0).strands.as_slice()), (1, [0, 4, 8].as_slice()));
    for between in [
        "Shape \"sphere\"",
        "Translate 1 0 0",
        "Material \"diffuse\"",
        "ReverseOrientation",
        "Attribute \"shape\" \"string type\" \"round\"",
        "Attribute \"shape\" \"float alpha\" 0.5",
    ] {
        let s = scene(&format!("{curve}{between} {curve}"));
        let strands: Vec<usize> = s
            .shapes
            .iter()
            .filter_map(|s| if let ShapeKind::Curves(c) = &s.kind { Some(c.strands.len()) } else { None })
            .collect();
        assert_eq!(strands, [1, 1], "after {between}");
    }
    let s = scene(&format!(
        "ObjectBegin \"o\" {curve}{curve} ObjectEnd ObjectInstance \"o\" ObjectInstance \"o\""
    ));
    let shapes = &s.prototypes[0].shapes;
    let strands = |d: &ShapeDesc| if let ShapeKind::Curves(c) = &d.kind { c.strands.len() } else { 0 };
    assert_eq!((s.instances.len(), shapes.len(), strands(&shapes[0])), (2, 1, 2));
}

#[test]
fn ribbons_have_normals() {
    let c = one(&format!("Shape \"curve\" \"string type\" \"ribbon\" \"normal N\" [0 0 1  0 1 0] {P4}"));
    assert_eq!((c.kind, c.normals.len()), (CurveKind::Ribbon, 2));
    let e = fault(&format!("\"curve\" \"string type\" \"ribbon\" \"normal N\" [0 0 1] {P4}"));
    assert!(e.contains("the ribbon has 1 segments and 1 normals; give 2"), "{e}");
    let s = scene(&format!("Shape \"curve\" \"normal N\" [0 0 1  0 1 0] {P4}"));
    assert!(s.warnings[0].message.contains("only curves of type \"ribbon\" take normals"));
}

#[test]
fn faults_have_a_place_and_a_remedy() {
    for (text, message) in [
        ("\"curve\"".to_string(), "\"P\" holds 0 points; the basis bezier of degree 3 takes 4 + k * 3"),
        (
            format!("\"curve\" \"string type\" \"rond\" {P4}"),
            "curves have no type \"rond\"; did you mean \"round\"?",
        ),
        (format!("\"curve\" \"string basis\" \"b-spline\" {P4}"), "did you mean \"bspline\"?"),
        (format!("\"curve\" \"integer degree\" 4 {P4}"), "\"degree\" is 4; give 3"),
        (format!("\"curve\" \"float width\" -1 {P4}"), "\"width\" is -1; give one that is not negative"),
        ("\"curve\" \"point3 P\" [0 0 0 1 1 1 2 2 2 3 3 3 4 4 4]".to_string(), "\"P\" holds 5 points"),
        (
            "\"curve\" \"string basis\" \"hermite\" \"point3 P\" [0 0 0 1 1 1]".to_string(),
            "and 0 tangents; give one",
        ),
        ("\"hair\"".to_string(), "the hair names no file; add \"string filename\""),
        ("\"hair\" \"string filename\" \"none.hair\"".to_string(), "there is no such file; looked for"),
    ] {
        let e = fault(&text);
        assert!(e.contains(message), "{e}");
    }
}

#[test]
fn curves_emit_nothing() {
    let s = scene(&format!("AreaLightSource \"diffuse\" Shape \"curve\" {P4}"));
    assert!(s.shapes[0].area_light.is_none());
    assert!(s.warnings.iter().any(|w| w.message.contains("curves do not emit light")));
}

/// The folder of test data.
fn data() -> Option<PathBuf> {
    let base = std::env::var_os("SPARROW_DATA")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"), PathBuf::from);
    let dir = base.join("hair");
    if !dir.is_dir() {
        eprintln!("skipped: there is no {}", dir.display());
        return None;
    }
    Some(dir)
}

/// One groom in two formats: points as they are, and the Bezier chains that a Catmull-Rom spline through them makes.
#[test]
fn grooms_of_other_programs_are_read() {
    let Some(dir) = data() else { return };
    let file =
        |name: &str| one(&format!("Shape \"hair\" \"string filename\" \"{}\"", dir.join(name).display()));
    let ball = file("fur-ball.hair");
    assert_eq!((ball.strands.len(), ball.points.len()), (11_341, 68_046));
    let beziers = one(&format!("Include \"{}\"", dir.join("fur-ball.pbrt.gz").display()));
    assert_eq!((beziers.strands.len(), beziers.n_segments()), (11_341, 5 * 11_341));
    for (i, p) in ball.points.iter().enumerate() {
        let b = beziers.points[i / 6 * 16 + i % 6 * 3];
        assert!((0..3).all(|k| (p[k] - b[k]).abs() < 1e-4), "point {i}: {p:?} is not {b:?}");
    }
    assert!((ball.points[0][3] - beziers.points[0][3]).abs() < 1e-5, "widths agree at the root");
    let (tfx, hair) = (file("Ratboy_mohawk.tfx"), file("ratboy-mohawk.hair"));
    assert_eq!((tfx.strands.len(), tfx.points.len()), (2_228, 2_228 * 32));
    for (a, b) in tfx.points.iter().zip(&hair.points) {
        assert_eq!(a[..3], b[..3]);
    }
}

/// Points, widths and normals of the end are made as those of the start are.
#[test]
fn curves_go_where_their_end_says() {
    let c = one(&format!(
        "Shape \"curve\" {P4} \"point3 P_end\" [0 0 1  1 0 1  2 1 1  3 1 1] \"float width_end\" 3"
    ));
    assert!(near(c.points[3], [3.0, 1.0, 0.0, 0.5]) && near(c.points_end[3], [3.0, 1.0, 1.0, 1.5]));
    // Widths alone may change, and what is not said of them stays.
    let c =
        one(&format!("Shape \"curve\" {P4} \"float width0\" 4 \"float width1\" 2 \"float width1_end\" 0"));
    assert!(near(c.points_end[0], [0.0, 0.0, 0.0, 2.0]) && near(c.points_end[3], [3.0, 1.0, 0.0, 0.0]));
    let ends = "\"point3 P_end\" [0 0 1  1 0 1] \"vector3 T_end\" [0 3 0  0 3 0]";
    let c = one(&format!(
        "Shape \"curve\" \"string basis\" \"hermite\" \"point3 P\" [0 0 0  1 0 0] \"vector3 T\" [3 0 0  3 0 0] {ends}"
    ));
    assert!(near(c.points[1], [1.0, 0.0, 0.0, 0.5]) && near(c.points_end[1], [0.0, 1.0, 1.0, 0.5]));
    let ribbon = "\"string type\" \"ribbon\" \"normal N\" [0 0 1  0 1 0] \"normal N_end\" [1 0 0  0 1 0]";
    let c = one(&format!("Shape \"curve\" {P4} {ribbon}"));
    assert_eq!((c.normals_end.len(), c.points_end.as_slice()), (2, c.points.as_slice()));
    // A strand that moves does not join one that stands.
    let s = scene(&format!(
        "Shape \"curve\" {P4} Shape \"curve\" {P4} \"float width_end\" 3 Shape \"curve\" {P4} \"float width_end\" 2"
    ));
    assert_eq!((s.shapes.len(), curves(&s, 0).strands.len(), curves(&s, 1).strands.len()), (2, 1, 2));
    assert_eq!(curves(&s, 1).points_end.len(), 8);
    assert!(s.shapes[1].kind.deforms() && !s.shapes[0].kind.deforms());
}
