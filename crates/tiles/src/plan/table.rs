//! Formats of the tables beside the contents of tiles.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Format of a table of the features of a tile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TableFormat {
    /// CityJSON sequence: shapes and attributes of the features in the coordinates of the data.
    Cityjson,
    /// GeoParquet: attributes of the features, and their geometry in the data, in degrees.
    Geoparquet,
}

impl TableFormat {
    /// All formats.
    pub const ALL: [Self; 2] = [Self::Cityjson, Self::Geoparquet];

    /// Returns the extension of files of the format.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Cityjson => "city.jsonl",
            Self::Geoparquet => "parquet",
        }
    }
}

impl fmt::Display for TableFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Cityjson => "cityjson",
            Self::Geoparquet => "geoparquet",
        })
    }
}
