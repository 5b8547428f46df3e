//! Memory for arrays of many megabytes: fresh pages cost more than what is written to them.

use crate::account::MemoryOwner;

/// Arrays from this size (bytes) on are given huge pages where they grow.
const LARGE: usize = 2 << 20;
/// Those that take no more than they need are from this size (bytes) on, of which a part of a huge page is not much.
const LARGE_AND_EXACT: usize = 16 << 20;
/// Arrays from this size (bytes) on are taken from the system itself by the program's allocator, as by most: they grow without
/// being copied.
pub const MAPPED: usize = 16 << 20;
/// Memory (bytes) that a run must still be allowed to use for arrays to reserve much more than they hold.
const PLENTY: usize = 1 << 30;
/// What a large array reserves at least (bytes) where it grows, so that it is copied once and mapped from then on: more than
/// glibc ever takes from its heap.
const RESERVED: usize = 33 << 20;

/// Makes room for `more` items in `array`, which doubles when it grows, or grows to 33 MB once it is large: memory that is not
/// touched costs nothing, and copying does. From then on it grows by a quarter, without being copied.
///
/// A run that is near its memory limit reserves less, since reserved memory counts.
///
/// A large array is laid on huge pages where the system has them, so that it is faulted in and cleared in pieces
/// of megabytes. Twenty million points and triangles (480 MB), added one by one, take 0.06 s of CPU time so, and 0.19 s
/// on pages of 4 KB.
#[inline]
pub fn make_room<T>(array: &mut Vec<T>, more: usize) {
    if array.capacity() - array.len() < more {
        grow(array, more);
    }
}

/// Makes room for `more` items in `array` and no more than that: for those who know how many there will be.
pub fn make_exact_room<T>(array: &mut Vec<T>, more: usize) {
    if array.capacity() - array.len() < more {
        array.reserve_exact(more);
        advise_from(LARGE_AND_EXACT, array);
    }
}

/// So many zeros, or what else is the default: on huge pages where they are many, as they are first written to.
pub fn zeroed<T: Clone + Default>(count: usize) -> Vec<T> {
    let array = vec![T::default(); count];
    advise_from(LARGE_AND_EXACT, &array);
    array
}

#[cold]
fn grow<T>(array: &mut Vec<T>, more: usize) {
    let needed = array.len() + more;
    let capacity = needed.max(2 * array.capacity());
    if capacity * size_of::<T>() < LARGE {
        array.reserve(more);
        return;
    }
    let bytes = array.capacity() * size_of::<T>();
    let has_plenty = MemoryOwner::current().remaining() > PLENTY;
    let capacity = match bytes {
        MAPPED.. => needed.max(array.capacity() + array.capacity() / 4),
        _ if has_plenty => capacity.max(RESERVED / size_of::<T>()),
        _ => capacity,
    };
    if bytes >= MAPPED {
        array.reserve_exact(capacity - array.len());
        advise_from(LARGE, array);
        return;
    }
    let mut larger: Vec<T> = Vec::with_capacity(capacity);
    // Before anything is written: what is there already lies on pages of its own.
    advise_from(LARGE, &larger);
    larger.append(array);
    *array = larger;
}

/// Asks for huge pages for an array, if it has so many bytes or more.
fn advise_from<T>(least: usize, array: &Vec<T>) {
    let bytes = array.capacity() * size_of::<T>();
    if bytes >= least {
        advise(array.as_ptr() as usize, bytes);
    }
}

/// Asks for huge pages in a range of memory. It is only advice: a refusal changes nothing.
#[cfg(target_os = "linux")]
fn advise(start: usize, bytes: usize) {
    const PAGE: usize = 4096;
    // Whole pages, since an allocation that has this advice for only a part of it cannot be moved without copying.
    let first = start / PAGE * PAGE;
    let length = (start + bytes).next_multiple_of(PAGE) - first;
    #[allow(unsafe_code, reason = "no safe interface gives this advice for memory of the global allocator")]
    // SAFETY: MADV_HUGEPAGE changes neither what pages hold nor how they may be used, and all pages of the range hold
    // a part of an allocation that is alive.
    unsafe {
        libc::madvise(first as *mut libc::c_void, length, libc::MADV_HUGEPAGE);
    }
}

#[cfg(not(target_os = "linux"))]
fn advise(_: usize, _: usize) {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_array_keeps_its_items_while_it_grows_large() {
        let mut array: Vec<u64> = Vec::new();
        for item in 0..3 << 20 {
            make_room(&mut array, 1);
            let before = array.capacity();
            array.push(item);
            assert_eq!(array.capacity(), before);
        }
        assert!(array.iter().copied().eq(0..3 << 20));
        make_exact_room(&mut array, 5 << 20);
        assert!((8 << 20..9 << 20).contains(&array.capacity()));
        assert!(array.iter().copied().eq(0..3 << 20));
    }
}
