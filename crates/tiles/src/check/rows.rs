//! Reader of the rows of a GeoParquet file.

use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader as _, SerializedFileReader};
use parquet::record::{Field, Row};

/// Returns the layer and the id of each row. Fails with the reason if a row lacks them or its geometry.
pub(super) fn geoparquet_rows(bytes: &[u8]) -> Result<Vec<(String, String)>, String> {
    let refuse = |error: ParquetError| format!("it cannot be read: {error}");
    let file = SerializedFileReader::new(bytes::Bytes::copy_from_slice(bytes)).map_err(refuse)?;
    let about = file.metadata().file_metadata().key_value_metadata();
    if !about.is_some_and(|list| list.iter().any(|pair| pair.key == "geo")) {
        return Err("it does not describe its geometries".to_owned());
    }
    let mut rows = Vec::new();
    for row in file.get_row_iter(None).map_err(refuse)? {
        let row: Row = row.map_err(refuse)?;
        let (mut layer, mut id, mut has_geometry) = (None, None, false);
        for (name, field) in row.get_column_iter() {
            match (name.as_str(), field) {
                ("layer", Field::Str(text)) => layer = Some(text.clone()),
                ("id", Field::Str(text)) => id = Some(text.clone()),
                ("geometry", Field::Bytes(_)) => has_geometry = true,
                _ => {}
            }
        }
        let row = layer.zip(id).filter(|_| has_geometry);
        rows.push(row.ok_or("a row has no layer, no id or no geometry")?);
    }
    Ok(rows)
}
