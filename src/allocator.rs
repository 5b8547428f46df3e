//! Memory allocator of the program: mimalloc, except that large arrays are mapped pages, which grow without being
//! copied.
#![allow(unsafe_code, reason = "an allocator hands out memory that nothing has a type for yet")]

use std::alloc::{GlobalAlloc, Layout};
use std::ptr::null_mut;

use burgeon_base::memory::MAPPED;
use mimalloc::MiMalloc;

/// Allocator for all threads.
pub(crate) struct ProgramAllocator;

const PAGE: usize = 4096;

fn is_mapped(size: usize, align: usize) -> bool {
    cfg!(target_os = "linux") && size >= MAPPED && align <= PAGE
}

// SAFETY: the layout alone determines whether an allocation is mapped, so each is returned to its origin. mimalloc's
// own contract is that of the trait, and mapped pages have the requested size, are aligned and are not shared.
unsafe impl GlobalAlloc for ProgramAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if is_mapped(layout.size(), layout.align()) {
            return map(layout.size());
        }
        // SAFETY: guaranteed by the caller.
        unsafe { MiMalloc.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        if is_mapped(layout.size(), layout.align()) {
            return map(layout.size());
        }
        // SAFETY: guaranteed by the caller.
        unsafe { MiMalloc.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        if is_mapped(layout.size(), layout.align()) {
            return unmap(at, layout.size());
        }
        // SAFETY: guaranteed by the caller.
        unsafe { MiMalloc.dealloc(at, layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        let mapped = [layout.size(), size].map(|size| is_mapped(size, layout.align()));
        match mapped {
            [true, true] => remap(at, layout.size(), size),
            // SAFETY: guaranteed by the caller.
            [false, false] => unsafe { MiMalloc.realloc(at, layout, size) },
            _ => {
                // SAFETY: the caller guarantees that the size is not 0 and does not exceed the maximum size of a
                // layout. Both allocations have room for the smaller size and do not overlap.
                unsafe {
                    let new = self.alloc(Layout::from_size_align_unchecked(size, layout.align()));
                    if !new.is_null() {
                        at.copy_to_nonoverlapping(new, size.min(layout.size()));
                        self.dealloc(at, layout);
                    }
                    new
                }
            }
        }
    }
}

/// Maps new pages, which are zeroed.
#[cfg(target_os = "linux")]
fn map(size: usize) -> *mut u8 {
    let (access, kind) = (libc::PROT_READ | libc::PROT_WRITE, libc::MAP_PRIVATE | libc::MAP_ANONYMOUS);
    // SAFETY: the call affects no existing memory.
    let at = unsafe { libc::mmap(null_mut(), size, access, kind, -1, 0) };
    if at == libc::MAP_FAILED { null_mut() } else { at.cast() }
}

/// Resizes mapped pages to the number that the new size needs, keeping their content. The address may change.
#[cfg(target_os = "linux")]
fn remap(at: *mut u8, from: usize, to: usize) -> *mut u8 {
    let [from, to] = [from, to].map(|size| size.next_multiple_of(PAGE));
    // SAFETY: the pages belong to one allocation, which its owner exchanges for the result.
    let at = unsafe { libc::mremap(at.cast(), from, to, libc::MREMAP_MAYMOVE) };
    if at == libc::MAP_FAILED { null_mut() } else { at.cast() }
}

#[cfg(target_os = "linux")]
fn unmap(at: *mut u8, size: usize) {
    // SAFETY: the pages belong to one allocation, which its owner releases.
    unsafe {
        libc::munmap(at.cast(), size.next_multiple_of(PAGE));
    }
}

#[cfg(not(target_os = "linux"))]
fn map(_: usize) -> *mut u8 {
    null_mut()
}

#[cfg(not(target_os = "linux"))]
fn remap(_: *mut u8, _: usize, _: usize) -> *mut u8 {
    null_mut()
}

#[cfg(not(target_os = "linux"))]
fn unmap(_: *mut u8, _: usize) {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_an_array_holds_stays_while_it_becomes_larger_and_smaller_than_what_is_mapped() {
        let sizes = [1000, MAPPED, 5 * MAPPED + 1, MAPPED + 4097, MAPPED - 1, 3 * MAPPED, 10];
        let layout = |size: usize| Layout::from_size_align(size, 8).expect("a layout");
        // SAFETY: each size is the size of the allocation at that time.
        unsafe {
            let mut at = ProgramAllocator.alloc_zeroed(layout(sizes[0]));
            for place in 0..10 {
                *at.add(place) = 7 + u8::try_from(place).expect("a digit");
            }
            for pair in sizes.windows(2) {
                at = ProgramAllocator.realloc(at, layout(pair[0]), pair[1]);
                assert!(!at.is_null() && at.addr().is_multiple_of(8));
                for place in 0..10 {
                    assert_eq!(usize::from(*at.add(place)), 7 + place, "{pair:?}");
                }
                *at.add(pair[1] - 1) = if pair[1] == 10 { 16 } else { 3 };
            }
            ProgramAllocator.dealloc(at, layout(10));
            let zeroed = ProgramAllocator.alloc_zeroed(layout(2 * MAPPED));
            assert_eq!((*zeroed, *zeroed.add(2 * MAPPED - 1)), (0, 0));
            ProgramAllocator.dealloc(zeroed, layout(2 * MAPPED));
            assert!(ProgramAllocator.alloc(layout(isize::MAX as usize - 7)).is_null());
        }
    }
}
