//! The TressFX format, version 4: a header of 160 bytes with offsets of arrays; all strands have the same length.

use super::bytes::{array, f32_at, triple, u32_at};
use super::{CurveFile, Fault, Gathered};
use crate::desc::CurveBasis;

/// Texture coordinates and colours are not looked at, nor the fourth number of a point, its mobility.
pub(super) fn read(bytes: &[u8]) -> Result<CurveFile, Fault> {
    let version = f32_at(bytes, 0, "version")?;
    if !(4.0..5.0).contains(&version) {
        let fault = format!("the version is {version}, and only 4 is known");
        return Err(Fault { remedy: "export the strands as TressFX 4", ..Fault::at_byte(0, fault) });
    }
    let n_strands = u32_at(bytes, 4, "number of strands")?;
    let length = u32_at(bytes, 8, "number of points of a strand")?;
    let points_at = u32_at(bytes, 12, "offset of the points")?;
    if length < 2 {
        return Err(Fault::at_byte(8, format!("strands of {length} points have no length")));
    }
    let Some(n) = n_strands.checked_mul(length) else {
        return Err(Fault::at_byte(4, "the number of points is beyond all measure"));
    };
    let (points, _) = array::<16>(bytes, points_at, n, "points")?;
    let mut out = Gathered::default();
    out.file.points.reserve_exact(n);
    for strand in points.chunks_exact(length) {
        out.push(strand.iter().map(|b| {
            let [x, y, z] = triple(b);
            [x, y, z, -1.0]
        }));
    }
    Ok(out.finish(CurveBasis::CatmullRom))
}
