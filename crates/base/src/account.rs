//! Memory accounts: the memory in use by each run, counted at each allocation and free.
//!
//! A run has one [`MemoryAccount`] for all its data, so data structures need no code to enforce the limit. The
//! program's allocator, [`CountingAllocator`], reports each allocation and each free here, and the thread's current
//! account is charged or credited. A thread charges the account of the run whose [`Stop`](crate::Stop) it works for.
//! Tasks on other threads enter the account with [`MemoryOwner`].
//!
//! An account that exceeds its limit does not make an allocation fail, because most Rust code cannot handle that. The
//! account is marked as exceeded, and the run's `Stop` reports an error: all long work polls it, and scripts are
//! interrupted.
//!
//! A host program without this allocator has no accounts. The limit then applies only to each virtual machine and to
//! file readers.

use std::alloc::{GlobalAlloc, Layout};
use std::cell::Cell;
use std::sync::atomic::{AtomicBool, AtomicIsize, AtomicU16, Ordering};

use crate::error::{Error, Limit, Result};

/// Maximum number of open accounts plus one. Slot 0 belongs to no run and has no limit.
const SLOTS: usize = 512;
/// Number of bytes that a thread counts locally before it charges them, to avoid contention on the counter.
const PENDING: isize = 64 << 10;

static TABLE: [AccountSlot; SLOTS] = [const { AccountSlot::new() }; SLOTS];
/// Slot for threads that work for no run.
static ADOPTED: AtomicU16 = AtomicU16::new(0);

thread_local! {
    // The count has no destructor, so the allocator can use it at any time.
    static THREAD: ThreadCount = const { ThreadCount { slot: Cell::new(0), pending: Cell::new(0) } };
}

/// Slot of an account, on its own cache line.
#[repr(align(64))]
struct AccountSlot {
    used: AtomicIsize,
    limit: AtomicIsize,
    exceeded: AtomicBool,
    open: AtomicBool,
}

/// Allocation count of a thread.
struct ThreadCount {
    /// Slot of the account that the thread works for; 0 for none.
    slot: Cell<u16>,
    /// Bytes that are not charged yet.
    pending: Cell<isize>,
}

impl AccountSlot {
    const fn new() -> Self {
        Self {
            used: AtomicIsize::new(0),
            limit: AtomicIsize::new(isize::MAX),
            exceeded: AtomicBool::new(false),
            open: AtomicBool::new(false),
        }
    }

    fn add(&self, bytes: isize) {
        let used = self.used.fetch_add(bytes, Ordering::Relaxed).wrapping_add(bytes);
        if bytes > 0 && used > self.limit.load(Ordering::Relaxed) {
            self.exceeded.store(true, Ordering::Relaxed);
        }
    }
}

impl ThreadCount {
    /// Charges all pending bytes.
    fn settle(&self) {
        MemoryOwner { slot: self.slot.get() }.entry().add(self.pending.replace(0));
    }
}

/// Counts bytes that this thread has allocated, or freed if the number is negative.
#[inline]
fn count(bytes: isize) {
    // A thread that is exiting is not counted.
    let _ = THREAD.try_with(|thread| {
        let pending = thread.pending.get() + bytes;
        thread.pending.set(pending);
        if pending.unsigned_abs() >= PENDING.unsigned_abs() {
            thread.settle();
        }
    });
}

/// Memory account of one run.
#[derive(Debug)]
pub struct MemoryAccount {
    slot: u16,
    limit: usize,
}

impl MemoryAccount {
    /// Opens an account with a limit (bytes). If too many accounts are open, it counts nothing.
    pub fn new(limit: usize) -> Self {
        let free = |slot: &&u16| {
            let open = &TABLE[usize::from(**slot)].open;
            open.compare_exchange(false, true, Ordering::Acquire, Ordering::Relaxed).is_ok()
        };
        #[allow(clippy::cast_possible_truncation, reason = "a small constant")]
        let slots: [u16; SLOTS - 1] = std::array::from_fn(|index| index as u16 + 1);
        let Some(slot) = slots.iter().find(free).copied() else { return Self { slot: 0, limit: usize::MAX } };
        let entry = &TABLE[usize::from(slot)];
        entry.used.store(0, Ordering::Relaxed);
        entry.exceeded.store(false, Ordering::Relaxed);
        entry.limit.store(isize::try_from(limit).unwrap_or(isize::MAX), Ordering::Relaxed);
        Self { slot, limit }
    }

    /// Charges this account for all threads that work for no run, until the account is closed. For programs that run
    /// one script.
    pub fn adopt_threads(&self) {
        ADOPTED.store(self.slot, Ordering::Relaxed);
    }

    /// Returns the account as an owner to charge for allocations.
    pub fn owner(&self) -> MemoryOwner {
        MemoryOwner { slot: self.slot }
    }

    /// Returns true if the account has ever exceeded its limit.
    #[inline]
    pub fn is_exceeded(&self) -> bool {
        TABLE[usize::from(self.slot)].exceeded.load(Ordering::Relaxed)
    }

    /// Returns the memory (bytes) that may still be allocated.
    pub fn remaining(&self) -> usize {
        self.owner().remaining()
    }

    /// Returns true if more than half of the limit is used.
    pub fn is_half_full(&self) -> bool {
        self.remaining() < self.limit / 2
    }

    /// Returns the error for a run that exceeds the limit.
    pub fn error(&self) -> Error {
        too_much(self.limit)
    }
}

/// Returns the error for a run that needs more than `limit` (bytes).
fn too_much(limit: usize) -> Error {
    Error::limit(Limit::Memory, format!("the run exceeds the memory limit of {} MB", limit / 1_000_000))
        .help("look for a growing table, string or report, or raise the limit: --memory-limit MEGABYTES")
}

impl Drop for MemoryAccount {
    fn drop(&mut self) {
        if self.slot == 0 {
            return;
        }
        let _ = ADOPTED.compare_exchange(self.slot, 0, Ordering::Relaxed, Ordering::Relaxed);
        let entry = &TABLE[usize::from(self.slot)];
        entry.limit.store(isize::MAX, Ordering::Relaxed);
        entry.open.store(false, Ordering::Release);
    }
}

/// Account that a thread currently charges, which can be passed to other threads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MemoryOwner {
    slot: u16,
}

impl MemoryOwner {
    /// Owner of allocations by threads that work for no run.
    pub const NOBODY: Self = Self { slot: 0 };

    /// Returns the owner that this thread charges.
    pub fn current() -> Self {
        Self { slot: THREAD.try_with(|thread| thread.slot.get()).unwrap_or(0) }
    }

    /// Charges this owner for the allocations of `work` in this thread.
    pub fn charge<T>(self, work: impl FnOnce() -> T) -> T {
        let _entered = self.enter();
        work()
    }

    /// Charges this owner for the allocations of this thread until the returned guard is dropped.
    #[must_use]
    pub fn enter(self) -> OwnerGuard {
        OwnerGuard { before: switch(self) }
    }

    /// Returns true if `bytes` more may be allocated, and otherwise marks the account as exceeded.
    pub fn demand(self, bytes: usize) -> bool {
        let has_room = bytes <= self.remaining();
        if !has_room {
            self.entry().exceeded.store(true, Ordering::Relaxed);
        }
        has_room
    }

    /// Fails and ends the current thread's run if the run may not use `bytes` more. Call it before a single allocation
    /// whose size a script or a file determines.
    pub fn ensure_room(bytes: usize) -> Result<()> {
        let owner = Self::current();
        if owner.demand(bytes) {
            return Ok(());
        }
        Err(too_much(owner.entry().limit.load(Ordering::Relaxed).unsigned_abs()))
    }

    fn entry(self) -> &'static AccountSlot {
        let slot = if self.slot == 0 { ADOPTED.load(Ordering::Relaxed) } else { self.slot };
        &TABLE[usize::from(slot)]
    }

    /// Returns the memory (bytes) that may still be allocated; a very large number if there is no limit.
    pub fn remaining(self) -> usize {
        let entry = self.entry();
        let limit = entry.limit.load(Ordering::Relaxed);
        usize::try_from(limit.saturating_sub(entry.used.load(Ordering::Relaxed))).unwrap_or(0)
    }
}

/// Guard that charges an owner in this thread until it is dropped.
#[derive(Debug)]
pub struct OwnerGuard {
    before: MemoryOwner,
}

impl Drop for OwnerGuard {
    fn drop(&mut self) {
        switch(self.before);
    }
}

/// Charges `owner` in this thread from now on. Returns the previous owner.
pub(crate) fn switch(owner: MemoryOwner) -> MemoryOwner {
    let before = THREAD.try_with(|thread| {
        if thread.slot.get() != owner.slot {
            thread.settle();
        }
        thread.slot.replace(owner.slot)
    });
    MemoryOwner { slot: before.unwrap_or(0) }
}

/// Allocator that counts the memory of runs.
///
/// ```
/// use burgeon_base::account::CountingAllocator;
///
/// #[global_allocator]
/// static ALLOCATOR: CountingAllocator<std::alloc::System> = CountingAllocator(std::alloc::System);
/// ```
#[derive(Debug)]
pub struct CountingAllocator<A>(pub A);

/// Converts a size to a signed number. The size of a layout always fits.
#[inline]
#[allow(clippy::cast_possible_wrap, reason = "a layout has at most isize::MAX bytes")]
fn signed_size(size: usize) -> isize {
    size as isize
}

#[allow(unsafe_code, reason = "an allocator is made of another one")]
// SAFETY: all calls are forwarded to an allocator that fulfils the contract; counting neither allocates nor unwinds.
unsafe impl<A: GlobalAlloc> GlobalAlloc for CountingAllocator<A> {
    #[inline]
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: guaranteed by the caller.
        let at = unsafe { self.0.alloc(layout) };
        if !at.is_null() {
            count(signed_size(layout.size()));
        }
        at
    }

    #[inline]
    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: guaranteed by the caller.
        let at = unsafe { self.0.alloc_zeroed(layout) };
        if !at.is_null() {
            count(signed_size(layout.size()));
        }
        at
    }

    #[inline]
    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        // SAFETY: guaranteed by the caller.
        unsafe { self.0.dealloc(at, layout) }
        count(-signed_size(layout.size()));
    }

    #[inline]
    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: guaranteed by the caller.
        let new = unsafe { self.0.realloc(at, layout, size) };
        if !new.is_null() {
            count(signed_size(size) - signed_size(layout.size()));
        }
        new
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[global_allocator]
    static ALLOCATOR: CountingAllocator<std::alloc::System> = CountingAllocator(std::alloc::System);

    const MB: usize = 1_000_000;

    #[test]
    fn an_account_counts_what_its_threads_hold_and_remembers_that_it_was_exceeded() {
        let account = MemoryAccount::new(10 * MB);
        let owner = account.owner();
        let kept = owner.charge(|| vec![1_u8; 4 * MB]);
        assert!((5 * MB..6 * MB + MB / 2).contains(&account.remaining()), "{}", account.remaining());
        let other = std::thread::spawn(move || owner.charge(|| vec![1_u8; 4 * MB])).join().unwrap();
        assert!(account.is_half_full() && !account.is_exceeded());
        owner.charge(|| drop((kept, other)));
        assert!(account.remaining() > 9 * MB, "{}", account.remaining());
        owner.charge(|| drop(vec![1_u8; 11 * MB]));
        assert!(account.is_exceeded());
        insta::assert_snapshot!(account.error(), @r"
        the run exceeds the memory limit of 10 MB
          help: look for a growing table, string or report, or raise the limit: --memory-limit MEGABYTES
        ");
    }

    #[test]
    fn what_a_thread_allocates_for_others_is_not_charged() {
        let (account, other) = (MemoryAccount::new(10 * MB), MemoryAccount::new(10 * MB));
        let entered = account.owner().enter();
        let kept = other.owner().charge(|| vec![1_u8; 8 * MB]);
        assert!(account.remaining() > 9 * MB && other.remaining() < 3 * MB);
        drop(entered);
        drop(kept);
        assert!(account.remaining() > 9 * MB && other.remaining() < 3 * MB);
    }

    #[test]
    fn an_account_that_is_opened_again_begins_empty() {
        for _ in 0..2 * SLOTS {
            let account = MemoryAccount::new(MB);
            assert!(!account.is_exceeded() && account.slot != 0);
            account.owner().charge(|| drop(vec![1_u8; 2 * MB]));
            assert!(account.is_exceeded());
        }
    }
}
