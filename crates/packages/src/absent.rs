//! Stub of `unzip`, for builds without the feature `zip`.

use std::path::Path;

use burgeon_base::error::{Error, Result};

use super::copy::PackageCopy;

/// Fails, because zip files are not supported.
pub(crate) fn unpack(from: &Path, _: &mut PackageCopy) -> Result<()> {
    Err(Error::unavailable(format!(
        "{} is not a folder, and this program was built without zip support",
        from.display()
    ))
    .help("unpack it, and specify its folder"))
}
