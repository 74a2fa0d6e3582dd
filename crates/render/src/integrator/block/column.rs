//! Columns of numbers that run in lanes.

use core::ops::{Deref, DerefMut};

use sparrow_geometry::RoundedPoint;
use sparrow_math::{MAX_WIDTH, Real, Vec3, vec3};
use sparrow_spectra::{N_LAMBDA, Spectrum};

/// Most vertices of one material that are worked off together: what is known of them stays in the nearest cache.
pub(crate) const BATCH: usize = 256;

/// A number for each vertex of a batch.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(crate) struct Column([f32; BATCH]);

impl Default for Column {
    fn default() -> Column {
        Column([0.0; BATCH])
    }
}
impl Deref for Column {
    type Target = [f32; BATCH];
    #[inline(always)]
    fn deref(&self) -> &[f32; BATCH] {
        &self.0
    }
}
impl DerefMut for Column {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [f32; BATCH] {
        &mut self.0
    }
}

/// The places of lanes among themselves.
pub(super) const LANES: [u32; MAX_WIDTH] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

/// The vertices whose lanes are computed where `n` count: up to whole registers.
#[inline(always)]
pub(crate) fn padded(n: usize) -> usize {
    n.next_multiple_of(MAX_WIDTH)
}

/// Repeats the last of `n` numbers up to whole registers, so that lanes beyond the end compute what another lane computes.
#[inline(always)]
pub(crate) fn pad(column: &mut Column, n: usize) {
    if n > 0 {
        let last = column[n - 1];
        column[n..padded(n)].fill(last);
    }
}

/// Reads a number, for one path or for lanes of them.
#[inline(always)]
pub(super) fn load<R: Real>(column: &Column, k: usize) -> R {
    R::load(&column[..], k)
}

/// Writes a vector to columns.
#[inline(always)]
pub(super) fn put_vector(columns: &mut [Column; 3], k: usize, v: Vec3<f32>) {
    columns[0][k] = v.x;
    columns[1][k] = v.y;
    columns[2][k] = v.z;
}

/// Reads a vector from columns, for one path or for lanes of them.
#[inline(always)]
pub(super) fn vector<R: Real>(columns: &[Column; 3], k: usize) -> Vec3<R> {
    vec3(R::load(&columns[0][..], k), R::load(&columns[1][..], k), R::load(&columns[2][..], k))
}

/// Writes vectors to columns, for one path or for lanes of them.
#[inline(always)]
pub(super) fn store_vector<R: Real>(v: Vec3<R>, columns: &mut [Column; 3], k: usize) {
    v.x.store(&mut columns[0][..], k);
    v.y.store(&mut columns[1][..], k);
    v.z.store(&mut columns[2][..], k);
}

/// Reads a spectrum from columns, for one path or for lanes of them.
#[inline(always)]
pub(super) fn spectrum<R: Real>(columns: &[Column; N_LAMBDA], k: usize) -> Spectrum<R> {
    Spectrum([load(&columns[0], k), load(&columns[1], k), load(&columns[2], k), load(&columns[3], k)])
}

/// Writes spectra to columns, for one path or for lanes of them.
#[inline(always)]
pub(super) fn store_spectrum<R: Real>(s: Spectrum<R>, columns: &mut [Column; N_LAMBDA], k: usize) {
    s.0[0].store(&mut columns[0][..], k);
    s.0[1].store(&mut columns[1][..], k);
    s.0[2].store(&mut columns[2][..], k);
    s.0[3].store(&mut columns[3][..], k);
}

/// Points of surfaces with bounds of their rounding errors.
#[derive(Default)]
pub(super) struct Rounded {
    pub(super) p: [Column; 3],
    pub(super) p_error: [Column; 3],
    /// Unit geometric normals.
    pub(super) n: [Column; 3],
}

impl Rounded {
    /// Reads a point, for one path or for lanes of them.
    #[inline(always)]
    pub(super) fn get<R: Real>(&self, k: usize) -> RoundedPoint<R> {
        RoundedPoint { p: vector(&self.p, k), p_error: vector(&self.p_error, k), n: vector(&self.n, k) }
    }
    /// Writes a point.
    #[inline(always)]
    pub(super) fn put(&mut self, k: usize, point: &RoundedPoint<f32>) {
        put_vector(&mut self.p, k, point.p);
        put_vector(&mut self.p_error, k, point.p_error);
        put_vector(&mut self.n, k, point.n);
    }
}

/// Writes a spectrum to columns.
#[inline(always)]
pub(super) fn put_spectrum(columns: &mut [Column; N_LAMBDA], k: usize, s: Spectrum<f32>) {
    columns.iter_mut().zip(s.0).for_each(|(column, v)| column[k] = v);
}
