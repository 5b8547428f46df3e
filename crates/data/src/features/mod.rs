//! Features of a layer, as stored in its file.
//!
//! Input: geometries, attributes and ids that a reader finds. Output: a [`FeatureTable`] with a unique id for each
//! feature, of which equal attributes and texts are stored once. Coordinates are those of the file.

mod attribute_pool;
mod derived_id;
pub(crate) mod feature;
pub(crate) mod id;
mod selection;
pub(crate) mod table;
mod taken_ids;

pub use feature::Feature;
pub use id::FeatureId;
pub use table::FeatureTable;
