//! One shape, drawn from many viewpoints at once, in lanes.

use sparrow_math::{InLanes, Real, Vec3, in_lanes, vec3};

use super::Viewpoint;
use crate::point::ShapeSample;

/// A shape to which directions are drawn by one text, from one viewpoint or from lanes of them.
pub(crate) trait Draw {
    /// What a viewpoint sees of the shape.
    type View<R: Real>: Copy;

    /// From a point with unit normal `n`, if directions are to follow its cosine.
    fn view<R: Real>(&self, from: Vec3<R>, n: Option<Vec3<R>>) -> Self::View<R>;
    /// A point of what is seen, by two uniform numbers.
    fn draw<R: Real>(&self, view: &Self::View<R>, u: [R; 2]) -> Drawn<R>;
    /// Density per steradian of the direction to the point `p` of the shape.
    fn pdf<R: Real>(&self, view: &Self::View<R>, p: Vec3<R>) -> R;

    /// From one viewpoint.
    #[inline]
    fn draw_one(&self, from: &Viewpoint, u: [f32; 2]) -> Drawn<f32> {
        self.draw(&self.view(from.p, from.n), u)
    }
    /// Seen from one viewpoint.
    #[inline]
    fn pdf_one(&self, from: &Viewpoint, p: Vec3<f32>) -> f32 {
        self.pdf(&self.view(from.p, from.n), p)
    }
}

/// A point of a shape.
pub(crate) struct Drawn<R> {
    pub(crate) p: Vec3<R>,
    /// Unit normal, its side chosen by the shape.
    pub(crate) n: Vec3<R>,
    /// Unit direction to it.
    pub(crate) wi: Vec3<R>,
    pub(crate) distance: R,
    /// Density per steradian.
    pub(crate) pdf: R,
}

impl<R: Real> Drawn<R> {
    /// False where the point is seen edge-on, lies at the viewpoint, or where the shape is too small a target.
    #[inline(always)]
    fn is_there(&self) -> R::Mask {
        let (most, p) = (R::of(f64::from(f32::MAX)), self.p.abs());
        let finite = p.x.le(most) & p.y.le(most) & p.z.le(most);
        self.pdf.gt(R::ZERO) & self.pdf.lt(most) & self.distance.gt(R::ZERO) & finite
    }
}

impl Drawn<f32> {
    /// `None` where nothing is there.
    #[inline]
    pub(crate) fn sample(&self, p_error: Vec3<f32>, n: Vec3<f32>) -> Option<ShapeSample> {
        self.is_there().then_some(ShapeSample {
            p: self.p,
            p_error,
            n,
            wi: self.wi,
            distance: self.distance,
            pdf: self.pdf,
        })
    }
}

/// Viewpoints from which one primitive is drawn, and room for what is drawn; all columns have the same length, a multiple of
/// [`MAX_WIDTH`](sparrow_math::MAX_WIDTH).
#[derive(Debug)]
pub struct SampleColumns<'a> {
    /// Points.
    pub from: [&'a [f32]; 3],
    /// Their unit normals: see [`Viewpoint::n`].
    pub n: [&'a [f32]; 3],
    /// Uniform numbers.
    pub u: [&'a [f32]; 2],
    /// Points of the primitive.
    pub p: [&'a mut [f32]; 3],
    /// Their normals.
    pub on: [&'a mut [f32]; 3],
    /// Unit directions.
    pub wi: [&'a mut [f32]; 3],
    /// Distances.
    pub distance: &'a mut [f32],
    /// Densities per steradian; zero where nothing was drawn.
    pub pdf: &'a mut [f32],
}

impl SampleColumns<'_> {
    /// Draws from each of the first `n` viewpoints.
    pub(crate) fn draw(&mut self, shape: &impl Draw, n: usize) {
        in_lanes(Many { shape, columns: self, n });
    }
    /// Writes the normal that the first `n` points have in common.
    pub(crate) fn set_normal(&mut self, n: usize, normal: Vec3<f32>) {
        self.on.iter_mut().zip(normal.to_array()).for_each(|(column, x)| column[..n].fill(x));
    }
    /// Writes the normal at each of the first `n` points that were drawn, from the point.
    pub(crate) fn set_normals(&mut self, n: usize, normal_at: impl Fn(Vec3<f32>) -> Vec3<f32>) {
        for k in 0..n {
            let normal = normal_at(vec3(self.p[0][k], self.p[1][k], self.p[2][k]));
            self.on.iter_mut().zip(normal.to_array()).for_each(|(column, x)| column[k] = x);
        }
    }
}

/// Viewpoints, and points of one primitive to which directions from there lead; all columns have the same length, a multiple of
/// [`MAX_WIDTH`](sparrow_math::MAX_WIDTH).
#[derive(Debug)]
pub struct PdfColumns<'a> {
    /// Points.
    pub from: [&'a [f32]; 3],
    /// Their unit normals: see [`Viewpoint::n`].
    pub n: [&'a [f32]; 3],
    /// Points of the primitive.
    pub p: [&'a [f32]; 3],
    /// Densities per steradian.
    pub pdf: &'a mut [f32],
}

impl PdfColumns<'_> {
    /// Densities from each of the first `n` viewpoints.
    pub(crate) fn fill(&mut self, shape: &impl Draw, n: usize) {
        in_lanes(Densities { shape, columns: self, n });
    }
}

struct Densities<'a, 'b, S> {
    shape: &'a S,
    columns: &'a mut PdfColumns<'b>,
    n: usize,
}

impl<S: Draw> InLanes for Densities<'_, '_, S> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let Densities { shape, columns: c, n } = self;
        for k in (0..n).step_by(R::WIDTH) {
            let view = shape.view(load::<R>(&c.from, k), Some(load(&c.n, k)));
            shape.pdf(&view, load(&c.p, k)).store(c.pdf, k);
        }
    }
}

/// Registers of viewpoints that are worked on together.
const AT_ONCE: usize = 4;

struct Many<'a, 'b, S> {
    shape: &'a S,
    columns: &'a mut SampleColumns<'b>,
    n: usize,
}

impl<S: Draw> InLanes for Many<'_, '_, S> {
    type Output = ();
    #[inline(always)]
    fn run<R: Real>(self) {
        let (c, n) = (self.columns, self.n);
        // All views of a few registers, then all points: half as many instructions depend on each other at a time.
        for first in (0..n).step_by(AT_ONCE * R::WIDTH) {
            let mut views = [self.shape.view(load::<R>(&c.from, first), Some(load(&c.n, first))); AT_ONCE];
            for (view, k) in views.iter_mut().zip((first..n).step_by(R::WIDTH)).skip(1) {
                *view = self.shape.view(load(&c.from, k), Some(load(&c.n, k)));
            }
            for (view, k) in views.iter().zip((first..n).step_by(R::WIDTH)) {
                let drawn = self.shape.draw(view, [R::load(c.u[0], k), R::load(c.u[1], k)]);
                put(&drawn, c, k);
            }
        }
    }
}

/// Writes what lanes drew.
#[inline(always)]
pub(super) fn put<R: Real>(drawn: &Drawn<R>, c: &mut SampleColumns<'_>, k: usize) {
    store(drawn.p, &mut c.p, k);
    store(drawn.n, &mut c.on, k);
    store(drawn.wi, &mut c.wi, k);
    drawn.distance.store(c.distance, k);
    drawn.pdf.only_where(drawn.is_there()).store(c.pdf, k);
}

#[inline(always)]
pub(super) fn load<R: Real>(c: &[&[f32]; 3], k: usize) -> Vec3<R> {
    vec3(R::load(c[0], k), R::load(c[1], k), R::load(c[2], k))
}

#[inline(always)]
fn store<R: Real>(v: Vec3<R>, c: &mut [&mut [f32]; 3], k: usize) {
    v.x.store(c[0], k);
    v.y.store(c[1], k);
    v.z.store(c[2], k);
}
