//! Replacement for the writer of 3MF in programs built without the feature `data`.

use std::path::Path;

use crate::facts::Export;
use crate::files::Files;
use burgeon_base::error::{Error, Result};

/// Fails, because 3MF is available only with the feature `data`.
pub(crate) fn check() -> Result<()> {
    Err(Error::left_out("data formats", "data"))
}

/// Fails, because 3MF needs the feature `data`.
pub(crate) fn write(_export: &Export<'_>, _path: &Path, _files: &mut Files) -> Result<()> {
    check()
}
