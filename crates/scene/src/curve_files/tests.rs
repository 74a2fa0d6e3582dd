#![allow(clippy::float_cmp, reason = "the values are exact")]

use std::io::Write;

use super::*;

/// A HAIR file of strands with these numbers of segments; `flags` choose its arrays. Point `i` lies at `(i, 2i, 3i)` and is
/// `0.01 i` wide.
fn hair(flags: u32, segments: &[u16]) -> Vec<u8> {
    let n_points: u32 = segments.iter().map(|&s| u32::from(s) + 1).sum();
    let mut b = b"HAIR".to_vec();
    let all_alike = u32::from(segments[0]);
    for n in [segments.len() as u32, n_points, flags, all_alike] {
        b.extend(n.to_le_bytes());
    }
    for v in [0.25_f32, 0.5, 0.1, 0.2, 0.3] {
        b.extend(v.to_le_bytes());
    }
    b.resize(128, 0);
    let mut floats = |on: u32, per_point: u32, f: &dyn Fn(u32, u32) -> f32| {
        if flags & on != 0 {
            for i in 0..n_points {
                (0..per_point).for_each(|k| b.extend(f(i, k).to_le_bytes()));
            }
        }
    };
    let mut head = Vec::new();
    if flags & 1 != 0 {
        segments.iter().for_each(|s| head.extend(s.to_le_bytes()));
    }
    floats(2, 3, &|i, k| (i * (k + 1)) as f32);
    floats(4, 1, &|i, _| 0.01 * i as f32);
    floats(8, 1, &|_, _| 0.5);
    floats(16, 3, &|_, _| 0.5);
    b.splice(128..128, head);
    b
}

fn at(bytes: &[u8], name: &str) -> Result<CurveFile, String> {
    read_from(bytes, Path::new(name)).map_err(|e| e.to_string())
}

#[test]
fn hair_files_with_any_arrays_are_read() {
    for flags in (0..32).filter(|f| f & 2 != 0) {
        let segments: &[u16] = if flags & 1 != 0 { &[3, 1, 5] } else { &[3, 3, 3] };
        let file = at(&hair(flags, segments), "a.hair").unwrap();
        let first = if flags & 1 != 0 { vec![0, 4, 6] } else { vec![0, 4, 8] };
        assert_eq!(file.strands, first, "flags {flags}");
        assert_eq!(file.points.len(), 12);
        let width = if flags & 4 != 0 { 0.07 } else { 0.25 };
        assert_eq!(file.points[7], [7.0, 14.0, 21.0, width]);
        assert_eq!(file.basis, CurveBasis::CatmullRom);
    }
}

#[test]
fn compressed_files_are_read() {
    let dir = std::env::temp_dir().join(format!("sparrow-hair-{}", std::process::id()));
    let mut gz = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
    gz.write_all(&hair(6, &[3, 3])).unwrap();
    std::fs::write(&dir, gz.finish().unwrap()).unwrap();
    let read = read(&dir);
    std::fs::remove_file(&dir).unwrap();
    assert_eq!(read.unwrap().strands, [0, 4]);
}

/// Wherever a file ends too early, the message says so.
#[test]
fn truncated_files_are_refused() {
    let whole = hair(31, &[3, 1, 5]);
    for n in 4..whole.len() {
        match at(&whole[..n], "a.hair") {
            Err(e) => {
                assert!(e.starts_with("a.hair: byte ") && e.ends_with("; export the strands again"), "{e}")
            }
            // Transparency and colour are not looked at.
            Ok(_) => assert!(n >= 128 + 6 + 12 * 12 + 12 * 4),
        }
    }
}

#[test]
fn headers_that_lie_are_refused() {
    let set = |at: usize, n: u32| {
        let mut b = hair(3, &[3, 1, 5]);
        b[at..at + 4].copy_from_slice(&n.to_le_bytes());
        self::at(&b, "a.hair").unwrap_err()
    };
    assert!(set(4, u32::MAX).contains("promises 4294967295 numbers of segments"));
    assert!(set(8, u32::MAX).contains("the strands have 12 points together, and the header says 4294967295"));
    assert!(set(8, 11).contains("12 points together"));
    assert!(set(12, 0).contains("holds no points"));
    let mut b = hair(2, &[3, 3]);
    b[4..8].copy_from_slice(&u32::MAX.to_le_bytes());
    b[16..20].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(at(&b, "a.hair").unwrap_err().contains("points together"));
    assert!(at(b"HAIR", "a.hair").unwrap_err().contains("within the header"));
    assert!(at(b"RIAH", "a.hair").unwrap_err().contains("does not begin with the letters HAIR"));
}

#[test]
fn strands_that_are_none_are_left_out() {
    let mut b = hair(3, &[0, 2, 1, 2]);
    // The first number of the third strand's second point.
    let place = 128 + 8 + 12 * 5;
    b[place..place + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    let file = at(&b, "a.hair").unwrap();
    assert_eq!(file.strands, [0, 3]);
    assert_eq!(file.points.len(), 6);
    let notes =
        ["1 strand of fewer than two points left out", "1 strand with numbers that are not finite left out"];
    assert_eq!(file.notes, notes);
}

fn tfx(version: f32, n: u32, length: u32) -> Vec<u8> {
    let mut b = version.to_le_bytes().to_vec();
    for v in [n, length, 160] {
        b.extend(v.to_le_bytes());
    }
    b.resize(160, 0);
    for i in 0..n * length {
        [i as f32, 0.0, 1.0, 1.0].iter().for_each(|v| b.extend(v.to_le_bytes()));
    }
    b
}

#[test]
fn tressfx_files_are_read_or_refused() {
    let file = at(&tfx(4.0, 3, 4), "a.TFX").unwrap();
    assert_eq!((file.strands, file.points[5]), (vec![0, 4, 8], [5.0, 0.0, 1.0, -1.0]));
    assert!(at(&tfx(3.0, 3, 4), "a.tfx").unwrap_err().contains("the version is 3, and only 4 is known"));
    assert!(at(&tfx(4.0, 3, 1), "a.tfx").unwrap_err().contains("have no length"));
    let whole = tfx(4.0, 3, 4);
    for n in 0..whole.len() {
        assert!(at(&whole[..n], "a.tfx").is_err());
    }
    // Behind the points, a thickness for each strand.
    let mut thick = whole.clone();
    thick[24..28].copy_from_slice(&(whole.len() as u32).to_le_bytes());
    [0.25_f32, 0.5, f32::NAN].iter().for_each(|v| thick.extend(v.to_le_bytes()));
    let file = at(&thick, "a.tfx").unwrap();
    assert_eq!((file.points[3][3], file.points[4][3], file.strands), (0.25, 0.5, vec![0, 4]));
    assert_eq!(file.notes, ["1 strand with numbers that are not finite left out"]);
    let short = at(&thick[..thick.len() - 1], "a.tfx").unwrap_err();
    assert!(short.contains("promises 3 thicknesses"), "{short}");
}

#[test]
fn text_is_read_or_refused() {
    let text = b"\n\n0 0 0 .1\r\n1 0 0 .2\n\n \n2 0 0\n3 0 0\n4 0 0";
    let file = at(text, "a.txt").unwrap();
    assert_eq!(file.strands, [0, 2]);
    assert_eq!(file.points[1], [1.0, 0.0, 0.0, 0.4]);
    assert!(file.points[2][3] < 0.0, "no radius is given");
    assert_eq!(file.basis, CurveBasis::BSpline);
    assert_eq!(
        at(b"0 0 0 1\n1 2 x 3", "a.txt").unwrap_err(),
        "a.txt:2: `x` is no number; export the strands again"
    );
    assert!(at(b"0 0\n", "a.txt").unwrap_err().contains("and here are 2"));
}
