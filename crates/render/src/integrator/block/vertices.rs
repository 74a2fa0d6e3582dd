//! What is known of the vertices of a batch: [`Vertices`].

use sparrow_geometry::{Hit, Ray, SurfaceColumns, SurfaceParts, SurfacePoint};
use sparrow_math::{InLanes, Real, in_lanes, vec3};
use sparrow_models::ModelKind;
use sparrow_spectra::{N_LAMBDA, Spectrum};

use super::column::{Column, Rounded, pad, padded, store_spectrum, store_vector, vector};
use super::paths::{Paths, Steps};
use crate::integrator::{PathIntegrator, Record};
use crate::light::LitPoint;
use crate::material::Material;
use crate::scene::Scene;

/// Vertices of one material, in columns.
#[derive(Default)]
pub(super) struct Vertices {
    /// The path of each; up to whole registers that of the last.
    path: Vec<u32>,
    n: usize,
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
    pub(super) time: Column,
}

fn slices<const N: usize>(columns: &mut [Column; N]) -> [&mut [f32]; N] {
    columns.each_mut().map(|c| &mut c[..])
}

impl Vertices {
    pub(super) fn len(&self) -> usize {
        self.n
    }
    /// The path of each.
    pub(super) fn paths(&self) -> &[u32] {
        &self.path[..self.n]
    }
    /// The same up to whole registers, where the last is repeated.
    pub(super) fn padded_paths(&self) -> &[u32] {
        &self.path
    }

    /// Takes the vertices of `paths` numbered `which`, at most a batch, all of that material.
    pub(super) fn gather<R: Record + Default>(
        &mut self,
        scene: &Scene,
        how: &PathIntegrator,
        paths: &mut Paths<R>,
        hits: &[Option<Hit>],
        (material, which): (&Material, &[u32]),
    ) {
        if material.dispersive {
            which.iter().for_each(|&i| paths.terminate_secondary(i as usize));
        }
        for (k, &path) in which.iter().enumerate() {
            let Steps { depth, eta_scale, .. } = paths.steps[path as usize];
            self.eta_scale[k] = eta_scale;
            self.depth[k] = depth as f32;
        }
        if how.splits > 1 {
            let depth = |path: &u32| paths.steps[*path as usize].depth;
            self.ways.iter_mut().zip(which).for_each(|(ways, path)| *ways = how.ways_on(depth(path)));
        } else {
            self.ways[..which.len()].fill(how.ways_on(0));
        }
        let fibre = matches!(material.kind, ModelKind::Fibre(_));
        let parts = SurfaceParts { uv: material.textured || fibre, derivatives: material.textured };
        self.take(scene, paths, hits, parts, which);
    }

    /// Takes where `paths` numbered `which`, at most a batch, met surfaces, and what they bring there.
    pub(super) fn take<R>(
        &mut self,
        scene: &Scene,
        paths: &Paths<R>,
        hits: &[Option<Hit>],
        parts: SurfaceParts,
        which: &[u32],
    ) {
        self.n = which.len();
        self.path.clear();
        self.path.extend_from_slice(which);
        if let Some(&last) = which.last() {
            self.path.resize(padded(which.len()), last);
        }
        in_lanes(Gather { rays: Ray::rows(&paths.ray), carried: &paths.carried, vertices: self });
        scene.geometry().surface_many(&paths.ray, hits, which, parts, &mut self.surface());
        let vectors = [&mut self.at.p, &mut self.ns, &mut self.tangent];
        vectors.into_iter().flatten().for_each(|c| pad(c, which.len()));
    }

    fn surface(&mut self) -> SurfaceColumns<'_> {
        let [p, p_error, ng] = [&mut self.at.p, &mut self.at.p_error, &mut self.at.n].map(slices);
        let [ns, tangent] = [&mut self.ns, &mut self.tangent].map(slices);
        let [dpdu, dpdv] = [&mut self.dpdu, &mut self.dpdv].map(slices);
        SurfaceColumns { p, p_error, ng, ns, tangent, dpdu, dpdv, uv: slices(&mut self.uv) }
    }

    /// A vertex as a point of a surface; of texture coordinates and derivatives, only what the material asks for.
    pub(super) fn point(&self, k: usize, hit: &Hit) -> SurfacePoint {
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
            time: self.time[k],
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

/// Takes what the paths bring to their vertices.
struct Gather<'a> {
    rays: &'a [[f32; 8]],
    carried: &'a [[f32; 8]],
    vertices: &'a mut Vertices,
}

impl InLanes for Gather<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Gather { rays, carried, vertices } = self;
        let Vertices { path, wo, time, beta, nm, .. } = vertices;
        for (k, path) in (0..).step_by(R::WIDTH).zip(path.chunks_exact(R::WIDTH)) {
            let [_, _, _, x, y, z, _, when] = R::gather_rows(rays, path);
            store_vector(-vec3(x, y, z), wo, k);
            when.store(&mut time[..], k);
            let [a, b, c, d, nm0, nm1, nm2, nm3] = R::gather_rows(carried, path);
            store_spectrum(Spectrum([a, b, c, d]), beta, k);
            store_spectrum(Spectrum([nm0, nm1, nm2, nm3]), nm, k);
        }
    }
}
