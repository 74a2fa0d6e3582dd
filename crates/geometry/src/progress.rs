//! How far a build is: [`BuildProgress`].

use core::sync::atomic::{AtomicUsize, Ordering};

/// How much of a geometry has its place in a hierarchy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuildProgress {
    /// Primitives, parts of curves and instances that have theirs.
    pub placed: usize,
    /// All of them; estimated for curves.
    pub total: usize,
}

/// Is told now and then, by any thread, how far a build is, and once at the end. The result of the build does not depend on it.
pub type BuildObserver<'a> = &'a (dyn Fn(BuildProgress) + Sync);

/// Counts what has its place.
pub(crate) struct Progress<'a> {
    observer: Option<BuildObserver<'a>>,
    placed: AtomicUsize,
    total: usize,
}

impl<'a> Progress<'a> {
    pub(crate) fn new(observer: Option<BuildObserver<'a>>, total: usize) -> Progress<'a> {
        Progress { observer, placed: AtomicUsize::new(0), total }
    }
    /// For thousands at a time.
    pub(crate) fn add(&self, n: usize) {
        let Some(observer) = self.observer else { return };
        let placed = self.placed.fetch_add(n, Ordering::Relaxed) + n;
        // Where triangles are cut, more than there were are placed.
        observer(BuildProgress { placed: placed.min(self.total), total: self.total });
    }
    pub(crate) fn finish(&self) {
        if let Some(observer) = self.observer {
            observer(BuildProgress { placed: self.total, total: self.total });
        }
    }
}
