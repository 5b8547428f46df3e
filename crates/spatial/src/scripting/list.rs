//! Lists of geometries that objects and layers have.

use crate::Geometry;

/// Has numbered geometries, as the features of a layer.
pub trait GeometryList: Send + Sync {
    /// Returns the number of geometries.
    fn count(&self) -> usize;

    /// Returns the geometry with the number `index`, from 0, if there is one.
    fn geometry(&self, index: usize) -> Option<&Geometry>;
}
