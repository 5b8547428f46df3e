//! Command `burgeon` of the Python package.

use std::ffi::OsString;

use pyo3::prelude::*;

/// Runs the command with these arguments, of which the first is its name, and returns the exit status.
#[pyfunction]
pub(crate) fn run_command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    let status = py.detach(|| burgeon::run_command(arguments));
    // A status has no number in the standard library; it is equal to one of the numbers that the commands use.
    (0..=u8::MAX).find(|code| std::process::ExitCode::from(*code) == status).unwrap_or(1)
}
