//! Companion files next to a data file.

use std::path::{Path, PathBuf};

/// Extensions of the companion files of a shapefile.
pub(crate) const OF_SHAPEFILE: [&str; 3] = ["dbf", "prj", "cpg"];

/// Returns the companion files that are read with the file at `path`: for a shapefile, its `.dbf`, `.prj` and `.cpg`
/// files. Missing files are included, because they may be added later.
pub fn companions(path: &Path) -> Vec<PathBuf> {
    let is_shape = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("shp"));
    if !is_shape {
        return Vec::new();
    }
    OF_SHAPEFILE.iter().map(|extension| companion(path, extension)).collect()
}

/// Returns the path of the companion file with another extension, in lower or upper case.
pub(crate) fn companion(path: &Path, extension: &str) -> PathBuf {
    let small = path.with_extension(extension);
    let large = path.with_extension(extension.to_ascii_uppercase());
    if !small.exists() && large.exists() { large } else { small }
}
