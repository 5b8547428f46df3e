//! Script object of a geometry.

use std::hash::{Hash, Hasher};
use std::sync::{Arc, OnceLock};

use burgeon_data::Layer;
use burgeon_macros::object;
use burgeon_spatial::{Geometry, PreparedGeometry};

use crate::declare::as_ref;
use crate::{Answer, Expectation, Field, Object, Parameter, Prefetch, Value, Vector};

/// Points, lines, polygons with holes, and collections of these, from `feature.geometry` and `geometry(text)`.
///
/// A geometry is immutable.
#[object("geometry", given, has = fields(), example = include_str!("../../scripts/geometry.lua"))]
pub struct GeometryObject {
    from: GeometryStorage,
    /// Form for comparisons, built by the first comparison.
    prepared: OnceLock<Box<PreparedGeometry>>,
}

/// Storage of a geometry.
#[derive(Clone)]
enum GeometryStorage {
    Value(Arc<Geometry>),
    Feature { layer: Arc<Layer>, index: usize, prefetch: Option<Arc<dyn Prefetch>> },
}

/// Returns the fields that scripts can read.
fn fields() -> Vec<Field> {
    let metres = |name: &'static str, luau: &str, doc: &'static str| Field {
        unit: Some("m".into()),
        ..Field::new(name, luau, doc)
    };
    vec![
        Field::new(
            "kind",
            "string",
            "What it is: \"point\", \"line\", \"polygon\", \"multipoint\", \"multiline\", \"multipolygon\" or \"collection\".",
        ),
        metres(
            "rings",
            "{ { { number } } }?",
            "Of a polygon, the outer ring, which turns left, and its holes: points { x, y, z } (m).",
        ),
        metres("points", "{ { number } }?", "Of a line, a point or points, its points { x, y, z } (m)."),
    ]
}

impl GeometryObject {
    /// Creates an object that owns its geometry.
    pub fn new(geometry: Geometry) -> Self {
        Self::shared(Arc::new(geometry))
    }

    /// Creates an object that shares its geometry.
    pub fn shared(geometry: Arc<Geometry>) -> Self {
        Self { from: GeometryStorage::Value(geometry), prepared: OnceLock::new() }
    }

    /// Creates the object of the feature at `index` (from 0); `None` if there is no such feature. `prefetch` may
    /// prepare its data in advance.
    pub fn of_feature(
        layer: &Arc<Layer>,
        index: usize,
        prefetch: Option<&Arc<dyn Prefetch>>,
    ) -> Option<Self> {
        let there = index < layer.features.len();
        there.then(|| Self {
            from: GeometryStorage::Feature { layer: Arc::clone(layer), index, prefetch: prefetch.cloned() },
            prepared: OnceLock::new(),
        })
    }

    /// Returns the prefetch of the feature's layer and the feature's index, if the geometry has one.
    pub fn prefetch(&self) -> Option<(&dyn Prefetch, usize)> {
        match &self.from {
            GeometryStorage::Feature { prefetch, index, .. } => Some((prefetch.as_deref()?, *index)),
            GeometryStorage::Value(_) => None,
        }
    }

    /// Returns the geometry.
    pub fn geometry(&self) -> &Geometry {
        match &self.from {
            GeometryStorage::Value(geometry) => geometry,
            GeometryStorage::Feature { layer, index, .. } => &layer.features[*index].geometry,
        }
    }

    /// Returns the geometry prepared for comparisons.
    pub(super) fn prepared(&self) -> &PreparedGeometry {
        self.prepared.get_or_init(|| Box::new(PreparedGeometry::new(self.geometry())))
    }

    /// Returns the geometry of `object`, if it is a geometry object.
    pub fn of(object: &dyn Object) -> Option<&Geometry> {
        as_ref::<Self>(object).map(Self::geometry)
    }

    /// Returns the member that scripts read by `name` without a call.
    pub fn member(&self, name: &str) -> Option<Value> {
        let geometry = self.geometry();
        let points =
            |points: &[glam::DVec3]| points.iter().map(|point| point.to_array().to_vec()).collect::<Vec<_>>();
        match (name, geometry) {
            ("kind", _) => Some(Value::Text(geometry.kind().name().into())),
            ("rings", Geometry::Polygon(rings)) => {
                Some(rings.iter().map(|ring| points(ring)).collect::<Vec<_>>().into_value())
            }
            ("points", Geometry::Line(line) | Geometry::MultiPoint(line)) => Some(points(line).into_value()),
            ("points", Geometry::Point(point)) => Some(points(point.as_slice()).into_value()),
            _ => None,
        }
    }

    /// Adds the geometry to a hash. Equal geometries add the same data.
    pub(crate) fn hash<H: Hasher>(geometry: &Geometry, state: &mut H) {
        geometry.kind().hash(state);
        for point in geometry.points() {
            // Adding 0.0 turns -0.0 into 0.0, because the two are equal.
            point.to_array().iter().for_each(|number| (number + 0.0).to_bits().hash(state));
        }
    }
}

impl Parameter for Geometry {
    fn luau() -> String {
        "Geometry".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        super::Shape::from_value(value).map(|shape| shape.geometry().clone())
    }

    fn into_value(self) -> Value {
        Value::Object(Arc::new(GeometryObject::new(self)))
    }
}

impl Answer for Geometry {
    fn luau() -> String {
        <Self as Parameter>::luau()
    }

    fn answer(self) -> burgeon_base::Result<Value> {
        Ok(self.into_value())
    }
}

impl Answer for Vec<Geometry> {
    fn luau() -> String {
        <Self as Parameter>::luau()
    }

    fn answer(self) -> burgeon_base::Result<Value> {
        Ok(self.into_value())
    }
}

/// Returns the position of a point as a vector.
pub(super) fn place(geometry: &Geometry) -> Option<Vector> {
    match geometry {
        Geometry::Point(Some(place)) => Some(Vector(*place)),
        _ => None,
    }
}
