//! Light that paths found, as the film shows it: [`Colours`].

use sparrow_math::{InLanes, Real, in_lanes};
use sparrow_spectra::{Spectrum, table_index};

use super::column::{BATCH, LANES, padded};
use super::paths::Paths;
use crate::plan::FilmSensor;

/// Colours of the light that paths found.
#[derive(Default)]
pub(super) struct Colours {
    /// Paths; up to whole registers the last.
    which: Vec<u32>,
    /// Red, green and blue, and nothing.
    rgb: Vec<[f32; 8]>,
}

impl Colours {
    /// Hands on each path of `which`, in their order, with the colour of its light in linear RGB.
    pub(super) fn measure<R>(
        &mut self,
        sensor: &FilmSensor,
        paths: &Paths<R>,
        which: &[u32],
        mut give: impl FnMut(usize, f32, f32, f32),
    ) {
        for batch in which.chunks(BATCH) {
            self.which.clear();
            self.which.extend_from_slice(batch);
            self.which.resize(padded(batch.len()), batch[0]);
            self.rgb.resize(BATCH, [0.0; 8]);
            let (colours, give) = (&mut *self, &mut give);
            let (found, carried) = (&paths.found[..], &paths.carried[..]);
            in_lanes(Measure { sensor, n: batch.len(), found, carried, colours, give });
        }
    }
}

struct Measure<'a, G> {
    sensor: &'a FilmSensor,
    /// Paths that are handed on.
    n: usize,
    found: &'a [[f32; 8]],
    carried: &'a [[f32; 8]],
    colours: &'a mut Colours,
    give: &'a mut G,
}

impl<G: FnMut(usize, f32, f32, f32)> InLanes for Measure<'_, G> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Measure { sensor, n, found, carried, colours: Colours { which, rgb }, give } = self;
        for (k, which) in (0..).step_by(R::WIDTH).zip(which.chunks_exact(R::WIDTH)) {
            let [a, b, c, d, p, q, r, s] = R::gather_rows(found, which);
            let [.., nm0, nm1, nm2, nm3] = R::gather_rows(carried, which);
            let index = [table_index(nm0), table_index(nm1), table_index(nm2), table_index(nm3)];
            let [r, g, b] = sensor.rgb_of(Spectrum([a, b, c, d]), Spectrum([p, q, r, s]), index);
            let none = R::ZERO;
            R::scatter_rows([r, g, b, none, none, none, none, none], &mut rgb[k..k + R::WIDTH], &LANES);
        }
        for (&i, &[r, g, b, ..]) in which[..n].iter().zip(&*rgb) {
            give(i as usize, r, g, b);
        }
    }
}
