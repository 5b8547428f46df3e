//! Geometries and lists of points as arguments.

use std::sync::Arc;

use burgeon_geometry::Rings;
use burgeon_kit::{Expectation, Parameter, Value, Vector, object};
use glam::DVec3;

use super::object::GeometryObject;
use super::polygon::PolygonArgument;
use crate::{Geometry, PreparedGeometry};

/// A geometry as an argument: a geometry object, a feature's geometry, or a position.
pub struct GeometryInput(Arc<GeometryObject>);

impl GeometryInput {
    /// Returns the geometry.
    pub fn geometry(&self) -> &Geometry {
        self.0.geometry()
    }

    /// Returns the geometry prepared for comparisons.
    pub(super) fn prepared(&self) -> &PreparedGeometry {
        self.0.prepared()
    }
}

impl Parameter for GeometryInput {
    fn luau() -> String {
        "Geometry | { any }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = || {
            Expectation::new(
                "a geometry: feature.geometry, point(x, y), line({ ... }), polygon({ ... }) or geometry(\"POINT (1 2)\")",
            )
        };
        let Value::Table(table) = &value else { return object(value, "").map(Self).map_err(|_| what()) };
        if let Some(geometry) = table.get("geometry") {
            return Self::read_value(geometry);
        }
        let made = if let Some(rings) = table.get("rings") {
            Geometry::Polygon(PolygonArgument::read_value(rings)?.0)
        } else if let Some(points) = table.get("points") {
            let points: Vec<DVec3> = Vec::<DVec3>::read_value(points)?;
            if points.len() == 1 { Geometry::Point(points.first().copied()) } else { Geometry::Line(points) }
        } else {
            Geometry::Point(Some(Vector::from_value(value).map_err(|_| what())?.0))
        };
        Ok(Self(Arc::new(GeometryObject::new(made))))
    }

    fn into_value(self) -> Value {
        Value::Object(self.0)
    }
}

/// A list of points as an argument, or a geometry with such a list: a line, or a polygon, whose outer ring is used.
#[derive(Debug, Clone)]
pub struct Path {
    /// Points (m).
    pub points: Vec<DVec3>,
    /// Holes of a polygon.
    pub holes: Rings,
}

impl From<Vec<Vector>> for Path {
    fn from(points: Vec<Vector>) -> Self {
        Self { points: points.into_iter().map(|it| it.0).collect(), holes: Rings::default() }
    }
}

impl Parameter for Path {
    fn luau() -> String {
        "{ Vector } | Geometry".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let Value::Object(object) = &value else {
            return Vec::<Vector>::from_value(value).map(Self::from);
        };
        let what = || Expectation::new("a list of points, a line or a polygon");
        match GeometryObject::of(&**object).ok_or_else(what)? {
            Geometry::Line(points) => Ok(Self { points: points.clone(), holes: Rings::default() }),
            Geometry::Polygon(rings) => {
                let mut rings = rings.iter().cloned();
                let points = rings.next().unwrap_or_default();
                Ok(Self { points, holes: rings.collect() })
            }
            other => Err(what().but_was(format!("a geometry of kind {:?}", other.kind().name()))),
        }
    }

    fn into_value(self) -> Value {
        self.points.into_iter().map(Vector).collect::<Vec<_>>().into_value()
    }
}
