//! Memory accounts: the memory that each run holds, counted where memory is allocated and freed.
//!
//! A run has one [`MemoryAccount`] for everything it keeps, so no store needs code of its own to be limited. The program's
//! allocator, [`CountingAllocator`], reports each allocation and each free here, and the thread's current account is charged
//! or credited. A thread charges the account of the run whose [`Stop`](crate::Stop) it works for; tasks on other threads enter
//! the account with [`MemoryOwner`].
//!
//! An account over its limit does not fail an allocation, since most Rust code cannot go on without it. It is marked as
//! exceeded, and the run's `Stop` reports this as an error: all long work polls it, and scripts are interrupted.
//!
//! A host program without this allocator has no such accounts: then the limit holds for each virtual machine and for the
//! readers of files only.

use std::alloc::{GlobalAlloc, Layout};
use std::cell::Cell;
use std::sync::atomic::{AtomicBool, AtomicIsize, AtomicU16, Ordering};

use crate::error::{Error, Limit, Result};

/// Accounts that can be open at the same time; slot 0 is nobody's and has no limit.
const SLOTS: usize = 512;
/// Bytes that a thread counts by itself before it charges them, so that threads do not compete for the counter.
const PENDING: isize = 64 << 10;

static TABLE: [AccountSlot; SLOTS] = [const { AccountSlot::new() }; SLOTS];
/// The slot for threads that work for no run.
static ADOPTED: AtomicU16 = AtomicU16::new(0);

thread_local! {
    // Without a destructor, so that an allocator may use it at any time.
    static THREAD: ThreadCount = const { ThreadCount { slot: Cell::new(0), pending: Cell::new(0) } };
}

/// One account. Each has a cache line of its own.
#[repr(align(64))]
struct AccountSlot {
    used: AtomicIsize,
    limit: AtomicIsize,
    exceeded: AtomicBool,
    open: AtomicBool,
}

/// The count of a thread.
struct ThreadCount {
    /// The account that the thread works for; 0 for none.
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
    /// Charges everything that is pending.
    fn settle(&self) {
        MemoryOwner { slot: self.slot.get() }.entry().add(self.pending.replace(0));
    }
}

/// Counts bytes that this thread has allocated, or freed if the number is negative.
#[inline]
fn count(bytes: isize) {
    // A thread that is ending counts no more.
    let _ = THREAD.try_with(|thread| {
        let pending = thread.pending.get() + bytes;
        thread.pending.set(pending);
        if pending.unsigned_abs() >= PENDING.unsigned_abs() {
            thread.settle();
        }
    });
}

/// The memory of one run.
#[derive(Debug)]
pub struct MemoryAccount {
    slot: u16,
    limit: usize,
}

impl MemoryAccount {
    /// Opens an account for at most `limit` (bytes). If too many are open at the same time it counts nothing.
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

    /// Charges this account for all threads that work for no run, until it is closed. For programs that run one script.
    pub fn adopt_threads(&self) {
        ADOPTED.store(self.slot, Ordering::Relaxed);
    }

    /// The account as an owner of what threads allocate.
    pub fn owner(&self) -> MemoryOwner {
        MemoryOwner { slot: self.slot }
    }

    /// Checks if it has ever gone over its limit.
    #[inline]
    pub fn is_exceeded(&self) -> bool {
        TABLE[usize::from(self.slot)].exceeded.load(Ordering::Relaxed)
    }

    /// Memory (bytes) that may still be allocated.
    pub fn remaining(&self) -> usize {
        self.owner().remaining()
    }

    /// Checks if more than half of the limit is used.
    pub fn is_half_full(&self) -> bool {
        self.remaining() < self.limit / 2
    }

    /// The error of a run that exceeds the limit.
    pub fn error(&self) -> Error {
        too_much(self.limit)
    }
}

/// The error of a run that needs more than `limit` (bytes).
fn too_much(limit: usize) -> Error {
    Error::limit(Limit::Memory, format!("the run needs more than {} MB of memory", limit / 1_000_000))
        .help("look for a table, a string or notes that grow, or raise the limit: --memory-limit MEGABYTES")
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

/// The account that a thread charges at present, to be taken to the threads of a pool.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MemoryOwner {
    slot: u16,
}

impl MemoryOwner {
    /// The owner of what threads allocate that work for no run.
    pub const NOBODY: Self = Self { slot: 0 };

    /// The owner of what this thread allocates.
    pub fn current() -> Self {
        Self { slot: THREAD.try_with(|thread| thread.slot.get()).unwrap_or(0) }
    }

    /// Charges this owner for what `work` allocates in this thread.
    pub fn charge<T>(self, work: impl FnOnce() -> T) -> T {
        let _entered = self.enter();
        work()
    }

    /// Charges this owner for what this thread allocates until the result is dropped.
    #[must_use]
    pub fn enter(self) -> OwnerGuard {
        OwnerGuard { before: switch(self) }
    }

    /// Checks if `bytes` more may be allocated, and otherwise marks the account as exceeded.
    pub fn demand(self, bytes: usize) -> bool {
        let has_room = bytes <= self.remaining();
        if !has_room {
            self.entry().exceeded.store(true, Ordering::Relaxed);
        }
        has_room
    }

    /// Fails, and ends the run for which this thread allocates, if the run may not use `bytes` more. For those who are about to
    /// allocate what a script or a file decides in one piece.
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

    /// Memory (bytes) that may still be allocated; a great number without a limit.
    pub fn remaining(self) -> usize {
        let entry = self.entry();
        let limit = entry.limit.load(Ordering::Relaxed);
        usize::try_from(limit.saturating_sub(entry.used.load(Ordering::Relaxed))).unwrap_or(0)
    }
}

/// Charges an owner in this thread until it is dropped.
#[derive(Debug)]
pub struct OwnerGuard {
    before: MemoryOwner,
}

impl Drop for OwnerGuard {
    fn drop(&mut self) {
        switch(self.before);
    }
}

/// Charges `owner` from now on in this thread. Returns the one before.
pub(crate) fn switch(owner: MemoryOwner) -> MemoryOwner {
    let before = THREAD.try_with(|thread| {
        if thread.slot.get() != owner.slot {
            thread.settle();
        }
        thread.slot.replace(owner.slot)
    });
    MemoryOwner { slot: before.unwrap_or(0) }
}

/// An allocator that counts the memory of runs.
///
/// ```
/// use burgeon_base::account::CountingAllocator;
///
/// #[global_allocator]
/// static ALLOCATOR: CountingAllocator<std::alloc::System> = CountingAllocator(std::alloc::System);
/// ```
#[derive(Debug)]
pub struct CountingAllocator<A>(pub A);

/// A size as a signed number: a layout's fits.
#[inline]
#[allow(clippy::cast_possible_wrap, reason = "a layout has at most isize::MAX bytes")]
fn signed(size: usize) -> isize {
    size as isize
}

#[allow(unsafe_code, reason = "an allocator is made of another one")]
// SAFETY: everything is handed on to an allocator that keeps the contract; counting allocates nothing and does not unwind.
unsafe impl<A: GlobalAlloc> GlobalAlloc for CountingAllocator<A> {
    #[inline]
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: as the caller promises.
        let at = unsafe { self.0.alloc(layout) };
        if !at.is_null() {
            count(signed(layout.size()));
        }
        at
    }

    #[inline]
    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: as the caller promises.
        let at = unsafe { self.0.alloc_zeroed(layout) };
        if !at.is_null() {
            count(signed(layout.size()));
        }
        at
    }

    #[inline]
    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        // SAFETY: as the caller promises.
        unsafe { self.0.dealloc(at, layout) }
        count(-signed(layout.size()));
    }

    #[inline]
    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: as the caller promises.
        let new = unsafe { self.0.realloc(at, layout, size) };
        if !new.is_null() {
            count(signed(size) - signed(layout.size()));
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
        the run needs more than 10 MB of memory
          help: look for a table, a string or notes that grow, or raise the limit: --memory-limit MEGABYTES
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
