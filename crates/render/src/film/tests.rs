//! Order and split do not matter; nothing that is not finite enters; variances are right.

use super::{Film, FilmError, FilmTile};

/// A small generator for test data: multiplies by an odd constant and hands out the upper bits.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as u32
    }
    fn unit(&mut self) -> f32 {
        self.next() as f32 / 2_147_483_648.0
    }
}

type Sample = (u32, u32, [f32; 3], f32);

/// Samples of wildly different size and both signs, on a film of 8 x 6.
fn samples(n: usize) -> Vec<Sample> {
    let mut r = Random(7);
    let value = |r: &mut Random| (r.unit() - 0.3) * [1e-14, 1.0, 3e7, 1e25][r.next() as usize % 4];
    (0..n)
        .map(|_| {
            let rgb = [value(&mut r), value(&mut r), value(&mut r)];
            let weight = [1.0, -1.0, r.unit() * 2.0 - 0.5][r.next() as usize % 3];
            (r.next() % 8, r.next() % 6, rgb, weight)
        })
        .collect()
}

fn filled(samples: &[Sample]) -> Film {
    let mut film = Film::new(8, 6, true);
    for (x, y, rgb, w) in samples {
        film.add(*x, *y, *rgb, *w);
    }
    film
}

#[test]
fn any_order_and_any_split_give_the_same_bits() {
    let all = samples(5000);
    let whole = filled(&all);
    let mut r = Random(1);
    for round in 0..5 {
        let mut order = all.clone();
        for i in (1..order.len()).rev() {
            order.swap(i, r.next() as usize % (i + 1));
        }
        assert_eq!(filled(&order), whole, "order {round}");
        let cut = r.next() as usize % order.len();
        let mut joined = filled(&order[cut..]);
        joined.merge(&filled(&order[..cut])).unwrap();
        assert_eq!(joined, whole, "split at {cut}");
        let mut tiled = Film::new(8, 6, true);
        for origin in [[3, 0], [0, 0], [3, 4], [0, 4]] {
            let size = if origin[0] == 0 { [3, 4] } else { [50, 4] };
            let mut tile = tiled.tile(origin, size);
            order.iter().for_each(|(x, y, rgb, w)| tile.add(*x, *y, *rgb, *w));
            tiled.absorb(&tile).unwrap();
        }
        assert_eq!(tiled, whole, "tiles {round}");
    }
}

#[test]
fn tiles_without_variance_sum_up_the_same() {
    let (mut film, mut tiled) = (Film::new(8, 6, false), Film::new(8, 6, false));
    let mut tile = tiled.tile([2, 1], [3, 3]);
    // More than a pixel of a tile takes in parts, and some that are no numbers.
    for (i, (x, y, mut rgb, w)) in samples(400_000).into_iter().enumerate() {
        rgb[1] = if i % 1000 == 7 { f32::NAN } else { rgb[1] };
        tile.add(x, y, rgb, w);
        if (2..5).contains(&x) && (1..4).contains(&y) {
            film.add(x, y, rgb, w);
        }
    }
    tiled.absorb(&tile).unwrap();
    assert_eq!(tiled, film);
    assert!(film.rejected() > 0 && film.pixel(2, 1).n > 5000);
}

#[test]
fn raw_sums_rebuild_the_film() {
    let whole = filled(&samples(300));
    let mut copy = Film::new(8, 6, true);
    for y in 0..6 {
        for x in 0..8 {
            copy.add_raw(x, y, &whole.raw(x, y).unwrap()).unwrap();
        }
    }
    assert_eq!(copy, whole);
    assert_eq!(whole.raw(8, 0), None);
    let plain = Film::new(8, 6, false);
    assert_eq!(copy.add_raw(0, 0, &plain.raw(0, 0).unwrap()), Err(FilmError::Variance));
}

#[test]
fn what_is_not_finite_is_refused_and_counted() {
    let mut film = Film::new(2, 1, true);
    film.add(0, 0, [1.0, 2.0, 3.0], 1.0);
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        film.add(0, 0, [0.0, bad, 0.0], 1.0);
        film.add(0, 0, [1.0; 3], bad);
    }
    let p = film.pixel(0, 0);
    assert_eq!((p.rgb, p.n, film.rejected()), ([1.0, 2.0, 3.0], 1, 6));
    // No sample and no weight: black, not NaN.
    assert_eq!(film.pixel(1, 0).rgb, [0.0; 3]);
    film.add(1, 0, [1.0; 3], 1.0);
    film.add(1, 0, [2.0; 3], -1.0);
    assert_eq!(film.pixel(1, 0).rgb, [0.0; 3]);
    assert_eq!(film.pixel(9, 9), super::PixelView::default());
}

#[test]
fn big_and_tiny_values_keep_their_digits() {
    let mut film = Film::new(1, 1, false);
    film.add(0, 0, [1e9, 1e-9, -3.0], 1.0);
    for _ in 0..1000 {
        film.add(0, 0, [1e-6, 1e-9, -3.0], 1.0);
    }
    let p = film.pixel(0, 0);
    let want = (f64::from(1e9f32) + 1000.0 * f64::from(1e-6f32)) / 1001.0;
    assert!((p.rgb[0] - want).abs() < 1e-15 * want, "{} for {want}", p.rgb[0]);
    // One term is off by at most half a step of 2^-64.
    assert!((p.rgb[1] - f64::from(1e-9f32)).abs() < 2.8e-20);
    assert!((p.rgb[2] + 3.0).abs() < 1e-15 && p.variance == [0.0; 3]);
    // Absurd values are cut, not wrapped; a billion of them would be needed to reach the end.
    film.add(0, 0, [f32::MAX, f32::MIN, 0.0], 1.0);
    let p = film.pixel(0, 0);
    assert!(p.rgb[0] > 1e9 && p.rgb[1] < -1e9 && p.rgb[1].is_finite(), "{:?}", p.rgb);
}

#[test]
fn sums_of_squares_that_end_say_so() {
    let mut film = Film::new(1, 1, true);
    film.add(0, 0, [1.0, 1e10, 1.0], 1.0);
    assert_eq!(film.pixel(0, 0).variance, [f64::INFINITY; 3]);
    film.add(0, 0, [3.0, 1e10, 1.0], 1.0);
    let v = film.pixel(0, 0).variance;
    // Of 1 and 3: sample variance 2, of the mean 1.
    assert!((v[0] - 1.0).abs() < 1e-12 && v[1].is_infinite() && v[2].abs() < 1e-12, "{v:?}");
}

/// Variance of 4000 pixels' means against the mean of their own estimates.
fn variance_ratio(weight: impl Fn(&mut Random, f32) -> f32) -> f64 {
    let mut r = Random(99);
    let (mut sum, mut sqr, mut estimate) = (0.0, 0.0, 0.0);
    let mut film = Film::new(1, 1, true);
    for _ in 0..4000 {
        film.clear();
        for _ in 0..64 {
            let v = r.unit();
            let w = weight(&mut r, v);
            film.add(0, 0, [v * v; 3], w);
        }
        let p = film.pixel(0, 0);
        sum += p.rgb[0];
        sqr += p.rgb[0] * p.rgb[0];
        estimate += p.variance[0];
    }
    let true_variance = (sqr - sum * sum / 4000.0) / 3999.0;
    estimate / 4000.0 / true_variance
}

#[test]
fn variance_of_the_mean_is_right() {
    // The variance of 4000 means is known to 2.3 %.
    let equal = variance_ratio(|_, _| 1.0);
    assert!((equal - 1.0).abs() < 0.08, "equal weights: {equal}");
    let signed = variance_ratio(|r, _| if r.unit() < 0.1 { -1.0 } else { 1.0 });
    assert!((signed - 1.0).abs() < 0.1, "negative lobes: {signed}");
    let correlated = variance_ratio(|_, v| 0.5 + v);
    assert!((correlated - 1.0).abs() < 0.08, "weights that follow the value: {correlated}");
}

#[test]
fn films_that_do_not_fit_are_refused() {
    let mut film = Film::new(4, 4, false);
    assert!(matches!(film.merge(&Film::new(4, 5, false)), Err(FilmError::Size { .. })));
    assert_eq!(film.merge(&Film::new(4, 4, true)), Err(FilmError::Variance));
    let foreign: FilmTile = Film::new(9, 9, false).tile([3, 3], [4, 4]);
    let error = film.absorb(&foreign).unwrap_err();
    assert_eq!(error.to_string(), "a tile of 4 x 4 pixels at (3, 3) reaches beyond a film of 4 x 4");
    assert_eq!(film, Film::new(4, 4, false));
    assert_eq!((film.bytes(), Film::new(4, 4, true).bytes()), (16 * 64, 16 * 176));
}
