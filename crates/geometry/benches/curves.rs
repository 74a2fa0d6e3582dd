//! Rays per second of processor time on curves: a ball of fur, flat and round, and a groom of long curls; one thread.
//!
//! `cargo bench -p sparrow-geometry --bench curves -- [SCENE] [ROUNDS] [RESOLUTION] [SETTINGS] [SPLIT]`, with SCENE one of `round`,
//! `flat`, `curls` or `all`, and SPLIT the depth to which segments are split beforehand. Embree and the clock as in the benchmark
//! of triangles.

#![allow(clippy::print_stdout, reason = "printing is what it is for")]
#![allow(clippy::unwrap_used, reason = "a benchmark stops where something is missing")]

#[cfg(all(target_os = "linux", feature = "embree"))]
#[path = "rays/embree.rs"]
mod embree;
#[cfg(target_os = "linux")]
#[path = "rays/race.rs"]
#[allow(dead_code, reason = "lists of rays are not timed here")]
mod race;
#[cfg(target_os = "linux")]
#[allow(dead_code, reason = "bounces of triangles are not wanted here")]
#[path = "rays/rays.rs"]
mod rays;

#[cfg(not(target_os = "linux"))]
fn main() {
    println!("this benchmark reads a clock that only Linux has");
}

#[cfg(target_os = "linux")]
fn main() {
    let args: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let what = args.first().map_or("all", String::as_str);
    let number = |i: usize, default: usize| args.get(i).and_then(|s| s.parse().ok()).unwrap_or(default);
    let settings = fur::Settings {
        rounds: number(1, 7),
        resolution: number(2, 320),
        embree: number(3, 2),
        split_depth: number(4, 0) as u8,
    };
    let wanted = |name: &str| what == "all" || what == name;
    // Trees are built by this thread, whose clock is read.
    rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build_global().unwrap();
    if wanted("round") {
        settings.run("fur, round", fur::ball(25_000, 0.45, 0.0025), true);
    }
    if wanted("flat") {
        settings.run("fur, flat", fur::ball(25_000, 0.45, 0.0025), false);
    }
    if wanted("curls") {
        settings.run("curls, round", fur::curls(400, 50), true);
        settings.run("curls, flat", fur::curls(400, 50), false);
    }
}

/// Strands made by formulas, and rays at them.
#[cfg(target_os = "linux")]
mod fur {
    use core::f32::consts::TAU;

    use sparrow_geometry::{CurveBasis, CurveKind, CurveSet, Geometry, Ray, Shape, ShapeInstance};
    use sparrow_math::{Frame, Real, Transform, Vec3, vec3};

    use crate::race::{Query, Single, Tracer, cpu_seconds, race};
    use crate::rays::{Rng, camera};

    /// B-spline strands: points with radii, and how many belong to a strand.
    pub(crate) struct Strands {
        points: Vec<[f32; 4]>,
        length: usize,
    }

    /// Short fur on a ball of radius 1: `n` strands of 4 segments that curl, hang and taper.
    pub(crate) fn ball(n: usize, length: f32, radius: f32) -> Strands {
        let mut rng = Rng(7);
        let mut points = Vec::with_capacity(7 * n);
        for _ in 0..n {
            let n = rng.sphere();
            let frame = Frame::from_z(n);
            let l = length * (0.6 + 0.8 * rng.next());
            let (phase, curl) = (TAU * rng.next(), 0.02 + 0.05 * rng.next());
            let lean =
                |k: f32| Real::sin(3.0 * n.x + k) * Real::sin(3.0 * n.y + 2.0 * k) * Real::sin(3.0 * n.z - k);
            let bend = vec3(lean(0.3), lean(1.7) - 0.7, lean(4.1)) + rng.sphere() * 0.15;
            let bend = bend.normalized();
            for k in 0..7 {
                let u = (k as f32 - 1.0) / 4.0;
                let v = u.max(0.0);
                let (s, c) = Real::sin_cos(phase + 7.0 * u);
                let p = n * (1.0 + l * u * (1.0 - 0.35 * v))
                    + bend * (0.5 * l * v * v)
                    + frame.x * (curl * c * u)
                    + frame.y * (curl * s * u);
                points.push([p.x, p.y, p.z, radius * (1.0 - 0.75 * u.clamp(0.0, 1.0))]);
            }
        }
        Strands { points, length: 7 }
    }

    /// Long curls that hang from a cap: `clumps` of `members` strands of 60 segments.
    pub(crate) fn curls(clumps: usize, members: usize) -> Strands {
        const POINTS: usize = 63;
        let mut rng = Rng(8);
        let mut points = Vec::with_capacity(POINTS * clumps * members);
        for _ in 0..clumps {
            let mut root = rng.sphere();
            root.y = root.y.abs();
            let (phase, turns, wide) = (TAU * rng.next(), 5.0 + 4.0 * rng.next(), 0.03 + 0.03 * rng.next());
            let length = 1.2 + 0.8 * rng.next();
            for _ in 0..members {
                let own = rng.sphere() * 0.05;
                let (lag, loose) = (0.5 * rng.next(), 0.8 + 0.4 * rng.next());
                for k in 0..POINTS {
                    let u = k as f32 / (POINTS - 1) as f32;
                    let out = vec3(root.x, 0.0, root.z) * (0.4 * length * u * (1.0 - 0.6 * u));
                    let hang = vec3(0.0, -length * u * u, 0.0);
                    let (s, c) = Real::sin_cos(phase + lag + TAU * turns * u);
                    let helix = vec3(c, 0.3 * s, s) * (wide * loose * u.min(0.2) * 5.0);
                    // Members close up towards the tip.
                    let p = root + out + hang + helix + own * (1.0 - 0.8 * u);
                    points.push([p.x, p.y, p.z, 0.0012 * (1.0 - 0.7 * u)]);
                }
            }
        }
        Strands { points, length: POINTS }
    }

    pub(crate) struct Settings {
        pub(crate) rounds: usize,
        pub(crate) resolution: usize,
        pub(crate) embree: usize,
        pub(crate) split_depth: u8,
    }

    impl Settings {
        pub(crate) fn run(&self, name: &str, strands: Strands, round: bool) {
            let n_strands = strands.points.len() / strands.length;
            let first = |i: usize| (i * strands.length) as u32;
            let curves = CurveSet {
                points: strands.points.clone(),
                strands: (0..n_strands).map(first).collect(),
                basis: CurveBasis::BSpline,
                kind: if round { CurveKind::Round } else { CurveKind::Flat },
                split_depth: self.split_depth,
                ..CurveSet::default()
            };
            println!("{name}: {} segments", n_strands * (strands.length - 3));
            let shape = Shape::Curves(curves);
            let start = cpu_seconds();
            let geometry = Geometry::build(vec![ShapeInstance {
                shape,
                to_world: Transform::IDENTITY,
                flip_normal: false,
            }]);
            let (seconds, stats) = (cpu_seconds() - start, geometry.stats());
            let megabytes = 1e-6 * stats.bytes.total() as f64;
            println!("  built in {seconds:.3} s: {} nodes, {megabytes:.1} MB with the points", stats.nodes);
            #[cfg_attr(
                not(feature = "embree"),
                allow(unused_mut, reason = "Embree is added where it is there")
            )]
            let mut tracers: Vec<Box<dyn Tracer + '_>> = vec![Box::new(Single(&geometry))];
            #[cfg(feature = "embree")]
            {
                let of_strand =
                    |i: usize| (0..strands.length - 3).map(move |k| (i * strands.length + k) as u32);
                let segments: Vec<u32> = (0..n_strands).flat_map(of_strand).collect();
                for tracer in crate::embree::curves(&strands.points, &segments, round, self.embree) {
                    tracers.push(Box::new(tracer));
                }
            }
            #[cfg(not(feature = "embree"))]
            let _ = self.embree;
            let camera = camera(vec3(0.0, 1.0, 4.0), Vec3::splat(0.0), 45.0, self.resolution);
            let mut rng = Rng(3);
            let first = scattered(&geometry, &camera, &mut rng, |rng| rng.sphere());
            let mut second = scattered(&geometry, &first, &mut rng, |rng| rng.sphere());
            shuffle(&mut second, &mut rng);
            let sun = |rng: &mut Rng| (rng.sphere() * 0.3 + vec3(0.5, 1.0, 0.6)).normalized();
            let mut shadow = scattered(&geometry, &camera, &mut rng, sun);
            shadow.extend(scattered(&geometry, &first, &mut rng, sun));
            race("camera", &tracers, &camera, self.rounds, Query::Closest);
            race("scatter", &tracers, &first, self.rounds, Query::Closest);
            race("second scatter, shuffled", &tracers, &second, self.rounds, Query::Closest);
            race("shadow, any hit", &tracers, &shadow, self.rounds, Query::Any);
        }
    }

    fn shuffle(rays: &mut [Ray], rng: &mut Rng) {
        for i in (1..rays.len()).rev() {
            rays.swap(i, (rng.next() * (i + 1) as f32) as usize);
        }
    }

    /// Rays from where others end, beyond the fibre that they met.
    fn scattered(
        geometry: &Geometry,
        rays: &[Ray],
        rng: &mut Rng,
        direction: impl Fn(&mut Rng) -> Vec3<f32>,
    ) -> Vec<Ray> {
        let hits = rays.iter().filter_map(|ray| Some(ray.at(geometry.intersect(ray)?.t)));
        let start = |p: Vec3<f32>| {
            let d = direction(rng);
            Ray::new(p + d * 0.006, d)
        };
        hits.map(start).collect()
    }
}
