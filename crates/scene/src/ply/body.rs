//! The data behind the header: vertices, faces, and what is passed over.

use std::io::Read;

use super::header::{Element, Format, Header, Kind, Property, Type};
use super::input::Input;
use super::plain::{self, PlainVertices};
use super::{EXPORT_AGAIN, Fault, Place, PlyMesh};

/// Numbers one after the other, written in whatever way.
pub(super) trait Numbers {
    /// The next number. All types of PLY fit into `f64` exactly.
    fn next(&mut self, t: Type) -> Result<f64, Fault>;
    /// Passes over `n` numbers.
    fn skip(&mut self, t: Type, n: u64) -> Result<(), Fault>;
    /// Where the number of type `t` stands that was read last.
    fn place_of_last(&self, t: Type) -> Place;
    /// Something follows that is no blank.
    fn has_more(&mut self) -> Result<bool, Fault>;

    /// Whole rows of `row` bytes that lie ready, at most `n`: of text, whose rows have no such length, and where the file ends, none.
    fn rows(&mut self, row: usize, n: u64) -> Result<&[u8], Fault>;
    /// Passes over bytes that [`rows`](Self::rows) has shown.
    fn pass(&mut self, n_bytes: usize);
    /// The four bytes of a number in such a row, the lowest first.
    fn lowest_first(number: [u8; 4]) -> [u8; 4];

    /// The length of a list.
    fn count(&mut self, t: Type) -> Result<u64, Fault> {
        let n = self.next(t)?;
        if n < 0.0 {
            return Err(Fault::damaged(self.place_of_last(t), format!("a list of {n} values is announced")));
        }
        Ok(n as u64)
    }

    fn skip_property(&mut self, kind: Kind) -> Result<(), Fault> {
        match kind {
            Kind::Scalar(t) => self.skip(t, 1),
            Kind::List { count, item } => {
                let n = self.count(count)?;
                self.skip(item, n)
            }
        }
    }
}

struct Binary<R, const BIG: bool>(Input<R>);

impl<R: Read, const BIG: bool> Binary<R, BIG> {
    #[inline]
    fn bytes<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        let Some(mut b) = self.0.take::<N>()? else { return Err(cut_short(Place::Byte(self.0.end()))) };
        if BIG {
            b.reverse();
        }
        Ok(b)
    }
}

fn cut_short(place: Place) -> Fault {
    Fault::Damaged {
        place,
        fault: "the file ends before all that its header announces".to_owned(),
        remedy: "fetch the file again or export the mesh again",
    }
}

impl<R: Read, const BIG: bool> Numbers for Binary<R, BIG> {
    #[inline]
    fn next(&mut self, t: Type) -> Result<f64, Fault> {
        Ok(match t {
            Type::I8 => f64::from(i8::from_le_bytes(self.bytes()?)),
            Type::U8 => f64::from(u8::from_le_bytes(self.bytes()?)),
            Type::I16 => f64::from(i16::from_le_bytes(self.bytes()?)),
            Type::U16 => f64::from(u16::from_le_bytes(self.bytes()?)),
            Type::I32 => f64::from(i32::from_le_bytes(self.bytes()?)),
            Type::U32 => f64::from(u32::from_le_bytes(self.bytes()?)),
            Type::F32 => f64::from(f32::from_le_bytes(self.bytes()?)),
            Type::F64 => f64::from_le_bytes(self.bytes()?),
        })
    }
    fn skip(&mut self, t: Type, n: u64) -> Result<(), Fault> {
        if self.0.skip(n.saturating_mul(t.size()))? {
            Ok(())
        } else {
            Err(cut_short(Place::Byte(self.0.end())))
        }
    }
    fn place_of_last(&self, t: Type) -> Place {
        Place::Byte(self.0.offset().saturating_sub(t.size()))
    }
    fn has_more(&mut self) -> Result<bool, Fault> {
        Ok(self.0.take::<1>()?.is_some())
    }
    fn rows(&mut self, row: usize, n: u64) -> Result<&[u8], Fault> {
        self.0.rows(row, n)
    }
    fn pass(&mut self, n_bytes: usize) {
        self.0.pass(n_bytes);
    }
    #[inline]
    fn lowest_first(mut number: [u8; 4]) -> [u8; 4] {
        if BIG {
            number.reverse();
        }
        number
    }
}

struct Ascii<R>(Input<R>);

impl<R: Read> Numbers for Ascii<R> {
    fn next(&mut self, t: Type) -> Result<f64, Fault> {
        let Some(word) = self.0.word()? else { return Err(cut_short(self.0.line())) };
        // No type of PLY has whole numbers beyond 32 bits, which `f64` holds exactly.
        let value = match t {
            Type::F32 | Type::F64 => word.parse().ok(),
            Type::I8 => word.parse::<i8>().ok().map(f64::from),
            Type::U8 => word.parse::<u8>().ok().map(f64::from),
            Type::I16 => word.parse::<i16>().ok().map(f64::from),
            Type::U16 => word.parse::<u16>().ok().map(f64::from),
            Type::I32 => word.parse::<i32>().ok().map(f64::from),
            Type::U32 => word.parse::<u32>().ok().map(f64::from),
        };
        let (word, place) = (value.is_none().then(|| word.escape_debug().to_string()), self.0.line());
        value.ok_or_else(|| {
            let word = word.unwrap_or_default();
            Fault::damaged(place, format!("`{word}` is no number of the type the header declares ({t:?})"))
        })
    }
    fn skip(&mut self, _: Type, n: u64) -> Result<(), Fault> {
        for _ in 0..n {
            if self.0.word()?.is_none() {
                return Err(cut_short(self.0.line()));
            }
        }
        Ok(())
    }
    fn place_of_last(&self, _: Type) -> Place {
        self.0.line() // A word is read without the line's end behind it.
    }
    fn has_more(&mut self) -> Result<bool, Fault> {
        self.0.skip_blanks()
    }
    fn rows(&mut self, _: usize, _: u64) -> Result<&[u8], Fault> {
        Ok(&[])
    }
    fn pass(&mut self, _: usize) {}
    fn lowest_first(number: [u8; 4]) -> [u8; 4] {
        number
    }
}

/// Reads all elements.
pub(super) fn read<R: Read>(input: Input<R>, header: &Header) -> Result<PlyMesh, Fault> {
    for e in &header.elements {
        let bytes = e.count.checked_mul(e.least_bytes(header.format));
        if bytes.is_none_or(|b| b > input.limit()) {
            let what = format!("{} times `{}` is more than the file can hold", e.count, e.name);
            return Err(Fault::Damaged { place: e.line, fault: what, remedy: EXPORT_AGAIN });
        }
    }
    let likely = input.likely();
    match header.format {
        Format::Ascii => read_elements(Ascii(input), header, likely),
        Format::Little => read_elements(Binary::<R, false>(input), header, likely),
        Format::Big => read_elements(Binary::<R, true>(input), header, likely),
    }
}

/// `likely` is how many bytes the uncompressed file probably has.
fn read_elements(mut numbers: impl Numbers, header: &Header, likely: u64) -> Result<PlyMesh, Fault> {
    let reserve = |e: &Element| {
        let n = e.count.min(likely / e.least_bytes(header.format).max(1));
        usize::try_from(n).unwrap_or(0)
    };
    let n_vertices = header.elements.iter().find(|e| e.name == "vertex").map_or(0, |e| e.count);
    let mut mesh = PlyMesh::default();
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" => read_vertices(&mut numbers, element, reserve(element), &mut mesh)?,
            "face" => {
                mesh.triangles.reserve_exact(reserve(element));
                read_faces(&mut numbers, element, n_vertices, &mut mesh)?;
            }
            // An element without properties takes no room, however often it is there.
            _ if element.properties.is_empty() => {}
            _ => {
                for _ in 0..element.count {
                    element.properties.iter().try_for_each(|p| numbers.skip_property(p.kind))?;
                }
            }
        }
    }
    if mesh.triangles.is_empty() && mesh.quads.is_empty() {
        let faces = header.elements.iter().find(|e| e.name == "face");
        let place = faces.map_or(Place::Line(1), |e| e.line);
        return Err(Fault::damaged(place, "the file has no face of three or more vertices"));
    }
    if numbers.has_more()? {
        mesh.notes.push("data behind the last element were ignored".to_owned());
    }
    mesh.triangles.shrink_to_fit();
    mesh.quads.shrink_to_fit();
    Ok(mesh)
}

/// Names of the two texture coordinates, the first pair that is there counts.
const UV_NAMES: [[&str; 2]; 4] =
    [["u", "v"], ["s", "t"], ["texture_u", "texture_v"], ["texture_s", "texture_t"]];

fn read_vertices(
    numbers: &mut impl Numbers,
    element: &Element,
    n: usize,
    mesh: &mut PlyMesh,
) -> Result<(), Fault> {
    let scalar =
        |name: &&str| element.find(name).filter(|i| matches!(element.properties[*i].kind, Kind::Scalar(_)));
    let has = |names: &[&str]| names.iter().all(|n| scalar(n).is_some());
    if !has(&["x", "y", "z"]) {
        return Err(Fault::damaged(element.line, "the vertices have no numbers `x`, `y` and `z`"));
    }
    let has_n = has(&["nx", "ny", "nz"]);
    let uv = UV_NAMES.iter().find(|names| has(&names[..]));
    // Where each property goes: 0 to 2 position, 3 to 5 normal, 6 and 7 texture coordinates.
    let names = ["x", "y", "z", "nx", "ny", "nz"].into_iter().chain(uv.into_iter().flatten().copied());
    let mut slots: Vec<Option<usize>> = vec![None; element.properties.len()];
    for (slot, name) in names.enumerate() {
        if let Some(i) = scalar(&name) {
            slots[i] = Some(slot);
        }
    }
    mesh.p.reserve_exact(n);
    mesh.n.reserve_exact(if has_n { n } else { 0 });
    mesh.uv.reserve_exact(if uv.is_some() { n } else { 0 });
    let (mut bad_n, mut bad_uv) = (0u64, 0u64);
    let mut push = |[x, y, z, nx, ny, nz, s, t]: [f32; 8]| {
        mesh.p.push([x, y, z]);
        if has_n {
            mesh.n.push(finite_or_zero([nx, ny, nz], &mut bad_n));
        }
        if uv.is_some() {
            mesh.uv.push(finite_or_zero([s, t], &mut bad_uv));
        }
    };
    let plain = PlainVertices::of(element, &slots);
    let mut i = 0;
    while i < element.count {
        if let Some(plain) = &plain {
            i += plain.read(numbers, element.count - i, &mut push)?;
            if i == element.count {
                break;
            }
        }
        push(read_vertex(numbers, element, &slots, i)?);
        i += 1;
    }
    note(mesh, bad_n, "normals were not finite and became zero");
    note(mesh, bad_uv, "texture coordinates were not finite and became zero");
    Ok(())
}

/// The numbers of vertex `i`, by slots.
fn read_vertex(
    numbers: &mut impl Numbers,
    element: &Element,
    slots: &[Option<usize>],
    i: u64,
) -> Result<[f32; 8], Fault> {
    let mut v = [0.0f32; 8];
    for (Property { name, kind }, slot) in element.properties.iter().zip(slots) {
        match (kind, slot) {
            (Kind::Scalar(t), Some(slot)) => {
                let x = numbers.next(*t)? as f32;
                if !x.is_finite() && *slot < 3 {
                    let what = format!("`{name}` of vertex {i} is {x}, not a finite number");
                    return Err(Fault::damaged(numbers.place_of_last(*t), what));
                }
                v[*slot] = x;
            }
            _ => numbers.skip_property(*kind)?,
        }
    }
    Ok(v)
}

fn finite_or_zero<const N: usize>(v: [f32; N], n_bad: &mut u64) -> [f32; N] {
    if v.iter().all(|x| x.is_finite()) {
        return v;
    }
    *n_bad += 1;
    [0.0; N]
}

fn note(mesh: &mut PlyMesh, n: u64, what: &str) {
    if n > 0 {
        mesh.notes.push(format!("{n} {what}"));
    }
}

fn read_faces(
    numbers: &mut impl Numbers,
    element: &Element,
    n_vertices: u64,
    mesh: &mut PlyMesh,
) -> Result<(), Fault> {
    let list = ["vertex_indices", "vertex_index"].iter().find_map(|n| element.find(n));
    let whole_list =
        |i: &usize| matches!(element.properties[*i].kind, Kind::List { item, .. } if item.is_whole());
    let Some(list) = list.filter(whole_list) else {
        let what = "the faces have no list `vertex_indices` of whole numbers";
        return Err(Fault::damaged(element.line, what));
    };
    let index = element
        .find("face_indices")
        .filter(|i| matches!(element.properties[*i].kind, Kind::Scalar(t) if t.is_whole()));
    let (mut corners, mut face_index) = (Vec::new(), 0i32);
    let (mut n_fans, mut n_left_out) = (0u64, 0u64);
    let mut quad_indices = Vec::new();
    let plain = plain::has_plain_faces(element) && n_vertices <= 1 << 31;
    let mut face = 0;
    while face < element.count {
        if plain {
            let (n, triangles) = (element.count - face, &mut mesh.triangles);
            face += plain::read_triangles(numbers, n, n_vertices as u32, triangles)?;
            if face == element.count {
                break;
            }
        }
        for (i, property) in element.properties.iter().enumerate() {
            match property.kind {
                Kind::List { count, item } if i == list => {
                    read_corners(numbers, count, item, face, n_vertices, &mut corners)?;
                }
                // 32 bits without a sign do not fit; the largest value stands for them.
                Kind::Scalar(t) if index == Some(i) => face_index = numbers.next(t)? as i32,
                kind @ (Kind::Scalar(_) | Kind::List { .. }) => numbers.skip_property(kind)?,
            }
        }
        face += 1;
        match corners[..] {
            [a, b, c] => mesh.triangles.push([a, b, c]),
            [a, b, c, d] => {
                mesh.quads.push([a, b, c, d]);
                quad_indices.extend(index.map(|_| face_index));
                continue;
            }
            [a, ref rest @ ..] if rest.len() > 3 => {
                n_fans += 1;
                mesh.triangles.extend(rest.windows(2).map(|w| [a, w[0], w[1]]));
            }
            _ => n_left_out += 1,
        }
        if index.is_some() {
            mesh.face_indices.resize(mesh.triangles.len(), face_index);
        }
    }
    mesh.face_indices.append(&mut quad_indices);
    note(mesh, n_fans, "faces of more than four vertices were cut into triangles");
    note(mesh, n_left_out, "faces of fewer than three vertices were left out");
    Ok(())
}

/// The vertices of one face.
#[inline]
fn read_corners(
    numbers: &mut impl Numbers,
    count: Type,
    item: Type,
    face: u64,
    n_vertices: u64,
    corners: &mut Vec<u32>,
) -> Result<(), Fault> {
    corners.clear();
    for _ in 0..numbers.count(count)? {
        let v = numbers.next(item)?;
        if v < 0.0 || v >= n_vertices as f64 {
            let what = format!("face {face} names vertex {v}, but there are {n_vertices}, counted from 0");
            return Err(Fault::damaged(numbers.place_of_last(item), what));
        }
        corners.push(v as u32);
    }
    Ok(())
}
