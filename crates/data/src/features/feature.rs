//! Feature of a layer.

use std::sync::Arc;

use super::id::FeatureId;
use burgeon_kit::Attribute;
use burgeon_spatial::Geometry;

/// Record with a geometry.
#[derive(Debug, Clone)]
pub struct Feature {
    /// Id, unique within its layer.
    pub id: FeatureId,
    /// Geometry with one part.
    pub geometry: Geometry,
    /// Indices of the names in [`FeatureTable::names`](crate::FeatureTable::names), and the values. Features with equal attributes may share the
    /// list.
    pub attributes: Arc<[(usize, Attribute)]>,
}
