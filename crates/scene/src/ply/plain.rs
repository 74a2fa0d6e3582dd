//! Rows of binary files whose numbers lie at fixed places, as nearly all of them do: read many at once.
//!
//! A row that is not as the rest, is faulty or is cut off is left for [`body`](super::body), which reads number by number and knows
//! what to say.

use super::Fault;
use super::body::Numbers;
use super::header::{Element, Kind, Property, Type};

/// Vertices of scalar properties, of which those that count are all of type `float`.
pub(super) struct PlainVertices {
    /// Bytes of a row.
    row: usize,
    /// Where in the row each slot's number begins.
    at: [Option<usize>; 8],
}

impl PlainVertices {
    /// `None` where vertices are not plain; `slots` says where each property goes.
    pub(super) fn of(element: &Element, slots: &[Option<usize>]) -> Option<PlainVertices> {
        let mut plain = PlainVertices { row: 0, at: [None; 8] };
        for (Property { kind, .. }, slot) in element.properties.iter().zip(slots) {
            match (kind, slot) {
                (Kind::Scalar(Type::F32), Some(slot)) => plain.at[*slot] = Some(plain.row),
                (Kind::Scalar(_), None) => {}
                (Kind::Scalar(_) | Kind::List { .. }, _) => return None,
            }
            let (Kind::Scalar(t) | Kind::List { item: t, .. }) = kind;
            plain.row += t.size() as usize;
        }
        Some(plain)
    }

    /// Reads at most `n` vertices, up to one whose position is not finite; gives how many.
    pub(super) fn read<N: Numbers>(
        &self,
        numbers: &mut N,
        n: u64,
        push: &mut impl FnMut([f32; 8]),
    ) -> Result<u64, Fault> {
        read_rows(numbers, self.row, n, |row| {
            let v = self.at.map(|at| at.map_or(0.0, |at| f32::from_le_bytes(number::<N>(row, at))));
            let [x, y, z, ..] = v;
            let sound = [x, y, z].iter().all(|x| x.is_finite());
            if sound {
                push(v);
            }
            sound
        })
    }
}

/// Bytes of a triangle: the number of corners, and the corners.
const TRIANGLE: usize = 13;

/// Faces are lists of corners and nothing else, in the types that everybody writes.
pub(super) fn has_plain_faces(element: &Element) -> bool {
    let kinds: Vec<Kind> = element.properties.iter().map(|p| p.kind).collect();
    matches!(kinds[..], [Kind::List { count: Type::U8 | Type::I8, item: Type::I32 | Type::U32 }])
}

/// Reads at most `n` faces, up to one that is no triangle or has a corner beyond the vertices; gives how many. Of such faces corners
/// below zero lie beyond 2^31 vertices, which there may not be.
pub(super) fn read_triangles<N: Numbers>(
    numbers: &mut N,
    n: u64,
    n_vertices: u32,
    triangles: &mut Vec<[u32; 3]>,
) -> Result<u64, Fault> {
    read_rows(numbers, TRIANGLE, n, |row| {
        let corners = [1, 5, 9].map(|at| u32::from_le_bytes(number::<N>(row, at)));
        let sound = row[0] == 3 && corners.iter().all(|c| *c < n_vertices);
        if sound {
            triangles.push(corners);
        }
        sound
    })
}

/// Hands out rows of that many bytes, at most `n` and up to one that is refused, which is not passed; gives how many were taken.
#[inline]
fn read_rows<N: Numbers>(
    numbers: &mut N,
    bytes: usize,
    n: u64,
    mut take: impl FnMut(&[u8]) -> bool,
) -> Result<u64, Fault> {
    let mut taken = 0;
    while taken < n {
        let rows = numbers.rows(bytes, n - taken)?.chunks_exact(bytes);
        let n_shown = rows.len();
        let n_taken = rows.take_while(|row| take(row)).count();
        numbers.pass(n_taken * bytes);
        taken += n_taken as u64;
        if n_taken < n_shown || n_shown == 0 {
            break;
        }
    }
    Ok(taken)
}

/// The four bytes of a number of a row, the lowest first.
#[inline]
fn number<N: Numbers>(row: &[u8], at: usize) -> [u8; 4] {
    N::lowest_first([row[at], row[at + 1], row[at + 2], row[at + 3]])
}
