//! Replacement for the reader of GeoParquet in programs built without the feature `parquet`.

/// Fails, because GeoParquet is available only with the feature `parquet`.
pub(super) fn geoparquet_rows(_bytes: &[u8]) -> Result<Vec<(String, String)>, String> {
    Err("this program was built without the feature `parquet`".to_owned())
}
