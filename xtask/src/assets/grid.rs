//! Triangles over a grid, as PLY text.

/// An ASCII PLY file of `nu` by `nv` cells of two triangles each. `vertex` gives position, normal, u and v at a corner of the grid.
pub(super) fn ply(nu: u32, nv: u32, vertex: impl Fn(u32, u32) -> [f64; 8]) -> String {
    let mut text = format!(
        "ply\nformat ascii 1.0\ncomment written by cargo run -p xtask -- assets\nelement vertex {}\n",
        (nu + 1) * (nv + 1)
    );
    for name in ["x", "y", "z", "nx", "ny", "nz", "u", "v"] {
        text += &format!("property float {name}\n");
    }
    text += &format!("element face {}\nproperty list uchar int vertex_indices\nend_header\n", 2 * nu * nv);
    for j in 0..=nv {
        for i in 0..=nu {
            text += &vertex(i, j).map(short).join(" ");
            text.push('\n');
        }
    }
    for j in 0..nv {
        for i in 0..nu {
            let a = j * (nu + 1) + i;
            let d = a + nu + 1;
            text += &format!("3 {a} {} {}\n3 {a} {} {d}\n", a + 1, d + 1, d + 1);
        }
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
