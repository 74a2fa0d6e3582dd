//! What has the same key put together: [`Groups`], and those of several keys: [`Joined`].

/// Numbers put together by their key, of which there may be many more than have numbers at a time.
#[derive(Default)]
pub(super) struct Groups {
    /// For each key the place of its group and one, or zero.
    place: Vec<u32>,
    /// Those that have numbers; each has the group in its place.
    keys: Vec<u32>,
    groups: Vec<Vec<u32>>,
}

impl Groups {
    /// Forgets all numbers; keys are below `n_keys`.
    pub(super) fn clear(&mut self, n_keys: usize) {
        for (key, group) in self.keys.drain(..).zip(&mut self.groups) {
            self.place[key as usize] = 0;
            group.clear();
        }
        self.place.resize(n_keys.max(self.place.len()), 0);
    }
    /// One more number.
    #[inline(always)]
    pub(super) fn push(&mut self, key: u32, i: u32) {
        let place = &mut self.place[key as usize];
        if *place == 0 {
            self.keys.push(key);
            *place = self.keys.len() as u32;
            self.groups.resize_with(self.groups.len().max(self.keys.len()), Vec::new);
        }
        self.groups[*place as usize - 1].push(i);
    }
    /// Sorts each group by depth.
    pub(super) fn sort_by_depth(&mut self, depth: impl Fn(u32) -> u32) {
        for group in &mut self.groups[..self.keys.len()] {
            if !group.is_sorted_by_key(|&i| depth(i)) {
                group.sort_unstable_by_key(|&i| (depth(i), i));
            }
        }
    }
    /// The groups, those larger than `size` in parts, each with its key; keys come in the order of their first number.
    pub(super) fn parts(&self, size: usize) -> impl Iterator<Item = (u32, &[u32])> {
        let groups = self.keys.iter().zip(&self.groups);
        groups.flat_map(move |(&key, group)| group.chunks(size).map(move |part| (key, part)))
    }
}

/// Groups put together once more.
#[derive(Default)]
pub(super) struct Joined {
    /// Places of the groups in the order in which they follow each other.
    order: Vec<usize>,
    /// The numbers of all groups.
    numbers: Vec<u32>,
    /// What the keys of neighbours have in common, and where their numbers end.
    ends: Vec<(u32, usize)>,
}

impl Joined {
    /// Joins groups for whose keys `of` gives the same.
    pub(super) fn fill(&mut self, groups: &Groups, of: impl Fn(u32) -> u32) {
        let Joined { order, numbers, ends } = self;
        numbers.clear();
        ends.clear();
        order.clear();
        order.extend(0..groups.keys.len());
        order.sort_unstable_by_key(|&g| (of(groups.keys[g]), g));
        for &g in &*order {
            numbers.extend_from_slice(&groups.groups[g]);
            let (common, end) = (of(groups.keys[g]), numbers.len());
            match ends.last_mut() {
                Some(last) if last.0 == common => last.1 = end,
                _ => ends.push((common, end)),
            }
        }
    }
    /// What was joined, in parts where it is longer than `size`, each with what `of` gave.
    pub(super) fn parts(&self, size: usize) -> impl Iterator<Item = (u32, &[u32])> {
        let begins = core::iter::once(0).chain(self.ends.iter().map(|&(_, end)| end));
        let all = begins.zip(&self.ends).map(|(begin, &(common, end))| (common, &self.numbers[begin..end]));
        all.flat_map(move |(common, numbers)| numbers.chunks(size).map(move |part| (common, part)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_one_key_stand_together_in_the_order_of_depth() {
        let (mut groups, mut joined) = (Groups::default(), Joined::default());
        let depth = |i: u32| [0, 0, 0, 0, 2, 1, 0][i as usize];
        for _ in 0..3 {
            groups.clear(5);
            for (i, key) in (0..).zip([3, 1, 3, 4, 1, 3, 3]) {
                groups.push(key, i);
            }
            groups.sort_by_depth(depth);
            let found: Vec<_> = groups.parts(3).collect();
            assert_eq!(found, [(3, &[0, 2, 6][..]), (3, &[5]), (1, &[1, 4]), (4, &[3])]);
            joined.fill(&groups, |key| key % 3);
            let found: Vec<_> = joined.parts(3).collect();
            assert_eq!(found, [(0, &[0, 2, 6][..]), (0, &[5]), (1, &[1, 4, 3])]);
        }
    }
}
