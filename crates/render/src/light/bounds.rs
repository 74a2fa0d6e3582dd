//! What is known of a light, or of a group of them, before it is sampled.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use sparrow_math::{Aabb, Real, Vec3, vec3};

/// Directions in which light leaves: a cone of normals, and how far beyond them. [ContyKulla2018, section 4.1]
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cone {
    /// Middle of the normals, unit.
    pub(super) axis: Vec3<f64>,
    /// Largest angle of a normal to the axis, `theta_o`, in rad.
    pub(super) normals: f64,
    /// Largest angle of light to its normal, `theta_e`, in rad.
    pub(super) emission: f64,
    /// Light leaves in the opposite directions too.
    pub(super) two_sided: bool,
}

impl Cone {
    /// Light leaves in all directions.
    pub(super) const ALL: Cone =
        Cone { axis: vec3(0.0, 0.0, 1.0), normals: PI, emission: FRAC_PI_2, two_sided: false };

    /// A flat emitter.
    pub(super) fn facing(n: Vec3<f32>, two_sided: bool) -> Cone {
        Cone { axis: n.to_f64().normalized(), normals: 0.0, emission: FRAC_PI_2, two_sided }
    }

    /// A cone around both. [ContyKulla2018, algorithm 1]
    fn union(self, o: Cone) -> Cone {
        let (a, b) = if self.normals >= o.normals { (self, o) } else { (o, self) };
        let emission = a.emission.max(b.emission);
        let whole = Cone { emission, two_sided: a.two_sided || b.two_sided, ..Cone::ALL };
        let cone = |axis, normals| Cone { axis, normals, ..whole };
        if a.normals >= PI {
            return whole;
        }
        // What has two sides may be turned around.
        let flip = (a.two_sided || b.two_sided) && a.axis.dot(b.axis) < 0.0;
        let axis = if flip { -b.axis } else { b.axis };
        let between = Real::atan2(a.axis.cross(axis).length(), a.axis.dot(axis));
        if between + b.normals <= a.normals {
            return cone(a.axis, a.normals);
        }
        let normals = (a.normals + between + b.normals) / 2.0;
        if normals >= PI {
            return whole;
        }
        let turn = normals - a.normals;
        let turned = a.axis * Real::sin(between - turn) + axis * Real::sin(turn);
        if turned.length2() > 1e-12 { cone(turned.normalized(), normals) } else { whole }
    }

    /// Solid angle of emission, weighted by its cosine: `M_Omega` of [ContyKulla2018, section 4.4].
    fn measure(&self) -> f64 {
        let (o, w) = (self.normals, (self.normals + self.emission).min(PI));
        let (sin_o, cos_o) = Real::sin_cos(o);
        TAU * (1.0 - cos_o) + FRAC_PI_2 * (2.0 * w * sin_o - Real::cos(o - 2.0 * w) - 2.0 * o * sin_o + cos_o)
    }
}

/// A light, or several, seen from afar.
#[derive(Clone, Copy, Debug)]
pub(super) struct LightBounds {
    /// Radiant power, up to a factor common to all lights.
    pub(super) power: f32,
    /// Where it is; empty for infinite lights.
    pub(super) bounds: Aabb,
    /// Where its light goes.
    pub(super) cone: Cone,
}

impl LightBounds {
    /// Both together.
    pub(super) fn union(&self, o: &LightBounds) -> LightBounds {
        LightBounds {
            power: self.power + o.power,
            bounds: self.bounds.union(o.bounds),
            cone: self.cone.union(o.cone),
        }
    }

    /// What a group costs whose lights are told apart no further: power, times solid angle, times the square of its size.
    pub(super) fn cost(&self) -> f64 {
        f64::from(self.power) * self.cone.measure() * f64::from(self.bounds.radius()).sqr()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_union_holds_the_normals_of_both() {
        let unit = |i: u32| {
            let (z, phi) = (f64::from(i % 19) / 9.0 - 1.0, f64::from(i) * 2.4);
            let r = (1.0 - z * z).max(0.0).sqrt();
            vec3(r * Real::cos(phi), r * Real::sin(phi), z)
        };
        for i in 0..200u32 {
            let two_sided = i.is_multiple_of(3);
            let cone = |k: u32| Cone {
                axis: unit(k),
                normals: f64::from(k % 7) * 0.2,
                emission: 1.0,
                two_sided: two_sided && k == i,
            };
            let (a, b) = (cone(i), cone(7 * i + 3));
            let both = a.union(b);
            assert!((both.axis.length() - 1.0).abs() < 1e-9 && both.two_sided == two_sided);
            for part in [a, b] {
                let cos = both.axis.dot(part.axis);
                let cos = if two_sided { cos.abs() } else { cos };
                let reach = Real::acos(cos.min(1.0)) + part.normals;
                assert!(reach <= both.normals + 1e-6 || both.normals >= PI, "{a:?} {b:?}: {both:?}");
            }
        }
    }

    /// One flat emitter, weighted by its cosine: pi. All directions: 4 pi of them.
    #[test]
    fn measures_of_one_normal_and_of_all() {
        let flat = Cone::facing(vec3(0.0, 1.0, 0.0), false);
        assert!((flat.measure() - PI).abs() < 1e-12 && (Cone::ALL.measure() - 4.0 * PI).abs() < 1e-9);
    }
}
