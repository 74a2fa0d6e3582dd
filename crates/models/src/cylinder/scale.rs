//! A rough, tilted piece of a fibre's surface: [`Scale`].

use sparrow_math::{LocalDir, Real, Vec3, vec3};

use super::section::Flat;
use crate::fresnel;
use crate::ggx::Ggx;

/// What all scales of a fibre have in common.
#[derive(Clone, Copy, Debug)]
pub struct Scales<R> {
    /// Facets.
    pub ggx: Ggx<R>,
    /// Index inside over index outside, above 1.
    pub eta: R,
    /// Sine and cosine of the angle by which normals lean towards the tip.
    pub tilt: [R; 2],
}

/// One scale, with its axes in the fibre's frame: x along the fibre, z outwards.
#[derive(Clone, Copy, Debug)]
pub struct Scale<R> {
    of: Scales<R>,
    x: Vec3<R>,
    y: Vec3<R>,
    z: Vec3<R>,
}

/// Light that passed a scale, or was reflected at it, in the fibre's frame.
#[derive(Clone, Copy, Debug)]
pub struct Ray<R> {
    /// Where it goes.
    pub w: Vec3<R>,
    /// What is left of it; zero where it went nowhere.
    pub weight: R,
}

/// `G1 = 2 |cos| / (|cos| (1 + 2 Lambda) + |cos|)`
#[inline(always)]
fn seen<R: Real>(ggx: &Ggx<R>, w: LocalDir<R>) -> R {
    let cos = w.abs_cos_theta();
    (cos + cos) / (cos + ggx.stretched(w))
}

#[inline(always)]
fn upside_down<R: Real>(w: LocalDir<R>) -> LocalDir<R> {
    LocalDir::new(vec3(w.x(), w.y(), -w.z()))
}

impl<R: Real> Scale<R> {
    /// Where the section's unit normal is `n`.
    #[inline(always)]
    pub fn new(of: Scales<R>, n: Flat<R>) -> Self {
        let [s, c] = of.tilt;
        let (x, z) = (vec3(c, -s * n[0], -s * n[1]), vec3(s, c * n[0], c * n[1]));
        Scale { of, x, y: z.cross(x), z }
    }
    #[inline(always)]
    fn local(&self, w: Vec3<R>) -> LocalDir<R> {
        LocalDir::new(vec3(w.dot(self.x), w.dot(self.y), w.dot(self.z)))
    }
    #[inline(always)]
    fn in_fibre(&self, w: Vec3<R>) -> Vec3<R> {
        self.x * w.x + self.y * w.y + self.z * w.z
    }
    /// Reflection from `o` to `i`, both in the fibre's frame: `D G2 / (4 cos_o)` without reflectance, the density of samples, and the
    /// cosine of the angle to the facet.
    #[inline(always)]
    pub fn reflected(&self, o: Vec3<R>, i: Vec3<R>) -> [R; 3] {
        let (o, i) = (self.local(o), self.local(i));
        let m = o.half(i);
        let cos = o.dot(m);
        let lit = o.above() & m.above() & cos.gt(R::ZERO);
        let both = lit & i.above();
        let d = self.of.ggx.d(m);
        let value = d * self.of.ggx.g2_over_4cos(o, i) * i.z();
        let density = R::of(0.25) * self.of.ggx.visible_over_cos(o, m);
        [value.only_where(both), density.only_where(lit), cos.min(R::ONE).only_where(lit)]
    }
    /// Draws the reflection of `o`; upwards or not, none where `o` lies behind the scale.
    #[inline(always)]
    pub fn draw_reflected(&self, o: Vec3<R>, u: [R; 2]) -> (Vec3<R>, R::Mask) {
        let o = self.local(o);
        let r = o.reflect(self.of.ggx.sample_visible(o, u));
        (self.in_fibre(r.v()), o.above())
    }
    /// Light from `o` outside goes inside at the visible facet of `u`.
    #[inline(always)]
    pub fn enter(&self, o: Vec3<R>, u: [R; 2]) -> Ray<R> {
        let o = self.local(o);
        let m = self.of.ggx.sample_visible(o, u);
        let cos = o.dot(m).clamp(R::ZERO, R::ONE);
        let (f, cos_t) = fresnel::dielectric(cos, self.of.eta);
        let over = R::ONE / self.of.eta;
        let t = LocalDir::new(m.v() * (cos * over - cos_t) - o.v() * over);
        let passes = o.above() & t.z().lt(R::ZERO);
        Ray { w: self.in_fibre(t.v()), weight: ((R::ONE - f) * seen(&self.of.ggx, t)).only_where(passes) }
    }
    /// Light that travels along `w` inside is reflected at the visible facet of `u`.
    #[inline(always)]
    pub fn turn_back(&self, w: Vec3<R>, u: [R; 2]) -> Ray<R> {
        let v = upside_down(self.local(-w));
        let m = self.of.ggx.sample_visible(v, u);
        let f = fresnel::dielectric(v.dot(m).clamp(R::ZERO, R::ONE), R::ONE / self.of.eta).0;
        let r = v.reflect(m);
        let stays = v.above() & r.above();
        Ray { w: self.in_fibre(upside_down(r).v()), weight: (f * seen(&self.of.ggx, r)).only_where(stays) }
    }
    /// Light that travels along `w` inside leaves towards `i`: its value, and the density of samples. [Walter2007, eq. 17]
    #[inline(always)]
    pub fn left(&self, w: Vec3<R>, i: Vec3<R>) -> [R; 2] {
        let (v, i) = (self.local(-w), self.local(i));
        let eta = self.of.eta;
        let between = -(v.v() * eta + i.v());
        let length = between.length();
        let some = length.gt(R::of(1e-9));
        let m = LocalDir::new(between * (R::ONE / R::select(some, length, R::ONE)));
        let (cos_v, cos_i) = (-v.dot(m), i.dot(m));
        let passes = some & v.z().lt(R::ZERO) & i.above() & m.above() & cos_v.gt(R::ZERO) & cos_i.gt(R::ZERO);
        let f = fresnel::dielectric(cos_v.clamp(R::ZERO, R::ONE), R::ONE / eta).0;
        // The vector of [Walter2007, eq. 16] has the length eta cos_v - cos_i.
        let jacobian = cos_v * cos_i / R::select(some, length, R::ONE).sqr();
        let density = (self.of.ggx.visible_over_cos(v, m) * jacobian).only_where(passes);
        [density * (R::ONE - f) * seen(&self.of.ggx, i), density]
    }
    /// Draws where light that travels along `w` inside leaves.
    #[inline(always)]
    pub fn draw_left(&self, w: Vec3<R>, u: [R; 2]) -> (Vec3<R>, R::Mask) {
        let v = upside_down(self.local(-w));
        let m = self.of.ggx.sample_visible(v, u);
        let eta = self.of.eta;
        let cos = v.dot(m).clamp(R::ZERO, R::ONE);
        let cos_t = fresnel::dielectric(cos, R::ONE / eta).1;
        let t = LocalDir::new(m.v() * (cos * eta - cos_t) - v.v() * eta);
        let passes = v.above() & t.z().lt(R::ZERO) & cos_t.gt(R::ZERO);
        (self.in_fibre(upside_down(t).v().normalized()), passes)
    }
}
