//! Parameters of one material at many points, side by side: [`MaterialColumns`].

use sparrow_models::batch::ParamColumns;
use sparrow_models::{MAX_CHOICES, MAX_REALS, MAX_SPECTRA};
use sparrow_spectra::{N_LAMBDA, Wavelengths};

use super::{Material, RealSource, SpectrumSource, k_of_reflectance};
use crate::integrator::{Column, pad};
use crate::texture::{TextureContext, Textures};

/// What parameters depend on, point by point.
pub(crate) struct Points<'a> {
    /// How many there are.
    pub(crate) n: usize,
    /// Wavelengths of the paths in nm, up to whole registers.
    pub(crate) nm: &'a [Column; N_LAMBDA],
    /// For materials with textures: wavelengths once more, and what textures need.
    pub(crate) lambda: &'a [Wavelengths],
    pub(crate) contexts: &'a [TextureContext],
}

impl RealSource {
    /// Its values at the first `n` points.
    fn fill(&self, textures: &Textures, points: &Points<'_>, n: usize, column: &mut Column) {
        match self {
            RealSource::Constant(v) => column[..n].fill(*v),
            RealSource::AtHero(table) => {
                column.iter_mut().zip(&points.nm[0][..n]).for_each(|(slot, nm)| *slot = table.value(*nm));
            }
            RealSource::Texture(id) => textures.float_many(*id, points.contexts, column),
            RealSource::SqrtOfTexture(id) => {
                textures.float_many(*id, points.contexts, column);
                column[..n].iter_mut().for_each(|v| *v = v.max(0.0).sqrt());
            }
        }
    }
}

impl SpectrumSource {
    /// Its values at the first `n` points.
    fn fill(&self, textures: &Textures, points: &Points<'_>, n: usize, columns: &mut [Column; N_LAMBDA]) {
        let (contexts, lambda) = (points.contexts, points.lambda);
        match self {
            SpectrumSource::Value(s) => {
                let nm = points.nm.each_ref().map(|c| &c[..]);
                s.fill(1.0, nm, n, columns.each_mut().map(|c| &mut c[..]));
            }
            SpectrumSource::Texture(id) => textures.value_many(*id, contexts, lambda, columns),
            SpectrumSource::KOfTexture(id) => {
                textures.value_many(*id, contexts, lambda, columns);
                columns.iter_mut().flat_map(|c| &mut c[..n]).for_each(|v| *v = k_of_reflectance(*v));
            }
        }
    }
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
        let n = points.n;
        self.choices = material.choices;
        let first = |nm: &Column| nm[0].to_bits();
        let differ = |nm: &Column, some: &[f32]| some.iter().fold(0, |d, x| d | (x.to_bits() ^ first(nm)));
        let same = |nm: &Column| nm[..n].chunks(16).all(|some| differ(nm, some) == 0);
        self.n_lambda = if points.nm.iter().all(same) { 1 } else { n };
        self.n_reals = [0; MAX_REALS];
        self.n_spectra = [0; MAX_SPECTRA];
        for ((column, count), source) in self.reals.iter_mut().zip(&mut self.n_reals).zip(&material.reals) {
            *count = if matches!(source, RealSource::Constant(_)) { 1 } else { n };
            source.fill(textures, points, *count, column);
            pad(column, *count);
        }
        let columns = self.spectra.iter_mut().zip(&mut self.n_spectra);
        for ((columns, count), source) in columns.zip(&material.spectra) {
            *count = if source.is_constant() { 1 } else { n };
            source.fill(textures, points, *count, columns);
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
