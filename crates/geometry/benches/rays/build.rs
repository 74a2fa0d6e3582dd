//! Time to build the tree with one thread and with two.

use rayon::{ThreadPool, ThreadPoolBuilder};
use sparrow_geometry::{Geometry, Shape, ShapeInstance, TriangleMesh};
use sparrow_math::Transform;

use crate::race::{cpu_seconds, median};

fn pool(threads: usize) -> ThreadPool {
    ThreadPoolBuilder::new().num_threads(threads).build().unwrap()
}

/// Processor time of the thread that has most to do, in seconds. Other programs do not lengthen it.
fn busiest(pool: &ThreadPool, mesh: &TriangleMesh) -> f64 {
    let shape = Shape::Triangles(mesh.clone());
    let shapes = vec![ShapeInstance { shape, to_world: Transform::IDENTITY, flip_normal: false }];
    let before = pool.broadcast(|_| cpu_seconds());
    pool.install(|| Geometry::build(shapes));
    let after = pool.broadcast(|_| cpu_seconds());
    before.iter().zip(after).map(|(a, b)| b - a).fold(0.0, f64::max)
}

/// Builds in turn on one thread and on two, `rounds` times, and prints medians. Of the gain this is an upper bound: what one
/// thread waits for the other is not seen.
pub(crate) fn run(name: &str, mesh: &TriangleMesh, rounds: usize) {
    let (one, two) = (pool(1), pool(2));
    let mut seconds = [Vec::new(), Vec::new(), Vec::new()];
    for _ in 0..rounds.max(1) {
        let (a, b) = (busiest(&one, mesh), busiest(&two, mesh));
        seconds.iter_mut().zip([a, b, a / b]).for_each(|(v, x)| v.push(x));
    }
    let [one, two, ratio] = seconds.map(median);
    println!("{name}: one thread {one:.3} s, the busier of two {two:.3} s, ratio {ratio:.2}");
}
