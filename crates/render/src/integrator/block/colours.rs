//! Light that paths found, as the film shows it: [`Colours`].

use sparrow_math::{InLanes, Real, in_lanes};
use sparrow_spectra::{N_LAMBDA, Spectrum};

use super::column::{BATCH, Column, padded, put_spectrum, spectrum};
use super::paths::Paths;
use crate::plan::FilmSensor;

/// What paths found, at which wavelengths, and the colour of it, in columns.
#[derive(Default)]
pub(super) struct Colours {
    l: [Column; N_LAMBDA],
    pdf: [Column; N_LAMBDA],
    index: [Column; N_LAMBDA],
    rgb: [Column; 3],
}

impl Colours {
    /// Hands on each path of `which`, in their order, with the colour of its light in linear RGB.
    pub(super) fn measure<R>(
        &mut self,
        sensor: &FilmSensor,
        paths: &Paths<'_, R>,
        which: &[u32],
        mut give: impl FnMut(usize, [f32; 3]),
    ) {
        for batch in which.chunks(BATCH) {
            for (k, &i) in batch.iter().enumerate() {
                let (l, w) = (paths.l[i as usize], &paths.lambda[i as usize]);
                put_spectrum(&mut self.l, k, l);
                put_spectrum(&mut self.pdf, k, w.pdf_spectrum());
                put_spectrum(&mut self.index, k, Spectrum(w.index.map(f32::from)));
            }
            in_lanes(Measure { sensor, n: padded(batch.len()), colours: self });
            for (k, &i) in batch.iter().enumerate() {
                give(i as usize, self.rgb.each_ref().map(|c| c[k]));
            }
        }
    }
}

struct Measure<'a> {
    sensor: &'a FilmSensor,
    n: usize,
    colours: &'a mut Colours,
}

impl InLanes for Measure<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Colours { l, pdf, index, rgb } = self.colours;
        for k in (0..self.n).step_by(R::WIDTH) {
            let (l, pdf, index) = (spectrum::<R>(l, k), spectrum(pdf, k), spectrum::<R>(index, k));
            let colour = self.sensor.rgb_of(l, pdf, index.0);
            for (column, c) in rgb.iter_mut().zip(colour) {
                c.store(&mut column[..], k);
            }
        }
    }
}
