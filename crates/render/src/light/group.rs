//! Grouping lights by place, direction and power: the binary tree below [`LightTree`](super::tree::LightTree).

use sparrow_math::{Aabb, Real, Vec3};

use super::bounds::LightBounds;

/// Parts of an axis between which a group may be split.
const N_BUCKETS: usize = 12;

/// A light by its index.
type Listed = (u32, LightBounds);

/// One light, or two groups.
pub(super) struct Grouped {
    pub(super) bounds: LightBounds,
    /// [`LightBounds::cost`]
    pub(super) cost: f64,
    /// Index of the light, where it is one.
    pub(super) light: u32,
    pub(super) parts: Option<Box<(Grouped, Grouped)>>,
}

/// Groups lights, splitting where the surface area orientation heuristic is least; none where there are none.
/// [ContyKulla2018, section 4.4]
pub(super) fn group(lights: &[Listed]) -> Option<Grouped> {
    if let [(light, bounds)] = lights {
        return Some(Grouped { bounds: *bounds, cost: bounds.cost(), light: *light, parts: None });
    }
    let (a, b) = split(lights);
    let (a, b) = (group(&a)?, group(&b)?);
    let bounds = a.bounds.union(&b.bounds);
    Some(Grouped { bounds, cost: bounds.cost(), light: u32::MAX, parts: Some(Box::new((a, b))) })
}

/// What a bucket holds, cheaply: a box around the axes of emission stands for their cone.
#[derive(Clone, Copy)]
struct Bucket {
    power: f64,
    bounds: Aabb,
    axes: Aabb,
    all_around: bool,
}

impl Bucket {
    const EMPTY: Bucket = Bucket { power: 0.0, bounds: Aabb::EMPTY, axes: Aabb::EMPTY, all_around: false };

    fn of(l: &LightBounds) -> Bucket {
        // Of what has two sides, the axis that points up.
        let a = l.cone.axis;
        let down = a.z < 0.0 || (a.z <= 0.0 && (a.y < 0.0 || (a.y <= 0.0 && a.x < 0.0)));
        let axis = if l.cone.two_sided && down { -a } else { a };
        Bucket {
            power: l.power.into(),
            bounds: l.bounds,
            axes: Aabb::EMPTY.grow(axis.to_f32()),
            all_around: l.cone.normals > core::f64::consts::FRAC_PI_2,
        }
    }
    fn union(&self, o: &Bucket) -> Bucket {
        Bucket {
            power: self.power + o.power,
            bounds: self.bounds.union(o.bounds),
            axes: self.axes.union(o.axes),
            all_around: self.all_around || o.all_around,
        }
    }
    /// As [`LightBounds::cost`]; between pi, one normal, and 4 pi, all of them.
    fn cost(&self) -> f64 {
        if !(self.power > 0.0) {
            return 0.0;
        }
        // Unit vectors in a ball of radius h around c lie within asin(h / |c|) of it.
        let (c, h) = (self.axes.center().to_f64().length(), f64::from(self.axes.radius()));
        let versine = if self.all_around || h >= c { 2.0 } else { 1.0 - (1.0 - (h / c).sqr()).sqrt() };
        self.power * (1.0 + 1.5 * versine) * f64::from(self.bounds.radius()).sqr()
    }
}

fn component(v: Vec3<f32>, axis: usize) -> f32 {
    v.to_array()[axis]
}

/// Two groups of at least two lights; neither is empty.
fn split(lights: &[Listed]) -> (Vec<Listed>, Vec<Listed>) {
    let centers = lights.iter().fold(Aabb::EMPTY, |b, l| b.grow(l.1.bounds.center()));
    let extent = centers.extent();
    let bucket_of = |l: &LightBounds, axis: usize| {
        let low = component(centers.center(), axis) - 0.5 * component(extent, axis);
        let part = (component(l.bounds.center(), axis) - low) / component(extent, axis);
        ((part * N_BUCKETS as f32) as usize).min(N_BUCKETS - 1)
    };
    let mut best = (f64::INFINITY, 0, 0);
    for axis in (0..3).filter(|&a| component(extent, a) > 0.0) {
        let mut buckets = [Bucket::EMPTY; N_BUCKETS];
        for (_, l) in lights {
            let b = &mut buckets[bucket_of(l, axis)];
            *b = b.union(&Bucket::of(l));
        }
        // Long thin groups are split across.
        let slenderness = f64::from(extent.max_component() / component(extent, axis));
        for at in 1..N_BUCKETS {
            let sum = |part: &[Bucket]| part.iter().fold(Bucket::EMPTY, |a, b| a.union(b)).cost();
            let cost = slenderness * (sum(&buckets[..at]) + sum(&buckets[at..]));
            if cost < best.0 {
                best = (cost, axis, at);
            }
        }
    }
    let (a, b): (Vec<_>, Vec<_>) = lights.iter().partition(|l| bucket_of(&l.1, best.1) < best.2);
    if a.is_empty() || b.is_empty() {
        // All in one place.
        let (a, b) = lights.split_at(lights.len() / 2);
        return (a.to_vec(), b.to_vec());
    }
    (a, b)
}
