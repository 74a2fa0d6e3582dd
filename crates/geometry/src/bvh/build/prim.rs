//! What a tree is built from: [`PrimRef`], and boxes in registers, [`Box4`].

use sparrow_math::{Aabb, Vec3};
use wide::f32x4;

use super::super::node::Kind;

/// A box in two registers; the fourth lanes are not part of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Box4 {
    pub(crate) lo: f32x4,
    pub(crate) hi: f32x4,
}

impl Box4 {
    pub(crate) const EMPTY: Box4 =
        Box4 { lo: f32x4::new([f32::INFINITY; 4]), hi: f32x4::new([f32::NEG_INFINITY; 4]) };

    #[inline(always)]
    pub(crate) fn of(b: &Aabb) -> Box4 {
        let wide = |v: Vec3<f32>| f32x4::new([v.x, v.y, v.z, 0.0]);
        Box4 { lo: wide(b.lo), hi: wide(b.hi) }
    }
    #[inline(always)]
    pub(crate) fn union(self, o: Box4) -> Box4 {
        Box4 { lo: self.lo.fast_min(o.lo), hi: self.hi.fast_max(o.hi) }
    }
    #[inline(always)]
    pub(super) fn intersection(self, o: Box4) -> Box4 {
        Box4 { lo: self.lo.fast_max(o.lo), hi: self.hi.fast_min(o.hi) }
    }
    #[inline(always)]
    pub(crate) fn grow(self, p: f32x4) -> Box4 {
        Box4 { lo: self.lo.fast_min(p), hi: self.hi.fast_max(p) }
    }
    /// Half of the surface area; 0 where it is empty.
    #[inline(always)]
    pub(crate) fn half_area(self) -> f32 {
        let [x, y, z, _] = (self.hi - self.lo).to_array();
        if x >= 0.0 && y >= 0.0 && z >= 0.0 { x * y + y * z + z * x } else { 0.0 }
    }
    pub(super) fn to_aabb(self) -> Aabb {
        let ([x, y, z, _], [u, v, w, _]) = (self.lo.to_array(), self.hi.to_array());
        Aabb { lo: [x, y, z].into(), hi: [u, v, w].into() }
    }
}

/// A primitive on its way into the tree: its box, and in the fourth lanes its number and kind.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub(crate) struct PrimRef {
    lo: [f32; 4],
    hi: [f32; 4],
}

/// Makes a number of less than 30 bits a normal float: arithmetic on others may be slow.
const NORMAL: u32 = 1 << 30;

/// A box, widened by what a triangle test may err that starts from far corners.
pub(super) fn widened(b: Aabb) -> Aabb {
    let pad = Vec3::splat(4.0 * f32::EPSILON * b.extent().max_component());
    Aabb { lo: b.lo - pad, hi: b.hi + pad }
}

impl PrimRef {
    /// In the place of one that cannot be hit. It goes into no tree.
    pub(crate) const NONE: PrimRef = PrimRef { lo: [0.0; 4], hi: [0.0; 4] };

    pub(crate) fn is_none(&self) -> bool {
        self.lo[3].to_bits() & NORMAL == 0
    }

    /// A primitive with its box, [`widened`].
    pub(crate) fn new(id: u32, b: Aabb, kind: Kind) -> PrimRef {
        let b = widened(b);
        PrimRef::pack(b.lo.to_array(), b.hi.to_array(), id, kind)
    }
    fn pack(lo: [f32; 3], hi: [f32; 3], id: u32, kind: Kind) -> PrimRef {
        let with = |[x, y, z]: [f32; 3], bits: u32| [x, y, z, f32::from_bits(bits | NORMAL)];
        PrimRef { lo: with(lo, id), hi: with(hi, u32::from(kind == Kind::Others)) }
    }
    /// The same primitive with the part of its box that lies in `part`.
    pub(super) fn clipped(&self, part: Box4) -> PrimRef {
        let b = self.bounds().intersection(part).to_aabb();
        PrimRef::pack(b.lo.to_array(), b.hi.to_array(), self.id(), self.kind())
    }
    #[inline(always)]
    pub(super) fn id(&self) -> u32 {
        self.lo[3].to_bits() & !NORMAL
    }
    #[inline(always)]
    pub(super) fn kind(&self) -> Kind {
        if self.hi[3].to_bits() & !NORMAL == 0 { Kind::Triangles } else { Kind::Others }
    }
    #[inline(always)]
    pub(super) fn bounds(&self) -> Box4 {
        Box4 { lo: f32x4::new(self.lo), hi: f32x4::new(self.hi) }
    }
    /// The box.
    pub(crate) fn aabb(&self) -> Aabb {
        self.bounds().to_aabb()
    }
    /// Twice the centre of the box.
    #[inline(always)]
    pub(super) fn center2(&self) -> f32x4 {
        f32x4::new(self.lo) + f32x4::new(self.hi)
    }
}
