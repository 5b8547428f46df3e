//! Companion files next to a data file.

use std::io::Read;
use std::path::{Path, PathBuf};

/// Extensions of the companion files of a shapefile.
pub(crate) const OF_SHAPEFILE: [&str; 3] = ["dbf", "prj", "cpg"];

/// Extensions of the companion files of a file of heights.
const OF_HEIGHTS: [&str; 1] = ["prj"];

/// Maximum size of a `.prj` or `.cpg` file (bytes).
pub(crate) const LARGEST_TEXT: u64 = 1 << 20;

/// Returns the companion files that are read with the file at `path`: for a shapefile, its `.dbf`, `.prj` and `.cpg`
/// files; for an ASCII grid and a GeoTIFF, the `.prj` file. Missing files are included, because they may be added later.
pub fn companions(path: &Path) -> Vec<PathBuf> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let extensions: &[&str] = match &*extension {
        "shp" => &OF_SHAPEFILE,
        "asc" | "tif" | "tiff" => &OF_HEIGHTS,
        _ => &[],
    };
    extensions.iter().map(|extension| companion(path, extension)).collect()
}

/// Returns the path of the companion file with another extension, without links; `None` if there is none in the same
/// folder, because a link may lead out of the folders that a script may read.
pub(crate) fn real_companion(path: &Path, extension: &str) -> Option<PathBuf> {
    let real = companion(path, extension).canonicalize().ok()?;
    let folder = path.canonicalize().ok()?;
    (real.parent().is_some() && real.parent() == folder.parent()).then_some(real)
}

/// Returns the text of the `.prj` file next to a file of heights, if there is one.
pub(crate) fn coordinate_system(path: &Path) -> Option<String> {
    let has_one = companions(path).len() == OF_HEIGHTS.len();
    let real = real_companion(path, OF_HEIGHTS[0]).filter(|_| has_one)?;
    let mut bytes = Vec::new();
    let (file, _) = burgeon_base::files::open(&real).ok()?;
    file.take(LARGEST_TEXT).read_to_end(&mut bytes).ok()?;
    Some(String::from_utf8_lossy(&bytes).trim_start_matches('\u{feff}').to_owned())
}

/// Returns the path of the companion file with another extension, in lower or upper case.
pub(crate) fn companion(path: &Path, extension: &str) -> PathBuf {
    let small = path.with_extension(extension);
    let large = path.with_extension(extension.to_ascii_uppercase());
    if !small.exists() && large.exists() { large } else { small }
}
