//! Values over half and difference angle. [Rusinkiewicz1998]

use sparrow_math::{LocalDir, Real, vec3};

use super::options::Options;
use super::{Figure, column, page, panel_size};
use crate::draw::axis::Axis;
use crate::draw::heat::{Grid, Heat, Panel};
use crate::draw::table::Table;
use crate::draw::ticks::pow10;
use crate::series::{Labels, Series};

/// Cells along each axis: one for every degree.
const CELLS: usize = 90;
/// Cells along each axis that choose the range of colours.
const CALM: usize = 80;
/// Decades that colours show below the greatest value.
const DECADES: i32 = 5;

/// The pair `wo`, `wi` with half vector `[theta_h, phi_h]` and difference `[theta_d, phi_d]`, in radians.
///
/// `wi` is the difference vector turned by `theta_h` about y and by `phi_h` about z; `wo` its mirror image about the half
/// vector. Either may lie below the surface.
pub fn from_half_difference(half: [f64; 2], difference: [f64; 2]) -> [LocalDir<f64>; 2] {
    let d = LocalDir::from_angles(difference[0], difference[1]);
    let (s, c) = Real::sin_cos(half[0]);
    let tilted = vec3(c * d.x() + s * d.z(), d.y(), c * d.z() - s * d.x());
    let (sp, cp) = Real::sin_cos(half[1]);
    let wi = LocalDir::new(vec3(cp * tilted.x - sp * tilted.y, sp * tilted.x + cp * tilted.y, tilted.z));
    let h = LocalDir::from_angles(half[0], half[1]);
    [wi.reflect(h), wi]
}

/// Half and difference angle `[theta_h, theta_d]` of a pair that is not opposite, in radians.
pub fn to_half_difference(wo: LocalDir<f64>, wi: LocalDir<f64>) -> [f64; 2] {
    let h = wo.half(wi);
    [Real::acos(h.z()), Real::acos(wi.dot(h))]
}

pub(super) fn figure(series: &[Series], o: &Options) -> Figure {
    let quantity = o.quantity;
    let views = super::several_views(series);
    let what = format!("{} [1/sr]", quantity.name());
    let names = series.iter().map(|s| column(s, views, &what));
    let heads = ["theta_h_deg".to_owned(), "theta_d_deg".to_owned()];
    let mut table = Table::new(heads.into_iter().chain(names));
    let mut grids = vec![Vec::with_capacity(CELLS * CELLS); series.len()];
    let models: Vec<_> = series.iter().map(Series::model).collect();
    for j in 0..CELLS {
        for i in 0..CELLS {
            let [h, d] = [i as f64 + 0.5, j as f64 + 0.5];
            let at = |(s, m): (&Series, _)| {
                let half = [h.to_radians(), s.wo_deg[1].to_radians()];
                let [wo, wi] = from_half_difference(half, [d.to_radians(), core::f64::consts::FRAC_PI_2]);
                quantity.of(m, wo, wi)
            };
            let values: Vec<f64> = series.iter().zip(&models).map(at).collect();
            grids.iter_mut().zip(&values).for_each(|(g, v)| g.push(*v));
            table.numbers([h, d].into_iter().chain(values));
        }
    }
    let title = format!("{}  [1/sr]", quantity.symbol());
    let colour = colour_axis(&title, &grids, o.log);
    let labels = Labels::new(series);
    let panel = |(grid, own): (Vec<f64>, &String)| Panel {
        title: own.clone(),
        grid: Grid { nx: CELLS, ny: CELLS, values: grid },
    };
    let panels: Vec<Panel> = grids.into_iter().zip(&labels.own).map(panel).collect();
    let mut about = vec!["half and difference angle, φ_{d} = 90°".to_owned()];
    if series[0].kind.about().anisotropic {
        about.push(format!("φ_{{h}} = {}°", series[0].wo_deg[1]));
    }
    let mut page = page(series, o, &about, false, panel_size(panels.len()));
    let mirrors = models.iter().zip(series).any(|(m, s)| !super::deltas(m, s.wo()).is_empty());
    if mirrors {
        page.notes.push(
            "Mirror-like (delta) lobes lie at θ_{h} = 0 and have no value in 1/sr; they are not shown."
                .to_owned(),
        );
    }
    let x = Axis::degrees("half angle θ_{h}  [deg]", 0.0, 90.0);
    let y = Axis::degrees("difference angle θ_{d}  [deg]", 0.0, 90.0);
    Figure { svg: Heat { page, x, y, colour, panels }.svg(), table }
}

/// Logarithmic where it was asked for, or where values span more than a decade and a half.
fn colour_axis(title: &str, grids: &[Vec<f64>], log: bool) -> Axis {
    // Towards grazing some models grow without limit; what exceeds the rest there gets the last colour.
    let calm = |k: usize| k % CELLS < CALM && k / CELLS < CALM;
    let cells = || grids.iter().flat_map(|g| g.iter().copied().enumerate());
    let all = || cells().filter(|(k, v)| calm(*k) && v.is_finite() && *v > 0.0).map(|(_, v)| v);
    let (lo, hi) = (all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
    if hi > 0.0 && (log || hi / lo > 30.0) {
        Axis::log(title, lo.max(hi / pow10(DECADES)), hi, 8)
    } else {
        Axis::linear(title, 0.0, hi, 6)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_survive_the_round_trip() {
        for (h, d, phi) in [(0.2, 0.5, 0.0), (0.7, 0.3, 1.2), (1.1, 0.9, 2.0), (0.0, 0.6, 0.4)] {
            let [wo, wi] = from_half_difference([h, 0.3], [d, phi]);
            let back = to_half_difference(wo, wi);
            assert!((back[0] - h).abs() < 1e-7 && (back[1] - d).abs() < 1e-12, "{h} {d}: {back:?}");
        }
        // With a difference azimuth of 90 degrees neither direction leaves the upper side.
        let [wo, wi] = from_half_difference([1.5, 0.0], [1.5, core::f64::consts::FRAC_PI_2]);
        assert!(wo.z() > 0.0 && wi.z() > 0.0);
    }
}
