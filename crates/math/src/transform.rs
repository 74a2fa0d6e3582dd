//! Affine and projective maps in double precision: [`Transform`].

use crate::real::Real;
use crate::vec3::{Vec3, vec3};

type M4 = [[f64; 4]; 4];

const IDENTITY: M4 = [[1., 0., 0., 0.], [0., 1., 0., 0.], [0., 0., 1., 0.], [0., 0., 0., 1.]];

/// A 4x4 matrix with its inverse. Column vectors: `m[row][column]`, the translation stands in column 3.
///
/// Double precision, because scene files stack many of them; the result is rounded once, when points are mapped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    m: M4,
    inv: M4,
}

impl Default for Transform {
    fn default() -> Self {
        Transform::IDENTITY
    }
}

fn mul(a: &M4, b: &M4) -> M4 {
    let mut r = [[0.0; 4]; 4];
    for (row, out) in a.iter().zip(&mut r) {
        for (j, o) in out.iter_mut().enumerate() {
            *o = (0..4).map(|k| row[k] * b[k][j]).sum();
        }
    }
    r
}

fn transpose(a: &M4) -> M4 {
    core::array::from_fn(|i| core::array::from_fn(|j| a[j][i]))
}

/// Gauss-Jordan elimination with row pivots; `None` for a singular or non-finite matrix.
fn invert(a: &M4) -> Option<M4> {
    let (mut m, mut r) = (*a, IDENTITY);
    for c in 0..4 {
        let p = (c..4).max_by(|&i, &j| m[i][c].abs().total_cmp(&m[j][c].abs()))?;
        let pivot = m[p][c];
        if pivot == 0.0 || !pivot.is_finite() {
            return None;
        }
        m.swap(c, p);
        r.swap(c, p);
        for j in 0..4 {
            m[c][j] /= pivot;
            r[c][j] /= pivot;
        }
        for i in (0..4).filter(|&i| i != c) {
            let f = m[i][c];
            for j in 0..4 {
                m[i][j] -= f * m[c][j];
                r[i][j] -= f * r[c][j];
            }
        }
    }
    r.iter().flatten().all(|v| v.is_finite()).then_some(r)
}

impl Transform {
    /// Leaves everything where it is.
    pub const IDENTITY: Transform = Transform { m: IDENTITY, inv: IDENTITY };

    /// From a matrix `m[row][column]`; `None` where it has no inverse.
    pub fn from_rows(m: M4) -> Option<Transform> {
        invert(&m).map(|inv| Transform { m, inv })
    }
    /// Moves by `d`.
    pub fn translate(d: Vec3<f64>) -> Transform {
        let with = |d: Vec3<f64>| [[1., 0., 0., d.x], [0., 1., 0., d.y], [0., 0., 1., d.z], [0., 0., 0., 1.]];
        Transform { m: with(d), inv: with(-d) }
    }
    /// Scales along the axes; `None` where a factor is zero.
    pub fn scale(s: Vec3<f64>) -> Option<Transform> {
        Transform::from_rows([[s.x, 0., 0., 0.], [0., s.y, 0., 0.], [0., 0., s.z, 0.], [0., 0., 0., 1.]])
    }
    /// Turns by `degrees` about `axis`, right-handed; `None` for a null axis.
    pub fn rotate(degrees: f64, axis: Vec3<f64>) -> Option<Transform> {
        let len = axis.length();
        if len.partial_cmp(&0.0) != Some(core::cmp::Ordering::Greater) || !len.is_finite() {
            return None;
        }
        let a = axis / len;
        let (s, c) = Real::sin_cos(degrees.to_radians());
        let k = 1.0 - c;
        let m = [
            [a.x * a.x * k + c, a.x * a.y * k - a.z * s, a.x * a.z * k + a.y * s, 0.],
            [a.x * a.y * k + a.z * s, a.y * a.y * k + c, a.y * a.z * k - a.x * s, 0.],
            [a.x * a.z * k - a.y * s, a.y * a.z * k + a.x * s, a.z * a.z * k + c, 0.],
            [0., 0., 0., 1.],
        ];
        Some(Transform { m, inv: transpose(&m) })
    }
    /// Camera space from world space for an eye looking at a point: camera z looks ahead, y up, left-handed as in
    /// pbrt-v4. `None` where the three vectors do not span a frame.
    pub fn look_at(eye: Vec3<f64>, at: Vec3<f64>, up: Vec3<f64>) -> Option<Transform> {
        let d = (at - eye).normalized();
        let right = up.normalized().cross(d);
        // Null or not a number: the three vectors span no frame.
        let spans = right.length() > 1e-12;
        if !spans {
            return None;
        }
        let right = right.normalized();
        let up = d.cross(right);
        let row = |i: usize| [right[i], up[i], d[i], eye[i]];
        Transform::from_rows([row(0), row(1), row(2), [0., 0., 0., 1.]]).map(|t| t.inverse())
    }
    /// pbrt-v4's perspective map: `fov` in degrees over the extent -1..1, depth to 0..1 between `near` and `far`.
    pub fn perspective(fov: f64, near: f64, far: f64) -> Option<Transform> {
        let p = [
            [1., 0., 0., 0.],
            [0., 1., 0., 0.],
            [0., 0., far / (far - near), -far * near / (far - near)],
            [0., 0., 1., 0.],
        ];
        let s = 1.0 / Real::tan(fov.to_radians() / 2.0);
        Some(Transform::scale(vec3(s, s, 1.0))?.then_first(&Transform::from_rows(p)?))
    }
    /// First `first`, then this: the matrix product `self * first`.
    #[must_use]
    pub fn then_first(&self, first: &Transform) -> Transform {
        Transform { m: mul(&self.m, &first.m), inv: mul(&first.inv, &self.inv) }
    }
    /// The way back.
    #[must_use]
    pub fn inverse(&self) -> Transform {
        Transform { m: self.inv, inv: self.m }
    }
    /// `m[column][row]`, as scene files and image headers that count columns first want it transposed.
    #[must_use]
    pub fn transposed(&self) -> Transform {
        Transform { m: transpose(&self.m), inv: transpose(&self.inv) }
    }
    /// The matrix, `m[row][column]`.
    pub fn rows(&self) -> &M4 {
        &self.m
    }
    /// Maps a point, dividing by the fourth coordinate where that is not 1.
    pub fn point(&self, p: Vec3<f64>) -> Vec3<f64> {
        let row = |i: usize| self.m[i][0] * p.x + self.m[i][1] * p.y + self.m[i][2] * p.z + self.m[i][3];
        let (v, w) = (vec3(row(0), row(1), row(2)), row(3));
        if (w - 1.0).abs() < 1e-15 { v } else { v / w }
    }
    /// Maps a direction: no translation.
    pub fn vector(&self, v: Vec3<f64>) -> Vec3<f64> {
        let row = |i: usize| self.m[i][0] * v.x + self.m[i][1] * v.y + self.m[i][2] * v.z;
        vec3(row(0), row(1), row(2))
    }
    /// Maps a surface normal, by the inverse transpose. The length changes.
    pub fn normal(&self, n: Vec3<f64>) -> Vec3<f64> {
        let col = |i: usize| self.inv[0][i] * n.x + self.inv[1][i] * n.y + self.inv[2][i] * n.z;
        vec3(col(0), col(1), col(2))
    }
    /// Determinant of the linear part.
    pub fn determinant(&self) -> f64 {
        let m = &self.m;
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    }
    /// Turns a right-handed system into a left-handed one.
    pub fn swaps_handedness(&self) -> bool {
        self.determinant() < 0.0
    }
    /// It is the identity, exactly.
    pub fn is_identity(&self) -> bool {
        self.m == IDENTITY
    }
}
