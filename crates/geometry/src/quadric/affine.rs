//! The first three rows of a matrix: [`Affine`].

use sparrow_math::{Transform, Vec3, vec3};

/// An affine map, without the projective row that every ray would pay for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Affine([[f64; 4]; 3]);

impl Affine {
    pub(super) fn of(t: &Transform) -> Affine {
        let [a, b, c, _] = *t.rows();
        Affine([a, b, c])
    }
    #[inline(always)]
    pub(super) fn vector(&self, v: Vec3<f64>) -> Vec3<f64> {
        let row = |r: &[f64; 4]| r[0] * v.x + r[1] * v.y + r[2] * v.z;
        vec3(row(&self.0[0]), row(&self.0[1]), row(&self.0[2]))
    }
    #[inline]
    pub(super) fn point(&self, p: Vec3<f64>) -> Vec3<f64> {
        self.vector(p) + vec3(self.0[0][3], self.0[1][3], self.0[2][3])
    }
    /// The transpose of the linear part applied to `v`: maps normals, on the inverse of the map of points.
    #[inline]
    pub(super) fn transposed(&self, v: Vec3<f64>) -> Vec3<f64> {
        let col = |i: usize| self.0[0][i] * v.x + self.0[1][i] * v.y + self.0[2][i] * v.z;
        vec3(col(0), col(1), col(2))
    }
    fn column(&self, i: usize) -> Vec3<f64> {
        vec3(self.0[0][i], self.0[1][i], self.0[2][i])
    }
    pub(super) fn determinant(&self) -> f64 {
        self.column(0).dot(self.column(1).cross(self.column(2)))
    }
    /// Lengths of the rows of the linear part.
    pub(super) fn row_lengths(&self) -> Vec3<f64> {
        let len = |r: &[f64; 4]| (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt();
        vec3(len(&self.0[0]), len(&self.0[1]), len(&self.0[2]))
    }
    /// The factor by which all lengths are stretched, if it is the same for all.
    pub(super) fn uniform_scale(&self) -> Option<f64> {
        let [a, b, c] = [self.column(0), self.column(1), self.column(2)];
        let s2 = a.length2();
        let same = |x: f64, y: f64| (x - y).abs() <= 1e-6 * s2;
        let is_uniform = same(b.length2(), s2)
            && same(c.length2(), s2)
            && same(a.dot(b), 0.0)
            && same(b.dot(c), 0.0)
            && same(c.dot(a), 0.0);
        is_uniform.then(|| s2.sqrt())
    }
}
