//! Replacement for `formats` in programs built without the feature `data`: each function returns an error that names
//! the missing feature.

use std::fs::File;
use std::path::Path;

use super::content::DataFile;
use super::features::table::FeatureTable;
use super::layered_file::LayeredFile;
use super::source_options::SourceOptions;
use burgeon_base::error::{Error, Result};

fn left_out<T>() -> Result<T> {
    Err(Error::left_out("data formats", "data"))
}

/// Database of layers; never constructed without the feature `data`.
pub enum GeoPackage {}

impl GeoPackage {
    pub(crate) fn open(_path: &Path, name: &str, _wanted: &SourceOptions) -> Result<Self> {
        left_out().map_err(|error: Error| error.about(name))
    }

    pub(crate) fn layers(&self) -> Vec<&str> {
        match *self {}
    }

    pub(crate) fn read(self, _layer: &str, _wanted: &SourceOptions) -> Result<FeatureTable> {
        match self {}
    }
}

/// Defines a file format that cannot be read without the feature `data`.
macro_rules! absent {
    ($name:ident, $doc:literal, ($($argument:ident: $kind:ty),*)) => {
        #[doc = $doc]
        pub enum $name {}

        impl $name {
            pub(crate) fn open(_file: File, _path: &Path, name: &str, _wanted: &SourceOptions) -> Result<Self> {
                left_out().map_err(|error: Error| error.about(name))
            }

            pub(crate) fn layers(&self) -> Vec<&str> {
                match *self {}
            }

            pub(crate) fn read(&self, $($argument: $kind),*) -> Result<FeatureTable> {
                match *self {}
            }
        }
    };
}

absent!(FlatGeobuf, "A row of features, of which there is none without the feature `data`.", (_wanted: &SourceOptions));

/// OpenStreetMap extract; never constructed without the feature `data`.
pub enum OsmFile {}

impl FlatGeobuf {
    pub(crate) fn is_one(head: &[u8]) -> bool {
        head.starts_with(b"fgb")
    }
}

impl OsmFile {
    pub(crate) fn is_one(head: &[u8]) -> bool {
        head.get(4..15).is_some_and(|found| found == b"\x0a\x09OSMHeader")
    }

    pub(crate) fn open(file: DataFile, _head: &[u8], _wanted: &SourceOptions) -> Result<Self> {
        left_out().map_err(|error: Error| error.about(&file.name))
    }

    pub(crate) fn layers(&self) -> Vec<&str> {
        match *self {}
    }

    pub(crate) fn read(&self, _wanted: &SourceOptions) -> Result<FeatureTable> {
        match *self {}
    }
}

/// Fails for XML, shapefiles, CityJSON and delimited text; returns other files unchanged.
pub(crate) fn open_layers(
    file: DataFile,
    head: &[u8],
    _wanted: &SourceOptions,
) -> Result<std::result::Result<Box<dyn LayeredFile>, DataFile>> {
    let text = head.trim_ascii_start();
    let is_city = text.starts_with(b"{") && String::from_utf8_lossy(text).contains("\"CityJSON");
    let is_known = text.starts_with(b"<") || head.starts_with(&[0, 0, 0x27, 0x0a]) || is_city;
    if is_known || matches!(&*file.extension(), "csv" | "tsv") {
        return left_out().map_err(|error: Error| error.about(&file.name));
    }
    Ok(Err(file))
}

/// Fails for compressed files; returns other files unchanged.
pub(crate) fn unpack_file(
    file: DataFile,
    head: &[u8],
    _wanted: &SourceOptions,
) -> Result<std::result::Result<Box<dyn LayeredFile>, DataFile>> {
    if head.starts_with(b"\x1f\x8b") || head.starts_with(b"PK\x03\x04") {
        return left_out().map_err(|error: Error| error.about(&file.name));
    }
    Ok(Err(file))
}

pub(crate) mod condition {
    use super::{Result, left_out};
    use crate::features::table::FeatureTable;
    use crate::source_options::SourceOptions;

    pub(crate) fn find_matches(
        _table: &FeatureTable,
        _condition: &str,
        _wanted: &SourceOptions,
    ) -> Result<Vec<usize>> {
        left_out()
    }
}

pub(crate) mod geotiff {
    use super::{Error, Result, left_out};
    use crate::heights::RasterHeader;

    pub(crate) fn read<'a>(_bytes: &'a [u8], name: &'a str) -> Result<RasterHeader<'a>> {
        left_out().map_err(|error: Error| error.about(name))
    }
}

pub(crate) mod png {
    use super::Result;
    use crate::heights::{HeightOptions, RasterHeader};

    pub(crate) fn read<'a>(
        bytes: &'a [u8],
        name: &'a str,
        _wanted: &'a HeightOptions,
    ) -> Result<RasterHeader<'a>> {
        super::geotiff::read(bytes, name)
    }
}

pub(crate) mod zipped {
    pub(crate) use super::png::read;
}
