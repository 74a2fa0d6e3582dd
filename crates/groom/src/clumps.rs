//! Which strands belong together.

use sparrow_math::Vec3;

use crate::axis::Axis;

/// Every so-many-th strand leads a clump; others follow the leader whose root is nearest.
pub(crate) struct Clumps {
    /// Roots of the leaders in the order of x, with their places among all strands.
    guides: Vec<(Vec3<f64>, usize)>,
}

impl Clumps {
    pub(crate) fn new(axes: &[Axis], size: u32) -> Clumps {
        let leaders = axes.iter().enumerate().step_by(size as usize);
        let mut guides: Vec<_> = leaders.map(|(i, a)| (a.root(), i)).collect();
        guides.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
        Clumps { guides }
    }

    /// The leader nearest to a root, searched from its x outwards.
    pub(crate) fn guide(&self, root: Vec3<f64>) -> usize {
        let middle = self.guides.partition_point(|g| g.0.x < root.x);
        let (before, after) = self.guides.split_at(middle);
        let mut best = (f64::INFINITY, 0);
        for side in
            [&mut before.iter().rev() as &mut dyn Iterator<Item = &(Vec3<f64>, usize)>, &mut after.iter()]
        {
            for &(p, i) in side {
                let away = (p.x - root.x) * (p.x - root.x);
                if away > best.0 {
                    break;
                }
                let distance2 = (p - root).length2();
                if distance2 < best.0 {
                    best = (distance2, i);
                }
            }
        }
        best.1
    }
}

#[cfg(test)]
mod tests {
    use sparrow_stats::Random;

    use super::*;

    #[test]
    fn the_nearest_leader_is_found() {
        let mut random = Random::new(3);
        let guides: Vec<Vec3<f64>> = (0..200).map(|_| random.direction().v()).collect();
        let mut sorted: Vec<_> = guides.iter().copied().zip(0..).collect();
        sorted.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
        let clumps = Clumps { guides: sorted };
        for _ in 0..500 {
            let p = random.direction().v();
            let distance = |i: usize| (guides[i] - p).length();
            let found = distance(clumps.guide(p));
            assert!((0..guides.len()).all(|i| distance(i) >= found), "{p:?}");
        }
    }
}
