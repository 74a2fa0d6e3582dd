//! Spheres, disks and cylinders under affine maps: [`Quadric`].
//!
//! Worked in double precision and, but for whole spheres, in object space; points and normals are rounded once.

mod affine;
mod ball;
mod columns;
mod form;
mod sampling;

use affine::Affine;
use ball::Ball;
pub(crate) use columns::Met;
use form::{Form, Local};
use sparrow_math::{Aabb, Transform, Vec3, vec3};

use crate::bvh::{self, RAYS, RawHit};
use crate::point::SurfacePoint;
use crate::ray::{Hit, Ray};
use crate::shape::Shape;

/// A quadric at its place.
#[derive(Debug)]
pub(crate) struct Quadric {
    form: Form,
    to_world: Affine,
    to_object: Affine,
    flip: bool,
    /// Volume scale of the map to world space.
    volume: f64,
    /// Set if this is a whole sphere and stays one.
    ball: Option<Ball>,
    /// World-space area.
    area: f64,
}

/// Bound of the rounding error of a world-space point on the surface.
#[inline(always)]
fn p_error(p: Vec3<f64>) -> Vec3<f32> {
    // Everything but the last rounding is done in double precision; that one errs by half of this.
    (p.abs() * f64::from(f32::EPSILON)).to_f32() + Vec3::splat(f32::MIN_POSITIVE)
}

impl Quadric {
    /// `None` for meshes, and where nothing is left to hit: no extent, or numbers that are not finite.
    pub(crate) fn new(shape: &Shape, to_world: &Transform, flip: bool) -> Option<Quadric> {
        let form = Form::of(shape)?;
        let (to, back) = (Affine::of(to_world), Affine::of(&to_world.inverse()));
        let mut q = Quadric {
            form,
            to_world: to,
            to_object: back,
            flip,
            volume: to.determinant().abs(),
            ball: None,
            area: 0.0,
        };
        q.ball = q
            .form
            .whole_radius()
            .and_then(|r| Some(Ball::new(to.point(Vec3::splat(0.0)), r, to.uniform_scale()?)));
        q.area = q.world_area();
        let b = q.bounds();
        (q.area > 0.0 && q.area.is_finite() && b.lo.is_finite() && b.hi.is_finite()).then_some(q)
    }

    /// Box in world space.
    pub(crate) fn bounds(&self) -> Aabb {
        let (lo, hi) = self.form.bounds();
        let mut b = Aabb::EMPTY;
        if let Some(r) = self.form.whole_radius() {
            // Along each axis a linear map stretches the unit ball by the length of its row.
            let (c, e) = (self.to_world.point(Vec3::splat(0.0)), self.to_world.row_lengths() * r);
            b = b.grow((c - e).to_f32()).grow((c + e).to_f32());
        } else {
            for i in 0..8 {
                let pick = |bit: usize, lo: f64, hi: f64| if i >> bit & 1 == 0 { lo } else { hi };
                let p = vec3(pick(0, lo.x, hi.x), pick(1, lo.y, hi.y), pick(2, lo.z, hi.z));
                b = b.grow(self.to_world.point(p).to_f32());
            }
        }
        // The corners were rounded to the nearest number, not outwards.
        Aabb {
            lo: vec3(b.lo.x.next_down(), b.lo.y.next_down(), b.lo.z.next_down()),
            hi: vec3(b.hi.x.next_up(), b.hi.y.next_up(), b.hi.z.next_up()),
        }
    }

    /// The ball that this is, if it is a whole sphere.
    pub(crate) fn whole(&self) -> Option<bvh::Ball> {
        self.ball.map(|b| bvh::Ball {
            center: b.center.to_f32().to_array(),
            radius: b.radius as f32,
            whole: true,
        })
    }

    fn to_local(&self, ray: &Ray) -> (Vec3<f64>, Vec3<f64>) {
        (self.to_object.point(ray.o.to_f64()), self.to_object.vector(ray.d.to_f64()))
    }

    /// Where the lines of eight rays meet a whole ball, as [`Others::roots`](crate::bvh::Others::roots) says; `None` of others.
    #[inline(always)]
    pub(crate) fn roots(&self, o: &[[f32; RAYS]; 3], d: &[[f32; RAYS]; 3]) -> Option<[[f32; RAYS]; 2]> {
        let ball = self.ball.as_ref()?;
        let mut roots = [[0.0; RAYS]; 2];
        for i in 0..RAYS {
            let ray = Ray::new(vec3(o[0][i], o[1][i], o[2][i]), vec3(d[0][i], d[1][i], d[2][i]));
            [roots[0][i], roots[1][i]] = ball.roots_or_nan(&ray).map(|t| t as f32);
        }
        Some(roots)
    }

    /// Offers the points of the ray on the quadric, the nearer one first; returns the last limit.
    #[inline]
    pub(crate) fn hit(&self, id: u32, ray: &Ray, t_max: f32, found: &mut impl FnMut(RawHit) -> f32) -> f32 {
        let mut limit = t_max;
        if let Some(ball) = &self.ball {
            for t in ball.roots(ray).into_iter().flatten() {
                let t = t as f32;
                if t > 0.0 && t < limit {
                    limit = found(RawHit { t, id, u: 0.0, v: 0.0 });
                }
            }
            return limit;
        }
        let (o, d) = self.to_local(ray);
        for t in self.form.roots(o, d) {
            let t32 = t as f32;
            if t32 > 0.0 && t32 < limit && self.form.covers(o + d * t) {
                limit = found(RawHit { t: t32, id, u: 0.0, v: 0.0 });
            }
        }
        limit
    }
    /// The point of the quadric that the tree found at `t`.
    fn local(&self, ray: &Ray, t: f32) -> Local {
        if let Some(ball) = &self.ball {
            return self.local_on_ball(ball, ball.outward(ray, t));
        }
        let (o, d) = self.to_local(ray);
        // The root itself, not its rounded value, which may lie far off the surface.
        let off = |x: f64| (x - f64::from(t)).abs();
        let nearest = self
            .form
            .roots(o, d)
            .into_iter()
            .fold(f64::NAN, |a, b| if off(b) < off(a) || a.is_nan() { b } else { a });
        self.form.local(o + d * nearest)
    }

    #[inline]
    fn local_on_ball(&self, ball: &Ball, out: Vec3<f64>) -> Local {
        self.form.local_of_normal(self.to_object.vector(out) * ball.scale)
    }
    /// The point of a ball in direction `out` from its centre, and its normal there, in the world.
    #[inline(always)]
    fn on_ball(&self, ball: &Ball, out: Vec3<f64>) -> (Vec3<f64>, Vec3<f64>) {
        (ball.center + out * ball.radius, if self.flip { -out } else { out })
    }

    /// Unit normal in world space, turned as the orientation says.
    fn world_normal(&self, n: Vec3<f64>) -> Vec3<f64> {
        let n = self.to_object.transposed(n).normalized();
        if self.flip { -n } else { n }
    }

    /// The surface at a hit; meanings as in pbrt-v4.
    pub(crate) fn surface(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let (l, p, ng) = match &self.ball {
            Some(ball) => {
                let out = ball.outward(ray, hit.t);
                let (p, n) = self.on_ball(ball, out);
                (self.local_on_ball(ball, out), p, n)
            }
            None => {
                let l = self.local(ray, hit.t);
                (l, self.to_world.point(l.p), self.world_normal(l.n))
            }
        };
        let ng = ng.to_f32();
        let dpdu = self.to_world.vector(l.dpdu).to_f32();
        SurfacePoint {
            p: p.to_f32(),
            p_error: p_error(p),
            ng,
            ns: ng,
            dpdu,
            dpdv: self.to_world.vector(l.dpdv).to_f32(),
            uv: l.uv,
            tangent: dpdu,
            shape: hit.shape,
            prim: hit.prim,
            time: 0.0,
        }
    }
    /// Derivatives of the normal by the texture coordinates.
    pub(crate) fn normal_derivatives(&self, ray: &Ray, hit: &Hit) -> (Vec3<f32>, Vec3<f32>) {
        let l = self.local(ray, hit.t);
        let n = self.to_object.transposed(l.n);
        let len = n.length();
        let n = n / len;
        // The normal of the image is not of unit length; its change of length is taken out.
        let change = |d: Vec3<f64>| {
            let d = self.to_object.transposed(d) / len;
            (d - n * n.dot(d)).to_f32()
        };
        let (du, dv) = self.form.normal_derivatives(&l);
        (change(du), change(dv))
    }
}
