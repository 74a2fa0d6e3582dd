//! What strands stay outside of: [`Body`].

use core::cmp::Ordering;

use sparrow_math::Vec3;

use crate::{GroomError, Surface};

/// Triangles in a tree of boxes. Inside is told from outside by the side of the nearest triangle, counter-clockwise as seen from
/// outside; where several are equally near, as at a shared edge, by that which most faces the point.
pub(crate) struct Body {
    triangles: Vec<[Vec3<f64>; 3]>,
    nodes: Vec<Node>,
}

/// Bounds of some triangles.
struct Node {
    lo: Vec3<f64>,
    hi: Vec3<f64>,
    below: Below,
}

enum Below {
    /// Two nodes: the next one, and this.
    Nodes(usize),
    /// Triangles from and up to.
    Triangles(usize, usize),
}

/// The triangle nearest to a point.
#[derive(Clone, Copy)]
struct Nearest {
    distance2: f64,
    /// Place on the triangle.
    at: Vec3<f64>,
    /// Unit normal.
    n: Vec3<f64>,
    /// Cosine between `n` and the way from `at` to the point, without its sign.
    facing: f64,
}

const MOST_IN_LEAF: usize = 4;
/// Squared distances that differ by this share are equal but for rounding.
const EQUAL: f64 = 1e-9;

impl Body {
    pub(crate) fn new(surfaces: &[Surface<'_>]) -> Result<Body, GroomError> {
        let mut triangles = Vec::new();
        for surface in surfaces {
            surface.check()?;
            let corners = surface.triangles.iter().map(|&t| surface.corners(t));
            triangles.extend(corners.filter(|&[a, b, c]| (b - a).cross(c - a).length2() > 0.0));
        }
        let mut body = Body { nodes: Vec::with_capacity(2 * triangles.len()), triangles };
        if !body.triangles.is_empty() {
            body.split(0, body.triangles.len());
        }
        Ok(body)
    }

    /// Adds the node of some triangles and all below it; sorts them on the way, by halves along the longest side.
    fn split(&mut self, from: usize, to: usize) {
        let corners = || self.triangles[from..to].iter().flatten();
        let lo = corners().fold(Vec3::splat(f64::INFINITY), |a, &b| a.min(b));
        let hi = corners().fold(Vec3::splat(f64::NEG_INFINITY), |a, &b| a.max(b));
        let node = self.nodes.len();
        self.nodes.push(Node { lo, hi, below: Below::Triangles(from, to) });
        if to - from <= MOST_IN_LEAF {
            return;
        }
        let size = hi - lo;
        let axis = (0..3).max_by(|&i, &j| size[i].total_cmp(&size[j])).unwrap_or(0);
        let middle = |[a, b, c]: &[Vec3<f64>; 3]| a[axis] + b[axis] + c[axis];
        let half = (to - from) / 2;
        let order = |a: &_, b: &_| -> Ordering { middle(a).total_cmp(&middle(b)) };
        self.triangles[from..to].select_nth_unstable_by(half, order);
        self.split(from, from + half);
        self.nodes[node].below = Below::Nodes(self.nodes.len());
        self.split(from + half, to);
    }

    /// Where `p` goes that it stands at least `keep` outside; none where it does already.
    pub(crate) fn pushed_out(&self, p: Vec3<f64>, keep: f64) -> Option<Vec3<f64>> {
        let nearest = self.nearest(p)?;
        let inside = (p - nearest.at).dot(nearest.n) < 0.0;
        (inside || nearest.distance2 < keep * keep).then(|| {
            let away = p - nearest.at;
            // At an edge the way to the point leads out better than a normal, if there is a way.
            let out = if !inside && away.length() > 1e-3 * keep { away.normalized() } else { nearest.n };
            nearest.at + out * keep
        })
    }

    fn nearest(&self, p: Vec3<f64>) -> Option<Nearest> {
        let mut best: Option<Nearest> = None;
        let mut stack = vec![0];
        while let Some(node) = stack.pop().and_then(|i| self.nodes.get(i).map(|n| (i, n))) {
            let (i, Node { lo, hi, below }) = node;
            let away = (*lo - p).max(p - *hi).max(Vec3::splat(0.0));
            if best.is_some_and(|b| away.length2() > b.distance2 * (1.0 + EQUAL)) {
                continue;
            }
            match *below {
                Below::Nodes(second) => {
                    let middle = |i: usize| (self.nodes[i].lo + self.nodes[i].hi) * 0.5;
                    let nearer_first = (middle(i + 1) - p).length2() < (middle(second) - p).length2();
                    stack.extend(if nearer_first { [second, i + 1] } else { [i + 1, second] });
                }
                Below::Triangles(from, to) => {
                    for t in &self.triangles[from..to] {
                        let new = Nearest::of(t, p);
                        if best.is_none_or(|old| new.is_better_than(&old)) {
                            best = Some(new);
                        }
                    }
                }
            }
        }
        best
    }
}

impl Nearest {
    fn of(t: &[Vec3<f64>; 3], p: Vec3<f64>) -> Nearest {
        let [a, b, c] = *t;
        let n = (b - a).cross(c - a).normalized();
        let at = nearest_on(t, n, p);
        let away = p - at;
        let distance2 = away.length2();
        let facing = if distance2 > 0.0 { away.dot(n).abs() / distance2.sqrt() } else { 1.0 };
        Nearest { distance2, at, n, facing }
    }

    fn is_better_than(&self, old: &Nearest) -> bool {
        let equal = (self.distance2 - old.distance2).abs() <= EQUAL * old.distance2;
        if equal { self.facing > old.facing } else { self.distance2 < old.distance2 }
    }
}

/// The place on a triangle with unit normal `n` that is nearest to `p`: below `p` if that is in the triangle, else on a side.
fn nearest_on(&[a, b, c]: &[Vec3<f64>; 3], n: Vec3<f64>, p: Vec3<f64>) -> Vec3<f64> {
    let sides = [(a, b), (b, c), (c, a)];
    if sides.iter().all(|&(from, to)| (to - from).cross(p - from).dot(n) >= 0.0) {
        return p - n * (p - a).dot(n);
    }
    let on_side = |(from, to): (Vec3<f64>, Vec3<f64>)| {
        let side = to - from;
        from + side * ((p - from).dot(side) / side.length2()).clamp(0.0, 1.0)
    };
    let on = sides.map(on_side);
    let distance2 = on.map(|q| (q - p).length2());
    let nearest = (0..3).min_by(|&i, &j| distance2[i].total_cmp(&distance2[j])).unwrap_or(0);
    on[nearest]
}

#[cfg(test)]
mod tests {
    use sparrow_math::vec3;
    use sparrow_stats::Random;

    use super::*;

    /// A cube of half side 1, corner i at the signs of its bits.
    const CUBE: [[u32; 3]; 12] = [
        [0, 4, 6],
        [0, 6, 2],
        [1, 3, 7],
        [1, 7, 5],
        [0, 1, 5],
        [0, 5, 4],
        [2, 6, 7],
        [2, 7, 3],
        [0, 2, 3],
        [0, 3, 1],
        [4, 5, 7],
        [4, 7, 6],
    ];

    fn cube() -> Body {
        let p: [[f32; 3]; 8] = std::array::from_fn(|i| [0, 1, 2].map(|k| 2.0 * ((i >> k) & 1) as f32 - 1.0));
        Body::new(&[Surface { p: &p, triangles: &CUBE, ..Surface::default() }]).unwrap()
    }

    #[test]
    fn points_leave_a_cube_by_its_nearest_face() {
        let body = cube();
        let mut random = Random::new(5);
        let mut n_inside = 0;
        for _ in 0..2000 {
            let p = vec3(random.within(-1.3, 1.3), random.within(-1.3, 1.3), random.within(-1.3, 1.3));
            let depth = 1.0 - p.abs().max_component();
            let outside = (p.abs() - Vec3::splat(1.0)).max(Vec3::splat(0.0)).length();
            let out = body.pushed_out(p, 0.1);
            if depth > 0.0 {
                n_inside += 1;
                let out = out.expect("a point inside is moved");
                assert!((out.abs().max_component() - 1.1).abs() < 1e-9, "{p:?} to {out:?}");
                assert!(((out - p).length() - depth - 0.1).abs() < 1e-9, "{p:?} to {out:?}");
            } else if let Some(out) = out {
                let now = (out.abs() - Vec3::splat(1.0)).max(Vec3::splat(0.0)).length();
                assert!(outside < 0.1 && (now - 0.1).abs() < 1e-9, "{p:?} to {out:?}");
            } else {
                assert!(outside >= 0.1, "{p:?} stays");
            }
        }
        assert!(n_inside > 500);
    }

    #[test]
    fn a_body_of_nothing_moves_nothing() {
        let body = Body::new(&[]).unwrap();
        assert_eq!(body.pushed_out(Vec3::splat(0.0), 1.0), None);
        let bad = Surface { p: &[[0.0; 3]], triangles: &[[0, 0, 7]], ..Surface::default() };
        assert_eq!(Body::new(&[bad]).err(), Some(GroomError::BadFace { face: 0 }));
    }
}
