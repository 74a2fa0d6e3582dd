//! Directions to a ball.

use core::f64::consts::{FRAC_1_PI, TAU};

use sparrow_math::{Frame, LocalDir, Mask, Real, Vec3, vec3, warp};

use super::{Draw, Drawn, spread};

/// Density of directions drawn over the whole sphere.
const UNIFORM_SPHERE: f64 = 0.25 * FRAC_1_PI;

/// A ball to which directions are drawn: uniformly in the cone it fills, or over all directions from inside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ball {
    center: Vec3<f32>,
    radius: f32,
}

impl Ball {
    pub(crate) fn new(center: Vec3<f64>, radius: f64) -> Ball {
        Ball { center: center.to_f32(), radius: radius as f32 }
    }
    /// The same ball in every lane.
    #[inline(always)]
    fn spread<R: Real>(&self) -> BallOf<R> {
        BallOf { center: spread(self.center), radius: R::of(self.radius.into()) }
    }
    /// Bound of the rounding error of its points.
    pub(crate) fn p_error(&self) -> Vec3<f32> {
        self.spread::<f32>().p_error()
    }
    /// Centre and radius.
    pub(crate) fn to_array(self) -> [f32; 4] {
        let Ball { center: Vec3 { x, y, z }, radius } = self;
        [x, y, z, radius]
    }
}

/// A ball, or one for each lane.
#[derive(Clone, Copy)]
pub(super) struct BallOf<R> {
    pub(super) center: Vec3<R>,
    pub(super) radius: R,
}

/// The cone that a ball fills.
#[derive(Clone, Copy)]
pub(crate) struct Cone<R> {
    /// To the centre.
    distance: R,
    /// Sine of the half angle; 1 or more from inside.
    sin: R,
    /// Squared cosine of it.
    cos2: R,
    /// 1 less its cosine.
    one_minus_cos: R,
}

impl<R: Real> Cone<R> {
    #[inline(always)]
    fn new(radius: R, to_center: Vec3<R>) -> Cone<R> {
        let distance = to_center.length();
        let sin = radius / distance;
        let cos2 = (R::ONE - sin) * (R::ONE + sin);
        Cone { distance, sin, cos2, one_minus_cos: sin * sin / (R::ONE + cos2.safe_sqrt()) }
    }
    #[inline(always)]
    fn is_inside(&self) -> R::Mask {
        !self.sin.lt(R::ONE)
    }
    #[inline(always)]
    fn pdf(&self) -> R {
        R::select(self.is_inside(), R::of(UNIFORM_SPHERE), R::ONE / (R::of(TAU) * self.one_minus_cos))
    }
}

/// The way to the centre, and the cone around it.
type View<R> = (Vec3<R>, Cone<R>);

impl<R: Real> BallOf<R> {
    #[inline(always)]
    pub(super) fn p_error(&self) -> Vec3<R> {
        let reach = self.center.abs() + vec3(self.radius, self.radius, self.radius);
        reach * R::of(f64::from(crate::bvh::gamma(5)))
    }
    #[inline(always)]
    pub(super) fn view(&self, from: Vec3<R>) -> View<R> {
        let to_center = self.center - from;
        (to_center, Cone::new(self.radius, to_center))
    }
    #[inline(always)]
    pub(super) fn draw(&self, &(to_center, cone): &View<R>, u: [R; 2]) -> Drawn<R> {
        let radius = self.radius;
        let local = warp::uniform_cone(u, cone.one_minus_cos);
        let (sin2, cos) = (local.x * local.x + local.y * local.y, local.z);
        let frame = Frame::from_z(to_center * (R::ONE / cone.distance));
        // The nearer end of the chord, in distances of the centre: cos - root, without the cancellation.
        let root = (cone.sin * cone.sin - sin2).safe_sqrt();
        let near = cone.cos2 / (cos + root);
        // By the law of sines, and as a difference of angles: the direction from the centre to that end.
        let across = near / cone.sin;
        let out = vec3(local.x * across, local.y * across, -(sin2 + cos * root) / cone.sin);
        let mut drawn = Drawn {
            wi: frame.to_world(LocalDir::new(local)),
            n: frame.to_world(LocalDir::new(out)),
            p: Vec3::default(),
            distance: near * cone.distance,
            pdf: cone.pdf(),
        };
        let inside = cone.is_inside();
        if inside.any() {
            let wi = warp::uniform_sphere(u);
            let along = to_center.dot(wi);
            let half = (radius * radius - (to_center - wi * along).length2()).safe_sqrt();
            let distance = along + half;
            let out = (wi * distance - to_center).normalized();
            drawn.wi = Vec3::select(inside, wi, drawn.wi);
            drawn.n = Vec3::select(inside, out, drawn.n);
            drawn.distance = R::select(inside, distance, drawn.distance);
        }
        Drawn { p: self.center + drawn.n * radius, ..drawn }
    }
}

impl Draw for Ball {
    type View<R: Real> = View<R>;

    #[inline(always)]
    fn view<R: Real>(&self, from: Vec3<R>, _: Option<Vec3<R>>) -> View<R> {
        self.spread().view(from)
    }
    /// The same for all of the ball; none where it is too small a target.
    #[inline(always)]
    fn pdf<R: Real>(&self, (_, cone): &View<R>, _: Vec3<R>) -> R {
        let pdf = cone.pdf();
        pdf.only_where(pdf.lt(R::of(f64::from(f32::MAX))))
    }
    #[inline(always)]
    fn draw<R: Real>(&self, view: &View<R>, u: [R; 2]) -> Drawn<R> {
        self.spread().draw(view, u)
    }
}
