//! Tables of records as layers: GeoJSON, GeoPackages, GeoParquet and DXF.
//!
//! Input: a [`RecordTable`](burgeon_spatial::RecordTable) for each layer, in metres of a run's frame. Output: the same
//! records georeferenced in a coordinate system that other programs support. The same tables yield the same bytes.

mod column;
mod dxf;
mod geojson;
#[cfg_attr(not(feature = "data"), path = "absent_geopackage.rs")]
mod geopackage;
#[cfg_attr(not(feature = "parquet"), path = "absent_geoparquet.rs")]
mod geoparquet;
mod place;
#[cfg(test)]
mod tests;
mod write;

pub use column::{ColumnKind, TableColumn, column_kinds};
pub use dxf::write_dxf;
pub use geojson::write_geojson;
pub use geopackage::{check_geopackage, write_geopackage};
pub use geoparquet::write_geoparquet;
pub use place::OutputPlacement;
pub(crate) use write::{write_dxf_file, write_geojson_file, write_geopackage_file};
