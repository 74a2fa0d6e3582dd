use std::io::Write;

use flate2::Compression;
use flate2::write::GzEncoder;
use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, TestRng, TestRunner};

use super::*;

fn given(bytes: &[u8]) -> Result<PlyMesh, PlyError> {
    read_from(bytes, bytes.len() as u64, Path::new("a.ply"))
}

fn refusal(bytes: &[u8]) -> String {
    given(bytes).err().map(|e| e.to_string()).unwrap_or_default()
}

/// A triangle and a quad, with everything at once: all types, any order, things to pass over.
const HEADER: &str = "comment made by hand\nelement junk 2\nproperty list uchar short a\nproperty double b\n\
    element vertex 5\nproperty uchar red\nproperty float nx\nproperty double y\nproperty float x\n\
    property short z\nproperty float ny\nproperty float nz\nproperty float t\nproperty float s\n\
    property list uchar float weights\nelement face 2\nproperty int face_indices\n\
    property list uchar int vertex_indices\nproperty uint flags\nend_header\n";

fn vertex(i: usize) -> [f32; 8] {
    let i = i as f32;
    [i, i * 0.5, i * 2.0, 0.0, 0.25 * i, 1.0, i / 8.0, i / 16.0]
}

fn expected() -> PlyMesh {
    let v: Vec<[f32; 8]> = (0..5).map(vertex).collect();
    PlyMesh {
        p: v.iter().map(|v| [v[0], v[1], v[2]]).collect(),
        n: v.iter().map(|v| [v[3], v[4], v[5]]).collect(),
        uv: v.iter().map(|v| [v[6], v[7]]).collect(),
        triangles: vec![[0, 1, 2]],
        quads: vec![[4, 3, 2, 1]],
        face_indices: vec![-7, 9],
        notes: vec![],
    }
}

fn ascii(line_end: &str) -> Vec<u8> {
    let mut s = format!("ply\nformat ascii 1.0\n{HEADER}2 1 2 0.5\n0 0.5\n");
    for i in 0..5 {
        let [x, y, z, nx, ny, nz, u, v] = vertex(i);
        s += &format!("255 {nx} {y} {x} {z} {ny} {nz} {v} {u} {}\n", if i == 2 { "2 0.5 0.5" } else { "0" });
    }
    s += "9 4 4 3 2 1 0\n-7 3 0 1 2 4000000000\n";
    s.replace('\n', line_end).into_bytes()
}

fn binary(big: bool, line_end: &str) -> Vec<u8> {
    let name = if big { "binary_big_endian" } else { "binary_little_endian" };
    let mut b = format!("ply\nformat {name} 1.0\n{HEADER}").replace('\n', line_end).into_bytes();
    let mut put = |bytes: &[u8]| {
        if big { b.extend(bytes.iter().rev()) } else { b.extend(bytes) }
    };
    put(&[2]);
    put(&1i16.to_le_bytes());
    put(&2i16.to_le_bytes());
    put(&0.5f64.to_le_bytes());
    put(&[0]);
    put(&0.5f64.to_le_bytes());
    for i in 0..5 {
        let [x, y, z, nx, ny, nz, u, v] = vertex(i);
        put(&[255]);
        put(&nx.to_le_bytes());
        put(&f64::from(y).to_le_bytes());
        put(&x.to_le_bytes());
        put(&(z as i16).to_le_bytes());
        [ny, nz, v, u].iter().for_each(|f| put(&f.to_le_bytes()));
        put(&[u8::from(i == 2)]);
        if i == 2 {
            put(&0.5f32.to_le_bytes());
        }
    }
    for (index, face) in [(9i32, &[4i32, 3, 2, 1][..]), (-7, &[0, 1, 2])] {
        put(&index.to_le_bytes());
        put(&[face.len() as u8]);
        face.iter().for_each(|v| put(&v.to_le_bytes()));
        put(&4_000_000_000u32.to_le_bytes());
    }
    b
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut e = GzEncoder::new(Vec::new(), Compression::default());
    e.write_all(bytes).unwrap();
    e.finish().unwrap()
}

#[test]
fn every_form_gives_the_same_mesh() {
    for end in ["\n", "\r\n", "\r"] {
        for (what, file) in
            [("ascii", ascii(end)), ("little", binary(false, end)), ("big", binary(true, end))]
        {
            assert_eq!(given(&file).unwrap(), expected(), "{what} {end:?}");
            assert_eq!(given(&gzip(&file)).unwrap(), expected(), "{what} {end:?} gzip");
        }
    }
}

#[test]
fn files_cut_short_are_refused() {
    for file in [ascii("\n"), binary(false, "\n"), binary(true, "\n"), gzip(&ascii("\n"))] {
        // Without its last digits, or the blank behind it, the last number of a text is still one.
        let spared = if file.ends_with(b"\n") { 10 } else { 0 };
        for n in 0..file.len() - spared {
            assert!(refusal(&file[..n]).starts_with("a.ply:"), "{n} of {} bytes were enough", file.len());
        }
    }
    let file = binary(false, "\n");
    let e = refusal(&file[..file.len() - 1]);
    assert!(e.contains(&format!("byte {}: the file ends before", file.len() - 1)), "{e}");
}

/// A text of one triangle, with a line replaced.
fn with(from: &str, to: &str) -> Vec<u8> {
    let file = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    assert!(file.contains(from), "the test names a line that is not there: {from}");
    file.replacen(from, to, 1).into_bytes()
}

#[test]
fn faults_are_named_with_their_place() {
    let cases = [
        ("ply\n", "solid\n", "a.ply:1: this is no PLY file"),
        ("ascii 1.0", "ascii 2.0", "a.ply:2: `format ascii 2.0`"),
        ("ascii", "binary", "a.ply:2: `format binary 1.0`: the format must be"),
        ("format ascii 1.0\n", "", "a.ply:9: the header has no line `format"),
        ("vertex 3", "vertex three", "a.ply:3: `element vertex three`: the count"),
        ("vertex 3", "vertex -3", "a.ply:3: `element vertex -3`: the count"),
        ("vertex 3", "vertex 4000000000", "a.ply:3: 4000000000 times `vertex` is more"),
        ("face 1", "face 18446744073709551615", "a.ply:7: 18446744073709551615 times `face` is more"),
        ("float y", "float x", "a.ply:5: `property float x`: the element has such"),
        ("float y", "half y", "a.ply:5: `property half y`: this declares no"),
        ("float y", "float why", "a.ply:3: the vertices have no numbers"),
        ("element vertex 3\n", "", "a.ply:3: `property float x`: no element"),
        ("list int int", "list int float", "a.ply:7: the faces have no list"),
        ("list int int", "list float int", "a.ply:8: `property list float int"),
        ("end_header\n", "", "a.ply:9: `0 0 0`: this line is not understood"),
        ("1 0 0", "1 zero 0", "a.ply:11: `zero` is no number"),
        ("1 0 0", "nan 0 0", "a.ply:11: `x` of vertex 1 is NaN"),
        ("0 1 0", "0 1 1e39", "a.ply:12: `z` of vertex 2 is inf"),
        ("3 0 1 2", "3 0 1 3", "a.ply:13: face 0 names vertex 3, but there are 3"),
        ("3 0 1 2", "3 0 -1 2", "a.ply:13: face 0 names vertex -1"),
        ("3 0 1 2", "-3 0 1 2", "a.ply:13: a list of -3 values"),
        ("3 0 1 2", "3 0 1 2.0", "a.ply:13: `2.0` is no number"),
        ("3 0 1 2", "2 0 1", "a.ply:7: the file has no face"),
        ("face 1", "face 0", "a.ply:7: the file has no face"),
        ("element face 1\nproperty list int int vertex_indices\n", "", "a.ply:1: the file has no face"),
    ];
    for (from, to, want) in cases {
        let e = refusal(&with(from, to));
        assert!(e.starts_with(want) && e.contains("; "), "{from:?} as {to:?}: {e:?}, want {want:?}");
    }
    let mut file = binary(false, "\n");
    let at = file.len() - 4 - 4;
    file[at..at + 4].copy_from_slice(&5i32.to_le_bytes());
    let e = refusal(&file);
    assert!(e.starts_with(&format!("a.ply: byte {at}: face 1 names vertex 5")), "{e}");
    let e = read(Path::new("no/such.ply")).unwrap_err().to_string();
    assert!(e.starts_with("no/such.ply: cannot be read"), "{e}");
}

#[test]
fn what_is_read_differently_is_noted() {
    let five = "ply\nformat ascii 1.0\nelement face 4\nproperty list int int vertex_indices\n\
        property uchar face_indices\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
        property float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\nend_header\n\
        5 0 1 2 3 4 8\n2 0 1 1\n4 0 1 2 3 5\n3 0 1 2 6\n0 0 0 nan 0 0 inf 0\n1 0 0 1 0 0 0 1\n1 1 0 1 0 0 0 1\n\
        0 2 0 1 0 0 0 1\n0 1 0 1 0 0 0 1\nmore\n";
    let mesh = given(five.as_bytes()).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 1, 2]]);
    assert_eq!((mesh.quads, mesh.face_indices), (vec![[0, 1, 2, 3]], vec![8, 8, 8, 6, 5]));
    assert_eq!((mesh.n[0], mesh.n[1], mesh.uv[0]), ([0.0; 3], [1.0, 0.0, 0.0], [0.0; 2]));
    let notes = mesh.notes.join("\n");
    for want in ["1 faces of more than four", "1 faces of fewer", "1 normals", "1 texture", "data behind"] {
        assert!(notes.contains(want), "{notes}");
    }
}

#[test]
fn a_header_cannot_claim_memory_or_time() {
    let header = "ply\nformat binary_little_endian 1.0\nelement nothing 18446744073709551615\n\
        element vertex 1000000000\nproperty uchar x\nproperty uchar y\nproperty uchar z\nend_header\n";
    let e = refusal(&gzip(header.as_bytes()));
    assert!(e.contains("1000000000 times `vertex` is more"), "{e}");
    let long = [b"ply\nformat ascii 1.0\ncomment ".as_slice(), &[b'x'; 10_000]].concat();
    assert!(refusal(&long).contains("longer than any"));
    let many = format!("ply\nformat ascii 1.0\n{}", "comment x\n".repeat(5000));
    assert!(refusal(many.as_bytes()).contains("longer than that of any"));
}

#[test]
fn mutated_files_never_panic() {
    let seeds =
        [ascii("\n"), binary(false, "\n"), binary(true, "\r\n"), gzip(&binary(false, "\n")), with("3", "3")];
    for seed in seeds {
        let config = ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() };
        let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
        let byte = prop_oneof![any::<u8>(), Just(0), Just(0xff), Just(b'9'), Just(b'-'), Just(b' ')];
        let edits = prop::collection::vec((any::<usize>(), byte), 0..5);
        let mutations = (edits, prop_oneof![Just(0usize), 0usize..64]);
        TestRunner::new_with_rng(config, rng)
            .run(&mutations, |(edits, cut)| {
                let mut file = seed.clone();
                for (at, value) in edits {
                    let n = file.len();
                    file[at % n] = value;
                }
                file.truncate(file.len() - cut.min(file.len()));
                if let Ok(mesh) = given(&file) {
                    let n = mesh.p.len();
                    let indices = mesh.triangles.iter().flatten().chain(mesh.quads.iter().flatten());
                    prop_assert!(indices.copied().all(|i| (i as usize) < n));
                    prop_assert!(mesh.n.is_empty() || mesh.n.len() == n);
                    prop_assert!(mesh.uv.is_empty() || mesh.uv.len() == n);
                    let faces = mesh.triangles.len() + mesh.quads.len();
                    prop_assert!(mesh.face_indices.is_empty() || mesh.face_indices.len() == faces);
                }
                Ok(())
            })
            .unwrap();
    }
}

/// A long mesh in the types that everybody writes: vertices with normals, and triangles with now and then another face.
fn plain(format: &str, position: impl Fn(usize) -> f32, corner: impl Fn(usize) -> i32) -> Vec<u8> {
    const N: usize = 12_000;
    let header = "element vertex 12000\nproperty float x\nproperty float y\nproperty float z\nproperty uchar shade\n\
                  property float nx\nproperty float ny\nproperty float nz\nelement face 12000\n\
                  property list uchar int vertex_indices\nend_header\n";
    let mut file = format!("ply\nformat {format} 1.0\n{header}").into_bytes();
    let mut put = |bytes: &[u8], text: &dyn std::fmt::Display, end: &str| match format {
        "ascii" => file.extend(format!("{text}{end}").bytes()),
        "binary_big_endian" => file.extend(bytes.iter().rev()),
        _ => file.extend(bytes),
    };
    for i in 0..N {
        for (k, v) in [position(i), 0.5, 0.25, -1.0, i as f32, 0.0, 2.0].into_iter().enumerate() {
            match k {
                3 => put(&[7], &7, " "),
                6 => put(&v.to_le_bytes(), &v, "\n"),
                _ => put(&v.to_le_bytes(), &v, " "),
            }
        }
    }
    for i in 0..N {
        let n = if i % 1000 == 999 { 3 + i / 1000 % 3 } else { 3 };
        put(&[n as u8], &n, " ");
        (0..n).for_each(|k| {
            put(&corner(i + k).to_le_bytes(), &corner(i + k), if k + 1 < n { " " } else { "\n" })
        });
    }
    file
}

#[test]
fn plain_rows_are_read_as_text_is() {
    let (position, corner) = (|i| i as f32 * 0.125, |i| (i * 7 % 12_000) as i32);
    let text = given(&plain("ascii", position, corner)).unwrap();
    assert_eq!(
        (text.p.len(), text.n.len(), text.triangles.len(), text.quads.len()),
        (12_000, 12_000, 12_004, 4)
    );
    for format in ["binary_little_endian", "binary_big_endian"] {
        let file = plain(format, position, corner);
        assert_eq!(given(&file).unwrap(), text, "{format}");
        assert_eq!(given(&gzip(&file)).unwrap(), text, "{format}");
        // Within the last vertex, the first and a later face.
        for cut in [12_000 * 25 - 3, 12_000 * 25 + 5, 12_000 * 25 + 6000 * 13] {
            let start = file.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
            let e = refusal(&file[..start + cut]);
            let want = format!("a.ply: byte {}: the file ends before all", start + cut);
            assert!(e.starts_with(&want), "{format}, {cut}: {e}");
        }
    }
}

#[test]
fn faults_of_plain_rows_are_named_with_their_place() {
    let (sound, at) = (|i: usize| (i * 7 % 12_000) as i32, |i: usize| i as f32);
    for format in ["binary_little_endian", "binary_big_endian"] {
        let file = plain(format, at, sound);
        let start = file.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
        let e = refusal(&plain(format, |i| if i == 7000 { f32::NAN } else { at(i) }, sound));
        let want =
            format!("a.ply: byte {}: `x` of vertex 7000 is NaN, not a finite number", start + 7000 * 25);
        assert!(e.starts_with(&want), "{e}");
        for bad in [-1, 12_000, i32::MIN] {
            let e = refusal(&plain(format, at, |i| if i == 500 { bad } else { sound(i) }));
            let place = start + 12_000 * 25 + 498 * 13 + 9;
            let want = format!("a.ply: byte {place}: face 498 names vertex {bad}, but there are 12000");
            assert!(e.starts_with(&want), "{e}");
        }
    }
}
