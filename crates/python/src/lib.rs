//! Python module `burgeon._burgeon`, on which the package in `python/` is built.
//!
//! Input: the path or the name of a script, and options as JSON. Output: a model whose arrays NumPy reads without a copy,
//! and files in all formats. Reports, rows and errors are JSON, which the package turns into Python values. The module
//! never replaces the allocator of the process, and it holds the interpreter's lock only while Python code runs.

mod buffer;
mod command;
mod errors;
mod loader;
mod model;
mod model_data;
mod options;
mod parameters;
mod run;
mod supervised;

use burgeon_base::account::CountingAllocator;
use pyo3::prelude::*;

// Memory limits of runs need a count of the module's own allocations; the memory itself comes from the C library.
#[global_allocator]
static ALLOCATOR: CountingAllocator<std::alloc::System> = CountingAllocator(std::alloc::System);

/// Compiled part of Burgeon.
#[pymodule]
#[pyo3(name = "_burgeon")]
mod module {
    #[pymodule_export]
    use crate::buffer::Buffer;
    #[pymodule_export]
    use crate::command::run_command;
    #[pymodule_export]
    use crate::model::ScriptModel;
    #[pymodule_export]
    use crate::model::formats;
    #[pymodule_export]
    use crate::parameters::parameters;
    #[pymodule_export]
    use crate::run::run;

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
