//! Companion files next to a data file.

use std::io::Read;
use std::path::{Path, PathBuf};

use burgeon_base::error::{Error, Limit, Result};

/// Kind of a data file by its extension, which decides the companions that are read with it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum CompanionKind {
    /// Shapefile, with a table, a coordinate system and an encoding.
    Shapefile,
    /// ASCII grid or GeoTIFF, with a coordinate system.
    Heights,
    /// File without companions.
    Alone,
}

impl CompanionKind {
    fn of(path: &Path) -> Self {
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        match &*extension {
            "shp" => Self::Shapefile,
            "asc" | "tif" | "tiff" => Self::Heights,
            _ => Self::Alone,
        }
    }

    fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Shapefile => &OF_SHAPEFILE,
            Self::Heights => &[PRJ],
            Self::Alone => &[],
        }
    }
}

/// Extensions of the companion files of a shapefile.
pub(crate) const OF_SHAPEFILE: [&str; 3] = ["dbf", PRJ, "cpg"];

/// Extension of a coordinate system.
const PRJ: &str = "prj";

/// Maximum size of a `.prj` or `.cpg` file (bytes).
const LARGEST_TEXT: u64 = 1 << 20;

/// Returns the paths of the companion files that are read with the file at `path`: for a shapefile, its `.dbf`, `.prj`
/// and `.cpg` files; for an ASCII grid and a GeoTIFF, the `.prj` file. Each extension is in lower case, then in upper
/// case. Missing files are included, because they may be added later.
///
/// ```
/// use burgeon_data::companions;
/// use std::path::{Path, PathBuf};
///
/// let files = companions(Path::new("roads.shp"));
/// assert!(files.contains(&PathBuf::from("roads.dbf")) && files.contains(&PathBuf::from("roads.PRJ")));
/// assert!(companions(Path::new("roads.gpkg")).is_empty());
/// ```
pub fn companions(path: &Path) -> Vec<PathBuf> {
    let spellings = |extension: &&str| [path.with_extension(extension), upper(path, extension)];
    CompanionKind::of(path).extensions().iter().flat_map(spellings).collect()
}

/// Returns the path of the companion file with another extension, without links; `None` if there is none in the same
/// folder, because a link may lead out of the folders that a script may read.
pub(crate) fn real_companion(path: &Path, extension: &str) -> Option<PathBuf> {
    let real = companion(path, extension).canonicalize().ok()?;
    let folder = path.canonicalize().ok()?;
    (real.parent().is_some() && real.parent() == folder.parent()).then_some(real)
}

/// Returns the text of the `.prj` file next to a file of heights, if there is one; `name` is that of the heights in
/// messages. Fails if it cannot be read, or is too large.
pub(crate) fn coordinate_system(path: &Path, name: &str) -> Result<Option<String>> {
    if CompanionKind::of(path) != CompanionKind::Heights {
        return Ok(None);
    }
    let Some(real) = real_companion(path, PRJ) else { return Ok(None) };
    let name = Path::new(name).with_extension(PRJ).display().to_string();
    let (file, _) = burgeon_base::files::open(&real)
        .map_err(|error| Error::file(&real, format!("cannot read {name}: {error}")))?;
    let remedy = "a .prj file contains the text of one coordinate system; re-export it, or specify the EPSG code: elevation(file, { crs = 3067 })";
    read_text(file, &name, remedy).map(Some)
}

/// Returns the content of the small text file called `name`. Fails if it cannot be read, or is larger than 1 MB.
pub(crate) fn read_text(file: impl Read, name: &str, remedy: &str) -> Result<String> {
    let mut bytes = Vec::new();
    file.take(LARGEST_TEXT + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| Error::data(format!("cannot read {name}: {error}")).help(remedy))?;
    if bytes.len() as u64 > LARGEST_TEXT {
        return Err(Error::limit(Limit::Size, format!("{name} is larger than 1 MB")).help(remedy));
    }
    Ok(String::from_utf8_lossy(&bytes).trim_start_matches('\u{feff}').to_owned())
}

/// Returns the path of the companion file with another extension, in lower or upper case.
pub(crate) fn companion(path: &Path, extension: &str) -> PathBuf {
    let (small, large) = (path.with_extension(extension), upper(path, extension));
    if !small.exists() && large.exists() { large } else { small }
}

fn upper(path: &Path, extension: &str) -> PathBuf {
    path.with_extension(extension.to_ascii_uppercase())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn companions_are_those_of_the_extension_in_both_cases() {
        let of = |name: &str| {
            let names = companions(Path::new(name)).into_iter().map(|path| path.display().to_string());
            names.collect::<Vec<_>>().join(" ")
        };
        assert_eq!(of("a/b.TIF"), "a/b.prj a/b.PRJ");
        assert_eq!(of("b.shp"), "b.dbf b.DBF b.prj b.PRJ b.cpg b.CPG");
        assert_eq!(of("b.hgt"), "");
    }
}
