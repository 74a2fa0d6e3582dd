//! The TressFX format, version 4: a header of 160 bytes with offsets of arrays; all strands have the same length.

use super::bytes::{array, f32_at, triple, u32_at};
use super::{CurveFile, Fault, Gathered};
use crate::desc::CurveBasis;

/// The thickness of a strand, where there is one, is taken for the width of its points. Texture coordinates and colours are not looked
/// at, nor the fourth number of a point, its mobility.
pub(super) fn read(bytes: &[u8]) -> Result<CurveFile, Fault> {
    let version = f32_at(bytes, 0, "version")?;
    if !(4.0..5.0).contains(&version) {
        let fault = format!("the version is {version}, and only 4 is known");
        return Err(Fault { remedy: "export the strands as TressFX 4", ..Fault::at_byte(0, fault) });
    }
    let n_strands = u32_at(bytes, 4, "number of strands")?;
    let length = u32_at(bytes, 8, "number of points of a strand")?;
    let points_at = u32_at(bytes, 12, "offset of the points")?;
    let widths_at = u32_at(bytes, 24, "offset of the thicknesses")?;
    if length < 2 {
        return Err(Fault::at_byte(8, format!("strands of {length} points have no length")));
    }
    let Some(n) = n_strands.checked_mul(length) else {
        return Err(Fault::at_byte(4, "the number of points is beyond all measure"));
    };
    let (points, _) = array::<16>(bytes, points_at, n, "points")?;
    // No array stands where the header does.
    let n_widths = if widths_at == 0 { 0 } else { n_strands };
    let (widths, _) = array::<4>(bytes, widths_at, n_widths, "thicknesses")?;
    let mut out = Gathered::default();
    out.file.points.reserve_exact(n);
    for (i, strand) in points.chunks_exact(length).enumerate() {
        let width = widths.get(i).map_or(-1.0, |b| f32::from_le_bytes(*b));
        out.push(strand.iter().map(|b| {
            let [x, y, z] = triple(b);
            [x, y, z, width]
        }));
    }
    Ok(out.finish(CurveBasis::CatmullRom))
}
