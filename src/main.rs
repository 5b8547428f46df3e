//! The command line.

use std::process::ExitCode;

mod allocator;
mod commands;

#[global_allocator]
static ALLOCATOR: allocator::Allocator = allocator::Allocator;

fn main() -> ExitCode {
    commands::main()
}
