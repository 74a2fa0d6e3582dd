//! The global Sobol sequence: generator matrices, and the samples that fall into a pixel.

use super::joe_kuo::JOE_KUO;

/// Dimensions with generator matrices of their own: two of the image plane, the rest of the path.
pub(crate) const N_DIMENSIONS: u32 = 128;

/// Index bits the matrices cover.
pub(crate) const N_COLUMNS: usize = 52;
/// A column's worth of index bits is looked up four at a time.
const N_NIBBLES: usize = N_COLUMNS / 4;

/// Largest power of two of the image's side, as its logarithm; wider images repeat.
const MAX_LOG2_SIDE: u32 = 16;

/// Sums of columns for every value of four index bits: one cache line per four bits.
type Matrix = [[u32; 16]; N_NIBBLES];

/// Tables of the sequence for one image size; 104 KiB.
pub(crate) struct SobolTables {
    matrices: Vec<Matrix>,
    log2_side: u32,
    /// Index bits that move the point from pixel (0, 0) to the pixel whose coordinate bits are set: x first, then y.
    to_pixel: Vec<u64>,
}

/// Columns of dimension `d` as binary fractions, by the recurrence of [JoeKuo2008].
fn columns(d: usize) -> [u32; N_COLUMNS] {
    let mut v = [0u32; N_COLUMNS];
    if d == 0 {
        for (j, c) in v.iter_mut().enumerate().take(32) {
            *c = 1 << (31 - j);
        }
        return v;
    }
    let (degree, inner, initial) = JOE_KUO[d - 1];
    let s = degree as usize;
    for j in 0..s {
        v[j] = u32::from(initial[j]) << (31 - j);
    }
    for j in s..N_COLUMNS {
        v[j] = v[j - s] ^ (v[j - s] >> s);
        for k in 1..s {
            if (inner >> (s - 1 - k)) & 1 == 1 {
                v[j] ^= v[j - k];
            }
        }
    }
    v
}

fn nibble_table(d: usize) -> Matrix {
    let columns = columns(d);
    let mut m = [[0u32; 16]; N_NIBBLES];
    for (n, row) in m.iter_mut().enumerate() {
        for bits in 1..16usize {
            // All bits but the lowest one have been summed before.
            row[bits] = row[bits & (bits - 1)] ^ columns[4 * n + bits.trailing_zeros() as usize];
        }
    }
    m
}

/// How often an index has passed the end of the sequence: wide images leave fewer than 2^32 points to a pixel, and what comes
/// after them is scrambled anew.
#[inline(always)]
pub(crate) fn turn(index: u64) -> u32 {
    (index >> N_COLUMNS) as u32
}

impl SobolTables {
    /// Tables for an image of this size.
    pub(crate) fn new(resolution: [u32; 2]) -> SobolTables {
        let side = resolution[0].max(resolution[1]).clamp(1, 1 << MAX_LOG2_SIDE);
        let log2_side = side.next_power_of_two().trailing_zeros();
        let matrices = (0..N_DIMENSIONS as usize).map(nibble_table).collect();
        let mut tables = SobolTables { matrices, log2_side, to_pixel: Vec::new() };
        tables.to_pixel = tables.invert();
        tables
    }

    /// The sequence's value as a binary fraction; bits of `index` beyond 52 are ignored.
    #[inline]
    pub(crate) fn value(&self, index: u64, dimension: u32) -> u32 {
        let matrix = &self.matrices[dimension as usize];
        let mut rest = index;
        let mut v = 0;
        for row in matrix {
            v ^= row[(rest & 15) as usize];
            rest >>= 4;
            if rest == 0 {
                break;
            }
        }
        v
    }

    /// What bits `j` to `j + 3` of an index add to [`value`](Self::value); `j` is a multiple of 4 below [`N_COLUMNS`].
    #[inline(always)]
    pub(crate) fn columns(&self, dimension: u32, j: usize) -> [u32; 4] {
        let row = &self.matrices[dimension as usize][j / 4];
        [row[1], row[2], row[4], row[8]]
    }

    /// Bits of the pixel, x then y, that the point with this index falls into.
    fn pixel_bits(&self, index: u64) -> u64 {
        let m = self.log2_side;
        let top = |d| u64::from(self.value(index, d)) >> (32 - m);
        top(0) | (top(1) << m)
    }

    /// Inverts the map from the lower `2 m` index bits to the pixel, by elimination over single bits.
    ///
    /// The first two dimensions form a (0, 2)-sequence, so the map is one to one.
    fn invert(&self) -> Vec<u64> {
        let n = 2 * self.log2_side as usize;
        let mut rows: Vec<(u64, u64)> = (0..n).map(|b| (self.pixel_bits(1 << b), 1 << b)).collect();
        for bit in 0..n {
            let Some(pivot) = (bit..n).find(|r| rows[*r].0 >> bit & 1 == 1) else { continue };
            rows.swap(bit, pivot);
            let (p, i) = rows[bit];
            for (r, row) in rows.iter_mut().enumerate() {
                if r != bit && row.0 >> bit & 1 == 1 {
                    *row = (row.0 ^ p, row.1 ^ i);
                }
            }
        }
        rows.into_iter().map(|row| row.1).collect()
    }

    /// Index of the `sample`-th point of the sequence that falls into `pixel`. [Gruenschloss2012]
    #[inline]
    pub(crate) fn index(&self, pixel: [u32; 2], sample: u32) -> u64 {
        let m = self.log2_side;
        let mask = (1u64 << m) - 1;
        let high = u64::from(sample) << (2 * m);
        let target = (u64::from(pixel[0]) & mask) | ((u64::from(pixel[1]) & mask) << m);
        let mut missing = target ^ self.pixel_bits(high);
        let mut index = high;
        while missing != 0 {
            index ^= self.to_pixel[missing.trailing_zeros() as usize];
            missing &= missing - 1;
        }
        index
    }

    /// Place in the image plane of the first `2^log2_side` square, as two binary fractions.
    #[inline]
    pub(crate) fn plane(&self, index: u64) -> [u32; 2] {
        [self.value(index, 0), self.value(index, 1)]
    }

    /// Logarithm of the image's side, rounded up to a power of two.
    #[inline]
    pub(crate) fn log2_side(&self) -> u32 {
        self.log2_side
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_points_are_those_of_joe_and_kuo() {
        // Points 1 to 3 as printed by the authors' program, whose Gray-code order visits 1, 3, 2. [JoeKuo2008]
        let t = SobolTables::new([1, 1]);
        let rows: [(u64, [f64; 5]); 3] = [
            (1, [0.5, 0.5, 0.5, 0.5, 0.5]),
            (3, [0.75, 0.25, 0.25, 0.25, 0.75]),
            (2, [0.25, 0.75, 0.75, 0.75, 0.25]),
        ];
        for (i, row) in rows {
            for (d, want) in row.iter().enumerate() {
                let got = f64::from(t.value(i, d as u32)) / 4_294_967_296.0;
                assert!((got - want).abs() < 1e-12, "index {i} dimension {d}: {got} for {want}");
            }
        }
    }

    #[test]
    fn every_dimension_is_a_one_dimensional_net() {
        let t = SobolTables::new([1, 1]);
        for d in 0..N_DIMENSIONS {
            let mut seen = vec![false; 1024];
            for i in 0..1024u64 {
                seen[(t.value(i + (7 << 30), d) >> 22) as usize] = true;
            }
            assert!(seen.iter().all(|s| *s), "dimension {d}");
        }
    }

    #[test]
    fn the_index_falls_into_its_pixel() {
        for side in [1u32, 2, 100, 1000] {
            let t = SobolTables::new([side, side / 2 + 1]);
            for (x, y, s) in [(0, 0, 0), (side - 1, side / 2, 5), (side / 3, side / 4, 1000)] {
                let i = t.index([x, y], s);
                assert_eq!(i >> (2 * t.log2_side), u64::from(s));
                assert_eq!(t.pixel_bits(i), u64::from(x) | u64::from(y) << t.log2_side);
            }
        }
    }
}
