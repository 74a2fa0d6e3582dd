//! What strands look like: [`Style`].

use sparrow_math::Vec3;

use crate::GroomError;

/// How many strands grow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Count {
    /// So many.
    Strands(u32),
    /// So many on each unit of area.
    PerArea(f64),
}

/// The direction in which a coat lies. Only its part along the surface counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Flow {
    /// The same everywhere.
    Along(Vec3<f64>),
    /// Away from a point.
    From(Vec3<f64>),
    /// Away from the nearest point of a line between two points.
    Parting([Vec3<f64>; 2]),
    /// Around an axis through the origin, by the right hand.
    Around(Vec3<f64>),
    /// Along the first texture coordinate, where it grows.
    U,
    /// Along the second texture coordinate, where it grows.
    V,
}

/// The parameters of a groom. Lengths are those of the mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Style {
    /// How many strands grow.
    pub count: Count,
    /// Length of the longest strands, above 0.
    pub length: f64,
    /// Share by which the shortest strands are shorter, in [0, 1).
    pub length_spread: f64,
    /// Segments of each strand, 1 or more.
    pub n_segments: u16,
    /// Widths (diameters) at root and tip, 0 or more.
    pub width: [f64; 2],
    /// Where strands lean to.
    pub flow: Flow,
    /// Angle between the surface's normal and a strand at its root, in degrees, in [0, 90].
    pub lean_deg: f64,
    /// What is added to the direction of a strand, a unit vector, from root to tip.
    pub gravity: Vec3<f64>,
    /// Size of the same for a random direction of each strand, that turns by 180 degrees from root to tip; 0 or more.
    pub noise: f64,
    /// How far tips are drawn to the middle of their clump, in [0, 1].
    pub clump: f64,
    /// Strands in a clump, on average; 1 or more.
    pub clump_size: u32,
    /// Radius of the helix, 0 or more.
    pub curl: f64,
    /// Windings of the helix from root to tip, 0 or more.
    pub curl_turns: f64,
    /// Most distance that strands keep from the body, each a share of its own; 0 or more.
    pub clearance: f64,
    /// Seed of all that is random.
    pub seed: u64,
}

impl Default for Style {
    fn default() -> Style {
        Style {
            count: Count::Strands(10_000),
            length: 0.1,
            length_spread: 0.2,
            n_segments: 8,
            width: [1e-3, 2e-4],
            flow: Flow::Along(Vec3 { x: 0.0, y: -1.0, z: 0.0 }),
            lean_deg: 0.0,
            gravity: Vec3::splat(0.0),
            noise: 0.0,
            clump: 0.0,
            clump_size: 40,
            curl: 0.0,
            curl_turns: 3.0,
            clearance: 0.0,
            seed: 0,
        }
    }
}

impl Style {
    /// # Errors
    /// The first number out of its range.
    pub(crate) fn check(&self) -> Result<(), GroomError> {
        let (count, least) = match self.count {
            Count::Strands(n) => (f64::from(n), 1.0),
            Count::PerArea(density) => (density, f64::MIN_POSITIVE),
        };
        let flow = match self.flow {
            Flow::Along(v) | Flow::Around(v) => v.length(),
            Flow::From(p) => p.length() + 1.0,
            Flow::Parting([a, b]) => (b - a).length(),
            Flow::U | Flow::V => 1.0,
        };
        let most = f64::MAX;
        let ranges = [
            ("the number of strands", count, [least, most], "above 0"),
            ("the length", self.length, [f64::MIN_POSITIVE, most], "above 0"),
            ("the spread of lengths", self.length_spread, [0.0, 1.0 - f64::EPSILON], "from 0 to below 1"),
            ("the number of segments", f64::from(self.n_segments), [1.0, most], "from 1 to 65535"),
            ("the width at the root", self.width[0], [0.0, most], "not below 0"),
            ("the width at the tip", self.width[1], [0.0, most], "not below 0"),
            ("the length of the flow", flow, [f64::MIN_POSITIVE, most], "above 0"),
            ("the lean", self.lean_deg, [0.0, 90.0], "from 0 to 90"),
            ("the length of gravity", self.gravity.length(), [0.0, most], "that is finite"),
            ("the noise", self.noise, [0.0, most], "not below 0"),
            ("the clump", self.clump, [0.0, 1.0], "from 0 to 1"),
            ("the size of clumps", f64::from(self.clump_size), [1.0, most], "of 1 or more"),
            ("the curl", self.curl, [0.0, most], "not below 0"),
            ("the number of windings", self.curl_turns, [0.0, most], "not below 0"),
            ("the clearance", self.clearance, [0.0, most], "not below 0"),
        ];
        match ranges.into_iter().find(|(_, value, [lo, hi], _)| !(lo..=hi).contains(&value)) {
            Some((name, value, _, wanted)) => Err(GroomError::OutOfRange { name, value, wanted }),
            None => Ok(()),
        }
    }
}
