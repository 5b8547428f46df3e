//! Table of the formats of height maps.
//!
//! The command line, its help and errors read this table. A new format is a row here.

use std::io;
use std::path::{Path, PathBuf};

use super::super::Out;
use super::super::format::{FileFormat, always, find};
use super::height_map::HeightMap;
use super::{packed, plain};
use burgeon_base::error::Result;

/// Format of a height map: a row of [`HEIGHT_FORMATS`].
#[derive(Debug, Clone, Copy)]
pub struct HeightFormat {
    /// Extensions, title and files. The companion contains the projection.
    pub file: FileFormat,
    /// Function that returns true if the file itself contains the projection of a height map.
    pub has_projection: fn(&HeightMap) -> bool,
    /// Set if the file can omit heights.
    pub has_gaps: bool,
    /// Set if the file contains the number of columns. Otherwise the map must be square.
    pub has_size: bool,
    /// Function that writes the content of a file.
    pub write: fn(&HeightMap, &mut Out) -> io::Result<()>,
}

/// All formats of a height map, in the order in which messages list them.
pub static HEIGHT_FORMATS: [HeightFormat; 5] = [
    // The text entries `low` and `high` contain the range (m).
    HeightFormat {
        file: FileFormat {
            extensions: &["png"],
            title: "16-bit grey from the lowest to the highest height",
            companion: None,
            check: packed::check,
        },
        has_projection: |_| false,
        has_gaps: false,
        has_size: true,
        write: packed::write_png,
    },
    HeightFormat {
        file: FileFormat {
            extensions: &["asc"],
            title: "ESRI ASCII grid",
            companion: Some(projection_path),
            check: always,
        },
        has_projection: |_| false,
        has_gaps: true,
        has_size: true,
        write: plain::write_ascii,
    },
    // Only codes and projections around a centre fit into the file.
    HeightFormat {
        file: FileFormat {
            extensions: &["tif", "tiff"],
            title: "GeoTIFF of 32-bit floats",
            companion: Some(projection_path),
            check: packed::check,
        },
        has_projection: |map| {
            map.frame.as_ref().is_some_and(|frame| frame.epsg.is_some() || frame.middle.is_some())
        },
        has_gaps: true,
        has_size: true,
        write: packed::write_tiff,
    },
    HeightFormat {
        file: FileFormat {
            extensions: &["r32", "f32"],
            title: "raw little-endian 32-bit floats of a square",
            companion: None,
            check: always,
        },
        has_projection: |_| false,
        has_gaps: true,
        has_size: false,
        write: plain::write_raw32,
    },
    HeightFormat {
        file: FileFormat {
            extensions: &["r64", "f64"],
            title: "raw little-endian 64-bit floats of a square",
            companion: None,
            check: always,
        },
        has_projection: |_| false,
        has_gaps: true,
        has_size: false,
        write: plain::write_raw64,
    },
];

impl HeightFormat {
    /// Returns the format that the extension of `path` names, in upper or lower case.
    ///
    /// Fails on an unknown or missing extension; the error lists the known ones.
    pub fn of(path: &Path) -> Result<&'static Self> {
        find(&HEIGHT_FORMATS, path)
    }
}

impl AsRef<FileFormat> for HeightFormat {
    fn as_ref(&self) -> &FileFormat {
        &self.file
    }
}

/// Returns the path of the projection of the height map at `path`.
fn projection_path(path: &Path) -> PathBuf {
    path.with_extension("prj")
}
