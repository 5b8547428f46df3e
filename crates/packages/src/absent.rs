//! Stub of `unzip`, for builds without the feature `zip`.

use std::path::Path;

use burgeon_base::error::{Error, Result};

use super::copy::PackageCopy;

/// Fails, because zip files are not supported.
pub(crate) fn unpack(from: &Path, _: &mut PackageCopy) -> Result<()> {
    Err(Error::unavailable(format!(
        "{} is no folder, and this Burgeon is built without zips",
        from.display()
    ))
    .help("unpack it, and name its folder"))
}
