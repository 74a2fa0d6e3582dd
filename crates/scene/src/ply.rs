//! Triangle and quad meshes in PLY files: [`read`].
//!
//! ASCII and binary of either byte order, plain or gzip-compressed (told by content), properties in any order
//! and of any type; unknown properties and elements are skipped. Data are streamed: beside the mesh itself
//! only a small buffer is held, and no count of a header is believed beyond what the file can hold.
//!
//! Source of the format: Greg Turk, "The PLY Polygon File Format", 1994. Names of properties as in pbrt-v4.

mod body;
mod header;
mod input;
mod plain;
#[cfg(test)]
mod tests;

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use self::input::Input;

/// A mesh as its file has it, checked: all positions are finite and all indices exist.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlyMesh {
    /// Positions.
    pub p: Vec<[f32; 3]>,
    /// Normals as stored, one for each position, or none at all.
    pub n: Vec<[f32; 3]>,
    /// Texture coordinates, one pair for each position, or none at all.
    pub uv: Vec<[f32; 2]>,
    /// Triangles, as positions in `p`.
    pub triangles: Vec<[u32; 3]>,
    /// Faces of four vertices, around the face as in the file. pbrt-v4 makes bilinear patches of them, whose
    /// corners are the vertices 0, 1, 3, 2 of the face.
    pub quads: Vec<[u32; 4]>,
    /// The property `face_indices`: one for each triangle, then one for each quad; or none at all.
    pub face_indices: Vec<i32>,
    /// What was read in another way than the file says, one sentence each.
    pub notes: Vec<String>,
}

/// Where in a PLY file a fault lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In a line of text, counted from 1.
    Line(u64),
    /// At a byte of the (uncompressed) file, counted from 0.
    Byte(u64),
}

impl Place {
    /// What follows the path in a message: `path:12` as editors know it, or `path: byte 345`.
    pub(crate) fn suffix(self) -> String {
        match self {
            Place::Line(n) => format!(":{n}"),
            Place::Byte(n) => format!(": byte {n}"),
        }
    }
}

/// A PLY file that cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlyError {
    /// The file system or the decompression refused.
    #[error("{}: cannot be read: {source}; check the path and that the file is whole", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The contents contradict the format or themselves.
    #[error("{}{}: {fault}; {remedy}", path.display(), place.suffix())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Where the fault was seen.
        place: Place,
        /// What is wrong.
        fault: String,
        /// What to do.
        remedy: &'static str,
    },
}

/// A fault, before the file's name is known.
#[derive(Debug)]
enum Fault {
    Io(io::Error),
    Damaged { place: Place, fault: String, remedy: &'static str },
}

const EXPORT_AGAIN: &str = "export the mesh again";

impl Fault {
    fn damaged(place: Place, fault: impl Into<String>) -> Fault {
        Fault::Damaged { place, fault: fault.into(), remedy: EXPORT_AGAIN }
    }
    fn at(self, path: &Path) -> PlyError {
        let path = path.to_path_buf();
        match self {
            Fault::Io(source) => PlyError::Io { path, source },
            Fault::Damaged { place, fault, remedy } => PlyError::Damaged { path, place, fault, remedy },
        }
    }
}

impl From<io::Error> for Fault {
    fn from(e: io::Error) -> Fault {
        Fault::Io(e)
    }
}

/// Reads a mesh.
///
/// Faces of five and more vertices are cut into a fan of triangles, which is right where they are convex;
/// faces of fewer than three are left out; normals and texture coordinates that are not finite become zero.
/// `notes` counts all of these.
///
/// # Errors
/// [`PlyError`] names the file, the line or byte, the fault and a remedy.
pub fn read(path: &Path) -> Result<PlyMesh, PlyError> {
    let open = || {
        let file = File::open(path)?;
        let length = file.metadata()?.len();
        Ok((file, length))
    };
    let (file, length) = open().map_err(|source| PlyError::Io { path: path.to_path_buf(), source })?;
    read_from(file, length, path)
}

/// Like [`read`], from `length` bytes of any source; `path` serves the messages.
///
/// # Errors
/// As [`read`].
pub fn read_from(source: impl Read, length: u64, path: &Path) -> Result<PlyMesh, PlyError> {
    let parse = || {
        let mut input = Input::new(source, length)?;
        let header = header::read(&mut input)?;
        body::read(input, &header)
    };
    parse().map_err(|fault| fault.at(path))
}
