//! Features of a layer as scripts pass them to constructors.

use std::sync::Arc;

use burgeon_base::error::Error;
use burgeon_base::warning::Warning;
use burgeon_kit::{Attribute, FeatureSource, Object, Prefetch, methods, object};
use burgeon_spatial::{Geometry, GeometryList, GeometryObject};

use crate::Layer;

/// The features of a data file.
///
/// A constructor may take them; no script holds them in this form.
#[object("source", given, can(GeometryList))]
pub struct Features(pub Arc<Layer>);

#[methods("source")]
impl Features {}

impl GeometryList for Features {
    fn count(&self) -> usize {
        self.0.features.len()
    }

    fn geometry(&self, index: usize) -> Option<&Geometry> {
        self.0.features.get(index).map(|feature| &feature.geometry)
    }
}

impl GeometryList for Layer {
    fn count(&self) -> usize {
        self.features.len()
    }

    fn geometry(&self, index: usize) -> Option<&Geometry> {
        self.features.get(index).map(|feature| &feature.geometry)
    }
}

impl FeatureSource for Layer {
    fn name(&self) -> &str {
        &self.name
    }

    fn label(&self) -> &str {
        &self.shown
    }

    fn crs(&self) -> &str {
        &self.crs
    }

    fn origin(&self) -> [f64; 2] {
        self.origin
    }

    fn bounds(&self) -> [[f64; 3]; 2] {
        self.bounds
    }

    fn count(&self) -> usize {
        self.features.len()
    }

    fn id(&self, feature: usize) -> &str {
        self.features.get(feature).map_or("", |feature| feature.id.as_str())
    }

    fn attribute_names(&self) -> &[String] {
        &self.names
    }

    fn attributes(&self, feature: usize) -> &[(usize, Attribute)] {
        self.features.get(feature).map_or(&[], |feature| &feature.attributes)
    }

    fn geometry(
        self: Arc<Self>,
        feature: usize,
        prefetch: Option<&Arc<dyn Prefetch>>,
    ) -> Option<Arc<dyn Object>> {
        Some(Arc::new(GeometryObject::of_feature(self, feature, prefetch)?))
    }

    fn object(self: Arc<Self>) -> Arc<dyn Object> {
        Arc::new(Features(self))
    }

    fn refused(&self) -> &[(String, Error)] {
        &self.refused
    }

    fn warnings(&self) -> Vec<Warning> {
        self.warnings()
    }

    fn note(&self) -> Option<String> {
        self.derived_note()
    }
}
