//! Parameters of one material at many points, side by side: [`MaterialColumns`].

use sparrow_models::batch::ParamColumns;
use sparrow_models::{MAX_CHOICES, MAX_REALS, MAX_SPECTRA};
use sparrow_spectra::{N_LAMBDA, Wavelengths};

use super::{Material, RealSource};
use crate::integrator::{Column, pad};
use crate::texture::{TextureContext, Textures};

/// What parameters depend on, point by point.
pub(crate) struct Points<'a> {
    /// Wavelengths of the paths.
    pub(crate) lambda: &'a [Wavelengths],
    /// For materials with textures.
    pub(crate) contexts: &'a [TextureContext],
}

/// One column for each parameter; one number where it is the same at all points.
#[derive(Default)]
pub(crate) struct MaterialColumns {
    reals: [Column; MAX_REALS],
    spectra: [[Column; N_LAMBDA]; MAX_SPECTRA],
    /// Numbers in each column that count: none, one, or one for each point.
    n_reals: [usize; MAX_REALS],
    n_spectra: [usize; MAX_SPECTRA],
    /// The same for wavelengths.
    n_lambda: usize,
    choices: [u8; MAX_CHOICES],
}

impl MaterialColumns {
    /// Evaluates the parameters of a material at all points.
    pub(crate) fn bind(&mut self, material: &Material, textures: &Textures, points: &Points<'_>) {
        let n = points.lambda.len();
        let none = TextureContext::default();
        let context = |k: usize| points.contexts.get(k).unwrap_or(&none);
        self.choices = material.choices;
        let same = |w: &[Wavelengths]| w[0].lambda.map(f32::to_bits) == w[1].lambda.map(f32::to_bits);
        self.n_lambda = if points.lambda.windows(2).all(same) { 1 } else { n };
        self.n_reals = [0; MAX_REALS];
        self.n_spectra = [0; MAX_SPECTRA];
        for ((column, count), source) in self.reals.iter_mut().zip(&mut self.n_reals).zip(&material.reals) {
            *count = if matches!(source, RealSource::Constant(_)) { 1 } else { n };
            for k in 0..*count {
                column[k] = source.at(textures, context(k), &points.lambda[k]);
            }
            pad(column, *count);
        }
        let columns = self.spectra.iter_mut().zip(&mut self.n_spectra);
        for ((columns, count), source) in columns.zip(&material.spectra) {
            *count = if source.is_constant() { 1 } else { n };
            for k in 0..*count {
                let s = source.at(textures, context(k), &points.lambda[k]);
                columns.iter_mut().zip(s.0).for_each(|(column, v)| column[k] = v);
            }
            columns.iter_mut().for_each(|column| pad(column, *count));
        }
    }

    /// As batches of models take them, for the first `n` points; wavelengths and offsets on fibres come from elsewhere.
    pub(crate) fn params<'a>(
        &'a self,
        n: usize,
        lambda: &'a [Column; N_LAMBDA],
        h: &'a Column,
    ) -> ParamColumns<'a> {
        let shown = |count: usize| if count > 1 { n } else { count };
        let mut params = ParamColumns { choices: self.choices, h: &h[..n], ..ParamColumns::default() };
        for ((slot, column), &count) in params.reals.iter_mut().zip(&self.reals).zip(&self.n_reals) {
            *slot = &column[..shown(count)];
        }
        for ((slots, columns), &count) in params.spectra.iter_mut().zip(&self.spectra).zip(&self.n_spectra) {
            slots.iter_mut().zip(columns).for_each(|(slot, column)| *slot = &column[..shown(count)]);
        }
        params
            .lambda
            .iter_mut()
            .zip(lambda)
            .for_each(|(slot, column)| *slot = &column[..shown(self.n_lambda)]);
        params
    }
}
