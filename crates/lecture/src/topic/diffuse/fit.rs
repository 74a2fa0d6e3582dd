//! Slide 7: the distribution of mirrors that comes nearest to a constant value, and how far it stays away.

use core::f64::consts::{FRAC_PI_2, PI};

use sparrow_math::{LocalDir, Real};
use sparrow_plot::draw::axis::Axis;
use sparrow_stats::Random;

use crate::ask::{surface, value};
use crate::chart::{self, Chart, Curve};
use crate::{Check, Figure, Formula, LectureError, Picture, Studio};

/// Bins of alpha, 1 degree each.
const BINS: usize = 90;
/// `bouguer.best_fit` of the reference sheet: relative rms, and `pi D / 4` at 10.5, 30.5 and 50.5 degrees.
const RESIDUAL: f64 = 0.500_173_46;
const HEIGHTS: [(usize, f64); 3] = [(10, 0.486_140_7), (30, 0.370_787_3), (50, 0.202_471_4)];

/// Sums of a bin.
#[derive(Clone, Copy, Default)]
struct Bin {
    /// `sum g t`, with g the response to a unit of D and t the target.
    gt: f64,
    /// `sum g^2`
    gg: f64,
    /// `sum t^2`
    tt: f64,
}

/// A fit of D to a constant value under a masking term: D in each bin, and the relative rms error that is left.
///
/// The error is that of `f cos theta_i cos theta_o` over uniform pairs of directions. Each pair has one half vector, hence one bin: the normal
/// equations are diagonal, every bin has its own solution `sum g t / sum g^2`, and none is negative.
fn fit(words: &str, pairs: u32, seed: u64) -> Result<([f64; BINS], f64), LectureError> {
    // Of uniform D, `f cos cos` is the response to a unit of D.
    let unit = surface(words)?;
    let mut random = Random::named(seed, "fit");
    let mut bins = [Bin::default(); BINS];
    for _ in 0..pairs {
        let mut upper = || {
            let (z, phi) = (random.uniform(), 2.0 * PI * random.uniform());
            LocalDir::from_angles(Real::atan2((1.0 - z * z).max(0.0).sqrt(), z), phi)
        };
        let (i, o) = (upper(), upper());
        let half = (i.v() + o.v()).normalized();
        let alpha = Real::atan2((half.x * half.x + half.y * half.y).sqrt(), half.z);
        let bin = &mut bins[((alpha / FRAC_PI_2 * BINS as f64) as usize).min(BINS - 1)];
        let cosines = i.z() * o.z();
        let (g, t) = (value(&unit, o, i) * cosines, cosines / PI);
        bin.gt += g * t;
        bin.gg += g * g;
        bin.tt += t * t;
    }
    let d = bins.map(|b| if b.gg > 0.0 { (b.gt / b.gg).max(0.0) } else { 0.0 });
    let left: f64 = bins.iter().zip(d).map(|(b, d)| b.tt - 2.0 * d * b.gt + d * d * b.gg).sum();
    Ok((d, (left / bins.iter().map(|b| b.tt).sum::<f64>()).sqrt()))
}

/// Makes the figure.
pub(super) fn make(studio: &Studio<'_>) -> Result<Figure, LectureError> {
    let pairs = studio.pick(1_000_000, 10_000_000);
    // An exponent of zero: D is one everywhere.
    let flat = "torrance_sparrow exponent=0 distribution=unnormalized fresnel=constant";
    let (open, left) = fit(&format!("{flat} masking=none"), pairs, 1)?;
    let (smith, left_smith) = fit(&format!("{flat} masking=smith"), pairs, 2)?;
    let curve = |label: &str, d: &[f64; BINS]| Curve {
        label: label.to_owned(),
        points: d.iter().enumerate().map(|(k, d)| [k as f64 + 0.5, 0.25 * PI * d]).collect(),
    };
    let chart = Chart {
        title: "The least bad distribution".to_owned(),
        subtitle: "fitted to a constant value, in bins of one degree".to_owned(),
        x: Axis::fixed("α  [deg]", 0.0, 90.0, 6),
        y: Axis::linear("π D / 4", 0.0, 0.25 * PI * smith.iter().fold(0.0, |a: f64, d| a.max(*d)), 6),
        curves: vec![curve("S = 1", &open), curve("S of Smith", &smith)],
        rules: Vec::new(),
    };
    let mut checks = vec![
        Check::near("relative rms error that is left, S = 1 (bouguer.best_fit)", left, RESIDUAL, 0.01),
        Check::at_least("relative rms error that is left, S of Smith: not zero", left_smith, 0.05),
    ];
    for (bin, want) in HEIGHTS {
        // Some thousand pairs a bin.
        checks.push(Check::near(format!("π D / 4 at {}.5°", bin), 0.25 * PI * open[bin], want, 0.02));
    }
    Ok(Figure {
        caption: format!(
            "A constant value needs D = (4/π) cos θi cos θo for every pair with the same half vector, and those products differ. The best of all distributions leaves \
             {:.0} % of the target as error without masking, {:.0} % with Smith's. Lambert's law is no microfacet distribution.",
            100.0 * left,
            100.0 * left_smith
        ),
        formulas: vec![Formula::new("D_b = frac{sum_{b} g t}{sum_{b} g^2} , g = frac{G}{4} , t = frac{cos θ_i cos θ_o}{π}", "[Bouguer1760]", "models/src/surface/torrance_sparrow.rs: masking_over_4cos")],
        pictures: vec![Picture::svg("", "The fitted distribution falls from 0.5 at zero to nothing at 90 degrees.", chart.svg())],
        table: Some(chart::table(&[&chart])),
        checks,
        ..Figure::default()
    }
    .with("pairs of directions", pairs)
    .with("error", "of f cos θi cos θo, over uniform pairs"))
}
