//! Meshes in OBJ files: [`read`].
//!
//! Positions, texture coordinates, normals and faces; groups, materials, lines and points are skipped, as are weights and colours behind
//! a position. Source of the format: Wavefront, "Advanced Visualizer manual", appendix B1, 1994.

use std::collections::HashMap;
use std::fmt;
use std::path::{Path, PathBuf};

/// A mesh, checked: all positions are finite and all indices exist. Vertices whose corners differ in texture coordinates or
/// normals stand once for each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObjMesh {
    /// Positions.
    pub p: Vec<[f32; 3]>,
    /// Normals as stored, one for each position, or none where some corner has none.
    pub n: Vec<[f32; 3]>,
    /// Texture coordinates, one pair for each position, or none where some corner has none.
    pub uv: Vec<[f32; 2]>,
    /// Triangles, as positions in `p`; larger faces are cut into fans, which is right where they are convex.
    pub triangles: Vec<[u32; 3]>,
}

/// Faults listed before the rest is only counted.
const MAX_LISTED: usize = 20;

/// An OBJ file that cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ObjError {
    /// The file system refused.
    #[error("{}: cannot be read: {source}; check the path", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The contents contradict the format or themselves: every fault, up to a limit.
    #[error("{0}")]
    Damaged(ObjFaults),
}

/// What is wrong with a file.
#[derive(Debug)]
pub struct ObjFaults {
    path: PathBuf,
    /// Line, counted from 1, and fault.
    faults: Vec<(usize, String)>,
}

impl fmt::Display for ObjFaults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, (line, fault)) in self.faults.iter().take(MAX_LISTED).enumerate() {
            let end = if i > 0 { "\n" } else { "" };
            write!(f, "{end}{}:{line}: {fault}", self.path.display())?;
        }
        match self.faults.len().saturating_sub(MAX_LISTED) {
            0 => write!(f, "; export the mesh again"),
            more => write!(f, "\nand {more} more faults; export the mesh again"),
        }
    }
}

/// A corner of a face: position, texture coordinate and normal, counted from 0.
type Corner = (usize, Option<usize>, Option<usize>);

/// What has been read so far.
#[derive(Default)]
struct Reader {
    p: Vec<[f32; 3]>,
    uv: Vec<[f32; 2]>,
    n: Vec<[f32; 3]>,
    /// Triangles, with the line of their face.
    faces: Vec<(usize, [Corner; 3])>,
    faults: Vec<(usize, String)>,
}

/// Reads a mesh.
///
/// # Errors
/// [`ObjError`] names the file, and each faulty line with its fault.
pub fn read(path: &Path) -> Result<ObjMesh, ObjError> {
    let bytes = std::fs::read(path).map_err(|source| ObjError::Io { path: path.to_path_buf(), source })?;
    parse(&bytes, path)
}

/// Like [`read`], from the contents of a file; `path` serves the messages.
///
/// # Errors
/// As [`read`].
pub fn parse(bytes: &[u8], path: &Path) -> Result<ObjMesh, ObjError> {
    let mut reader = Reader::default();
    let text = String::from_utf8_lossy(bytes);
    let (mut statement, mut begun) = (String::new(), 1);
    for (i, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default().trim_end();
        if statement.is_empty() {
            begun = i + 1;
        }
        // A backslash at the end goes on in the next line.
        if let Some(part) = line.strip_suffix('\\') {
            statement.push_str(part);
            statement.push(' ');
            continue;
        }
        statement.push_str(line);
        reader.statement(begun, &statement);
        statement.clear();
    }
    reader.statement(begun, &statement);
    reader.finish(path)
}

impl Reader {
    fn statement(&mut self, line: usize, text: &str) {
        let mut words = text.split_ascii_whitespace();
        let Some(name) = words.next() else { return };
        let done = match name {
            "v" => numbers(words).map(|p| self.p.push(p)),
            "vn" => numbers(words).map(|n| self.n.push(n)),
            "vt" => {
                // A coordinate alone is that of a curve.
                let words = words.chain(["0"]);
                numbers(words).map(|uv| self.uv.push(uv))
            }
            "f" => self.face(line, words),
            _ => Ok(()),
        };
        if let Err(fault) = done {
            self.faults.push((line, fault));
        }
    }

    fn face<'a>(&mut self, line: usize, words: impl Iterator<Item = &'a str>) -> Result<(), String> {
        let corners = words.map(|word| self.corner(word)).collect::<Result<Vec<_>, _>>()?;
        let [first, rest @ ..] = &corners[..] else { return Err("a face without corners".to_owned()) };
        if rest.len() < 2 {
            return Err(format!("a face of {} corners; it needs three", corners.len()));
        }
        self.faces.extend(rest.windows(2).map(|pair| (line, [*first, pair[0], pair[1]])));
        Ok(())
    }

    /// `position`, `position/texture`, `position//normal` or `position/texture/normal`.
    fn corner(&self, word: &str) -> Result<Corner, String> {
        let mut parts = word.split('/');
        let mut next = |n: usize| match parts.next() {
            None | Some("") => Ok(None),
            Some(s) => index(s, n).map(Some),
        };
        let (p, uv, n) = (next(self.p.len())?, next(self.uv.len())?, next(self.n.len())?);
        match (p, parts.next()) {
            (Some(p), None) => Ok((p, uv, n)),
            _ => Err(format!("`{word}` is no corner; write position/texture/normal")),
        }
    }

    fn finish(mut self, path: &Path) -> Result<ObjMesh, ObjError> {
        // Indices may name what comes later, so they are checked at the end.
        let exists = |&(p, uv, n): &Corner| {
            let missing = |what: &str, i: usize, len: usize| {
                (i >= len).then(|| format!("there is no {what} {}; the file has {len}", i + 1))
            };
            missing("position", p, self.p.len())
                .or_else(|| uv.and_then(|i| missing("texture coordinate", i, self.uv.len())))
                .or_else(|| n.and_then(|i| missing("normal", i, self.n.len())))
        };
        let missing =
            self.faces.iter().filter_map(|(line, face)| Some((*line, face.iter().find_map(exists)?)));
        let missing: Vec<_> = missing.collect();
        self.faults.extend(missing);
        if !self.faults.is_empty() {
            self.faults.sort();
            self.faults.dedup();
            return Err(ObjError::Damaged(ObjFaults { path: path.to_path_buf(), faults: self.faults }));
        }
        let corners = || self.faces.iter().flat_map(|(_, face)| face);
        let (all_uv, all_n) = (corners().all(|c| c.1.is_some()), corners().all(|c| c.2.is_some()));
        let (mut mesh, mut places) = (ObjMesh::default(), HashMap::new());
        for (_, face) in &self.faces {
            let triangle = face.map(|(p, uv, n)| {
                let (uv, n) = (uv.filter(|_| all_uv), n.filter(|_| all_n));
                *places.entry((p, uv, n)).or_insert_with(|| {
                    mesh.p.push(self.p[p]);
                    mesh.uv.extend(uv.map(|i| self.uv[i]));
                    mesh.n.extend(n.map(|i| self.n[i]));
                    mesh.p.len() as u32 - 1
                })
            });
            mesh.triangles.push(triangle);
        }
        Ok(mesh)
    }
}

/// The first `N` numbers.
fn numbers<'a, const N: usize>(mut words: impl Iterator<Item = &'a str>) -> Result<[f32; N], String> {
    let mut values = [0.0_f32; N];
    for value in &mut values {
        let word = words.next().ok_or_else(|| format!("here stand fewer than {N} numbers"))?;
        *value = word.parse().map_err(|_| format!("`{word}` is no number"))?;
        if !value.is_finite() {
            return Err(format!("`{word}` is not finite"));
        }
    }
    Ok(values)
}

/// An index, counted from 1, or from -1 backwards among the `n` that have been read; from 0.
fn index(word: &str, n: usize) -> Result<usize, String> {
    let i: i64 = word.parse().map_err(|_| format!("`{word}` is no index"))?;
    let from_zero = if i > 0 { Some(i - 1) } else { (i < 0).then_some(n as i64 + i) };
    from_zero
        .and_then(|i| usize::try_from(i).ok())
        .ok_or_else(|| format!("the index {i} names nothing; indices count from 1, or back from -1"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn mesh(text: &str) -> Result<ObjMesh, String> {
        parse(text.as_bytes(), Path::new("m.obj")).map_err(|e| e.to_string())
    }

    #[test]
    fn faces_in_all_their_forms() {
        let text = "# a square and a triangle\nmtllib a.mtl\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\n\
                    vt 0 0\nvt 1\nvn 0 0 1\ng square\nf 1/1/1 2/2/1 3/1/1 \\\n 4/1/1\nf -4/1/1 2/1/1 3/1/1\n";
        let m = mesh(text).unwrap();
        assert_eq!(m.triangles, [[0, 1, 2], [0, 2, 3], [0, 4, 2]]);
        assert_eq!(m.p, [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [1., 0., 0.]]);
        assert_eq!(m.uv, [[0., 0.], [1., 0.], [0., 0.], [0., 0.], [0., 0.]]);
        assert_eq!(m.n, [[0., 0., 1.]; 5]);
        // A corner without a normal takes them from all.
        let m = mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3\n").unwrap();
        assert_eq!((m.triangles.len(), m.p.len(), m.n.len(), m.uv.len()), (1, 3, 0, 0));
    }

    #[test]
    fn every_fault_is_told_with_its_line() {
        let text = "v 0 0\nv 0 0 x\nv 0 0 inf\nv 0 0 0\nf 1 1\nf 1 0 1\nf 1 2 1\nf 1/1 1 1\nf 1/1/1/1 1 1\nf a 1 1\nf -2 1 1\n";
        let told = mesh(text).unwrap_err();
        let want = [
            "m.obj:1: here stand fewer than 3 numbers",
            "m.obj:2: `x` is no number",
            "m.obj:3: `inf` is not finite",
            "m.obj:5: a face of 2 corners; it needs three",
            "m.obj:6: the index 0 names nothing; indices count from 1, or back from -1",
            "m.obj:7: there is no position 2; the file has 1",
            "m.obj:8: there is no texture coordinate 1; the file has 0",
            "m.obj:9: `1/1/1/1` is no corner; write position/texture/normal",
            "m.obj:10: `a` is no index",
            "m.obj:11: the index -2 names nothing; indices count from 1, or back from -1; export the mesh again",
        ];
        assert_eq!(told.lines().collect::<Vec<_>>(), want);
        let many = "v\n".repeat(100);
        assert!(mesh(&many).unwrap_err().ends_with("and 80 more faults; export the mesh again"));
    }

    proptest! {
        #[test]
        fn any_text_is_read_or_refused(text in "([vtnf/ 0-9.\\-\\\\\\n#]|\\PC){0,120}") {
            if let Ok(m) = mesh(&text) {
                prop_assert!(m.triangles.iter().flatten().all(|&i| (i as usize) < m.p.len()));
            }
        }
    }
}
