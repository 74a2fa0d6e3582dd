//! A jittered grid per pixel, its cells taken in an order that differs per dimension.

use super::hash::{below_one, join, permute, to_unit};

/// One coordinate, in one of `n` strata.
pub(crate) fn single(n: u32, jitter: bool, sample: u32, key: u64) -> f32 {
    let (stratum, h) = draw(n, jitter, sample, key);
    below_one((stratum as f32 + to_unit(h as u32)) / n as f32)
}

/// Two coordinates, in one of `x * y` strata.
pub(crate) fn pair(grid: [u32; 2], jitter: bool, sample: u32, key: u64) -> [f32; 2] {
    let (stratum, h) = draw(grid[0] * grid[1], jitter, sample, key);
    let (column, row) = (stratum % grid[0], stratum / grid[0]);
    [
        below_one((column as f32 + to_unit(h as u32)) / grid[0] as f32),
        below_one((row as f32 + to_unit((h >> 32) as u32)) / grid[1] as f32),
    ]
}

/// The stratum of a sample, and 64 bits of jitter (or one half, twice).
///
/// Samples beyond the grid start another, independent one.
#[inline]
fn draw(n: u32, jitter: bool, sample: u32, key: u64) -> (u32, u64) {
    let stratum = permute(sample % n, n, join(key, u64::from(sample / n)));
    let h = if jitter { join(key ^ 0x5bd1_e995, u64::from(sample)) } else { 0x8000_0000_8000_0000 };
    (stratum, h)
}
