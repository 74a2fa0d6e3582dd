//! The section of a fibre: [`Section`].

/// An ellipse with the semi-axes `y = 1` and `z = b`, across the fibre.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    /// Semi-axis along z, in units of that along y.
    pub b: f64,
}

/// A point or direction in the plane across the fibre.
pub(crate) type Flat = [f64; 2];

pub(crate) fn dot(a: Flat, b: Flat) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

impl Section {
    /// A circle.
    pub const CIRCLE: Section = Section { b: 1.0 };

    /// Half of the width seen from the azimuth `phi`.
    pub fn half_width(&self, [cos, sin]: Flat) -> f64 {
        (sin * sin + (self.b * cos).powi(2)).sqrt()
    }
    /// Outward unit normal at a point of the section.
    pub(crate) fn normal(&self, p: Flat) -> Flat {
        let n = [p[0], p[1] / (self.b * self.b)];
        let l = dot(n, n).sqrt();
        [n[0] / l, n[1] / l]
    }
    /// Where a line from `p` along the unit direction `d` crosses the section scaled by `scale`: both distances, if any.
    pub(crate) fn crossings(&self, p: Flat, d: Flat, scale: f64) -> Option<[f64; 2]> {
        let b2 = self.b * self.b;
        let a = d[0] * d[0] + d[1] * d[1] / b2;
        let h = p[0] * d[0] + p[1] * d[1] / b2;
        let c = p[0] * p[0] + p[1] * p[1] / b2 - scale * scale;
        let root = h * h - a * c;
        (root >= 0.0).then(|| {
            let root = root.sqrt();
            [(-h - root) / a, (-h + root) / a]
        })
    }
    /// The lit point of the ray at the offset `h` (of the half width, to the side of `phi + 90` degrees), from the azimuth `phi`.
    pub(crate) fn entry(&self, phi: Flat, h: f64) -> Flat {
        let side = [-phi[1], phi[0]];
        let w = self.half_width(phi);
        let far = [side[0] * h * w, side[1] * h * w];
        let t = self.crossings(far, phi, 1.0).map_or(0.0, |t| t[1]);
        [far[0] + t * phi[0], far[1] + t * phi[1]]
    }
}
