//! Output of tables of records as layers of a GeoPackage or as GeoJSON.
//!
//! Input: a [`RecordTable`] for each layer, in metres of a run's frame. Output: the same records georeferenced in a
//! coordinate system that other programs support. The same tables yield the same bytes.

mod column;
mod geojson;
mod place;
#[cfg(test)]
mod tests;

pub use burgeon_spatial::{Record, RecordTable};
pub use column::{ColumnKind, column_kinds};
pub use geojson::write_geojson;
pub use place::OutputPlacement;
