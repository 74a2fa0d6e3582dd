//! Meshes: from parameters and from PLY files.

use std::sync::Arc;

use super::Builder;
use crate::desc::Mesh;
use crate::diagnostic::Span;
use crate::params::Params;
use crate::ply;
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

    /// The mesh of a `plymesh`, which moves where there is a second file.
    pub(super) fn ply_mesh(&mut self, params: &Params) -> Option<Arc<Mesh>> {
        let Some((name, at)) = params.text("filename") else {
            self.report.error(params.at, "the mesh names no file; add \"string filename\" \"...\"");
            return None;
        };
        let mut start = self.ply_file(name, at)?;
        let Some((end_name, at)) = params.text("filename_end") else { return Some(start) };
        let end = self.ply_file(end_name, at)?;
        let other = if end.p.len() != start.p.len() {
            format!("{} vertices and \"{name}\" {}", end.p.len(), start.p.len())
        } else if (&end.triangles, &end.patches) != (&start.triangles, &start.patches) {
            format!("other faces than \"{name}\"")
        } else if end.n.is_empty() != start.n.is_empty() {
            format!("{} normals and \"{name}\" {}", end.n.len(), start.n.len())
        } else {
            let mesh = Arc::make_mut(&mut start);
            (mesh.p_end, mesh.n_end) = (end.p.clone(), end.n.clone());
            return Some(start);
        };
        let message =
            format!("\"{end_name}\" has {other}; both ends of a motion have the same vertices and faces");
        self.report.error(at, message);
        None
    }

    /// The mesh of a file; each is read once.
    fn ply_file(&mut self, name: &str, at: Span) -> Option<Arc<Mesh>> {
        let path = self.existing(name, at)?;
        if let Some(known) = self.meshes.get(&path) {
            return known.clone();
        }
        let mesh = self.read_ply(name, &path, at).map(Arc::new);
        self.meshes.insert(path, mesh.clone());
        mesh
    }

    fn read_ply(&mut self, name: &str, path: &std::path::Path, at: Span) -> Option<Mesh> {
        let read = match ply::read(path) {
            Ok(read) => read,
            Err(e) => {
                self.report.error(at, format!("\"{name}\" cannot be read: {e}"));
                return None;
            }
        };
        self.report.add_file(path.to_path_buf());
        for note in &read.notes {
            self.report.warn(at, format!("\"{name}\": {note}"));
        }
        // Around the face in the file, row by row in a patch.
        let patches = read.quads.into_iter().map(|[a, b, c, d]| [a, b, d, c]).collect();
        Some(Mesh {
            p: read.p,
            n: read.n,
            uv: read.uv,
            triangles: read.triangles,
            patches,
            ..Mesh::default()
        })
    }
}
