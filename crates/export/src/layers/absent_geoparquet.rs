//! Replacement for the writer of GeoParquet in programs built without the feature `parquet`.

use super::TableColumn;
use burgeon_base::error::{Error, Result};
use burgeon_spatial::{RecordTable, ReferenceFrame};

/// Fails, because GeoParquet is available only with the feature `parquet`.
pub fn write_geoparquet(
    _tables: &[RecordTable],
    _columns: &[TableColumn],
    _frame: &ReferenceFrame,
) -> Result<Vec<u8>> {
    Err(Error::left_out("GeoParquet", "parquet"))
}
