//! Sigmoids of a grid of RGB values, and interpolation between them.

use std::sync::OnceLock;

use super::fit::{Solver, clamped, grey, to_nm};
use crate::{ColorSpace, Sigmoid};

/// Grid points along each axis.
const RES: usize = 32;

/// The table for sRGB: coefficients as little-endian `f32`, made by `cargo run --release -p sparrow-spectra
/// --example rgb_table`.
static SRGB: &[u8] = include_bytes!("../data/rgb_srgb.bin");

/// The sigmoid for an RGB value, interpolated in a table of 32³ colours per largest component.
///
/// `rgb` is clamped to [0, 1]; equal components give an exactly constant spectrum.
/// The table for sRGB is part of the program; those of other spaces are computed at first use.
pub fn rgb_to_sigmoid(rgb: [f32; 3], space: ColorSpace) -> Sigmoid {
    static TABLES: [OnceLock<Table>; 4] = [const { OnceLock::new() }; 4];
    let rgb = clamped(rgb);
    if let Some(v) = grey(rgb) {
        return Sigmoid::constant(v);
    }
    let table = TABLES[space as usize].get_or_init(|| match space {
        ColorSpace::Srgb => Table::from_bytes(SRGB),
        ColorSpace::DciP3 | ColorSpace::Rec2020 | ColorSpace::Aces2065_1 => {
            Table::build(&Solver::coarse(space))
        }
    });
    table.lookup(rgb)
}

/// The bytes of a space's table, computed anew at every nanometre. For the example that writes the file.
#[doc(hidden)]
pub fn table_bytes(space: ColorSpace) -> Vec<u8> {
    let table = Table::build(Solver::fine(space));
    table.coefficients.iter().flatten().flat_map(|v| v.to_le_bytes()).collect()
}

/// `coefficients[((l RES + z) RES + y) RES + x]`: component `l` is the largest, with value `levels[z]`; the
/// next one, cyclically, is `x / (RES - 1)` of it, the one after `y / (RES - 1)`.
///
/// Source of the layout: [Jakob2019, sec. 4.2], as in the authors' code and pbrt-v4.
struct Table {
    levels: [f32; RES],
    coefficients: Vec<[f32; 3]>,
}

impl Table {
    fn from_bytes(bytes: &[u8]) -> Self {
        let number = |b: &[u8]| b.try_into().map_or(0.0, f32::from_le_bytes);
        let mut coefficients: Vec<_> =
            bytes.chunks_exact(12).map(|b| [number(&b[..4]), number(&b[4..8]), number(&b[8..])]).collect();
        coefficients.resize(3 * RES * RES * RES, [0.0; 3]);
        Self { levels: levels(), coefficients }
    }

    fn build(solver: &Solver) -> Self {
        let levels = levels();
        let mut coefficients = vec![[0.0; 3]; 3 * RES * RES * RES];
        for l in 0..3 {
            for y in 0..RES {
                for x in 0..RES {
                    let mut column = |order: &mut dyn Iterator<Item = usize>| {
                        // Each colour starts from its neighbour's solution, from the middle outwards.
                        let mut c = [0.0; 3];
                        for z in order {
                            let top = f64::from(levels[z]);
                            let mut rgb = [top; 3];
                            rgb[(l + 1) % 3] *= x as f64 / (RES - 1) as f64;
                            rgb[(l + 2) % 3] *= y as f64 / (RES - 1) as f64;
                            c = solver.solve(rgb, [c]);
                            coefficients[index(l, z, y, x)] = to_nm(c).c;
                        }
                    };
                    column(&mut (RES / 5..RES));
                    column(&mut (0..RES / 5).rev());
                }
            }
        }
        Self { levels, coefficients }
    }

    /// Trilinear interpolation of the coefficients. `rgb` within [0, 1], not all equal.
    fn lookup(&self, rgb: [f32; 3]) -> Sigmoid {
        // The last of equal largest components, as in pbrt-v4.
        let l = (1..3).fold(0, |m, j| if rgb[j] >= rgb[m] { j } else { m });
        let top = rgb[l];
        let step = (RES - 1) as f32 / top;
        let (xi, x) = cell(rgb[(l + 1) % 3] * step);
        let (yi, y) = cell(rgb[(l + 2) % 3] * step);
        let zi = self.levels.partition_point(|&v| v < top).clamp(1, RES - 1) - 1;
        let z = (top - self.levels[zi]) / (self.levels[zi + 1] - self.levels[zi]);
        let along_x = |zi, yi| {
            let at = index(l, zi, yi, xi);
            mix(self.coefficients[at], self.coefficients[at + 1], x)
        };
        let along_y = |zi| mix(along_x(zi, yi), along_x(zi, yi + 1), y);
        Sigmoid { c: mix(along_y(zi), along_y(zi + 1), z) }
    }
}

/// Levels of the largest component, dense near 0 and 1, where the coefficients change fast.
fn levels() -> [f32; RES] {
    let smooth = |x: f64| x * x * (3.0 - 2.0 * x);
    let mut levels = [0.0; RES];
    for (i, v) in levels.iter_mut().enumerate() {
        *v = smooth(smooth(i as f64 / (RES - 1) as f64)) as f32;
    }
    levels
}

fn index(l: usize, z: usize, y: usize, x: usize) -> usize {
    ((l * RES + z) * RES + y) * RES + x
}

/// Cell and position within it, for a grid position in [0, RES - 1].
fn cell(x: f32) -> (usize, f32) {
    let i = (x as usize).min(RES - 2);
    (i, x - i as f32)
}

fn mix(a: [f32; 3], b: [f32; 3], t: f32) -> [f32; 3] {
    [0, 1, 2].map(|i| (1.0 - t) * a[i] + t * b[i])
}
