//! Data file with layers.

use super::features::table::FeatureTable;
use super::source_options::SourceOptions;
use burgeon_base::error::Result;

/// Data file with layers that can be read individually.
pub trait LayeredFile: Send {
    /// Returns the name of the format.
    fn format(&self) -> &'static str;

    /// Returns the names of the layers.
    fn layers(&self) -> Vec<&str>;

    /// Reads the features of a layer that `wanted` selects, in file order.
    fn read(&self, layer: &str, wanted: &SourceOptions) -> Result<FeatureTable>;
}
