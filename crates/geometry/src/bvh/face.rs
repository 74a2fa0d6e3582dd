//! Parallelograms and triangles in numbers that tell quickly which rays miss them: [`Face`] and [`Wall`].

use sparrow_math::{Vec3, vec3};

use super::packet::RAYS;

/// A number, once for each ray of a packet.
pub(crate) type Repeated = [f32; RAYS];
/// A vector, likewise.
pub(crate) type RepeatedVector = [Repeated; 3];

fn repeated(v: Vec3<f64>) -> RepeatedVector {
    v.to_f32().to_array().map(|x| [x; RAYS])
}

/// What is known of a parallelogram, or the half of it where its two coordinates add up to nothing positive.
///
/// Coordinates are linear, zero in the middle and one on two sides. Numbers are rounded; the margins say how far that, and all
/// roundings of the test of a triangle, may move what is compared.
#[derive(Clone, Debug)]
pub(crate) struct Extent {
    /// Margins of the coordinates: times half a unit in the last place, the distance of anything from the ray's origin, and the length of
    /// its direction.
    pub(crate) margins: [Repeated; 2],
    /// Margin of the distance from the plane: times half a unit in the last place and the distance of anything from the ray's origin.
    pub(crate) depth: Repeated,
    pub(crate) center: [f32; 3],
    /// The longer diagonal.
    pub(crate) across: f32,
    /// How far corners lie beside the plane.
    pub(crate) bent: f32,
    /// The place of the triangle; of a parallelogram's two, of the one whose first coordinate is the larger, and the next is the other's.
    pub(crate) place: u32,
}

/// One that lies anyhow.
#[derive(Clone, Debug)]
pub(crate) struct Face {
    pub(crate) extent: Extent,
    /// Unit normal.
    pub(crate) normal: RepeatedVector,
    /// The distance of its plane from the origin.
    pub(crate) level: Repeated,
    /// What the ray's moment, the product of its direction and origin, is multiplied with to give coordinates; and its direction, to be taken away.
    pub(crate) of_moment: [RepeatedVector; 2],
    pub(crate) of_direction: [RepeatedVector; 2],
}

/// One whose plane and sides lie along the axes.
#[derive(Clone, Debug)]
pub(crate) struct Wall {
    /// The axis of the normal, and those of the first and the second coordinate.
    pub(crate) axes: [Axis; 3],
    /// The centre, along these.
    pub(crate) center: RepeatedVector,
    /// Coordinates of steps along the last two.
    pub(crate) scales: [Repeated; 2],
    /// The larger margin of the two coordinates, as in [`Extent`].
    pub(crate) margin: Repeated,
    /// As in [`Extent`].
    pub(crate) depth: Repeated,
    /// The longer diagonal.
    pub(crate) across: f32,
    /// The places of its triangles, as bits: of the one whose first coordinate is the larger, and of the other.
    pub(crate) places: [Repeated; 2],
}

/// An axis of space.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Axis {
    X = 0,
    Y = 1,
    Z = 2,
}

/// A parallelogram in double precision.
pub(super) struct Frame {
    center: Vec3<f64>,
    /// From the corner to the two.
    sides: [Vec3<f64>; 2],
    normal: Vec3<f64>,
    area: f64,
    extent: Extent,
}

impl Frame {
    /// The parallelogram with a corner and the two next to it; `corners` are those that count. `None` of what is too narrow for margins to be of
    /// use.
    pub(super) fn new([p, q, r]: [Vec3<f64>; 3], corners: &[Vec3<f64>], place: u32) -> Option<Frame> {
        let (e, f) = (q - p, r - p);
        let area = e.cross(f).length();
        let (normal, center) = (e.cross(f) / area, p + (e + f) * 0.5);
        let (wide, across) = ((e.length2() + f.length2()) / area, (e + f).length().max((e - f).length()));
        // Rounding of what is compared, and of the corners in the space of the ray, err by less than 42 of the first; products of
        // corners there by two of the second.
        let steep = [2.0 * f.length() / area, 2.0 * e.length() / area];
        let margins = steep.map(|s| [(64.0 * s + 8.0 * wide / across) as f32; RAYS]);
        // That of the corners and of sums moves distances by 19; products move weights of corners, and these distances, by less than the other.
        let depth = 24.0 + 12.0 * wide;
        let (plane, middle) = (normal.to_f32().to_f64(), center.to_f32().to_f64());
        let bent = corners.iter().map(|&c| plane.dot(c - middle).abs()).fold(0.0, f64::max) * 1.001;
        let extent = Extent {
            margins,
            depth: [depth as f32; RAYS],
            center: center.to_f32().to_array(),
            across: across as f32 * 1.001,
            bent: bent as f32,
            place,
        };
        let usable = wide < 1e6 && area.is_normal() && across < 1e9;
        usable.then_some(Frame { center, sides: [e, f], normal, area, extent })
    }
    pub(super) fn face(self) -> Face {
        let [e, f] = self.sides;
        let steps = [f * (2.0 / self.area), e * (-2.0 / self.area)];
        Face {
            extent: self.extent,
            normal: repeated(self.normal),
            level: [self.normal.dot(self.center) as f32; RAYS],
            of_moment: steps.map(repeated),
            of_direction: steps.map(|step| repeated(self.center.cross(step))),
        }
    }
    /// The wall that this is, if it is one.
    pub(super) fn wall(&self) -> Option<Wall> {
        use Axis::{X, Y, Z};
        let [e, f] = self.sides.map(|v| [v.x, v.y, v.z]);
        let along = |axes: &[Axis; 3]| {
            let [k, i, j] = axes.map(|axis| axis as usize);
            e[k] == 0.0 && f[k] == 0.0 && e[j] == 0.0 && f[i] == 0.0
        };
        let ways = [[X, Y, Z], [Y, Z, X], [Z, X, Y], [X, Z, Y], [Y, X, Z], [Z, Y, X]];
        let axes = ways.into_iter().find(along).filter(|_| self.extent.bent == 0.0)?;
        let [k, i, j] = axes.map(|axis| axis as usize);
        let Extent { margins: [dx, dy], depth, across, place, .. } = self.extent;
        Some(Wall {
            axes,
            center: repeated(vec3(self.center[k], self.center[i], self.center[j])),
            scales: [2.0 / e[i], 2.0 / f[j]].map(|s| [s as f32; RAYS]),
            margin: if dx[0] < dy[0] { dy } else { dx },
            depth,
            across,
            places: [place, place + 1].map(|place| [f32::from_bits(place); RAYS]),
        })
    }
}
