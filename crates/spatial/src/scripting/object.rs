//! Script object of a geometry.

use std::hash::{Hash, Hasher};
use std::sync::{Arc, OnceLock};

use burgeon_kit::declare::as_ref;
use burgeon_kit::{Answer, Expectation, Field, Object, ObjectContent, Parameter, Prefetch, Value, object};
use glam::DVec3;

use super::construct::constructors;
use super::list::GeometryList;
use crate::{Geometry, PreparedGeometry};

/// Maximum length of the text of a geometry in messages (characters).
const SHORT: usize = 60;

/// Points, lines, polygons with holes, and collections of these, from `feature.geometry` and `geometry(text)`.
///
/// It never changes.
#[object("geometry", given, can(ObjectContent), has = fields(), functions = constructors(), example = include_str!("../../scripts/geometry.lua"))]
pub struct GeometryObject {
    from: GeometryStorage,
    /// Form for comparisons, built by the first comparison.
    prepared: OnceLock<Box<PreparedGeometry>>,
}

/// Storage of a geometry.
#[derive(Clone)]
enum GeometryStorage {
    Value(Arc<Geometry>),
    Feature { list: Arc<dyn GeometryList>, index: usize, prefetch: Option<Arc<dyn Prefetch>> },
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
            "Type: \"point\", \"line\", \"polygon\", \"multipoint\", \"multiline\", \"multipolygon\" or \"collection\".",
        ),
        metres(
            "rings",
            "{ { { number } } }?",
            "Rings of a polygon: the outer ring, counter-clockwise, and the holes, as lists of points { x, y, z } (m).",
        ),
        metres("points", "{ { number } }?", "Points { x, y, z } (m) of a line, a point or points."),
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
        list: Arc<dyn GeometryList>,
        index: usize,
        prefetch: Option<&Arc<dyn Prefetch>>,
    ) -> Option<Self> {
        let exists = list.geometry(index).is_some();
        exists.then(|| Self {
            from: GeometryStorage::Feature { list, index, prefetch: prefetch.cloned() },
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
            GeometryStorage::Feature { list, index, .. } => list.geometry(*index).unwrap_or(&EMPTY),
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
}

/// Geometry of a feature that a list has no longer.
static EMPTY: Geometry = Geometry::Collection(Vec::new());

impl ObjectContent for GeometryObject {
    fn equals(&self, other: &dyn Object) -> bool {
        Self::of(other).is_some_and(|other| self.geometry() == other)
    }

    fn hash(&self, mut state: &mut dyn Hasher) {
        let geometry = self.geometry();
        geometry.kind().hash(&mut state);
        for point in geometry.points() {
            // The two zeros are equal.
            point.to_array().iter().for_each(|number| (number + 0.0).to_bits().hash(&mut state));
        }
    }

    fn text(&self) -> String {
        self.geometry().to_short_wkt(SHORT)
    }

    fn memory(&self) -> usize {
        self.geometry().points().count() * size_of::<DVec3>()
    }

    fn position(&self) -> Option<DVec3> {
        match self.geometry() {
            Geometry::Point(position) => *position,
            _ => None,
        }
    }

    fn fragments(&self) -> Option<Vec<Value>> {
        let value = |part| Value::Object(Arc::new(Self::new(part)));
        Some(self.geometry().fragments()?.into_iter().map(value).collect())
    }
}

impl Parameter for Geometry {
    fn luau() -> String {
        "Geometry".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        super::geometry_input::GeometryInput::from_value(value).map(|shape| shape.geometry().clone())
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
