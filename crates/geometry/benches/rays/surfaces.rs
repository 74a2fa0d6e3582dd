//! Surface points of hits, one by one and in columns.

use sparrow_geometry::{Geometry, Hit, Ray, SurfaceColumns, SurfaceParts};

use crate::race::{cpu_seconds, median};

/// Rays of a list, and most points of a batch: those of the path tracer.
const LIST: usize = 1024;
const BATCH: usize = 256;

/// Hits of one material in batches, as the path tracer asks for them.
struct Batches<'a> {
    rays: &'a [Ray],
    hits: Vec<Option<Hit>>,
    batches: Vec<Vec<u32>>,
}

impl<'a> Batches<'a> {
    fn new(geometry: &Geometry, rays: &'a [Ray], material: impl Fn(u32) -> u32) -> Batches<'a> {
        let mut hits = vec![None; rays.len()];
        geometry.intersect_many(rays, &mut hits);
        let mut batches = Vec::new();
        for first in (0..rays.len()).step_by(LIST) {
            let list = first..(first + LIST).min(rays.len());
            let of = |i: &usize| hits[*i].map(|h: Hit| material(h.shape));
            let mut met: Vec<usize> = list.filter(|i| of(i).is_some()).collect();
            met.sort_by_key(of);
            let same = met.chunk_by(|a, b| of(a) == of(b)).flat_map(|same| same.chunks(BATCH));
            batches.extend(same.map(|batch| batch.iter().map(|&i| i as u32).collect::<Vec<u32>>()));
        }
        Batches { rays, hits, batches }
    }
    fn one_by_one(&self, geometry: &Geometry) -> f32 {
        let mut sum = 0.0;
        for &i in self.batches.iter().flatten() {
            if let Some(hit) = &self.hits[i as usize] {
                let s = geometry.surface(&self.rays[i as usize], hit);
                sum += s.p.x + s.p_error.x + s.ng.x + s.ns.x + s.tangent.x;
            }
        }
        sum
    }
    fn in_columns(&self, geometry: &Geometry, columns: &mut SurfaceColumns<'_>, parts: SurfaceParts) -> f32 {
        let mut sum = 0.0;
        for batch in &self.batches {
            geometry.surface_many(self.rays, &self.hits, batch, parts, columns);
            sum += columns.p[0][0];
        }
        sum
    }
}

/// Times the surface points of `rays`, where `material` says which shapes are asked for together: ns a point, medians of interleaved
/// rounds.
pub(crate) fn run(
    label: &str,
    geometry: &Geometry,
    rays: &[Ray],
    rounds: usize,
    material: impl Fn(u32) -> u32,
) {
    let batches = Batches::new(geometry, rays, material);
    let n: usize = batches.batches.iter().map(Vec::len).sum();
    let mut room = vec![0.0; 23 * BATCH];
    let mut columns = room.chunks_mut(BATCH);
    let mut next = || columns.next().unwrap();
    let mut columns = SurfaceColumns {
        p: [next(), next(), next()],
        p_error: [next(), next(), next()],
        ng: [next(), next(), next()],
        ns: [next(), next(), next()],
        tangent: [next(), next(), next()],
        dpdu: [next(), next(), next()],
        dpdv: [next(), next(), next()],
        uv: [next(), next()],
    };
    let all = SurfaceParts { uv: true, derivatives: true };
    let (mut times, mut sum) = ([const { Vec::new() }; 3], 0.0);
    for _ in 0..rounds {
        let mut time = |i: usize, f: &mut dyn FnMut() -> f32| {
            let start = cpu_seconds();
            sum += f();
            times[i].push(1e9 * (cpu_seconds() - start) / n as f64);
        };
        time(0, &mut || batches.one_by_one(geometry));
        time(1, &mut || batches.in_columns(geometry, &mut columns, SurfaceParts::default()));
        time(2, &mut || batches.in_columns(geometry, &mut columns, all));
    }
    let [one, few, all] = times.map(median);
    println!(
        "  {label}: {n} points ({sum:.0}): {one:.1} ns one by one, {few:.1} in columns, {all:.1} with all parts"
    );
}
