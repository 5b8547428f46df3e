//! Conversion of tables and features from scripts to rings and lines in the plane.

use burgeon_geometry::Line;
use burgeon_kit::{Expectation, Parameter, Value, Vector};
use glam::DVec3;

use super::list::GeometryList;
use super::object::GeometryObject;
use crate::Geometry;

/// Returns points as scripts hold them.
pub(super) fn vectors(points: &[DVec3]) -> Vec<Vector> {
    points.iter().copied().map(Vector).collect()
}

/// Returns the positions of vectors.
pub(super) fn positions(vectors: Vec<Vector>) -> Vec<DVec3> {
    vectors.into_iter().map(|vector| vector.0).collect()
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
        Self::read_value(&value)
    }

    fn read_value(value: &Value) -> Result<Self, Expectation> {
        let mut lines = Self::default();
        lines.collect(value, 0)?;
        Ok(lines)
    }

    fn into_value(self) -> Value {
        self.lines.iter().map(|line| vectors(line)).collect::<Vec<_>>().into_value()
    }
}

impl Lines {
    /// Returns the lines of a geometry.
    pub fn of(geometry: &Geometry) -> Self {
        let mut lines = Self::default();
        lines.add(geometry);
        lines
    }

    /// Adds the lines of a value: of a source, a feature, a geometry, or a list of these or of points.
    fn collect(&mut self, value: &Value, depth: usize) -> Result<(), Expectation> {
        let what = || Expectation::new("a source of lines, a list of lines, or a list of points");
        match value {
            Value::Object(object) => {
                if let Some(geometry) = GeometryObject::of(&**object) {
                    self.add(geometry);
                    return Ok(());
                }
                let list = object.capability::<dyn GeometryList>().ok_or_else(what)?;
                (0..list.count())
                    .filter_map(|index| list.geometry(index))
                    .for_each(|geometry| self.add(geometry));
            }
            Value::Table(table) => {
                if let Some(geometry) = table.get("geometry") {
                    return self.collect(geometry, depth + 1);
                }
                if let Some(points) = table.get("points") {
                    return self.collect(points, depth + 1);
                }
                if let Some(rings) = table.get("rings") {
                    let rings = Vec::<Vec<Vector>>::read_value(rings).map_err(|_| what())?;
                    self.lines.extend(rings.into_iter().filter_map(|ring| around(positions(ring))));
                    return Ok(());
                }
                if let Ok(points) = Vec::<Vector>::read_value(value) {
                    self.lines.extend(Line::without_repeats(positions(points)));
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
pub(super) mod tests {
    use burgeon_base::random::Stream;

    use super::*;

    fn point(random: &mut Stream) -> DVec3 {
        // Few positions make repeated points likely. The heights test the third coordinate.
        DVec3::new(random.below(4) as f64, random.below(4) as f64, random.below(2) as f64 * 0.5)
    }

    pub(in crate::scripting) fn ring(random: &mut Stream, most: usize) -> Vec<DVec3> {
        (0..random.below(most)).map(|_| point(random)).collect()
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
}
