//! Meshes of bilinear patches whose vertices move: [`DeformingPatches`].

use sparrow_math::{Aabb, Vec3};

use super::{Bilinear, Patches, hit_bilinear};
use crate::bvh::{Kind, MotionBvh, Others, RawHit};
use crate::deforming::corners_at_ends;
use crate::lerp::Lerp;
use crate::point::SurfacePoint;
use crate::progress::Progress;
use crate::ray::{Hit, Ray};
use crate::shape::BilinearMesh;

/// A mesh with vertices at both ends of its motion, ready to be asked. Every patch is met as a curved one, even where it is flat.
#[derive(Debug)]
pub(crate) struct DeformingPatches {
    mesh: BilinearMesh,
    flip: bool,
    tree: MotionBvh,
    dropped: usize,
}

/// Corners at both ends, if they exist and are finite.
fn usable(mesh: &BilinearMesh, prim: u32) -> Option<[[[f32; 3]; 4]; 2]> {
    corners_at_ends(&[&mesh.p, &mesh.p_end], mesh.indices.get(prim as usize)?)
}

impl DeformingPatches {
    /// Takes a mesh with `p_end` as long as `p`; other lists of a length that does not fit are dropped.
    pub(crate) fn new(mut mesh: BilinearMesh, flip: bool, progress: &Progress) -> DeformingPatches {
        let n = mesh.p.len();
        for list in [&mut mesh.n, &mut mesh.n_end] {
            if list.len() != n {
                *list = Vec::new();
            }
        }
        if mesh.uv.len() != n {
            mesh.uv = Vec::new();
        }
        let all = mesh.indices.len() as u32;
        let ids: Vec<u32> = (0..all).filter(|&i| usable(&mesh, i).is_some()).collect();
        let boxes = |i: u32| {
            let corners = usable(&mesh, i).unwrap_or([[[f32::NAN; 3]; 4]; 2]);
            corners.map(|p| p.into_iter().fold(Aabb::EMPTY, |b, p| b.grow(p.into())))
        };
        let none = |_| [[[f32::NAN; 3]; 3]; 2];
        let tree = MotionBvh::build_motion(Kind::Others, &ids, boxes, none, progress);
        let dropped = all as usize - ids.len();
        DeformingPatches { mesh, flip, tree, dropped }
    }
    pub(crate) fn len(&self) -> usize {
        self.mesh.indices.len()
    }
    pub(crate) fn dropped(&self) -> usize {
        self.dropped
    }
    pub(crate) fn tree(&self) -> &MotionBvh {
        &self.tree
    }
    pub(crate) fn bytes(&self) -> usize {
        let m = &self.mesh;
        let triples = [&m.p, &m.p_end, &m.n, &m.n_end];
        12 * triples.iter().map(|list| list.len()).sum::<usize>() + 8 * m.uv.len() + 16 * m.indices.len()
    }
    pub(crate) fn area(&self, prim: u32) -> f32 {
        let p = usable(&self.mesh, prim).map(|[start, _]| start.map(Vec3::from));
        p.map_or(0.0, |p| Bilinear::new(p).area() as f32)
    }
    fn corners_at<const N: usize>(
        &self,
        prim: u32,
        [start, end]: [&[[f32; N]]; 2],
        time: f32,
    ) -> [[f32; N]; 4] {
        let lerp = Lerp::at(time);
        self.mesh.indices[prim as usize].map(|i| lerp.array(start[i as usize], end[i as usize]))
    }
    /// One patch as it stands at a time, as a mesh of its own.
    fn at(&self, prim: u32, time: f32) -> Patches {
        let m = &self.mesh;
        let n_end = if m.n_end.is_empty() { &m.n } else { &m.n_end };
        let n = if m.n.is_empty() { Vec::new() } else { self.corners_at(prim, [&m.n, n_end], time).into() };
        let uv = if m.uv.is_empty() { Vec::new() } else { self.corners_at(prim, [&m.uv, &m.uv], 0.0).into() };
        let p = self.corners_at(prim, [&m.p, &m.p_end], time).into();
        let one = BilinearMesh { p, indices: vec![[0, 1, 2, 3]], n, uv, ..BilinearMesh::default() };
        Patches::new(one, self.flip)
    }
    pub(crate) fn surface(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let point = self.at(hit.prim, ray.time).surface(&Hit { prim: 0, ..*hit });
        SurfacePoint { prim: hit.prim, ..point }
    }
    pub(crate) fn normal_derivatives(&self, ray: &Ray, hit: &Hit) -> (Vec3<f32>, Vec3<f32>) {
        self.at(hit.prim, ray.time).normal_derivatives(&Hit { prim: 0, ..*hit })
    }
}

impl Others for DeformingPatches {
    fn hit(&self, prim: u32, ray: &Ray, t_max: f32, found: &mut impl FnMut(RawHit) -> f32) -> f32 {
        let p = self.corners_at(prim, [&self.mesh.p, &self.mesh.p_end], ray.time);
        hit_bilinear(&Bilinear::new(p.map(Vec3::from)), prim, ray, t_max, found)
    }
}
