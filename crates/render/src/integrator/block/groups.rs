//! What has the same key put together: [`Groups`].

/// Numbers put together by their key.
#[derive(Default)]
pub(super) struct Groups {
    of_key: Vec<Vec<u32>>,
    /// Those that have numbers.
    keys: Vec<u32>,
}

impl Groups {
    /// Forgets all numbers; keys are below `n_keys`.
    pub(super) fn clear(&mut self, n_keys: usize) {
        self.keys.drain(..).for_each(|key| self.of_key[key as usize].clear());
        self.of_key.resize_with(n_keys.max(self.of_key.len()), Vec::new);
    }
    /// One more number.
    #[inline(always)]
    pub(super) fn push(&mut self, key: u32, i: u32) {
        let group = &mut self.of_key[key as usize];
        if group.is_empty() {
            self.keys.push(key);
        }
        group.push(i);
    }
    /// Sorts each group by depth.
    pub(super) fn sort_by_depth(&mut self, depth: impl Fn(u32) -> u32) {
        for &key in &self.keys {
            let group = &mut self.of_key[key as usize];
            if !group.is_sorted_by_key(|&i| depth(i)) {
                group.sort_unstable_by_key(|&i| (depth(i), i));
            }
        }
    }
    /// The groups, those larger than `size` in parts, each with its key; keys come in the order of their first number.
    pub(super) fn parts(&self, size: usize) -> impl Iterator<Item = (u32, &[u32])> {
        let parts = move |&key: &u32| self.of_key[key as usize].chunks(size).map(move |part| (key, part));
        self.keys.iter().flat_map(parts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_one_key_stand_together_in_the_order_of_depth() {
        let mut groups = Groups::default();
        let depth = |i: u32| [0, 0, 0, 0, 2, 1, 0][i as usize];
        for _ in 0..3 {
            groups.clear(5);
            for (i, key) in (0..).zip([3, 1, 3, 4, 1, 3, 3]) {
                groups.push(key, i);
            }
            groups.sort_by_depth(depth);
            let found: Vec<_> = groups.parts(3).collect();
            assert_eq!(found, [(3, &[0, 2, 6][..]), (3, &[5]), (1, &[1, 4]), (4, &[3])]);
        }
    }
}
