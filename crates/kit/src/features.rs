//! The features of a data file and their geometries, on their way from a source to a constructor.

use std::sync::Arc;

use glam::DVec3;

use super::{Parameter, Prefetch, Table, TableKey, Value};
use burgeon_data::{Geometry, Layer};
use burgeon_macros::{methods, object};

/// The features of a data file.
///
/// A constructor may take them; no script holds them in this form.
#[object("source", given)]
pub struct Features(pub Arc<Layer>);

#[methods("source")]
impl Features {}

/// The geometry of a feature.
///
/// A constructor may take it; scripts see it as a table.
#[object("geometry", given)]
pub struct FeatureShape {
    layer: Arc<Layer>,
    index: usize,
    prefetch: Option<Arc<dyn Prefetch>>,
}

#[methods("geometry")]
impl FeatureShape {}

impl FeatureShape {
    /// That of the feature with this number, from 0; `None` if there is none. What it needs may be fetched before by `prefetch`.
    pub fn new(layer: &Arc<Layer>, index: usize, prefetch: Option<&Arc<dyn Prefetch>>) -> Option<Self> {
        let there = index < layer.features.len();
        there.then(|| Self { layer: Arc::clone(layer), index, prefetch: prefetch.cloned() })
    }

    /// Where what it needs may have been made already, and its feature's number there.
    pub fn prefetch(&self) -> Option<(&dyn Prefetch, usize)> {
        self.prefetch.as_deref().map(|prefetch| (prefetch, self.index))
    }

    /// The geometry itself.
    pub fn geometry(&self) -> &Geometry {
        &self.layer.features[self.index].geometry
    }

    /// The table that scripts see.
    pub fn to_table(&self) -> Value {
        let points =
            |points: &[DVec3]| points.iter().map(|point| point.to_array().to_vec()).collect::<Vec<_>>();
        let geometry = self.geometry();
        let (name, lists) = match geometry {
            Geometry::Polygon(rings) => {
                ("rings", rings.iter().map(|ring| points(ring)).collect::<Vec<_>>().into_value())
            }
            Geometry::Line(line) => ("points", points(line).into_value()),
            other => ("points", points(&other.points().copied().collect::<Vec<_>>()).into_value()),
        };
        let kind = Value::Text(geometry.kind().name().into());
        let entries = vec![(TableKey::Name("kind".into()), kind), (TableKey::Name(name.into()), lists)];
        Value::Table(Arc::new(Table { class: None, entries }))
    }
}
