//! Triangles over a grid, as PLY text.

/// Position, normal, u and v at a corner of a grid.
pub(super) type Vertex<'a> = Box<dyn Fn(u32, u32) -> [f64; 8] + 'a>;

const PROPERTIES: [&str; 8] = ["x", "y", "z", "nx", "ny", "nz", "u", "v"];

/// A grid of cells of two triangles each.
pub(super) struct Grid<'a> {
    /// Cells along u and v.
    pub(super) cells: [u32; 2],
    pub(super) vertex: Vertex<'a>,
}

/// An ASCII PLY file of one grid of `nu` by `nv` cells.
pub(super) fn ply(nu: u32, nv: u32, vertex: impl Fn(u32, u32) -> [f64; 8]) -> String {
    ply_of(&[Grid { cells: [nu, nv], vertex: Box::new(vertex) }])
}

/// An ASCII PLY file of one grid, of positions and normals.
pub(super) fn ply_without_uv(cells: [u32; 2], vertex: impl Fn(u32, u32) -> [f64; 6]) -> String {
    let vertex = |i, j| {
        let [x, y, z, nx, ny, nz] = vertex(i, j);
        [x, y, z, nx, ny, nz, 0.0, 0.0]
    };
    text(&[Grid { cells, vertex: Box::new(vertex) }], &PROPERTIES[..6])
}

/// An ASCII PLY file of several grids.
pub(super) fn ply_of(grids: &[Grid<'_>]) -> String {
    text(grids, &PROPERTIES)
}

/// The first properties of each vertex, and the faces.
fn text(grids: &[Grid<'_>], properties: &[&str]) -> String {
    let sum = |f: fn([u32; 2]) -> u32| grids.iter().map(|g| f(g.cells)).sum::<u32>();
    let mut text = format!(
        "ply\nformat ascii 1.0\ncomment written by cargo run -p xtask -- assets\nelement vertex {}\n",
        sum(|[nu, nv]| (nu + 1) * (nv + 1))
    );
    for name in properties {
        text += &format!("property float {name}\n");
    }
    text += &format!(
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        sum(|[nu, nv]| 2 * nu * nv)
    );
    for Grid { cells: [nu, nv], vertex } in grids {
        for (i, j) in (0..=*nv).flat_map(|j| (0..=*nu).map(move |i| (i, j))) {
            text += &vertex(i, j).map(short)[..properties.len()].join(" ");
            text.push('\n');
        }
    }
    let mut first = 0;
    for Grid { cells: [nu, nv], .. } in grids {
        for (i, j) in (0..*nv).flat_map(|j| (0..*nu).map(move |i| (i, j))) {
            let a = first + j * (nu + 1) + i;
            let d = a + nu + 1;
            text += &format!("3 {a} {} {}\n3 {a} {} {d}\n", a + 1, d + 1, d + 1);
        }
        first += (nu + 1) * (nv + 1);
    }
    text
}

/// Four decimals, without the sign of a zero.
pub(super) fn short(x: f64) -> String {
    let text = format!("{x:.4}");
    if text == "-0.0000" {
        "0".to_owned()
    } else {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    }
}
