//! What a traversal still has to visit: [`Stack`].

#![allow(unsafe_code, reason = "clearing the stack of every ray would cost as much as a few nodes")]

use core::mem::MaybeUninit;

use super::node::Child;

/// Entries a stack holds; a tree that could need more is not built.
pub(crate) const STACK_SIZE: usize = 640;

/// A child and where the ray enters its box, as one number that sorts by that distance: distances are not negative, so
/// their bits sort as they do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Entry(u64);

impl Entry {
    #[inline(always)]
    pub(crate) fn new(t: f32, child: Child) -> Entry {
        Entry(u64::from(t.to_bits()) << 32 | u64::from(child.0))
    }
    #[inline(always)]
    pub(crate) fn child(self) -> Child {
        Child(self.0 as u32)
    }
    #[inline(always)]
    fn t(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }
}

/// What is left to visit, nearest on top.
pub(crate) struct Stack {
    entries: [MaybeUninit<Entry>; STACK_SIZE],
    len: usize,
}

impl Stack {
    #[inline(always)]
    pub(crate) fn new() -> Stack {
        Stack { entries: [const { MaybeUninit::uninit() }; STACK_SIZE], len: 0 }
    }
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.len
    }
    /// Puts an entry on top; does nothing where the stack is full, which the size of a tree rules out.
    #[inline(always)]
    pub(crate) fn push(&mut self, e: Entry) {
        debug_assert!(self.len < STACK_SIZE, "trees are built to fit the stack");
        if let Some(top) = self.entries.get_mut(self.len) {
            top.write(e);
            self.len += 1;
        }
    }
    /// The next child whose box begins before `t_max`.
    #[inline(always)]
    pub(crate) fn pop(&mut self, t_max: f32) -> Option<Child> {
        while self.len > 0 {
            self.len -= 1;
            let e = self.at(self.len);
            if e.t() < t_max {
                return Some(e.child());
            }
        }
        None
    }
    /// Sorts the entries from place `bottom` on, the nearest to the top.
    #[inline(always)]
    pub(crate) fn sort_from(&mut self, bottom: usize) {
        for end in bottom + 1..self.len {
            let e = self.at(end);
            let mut i = end;
            while i > bottom && self.at(i - 1) < e {
                self.entries[i] = self.entries[i - 1];
                i -= 1;
            }
            self.entries[i] = MaybeUninit::new(e);
        }
    }
    /// An entry that was pushed: `i` is below a length that the stack has had since it was made.
    #[inline(always)]
    fn at(&self, i: usize) -> Entry {
        // SAFETY: `push` alone raises `len`, and writes the entry first; nothing makes an entry uninitialised again.
        unsafe { self.entries[i].assume_init() }
    }
}
