//! Whole balls, in each lane another one: [`Balls`].

use sparrow_math::{InLanes, Real, in_lanes, vec3};

use super::ball::{Ball, BallOf};
use super::many::{SampleColumns, load, put};

/// Whole balls, by number, to which directions are drawn in lanes that see one each.
#[derive(Clone, Debug, Default)]
pub struct Balls {
    /// Centre, radius, and the sign of the normals: -1 where they point inwards, else 1.
    rows: Vec<[f32; 8]>,
}

impl Balls {
    /// One more, or nothing in its place.
    pub(crate) fn push(&mut self, ball: Option<(&Ball, bool)>) {
        self.rows.push(ball.map_or([0.0; 8], |(ball, flip)| {
            let [x, y, z, radius] = ball.to_array();
            [x, y, z, radius, if flip { -1.0 } else { 1.0 }, 0.0, 0.0, 0.0]
        }));
    }

    /// What [`Geometry::sample_from`](crate::Geometry::sample_from) draws of the ball that `which` names, from each of the first `n`
    /// viewpoints of `columns`, to the bit: where that gives nothing the density is zero. Writes bounds of the rounding errors of the
    /// points to `p_error`.
    ///
    /// Panics where a list is shorter than `n`, rounded up to whole registers, or where a number has no ball.
    pub fn sample_from_many(
        &self,
        which: &[u32],
        columns: &mut SampleColumns<'_>,
        p_error: [&mut [f32]; 3],
        n: usize,
    ) {
        in_lanes(Each { balls: self, which, columns, p_error, n });
    }
}

struct Each<'a, 'b> {
    balls: &'a Balls,
    which: &'a [u32],
    columns: &'a mut SampleColumns<'b>,
    p_error: [&'a mut [f32]; 3],
    n: usize,
}

impl InLanes for Each<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Each { balls, which, columns: c, p_error: [x_error, y_error, z_error], n } = self;
        for k in (0..n).step_by(R::WIDTH) {
            let [x, y, z, radius, side, ..] = R::gather_rows(&balls.rows, &which[k..k + R::WIDTH]);
            let ball = BallOf { center: vec3(x, y, z), radius };
            let view = ball.view(load::<R>(&c.from, k));
            let mut drawn = ball.draw(&view, [R::load(c.u[0], k), R::load(c.u[1], k)]);
            drawn.n = drawn.n * side;
            put(&drawn, c, k);
            let e = ball.p_error();
            e.x.store(x_error, k);
            e.y.store(y_error, k);
            e.z.store(z_error, k);
        }
    }
}
