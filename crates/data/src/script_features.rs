//! Features of a layer as scripts pass them to constructors.

use std::sync::Arc;

use burgeon_kit::{methods, object};
use burgeon_spatial::{Geometry, GeometryList};

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
