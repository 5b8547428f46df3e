//! The files that belong to a data file and lie beside it.

use std::path::{Path, PathBuf};

/// The extensions of the files that belong to a shapefile, besides its own.
pub(crate) const OF_SHAPEFILE: [&str; 3] = ["dbf", "prj", "cpg"];

/// The files beside the one at `path` that are read with it: those of a shapefile. Those that are not there are among them, since
/// they may come.
pub fn companions(path: &Path) -> Vec<PathBuf> {
    let is_shape = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("shp"));
    if !is_shape {
        return Vec::new();
    }
    OF_SHAPEFILE.iter().map(|extension| companion(path, extension)).collect()
}

/// The file beside the one at `path` that has another extension, in small or in large letters.
pub(crate) fn companion(path: &Path, extension: &str) -> PathBuf {
    let small = path.with_extension(extension);
    let large = path.with_extension(extension.to_ascii_uppercase());
    if !small.exists() && large.exists() { large } else { small }
}
