//! Streets on a terrain: the changes of the ground that they need.

use std::sync::Arc;

use burgeon_base::error::Result;
use burgeon_base::warning::Warning;
use burgeon_kit::Object;
use burgeon_terrain::{Edit, GroundCuts};

/// Streets to which a terrain adapts. The network, which may be on another terrain itself, implements them.
pub trait GroundStreets: Object + std::fmt::Debug {
    /// Returns the terrain edits with which the ground meets the edges of the sidewalks and stays below bridges. The
    /// terrain has cells of size `cell` (m), and its triangles deviate by at most `error` (m).
    fn bed(&self, cell: f64, error: f64) -> Result<Vec<Edit>>;

    /// Returns the areas that the streets cut out of ground that is drawn `lift` (m) lower.
    fn ground_cuts(&self, lift: f64) -> Result<GroundCuts>;

    /// Returns the warning about streets that differ much from the ground because of the maximum slope.
    fn steep_warning(&self) -> Result<Option<Warning>>;
}

/// Network under which a terrain is shaped.
#[derive(Debug, Clone)]
pub struct StreetsOnGround(pub(crate) Arc<dyn GroundStreets>);
