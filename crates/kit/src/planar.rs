//! Conversion of tables and features from scripts to rings and lines in the plane.

use std::sync::Arc;

use glam::DVec3;

use super::{Expectation, Features, GeometryObject, Parameter, Value, Vector};
use burgeon_data::Geometry;
use burgeon_geometry::{Line, Rings};

/// Returns the rings of a geometry, if it is a single polygon.
pub fn rings(geometry: &Geometry) -> Option<&Rings> {
    match geometry {
        Geometry::Polygon(rings) => Some(rings),
        Geometry::MultiPolygon(polygons) if polygons.len() == 1 => polygons.first(),
        _ => None,
    }
}

/// Converts points for scripts.
fn vectors(points: &[DVec3]) -> Vec<Vector> {
    points.iter().copied().map(Vector).collect()
}

fn places(vectors: Vec<Vector>) -> Vec<DVec3> {
    vectors.into_iter().map(|vector| vector.0).collect()
}

impl Parameter for Rings {
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
                return rings(geometry).cloned().ok_or_else(|| not_this(geometry.kind().name()));
            }
            _ => return Err(what()),
        };
        let rings = match (table.get("rings"), table.get("kind")) {
            (Some(rings), _) => rings.clone(),
            (None, Some(Value::Text(kind))) => return Err(not_this(kind)),
            _ => value.clone(),
        };
        let first = |value: &Value| match value {
            Value::Table(table) => table.list().into_iter().next(),
            _ => None,
        };
        let is_ring = |value: &Value| {
            let number = first(value).and_then(|point| first(&point));
            matches!(number, Some(Value::Number(_)))
        };
        let rings = Vec::<Vec<Vector>>::from_value(rings.clone()).or_else(|error| {
            let ring = Vec::<Vector>::from_value(rings.clone());
            ring.map(|ring| vec![ring]).map_err(|of_ring| if is_ring(&rings) { of_ring } else { error })
        })?;
        Ok(rings.into_iter().map(places).collect())
    }

    fn into_value(self) -> Value {
        self.iter().map(|ring| vectors(ring)).collect::<Vec<_>>().into_value()
    }
}

/// Lines (m) from a source, from geometries or from lists of points. Lines without length are dropped.
#[derive(Debug, Clone, Default)]
pub struct Lines {
    /// The lines (m).
    pub lines: Vec<Line<DVec3>>,
    /// Number of skipped items of a list, and the message for the first of them.
    pub refused: Option<(usize, String)>,
}

impl Parameter for Lines {
    fn luau() -> String {
        "any".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let mut lines = Self::default();
        lines.collect(value, 0)?;
        Ok(lines)
    }

    fn into_value(self) -> Value {
        self.lines.iter().map(|line| vectors(line)).collect::<Vec<_>>().into_value()
    }
}

impl Lines {
    /// Adds the lines of a value: of a source, a feature, a geometry, or a list of these or of points.
    fn collect(&mut self, value: Value, depth: usize) -> Result<(), Expectation> {
        let what = || Expectation::new("a source of lines, a list of lines, or a list of points");
        match value {
            Value::Object(object) => {
                let any: &dyn std::any::Any = &*object;
                if let Some(geometry) = GeometryObject::of(&*object) {
                    self.add(geometry);
                    return Ok(());
                }
                let features = any.downcast_ref::<Features>().ok_or_else(what)?;
                features.0.features.iter().for_each(|feature| self.add(&feature.geometry));
            }
            Value::Table(table) => {
                if let Some(geometry) = table.get("geometry") {
                    return self.collect(geometry.clone(), depth + 1);
                }
                if let Some(points) = table.get("points") {
                    return self.collect(points.clone(), depth + 1);
                }
                if let Some(rings) = table.get("rings") {
                    let rings = Vec::<Vec<Vector>>::from_value(rings.clone()).map_err(|_| what())?;
                    self.lines.extend(rings.into_iter().filter_map(|ring| around(places(ring))));
                    return Ok(());
                }
                if let Ok(points) = Vec::<Vector>::from_value(Value::Table(Arc::clone(&table))) {
                    self.lines.extend(Line::without_repeats(places(points)));
                    return Ok(());
                }
                let list = table.list();
                if depth > 4 || list.len() != table.entries.len() {
                    return Err(what());
                }
                // A bad item is skipped alone, if other items are good.
                let (mut good, mut bad) = (0, None);
                for (number, item) in (1..).zip(list) {
                    let known = self.lines.len();
                    match self.collect(item, depth + 1) {
                        Ok(()) => good += 1,
                        Err(error) => {
                            self.lines.truncate(known);
                            let (count, _) = self.refused.get_or_insert_with(|| (0, error.item(number)));
                            *count += 1;
                            bad.get_or_insert(error);
                        }
                    }
                }
                if let (0, Some(error)) = (good, bad) {
                    return Err(error);
                }
            }
            _ => return Err(what()),
        }
        Ok(())
    }

    fn add(&mut self, geometry: &Geometry) {
        match geometry {
            Geometry::Line(line) => self.lines.extend(Line::without_repeats(line.clone())),
            // A polygon contributes the lines around its rings, such as the path around a square.
            Geometry::Polygon(rings) => {
                self.lines.extend(rings.iter().filter_map(|ring| around(ring.clone())));
            }
            Geometry::MultiLine(lines) => {
                self.lines.extend(lines.iter().filter_map(|line| Line::without_repeats(line.clone())));
            }
            Geometry::MultiPolygon(polygons) => {
                self.lines.extend(
                    polygons.iter().flat_map(|rings| rings.iter()).filter_map(|ring| around(ring.clone())),
                );
            }
            Geometry::Collection(members) => members.iter().for_each(|member| self.add(member)),
            Geometry::Point(_) | Geometry::MultiPoint(_) => {}
        }
    }
}

/// Returns the closed line around a ring from user data; `None` if it has no length.
fn around(mut ring: Vec<DVec3>) -> Option<Line<DVec3>> {
    ring.extend(ring.first().copied());
    Line::without_repeats(ring)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Table, TableKey};
    use burgeon_base::random::Stream;

    fn point(random: &mut Stream) -> DVec3 {
        // Few positions make repeated points likely. The heights test the third coordinate.
        DVec3::new(random.below(4) as f64, random.below(4) as f64, random.below(2) as f64 * 0.5)
    }

    fn ring(random: &mut Stream, most: usize) -> Vec<DVec3> {
        (0..random.below(most)).map(|_| point(random)).collect()
    }

    #[test]
    fn rings_come_back_from_a_script_as_they_were() {
        let mut random = Stream::new(4);
        for _ in 0..500 {
            let rings: Rings = (0..1 + random.below(4)).map(|_| ring(&mut random, 6)).collect();
            // The content distinguishes a list without rings, or with an empty first ring, from a single ring.
            let there = Rings::from_value(rings.clone().into_value()).expect("rings");
            assert_eq!(there, rings);
            let table = vec![(TableKey::Name("rings".into()), rings.clone().into_value())];
            let named = Value::Table(Arc::new(Table { class: None, entries: table }));
            assert_eq!(Rings::from_value(named).expect("rings"), rings);
        }
    }

    #[test]
    fn one_ring_may_stand_for_a_polygon_without_holes() {
        let ring = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let found = Rings::from_value(vectors(&ring).into_value()).expect("a ring");
        assert_eq!(found, Rings(vec![ring]));
    }

    #[test]
    fn lines_come_back_from_a_script_without_what_has_no_length() {
        let mut random = Stream::new(9);
        let mut kept = 0;
        for _ in 0..500 {
            let given: Vec<Vec<DVec3>> = (0..1 + random.below(4)).map(|_| ring(&mut random, 5)).collect();
            let value = given.iter().map(|line| vectors(line)).collect::<Vec<_>>().into_value();
            let lines = Lines::from_value(value).expect("lines");
            let expected: Vec<_> = given.into_iter().filter_map(Line::without_repeats).collect();
            assert_eq!(lines.lines, expected);
            assert_eq!(Lines::from_value(lines.clone().into_value()).expect("lines").lines, expected);
            kept += expected.len();
        }
        assert!(kept > 500, "{kept}");
    }

    #[test]
    fn what_is_no_polygon_is_refused_by_what_it_is() {
        let refuse = |value: Value| {
            let refused = Rings::from_value(value.clone()).map(|rings| rings.0).expect_err("no polygon");
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
