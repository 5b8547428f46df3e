//! Choices for the model of a tile.

use serde::{Deserialize, Serialize};

/// Compression of the model of a tile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TileCompression {
    /// Coordinates and normals in single precision.
    #[default]
    None,
    /// Coordinates and normals as integers (`KHR_mesh_quantization`).
    Quantize,
    /// Integers in compressed arrays (`EXT_meshopt_compression`).
    Meshopt,
}

/// Choices for the model of a tile.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TileModelOptions {
    /// Set if repeated models are copied into the mesh, for viewers without instances.
    pub expand_instances: bool,
    /// Compression.
    pub compression: TileCompression,
    /// Largest step (m) of quantised coordinates. If 16 bits have a larger step in a tile, coordinates are multiples of the
    /// step in single precision.
    pub precision: f64,
}

impl Default for TileModelOptions {
    /// Returns options without compression, with instances.
    fn default() -> Self {
        Self { expand_instances: false, compression: TileCompression::None, precision: 0.001 }
    }
}
