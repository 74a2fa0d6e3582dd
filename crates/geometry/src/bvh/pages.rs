//! Lists that rays read at random: [`Pages`].

use core::ops::{Deref, DerefMut};

use bytemuck::Pod;
use memmap2::MmapMut;

/// From this size on, in bytes, a list gets pages of its own.
const LARGE: usize = 2 << 20;

/// A list of fixed length. A large one lies in huge pages where the system has them: a ray that jumps about in it then
/// finds its addresses in the translation cache. The advice has to come before the memory is first touched.
pub(crate) enum Pages<T> {
    Heap(Vec<T>),
    Mapped { map: MmapMut, len: usize },
}

impl<T: Pod> Pages<T> {
    /// `len` elements, all bits zero.
    pub(crate) fn zeroed(len: usize) -> Pages<T> {
        let bytes = len * size_of::<T>();
        // Pages are aligned for every type of ours; where there are none to be had, the heap does as well.
        if bytes >= LARGE
            && let Ok(map) = MmapMut::map_anon(bytes)
        {
            #[cfg(target_os = "linux")]
            let _ = map.advise(memmap2::Advice::HugePage);
            return Pages::Mapped { map, len };
        }
        Pages::Heap(vec![T::zeroed(); len])
    }
}

impl<T: Pod> Deref for Pages<T> {
    type Target = [T];
    #[inline]
    fn deref(&self) -> &[T] {
        match self {
            Pages::Heap(list) => list,
            Pages::Mapped { map, len } => bytemuck::cast_slice(&map[..len * size_of::<T>()]),
        }
    }
}

impl<T: Pod> DerefMut for Pages<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        match self {
            Pages::Heap(list) => list,
            Pages::Mapped { map, len } => bytemuck::cast_slice_mut(&mut map[..*len * size_of::<T>()]),
        }
    }
}

impl<T: Pod> From<Vec<T>> for Pages<T> {
    fn from(list: Vec<T>) -> Pages<T> {
        if size_of_val(&*list) < LARGE {
            return Pages::Heap(list);
        }
        let mut pages = Pages::zeroed(list.len());
        pages.copy_from_slice(&list);
        pages
    }
}

impl<T: Pod> Clone for Pages<T> {
    fn clone(&self) -> Pages<T> {
        let mut copy = Pages::zeroed(self.len());
        copy.copy_from_slice(self);
        copy
    }
}

impl<T: Pod + core::fmt::Debug> core::fmt::Debug for Pages<T> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.deref().fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_lists_are_lists() {
        for len in [0, 7, 3 * LARGE / 8 + 5] {
            let mut list = Pages::<u64>::zeroed(len);
            assert!(list.len() == len && list.iter().all(|&x| x == 0));
            list.iter_mut().zip(0..).for_each(|(x, i)| *x = i);
            assert!(list.iter().copied().eq(0..len as u64));
            assert!(Pages::from(list.to_vec()).iter().eq(list.iter()));
        }
    }
}
