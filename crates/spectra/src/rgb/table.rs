//! Sigmoids of a grid of RGB values, and interpolation between them.

use std::sync::OnceLock;

use super::fit::{Solver, clamped, grey, to_nm};
use crate::{ColorSpace, Sigmoid};

/// Grid points along each axis.
const RES: usize = 32;

/// The table for sRGB: coefficients as little-endian `f32`, made by `cargo run --release -p sparrow-spectra
/// --example rgb_table` in a few seconds.
static SRGB: &[u8] = include_bytes!("../data/rgb_srgb.bin");

/// The sigmoid for an RGB value, interpolated in a table of 32³ colours per largest component.
///
/// `rgb` is clamped to [0, 1]; equal components give an exactly constant spectrum.
///
/// Error of the round trip RGB to spectrum to RGB in sRGB, over a grid of 14³ colours with components up
/// to `top`: the largest of one component, and the root of the mean square.
///
/// | top | largest | rms |
/// | --- | --- | --- |
/// | 1 | 2.4e-3 | 3.0e-4 |
/// | 0.5 | 8.0e-4 | 1.5e-4 |
/// | 0.1 | 2.5e-4 | 3.9e-5 |
///
/// [`fit_sigmoid`](crate::fit_sigmoid) alone is within 7e-6 everywhere in sRGB. Of the wider spaces, colours
/// within sRGB come back within 8e-3; saturated bright ones beyond it, which no reflectance below one
/// reaches, can be far off.
///
/// The table for sRGB is part of the program; those of other spaces are computed at first use, in about a
/// second (ACES in two).
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

/// `coefficients[((l RES + z) RES + y) RES + x]`: component `l` is the largest, with value `level(z)`; the
/// next one, cyclically, is `ratio(x)` of it, the one after `ratio(y)`.
///
/// Source: [Jakob2019, sec. 4.2]. Spacing and interpolation are our own: with the authors' grid of the same
/// size, linear in the value, the round trip is off by 3.2e-3 at most and 7.4e-4 in the mean square.
struct Table {
    /// [`grey_coefficient`] of the levels.
    levels: [f32; RES],
    ratios: [f32; RES],
    coefficients: Vec<[f32; 3]>,
}

impl Table {
    fn new(coefficients: Vec<[f32; 3]>) -> Self {
        let grid = [0.0; RES];
        let mut table = Self { levels: grid, ratios: grid, coefficients };
        for i in 0..RES {
            table.levels[i] = grey_coefficient(level(i) as f32);
            table.ratios[i] = ratio(i) as f32;
        }
        table
    }

    fn from_bytes(bytes: &[u8]) -> Self {
        let number = |b: &[u8]| b.try_into().map_or(0.0, f32::from_le_bytes);
        let mut coefficients: Vec<_> =
            bytes.chunks_exact(12).map(|b| [number(&b[..4]), number(&b[4..8]), number(&b[8..])]).collect();
        coefficients.resize(3 * RES * RES * RES, [0.0; 3]);
        Self::new(coefficients)
    }

    fn build(solver: &Solver) -> Self {
        let mut coefficients = vec![[0.0; 3]; 3 * RES * RES * RES];
        for l in 0..3 {
            for y in 0..RES {
                for x in 0..RES {
                    let mut column = |order: &mut dyn Iterator<Item = usize>| {
                        // Each colour starts from its neighbour's solution, from the middle outwards.
                        let mut c = [0.0; 3];
                        for z in order {
                            let top = level(z);
                            let mut rgb = [top; 3];
                            rgb[(l + 1) % 3] *= ratio(x);
                            rgb[(l + 2) % 3] *= ratio(y);
                            c = solver.solve(rgb, [c]);
                            coefficients[index(l, z, y, x)] = to_nm(c).c;
                        }
                    };
                    column(&mut (RES / 5..RES));
                    column(&mut (0..RES / 5).rev());
                }
            }
        }
        Self::new(coefficients)
    }

    /// Trilinear interpolation of the coefficients. `rgb` within [0, 1], not all equal.
    fn lookup(&self, rgb: [f32; 3]) -> Sigmoid {
        // The last of equal largest components, as in pbrt-v4.
        let l = (1..3).fold(0, |m, j| if rgb[j] >= rgb[m] { j } else { m });
        let top = rgb[l];
        let (xi, x) = cell(&self.ratios, rgb[(l + 1) % 3] / top);
        let (yi, y) = cell(&self.ratios, rgb[(l + 2) % 3] / top);
        let (zi, z) = cell(&self.levels, grey_coefficient(top));
        let along_x = |zi, yi| {
            let at = index(l, zi, yi, xi);
            mix(self.coefficients[at], self.coefficients[at + 1], x)
        };
        let along_y = |zi| mix(along_x(zi, yi), along_x(zi, yi + 1), y);
        Sigmoid { c: mix(along_y(zi), along_y(zi + 1), z) }
    }
}

/// What a grey spectrum's coefficient would be for a value of `v / 1.1`.
///
/// Colours of one hue have coefficients nearly linear in this number, above all dark ones, so it measures
/// the steps along a column and carries on below its first level. Dividing keeps 1 finite.
fn grey_coefficient(v: f32) -> f32 {
    let v = v / 1.1;
    (v - 0.5) / (v * (1.0 - v)).sqrt()
}

/// Levels of the largest component: dense near 1, and near 0 down to 0.003.
fn level(i: usize) -> f64 {
    let t = 0.03 + 0.97 * i as f64 / (RES - 1) as f64;
    t * t * (3.0 - 2.0 * t)
}

/// Ratios of the other components to the largest: somewhat denser at 0 and at 1 than between.
fn ratio(i: usize) -> f64 {
    let t = i as f64 / (RES - 1) as f64;
    0.5 * (t + t * t * (3.0 - 2.0 * t))
}

fn index(l: usize, z: usize, y: usize, x: usize) -> usize {
    ((l * RES + z) * RES + y) * RES + x
}

/// Cell of an ascending grid, and position within it. Beyond the ends the outermost cell goes on.
fn cell(grid: &[f32; RES], x: f32) -> (usize, f32) {
    // All are counted: that takes fewer steps than a search, whose branches nobody can foresee.
    let i = (grid.iter().map(|&v| u32::from(v <= x)).sum::<u32>() as usize).clamp(1, RES - 1) - 1;
    (i, (x - grid[i]) / (grid[i + 1] - grid[i]))
}

fn mix(a: [f32; 3], b: [f32; 3], t: f32) -> [f32; 3] {
    [0, 1, 2].map(|i| (1.0 - t) * a[i] + t * b[i])
}
