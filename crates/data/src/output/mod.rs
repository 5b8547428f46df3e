//! Tables of records on their way out: as layers of a GeoPackage or as GeoJSON.
//!
//! Comes in: a [`RecordTable`] for each layer, in metres of a run's frame. Goes out: the same where the earth has it, in a
//! coordinate system that other programs know. The same tables give the same bytes.

mod column;
mod geojson;
mod place;
mod table;
#[cfg(test)]
mod tests;

pub use column::{ColumnKind, column_kinds};
pub use geojson::write_geojson;
pub use place::OutputPlacement;
pub use table::{Record, RecordTable};
