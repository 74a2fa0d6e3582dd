//! The ways on of camera samples, put together again: [`Families`].

use crate::integrator::start::FilmPlace;

/// Camera samples under way, each with the parts that its ways on have given. Parts are added in the order of the ways,
/// whichever ends first.
#[derive(Default)]
pub(super) struct Families {
    splits: usize,
    families: Vec<Family>,
    /// Parts of the first family, then of the second.
    parts: Vec<[f32; 3]>,
    free: Vec<u32>,
}

struct Family {
    place: FilmPlace,
    /// Ways that have not ended.
    left: u32,
}

impl Families {
    /// Forgets all; each camera sample goes on in so many ways at most.
    pub(super) fn begin(&mut self, splits: u32) {
        self.splits = splits as usize;
        self.families.clear();
        self.parts.clear();
        self.free.clear();
    }
    /// A camera sample, with one way; ways that it never takes give nothing.
    pub(super) fn push(&mut self, place: FilmPlace) -> u32 {
        let family = Family { place, left: 1 };
        if let Some(i) = self.free.pop() {
            let first = i as usize * self.splits;
            self.families[i as usize] = family;
            self.parts[first..first + self.splits].fill([0.0; 3]);
            return i;
        }
        self.families.push(family);
        self.parts.resize(self.families.len() * self.splits, [0.0; 3]);
        self.families.len() as u32 - 1
    }
    /// More ways.
    pub(super) fn grow(&mut self, family: u32, n: u32) {
        self.families[family as usize].left += n;
    }
    /// Takes the part of a way that has ended; gives the whole where it was the last.
    pub(super) fn take(&mut self, family: u32, way: u32, part: [f32; 3]) -> Option<(FilmPlace, &[[f32; 3]])> {
        let first = family as usize * self.splits;
        let parts = &mut self.parts[first..first + self.splits];
        let family_of = &mut self.families[family as usize];
        family_of.left -= 1;
        parts[way as usize] = part;
        if family_of.left > 0 {
            return None;
        }
        self.free.push(family);
        Some((family_of.place, parts))
    }
}
