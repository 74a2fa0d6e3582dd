//! Strands as text: a line for each point, an empty line between strands.

use super::{CurveFile, Fault, Gathered};
use crate::desc::CurveBasis;

/// `x y z radius`, or `x y z` where radii are left to the reader.
pub(super) fn read(bytes: &[u8]) -> Result<CurveFile, Fault> {
    let mut out = Gathered::default();
    let mut strand: Vec<[f32; 4]> = Vec::new();
    let mut close = |strand: &mut Vec<[f32; 4]>| {
        if !strand.is_empty() {
            out.push(strand.drain(..));
        }
    };
    for (i, line) in bytes.split(|&b| b == b'\n').enumerate() {
        let line = line.trim_ascii();
        if line.is_empty() {
            close(&mut strand);
        } else {
            strand.push(point(line).map_err(|fault| Fault::at_line(i + 1, fault))?);
        }
    }
    close(&mut strand);
    Ok(out.finish(CurveBasis::BSpline))
}

fn point(line: &[u8]) -> Result<[f32; 4], String> {
    let mut p = [0.0, 0.0, 0.0, -1.0];
    let mut n = 0;
    for word in line.split(u8::is_ascii_whitespace).filter(|w| !w.is_empty()) {
        let text = str::from_utf8(word).unwrap_or("not text");
        let Ok(v) = text.parse::<f32>() else {
            let word: String = String::from_utf8_lossy(word).chars().take(20).collect();
            return Err(format!("`{word}` is no number"));
        };
        if let Some(slot) = p.get_mut(n) {
            *slot = if n == 3 { 2.0 * v.max(0.0) } else { v };
        }
        n += 1;
    }
    match n {
        3 | 4 => Ok(p),
        _ => Err(format!("a point has three numbers and a radius, and here are {n}")),
    }
}
