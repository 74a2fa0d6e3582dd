//! Triangle meshes whose vertices move: [`DeformingTriangles`].

use sparrow_math::{Aabb, Vec3};

use super::{Corners, double_area, pick, texture_coordinates};
use crate::bvh::{Kind, MotionBvh};
use crate::deforming::corners_at_ends;
use crate::lerp::Lerp;
use crate::point::SurfacePoint;
use crate::progress::Progress;
use crate::ray::{Hit, Ray};
use crate::shape::TriangleMesh;

/// A mesh with vertices at both ends of its motion, ready to be asked.
#[derive(Debug)]
pub(crate) struct DeformingTriangles {
    mesh: TriangleMesh,
    flip: bool,
    tree: MotionBvh,
    dropped: usize,
}

/// Corners at both ends, if they exist and are finite. A triangle may lose its area while it moves.
fn usable(mesh: &TriangleMesh, prim: u32) -> Option<[[[f32; 3]; 3]; 2]> {
    corners_at_ends(&[&mesh.p, &mesh.p_end], mesh.indices.get(prim as usize)?)
}

impl DeformingTriangles {
    /// Takes a mesh with `p_end` as long as `p`; other lists of a length that does not fit are dropped.
    pub(crate) fn new(mut mesh: TriangleMesh, flip: bool, progress: &Progress) -> DeformingTriangles {
        let n = mesh.p.len();
        for list in [&mut mesh.n, &mut mesh.n_end, &mut mesh.s] {
            if list.len() != n {
                *list = Vec::new();
            }
        }
        if mesh.uv.len() != n {
            mesh.uv = Vec::new();
        }
        let all = mesh.indices.len() as u32;
        let ids: Vec<u32> = (0..all).filter(|&i| usable(&mesh, i).is_some()).collect();
        let corners = |i: u32| usable(&mesh, i).unwrap_or([[[f32::NAN; 3]; 3]; 2]);
        let boxes = |i: u32| corners(i).map(|p| p.into_iter().fold(Aabb::EMPTY, |b, p| b.grow(p.into())));
        let tree = MotionBvh::build_motion(Kind::Triangles, &ids, boxes, corners, progress);
        let dropped = all as usize - ids.len();
        DeformingTriangles { mesh, flip, tree, dropped }
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
        let triples = [&m.p, &m.p_end, &m.n, &m.n_end, &m.s];
        12 * (triples.iter().map(|list| list.len()).sum::<usize>() + m.indices.len()) + 8 * m.uv.len()
    }
    pub(crate) fn area(&self, prim: u32) -> f32 {
        let p = usable(&self.mesh, prim).map(|[start, _]| start.map(Vec3::from));
        p.map_or(0.0, |p| (0.5 * double_area(p).length()) as f32)
    }
    fn corners_at(&self, prim: u32, time: f32) -> Corners {
        let (m, at) = (&self.mesh, self.mesh.indices[prim as usize]);
        let between = |start: &[[f32; 3]], end: &[[f32; 3]]| {
            let (start, end) = (pick(start, at), pick(end, at));
            let lerp = Lerp::at(time);
            [0, 1, 2].map(|i: usize| Vec3::from(lerp.array(start[i].to_array(), end[i].to_array())))
        };
        let n_end = if m.n_end.is_empty() { &m.n } else { &m.n_end };
        Corners {
            p: between(&m.p, &m.p_end),
            n: (!m.n.is_empty()).then(|| between(&m.n, n_end)),
            s: (!m.s.is_empty()).then(|| pick(&m.s, at)),
            uv: texture_coordinates(&m.uv, at),
        }
    }
    pub(crate) fn surface(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        self.corners_at(hit.prim, ray.time).surface(self.flip, hit)
    }
    pub(crate) fn normal_derivatives(&self, ray: &Ray, hit: &Hit) -> (Vec3<f32>, Vec3<f32>) {
        self.corners_at(hit.prim, ray.time).normal_derivatives()
    }
}
