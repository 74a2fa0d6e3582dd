//! What is known of the vertices of a batch: [`Vertices`].

use sparrow_geometry::{Hit, SurfaceColumns, SurfaceParts, SurfacePoint};
use sparrow_models::ModelKind;
use sparrow_spectra::N_LAMBDA;

use super::column::{Column, Rounded, pad, put_spectrum, put_vector, vector};
use super::paths::Paths;
use crate::integrator::{PathIntegrator, Record};
use crate::light::LitPoint;
use crate::material::Material;
use crate::scene::Scene;

/// Vertices of one material, in columns.
#[derive(Default)]
pub(super) struct Vertices {
    /// The path of each.
    pub(super) path: Vec<u32>,
    /// Place and geometric normal.
    pub(super) at: Rounded,
    pub(super) ns: [Column; 3],
    pub(super) tangent: [Column; 3],
    dpdu: [Column; 3],
    dpdv: [Column; 3],
    uv: [Column; 2],
    /// To the viewer.
    pub(super) wo: [Column; 3],
    /// Wavelengths in nm.
    pub(super) nm: [Column; N_LAMBDA],
    /// What the path carries.
    pub(super) beta: [Column; N_LAMBDA],
    pub(super) eta_scale: Column,
    /// Scattering events before.
    pub(super) depth: Column,
    /// Directions that the vertex draws.
    pub(super) ways: Column,
}

fn slices<const N: usize>(columns: &mut [Column; N]) -> [&mut [f32]; N] {
    columns.each_mut().map(|c| &mut c[..])
}

impl Vertices {
    pub(super) fn len(&self) -> usize {
        self.path.len()
    }

    /// Takes the vertices of `paths` numbered `which`, at most a batch, all of that material.
    pub(super) fn gather<R: Record + Default>(
        &mut self,
        scene: &Scene,
        how: &PathIntegrator,
        paths: &mut Paths<'_, R>,
        hits: &[Option<Hit>],
        (material, which): (&Material, &[u32]),
    ) {
        self.path.clear();
        self.path.extend_from_slice(which);
        for (k, &path) in which.iter().enumerate() {
            let i = path as usize;
            if material.dispersive {
                paths.lambda[i].terminate_secondary();
            }
            put_vector(&mut self.wo, k, -paths.ray[i].d);
            self.nm.iter_mut().zip(paths.lambda[i].lambda).for_each(|(column, nm)| column[k] = nm);
            put_spectrum(&mut self.beta, k, paths.beta[i]);
            self.eta_scale[k] = paths.eta_scale[i];
            self.depth[k] = paths.depth[i] as f32;
            self.ways[k] = how.ways_on(paths.depth[i]);
        }
        let fibre = matches!(material.kind, ModelKind::Fibre(_));
        let parts = SurfaceParts { uv: material.textured || fibre, derivatives: material.textured };
        scene.geometry().surface_many(&paths.ray, hits, which, parts, &mut self.surface());
        let n = which.len();
        let vectors = [&mut self.at.p, &mut self.ns, &mut self.tangent, &mut self.wo].into_iter().flatten();
        vectors.chain(&mut self.nm).for_each(|c| pad(c, n));
    }

    fn surface(&mut self) -> SurfaceColumns<'_> {
        let [p, p_error, ng] = [&mut self.at.p, &mut self.at.p_error, &mut self.at.n].map(slices);
        let [ns, tangent] = [&mut self.ns, &mut self.tangent].map(slices);
        let [dpdu, dpdv] = [&mut self.dpdu, &mut self.dpdv].map(slices);
        SurfaceColumns { p, p_error, ng, ns, tangent, dpdu, dpdv, uv: slices(&mut self.uv) }
    }

    /// A vertex as a point of a surface; of texture coordinates and derivatives, only what the material asks for.
    pub(super) fn point(&self, k: usize, hit: &Hit, time: f32) -> SurfacePoint {
        SurfacePoint {
            p: vector(&self.at.p, k),
            p_error: vector(&self.at.p_error, k),
            ng: vector(&self.at.n, k),
            ns: vector(&self.ns, k),
            dpdu: vector(&self.dpdu, k),
            dpdv: vector(&self.dpdv, k),
            uv: [self.uv[0][k], self.uv[1][k]],
            tangent: vector(&self.tangent, k),
            shape: hit.shape,
            prim: hit.prim,
            time,
        }
    }
    /// Their second texture coordinates: across fibres.
    pub(super) fn v(&self) -> &Column {
        &self.uv[1]
    }
    /// A vertex as far as the choice of a light depends on it.
    #[inline(always)]
    pub(super) fn lit_point(&self, k: usize) -> LitPoint {
        LitPoint { p: vector(&self.at.p, k), n: vector(&self.ns, k) }
    }
}
