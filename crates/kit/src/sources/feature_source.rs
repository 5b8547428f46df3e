//! Features that a script has loaded.

use std::sync::Arc;

use super::Attribute;
use crate::contract::{Object, Prefetch};
use burgeon_base::error::Error;
use burgeon_base::warning::Warning;

/// Features of a layer, in metres relative to the origin of the run.
///
/// Features are numbered from 0. The methods of a number that does not exist return empty values.
pub trait FeatureSource: Send + Sync {
    /// Returns the name of the layer.
    fn name(&self) -> &str;

    /// Returns file and layer, for messages.
    fn label(&self) -> &str;

    /// Returns the projection of the coordinates.
    fn crs(&self) -> &str;

    /// Returns the origin in that projection (m).
    fn origin(&self) -> [f64; 2];

    /// Returns the minimum and maximum coordinates (m).
    fn bounds(&self) -> [[f64; 3]; 2];

    /// Returns the number of features.
    fn count(&self) -> usize;

    /// Returns the id of a feature, unique within the layer.
    fn id(&self, feature: usize) -> &str;

    /// Returns the names of all attributes.
    fn attribute_names(&self) -> &[String];

    /// Returns the attributes of a feature: the indices of their names, and their values.
    fn attributes(&self, feature: usize) -> &[(usize, Attribute)];

    /// Returns the geometry of a feature as a script object, which takes what `prefetch` has prepared.
    fn geometry(
        self: Arc<Self>,
        feature: usize,
        prefetch: Option<&Arc<dyn Prefetch>>,
    ) -> Option<Arc<dyn Object>>;

    /// Returns all features as an argument of constructors.
    fn object(self: Arc<Self>) -> Arc<dyn Object>;

    /// Returns the ids of the features that were skipped because they cannot be read, with the reasons.
    fn refused(&self) -> &[(String, Error)];

    /// Returns the warnings about reading the layer.
    fn warnings(&self) -> Vec<Warning>;

    /// Returns a report entry about the layer that is not a warning.
    fn note(&self) -> Option<String>;
}

impl dyn FeatureSource {
    /// Returns the geometry of a feature as [`geometry`](FeatureSource::geometry) does, for a source that others use too.
    pub fn feature_geometry(
        self: &Arc<Self>,
        feature: usize,
        prefetch: Option<&Arc<dyn Prefetch>>,
    ) -> Option<Arc<dyn Object>> {
        Arc::clone(self).geometry(feature, prefetch)
    }
}
