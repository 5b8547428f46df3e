//! Command line program.

use std::process::ExitCode;

use burgeon_base::account::CountingAllocator;

#[cfg(feature = "mimalloc")]
mod allocator;

#[cfg(feature = "mimalloc")]
#[global_allocator]
static ALLOCATOR: CountingAllocator<allocator::ProgramAllocator> =
    CountingAllocator(allocator::ProgramAllocator);

#[cfg(not(feature = "mimalloc"))]
#[global_allocator]
static ALLOCATOR: CountingAllocator<std::alloc::System> = CountingAllocator(std::alloc::System);

fn main() -> ExitCode {
    burgeon::run_command(std::env::args_os())
}
