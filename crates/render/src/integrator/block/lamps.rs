//! Lights on surfaces that rays met, in columns: [`Lamps`].

use sparrow_geometry::{Hit, PdfColumns, SurfaceParts};
use sparrow_math::{InLanes, Mask, Real, in_lanes, vec3};
use sparrow_mis::Mis;
use sparrow_spectra::{N_LAMBDA, Spectrum};

use super::batch::FEW;
use super::column::{BATCH, Column, load, padded, spectrum, store_spectrum, store_vector, vector};
use super::groups::Groups;
use super::paths::Paths;
use super::vertices::Vertices;
use crate::integrator::{PathIntegrator, Record};
use crate::light::LitPoints;
use crate::scene::Scene;

/// Paths whose rays met lights.
#[derive(Default)]
pub(super) struct Lamps {
    by_light: Groups,
    vertices: Box<Vertices>,
    columns: Box<Columns>,
}

/// What is worked out where rays met one light.
#[derive(Default)]
struct Columns {
    /// The vertex before: its place, its shading normal, and the density of the direction taken there or
    /// [`NO_DENSITY`](super::paths::NO_DENSITY).
    p: [Column; 3],
    n: [Column; 3],
    p_bsdf: Column,
    /// That the light is chosen there, and the density of the direction then.
    probability: Column,
    p_light: Column,
    /// What the light sends; zero to a side that does not shine.
    radiance: [Column; N_LAMBDA],
    weight: Column,
    /// What the path finds; of no meaning where the weight is negative.
    found: [Column; N_LAMBDA],
}

impl Lamps {
    /// Forgets all; lights have numbers below `n_lights`.
    pub(super) fn clear(&mut self, n_lights: usize) {
        self.by_light.clear(n_lights);
    }
    /// The ray of a path met that light.
    #[inline(always)]
    pub(super) fn push(&mut self, light: u32, path: u32) {
        self.by_light.push(light, path);
    }

    /// Adds what these rays found.
    pub(super) fn find<R: Record + Default>(
        &mut self,
        scene: &Scene,
        how: &PathIntegrator,
        paths: &mut Paths<R>,
        hits: &[Option<Hit>],
    ) {
        let Lamps { by_light, vertices, columns } = self;
        for (light, which) in by_light.parts(BATCH) {
            if which.len() < FEW || !scene.lights().samples_in_lanes(scene.geometry(), light) {
                which.iter().for_each(|&i| paths.find(scene, how, i as usize, hits[i as usize].as_ref()));
                continue;
            }
            vertices.take(scene, paths, hits, SurfaceParts::default(), which);
            columns.weigh(scene, how, light, vertices, &paths.behind);
            for (k, i) in which.iter().map(|i| *i as usize).enumerate() {
                let (l, weight) = (spectrum::<f32>(&columns.radiance, k), columns.weight[k]);
                if weight >= 0.0 && !l.is_black() {
                    let by = paths.finder(i);
                    paths.record[i].found(by, spectrum::<f32>(&vertices.beta, k) * l, weight);
                    paths.add(i, spectrum(&columns.found, k));
                }
            }
        }
    }
}

impl Columns {
    /// What one light sends along the rays that met it at these vertices, and its MIS weight.
    fn weigh(
        &mut self,
        scene: &Scene,
        how: &PathIntegrator,
        light: u32,
        vertices: &Vertices,
        behind: &[[f32; 8]],
    ) {
        let (n, lights) = (vertices.len(), scene.lights());
        in_lanes(Before { which: vertices.padded_paths(), behind, columns: self });
        let (from, normals) = (self.p.each_ref().map(|c| &c[..]), self.n.each_ref().map(|c| &c[..]));
        let points = LitPoints { p: from, n: normals, u: &[], n_points: n };
        lights.probability_many(&points, light, &mut self.probability[..]);
        let p = vertices.at.p.each_ref().map(|c| &c[..]);
        let densities = &mut PdfColumns { from, n: normals, p, pdf: &mut self.p_light[..] };
        let (nm, radiance) = (vertices.nm.each_ref().map(|c| &c[..]), &mut self.radiance);
        let radiance = radiance.each_mut().map(|c| &mut c[..]);
        let two_sided = lights.met_many(scene.geometry(), light, densities, n, nm, radiance);
        in_lanes(Weigh { n: padded(n), mis: how.mis, two_sided, vertices, columns: self });
    }
}

/// Takes the vertices before.
struct Before<'a> {
    which: &'a [u32],
    behind: &'a [[f32; 8]],
    columns: &'a mut Columns,
}

impl InLanes for Before<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Before { which, behind, columns } = self;
        for (k, which) in (0..).step_by(R::WIDTH).zip(which.chunks_exact(R::WIDTH)) {
            let [x, y, z, pdf, nx, ny, nz, _] = R::gather_rows(behind, which);
            store_vector(vec3(x, y, z), &mut columns.p, k);
            store_vector(vec3(nx, ny, nz), &mut columns.n, k);
            pdf.store(&mut columns.p_bsdf[..], k);
        }
    }
}

/// Weighs what the light sends, as [`Scene::emitted`] does.
struct Weigh<'a> {
    n: usize,
    mis: Mis,
    two_sided: bool,
    vertices: &'a Vertices,
    columns: &'a mut Columns,
}

impl InLanes for Weigh<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Weigh { n, mis, two_sided, vertices, columns } = self;
        for k in (0..n).step_by(R::WIDTH) {
            let (ng, wo) = (vector::<R>(&vertices.at.n, k), vector::<R>(&vertices.wo, k));
            let shines = R::Mask::of(two_sided) | ng.dot(wo).gt(R::ZERO);
            let l =
                Spectrum::select(shines, spectrum::<R>(&columns.radiance, k), Spectrum([R::ZERO; N_LAMBDA]));
            let p_bsdf = load::<R>(&columns.p_bsdf, k);
            let p_light = load::<R>(&columns.probability, k) * load(&columns.p_light, k);
            let weight = R::select(p_bsdf.lt(R::ZERO), R::ONE, mis.bsdf_weight(p_bsdf, p_light));
            let looks = p_bsdf.lt(R::ZERO) | p_bsdf.gt(R::ZERO);
            store_spectrum(l, &mut columns.radiance, k);
            R::select(looks, weight, -R::ONE).store(&mut columns.weight[..], k);
            store_spectrum(spectrum::<R>(&vertices.beta, k) * (l * weight), &mut columns.found, k);
        }
    }
}
