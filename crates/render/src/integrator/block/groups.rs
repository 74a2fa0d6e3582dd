//! Vertices put together by what they scatter with: [`Groups`].

use core::ops::Range;

/// Vertices with the same key stand side by side; keys come in the order of their first vertex.
#[derive(Default)]
pub(super) struct Groups {
    /// Key, depth and path of each vertex.
    vertices: Vec<(u32, u32, u32)>,
    /// For each key the number of its vertices, later the place of the next one.
    place: Vec<u32>,
    keys: Vec<u32>,
    /// Vertices came in the order of their depth.
    in_order: bool,
    sorted: Vec<u32>,
    batches: Vec<(u32, Range<usize>)>,
}

impl Groups {
    /// Forgets all vertices; keys are below `n_keys`.
    pub(super) fn clear(&mut self, n_keys: usize) {
        self.vertices.clear();
        self.in_order = true;
        self.keys.drain(..).for_each(|key| self.place[key as usize] = 0);
        self.place.resize(n_keys.max(self.place.len()), 0);
    }
    /// One more vertex.
    pub(super) fn push(&mut self, key: u32, depth: u32, path: u32) {
        let count = &mut self.place[key as usize];
        if *count == 0 {
            self.keys.push(key);
        }
        *count += 1;
        self.in_order &= self.vertices.last().is_none_or(|last| last.1 <= depth);
        self.vertices.push((key, depth, path));
    }
    /// Sorts them into batches of at most `size`; if asked, with the shallow before the deep.
    pub(super) fn sort(&mut self, size: usize, by_depth: bool) {
        if by_depth && !self.in_order {
            self.vertices.sort_unstable_by_key(|&(_, depth, path)| (depth, path));
        }
        let mut next = 0;
        self.batches.clear();
        for &key in &self.keys {
            let place = &mut self.place[key as usize];
            let (start, end) = (next, next + *place as usize);
            let batch = |first: usize| (key, first..end.min(first + size));
            self.batches.extend((start..end).step_by(size).map(batch));
            *place = start as u32;
            next = end;
        }
        self.sorted.resize(self.vertices.len(), 0);
        for &(key, _, path) in &self.vertices {
            let place = &mut self.place[key as usize];
            self.sorted[*place as usize] = path;
            *place += 1;
        }
    }
    /// Number of batches.
    pub(super) fn len(&self) -> usize {
        self.batches.len()
    }
    /// The key of a batch, and its paths.
    pub(super) fn batch(&self, i: usize) -> (u32, &[u32]) {
        let (key, range) = &self.batches[i];
        (*key, &self.sorted[range.clone()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_of_one_key_stand_together_in_the_order_of_depth() {
        let mut groups = Groups::default();
        for round in 0..3 {
            groups.clear(5);
            for path in 0..7 {
                groups.push([3, 1, 3, 4, 1, 3, 3][path], [0, 0, 0, 0, 2, 1, 0][path], path as u32 + round);
            }
            groups.sort(3, true);
            let found: Vec<_> = (0..groups.len()).map(|i| groups.batch(i)).collect();
            let moved = |paths: &[u32]| paths.iter().map(|p| p + round).collect::<Vec<_>>();
            let (three, rest, one, four) = (moved(&[0, 2, 6]), moved(&[5]), moved(&[1, 4]), moved(&[3]));
            assert_eq!(found, [(3, &three[..]), (3, &rest[..]), (1, &one[..]), (4, &four[..])]);
        }
    }
}
