//! Vertices that chose the same light, brought side by side: [`Chosen`].

use sparrow_geometry::SampleColumns;
use sparrow_math::{InLanes, Real, in_lanes, vec3};
use sparrow_spectra::{N_LAMBDA, Spectrum};

use super::column::{
    BATCH, Column, LANES, Rounded, load, padded, spectrum, store_spectrum, store_vector, vector,
};
use super::lights::parts;
use super::vertices::Vertices;
use crate::scene::Scene;

/// Eight numbers for each vertex of a batch.
type Rows = Vec<[f32; 8]>;

/// Vertices of one light after the other in columns, all of them in rows.
#[derive(Default)]
pub(super) struct Chosen {
    /// Place, shading normal and uniform numbers; wavelengths.
    from: [Rows; 2],
    /// Place and normal on the light, density; direction and radiance.
    found: [Rows; 2],
    /// Vertices of one light; up to whole registers the last.
    which: Vec<u32>,
    /// The bulb that each of these chose, and errors of points on them.
    bulbs: Vec<u32>,
    errors: Box<[Column; 3]>,
    one: Box<One>,
}

/// Vertices of one light, and what is sampled there.
#[derive(Default)]
struct One {
    p: [Column; 3],
    n: [Column; 3],
    u: [Column; 2],
    nm: [Column; N_LAMBDA],
    on: [Column; 3],
    on_n: [Column; 3],
    wi: [Column; 3],
    distance: Column,
    pdf: Column,
    radiance: [Column; N_LAMBDA],
}

impl One {
    /// As geometry and lights take them, `n` of them: wavelengths and radiance apart.
    #[allow(clippy::type_complexity, reason = "three groups of columns")]
    fn columns(&mut self, n: usize) -> (SampleColumns<'_>, [&[f32]; N_LAMBDA], [&mut [f32]; N_LAMBDA]) {
        let columns = columns_of(
            n,
            (&self.p, &self.n, &self.u),
            (&mut self.on, &mut self.on_n, &mut self.wi),
            (&mut self.distance, &mut self.pdf),
        );
        let radiance = self.radiance.each_mut().map(|c| &mut c[..]);
        (columns, self.nm.each_ref().map(|c| &c[..]), radiance)
    }
}

/// Light samples in the columns of a batch.
pub(super) struct Found<'a> {
    pub(super) end: &'a mut Rounded,
    pub(super) wi: &'a mut [Column; 3],
    pub(super) radiance: &'a mut [Column; N_LAMBDA],
    /// Of the choice of the light.
    pub(super) probability: &'a Column,
    /// With that choice; zero where there was none.
    pub(super) pdf: &'a mut Column,
}

impl Chosen {
    /// Takes the vertices of a batch, and uniform numbers for them.
    pub(super) fn take(&mut self, vertices: &Vertices, u: &[Column; 2]) {
        let n = padded(vertices.len());
        for rows in self.from.iter_mut().chain(&mut self.found) {
            rows.resize(rows.len().max(n), [0.0; 8]);
        }
        in_lanes(Take { n, vertices, u, rows: &mut self.from });
    }

    /// Samples the light at those vertices. Returns the errors of the points on it, and 1 where they lie nowhere, else 0.
    pub(super) fn sample(&mut self, scene: &Scene, light: u32, which: &[u32]) -> ([f32; 3], f32) {
        self.bring(which);
        let (mut columns, nm, radiance) = self.one.columns(padded(which.len()));
        let ends =
            scene.lights().sample_many(scene.geometry(), light, &mut columns, which.len(), nm, radiance);
        in_lanes(Keep { which, one: &self.one, rows: &mut self.found });
        parts(ends)
    }

    /// Samples, at the vertices `which`, the bulbs among `lights` that they chose, and writes the errors of points.
    pub(super) fn sample_bulbs(
        &mut self,
        scene: &Scene,
        (lights, which): (&[u32], &[u32]),
        p_error: &mut [Column; 3],
    ) {
        self.bring(which);
        let Chosen { which: padded_which, bulbs, errors, one, found, .. } = self;
        bulbs.clear();
        bulbs.extend(padded_which.iter().map(|k| lights[*k as usize]));
        let (mut columns, nm, radiance) = one.columns(bulbs.len());
        let to = errors.each_mut().map(|c| &mut c[..]);
        scene.lights().sample_bulbs(bulbs, &mut columns, to, bulbs.len(), nm, radiance);
        for (from, to) in errors.iter().zip(p_error) {
            which.iter().zip(&from[..]).for_each(|(k, e)| to[*k as usize % BATCH] = *e);
        }
        in_lanes(Keep { which, one, rows: found });
    }

    /// Brings those vertices side by side.
    fn bring(&mut self, which: &[u32]) {
        self.which.clear();
        self.which.extend_from_slice(which);
        self.which.resize(padded(which.len()), which.last().copied().unwrap_or(0));
        in_lanes(Bring { which: &self.which, rows: &self.from, one: &mut self.one });
    }

    /// Hands over what was sampled at the `n` vertices of the batch.
    pub(super) fn hand_over(&self, n: usize, to: Found<'_>) {
        in_lanes(HandOver { n: padded(n), rows: &self.found, to });
    }
}

/// Columns as the geometry takes them, `n` numbers each.
pub(super) fn columns_of<'a>(
    n: usize,
    (from, normals, u): (&'a [Column; 3], &'a [Column; 3], &'a [Column; 2]),
    (p, on, wi): (&'a mut [Column; 3], &'a mut [Column; 3], &'a mut [Column; 3]),
    (distance, pdf): (&'a mut Column, &'a mut Column),
) -> SampleColumns<'a> {
    SampleColumns {
        from: from.each_ref().map(|c| &c[..n]),
        n: normals.each_ref().map(|c| &c[..n]),
        u: u.each_ref().map(|c| &c[..n]),
        p: p.each_mut().map(|c| &mut c[..n]),
        on: on.each_mut().map(|c| &mut c[..n]),
        wi: wi.each_mut().map(|c| &mut c[..n]),
        distance: &mut distance[..n],
        pdf: &mut pdf[..n],
    }
}

/// From columns of a batch to rows.
struct Take<'a> {
    n: usize,
    vertices: &'a Vertices,
    u: &'a [Column; 2],
    rows: &'a mut [Rows; 2],
}

impl InLanes for Take<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Take { n, vertices, u, rows: [places, colours] } = self;
        for k in (0..n).step_by(R::WIDTH) {
            let (p, ns) = (vector::<R>(&vertices.at.p, k), vector::<R>(&vertices.ns, k));
            let row = [p.x, p.y, p.z, ns.x, ns.y, ns.z, load(&u[0], k), load(&u[1], k)];
            R::scatter_rows(row, &mut places[k..k + R::WIDTH], &LANES);
            let [a, b, c, d] = spectrum::<R>(&vertices.nm, k).0;
            let zero = R::ZERO;
            R::scatter_rows([a, b, c, d, zero, zero, zero, zero], &mut colours[k..k + R::WIDTH], &LANES);
        }
    }
}

/// From rows to the columns of one light.
struct Bring<'a> {
    which: &'a [u32],
    rows: &'a [Rows; 2],
    one: &'a mut One,
}

impl InLanes for Bring<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Bring { which, rows: [places, colours], one } = self;
        for (k, which) in (0..).step_by(R::WIDTH).zip(which.chunks_exact(R::WIDTH)) {
            let [x, y, z, nx, ny, nz, u, v] = R::gather_rows(places, which);
            store_vector(vec3(x, y, z), &mut one.p, k);
            store_vector(vec3(nx, ny, nz), &mut one.n, k);
            u.store(&mut one.u[0][..], k);
            v.store(&mut one.u[1][..], k);
            let [a, b, c, d, ..] = R::gather_rows(colours, which);
            store_spectrum(Spectrum([a, b, c, d]), &mut one.nm, k);
        }
    }
}

/// From the columns of one light to rows.
struct Keep<'a> {
    which: &'a [u32],
    one: &'a One,
    rows: &'a mut [Rows; 2],
}

impl InLanes for Keep<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Keep { which, one, rows: [ends, ways] } = self;
        for (k, which) in (0..).step_by(R::WIDTH).zip(which.chunks(R::WIDTH)) {
            let (on, n) = (vector::<R>(&one.on, k), vector::<R>(&one.on_n, k));
            R::scatter_rows([on.x, on.y, on.z, n.x, n.y, n.z, load(&one.pdf, k), R::ZERO], ends, which);
            let (wi, [a, b, c, d]) = (vector::<R>(&one.wi, k), spectrum::<R>(&one.radiance, k).0);
            R::scatter_rows([wi.x, wi.y, wi.z, a, b, c, d, R::ZERO], ways, which);
        }
    }
}

/// From rows to the columns of a batch.
struct HandOver<'a> {
    n: usize,
    rows: &'a [Rows; 2],
    to: Found<'a>,
}

impl InLanes for HandOver<'_> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let HandOver { n, rows: [ends, ways], to } = self;
        for k in (0..n).step_by(R::WIDTH) {
            let [x, y, z, nx, ny, nz, pdf, _] = R::gather_rows(&ends[k..k + R::WIDTH], &LANES);
            store_vector(vec3(x, y, z), &mut to.end.p, k);
            store_vector(vec3(nx, ny, nz), &mut to.end.n, k);
            let probability = load::<R>(to.probability, k);
            (pdf * probability).only_where(probability.gt(R::ZERO)).store(&mut to.pdf[..], k);
            let [x, y, z, a, b, c, d, _] = R::gather_rows(&ways[k..k + R::WIDTH], &LANES);
            store_vector(vec3(x, y, z), to.wi, k);
            store_spectrum(Spectrum([a, b, c, d]), to.radiance, k);
        }
    }
}
