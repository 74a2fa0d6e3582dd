//! Directions drawn to a lamp, from one point after another and in lanes; one thread.
//!
//! `cargo bench -p sparrow-geometry --bench lights -- [ROUNDS]`. The clock is that of the benchmark of triangles.

#![allow(clippy::print_stdout, reason = "printing is what it is for")]
#![allow(clippy::unwrap_used, reason = "a benchmark stops where something is missing")]

#[cfg(target_os = "linux")]
#[path = "rays/race.rs"]
#[allow(dead_code, reason = "rays are not timed here")]
mod race;
#[cfg(target_os = "linux")]
#[path = "rays/rays.rs"]
#[allow(dead_code, reason = "rays are not timed here")]
mod rays;

#[cfg(not(target_os = "linux"))]
fn main() {
    println!("this benchmark reads a clock that only Linux has");
}

#[cfg(target_os = "linux")]
fn main() {
    let rounds = std::env::args().skip(1).find_map(|a| a.parse().ok()).unwrap_or(21);
    lamps::run(rounds);
}

#[cfg(target_os = "linux")]
mod lamps {
    use core::f32::consts::TAU;

    use sparrow_geometry::{BilinearMesh, Geometry, SampleColumns, Shape, ShapeInstance, Viewpoint};
    use sparrow_math::{Transform, Vec3, vec3};

    use crate::race::{cpu_seconds, median};
    use crate::rays::Rng;

    /// Viewpoints of a batch, as the path tracer asks; and batches of a round.
    const BATCH: usize = 256;
    const REPEATS: usize = 400;

    /// The ceiling lamp of the Cornell box, and a ball in its place.
    fn lamps() -> [(&'static str, Shape); 2] {
        let p = [[-0.3, 0.0, -0.3], [0.3, 0.0, -0.3], [-0.3, 0.0, 0.3], [0.3, 0.0, 0.3]];
        let rectangle =
            BilinearMesh { p: p.to_vec(), indices: vec![[0, 1, 2, 3]], ..BilinearMesh::default() };
        let ball = Shape::Sphere { radius: 0.3, z_min: -0.3, z_max: 0.3, phi_max: TAU };
        [("rectangle", Shape::Patches(rectangle)), ("ball", ball)]
    }

    pub(super) fn run(rounds: usize) {
        let mut rng = Rng(5);
        // On the walls of a room below the lamp.
        let point = |rng: &mut Rng| vec3(rng.next() * 2.0 - 1.0, -2.0 * rng.next(), rng.next() * 2.0 - 1.0);
        let from: Vec<Vec3<f32>> = (0..BATCH).map(|_| point(&mut rng)).collect();
        let normals: Vec<Vec3<f32>> = (0..BATCH).map(|_| point(&mut rng).normalized()).collect();
        let u: Vec<[f32; 2]> = (0..BATCH).map(|_| [rng.next(), rng.next()]).collect();
        let columns =
            |v: &[Vec3<f32>]| [0, 1, 2].map(|c| v.iter().map(|v| v.to_array()[c]).collect::<Vec<_>>());
        let (at, n) = (columns(&from), columns(&normals));
        let pairs = [0, 1].map(|c| u.iter().map(|u| u[c]).collect::<Vec<_>>());
        let mut out = vec![vec![0.0; BATCH]; 11];
        let [px, py, pz, nx, ny, nz, wx, wy, wz, distance, pdf] = &mut out[..] else { unreachable!() };
        let mut many = SampleColumns {
            from: at.each_ref().map(|c| &c[..]),
            n: n.each_ref().map(|c| &c[..]),
            u: pairs.each_ref().map(|c| &c[..]),
            p: [px, py, pz],
            on: [nx, ny, nz],
            wi: [wx, wy, wz],
            distance,
            pdf,
        };
        for (name, shape) in lamps() {
            let placed = ShapeInstance { shape, to_world: Transform::IDENTITY, flip_normal: false };
            let geometry = Geometry::build(vec![placed]);
            let (mut times, mut sum) = ([const { Vec::new() }; 2], 0.0);
            for _ in 0..rounds {
                let mut time = |i: usize, f: &mut dyn FnMut() -> f32| {
                    let start = cpu_seconds();
                    (0..REPEATS).for_each(|_| sum += f());
                    times[i].push(1e9 * (cpu_seconds() - start) / (BATCH * REPEATS) as f64);
                };
                time(0, &mut || {
                    let views = from.iter().zip(&normals).map(|(&p, &n)| Viewpoint { p, n: Some(n) });
                    let drawn = views.zip(&u).filter_map(|(from, &u)| geometry.sample_from(0, 0, from, u));
                    drawn.map(|s| s.pdf).sum()
                });
                time(1, &mut || {
                    geometry.sample_from_many(0, 0, &mut many, BATCH).unwrap();
                    many.pdf.iter().sum()
                });
            }
            let [one, lanes] = times.map(median);
            println!("{name}: {one:.1} ns one by one, {lanes:.1} in lanes ({sum:.3e})");
        }
    }
}
