//! A layer of upright fibres as one lobe: a cosine, linearly transformed, whose albedo is known.
//! [ZeltnerBurleyChiang2022]
//!
//! `f(o, i) cos theta_i = R D(i)` with `D = max(0, v_z) A^2 / (pi |v|^4)`, `v = M^-1 i` and `M^-1 = [[A, 0, B], [0, A, 0],
//! [0, 0, 1]]` in the frame whose x leads towards the viewer. The last row keeps the height: nothing of the lobe falls
//! below the horizon, and the albedo towards the viewer is R exactly. A, B and R depend on the viewer's angle and the
//! fibres' roughness; they are fitted by us to random walks (`layer.rs`), and lie in `table.txt`. The lobe misplaces 4 % of the light,
//! 5 % where each node counts by its share, 16 % at worst, told over 8 by 8 cells.

use core::f64::consts::{FRAC_1_PI, PI};
use std::sync::OnceLock;

use sparrow_math::{LocalDir, Real, vec3};

use crate::table::{Place, interpolate};

#[cfg(test)]
mod layer;

/// The least roughness: fibres that stand straighter send nothing back but along the horizon.
pub(crate) const SMOOTHEST: f64 = 0.1;

/// Nodes along either axis of the table.
const N: usize = 32;

/// A, B and R at every node; rows of one roughness, columns of one angle.
struct Table([[f32; N * N]; 3]);

/// The table as it was written, read once.
///
/// Columns are even in `tan(theta / 2)`, in which R is smooth from the normal to the horizon; rows in the roughness.
fn table() -> &'static Table {
    static TABLE: OnceLock<Table> = OnceLock::new();
    TABLE.get_or_init(|| {
        let mut table = Table([[0.0; N * N]; 3]);
        let lines = include_str!("table.txt").lines().filter(|l| !l.starts_with('#'));
        for (k, line) in lines.take(N * N).enumerate() {
            for (column, word) in table.0.iter_mut().zip(line.split_ascii_whitespace()) {
                column[k] = word.parse().unwrap_or(0.0);
            }
        }
        table
    })
}

/// The layer as one viewer sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fibres<R> {
    a: R,
    b: R,
    /// R: the share of the light that white fibres send back; the rest reaches what lies below.
    pub(crate) share: R,
    /// Cosine and sine of the viewer's azimuth.
    along: [R; 2],
}

impl<R: Real> Fibres<R> {
    /// Seen from `o`, above; `roughness` from [`SMOOTHEST`], nearly along the normal, to 1, without direction.
    #[inline(always)]
    pub(crate) fn new(o: LocalDir<R>, roughness: R) -> Self {
        let sin = o.sin2_theta().sqrt().min(R::ONE);
        let smoothest = R::of(SMOOTHEST);
        let at = [
            Place::unit(N, ((roughness - smoothest) / (R::ONE - smoothest)).clamp(R::ZERO, R::ONE)),
            Place::unit(N, (sin / (R::ONE + o.cos_theta())).min(R::ONE)),
        ];
        let table = table();
        let mut values = [R::ZERO; 3];
        for (value, column) in values.iter_mut().zip(&table.0) {
            *value = interpolate(column, at);
        }
        let slanted = sin.gt(R::of(1e-9));
        let scale = R::ONE / R::select(slanted, sin, R::ONE);
        Fibres {
            a: values[0],
            b: values[1],
            share: values[2],
            along: [R::select(slanted, o.x() * scale, R::ONE), R::select(slanted, o.y() * scale, R::ZERO)],
        }
    }

    /// `D(i) / cos theta_i`; `i` above. [ZeltnerBurleyChiang2022]
    #[inline(always)]
    pub(crate) fn density_over_cos(&self, i: LocalDir<R>) -> R {
        let [c, s] = self.along;
        let (x, y) = (c * i.x() + s * i.y(), c * i.y() - s * i.x());
        let v = vec3(self.a * x + self.b * i.z(), self.a * y, i.z());
        (self.a / v.length2().max(R::of(1e-20))).sqr() * R::of(FRAC_1_PI)
    }

    /// A direction with the density `D`. [ZeltnerBurleyChiang2022]
    #[inline(always)]
    pub(crate) fn draw(&self, u: [R; 2]) -> LocalDir<R> {
        let radius = u[0].sqrt();
        let (sin, cos) = (R::of(2.0 * PI) * u[1]).sin_cos();
        let z = (R::ONE - u[0]).safe_sqrt();
        let (x, y) = (radius * cos - self.b * z, radius * sin);
        let [c, s] = self.along;
        LocalDir::new(vec3(c * x - s * y, s * x + c * y, self.a * z).normalized())
    }
}
