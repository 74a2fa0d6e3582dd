//! The value of fibres over all directions.

use sparrow_models::FibreKind;

use super::options::Options;
use super::width::Width;
use super::{Figure, page, panel_size, view_of};
use crate::draw::axis::Axis;
use crate::draw::heat::{Grid, Heat, Panel};
use crate::draw::table::Table;
use crate::draw::ticks::pow10;
use crate::series::{Labels, Series, inclined};

/// Cells over the azimuth and over the inclination: one for every two degrees.
const CELLS: [usize; 2] = [180, 90];
/// Rays over the width.
const RAYS: usize = 48;
/// Decades that colours show below the greatest value.
const DECADES: i32 = 4;

pub(super) fn figure(series: &[Series<FibreKind>], o: &Options) -> Figure {
    let mut table = Table::new(["series", "theta_i_deg", "phi_deg", "S cos theta_i [1/sr]"]);
    let labels = Labels::new(series);
    let mut panels = Vec::new();
    for (s, own) in series.iter().zip(&labels.own) {
        let (width, wo) = (Width::new(s, RAYS), s.wo());
        let mut values = Vec::with_capacity(CELLS[0] * CELLS[1]);
        for j in 0..CELLS[1] {
            for i in 0..CELLS[0] {
                let [phi, theta] = [2.0 * i as f64 - 179.0, 2.0 * j as f64 - 89.0];
                let q: f64 = width.lobes(wo, inclined([theta, s.wo_deg[1] + phi])).iter().sum();
                table.named(&s.name(), [theta, phi, q]);
                values.push(q);
            }
        }
        panels.push(Panel { title: own.clone(), grid: Grid { nx: CELLS[0], ny: CELLS[1], values } });
    }
    let values = || panels.iter().flat_map(|p| &p.grid.values).copied().filter(|v| v.is_finite());
    let hi = values().fold(0.0, f64::max);
    let title = "S cos θ_{i}  [1/sr]";
    let colour = if o.log {
        let lo = values().filter(|v| *v > 0.0).fold(hi, f64::min);
        Axis::log(title, lo.max(hi / pow10(DECADES)), hi, 8)
    } else {
        Axis::fixed(title, 0.0, hi, 6)
    };
    let mut about = vec!["all directions of the light".to_owned()];
    about.extend(view_of(series));
    let page = page(series, o, &about, false, panel_size(panels.len()));
    let x = Axis::degrees("azimuth φ_{i} - φ_{o}  [deg]", -180.0, 180.0);
    let y = Axis::degrees("inclination θ_{i}  [deg]", -90.0, 90.0);
    Figure { svg: Heat { page, x, y, colour, panels }.svg(), table }
}
