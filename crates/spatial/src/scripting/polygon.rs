//! Polygons as arguments: tables and geometries become rings.

use burgeon_geometry::Rings;
use burgeon_kit::{Expectation, Parameter, Value, Vector};

use super::lines::{positions, vectors};
use super::object::GeometryObject;
use crate::Geometry;

/// Returns the rings of a geometry, if it is one polygon.
pub fn rings(geometry: &Geometry) -> Option<&Rings> {
    match geometry {
        Geometry::Polygon(rings) => Some(rings),
        Geometry::MultiPolygon(polygons) if polygons.len() == 1 => polygons.first(),
        _ => None,
    }
}

/// A polygon as an argument: a geometry, a list of rings, or one ring.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PolygonArgument(pub Rings);

impl From<Rings> for PolygonArgument {
    fn from(rings: Rings) -> Self {
        Self(rings)
    }
}

impl Parameter for PolygonArgument {
    fn luau() -> String {
        "Geometry | { any }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = || {
            Expectation::new(
                "a polygon: feature.geometry, or { { { x, y }, { x, y }, { x, y } }, hole, ... }",
            )
        };
        let not_this =
            |kind: &str| Expectation::new("a polygon").but_was(format!("a geometry of kind {kind:?}"));
        let table = match &value {
            Value::Table(table) => table,
            Value::Object(object) => {
                let geometry = GeometryObject::of(&**object).ok_or_else(what)?;
                return rings(geometry).cloned().map(Self).ok_or_else(|| not_this(geometry.kind().name()));
            }
            _ => return Err(what()),
        };
        let rings = match (table.get("rings"), table.get("kind")) {
            (Some(rings), _) => rings,
            (None, Some(Value::Text(kind))) => return Err(not_this(kind)),
            _ => &value,
        };
        let is_ring = |value: &Value| matches!(first(value).and_then(first), Some(Value::Number(_)));
        let rings = Vec::<Vec<Vector>>::read_value(rings).or_else(|error| {
            let ring = Vec::<Vector>::read_value(rings);
            ring.map(|ring| vec![ring]).map_err(|of_ring| if is_ring(rings) { of_ring } else { error })
        })?;
        Ok(Self(rings.into_iter().map(positions).collect()))
    }

    fn into_value(self) -> Value {
        self.0.iter().map(|ring| vectors(ring)).collect::<Vec<_>>().into_value()
    }
}

/// Returns the first item of a list.
fn first(value: &Value) -> Option<&Value> {
    match value {
        Value::Table(table) => table.list().into_iter().next(),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use burgeon_base::random::Stream;
    use burgeon_kit::{Table, TableKey};
    use glam::DVec3;

    use super::*;
    use crate::scripting::lines::tests::ring;

    #[test]
    fn rings_come_back_from_a_script_as_they_were() {
        let mut random = Stream::new(4);
        for _ in 0..500 {
            let rings: Rings = (0..1 + random.below(4)).map(|_| ring(&mut random, 6)).collect();
            // A list without rings, or whose first ring is empty, is told from a ring by what it holds.
            let there =
                PolygonArgument::from_value(PolygonArgument(rings.clone()).into_value()).expect("rings").0;
            assert_eq!(there, rings);
            let table = vec![(TableKey::Name("rings".into()), PolygonArgument(rings.clone()).into_value())];
            let named = Value::Table(Arc::new(Table { class: None, entries: table }));
            assert_eq!(PolygonArgument::from_value(named).expect("rings").0, rings);
        }
    }

    #[test]
    fn one_ring_may_stand_for_a_polygon_without_holes() {
        let ring = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let found = PolygonArgument::from_value(vectors(&ring).into_value()).expect("a ring");
        assert_eq!(found.0, Rings(vec![ring]));
    }

    #[test]
    fn what_is_no_polygon_is_refused_by_what_it_is() {
        let refuse = |value: Value| {
            let refused = PolygonArgument::read_value(&value).expect_err("no polygon");
            refused.refuse("footprint", "geometry", &value).message().to_owned()
        };
        let line = vec![(TableKey::Name("kind".into()), Value::Text("line".into()))];
        let line = Value::Table(Arc::new(Table { class: None, entries: line }));
        assert_eq!(refuse(line), "footprint: geometry must be a polygon, not a geometry of kind \"line\"");
        assert_eq!(
            refuse(Value::Number(3.0)),
            "footprint: geometry must be a polygon: feature.geometry, or { { { x, y }, { x, y }, { x, y } }, hole, ... }, \
             not 3"
        );
    }
}
