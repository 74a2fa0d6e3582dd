//! Meshes: from parameters and from PLY files.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use rayon::prelude::*;

use super::Builder;
use crate::desc::{Mesh, ShapeKind};
use crate::diagnostic::Span;
use crate::params::Params;
use crate::ply::{self, PlyError, PlyMesh};
use crate::report::Report;
use crate::tables::Type;

impl Builder {
    /// The mesh of a `trianglemesh`.
    pub(super) fn triangle_mesh(&mut self, params: &mut Params) -> Option<Arc<Mesh>> {
        let mut mesh = self.vertices(params)?;
        let indices = params.ints("indices");
        if indices.is_empty() && mesh.p.len() == 3 {
            mesh.triangles = vec![[0, 1, 2]];
        } else {
            mesh.triangles = self.corners(params, "three", &mesh)?;
        }
        Some(Arc::new(mesh))
    }

    /// The mesh of a `bilinearmesh`.
    pub(super) fn bilinear_mesh(&mut self, params: &mut Params) -> Option<Arc<Mesh>> {
        let mut mesh = self.vertices(params)?;
        let indices = params.ints("indices");
        if indices.is_empty() && mesh.p.len() == 4 {
            mesh.patches = vec![[0, 1, 2, 3]];
        } else {
            mesh.patches = self.corners(params, "four", &mesh)?;
        }
        Some(Arc::new(mesh))
    }

    fn vertices(&mut self, params: &mut Params) -> Option<Mesh> {
        let p = params.take_triples("P", Type::Point3);
        if p.is_empty() {
            self.report.error(params.at, "the mesh has no vertices; add \"point3 P\" [ ... ]");
            return None;
        }
        let mesh = Mesh {
            n: params.take_triples("N", Type::Normal),
            s: params.take_triples("S", Type::Vector3),
            uv: params.take_pairs("uv", Type::Point2),
            p_end: params.take_triples("P_end", Type::Point3),
            n_end: params.take_triples("N_end", Type::Normal),
            p,
            ..Mesh::default()
        };
        let mut matching = self.has_start(params, "N_end", "N") && self.has_start(params, "N_end", "P_end");
        let lists = [
            ("N", mesh.n.len()),
            ("S", mesh.s.len()),
            ("uv", mesh.uv.len()),
            ("P_end", mesh.p_end.len()),
            ("N_end", mesh.n_end.len()),
        ];
        for (name, n) in lists {
            if n != 0 && n != mesh.p.len() {
                let message =
                    format!("\"{name}\" has {n} entries and \"P\" {}; give one per vertex", mesh.p.len());
                self.report.error(params.place(name), message);
                matching = false;
            }
        }
        matching.then_some(mesh)
    }

    /// A parameter is not given without the one that it goes with.
    pub(super) fn has_start(&mut self, params: &Params, end: &str, start: &str) -> bool {
        if !params.has(end) || params.has(start) {
            return true;
        }
        let message = format!("\"{end}\" is given without \"{start}\"; give both or none");
        self.report.error(params.place(end), message);
        false
    }

    /// The corners of triangles or patches, all within the vertices.
    fn corners<const N: usize>(&mut self, params: &Params, word: &str, mesh: &Mesh) -> Option<Vec<[u32; N]>> {
        let indices = params.ints("indices");
        let at = params.place("indices");
        let n = mesh.p.len();
        let problem = if indices.is_empty() {
            format!(
                "the mesh has {n} vertices and no \"indices\"; add \"integer indices\" [ ... ], {word} per face"
            )
        } else if !indices.len().is_multiple_of(N) {
            format!("\"indices\" has {} entries; give {word} per face", indices.len())
        } else if let Some(bad) = indices.iter().find(|&&i| i < 0 || i as usize >= n) {
            format!("\"indices\" holds {bad}, and \"P\" has {n} vertices; count them from 0 to {}", n - 1)
        } else {
            let (faces, _) = indices.as_chunks::<N>();
            return Some(faces.iter().map(|f| f.map(|i| i as u32)).collect());
        };
        self.report.error(at, problem);
        None
    }

    /// The files of a `plymesh`, of which there is a second one where it moves. They are read when all statements are known.
    pub(super) fn mesh_files(&mut self, params: &Params) -> Option<MeshFiles> {
        let Some((name, at)) = params.text("filename") else {
            self.report.error(params.at, "the mesh names no file; add \"string filename\" \"...\"");
            return None;
        };
        let path = self.existing(name, at)?;
        let start = self.meshes.add(name, at, path, &mut self.report);
        let end = params.text("filename_end").map(|(name, at)| {
            let path = self.resolve(name);
            self.meshes.add(name, at, path, &mut self.report)
        });
        Some(MeshFiles { start, end })
    }

    /// Reads the files of all meshes, side by side, and gives the meshes to their shapes. What there is to say of a file is said
    /// where it is named first.
    pub(super) fn read_meshes(&mut self) {
        let meshes = std::mem::take(&mut self.meshes);
        let mut files: Vec<Unread> =
            meshes.paths.par_iter().map(|path| Unread::Read(ply::read(path).map(Box::new))).collect();
        for PendingMesh { files: of, object, shape, stands } in meshes.pending {
            let Some(mesh) = self.mesh_of(&of, stands, &mut files) else { continue };
            let shapes = match object.and_then(|i| self.objects.get_mut(i)) {
                Some(object) => &mut object.shapes,
                None => &mut self.shapes,
            };
            if let Some(shape) = shapes.get_mut(shape) {
                shape.kind = ShapeKind::Mesh(mesh);
            }
        }
    }

    fn mesh_of(&mut self, of: &MeshFiles, stands: bool, files: &mut [Unread]) -> Option<Arc<Mesh>> {
        let name = &of.start.name;
        let mut start = self.mesh_in(&of.start, files)?;
        let Some(last) = &of.end else { return Some(start) };
        self.existing(&last.name, last.at)?;
        let end = self.mesh_in(last, files)?;
        let other = if end.p.len() != start.p.len() {
            format!("{} vertices and \"{name}\" {}", end.p.len(), start.p.len())
        } else if (&end.triangles, &end.patches) != (&start.triangles, &start.patches) {
            format!("other faces than \"{name}\"")
        } else if end.n.is_empty() != start.n.is_empty() {
            format!("{} normals and \"{name}\" {}", end.n.len(), start.n.len())
        } else if stands {
            return Some(start);
        } else {
            let mesh = Arc::make_mut(&mut start);
            (mesh.p_end, mesh.n_end) = (end.p.clone(), end.n.clone());
            return Some(start);
        };
        let message =
            format!("\"{}\" has {other}; both ends of a motion have the same vertices and faces", last.name);
        self.report.error(last.at, message);
        None
    }

    /// The mesh of a file that was read.
    fn mesh_in(&mut self, of: &MeshFile, files: &mut [Unread]) -> Option<Arc<Mesh>> {
        let file = &mut files[of.file];
        if let Unread::Known(mesh) = file {
            return mesh.clone();
        }
        let Unread::Read(read) = std::mem::replace(file, Unread::Known(None)) else { return None };
        match read {
            Ok(read) => {
                for note in &read.notes {
                    self.report.warn(of.at, format!("\"{}\": {note}", of.name));
                }
                let mesh = Arc::new(described(*read));
                *file = Unread::Known(Some(Arc::clone(&mesh)));
                Some(mesh)
            }
            Err(e) => {
                self.report.error(of.at, format!("\"{}\" cannot be read: {e}", of.name));
                None
            }
        }
    }
}

fn described(read: PlyMesh) -> Mesh {
    // Around the face in the file, row by row in a patch.
    let patches = read.quads.into_iter().map(|[a, b, c, d]| [a, b, d, c]).collect();
    Mesh { p: read.p, n: read.n, uv: read.uv, triangles: read.triangles, patches, ..Mesh::default() }
}

/// A file, read and perhaps not yet looked at.
enum Unread {
    Read(Result<Box<PlyMesh>, PlyError>),
    /// `None` where it could not be read, which has been said.
    Known(Option<Arc<Mesh>>),
}

/// A mesh file where the scene names it.
#[derive(Debug)]
pub(super) struct MeshFile {
    name: String,
    at: Span,
    /// Its number among all of them.
    file: usize,
}

/// The files of a `plymesh`.
#[derive(Debug)]
pub(super) struct MeshFiles {
    start: MeshFile,
    end: Option<MeshFile>,
}

impl MeshFiles {
    pub(super) fn deforms(&self) -> bool {
        self.end.is_some()
    }
}

/// A shape whose mesh is still in files.
#[derive(Debug)]
pub(super) struct PendingMesh {
    pub(super) files: MeshFiles,
    /// The object that it is part of.
    pub(super) object: Option<usize>,
    /// Its number among the shapes of the object, or those outside of objects.
    pub(super) shape: usize,
    /// It keeps its form where motion starts.
    pub(super) stands: bool,
}

/// Meshes in files, to be read.
#[derive(Debug, Default)]
pub(super) struct PendingMeshes {
    /// The files; each is read once.
    paths: Vec<PathBuf>,
    known: HashMap<PathBuf, usize>,
    pub(super) pending: Vec<PendingMesh>,
}

impl PendingMeshes {
    fn add(&mut self, name: &str, at: Span, path: PathBuf, report: &mut Report) -> MeshFile {
        let file = *self.known.entry(path).or_insert_with_key(|path| {
            report.add_file(path.clone());
            self.paths.push(path.clone());
            self.paths.len() - 1
        });
        MeshFile { name: name.to_owned(), at, file }
    }
}
