//! The command line.

use std::process::ExitCode;

#[cfg(feature = "mimalloc")]
mod allocator;
mod commands;

#[cfg(feature = "mimalloc")]
#[global_allocator]
static ALLOCATOR: allocator::ProgramAllocator = allocator::ProgramAllocator;

fn main() -> ExitCode {
    commands::main()
}
