//! Programs that intersect rays, timed in turn: [`Tracer`], [`race`].

use nix::time::{ClockId, clock_gettime};
use sparrow_geometry::{Geometry, Ray};

/// Something that intersects rays.
pub(crate) trait Tracer {
    /// What the table calls it.
    fn name(&self) -> &str;
    /// Parameter and primitive of the nearest point of each ray; infinite where there is none.
    fn closest(&self, rays: &[Ray], out: &mut [(f32, u32)]);
    /// Something lies on the ray.
    fn occluded(&self, rays: &[Ray], out: &mut [bool]);
}

/// Marks a ray that meets nothing.
pub(crate) const MISS: (f32, u32) = (f32::INFINITY, u32::MAX);

/// Sparrow, one ray at a time.
pub(crate) struct Single<'a>(pub(crate) &'a Geometry);

impl Tracer for Single<'_> {
    fn name(&self) -> &str {
        "sparrow"
    }
    fn closest(&self, rays: &[Ray], out: &mut [(f32, u32)]) {
        for (ray, out) in rays.iter().zip(out) {
            *out = self.0.intersect(ray).map_or(MISS, |h| (h.t, h.prim));
        }
    }
    fn occluded(&self, rays: &[Ray], out: &mut [bool]) {
        for (ray, out) in rays.iter().zip(out) {
            *out = self.0.occluded(ray);
        }
    }
}

/// Sparrow, by lists of rays.
pub(crate) struct Many<'a>(pub(crate) &'a Geometry);

/// Rays of a list.
const LIST: usize = 1024;

impl Tracer for Many<'_> {
    fn name(&self) -> &str {
        "sparrow, lists"
    }
    fn closest(&self, rays: &[Ray], out: &mut [(f32, u32)]) {
        let mut hits = [None; LIST];
        for (rays, out) in rays.chunks(LIST).zip(out.chunks_mut(LIST)) {
            self.0.intersect_many(rays, &mut hits);
            out.iter_mut().zip(&hits).for_each(|(out, h)| *out = h.map_or(MISS, |h| (h.t, h.prim)));
        }
    }
    fn occluded(&self, rays: &[Ray], out: &mut [bool]) {
        for (rays, out) in rays.chunks(LIST).zip(out.chunks_mut(LIST)) {
            self.0.occluded_many(rays, out);
        }
    }
}

/// Processor time of this thread, in seconds.
pub(crate) fn cpu_seconds() -> f64 {
    let t = clock_gettime(ClockId::CLOCK_THREAD_CPUTIME_ID).unwrap();
    t.tv_sec() as f64 + 1e-9 * t.tv_nsec() as f64
}

pub(crate) fn median(mut v: Vec<f64>) -> f64 {
    v.sort_by(f64::total_cmp);
    v[v.len() / 2]
}

/// What is asked of the rays.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Query {
    Closest,
    Any,
}

/// Answers of one tracer.
struct Answers {
    closest: Vec<(f32, u32)>,
    any: Vec<bool>,
}

impl Answers {
    fn ask(&mut self, tracer: &dyn Tracer, rays: &[Ray], query: Query) {
        match query {
            Query::Closest => tracer.closest(rays, &mut self.closest),
            Query::Any => tracer.occluded(rays, &mut self.any),
        }
    }
    fn hit(&self, i: usize, query: Query) -> bool {
        match query {
            Query::Closest => self.closest[i].0.is_finite(),
            Query::Any => self.any[i],
        }
    }
}

/// Asks all tracers in turn, `rounds` times, and prints medians: million rays a second, and the ratio of the first tracer to each
/// other in the same round; and how many answers differ from those of the first.
pub(crate) fn race(label: &str, tracers: &[Box<dyn Tracer + '_>], rays: &[Ray], rounds: usize, query: Query) {
    let mut rates = vec![Vec::new(); tracers.len()];
    let fresh = || Answers { closest: vec![MISS; rays.len()], any: vec![false; rays.len()] };
    let mut answers: Vec<Answers> = tracers.iter().map(|_| fresh()).collect();
    for round in 0..=rounds {
        for (i, tracer) in tracers.iter().enumerate() {
            let start = cpu_seconds();
            answers[i].ask(tracer.as_ref(), rays, query);
            let seconds = cpu_seconds() - start;
            // The first round warms the caches.
            if round > 0 {
                rates[i].push(1e-6 * rays.len() as f64 / seconds);
            }
        }
    }
    let met = (0..rays.len()).filter(|&i| answers[0].hit(i, query)).count();
    println!("  {label}: {} rays, {:.3} of them hit", rays.len(), met as f64 / rays.len() as f64);
    for (i, tracer) in tracers.iter().enumerate() {
        let ratio = median(rates[0].iter().zip(&rates[i]).map(|(a, b)| a / b).collect());
        let differ =
            (0..rays.len()).filter(|&k| answers[0].hit(k, query) != answers[i].hit(k, query)).count();
        let far = |k: &usize| {
            let (a, b) = (answers[0].closest[*k].0, answers[i].closest[*k].0);
            a.is_finite() && b.is_finite() && (a - b).abs() > 1e-4 * b
        };
        let far = (0..rays.len()).filter(far).count();
        let name = tracer.name();
        let rate = median(rates[i].clone());
        println!("    {name:<22} {rate:7.3} Mray/s   sparrow is {ratio:5.3}   differ: hit {differ}, t {far}");
    }
}
