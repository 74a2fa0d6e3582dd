//! Eight lights or groups of lights, weighed at once in lanes.

use sparrow_math::{Mask, Real, Vec3, vec3};

use super::LitPoint;
use super::bounds::LightBounds;

/// Lights in one [`Eight`].
pub(super) const EIGHT: usize = 8;

/// The least that an angle takes from importance where light may arrive: a fibre takes light across its normal.
const LEAST_COSINE: f64 = 0.02;
/// Angles of emission are widened by so much, in rad, against rounding.
const MARGIN: f64 = 1e-3;
/// What shines has at least this importance, however weak or far it is.
const LEAST: f64 = 1e-36;
/// No importance is larger, so that they can be added up.
const MOST: f64 = 1e36;

type Column = [f32; EIGHT];

/// Bounds by columns; empty places have power 0.
#[derive(Clone, Debug, Default)]
#[repr(align(32))]
pub(super) struct Eight {
    power: Column,
    /// Ball around the bounds.
    center: [Column; 3],
    radius: Column,
    /// Reciprocal of the square of that.
    near: Column,
    /// Cone of normals.
    axis: [Column; 3],
    cos_normals: Column,
    sin_normals: Column,
    /// Least cosine of light to its normal.
    cos_emission: Column,
    /// 1 where both sides shine, else 0.
    two_sided: Column,
}

/// Cosine and sine of an angle.
type Turn<R> = (R, R);

/// The angle `a - b`, or zero where `b` is the larger; both lie in [0, pi].
#[inline(always)]
fn less<R: Real>(a: Turn<R>, b: Turn<R>) -> Turn<R> {
    let inside = a.0.ge(b.0);
    let (cos, sin) = (a.0 * b.0 + a.1 * b.1, a.1 * b.0 - a.0 * b.1);
    (R::select(inside, R::ONE, cos), R::select(inside, R::ZERO, sin))
}

#[inline(always)]
fn turn<R: Real>(cos: R) -> Turn<R> {
    (cos, (R::ONE - cos * cos).safe_sqrt())
}

impl Eight {
    /// Writes bounds to place `i`.
    pub(super) fn set(&mut self, i: usize, b: &LightBounds) {
        let (center, axis) = (b.bounds.center(), b.cone.axis.to_f32());
        for (k, (c, a)) in center.to_array().into_iter().zip(axis.to_array()).enumerate() {
            self.center[k][i] = c;
            self.axis[k][i] = a;
        }
        let (sin, cos) = Real::sin_cos(b.cone.normals.min(core::f64::consts::PI));
        self.power[i] = b.power;
        self.radius[i] = b.bounds.radius();
        self.near[i] = 1.0 / (self.radius[i] * self.radius[i]).max(1e-30);
        (self.cos_normals[i], self.sin_normals[i]) = (cos as f32, sin as f32);
        self.cos_emission[i] = Real::cos((b.cone.emission + MARGIN).min(core::f64::consts::PI)) as f32;
        self.two_sided[i] = f32::from(u8::from(b.cone.two_sided));
    }

    /// About how much light each sends to a point.
    #[inline(always)]
    pub(super) fn importances<R: Real>(&self, at: &LitPoint) -> Column {
        let mut out = [0.0; EIGHT];
        let spread = |v: Vec3<f32>| vec3(R::of(v.x.into()), R::of(v.y.into()), R::of(v.z.into()));
        for i in (0..EIGHT).step_by(R::WIDTH) {
            self.read(|c| R::load(c, i)).importance(spread(at.p), spread(at.n)).store(&mut out, i);
        }
        out
    }

    /// The bounds in place `i`, in every lane.
    #[inline(always)]
    pub(super) fn spread<R: Real>(&self, i: usize) -> Bounds<R> {
        self.read(|c| R::of(c[i % EIGHT].into()))
    }

    #[inline(always)]
    fn read<R: Real>(&self, of: impl Fn(&Column) -> R) -> Bounds<R> {
        let [x, y, z] = &self.center;
        let [ax, ay, az] = &self.axis;
        Bounds {
            power: of(&self.power),
            center: vec3(of(x), of(y), of(z)),
            radius: of(&self.radius),
            near: of(&self.near),
            axis: vec3(of(ax), of(ay), of(az)),
            normals: (of(&self.cos_normals), of(&self.sin_normals)),
            cos_emission: of(&self.cos_emission),
            two_sided: of(&self.two_sided),
        }
    }
}

/// Bounds of a light or a group of them, a number or lanes of each.
pub(super) struct Bounds<R> {
    power: R,
    center: Vec3<R>,
    radius: R,
    near: R,
    axis: Vec3<R>,
    normals: Turn<R>,
    cos_emission: R,
    two_sided: R,
}

impl<R: Real> Bounds<R> {
    /// About how much light it sends to the point `p` with normal `n`. [ContyKulla2018, eq. 3]
    ///
    /// Zero only where no light can arrive: no cosine towards any point of the ball is larger.
    #[inline(always)]
    pub(super) fn importance(&self, p: Vec3<R>, n: Vec3<R>) -> R {
        let Bounds { power, radius, .. } = *self;
        let to = self.center - p;
        let (d2, r2) = (to.length2(), radius * radius);
        let inv = R::ONE / d2.max(R::of(1e-30)).sqrt();
        let sin_ball = (radius * inv).min(R::ONE);
        // Of the cosine towards any point of the ball, a bound without roots: cos(a - b) <= cos a + sin b.
        let least = R::of(LEAST_COSINE);
        let receives = (n.dot(to).abs() * inv + sin_ball).min(R::ONE).max(least);
        // Within the ball nothing is known of distance and angle.
        let within = d2.le(r2);

        let (far, mut shines) = (receives * (inv * inv), power.gt(R::ZERO));
        let weight = if self.everywhere().all() {
            R::select(within, self.near, far)
        } else {
            let emits = self.emits(to * inv, sin_ball);
            shines = shines & (within | emits.ge(self.cos_emission));
            R::select(within, self.near, emits.max(least) * far)
        };
        R::select(shines, (power * weight).clamp(R::of(LEAST), R::of(MOST)), R::ZERO)
    }

    /// Some normal points to every side, as those of balls do.
    #[inline(always)]
    fn everywhere(&self) -> R::Mask {
        self.normals.0.le(R::of(-1.0))
    }

    /// Largest cosine of light to its normal, seen along `d` in a ball of an angle of that sine.
    #[inline(always)]
    fn emits(&self, d: Vec3<R>, sin_ball: R) -> R {
        let cos = -self.axis.dot(d);
        let cos = R::select(self.two_sided.gt(R::ZERO), cos.abs(), cos);
        let ball = ((R::ONE - sin_ball * sin_ball).safe_sqrt(), sin_ball);
        let (emits, _) = less(less(turn(cos), self.normals), ball);
        R::select(self.everywhere(), R::ONE, emits)
    }
}

/// Chooses one of `weights`, whose sum is `total`: its place, its share, and `u` made uniform again.
///
/// None where no weight is positive.
#[inline(always)]
pub(super) fn pick(weights: &[f32], total: f32, u: f64) -> Option<(usize, f32, f64)> {
    let mut left = u * f64::from(total);
    let mut last = None;
    for (i, &w) in weights.iter().enumerate().filter(|(_, w)| **w > 0.0) {
        last = Some((i, w / total, (left / f64::from(w)).clamp(0.0, 1.0)));
        if left < f64::from(w) {
            break;
        }
        left -= f64::from(w);
    }
    last
}
