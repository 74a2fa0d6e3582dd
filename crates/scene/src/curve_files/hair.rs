//! The HAIR format: a header of 128 bytes, then those arrays that its flags name.

use super::bytes::{array, f32_at, triple, u32_at};
use super::{CurveFile, Fault, Gathered};
use crate::desc::CurveBasis;

pub(super) const MAGIC: &[u8] = b"HAIR";
pub(super) const HEADER: usize = 128;

/// Flags of the header, in the order in which the arrays follow it.
pub(super) const SEGMENTS: usize = 1;
pub(super) const POINTS: usize = 2;
pub(super) const THICKNESS: usize = 4;

/// Transparency and colour come last and are not looked at.
pub(super) fn read(bytes: &[u8]) -> Result<CurveFile, Fault> {
    if bytes.len() < HEADER {
        return Err(Fault::at_byte(bytes.len(), "the file ends within the header of 128 bytes"));
    }
    let n_strands = u32_at(bytes, 4, "number of strands")?;
    let n_points = u32_at(bytes, 8, "number of points")?;
    let flags = u32_at(bytes, 12, "flags")?;
    let segments = u32_at(bytes, 16, "number of segments")?;
    let thickness = f32_at(bytes, 20, "thickness")?;
    if flags & POINTS == 0 {
        return Err(Fault::at_byte(12, "the flags say that the file holds no points"));
    }
    let mut at = HEADER;
    let mut each_segments: Option<&[[u8; 2]]> = None;
    if flags & SEGMENTS != 0 {
        let (found, end) = array::<2>(bytes, at, n_strands, "numbers of segments")?;
        (each_segments, at) = (Some(found), end);
    }
    let length = |i: usize| 1 + each_segments.map_or(segments, |s| usize::from(u16::from_le_bytes(s[i])));
    let needed = match each_segments {
        Some(_) => (0..n_strands).map(length).sum(),
        None => n_strands.saturating_mul(segments.saturating_add(1)),
    };
    if needed != n_points {
        let fault = format!("the strands have {needed} points together, and the header says {n_points}");
        return Err(Fault::at_byte(8, fault));
    }
    let (points, end) = array::<12>(bytes, at, n_points, "points")?;
    at = end;
    let mut widths: Option<&[[u8; 4]]> = None;
    if flags & THICKNESS != 0 {
        (widths, _) = array::<4>(bytes, at, n_points, "widths").map(|(found, end)| (Some(found), end))?;
    }
    // A default of zero stands in files that leave the width to the reader.
    let default = if thickness > 0.0 { thickness } else { -1.0 };
    let width = |i: usize| widths.map_or(default, |w| f32::from_le_bytes(w[i]).max(0.0));
    let mut out = Gathered::default();
    out.file.points.reserve_exact(n_points);
    out.file.strands.reserve_exact(n_strands);
    let mut first = 0;
    for strand in 0..n_strands {
        let range = first..first + length(strand);
        first = range.end;
        out.push(range.map(|i| {
            let [x, y, z] = triple(&points[i]);
            [x, y, z, width(i)]
        }));
    }
    Ok(out.finish(CurveBasis::CatmullRom))
}
