//! What building cost and gave: [`BuildStats`].

/// Memory by what it holds, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BuildBytes {
    /// Vertices, indices and what else meshes of triangles have.
    pub triangles: usize,
    /// The same of bilinear patches.
    pub patches: usize,
    /// Control points and normals of curves.
    pub curves: usize,
    /// Spheres, disks and cylinders.
    pub quadrics: usize,
    /// Places of instances.
    pub instances: usize,
    /// Nodes and leaves of all trees, with the boxes of curves.
    pub hierarchy: usize,
}

impl BuildBytes {
    /// All together.
    pub fn total(&self) -> usize {
        self.triangles + self.patches + self.curves + self.quadrics + self.instances + self.hierarchy
    }
}

/// What building cost and gave.
#[derive(Clone, Copy, Debug, Default)]
pub struct BuildStats {
    /// Primitives that can be hit.
    pub primitives: usize,
    /// Primitives left out: without area, with coordinates that are not finite, or with vertices that do not exist.
    pub dropped: usize,
    /// Nodes of the hierarchy.
    pub nodes: usize,
    /// Bytes held by shapes and hierarchy.
    pub bytes: BuildBytes,
    /// Time taken, in seconds.
    pub build_seconds: f64,
}
