//! What choosing a light promises: probabilities that are told, and none that is zero where light arrives.

use sparrow_math::{Aabb, Real, Vec3, vec3};

use super::LitPoint;
use super::bounds::{Cone, LightBounds};
use super::selection::LightSelection;

/// Numbers in [0, 1) from a small generator.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }
    fn point(&mut self, side: f32) -> Vec3<f32> {
        vec3(self.next() - 0.5, self.next() - 0.5, self.next() - 0.5) * side
    }
    fn direction(&mut self) -> Vec3<f32> {
        sparrow_math::warp::uniform_sphere([self.next(), self.next()])
    }
    fn lit(&mut self) -> LitPoint {
        LitPoint { p: self.point(12.0), n: self.direction() }
    }
}

/// A small flat emitter: corners, normal, both sides.
struct Lamp {
    corners: [Vec3<f32>; 3],
    n: Vec3<f32>,
    two_sided: bool,
}

/// Lamps in a box of side 10, some in tight groups, of powers over six orders of magnitude; and their bounds.
fn lamps(count: usize) -> (Vec<Lamp>, Vec<LightBounds>) {
    let mut r = Numbers(5);
    let mut home = r.point(10.0);
    let lamp = |i: usize| {
        if i % 7 != 3 {
            home = r.point(10.0);
        }
        let (a, b, c) = (home + r.point(0.3), home + r.point(0.3), home + r.point(0.3));
        let n = (b - a).cross(c - a).normalized();
        Lamp { corners: [a, b, c], n, two_sided: i.is_multiple_of(5) }
    };
    let lamps: Vec<Lamp> = (0..count).map(lamp).collect();
    let mut r = Numbers(6);
    let bounds = lamps.iter().map(|l| LightBounds {
        power: Real::exp(14.0 * r.next() - 7.0),
        bounds: l.corners.iter().fold(Aabb::EMPTY, |b, &p| b.grow(p)),
        cone: Cone::facing(l.n, l.two_sided),
    });
    let bounds = bounds.collect();
    (lamps, bounds)
}

fn selection(bounds: &[LightBounds]) -> LightSelection {
    LightSelection::by_place(bounds, &vec![true; bounds.len()])
}

#[test]
fn lights_are_chosen_with_the_probability_that_is_told() {
    for count in [5, 64, 65, 1000] {
        let (_, bounds) = lamps(count);
        let s = selection(&bounds);
        let mut r = Numbers(9);
        for _ in 0..20 {
            let at = r.lit();
            let told: Vec<f32> = (0..count as u32).map(|i| s.probability(&at, i)).collect();
            let sum: f64 = told.iter().map(|&p| f64::from(p)).sum();
            let n = 40_000;
            let (mut counts, mut lost) = (vec![0.0f64; count], 0.0);
            for i in 0..n {
                match s.choose(&at, (i as f32 + 0.5) / n as f32) {
                    Some((light, p)) => {
                        counts[light as usize] += 1.0 / f64::from(n);
                        let told = told[light as usize];
                        assert!((p - told).abs() <= 1e-5 * told, "{count} lights: {p} said, {told} told");
                    }
                    None => lost += 1.0 / f64::from(n),
                }
            }
            // A group that looks as if it shone and turns out dark loses the sample.
            assert!((sum + lost - 1.0).abs() < 1e-3, "{count} lights: {sum} and {lost}");
            for (c, p) in counts.iter().zip(&told) {
                // Choices are monotone in `u` within each of at most eight levels.
                assert!((c - f64::from(*p)).abs() < 3e-4, "{count} lights: {c} for {p}");
            }
        }
    }
}

#[test]
fn no_lamp_that_shines_at_a_point_has_probability_zero() {
    for count in [40, 700] {
        let (lamps, bounds) = lamps(count);
        let s = selection(&bounds);
        let mut r = Numbers(11);
        let mut grazing = 0;
        for _ in 0..300 {
            let at = r.lit();
            for (i, lamp) in lamps.iter().enumerate() {
                let cosines = lamp.corners.map(|c| (at.p - c).normalized().dot(lamp.n));
                let shines = cosines.iter().any(|&c| c > 1e-5 || (lamp.two_sided && c < -1e-5));
                grazing += u32::from(cosines.iter().any(|c| c.abs() < 1e-2));
                assert!(
                    !shines || s.probability(&at, i as u32) > 0.0,
                    "{count}: lamp {i} at {at:?}, {cosines:?}"
                );
            }
        }
        assert!(grazing > 50, "some of them are to be seen at their edge: {grazing}");
    }
}

/// Excess variance of choosing with probabilities `q` what should be chosen with `p`: the chi-square distance.
fn excess(p: &[f32], q: &[f32]) -> f64 {
    let term = |(&p, &q): (&f32, &f32)| f64::from(p) * (f64::from(p) / f64::from(q.max(1e-12)) - 1.0);
    p.iter().zip(q).filter(|(p, _)| **p > 0.0).map(term).sum()
}

#[test]
fn the_tree_comes_close_to_weighing_each_light() {
    let (_, mut bounds) = lamps(64);
    let few = selection(&bounds);
    // A 65th that sends next to nothing makes it a tree.
    bounds.push(LightBounds { power: 1e-20, ..bounds[0] });
    let tree = selection(&bounds);
    let power = LightSelection::fixed(&bounds.iter().map(|b| b.power).collect::<Vec<_>>());
    let mut r = Numbers(17);
    let (mut by_tree, mut by_power) = (0.0, 0.0);
    for _ in 0..200 {
        let at = r.lit();
        let of = |s: &LightSelection| (0..64).map(|i| s.probability(&at, i)).collect::<Vec<_>>();
        by_tree += excess(&of(&few), &of(&tree)) / 200.0;
        by_power += excess(&of(&few), &of(&power)) / 200.0;
    }
    assert!(by_tree < 0.2 * by_power, "{by_tree}, by power {by_power}");
}

#[test]
fn lights_in_one_place_and_odd_powers_are_fine() {
    let one = LightBounds { power: 1.0, bounds: Aabb::EMPTY.grow(vec3(1.0, 2.0, 3.0)), cone: Cone::ALL };
    let mut bounds = vec![one; 100];
    bounds[7].power = 0.0;
    bounds[8].power = 1e-30;
    bounds[9].power = 1e30;
    let s = selection(&bounds);
    for p in [vec3(1.0, 2.0, 3.0), vec3(1e20, 0.0, 0.0), vec3(1.0, 2.0, 3.1)] {
        let at = LitPoint { p, n: vec3(0.0, 0.0, 1.0) };
        assert!(s.probability(&at, 7) <= 0.0);
        let sum: f32 = (0..100).map(|i| s.probability(&at, i)).sum();
        assert!((sum - 1.0).abs() < 1e-4, "{p:?}: {sum}");
        assert!(s.choose(&at, 0.999_999).is_some_and(|(_, p)| p > 0.0));
    }
}

#[test]
fn a_spot_is_left_out_where_it_does_not_shine() {
    let axis = vec3(0.0, 0.0, -1.0);
    let spot = |x: f32| LightBounds {
        power: 1.0,
        bounds: Aabb::EMPTY.grow(vec3(x, 0.0, 5.0)),
        cone: Cone { axis, normals: 0.4, emission: 0.1, two_sided: false },
    };
    let s = selection(&(0..80).map(|i| spot(i as f32)).collect::<Vec<_>>());
    let at = LitPoint { p: vec3(40.0, 0.0, 0.0), n: vec3(0.0, 0.0, 1.0) };
    for i in 0..80u32 {
        let angle = Real::atan2((i as f32 - 40.0).abs(), 5.0);
        assert!(angle > 0.5 || s.probability(&at, i) > 0.0, "light {i}");
        assert!(angle < 0.51 || s.probability(&at, i) <= 0.0, "light {i}");
    }
}
