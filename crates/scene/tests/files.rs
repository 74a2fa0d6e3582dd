//! Scenes made of several files.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "tests stop where something is missing; values are exact"
)]

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use sparrow_scene::{ShapeKind, SpectrumDesc, SpectrumTexture, read};

/// A folder of its own for each test, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let dir = std::env::temp_dir().join(format!("sparrow-scene-{name}-{}", std::process::id()));
        fs::create_dir_all(dir.join("sub")).unwrap();
        Folder(dir)
    }
    fn write(&self, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, text).unwrap();
        path
    }
    /// The faults of a scene, without the folder's name.
    fn faults(&self, path: &Path) -> String {
        let e = read(path).map(|_| ()).unwrap_err().to_string();
        e.replace(&format!("{}{}", self.0.display(), std::path::MAIN_SEPARATOR), "").replace('\\', "/")
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What is left in the folder for temporary files does no harm.
        let _ = fs::remove_dir_all(&self.0);
    }
}

const TRIANGLE: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
    property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
    0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

#[test]
fn includes_start_at_the_scene_file_and_keep_the_state() {
    let f = Folder::new("include");
    let main = f
        .write("main.pbrt", "WorldBegin AttributeBegin Include \"sub/a.pbrt\" Shape \"sphere\" AttributeEnd");
    f.write("sub/a.pbrt", "Translate 1 0 0\r\nInclude \"sub/b.pbrt\"");
    f.write("sub/b.pbrt", "Translate 0 2 0");
    let s = read(&main).unwrap();
    assert_eq!(s.shapes[0].to_world.rows()[0][3], 1.0);
    assert_eq!(s.shapes[0].to_world.rows()[1][3], 2.0);
    assert_eq!(s.files, [main, f.0.join("sub/a.pbrt"), f.0.join("sub/b.pbrt")]);
}

#[test]
fn imports_leave_the_state_as_it_was() {
    let f = Folder::new("import");
    let main = f.write(
        "main.pbrt",
        "WorldBegin Translate 1 0 0 Import \"a.pbrt\" NamedMaterial \"m\" Shape \"sphere\"",
    );
    f.write("a.pbrt", "Translate 5 0 0 MakeNamedMaterial \"m\" \"string type\" \"conductor\" Shape \"disk\"");
    let s = read(&main).unwrap();
    let x: Vec<f64> = s.shapes.iter().map(|s| s.to_world.rows()[0][3]).collect();
    assert_eq!(x, [6.0, 1.0]);
    f.write("a.pbrt", "AttributeBegin\nTranslate 1 1 1");
    assert!(f.faults(&main).contains("a.pbrt:1:1: `AttributeBegin` is never closed; add `AttributeEnd`"));
}

#[test]
fn a_cycle_of_includes_is_shown() {
    let f = Folder::new("cycle");
    let main = f.write("main.pbrt", "WorldBegin\nInclude \"a.pbrt\"");
    f.write("a.pbrt", "Identity\n Include \"b.pbrt\"");
    f.write("b.pbrt", "Include \"./sub/../a.pbrt\"");
    let want = "b.pbrt:1:9: the file includes itself: a.pbrt -> b.pbrt -> a.pbrt; remove one of these";
    assert_eq!(f.faults(&main), want);
}

#[test]
fn faults_in_included_files_have_their_place() {
    let f = Folder::new("places");
    let main = f.write("main.pbrt", "WorldBegin\nInclude \"a.pbrt\"\nShape \"cone\"\n");
    f.write("a.pbrt", "\n\tShape \"shpere\"");
    let faults = f.faults(&main);
    let mut lines = faults.lines();
    assert!(
        lines.next().unwrap().starts_with("main.pbrt:3:7: there is no shape \"cone\"; known are"),
        "{faults}"
    );
    assert_eq!(lines.next(), Some("a.pbrt:2:8: there is no shape \"shpere\"; did you mean \"sphere\"?"));
}

#[test]
fn compressed_files_are_read() {
    let f = Folder::new("gzip");
    let main = f.write("main.pbrt", "WorldBegin Include \"a.pbrt.gz\"");
    let mut gz = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    gz.write_all(b"Shape \"sphere\"").unwrap();
    f.write("a.pbrt.gz", gz.finish().unwrap());
    assert_eq!(read(&main).unwrap().shapes.len(), 1);
    f.write("a.pbrt.gz", b"\x1f\x8b broken");
    assert!(f.faults(&main).starts_with("main.pbrt:1:20: \"a.pbrt.gz\" cannot be read, "));
}

#[test]
fn a_mesh_file_is_read_once() {
    let f = Folder::new("ply");
    f.write("sub/t.ply", TRIANGLE);
    let shape = "Shape \"plymesh\" \"string filename\" \"sub/t.ply\"\n";
    let main = f.write("main.pbrt", format!("WorldBegin {shape}{shape}"));
    let s = read(&main).unwrap();
    let (ShapeKind::Mesh(a), ShapeKind::Mesh(b)) = (&s.shapes[0].kind, &s.shapes[1].kind) else { panic!() };
    assert!(std::sync::Arc::ptr_eq(a, b));
    assert_eq!(a.triangles, [[0, 1, 2]]);
}

#[test]
fn quads_of_a_mesh_file_become_patches() {
    let f = Folder::new("quads");
    let quad = TRIANGLE.replace("vertex 3", "vertex 4").replace("3 0 1 2\n", "1 1 0\n4 0 1 3 2\n");
    f.write("q.ply", quad);
    let main = f.write("main.pbrt", "WorldBegin Shape \"plymesh\" \"string filename\" \"q.ply\"");
    let s = read(&main).unwrap();
    let ShapeKind::Mesh(m) = &s.shapes[0].kind else { panic!() };
    // Around the face 0 1 3 2, so that rows of the patch are 0 1 and 2 3.
    assert_eq!((m.patches.as_slice(), m.triangles.len()), ([[0, 1, 2, 3]].as_slice(), 0));
}

#[test]
fn a_damaged_mesh_file_is_one_fault_however_often_it_is_used() {
    let f = Folder::new("damaged");
    f.write("t.ply", &TRIANGLE[..TRIANGLE.len() - 4]);
    let shape = "Shape \"plymesh\" \"string filename\" \"t.ply\"\n";
    let main = f.write("main.pbrt", format!("WorldBegin\n{shape}{shape}"));
    let faults = f.faults(&main);
    assert_eq!(faults.lines().count(), 1, "{faults}");
    assert!(faults.starts_with("main.pbrt:2:35: \"t.ply\" cannot be read: "), "{faults}");
}

#[test]
fn spectra_come_from_files() {
    let f = Folder::new("spd");
    f.write("s.spd", "# nm value\n400 0.5\n700 1\n");
    let main = f.write("main.pbrt", "WorldBegin Material \"diffuse\" \"spectrum reflectance\" \"s.spd\"");
    let s = read(&main).unwrap();
    let samples = s.spectrum_textures.iter().find_map(|t| {
        if let SpectrumTexture::Constant(SpectrumDesc::Samples(s)) = t { Some(s.to_vec()) } else { None }
    });
    assert_eq!(samples.as_deref(), Some([(400.0, 0.5), (700.0, 1.0)].as_slice()));
    f.write("s.spd", "400 x");
    assert!(f.faults(&main).starts_with("main.pbrt:1:54: the spectrum \"s.spd\" cannot be read: "));
}

#[test]
fn a_missing_scene_or_one_in_utf16_is_refused() {
    let f = Folder::new("missing");
    let want = "no.pbrt: the scene cannot be read, there is no such file; check the path";
    assert_eq!(f.faults(&f.0.join("no.pbrt")), want);
    let main = f.write("main.pbrt", b"\xff\xfeW\0o\0r\0l\0d\0");
    assert!(f.faults(&main).starts_with("main.pbrt: the file is UTF-16; save it as UTF-8"));
}

#[test]
fn meshes_and_strands_go_from_file_to_file() {
    let f = Folder::new("motion");
    f.write("a.ply", TRIANGLE);
    f.write("b.ply", TRIANGLE.replace("0 1 0\n3", "0 1 5\n3"));
    f.write("turned.ply", TRIANGLE.replace("3 0 1 2", "3 0 2 1"));
    f.write("larger.ply", TRIANGLE.replace("vertex 3", "vertex 4").replace("0 1 0\n3", "0 1 0\n2 2 2\n3"));
    f.write("a.txt", "0 0 0 .1\n1 0 0 .1\n\n0 1 0 .1\n1 1 0 .1\n");
    f.write("b.txt", "0 0 1 .2\n1 0 1 .2\n\n0 1 1 .2\n1 1 1 .2\n");
    f.write("short.txt", "0 0 1 .2\n1 0 1 .2\n2 0 1 .2\n\n1 1 1 .2\n1 1 1 .2\n");
    let moving = |shape: &str, end: &str| {
        let start = if shape == "hair" { "a.txt" } else { "a.ply" };
        let file = format!("\"string filename\" \"{start}\" \"string filename_end\" \"{end}\"");
        let basis = if shape == "hair" { "\"string basis\" \"linear\"" } else { "" };
        f.write("main.pbrt", format!("WorldBegin\nShape \"{shape}\" {basis}\n{file}"))
    };
    let s = read(&moving("plymesh", "b.ply")).unwrap();
    let ShapeKind::Mesh(mesh) = &s.shapes[0].kind else { unreachable!() };
    assert_eq!((mesh.p[2], mesh.p_end[2], mesh.p_end.len()), ([0.0, 1.0, 0.0], [0.0, 1.0, 5.0], 3));
    let s = read(&moving("hair", "b.txt")).unwrap();
    let ShapeKind::Curves(c) = &s.shapes[0].kind else { unreachable!() };
    assert_eq!((c.points[3], c.points_end[3]), ([1.0, 1.0, 0.0, 0.1], [1.0, 1.0, 1.0, 0.2]));
    for (shape, end, fault) in [
        ("plymesh", "turned.ply", "\"turned.ply\" has other faces than \"a.ply\"; both ends"),
        ("plymesh", "larger.ply", "\"larger.ply\" has 4 vertices and \"a.ply\" 3; both ends"),
        ("plymesh", "none.ply", "\"none.ply\" cannot be read, there is no such file"),
        ("hair", "short.txt", "\"short.txt\" has 2 strands with 5 points and \"a.txt\" 2 with 4"),
    ] {
        let said = f.faults(&moving(shape, end));
        assert!(said.starts_with("main.pbrt:3:") && said.contains(fault), "{said}");
    }
}

/// What is said of many mesh files, and the meshes, do not depend on who reads them.
#[test]
fn meshes_are_read_by_any_number_of_threads() {
    let f = Folder::new("threads");
    let quad = TRIANGLE.replace("3 0 1 2", "4 0 1 2 1").replace("0 1 0", "0 1 7");
    let (mut sound, mut faulty) = (String::from("WorldBegin\n"), String::from("WorldBegin\n"));
    for i in 0..20 {
        f.write(&format!("{i}.ply"), if i % 3 == 0 { &quad } else { TRIANGLE });
        f.write(&format!("bad{i}.ply"), TRIANGLE.replace("3 0 1 2", &format!("3 0 1 {}", 50 + i)));
        sound += &format!("Shape \"plymesh\" \"string filename\" \"{i}.ply\"\n");
        faulty += &format!(
            " Shape \"plymesh\" \"string filename\" \"bad{i}.ply\"\n Shape \"sphere\" \"float r\" 1\n"
        );
        faulty += &format!("Shape \"plymesh\" \"string filename\" \"bad{i}.ply\"\n");
    }
    let (sound, faulty) = (f.write("sound.pbrt", sound), f.write("faulty.pbrt", faulty));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let scene = read(&sound).unwrap();
            (format!("{:?}", scene.shapes), scene.files, f.faults(&faulty))
        })
    };
    let (one, three) = (on(1), on(3));
    assert_eq!(one, three);
    let names: Vec<String> = one.1.iter().map(|p| p.file_name().unwrap().display().to_string()).collect();
    assert_eq!(names[..3], ["sound.pbrt", "0.ply", "1.ply"]);
    let places: Vec<&str> = one.2.lines().filter(|l| l.starts_with("faulty.pbrt:")).collect();
    assert_eq!(places.len(), 40, "each file is told of once: {}", one.2);
    for (i, pair) in places.chunks(2).enumerate() {
        let [mesh, sphere] = [2 + 3 * i, 3 + 3 * i].map(|line| format!("faulty.pbrt:{line}:"));
        assert!(pair[0].starts_with(&mesh) && pair[0].contains(&format!("vertex {}", 50 + i)), "{pair:?}");
        assert!(pair[1].starts_with(&sphere) && pair[1].contains("no parameter"), "{pair:?}");
    }
}
