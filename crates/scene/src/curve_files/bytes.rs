//! Little-endian numbers out of a slice.

use super::Fault;

/// The four bytes at `at`, as a function makes a number of them.
fn four<T>(bytes: &[u8], at: usize, what: &str, make: fn([u8; 4]) -> T) -> Result<T, Fault> {
    match bytes.get(at..).and_then(|b| b.first_chunk::<4>()) {
        Some(b) => Ok(make(*b)),
        None => Err(Fault::at_byte(bytes.len(), format!("the file ends before the {what} at byte {at}"))),
    }
}

/// A whole number.
pub(super) fn u32_at(bytes: &[u8], at: usize, what: &str) -> Result<usize, Fault> {
    four(bytes, at, what, u32::from_le_bytes).map(|n| n as usize)
}

/// A number.
pub(super) fn f32_at(bytes: &[u8], at: usize, what: &str) -> Result<f32, Fault> {
    four(bytes, at, what, f32::from_le_bytes)
}

/// `n` items of `N` bytes from `at` on, and where they end. Nothing is set aside before the file is known to hold them.
pub(super) fn array<'a, const N: usize>(
    bytes: &'a [u8],
    at: usize,
    n: usize,
    what: &str,
) -> Result<(&'a [[u8; N]], usize), Fault> {
    let end = n.checked_mul(N).and_then(|size| size.checked_add(at));
    match end.and_then(|end| Some((bytes.get(at..end)?.as_chunks::<N>().0, end))) {
        Some(found) => Ok(found),
        None => Err(Fault::at_byte(
            bytes.len(),
            format!("the header promises {n} {what} from byte {at} on, and the file ends before"),
        )),
    }
}

/// Three numbers out of twelve bytes or more.
pub(super) fn triple(b: &[u8]) -> [f32; 3] {
    let (four, _) = b.as_chunks::<4>();
    let at = |i: usize| four.get(i).map_or(f32::NAN, |b| f32::from_le_bytes(*b));
    [at(0), at(1), at(2)]
}
