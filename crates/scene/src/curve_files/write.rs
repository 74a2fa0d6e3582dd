//! Strands to the HAIR format: [`hair_bytes`].

use super::hair::{HEADER, MAGIC, POINTS, SEGMENTS, THICKNESS};

/// The bytes of a HAIR file with these strands, points `x y z width`.
///
/// Numbers of segments and widths are stored once for all where all are alike. None where a strand has no point or more than
/// 65536, or where there are 2^32 points or more, which the format cannot say.
pub fn hair_bytes<'a>(strands: impl IntoIterator<Item = &'a [[f32; 4]]>) -> Option<Vec<u8>> {
    let strands: Vec<&[[f32; 4]]> = strands.into_iter().collect();
    let segments: Option<Vec<u16>> =
        strands.iter().map(|s| u16::try_from(s.len().checked_sub(1)?).ok()).collect();
    let segments = segments?;
    let n_strands = u32::try_from(strands.len()).ok()?;
    let n_points = u32::try_from(strands.iter().map(|s| s.len()).sum::<usize>()).ok()?;
    let points = || strands.iter().copied().flatten();
    let same_segments = segments.iter().all(|s| Some(s) == segments.first());
    let width = points().next().map_or(0.0, |p| p[3]);
    // Bit by bit; a width of zero for all would be read as none given.
    let same_width = width > 0.0 && points().all(|p| p[3].to_bits() == width.to_bits());

    let mut flags = POINTS as u32;
    flags |= if same_segments { 0 } else { SEGMENTS as u32 };
    flags |= if same_width { 0 } else { THICKNESS as u32 };
    let default_segments = if same_segments { segments.first().map_or(0, |&s| u32::from(s)) } else { 0 };
    let mut bytes = MAGIC.to_vec();
    for n in [n_strands, n_points, flags, default_segments] {
        bytes.extend(n.to_le_bytes());
    }
    let [transparency, red, green, blue] = [0.0, 1.0, 1.0, 1.0];
    for v in [width, transparency, red, green, blue] {
        bytes.extend(f32::to_le_bytes(v));
    }
    bytes.resize(HEADER, 0);
    if !same_segments {
        bytes.extend(segments.iter().flat_map(|s| s.to_le_bytes()));
    }
    bytes.extend(points().flat_map(|p| [p[0], p[1], p[2]]).flat_map(f32::to_le_bytes));
    if !same_width {
        bytes.extend(points().flat_map(|p| p[3].to_le_bytes()));
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::curve_files::read_from;

    /// `n` points whose numbers have no short form.
    fn strand(n: usize, width: impl Fn(usize) -> f32) -> Vec<[f32; 4]> {
        (0..n).map(|i| [0.1 * i as f32, -0.3, 1.0 / (i as f32 + 3.0), width(i)]).collect()
    }

    #[test]
    fn what_is_written_is_read() {
        let taper = |i: usize| 0.01 * i as f32;
        let cases: [(Vec<Vec<[f32; 4]>>, usize); 3] = [
            (vec![strand(3, |_| 0.2), strand(3, |_| 0.2)], 12 * 6),
            (vec![strand(3, taper), strand(3, taper)], 16 * 6),
            (vec![strand(2, taper), strand(5, |_| 0.0)], 2 * 2 + 16 * 7),
        ];
        for (strands, size) in cases {
            let bytes = hair_bytes(strands.iter().map(Vec::as_slice)).unwrap();
            assert_eq!(bytes.len(), HEADER + size);
            let file = read_from(&bytes, Path::new("a.hair")).unwrap();
            assert_eq!(file.points, strands.concat());
            assert_eq!(file.strands, [0, strands[0].len() as u32]);
            assert!(file.notes.is_empty(), "{:?}", file.notes);
        }
    }

    #[test]
    fn what_the_format_cannot_say_is_refused() {
        assert_eq!(hair_bytes([&[][..]]), None);
        let long = strand(65_537, |_| 1.0);
        assert_eq!(hair_bytes([&long[..]]), None);
        assert!(hair_bytes([&long[1..]]).is_some());
    }
}
