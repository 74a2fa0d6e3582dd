//! The layer that the lobe stands for, followed fibre by fibre, and the fit of the lobe to it.
//!
//! Fibres of density one fill a layer of thickness one. Seen from `w` they show the area `sigma(w) = sqrt(sin^2 theta + a^2
//! cos^2 theta)`: the microflakes of [Heitz2015] with the squared widths (1, 1, a^2), and they reflect like mirrors
//! that lose nothing. What leaves above is R, what leaves below is the base's. In slopes `(x, y) / z` the lobe is
//! Student's t of two degrees with the centre `-B / A` and the width `1 / A`, so that the likeliest one is found by the
//! iteration of [KentTylerVardi1994].

use core::f64::consts::{PI, TAU};

use sparrow_math::{LocalDir, Real, Vec3, vec3};

use super::{Fibres, N, SMOOTHEST};
use crate::generator::generator;

/// `sigma(w)`
fn sigma(w: Vec3<f64>, a: f64) -> f64 {
    vec3(w.x, w.y, a * w.z).length()
}

/// `v` mirrored at a fibre's face that it sees. [Heitz2015, alg. 1]
fn bounce(v: Vec3<f64>, a: f64, u: [f64; 2]) -> Vec3<f64> {
    let w = vec3(v.x, v.y, a * v.z).normalized();
    let (sin, cos) = Real::sin_cos(TAU * u[0]);
    let side = if w.z.abs() < 0.9 { vec3(0.0, 0.0, 1.0) } else { vec3(1.0, 0.0, 0.0) };
    let s = w.cross(side).normalized();
    let r = u[1].sqrt();
    let n = s * (r * cos) + w.cross(s) * (r * sin) + w * (1.0 - u[1]).max(0.0).sqrt();
    let m = vec3(n.x, n.y, a * n.z).normalized();
    (m * (2.0 * v.dot(m)) - v).normalized()
}

/// What a walk from `mu` is like: slopes with which light leaves above, and R.
struct Walks {
    slopes: Vec<[f64; 2]>,
    share: f64,
}

fn walks(mu: f64, a: f64, n: u32, seed: u64) -> Walks {
    let mut u = generator(seed);
    let a = a.max(1e-3);
    let o = vec3((1.0 - mu * mu).max(0.0).sqrt(), 0.0, mu);
    let depth = sigma(o, a) / mu;
    let met = 1.0 - Real::exp(-depth);
    let mut slopes = Vec::new();
    for k in 0..n {
        // The first fibre is met for certain, at places spread evenly.
        let first = (f64::from(k) + 0.5) / f64::from(n);
        let mut z = (-Real::ln(1.0 - first * met) / depth).min(1.0);
        let mut v = o;
        for _ in 0..10_000 {
            let d = bounce(v, a, [u(), u()]);
            z += Real::ln(u().max(1e-300)) * d.z / sigma(d, a);
            if z < 0.0 {
                slopes.push([d.x / d.z, d.y / d.z]);
            }
            if !(0.0..=1.0).contains(&z) {
                break;
            }
            v = -d;
        }
    }
    let share = met * slopes.len() as f64 / f64::from(n);
    Walks { slopes, share }
}

/// A and B of the likeliest lobe.
fn fit(slopes: &[[f64; 2]]) -> [f64; 2] {
    let (mut centre, mut width2) = (0.0, 1.0);
    for _ in 0..60 {
        let (mut sum, mut x_sum, mut r2_sum) = (0.0, 0.0, 0.0);
        for [x, y] in slopes {
            let r2 = (x - centre).powi(2) + y * y;
            let w = 1.0 / (width2 + r2);
            sum += w;
            x_sum += w * x;
            r2_sum += w * r2;
        }
        centre = x_sum / sum;
        width2 = r2_sum / sum;
    }
    let a = 1.0 / width2.sqrt();
    [a, -centre * a]
}

/// Half the summed difference between the lobe and the walks, over 64 cells that the lobe fills evenly.
fn distance(slopes: &[[f64; 2]], [a, b]: [f64; 2]) -> f64 {
    let mut cells = [0.0; 64];
    for [x, y] in slopes {
        let (x, y) = (a * x + b, a * y);
        let r2 = x * x + y * y;
        let phi = Real::atan2(y, x) + PI;
        let (i, j) = ((8.0 * r2 / (1.0 + r2)) as usize, (8.0 * phi / TAU) as usize);
        cells[i.min(7) * 8 + j.min(7)] += 1.0 / slopes.len() as f64;
    }
    0.5 * cells.iter().map(|c| (c - 1.0 / 64.0).abs()).sum::<f64>()
}

/// The cosine at a column of the table.
fn mu_at(col: usize) -> f64 {
    let t = col as f64 / (N - 1) as f64;
    ((1.0 - t * t) / (1.0 + t * t)).clamp(1e-4, 1.0 - 1e-9)
}

/// Writes `table.txt`, in a minute or two.
///
/// `cargo test --release -p sparrow-models --lib write_the_table -- --ignored --nocapture`
#[test]
#[ignore = "a generator, run by hand when the fit changes"]
#[allow(clippy::print_stdout, reason = "a generator reports to its user")]
fn write_the_table() {
    let mut text = String::from(
        "# A, B and R of a layer of fibres; 32 rows of roughness 0.1 to 1, each of 32 angles even in tan(theta / 2).\n\
         # Written by the test `write_the_table` in layer.rs.\n",
    );
    let (mut sum, mut worst, mut weighted, mut shares) = (0.0, 0.0f64, 0.0, 0.0);
    for row in 0..N {
        for col in 0..N {
            let a = SMOOTHEST + (1.0 - SMOOTHEST) * row as f64 / (N - 1) as f64;
            let few = walks(mu_at(col), a, 1 << 14, 1).share;
            // Where little light comes back more walks are taken, so that the fit has enough to go by.
            let n = 65_536.0 * (0.1 / few.max(1e-3)).clamp(1.0, 16.0);
            let walks = walks(mu_at(col), a, n as u32, (row * N + col) as u64);
            let [a, b] = fit(&walks.slopes);
            text += &format!("{a:.5} {b:.5} {:.5}\n", walks.share);
            let d = distance(&walks.slopes, [a, b]);
            sum += d;
            worst = worst.max(d);
            weighted += d * walks.share;
            shares += walks.share;
        }
    }
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/sheen_layer/table.txt");
    std::fs::write(path, text).expect("the table is written");
    let n = (N * N) as f64;
    println!("distance: mean {}, weighted {}, worst {worst}", sum / n, weighted / shares);
}

#[test]
fn the_table_stands_for_the_layer_between_its_nodes() {
    for (mu, a) in [(0.95, 0.24), (0.7, 0.5), (0.5, 0.9), (0.3, 0.14), (0.12, 0.7), (0.03, 0.33)] {
        let walks = walks(mu, a, 40_000, 77);
        let o = LocalDir::from_angles(Real::acos(mu), 0.0);
        let fibres = Fibres::new(o, a);
        // Four standard errors of 40 000 walks here and 65 536 there, and 0.003 between nodes.
        let want = walks.share;
        assert!((fibres.share - want).abs() < 0.016, "{mu} {a}: {}, walks {want}", fibres.share);
        let (table, best) =
            (distance(&walks.slopes, [fibres.a, fibres.b]), distance(&walks.slopes, fit(&walks.slopes)));
        assert!(table < best + 0.01, "{mu} {a}: {table}, best {best}");
    }
}

#[test]
fn fibres_without_direction_reflect_like_an_even_slab() {
    // Mirror balls scatter evenly. Of diffuse light a slab of optical thickness one lets 0.5532 through.
    // [HeasletWarming1965]
    let n = 40;
    let through: f64 = (0..n)
        .map(|k| {
            let mu = (f64::from(k) + 0.5) / f64::from(n);
            2.0 * mu * (1.0 - walks(mu, 1.0, 10_000, u64::try_from(k).unwrap_or(0)).share) / f64::from(n)
        })
        .sum();
    // Four standard errors of 400 000 walks.
    assert!((through - 0.5532).abs() < 0.003, "{through}");
}
