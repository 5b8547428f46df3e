//! In the place of `unzip` in a program that is built without it.

use std::path::Path;

use burgeon_base::error::{Error, Result};

use super::install::PackageCopy;

/// Says that zips cannot be read.
pub(crate) fn unpack(from: &Path, _: &mut PackageCopy) -> Result<()> {
    Err(Error::unavailable(format!(
        "{} is no folder, and this Burgeon is built without zips",
        from.display()
    ))
    .help("unpack it, and name its folder"))
}
