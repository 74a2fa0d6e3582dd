//! Where rays may meet light: [`Emitters`].

use sparrow_geometry::Geometry;
use sparrow_math::{Mask, Real, Vec3, vec3};

/// Most shapes that shine for which asking their balls is cheaper than asking all that a ray may meet.
const MOST: usize = 16;
/// Balls are widened, relative to how far they are, by more than rounding can do.
const MARGIN: f64 = 4e-6;

/// A ball around a shape that shines.
#[derive(Clone, Copy, Debug)]
struct Ball {
    center: [f32; 3],
    radius: f32,
}

/// Balls around all that shines and that rays can meet.
#[derive(Debug)]
pub(crate) struct Emitters(Vec<Ball>);

impl Emitters {
    /// Those of `shapes` of the world; `None` where they are too many to be asked for a ray.
    pub(super) fn new(geometry: &Geometry, shapes: impl Iterator<Item = u32>) -> Option<Emitters> {
        let mut balls = Vec::new();
        for (center, radius) in shapes.filter_map(|shape| geometry.ball_around(shape)) {
            balls.push(Ball { center: center.to_array(), radius });
            if balls.len() > MOST {
                return None;
            }
        }
        Some(Emitters(balls))
    }

    /// The ray from `o` along the unit vector `d` may meet one of them; where this says no, it meets none.
    #[inline(always)]
    pub(crate) fn may_be_met<R: Real>(&self, o: Vec3<R>, d: Vec3<R>) -> R::Mask {
        let mut met = R::Mask::of(false);
        for Ball { center: [x, y, z], radius } in &self.0 {
            let to = vec3(R::of((*x).into()), R::of((*y).into()), R::of((*z).into())) - o;
            let (along, distance2) = (to.dot(d), to.length2());
            let radius2 = R::of(f64::from(*radius).sqr()) + R::of(MARGIN) * distance2;
            // Of the line, the point next to the centre; the ray begins inside, or goes there.
            let ahead = along.gt(R::ZERO) | distance2.le(radius2);
            // Also where squares overflow, which tells nothing.
            met = met | (ahead & !(distance2 - along * along).gt(radius2));
        }
        met
    }
}

#[cfg(test)]
mod tests {
    use sparrow_geometry::{Ray, Shape, ShapeInstance};
    use sparrow_math::Transform;

    use super::*;

    fn number(state: &mut u64) -> f32 {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 40) as f32 / (1u64 << 24) as f32
    }

    fn sphere(center: Vec3<f64>, r: f32) -> ShapeInstance {
        let shape = Shape::Sphere { radius: r, z_min: -r, z_max: r, phi_max: 360.0 };
        ShapeInstance { shape, to_world: Transform::translate(center), flip_normal: false }
    }

    /// No ray that meets one is told not to, and rays that pass at a hundredth of the distance are.
    #[test]
    fn rays_are_told_apart() {
        let geometry =
            Geometry::build(vec![sphere(vec3(1.0, 2.0, 3.0), 0.5), sphere(vec3(-40.0, 0.0, 9.0), 0.01)]);
        let emitters = Emitters::new(&geometry, 0..2).unwrap();
        let (mut state, mut met) = (1, 0);
        for i in 0..200_000 {
            let mut next = || number(&mut state) - 0.5;
            let o = vec3(next(), next(), next()) * 30.0;
            let (center, radius) = geometry.ball_around(i % 2).unwrap();
            let side = vec3(next(), next(), next()).normalized() * radius;
            let d = (center + side * (2.5 * next() + 1.25) - o).normalized();
            let hit = geometry.intersect(&Ray::new(o, d)).is_some();
            met += u32::from(hit);
            assert!(!hit || emitters.may_be_met::<f32>(o, d), "{o:?} {d:?}");
            let past = (center + side * (1.0 + 0.01 * (center - o).length() / radius) - o).normalized();
            let far = [0, 1].iter().all(|k| {
                let (center, radius) = geometry.ball_around(*k).unwrap();
                let to = center - o;
                let beside = (to - past * to.dot(past)).length();
                beside > radius + 0.005 * to.length() || to.dot(past) < -radius
            });
            assert!(!far || !emitters.may_be_met::<f32>(o, past), "{o:?} {past:?}");
        }
        assert!(met > 50_000, "{met}");
    }

    /// Beyond what squares can hold, nothing is ruled out.
    #[test]
    fn rays_from_afar_are_asked() {
        let emitters = Emitters(vec![Ball { center: [0.0; 3], radius: 1.0 }]);
        assert!(emitters.may_be_met::<f32>(vec3(0.0, 0.0, -3e19), vec3(0.0, 0.0, 1.0)));
    }

    #[test]
    fn none_where_they_are_too_many() {
        let balls =
            |n: usize| Geometry::build((0..n).map(|i| sphere(vec3(i as f64, 0.0, 0.0), 0.1)).collect());
        assert!(Emitters::new(&balls(MOST), 0..MOST as u32).is_some());
        assert!(Emitters::new(&balls(MOST + 1), 0..MOST as u32 + 1).is_none());
    }
}
