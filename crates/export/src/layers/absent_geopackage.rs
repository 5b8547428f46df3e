//! Replacement for the writer of GeoPackages in programs built without the feature `data`.

use burgeon_base::error::{Error, Result};
use burgeon_base::stop::Stop;
use burgeon_spatial::{RecordTable, ReferenceFrame};

/// Fails, because GeoPackages are available only with the feature `data`.
pub fn check_geopackage() -> Result<()> {
    Err(Error::left_out("data formats", "data"))
}

/// Fails, because GeoPackages need the feature `data`.
pub fn write_geopackage(
    _tables: &[RecordTable],
    _frame: Option<&ReferenceFrame>,
    _stop: &Stop,
) -> Result<Vec<u8>> {
    Err(Error::left_out("data formats", "data"))
}
