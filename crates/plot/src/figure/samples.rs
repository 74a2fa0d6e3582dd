//! Sampled directions over the density.

use core::f64::consts::PI;

use sparrow_math::{LocalDir, Real};
use sparrow_models::{Bsdf, Uniforms};
use sparrow_stats::Random;

use super::delta::deltas;
use super::options::Options;
use super::{Figure, page, panel_size, view_of};
use crate::draw::axis::Axis;
use crate::draw::disc::{DiscPanel, Discs, equal_area, from_disc};
use crate::draw::heat::Grid;
use crate::draw::table::Table;
use crate::draw::ticks::{pow10, short};
use crate::series::{Labels, Series};

/// Cells across a disc that is alone; less where there are more of them.
const CELLS: f64 = 128.0;

/// A sample that goes on.
#[derive(Clone, Copy, Debug)]
pub struct Drawn {
    /// Towards the light.
    pub wi: LocalDir<f64>,
    /// Density in 1/sr, or the probability of a delta lobe.
    pub density: f64,
    /// `f |cos theta_i|` over the density, mean over the wavelengths.
    pub weight: f64,
    /// From a delta lobe.
    pub delta: bool,
}

/// `n` samples of a series, less those that end the path. The same seed gives the same samples.
pub fn draw_samples(s: &Series, n: usize, seed: u64) -> Vec<Drawn> {
    let (model, mut random) = (s.model(), Random::named(seed, "samples"));
    let mut draw = || {
        let (lobe, dir) = (random.uniform(), [random.uniform(), random.uniform()]);
        model.sample(s.wo(), Uniforms { lobe, dir })
    };
    let all = (0..n).map(|_| draw()).filter(|s| s.valid);
    all.map(|s| Drawn { wi: s.wi, density: s.density, weight: s.weight.average(), delta: s.delta }).collect()
}

pub(super) fn figure(series: &[Series], o: &Options) -> Figure {
    let labels = Labels::new(series);
    let both = series.iter().any(|s| s.kind.about().transmits);
    let mut table = Table::new(["series", "theta_i_deg", "phi_i_deg", "density [1/sr]", "weight", "delta"]);
    let mut panels = Vec::new();
    for (s, own) in series.iter().zip(&labels.own) {
        let drawn = draw_samples(s, o.samples, o.seed);
        for d in &drawn {
            let [theta, phi] = angles(d.wi);
            let row =
                [theta.to_degrees(), phi.to_degrees(), d.density, d.weight, f64::from(u8::from(d.delta))];
            table.named(&s.name(), row);
        }
        let above = s.wo_deg[0] < 90.0;
        let sides: &[bool] = if both {
            &[true, false]
        } else if above {
            &[true]
        } else {
            &[false]
        };
        let discs = series.len() * sides.len();
        let cells = (CELLS / (discs as f64).sqrt().min(1.8)) as usize;
        for up in sides {
            panels.push(panel(s, own, [*up, both], &drawn, density(s, *up, cells)));
        }
    }
    let all = || panels.iter().flat_map(|p| &p.grid.values).copied().filter(|v| v.is_finite());
    let hi = all().fold(0.0, f64::max);
    let lo = all().filter(|v| *v > 0.0).fold(f64::INFINITY, f64::min);
    let title = "pdf  [1/sr]";
    let colour =
        if o.log { Axis::log(title, lo.max(hi / pow10(4)), hi, 8) } else { Axis::linear(title, 0.0, hi, 6) };
    let mut about = view_of(series);
    about.insert(0, format!("{} samples over their density", o.samples));
    let mut page = page(series, o, &about, false, panel_size(panels.len()));
    page.notes.push("Disc of equal area: equal areas are equal solid angles. Rings: θ_{i} = 30°, 60°, 90°; around: φ_{i}.".to_owned());
    if panels.iter().any(|p| p.marks.iter().any(|m| m.1.starts_with('δ'))) {
        page.notes.push(
            "δ: mirror-like (delta) lobes with their share of the light; samples of them lie under the ring."
                .to_owned(),
        );
    }
    Figure { svg: Discs { page, colour, panels }.svg(), table }
}

/// Polar angle and azimuth in radians.
fn angles(w: LocalDir<f64>) -> [f64; 2] {
    [Real::atan2(w.sin2_theta().sqrt(), w.z()), Real::atan2(w.y(), w.x())]
}

/// Place on the disc, seen from above on both sides; none on the other side.
fn place(w: LocalDir<f64>, up: bool) -> Option<[f64; 2]> {
    let [theta, phi] = angles(w);
    ((w.z() > 0.0) == up).then(|| equal_area(if up { theta } else { PI - theta }, phi))
}

/// The density over the square around a disc.
fn density(s: &Series, up: bool, cells: usize) -> Grid {
    let (model, wo) = (s.model(), s.wo());
    let mut values = Vec::with_capacity(cells * cells);
    for j in 0..cells {
        for i in 0..cells {
            let at = [i, j].map(|k| 2.0 * (k as f64 + 0.5) / cells as f64 - 1.0);
            // Cells that the rim cuts take the value just inside it.
            let r = (at[0] * at[0] + at[1] * at[1]).sqrt();
            let inside = at.map(|x| if r > 0.99 && r < 1.03 { 0.99 * x / r } else { x });
            let value = from_disc(inside).map(|[theta, phi]| {
                let theta = if up { theta } else { PI - theta };
                model.pdf(wo, LocalDir::from_angles(theta, phi))
            });
            values.push(value.unwrap_or(f64::NAN));
        }
    }
    Grid { nx: cells, ny: cells, values }
}

/// One side of one series: its samples and marks, over `grid`.
fn panel(s: &Series, own: &str, [up, both]: [bool; 2], drawn: &[Drawn], grid: Grid) -> DiscPanel {
    let wo = s.wo();
    let mut marks: Vec<([f64; 2], String)> =
        place(wo, up).map(|p| (p, "ω_{o}".to_owned())).into_iter().collect();
    for d in deltas(&s.model(), wo) {
        marks.extend(place(d.wi, up).map(|p| (p, format!("δ {}", short(d.share)))));
    }
    let side = if up { "above the surface" } else { "below the surface" };
    let title = match (own.is_empty(), both) {
        (_, false) => own.to_owned(),
        (true, true) => side.to_owned(),
        (false, true) => format!("{own}, {}", if up { "above" } else { "below" }),
    };
    DiscPanel { title, grid, points: drawn.iter().filter_map(|d| place(d.wi, up)).collect(), marks }
}
