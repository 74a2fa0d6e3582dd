//! Capital letters of five by seven points, to label pictures without a font.

/// Rows of each letter from the top; the highest of five bits is the left column.
const LETTERS: [[u8; 7]; 26] = [
    [0b01110, 0b10001, 0b10001, 0b11111, 0b10001, 0b10001, 0b10001], // A
    [0b11110, 0b10001, 0b10001, 0b11110, 0b10001, 0b10001, 0b11110], // B
    [0b01110, 0b10001, 0b10000, 0b10000, 0b10000, 0b10001, 0b01110], // C
    [0b11110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b11110], // D
    [0b11111, 0b10000, 0b10000, 0b11110, 0b10000, 0b10000, 0b11111], // E
    [0b11111, 0b10000, 0b10000, 0b11110, 0b10000, 0b10000, 0b10000], // F
    [0b01110, 0b10001, 0b10000, 0b10111, 0b10001, 0b10001, 0b01111], // G
    [0b10001, 0b10001, 0b10001, 0b11111, 0b10001, 0b10001, 0b10001], // H
    [0b01110, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110], // I
    [0b00111, 0b00010, 0b00010, 0b00010, 0b00010, 0b10010, 0b01100], // J
    [0b10001, 0b10010, 0b10100, 0b11000, 0b10100, 0b10010, 0b10001], // K
    [0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b11111], // L
    [0b10001, 0b11011, 0b10101, 0b10101, 0b10001, 0b10001, 0b10001], // M
    [0b10001, 0b11001, 0b10101, 0b10011, 0b10001, 0b10001, 0b10001], // N
    [0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110], // O
    [0b11110, 0b10001, 0b10001, 0b11110, 0b10000, 0b10000, 0b10000], // P
    [0b01110, 0b10001, 0b10001, 0b10001, 0b10101, 0b10010, 0b01101], // Q
    [0b11110, 0b10001, 0b10001, 0b11110, 0b10100, 0b10010, 0b10001], // R
    [0b01111, 0b10000, 0b10000, 0b01110, 0b00001, 0b00001, 0b11110], // S
    [0b11111, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100], // T
    [0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110], // U
    [0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01010, 0b00100], // V
    [0b10001, 0b10001, 0b10001, 0b10101, 0b10101, 0b11011, 0b10001], // W
    [0b10001, 0b10001, 0b01010, 0b00100, 0b01010, 0b10001, 0b10001], // X
    [0b10001, 0b10001, 0b01010, 0b00100, 0b00100, 0b00100, 0b00100], // Y
    [0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b10000, 0b11111], // Z
];
const COLUMNS: usize = 5;
/// Pixels along the side of a point.
const POINT: usize = 2;
/// From one letter to the next.
const ADVANCE: usize = (COLUMNS + 1) * POINT;
/// Height of a letter in pixels.
pub(super) const HEIGHT: usize = 7 * POINT;

/// The pixels of a text, from the left end of its top row: columns and rows. What is no letter from A to Z is blank.
pub(super) fn pixels(text: &str) -> impl Iterator<Item = [usize; 2]> {
    let letters = text.bytes().enumerate().filter(|(_, c)| c.is_ascii_uppercase());
    letters.flat_map(|(i, c)| {
        let rows = LETTERS[usize::from(c - b'A')];
        (0..HEIGHT).flat_map(move |y| {
            let row = rows[y / POINT];
            let inked = move |x: &usize| row >> (COLUMNS - 1 - x / POINT) & 1 == 1;
            (0..COLUMNS * POINT).filter(inked).map(move |x| [i * ADVANCE + x, y])
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_l_stands_on_its_foot() {
        let l: Vec<[usize; 2]> = pixels("-L").collect();
        assert_eq!(l.len(), POINT * POINT * (7 + 4));
        assert!(l.iter().all(|[x, _]| (ADVANCE..2 * ADVANCE - POINT).contains(x)), "after the blank");
        assert!(l.iter().filter(|[_, y]| *y == HEIGHT - 1).count() == COLUMNS * POINT);
    }
}
