//! A rough, tilted piece of a fibre's surface: [`Scale`], and the facets on it: [`Scales`].

use sparrow_math::{LocalDir, Real, Vec3, vec3};

use super::section::Flat;
use crate::fresnel;
use crate::ggx::Ggx;

/// What all scales of a fibre have in common.
#[derive(Clone, Copy, Debug)]
pub struct Scales {
    /// Facets.
    pub ggx: Ggx<f64>,
    /// Index inside over index outside, above 1.
    pub eta: f64,
    /// Sine and cosine of the angle by which normals lean towards the tip.
    pub tilt: [f64; 2],
}

/// One scale: its axes in the fibre's frame, x along the fibre, z outwards.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    x: Vec3<f64>,
    y: Vec3<f64>,
    z: Vec3<f64>,
}

/// Light that passed a scale, or was reflected at it, in the fibre's frame.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it goes.
    pub w: Vec3<f64>,
    /// What is left of it, above zero.
    pub weight: f64,
}

/// No direction.
const ZERO: Vec3<f64> = Vec3 { x: 0.0, y: 0.0, z: 0.0 };

impl Scale {
    /// In place of one that nothing meets.
    pub(crate) const NONE: Scale = Scale { x: ZERO, y: ZERO, z: ZERO };

    /// Where the section's unit normal is `n`.
    pub fn new(scales: &Scales, n: Flat<f64>) -> Self {
        let [s, c] = scales.tilt;
        let (x, z) = (vec3(c, -s * n[0], -s * n[1]), vec3(s, c * n[0], c * n[1]));
        Scale { x, y: z.cross(x), z }
    }
    fn local(&self, w: Vec3<f64>) -> LocalDir<f64> {
        LocalDir::new(vec3(w.dot(self.x), w.dot(self.y), w.dot(self.z)))
    }
    fn in_fibre(&self, w: Vec3<f64>) -> Vec3<f64> {
        self.x * w.x + self.y * w.y + self.z * w.z
    }
}

fn upside_down(w: LocalDir<f64>) -> LocalDir<f64> {
    LocalDir::new(vec3(w.x(), w.y(), -w.z()))
}

impl Scales {
    /// `G1 = 2 |cos| / (|cos| (1 + 2 Lambda) + |cos|)`
    fn seen(&self, w: LocalDir<f64>) -> f64 {
        let cos = w.abs_cos_theta();
        (cos + cos) / (cos + self.ggx.stretched(w))
    }
    /// Reflection at a scale from `o` to `i`, both in the fibre's frame: `D G2 / (4 cos_o)` without reflectance, the density of samples,
    /// and the cosine of the angle to the facet.
    pub fn reflected(&self, at: &Scale, o: Vec3<f64>, i: Vec3<f64>) -> [f64; 3] {
        let (o, i) = (at.local(o), at.local(i));
        let m = o.half(i);
        let cos = o.dot(m);
        if !(o.above() && m.above() && cos > 0.0) {
            return [0.0; 3];
        }
        let density = 0.25 * self.ggx.visible_over_cos(o, m);
        let value = if i.above() { self.ggx.d(m) * self.ggx.g2_over_4cos(o, i) * i.z() } else { 0.0 };
        [value, density, cos.min(1.0)]
    }
    /// Draws the reflection of `o`, upwards or not; none where `o` lies behind the scale.
    pub fn draw_reflected(&self, at: &Scale, o: Vec3<f64>, u: [f64; 2]) -> Option<Vec3<f64>> {
        let o = at.local(o);
        o.above().then(|| at.in_fibre(o.reflect(self.ggx.sample_visible(o, u)).v()))
    }
    /// Light from `o` outside goes inside at the visible facet of `u`; none where it goes nowhere.
    pub fn enter(&self, at: &Scale, o: Vec3<f64>, u: [f64; 2]) -> Option<Ray> {
        let o = at.local(o);
        if !o.above() {
            return None;
        }
        let m = self.ggx.sample_visible(o, u);
        let cos = o.dot(m).clamp(0.0, 1.0);
        let (f, cos_t) = fresnel::dielectric(cos, self.eta);
        let t = LocalDir::new(m.v() * (cos / self.eta - cos_t) - o.v() * (1.0 / self.eta));
        (t.z() < 0.0).then(|| Ray { w: at.in_fibre(t.v()), weight: (1.0 - f) * self.seen(t) })
    }
    /// Light that travels along `w` inside is reflected at the visible facet of `u`.
    pub fn turn_back(&self, at: &Scale, w: Vec3<f64>, u: [f64; 2]) -> Option<Ray> {
        let v = upside_down(at.local(-w));
        if !v.above() {
            return None;
        }
        let m = self.ggx.sample_visible(v, u);
        let f = fresnel::dielectric(v.dot(m).clamp(0.0, 1.0), 1.0 / self.eta).0;
        let r = v.reflect(m);
        r.above().then(|| Ray { w: at.in_fibre(upside_down(r).v()), weight: f * self.seen(r) })
    }
    /// Light that travels along `w` inside leaves towards `i`: its value, and the density of samples. [Walter2007, eq. 17]
    pub fn left(&self, at: &Scale, w: Vec3<f64>, i: Vec3<f64>) -> [f64; 2] {
        let (v, i) = (at.local(-w), at.local(i));
        if !(v.z() < 0.0 && i.above()) {
            return [0.0; 2];
        }
        let between = -(v.v() * self.eta + i.v());
        let length = between.length();
        let m = LocalDir::new(between * (1.0 / length.max(1e-9)));
        let (cos_v, cos_i) = (-v.dot(m), i.dot(m));
        if !(m.above() && cos_v > 0.0 && cos_i > 0.0) {
            return [0.0; 2];
        }
        let f = fresnel::dielectric(cos_v.min(1.0), 1.0 / self.eta).0;
        // The vector of [Walter2007, eq. 16] has the length eta cos_v - cos_i.
        let density = self.ggx.visible_over_cos(v, m) * cos_v * cos_i / length.sqr();
        [density * (1.0 - f) * self.seen(i), density]
    }
    /// Draws where light that travels along `w` inside leaves; none where it does not.
    pub fn draw_left(&self, at: &Scale, w: Vec3<f64>, u: [f64; 2]) -> Option<Vec3<f64>> {
        let v = upside_down(at.local(-w));
        if !v.above() {
            return None;
        }
        let m = self.ggx.sample_visible(v, u);
        let cos = v.dot(m).clamp(0.0, 1.0);
        let cos_t = fresnel::dielectric(cos, 1.0 / self.eta).1;
        let t = LocalDir::new(m.v() * (cos * self.eta - cos_t) - v.v() * self.eta);
        (t.z() < 0.0 && cos_t > 0.0).then(|| at.in_fibre(upside_down(t).v().normalized()))
    }
}
