//! Hair and fur grown on meshes: triangles in, strands out; no files.
//!
//! [`grow`] spreads roots evenly over the area of a [`Surface`] and grows a strand from each as a [`Style`] says:
//!
//! 1. its axis starts along the normal, leaning towards the flow, and is bent by noise and gravity ([`Style::lean_deg`],
//!    [`Style::noise`], [`Style::gravity`]);
//! 2. axes of a clump are drawn together towards their tips ([`Style::clump`]);
//! 3. each is wound into a helix ([`Style::curl`]).
//!
//! Strands stay outside of the body that is given beside the surface, at distances up to [`Style::clearance`]: steps of the axis that
//! would enter it turn along it, and what clumps and curls move into it is moved out again. That holds for the points; between two of
//! them a strand is drawn straight or by a spline, so that the clearance has to cover what the body rises over such a chord. Of
//! each other strands know nothing.
//!
//! Every strand has random numbers of its own, from the seed and its place in the list, so that the same surface and style
//! give the same bits everywhere.

mod axis;
mod body;
mod clumps;
mod curl;
mod error;
mod style;
mod surface;

use sparrow_math::{Real, Vec3, vec3};
use sparrow_stats::Random;

pub use error::GroomError;
pub use style::{Count, Flow, Style};
pub use surface::Surface;

use axis::{Axis, Space};
use body::Body;
use clumps::Clumps;
use curl::curled;
use surface::Scalp;

/// Most points of a groom, as many as a scene holds in one shape.
pub const MAX_POINTS: usize = 1 << 28;

/// Strands of equal numbers of points, one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Groom {
    /// Points on the strands from root to tip, with widths: `x y z width`.
    pub points: Vec<[f32; 4]>,
    /// Segments of each strand, which has one point more.
    pub n_segments: u16,
}

impl Groom {
    /// The strands.
    pub fn strands(&self) -> impl ExactSizeIterator<Item = &[[f32; 4]]> {
        self.points.chunks_exact(usize::from(self.n_segments) + 1)
    }
}

/// Grows strands from `surface`, outside of `body`: closed meshes, or several that together are closed, or none.
///
/// # Errors
/// A style out of range, a mesh that nothing can grow on, or more points than [`MAX_POINTS`].
pub fn grow(surface: &Surface, body: &[Surface<'_>], style: &Style) -> Result<Groom, GroomError> {
    style.check()?;
    let body = Body::new(body)?;
    let scalp = Scalp::new(surface, &style.flow)?;
    let n = match style.count {
        Count::Strands(n) => f64::from(n),
        Count::PerArea(density) => (density * scalp.area()).round(),
    };
    if n < 1.0 {
        return Err(GroomError::NoStrands { area: scalp.area() });
    }
    let most = MAX_POINTS / (usize::from(style.n_segments) + 1);
    if n > most as f64 {
        return Err(GroomError::TooMany { n, most });
    }
    let n = n as usize;
    let roots: Vec<_> = (0..n).map(|i| scalp.root(i, n, &mut random(style.seed, i, Use::Root))).collect();
    let spaces: Vec<_> = (0..n)
        .map(|i| Space { body: &body, keep: style.clearance * random(style.seed, i, Use::Space).uniform() })
        .collect();
    let axes = roots
        .iter()
        .zip(&spaces)
        .enumerate()
        .map(|(i, (root, space))| Axis::grow(root, style, space, &mut random(style.seed, i, Use::Axis)))
        .collect::<Vec<_>>();
    let clumps = (style.clump > 0.0).then(|| Clumps::new(&axes, style.clump_size));
    let mut points = Vec::with_capacity(n * (usize::from(style.n_segments) + 1));
    for (i, axis) in axes.iter().enumerate() {
        let guide = clumps.as_ref().map_or(i, |c| c.guide(axis.root()));
        let drawn = axis.drawn_to(&axes[guide], style.clump);
        // A clump is wound as one.
        let phase = random(style.seed, guide, Use::Curl).within(0.0, core::f64::consts::TAU);
        let wound = curled(&drawn, style, phase);
        let last = usize::from(style.n_segments);
        for (k, p) in wound.into_iter().enumerate() {
            let p = spaces[i].free(p, k, last).unwrap_or(p);
            let width = style.width[0].lerp(style.width[1], k as f64 / last as f64);
            let point = [p.x, p.y, p.z, width].map(|v| v as f32);
            if !point.iter().all(|v| v.is_finite()) {
                return Err(GroomError::TooLarge);
            }
            points.push(point);
        }
    }
    Ok(Groom { points, n_segments: style.n_segments })
}

/// What random numbers of a strand are for.
#[derive(Clone, Copy)]
enum Use {
    Root,
    Axis,
    Curl,
    Space,
}

/// The random numbers of strand `i` for one use.
fn random(seed: u64, i: usize, to: Use) -> Random {
    let of_seed = Random::new(seed).bits();
    let of_strand = Random::new(of_seed ^ (4 * i as u64 + to as u64)).bits();
    Random::new(of_strand)
}

/// The unit vector along `v`; +y where `v` has no length.
fn unit_or_up(v: Vec3<f64>) -> Vec3<f64> {
    let length = v.length();
    if length > 0.0 && length.is_finite() { v / length } else { vec3(0.0, 1.0, 0.0) }
}

#[cfg(test)]
mod tests;
