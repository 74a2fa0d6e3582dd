//! Lanes against `f32`, bit for bit: every operation of `Real`, over ordinary and awkward numbers.

use sparrow_math::{InLanes, Lanes, Mask, Real, in_lanes, only_in_lanes, widest};

/// Awkward numbers, each met by each in the second operand.
const EDGES: [f32; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    f32::MIN_POSITIVE,
    1e-40,
    3.0e38,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    0.999_999_94,
    1.000_000_1,
    2.5,
    -3.5,
    16_777_216.0,
];

/// Rows to be looked up.
const FOURS: [[f32; 4]; 3] = [[1.0, 2.0, 3.0, 4.0], [0.5, 7.0, 7.0, -1.0], [9.0, 8.0, 7.0, 9.5]];
const ROWS: [[f32; 8]; 2] = [[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0], [9.0; 8]];

/// What `Real` can do, of two numbers; comparisons as 0 and 1.
#[inline(always)]
fn everything<R: Real>(a: R, b: R) -> [R; 28] {
    let bit = |m: R::Mask| R::ONE.only_where(m);
    let (mantissa, exponent) = a.frexp();
    let (sin, cos) = a.sin_cos();
    let [of_four, .., of_four2] = a.look_up_fours(&FOURS);
    let [.., of_eight, _] = (a - b).look_up_rows(&ROWS);
    [
        a + b,
        a - b,
        a * b,
        a / b,
        -a,
        a.sqrt(),
        a.abs(),
        a.min(b),
        a.max(b),
        a.copysign(b),
        a.fma(b, R::of(0.1)),
        bit(a.lt(b)),
        bit(a.le(b)),
        bit(a.lt(b) | b.lt(a)),
        bit(a.le(b) & b.le(a)),
        bit(!a.lt(b)),
        R::select(a.lt(b), a, b),
        a.round(),
        a.clamp(R::of(-20.0), R::of(20.0)).round().pow2(),
        mantissa,
        exponent,
        a.exp(),
        a.abs().ln(),
        sin + cos,
        a.atan2(b),
        a.look_up(&EDGES),
        of_four - of_four2,
        of_eight,
    ]
}

/// Every operation on columns; the results one after another.
struct Everything<'a>(&'a [f32], &'a [f32]);
impl InLanes for Everything<'_> {
    type Output = (usize, Vec<f32>);
    #[inline(always)]
    fn run<R: Real>(self) -> (usize, Vec<f32>) {
        let mut all = vec![0.0; 28 * self.0.len()];
        for i in (0..self.0.len()).step_by(R::WIDTH) {
            let results = everything(R::load(self.0, i), R::load(self.1, i));
            for (k, r) in results.into_iter().enumerate() {
                r.store(&mut all, k * self.0.len() + i);
            }
        }
        (R::WIDTH, all)
    }
}

fn operands() -> (Vec<f32>, Vec<f32>) {
    let pairs = EDGES.iter().flat_map(|&a| EDGES.iter().map(move |&b| (a, b)));
    let mut state = 1u64;
    let random = (0..8192).map(|_| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let at = |s: u32| ((state >> s) & 0xffff) as f32 / 2048.0 - 16.0;
        (at(16), at(40))
    });
    pairs.chain(random).unzip()
}

fn same(a: f32, b: f32) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

#[test]
fn the_widest_lanes_equal_scalars_bit_for_bit() {
    let (a, b) = operands();
    let (width, lanes) = in_lanes(Everything(&a, &b));
    assert!(width == 1 || width == 8);
    let (widest_width, widest_lanes) = only_in_lanes(Everything(&a, &b)).unwrap_or((width, lanes.clone()));
    assert_eq!(widest_width, widest());
    assert!(widest_lanes.iter().zip(&lanes).all(|(w, l)| same(*w, *l)), "in {widest_width} lanes");
    let (_, portable) = Everything(&a, &b).run::<Lanes<8>>();
    let (_, scalar) = Everything(&a, &b).run::<f32>();
    for (k, ((l, p), s)) in lanes.iter().zip(&portable).zip(&scalar).enumerate() {
        let (operation, i) = (k / a.len(), k % a.len());
        assert!(same(*l, *s), "operation {operation} of {} and {}: {l}, scalar {s}", a[i], b[i]);
        assert!(same(*p, *s), "operation {operation} of {} and {}: portable {p}, scalar {s}", a[i], b[i]);
    }
}

/// `any`, `all` and `of` of masks.
struct Masks;
impl InLanes for Masks {
    type Output = [bool; 6];
    #[inline(always)]
    fn run<R: Real>(self) -> [bool; 6] {
        let mut column = [0.0; 16];
        column[R::WIDTH - 1] = 1.0;
        let last = R::load(&column, 0).gt(R::ZERO);
        let none = R::ZERO.gt(R::ONE);
        let wide = R::WIDTH > 1;
        let of = R::Mask::of;
        [last.any(), !none.any(), last.all() != wide, (!none).all(), of(true).all(), !of(false).any()]
    }
}

#[test]
fn masks_tell_any_from_all() {
    assert_eq!(in_lanes(Masks), [true; 6]);
    assert_eq!(only_in_lanes(Masks).unwrap_or([true; 6]), [true; 6]);
    assert_eq!(Masks.run::<Lanes<8>>(), [true; 6]);
    assert_eq!(Masks.run::<f32>(), [true; 6]);
}

/// Rows to lanes and from lanes to other rows: the sum of the columns, then the table written.
struct Rows<'a> {
    table: &'a [[f32; 8]],
    from: &'a [u32],
    to: &'a [u32],
}
impl InLanes for Rows<'_> {
    type Output = Vec<[f32; 8]>;
    #[inline(always)]
    fn run<R: Real>(self) -> Vec<[f32; 8]> {
        let mut out = vec![[0.0; 8]; self.table.len()];
        for k in (0..self.from.len()).step_by(R::WIDTH) {
            let [a, b, c, d, e, f, g, h] = R::gather_rows(self.table, &self.from[k..]);
            let end = self.to.len().min(k + R::WIDTH);
            R::scatter_rows([h, g, f, e, d, c, b, a + b], &mut out, self.to.get(k..end).unwrap_or(&[]));
        }
        out
    }
}

#[test]
fn rows_go_to_their_places() {
    let table: Vec<[f32; 8]> = (0..40).map(|i| core::array::from_fn(|j| (10 * i + j) as f32)).collect();
    let from: Vec<u32> = (0..32).map(|k| k * 7 % 40).collect();
    // Fewer places than lanes at the end, and one twice: the later lane stays.
    let to: Vec<u32> = (0..27).map(|k| if k == 26 { 3 } else { k }).collect();
    let mut expected = vec![[0.0; 8]; 40];
    for (&from, &to) in from.iter().zip(&to) {
        let [a, b, c, d, e, f, g, h] = table[from as usize];
        expected[to as usize] = [h, g, f, e, d, c, b, a + b];
    }
    let rows = || Rows { table: &table, from: &from, to: &to };
    assert_eq!(in_lanes(rows()), expected);
    assert_eq!(only_in_lanes(rows()).unwrap_or_else(in_lanes), expected);
    assert_eq!(rows().run::<Lanes<8>>(), expected);
    assert_eq!(rows().run::<f32>(), expected);
}
