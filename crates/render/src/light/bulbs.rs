//! Lights on whole balls, sampled in lanes of which each has its own: [`Bulbs`].

use sparrow_geometry::{Balls, Geometry, SampleColumns};
use sparrow_math::{InLanes, Real, in_lanes, vec3};
use sparrow_spectra::{N_LAMBDA, table_index};

use super::Light;
use crate::spectrum::SceneSpectrum;

/// Lights of a scene that may have bulbs among them: each takes 64 bytes.
const MOST: usize = 1 << 16;
/// Tables that may differ: places in all of them together are whole numbers of single precision.
const MOST_TABLES: usize = 1 << 14;

/// Lights on whole balls, by their numbers among all lights.
#[derive(Debug, Default)]
pub(super) struct Bulbs {
    balls: Balls,
    /// 1 where both sides shine, else 0; the factor on the table; where the table begins; 1 for each that is here; four channels.
    rows: Vec<[f32; 8]>,
    /// Emission at whole nanometres, one table after the other; empty where paths carry channels.
    tables: Vec<f32>,
}

impl Bulbs {
    /// Those among `lights`.
    pub(super) fn new(geometry: &Geometry, lights: &[Light], emissions: &[SceneSpectrum]) -> Bulbs {
        let shape_of = |light: &Light| match light {
            Light::Area { shape, .. } if geometry.is_ball(*shape) => Some(*shape),
            Light::Area { .. }
            | Light::Point { .. }
            | Light::Spot { .. }
            | Light::Distant { .. }
            | Light::Uniform { .. }
            | Light::Environment(_) => None,
        };
        let known =
            emissions.iter().all(|e| matches!(e, SceneSpectrum::Channels(_) | SceneSpectrum::Dense(_)));
        if !known || lights.len() > MOST || emissions.len() > MOST_TABLES {
            return Bulbs::default();
        }
        let mut tables = Vec::new();
        let first: Vec<usize> = emissions
            .iter()
            .map(|e| {
                let first = tables.len();
                if let SceneSpectrum::Dense(table) = e {
                    tables.extend_from_slice(table.values());
                }
                first
            })
            .collect();
        let row = |light: &Light| match (shape_of(light), light) {
            (Some(_), Light::Area { emission, scale, two_sided, .. }) => {
                let at = *emission as usize;
                let [a, b, c, d] = match &emissions[at] {
                    SceneSpectrum::Channels(c) => c.0.map(|v| v * scale),
                    SceneSpectrum::Constant(_) | SceneSpectrum::Sigmoid(..) | SceneSpectrum::Dense(_) => {
                        [0.0; 4]
                    }
                };
                [f32::from(u8::from(*two_sided)), *scale, first[at] as f32, 1.0, a, b, c, d]
            }
            _ => [0.0; 8],
        };
        Bulbs {
            balls: geometry.balls(lights.iter().map(shape_of)),
            rows: lights.iter().map(row).collect(),
            tables,
        }
    }

    /// The light is one of them.
    #[inline(always)]
    pub(super) fn has(&self, light: u32) -> bool {
        self.rows.get(light as usize).is_some_and(|row| row[3] > 0.0)
    }

    /// Samples the light that `which` names, from each of the first `n` points of `columns`. All lists are as long as `n`, rounded up to
    /// whole registers.
    pub(super) fn sample_many(
        &self,
        which: &[u32],
        columns: &mut SampleColumns<'_>,
        p_error: [&mut [f32]; 3],
        n: usize,
        nm: [&[f32]; N_LAMBDA],
        radiance: [&mut [f32]; N_LAMBDA],
    ) {
        self.balls.sample_from_many(which, columns, p_error, n);
        in_lanes(Shine { bulbs: self, which, columns, n, nm, radiance });
    }
}

/// What each sends, and to which side.
struct Shine<'a, 'b> {
    bulbs: &'a Bulbs,
    which: &'a [u32],
    columns: &'a mut SampleColumns<'b>,
    n: usize,
    nm: [&'a [f32]; N_LAMBDA],
    radiance: [&'a mut [f32]; N_LAMBDA],
}

impl InLanes for Shine<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Shine { bulbs: Bulbs { rows, tables, .. }, which, columns: c, n, nm, radiance } = self;
        for k in (0..n).step_by(R::WIDTH) {
            let [two_sided, scale, first, _, channels @ ..] = R::gather_rows(rows, &which[k..k + R::WIDTH]);
            let on = vec3(R::load(c.on[0], k), R::load(c.on[1], k), R::load(c.on[2], k));
            let wi = vec3(R::load(c.wi[0], k), R::load(c.wi[1], k), R::load(c.wi[2], k));
            let shines = two_sided.gt(R::ZERO) | on.dot(wi).lt(R::ZERO);
            R::load(c.pdf, k).only_where(shines).store(c.pdf, k);
            for i in 0..N_LAMBDA {
                let l = if tables.is_empty() {
                    channels[i]
                } else {
                    (whole(table_index(R::load(nm[i], k))) + first).look_up(tables) * scale
                };
                l.store(radiance[i], k);
            }
        }
    }
}

/// The whole part of a number that is not negative.
#[inline(always)]
fn whole<R: Real>(x: R) -> R {
    let near = x.round();
    near - R::ONE.only_where(near.gt(x))
}
