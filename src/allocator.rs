//! Where memory comes from: small pieces from an allocator that is quick on several threads, arrays from the system.

use std::alloc::{GlobalAlloc, Layout, System};

use mimalloc::MiMalloc;

/// From this size (bytes) on, memory comes from the system, which takes it back at once and moves what grows without
/// copying it.
const LARGE: usize = 1 << 17;

/// Modules, buildings and meshes come and go by the million, in small pieces.
pub(crate) struct Allocator;

fn is_large(size: usize) -> bool {
    size >= LARGE
}

#[allow(unsafe_code, reason = "no safe interface is an allocator")]
// SAFETY: each piece is given back to where its size says that it came from; what both need is what the caller promises.
unsafe impl GlobalAlloc for Allocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: as promised by the caller.
        unsafe { if is_large(layout.size()) { System.alloc(layout) } else { MiMalloc.alloc(layout) } }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: as promised by the caller.
        unsafe {
            if is_large(layout.size()) { System.alloc_zeroed(layout) } else { MiMalloc.alloc_zeroed(layout) }
        }
    }

    unsafe fn dealloc(&self, piece: *mut u8, layout: Layout) {
        // SAFETY: it came from there.
        unsafe {
            if is_large(layout.size()) {
                System.dealloc(piece, layout)
            } else {
                MiMalloc.dealloc(piece, layout)
            }
        }
    }

    unsafe fn realloc(&self, piece: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: it came from there; where it goes elsewhere, both are as long as what is copied and do not overlap.
        unsafe {
            match (is_large(layout.size()), is_large(size)) {
                (true, true) => System.realloc(piece, layout, size),
                (false, false) => MiMalloc.realloc(piece, layout, size),
                _ => {
                    let moved = self.alloc(Layout::from_size_align_unchecked(size, layout.align()));
                    if !moved.is_null() {
                        piece.copy_to_nonoverlapping(moved, size.min(layout.size()));
                        self.dealloc(piece, layout);
                    }
                    moved
                }
            }
        }
    }
}
