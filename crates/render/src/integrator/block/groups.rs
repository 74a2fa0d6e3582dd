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
    /// The key of each number, where these are sorted.
    keys: Vec<u8>,
    /// Groups in the order in which they follow each other.
    order: Vec<usize>,
    /// The numbers of all groups.
    numbers: Vec<u32>,
    /// What the keys of neighbours have in common, and where their numbers end.
    ends: Vec<(u32, usize)>,
}

impl Joined {
    /// Takes groups as they are.
    pub(super) fn fill(&mut self, groups: &Groups) {
        self.numbers.clear();
        self.ends.clear();
        for (&key, group) in groups.keys.iter().zip(&groups.groups) {
            self.numbers.extend_from_slice(group);
            self.ends.push((key, self.numbers.len()));
        }
    }
    /// Numbers from zero on, of which there are `keys`, put together by what `of` gives for these, and among those by key.
    pub(super) fn sort(&mut self, keys_of_all: impl Iterator<Item = u8>, of: impl Fn(u8) -> u32) {
        let Joined { keys, order, numbers, ends } = self;
        keys.clear();
        keys.extend(keys_of_all);
        let mut places = [0; 256];
        keys.iter().for_each(|&key| places[usize::from(key)] += 1);
        order.clear();
        order.extend((0..places.len()).filter(|&key| places[key] > 0));
        order.sort_unstable_by_key(|&key| (of(key as u8), key));
        ends.clear();
        let mut end = 0;
        for &key in &*order {
            end += core::mem::replace(&mut places[key], end);
            let common = of(key as u8);
            match ends.last_mut() {
                Some(last) if last.0 == common => last.1 = end,
                _ => ends.push((common, end)),
            }
        }
        numbers.resize(keys.len(), 0);
        let numbers = &mut numbers[..];
        for (i, &key) in (0..).zip(&*keys) {
            let place = &mut places[usize::from(key)];
            numbers[*place] = i;
            *place += 1;
        }
    }
    /// Takes away the last group, if `of` gave this for it.
    pub(super) fn pop(&mut self, common: u32) -> &[u32] {
        let Some(&(last, end)) = self.ends.last() else { return &[] };
        if last != common {
            return &[];
        }
        self.ends.pop();
        let begin = self.ends.last().map_or(0, |&(_, end)| end);
        &self.numbers[begin..end]
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
            joined.fill(&groups);
            assert_eq!(joined.parts(3).collect::<Vec<_>>(), found);
            joined.sort([3, 1, 3, 4, 1, 3, 3].into_iter(), |key| u32::from(key % 3));
            assert_eq!(joined.pop(0), []);
            assert_eq!(
                joined.parts(3).collect::<Vec<_>>(),
                [(0, &[0, 2, 5][..]), (0, &[6]), (1, &[1, 4, 3])]
            );
            assert_eq!(joined.pop(1), [1, 4, 3]);
            assert_eq!(joined.parts(4).collect::<Vec<_>>(), [(0, &[0, 2, 5, 6][..])]);
        }
    }
}
