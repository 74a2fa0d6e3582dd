//! Motion between two places: [`Motion`].

use crate::bounds::Aabb;
use crate::real::Real;
use crate::transform::Transform;
use crate::vec3::{Vec3, vec3};

type M3 = [[f64; 3]; 3];

/// An affine map that changes from a start at time 0 to an end at time 1.
///
/// Each end is a stretch, then a rotation, then a translation. Stretch and translation change evenly with time, the rotation turns evenly
/// the shorter way round. [ShoemakeDuff1992], [Shoemake1985]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    translation: [Vec3<f64>; 2],
    /// Unit quaternions (w, x, y, z) not more than a right angle apart.
    rotation: [[f64; 4]; 2],
    stretch: [M3; 2],
    /// Half the angle turned, in radians.
    half_turn: f64,
}

/// Rounds of the iteration that finds the rotation: it converges quadratically once it is near.
const MAX_ROUNDS: u32 = 100;
/// Angle turned within one of the steps that boxes are made of, in radians.
const STEP: f64 = 0.1;
/// Below this many radians sines are their angles, to double precision.
const SMALL: f64 = 1e-8;

impl Motion {
    /// From the affine parts of two places; `None` where one of them mirrors and the other does not, so that something in between is flat.
    pub fn new(start: &Transform, end: &Transform) -> Option<Motion> {
        if start.swaps_handedness() != end.swaps_handedness() {
            return None;
        }
        let translation = [start, end].map(|t| t.point(vec3(0.0, 0.0, 0.0)));
        let [(r0, s0), (r1, s1)] = [start, end].map(decomposed);
        let (q0, q1) = (quaternion(&r0), quaternion(&r1));
        let dot: f64 = q0.iter().zip(&q1).map(|(a, b)| a * b).sum();
        let q1 = q1.map(|x| if dot < 0.0 { -x } else { x });
        // The angle from the sum and the difference keeps its digits everywhere.
        let length = |sign: f64| q0.iter().zip(&q1).map(|(a, b)| (b + sign * a).sqr()).sum::<f64>().sqrt();
        let half_turn = 2.0 * Real::atan2(length(-1.0), length(1.0));
        Some(Motion { translation, rotation: [q0, q1], stretch: [s0, s1], half_turn })
    }

    /// Rows of the map at `time` in [0, 1], the translation in the fourth column.
    pub fn at(&self, time: f64) -> [[f64; 4]; 3] {
        let between = |a: f64, b: f64| a + (b - a) * time;
        let r = matrix(&self.rotation_at(time));
        let [t0, t1] = self.translation.map(|t| [t.x, t.y, t.z]);
        let stretch = |i: usize, j: usize| between(self.stretch[0][i][j], self.stretch[1][i][j]);
        core::array::from_fn(|i| {
            let entry = |j: usize| (0..3).map(|k| r[i][k] * stretch(k, j)).sum();
            [entry(0), entry(1), entry(2), between(t0[i], t1[i])]
        })
    }

    /// A box around all that the points of `b` pass.
    ///
    /// Points that do not turn go straight. Those that do stray from the chord of a step of length h by h^2 / 8 times their
    /// acceleration, which is not above `w^2 |S p| + 2 w |S' p|` with the speed `w` of the rotation and the stretch `S`.
    pub fn bounds(&self, b: &Aabb) -> Aabb {
        let corners: [Vec3<f64>; 8] = core::array::from_fn(|i| {
            let pick = |axis: usize| f64::from(if i >> axis & 1 == 0 { b.lo[axis] } else { b.hi[axis] });
            vec3(pick(0), pick(1), pick(2))
        });
        let w = 2.0 * self.half_turn;
        let steps = (w / STEP).ceil().max(1.0);
        let rows = |m: &M3, p: Vec3<f64>| {
            let row = |r: &[f64; 3]| r[0] * p.x + r[1] * p.y + r[2] * p.z;
            vec3(row(&m[0]), row(&m[1]), row(&m[2]))
        };
        let [s0, s1] = &self.stretch;
        let acceleration = |&p: &Vec3<f64>| {
            let (a, b) = (rows(s0, p), rows(s1, p));
            w * w * a.length().max(b.length()) + 2.0 * w * (b - a).length()
        };
        let stray = corners.iter().map(acceleration).fold(0.0, f64::max) / (8.0 * steps * steps);
        let mut around = Aabb::EMPTY;
        for step in 0..=steps as u32 {
            let m = self.at(f64::from(step) / steps);
            for p in corners {
                let coordinate = |r: &[f64; 4]| r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3];
                let p = vec3(coordinate(&m[0]), coordinate(&m[1]), coordinate(&m[2]));
                around =
                    around.grow((p - Vec3::splat(stray)).to_f32()).grow((p + Vec3::splat(stray)).to_f32());
            }
        }
        around
    }

    fn rotation_at(&self, time: f64) -> [f64; 4] {
        let [a, b] = &self.rotation;
        let sin = Real::sin(self.half_turn);
        let (u, v) = if self.half_turn > SMALL {
            (Real::sin((1.0 - time) * self.half_turn) / sin, Real::sin(time * self.half_turn) / sin)
        } else {
            (1.0 - time, time)
        };
        core::array::from_fn(|i| u * a[i] + v * b[i])
    }
}

/// Rotation and stretch whose product is the linear part of `t`: the rotation nearest to it, and a symmetric matrix. [ShoemakeDuff1992]
///
/// Of a map that mirrors, the stretch does.
fn decomposed(t: &Transform) -> (M3, M3) {
    let rows = t.rows();
    let m: M3 = core::array::from_fn(|i| core::array::from_fn(|j| rows[i][j]));
    let mut r = m;
    for _ in 0..MAX_ROUNDS {
        let cofactors = cofactors(&r);
        let determinant: f64 = (0..3).map(|j| r[0][j] * cofactors[0][j]).sum();
        let next: M3 = core::array::from_fn(|i| {
            core::array::from_fn(|j| 0.5 * (r[i][j] + cofactors[i][j] / determinant))
        });
        let change = (0..9).map(|k| (next[k / 3][k % 3] - r[k / 3][k % 3]).abs()).fold(0.0, f64::max);
        r = next;
        if change < 1e-15 {
            break;
        }
    }
    if t.swaps_handedness() {
        r = r.map(|row| row.map(|x| -x));
    }
    let stretch = |i: usize, j: usize| (0..3).map(|k| r[k][i] * m[k][j]).sum::<f64>();
    (r, core::array::from_fn(|i| core::array::from_fn(|j| 0.5 * (stretch(i, j) + stretch(j, i)))))
}

/// The inverse transpose, times the determinant.
fn cofactors(m: &M3) -> M3 {
    let entry = |i: usize, j: usize| m[i % 3][j % 3];
    let cofactor =
        |i, j| entry(i + 1, j + 1) * entry(i + 2, j + 2) - entry(i + 1, j + 2) * entry(i + 2, j + 1);
    core::array::from_fn(|i| core::array::from_fn(|j| cofactor(i, j)))
}

/// A rotation matrix as a unit quaternion. [Shoemake1985]
fn quaternion(m: &M3) -> [f64; 4] {
    let trace = m[0][0] + m[1][1] + m[2][2];
    // The largest of the four is found first, so that nothing is divided by a small number.
    let squares = [trace, 2.0 * m[0][0] - trace, 2.0 * m[1][1] - trace, 2.0 * m[2][2] - trace];
    let largest = (1..4).fold(0, |best, i| if squares[i] > squares[best] { i } else { best });
    let twice = (1.0 + squares[largest]).safe_sqrt();
    let mut q = [0.0; 4];
    q[largest] = 0.5 * twice;
    let rest = 0.5 / twice;
    if largest == 0 {
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            q[i + 1] = (m[k][j] - m[j][k]) * rest;
        }
    } else {
        let i = largest - 1;
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        q[0] = (m[k][j] - m[j][k]) * rest;
        q[j + 1] = (m[j][i] + m[i][j]) * rest;
        q[k + 1] = (m[k][i] + m[i][k]) * rest;
    }
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    q.map(|x| x / length)
}

/// The rotation matrix of a unit quaternion. [Shoemake1985]
fn matrix(&[w, x, y, z]: &[f64; 4]) -> M3 {
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(k: u32, mirrored: bool) -> Transform {
        let k = f64::from(k);
        let turn = Transform::rotate(37.0 * k, vec3(Real::sin(k), 0.3, 1.0 - 0.1 * k)).unwrap();
        let stretch =
            Transform::scale(vec3(0.5 + 0.2 * k, if mirrored { -1.5 } else { 1.5 }, 3.0 - 0.1 * k)).unwrap();
        let skewed =
            turn.then_first(&stretch).then_first(&Transform::rotate(20.0, vec3(1.0, 1.0, 0.0)).unwrap());
        Transform::translate(vec3(k, -2.0 * k, 100.0)).then_first(&skewed)
    }

    fn far(a: &[[f64; 4]; 3], t: &Transform) -> f64 {
        let entries = a.iter().flatten().zip(t.rows().iter().flatten());
        entries.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn motion_begins_and_ends_where_it_should() {
        for k in 0..9 {
            for mirrored in [false, true] {
                let (a, b) = (place(k, mirrored), place(k + 3, mirrored));
                let motion = Motion::new(&a, &b).unwrap();
                assert!(
                    far(&motion.at(0.0), &a) < 1e-12 && far(&motion.at(1.0), &b) < 1e-12,
                    "{k} {mirrored}"
                );
            }
        }
        assert!(Motion::new(&place(1, false), &place(1, true)).is_none());
    }

    #[test]
    fn a_turn_goes_evenly_and_the_shorter_way() {
        let turned = |degrees: f64| Transform::rotate(degrees, vec3(0.0, 0.6, 0.8)).unwrap();
        for (end, half) in [(90.0, 45.0), (200.0, -80.0), (1e-5, 0.5e-5), (0.0, 0.0)] {
            let motion = Motion::new(&Transform::IDENTITY, &turned(end)).unwrap();
            assert!(far(&motion.at(0.5), &turned(half)) < 1e-14, "{end}");
        }
        // Half a turn has no shorter way; it goes round one of both.
        let half = Motion::new(&Transform::IDENTITY, &turned(180.0)).unwrap().at(0.5);
        assert!(far(&half, &turned(90.0)).min(far(&half, &turned(-90.0))) < 1e-7);
    }

    #[test]
    fn nothing_leaves_the_bounds() {
        let b = Aabb { lo: vec3(-1.0, -0.5, 0.0), hi: vec3(1.0, 2.0, 0.5) };
        for k in 0..8 {
            let motion = Motion::new(&place(k, false), &place(k + 4, false)).unwrap();
            let around = motion.bounds(&b);
            let (mut reached, size) = (Aabb::EMPTY, around.extent());
            for i in 0..=200 {
                let m = motion.at(f64::from(i) / 200.0);
                for corner in 0..8 {
                    let p =
                        [0, 1, 2].map(|a| f64::from(if corner >> a & 1 == 0 { b.lo[a] } else { b.hi[a] }));
                    let q = [0, 1, 2].map(|r| m[r][0] * p[0] + m[r][1] * p[1] + m[r][2] * p[2] + m[r][3]);
                    reached = reached.grow(vec3(q[0], q[1], q[2]).to_f32());
                }
            }
            assert!(around.union(reached) == around, "{k}");
            // The box is not much larger than it has to be.
            let spare = size - reached.extent();
            assert!(
                spare.x < 0.02 * size.x && spare.y < 0.02 * size.y && spare.z < 0.02 * size.z,
                "{k}: {spare:?}"
            );
        }
    }
}
