//! Parallelograms and triangles in numbers that tell quickly which rays miss them: [`Face`].

use sparrow_math::Vec3;

use super::packet::RAYS;

/// A number, once for each ray of a packet.
pub(crate) type Repeated = [f32; RAYS];
/// A vector, likewise.
pub(crate) type RepeatedVector = [Repeated; 3];

fn repeated(v: Vec3<f64>) -> RepeatedVector {
    v.to_f32().to_array().map(|x| [x; RAYS])
}

/// A parallelogram, or the half of it where its two coordinates add up to nothing positive.
///
/// Coordinates are linear, zero in the middle and one on two sides. Numbers are rounded; the margins say how far that, and all
/// roundings of the test of a triangle, may move what is compared.
#[derive(Clone, Debug)]
pub(crate) struct Face {
    pub(crate) center: RepeatedVector,
    /// Unit normal.
    pub(crate) normal: RepeatedVector,
    /// What a step is multiplied with to give the change of a coordinate.
    pub(crate) axes: [RepeatedVector; 2],
    /// Margins of the coordinates: times half a unit in the last place, the distance of anything from the ray's origin, and the length of
    /// its direction.
    pub(crate) margins: [Repeated; 2],
    /// Margin of the distance from the plane: times half a unit in the last place and the distance of anything from the ray's origin.
    pub(crate) depth: Repeated,
    /// How far corners lie beside the plane.
    pub(crate) bent: f32,
    /// The place of the triangle; of a parallelogram's two, of the one whose first coordinate is the larger, and the next is the other's.
    pub(crate) place: u32,
}

impl Face {
    /// The parallelogram with a corner, the sides that leave it, and the corner across, which may miss a little.
    pub(super) fn square([p, q, r, across]: [Vec3<f64>; 4], place: u32) -> Option<Face> {
        Face::new([p, q, r], &[p, q, r, across], place)
    }
    /// The triangle with these corners.
    pub(super) fn triangle([p, q, r]: [Vec3<f64>; 3], place: u32) -> Option<Face> {
        Face::new([p, q, r], &[p, q, r], place)
    }
    /// `None` of what is too narrow for margins to be of use.
    fn new([p, q, r]: [Vec3<f64>; 3], corners: &[Vec3<f64>], place: u32) -> Option<Face> {
        let (e, f) = (q - p, r - p);
        let area = e.cross(f).length();
        let n = e.cross(f) / area;
        let (a, b) = (f.cross(n), n.cross(e));
        let axes = [a * (2.0 / e.dot(a)), b * (2.0 / f.dot(b))];
        let center = p + (e + f) * 0.5;
        let (wide, across) = ((e.length2() + f.length2()) / area, (e + f).length().max((e - f).length()));
        // Rounding of what is compared, and of the corners in the space of the ray, err by 42 of the first; products of corners
        // there by two of the second.
        let margins = axes.map(|a| [(64.0 * a.length() + 8.0 * wide / across) as f32; RAYS]);
        let depth = 64.0 * axes[0].length().max(axes[1].length()) * across + 16.0;
        let (plane, middle) = (n.to_f32().to_f64(), center.to_f32().to_f64());
        let bent = corners.iter().map(|&c| plane.dot(c - middle).abs()).fold(0.0, f64::max) * 1.001;
        (wide < 1e6 && area.is_normal() && across < 1e9).then(|| Face {
            center: repeated(center),
            normal: repeated(n),
            axes: axes.map(repeated),
            margins,
            depth: [depth as f32; RAYS],
            bent: bent as f32,
            place,
        })
    }
}
