//! Ridges, edges and apexes of roofs as scripts write them.

use burgeon_base::error::{Error, Result};
use burgeon_geometry::roof::RoofMap;
use burgeon_kit::{Expectation, Parameter, Value, Vector};
use burgeon_spatial::{Geometry, GeometryInput};
use glam::{DVec2, DVec3};

use super::checks::check_height;
use super::options::Roof;

/// Maximum number of points of the lines of a roof.
const MOST_POINTS: usize = 2_000;

/// Description of a list of lines.
const LINES: &str = "a list of lines, such as { { { 0, 4 }, { 12, 4 } } }";

/// Lines of a roof, each a list of points (m) or a line geometry.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RoofLines(pub(super) Vec<Vec<DVec3>>);

/// Points of a roof (m).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RoofPoints(pub(super) Vec<DVec3>);

impl Parameter for RoofLines {
    fn luau() -> String {
        "{ { Vector } | Geometry }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = || Expectation::new(LINES);
        let Value::Table(table) = &value else { return Err(what()) };
        let list = table.list();
        if list.len() != table.entries.len() {
            return Err(what());
        }
        let mut lines = Vec::with_capacity(list.len());
        for (number, item) in (1..).zip(list) {
            if let Ok(points) = Vec::<Vector>::read_value(item) {
                lines.push(points.into_iter().map(|point| point.0).collect());
                continue;
            }
            let refused = || what().but_was(format!("a list whose item {number} is not a line"));
            match GeometryInput::read_value(item).map_err(|_| refused())?.geometry() {
                Geometry::Line(points) => lines.push(points.clone()),
                Geometry::MultiLine(parts) => lines.extend(parts.iter().cloned()),
                _ => return Err(refused()),
            }
        }
        Ok(Self(lines))
    }

    fn into_value(self) -> Value {
        let lines = self.0.into_iter().map(|line| line.into_iter().map(Vector).collect::<Vec<_>>());
        lines.collect::<Vec<_>>().into_value()
    }
}

impl Parameter for RoofPoints {
    fn luau() -> String {
        "{ Vector | Geometry }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let points = Vec::<Vector>::read_value(&value)
            .map_err(|_| Expectation::new("a list of points, such as { { 6, 4 }, { 9, 4, 3.5 } }"))?;
        Ok(Self(points.into_iter().map(|point| point.0).collect()))
    }

    fn into_value(self) -> Value {
        self.0.into_iter().map(Vector).collect::<Vec<_>>().into_value()
    }
}

impl Roof {
    /// Returns true if lines or points define the surface.
    pub(super) fn has_lines(&self) -> bool {
        !(self.ridges.0.is_empty() && self.edges.0.is_empty() && self.apexes.0.is_empty())
    }
}

/// Returns the lines of a roof, moved by `-origin` (m); `None` if there are none. Fails if there are too many points, or one is
/// too high.
pub(crate) fn roof_map(options: &Roof, origin: DVec2) -> Result<Option<RoofMap>> {
    if !options.has_lines() {
        return Ok(None);
    }
    let lines = || options.ridges.0.iter().chain(&options.edges.0).chain(std::iter::once(&options.apexes.0));
    let count: usize = lines().map(Vec::len).sum();
    if count > MOST_POINTS {
        return Err(Error::argument(format!("footprint:roof: the lines of the roof have {count} points"))
            .help(format!("give at most {MOST_POINTS} points to one roof")));
    }
    for point in lines().flatten().filter(|point| point.z > 0.0) {
        check_height("footprint:roof: the height of a point", point.z)?;
    }
    let moved =
        |line: &Vec<DVec3>| -> Vec<DVec3> { line.iter().map(|at| *at - origin.extend(0.0)).collect() };
    Ok(Some(RoofMap {
        ridges: options.ridges.0.iter().map(moved).collect(),
        edges: options.edges.0.iter().map(moved).collect(),
        apexes: moved(&options.apexes.0),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(items: Vec<Value>) -> Value {
        items.into_value()
    }

    fn point(x: f64, y: f64) -> Value {
        Vector(DVec3::new(x, y, 0.0)).into_value()
    }

    #[test]
    fn lines_are_lists_of_points_and_a_single_line_is_refused() {
        let line = || list(vec![point(0.0, 4.0), point(12.0, 4.0)]);
        let read = RoofLines::from_value(list(vec![line(), line()])).expect("two lines");
        assert_eq!(read.0.len(), 2);
        assert_eq!(RoofLines::from_value(read.clone().into_value()).expect("two lines"), read);
        assert!(RoofLines::from_value(line()).is_err() && RoofLines::from_value(Value::Number(1.0)).is_err());
        assert_eq!(RoofLines::from_value(list(Vec::new())).expect("no lines"), RoofLines::default());
        assert!(RoofPoints::from_value(list(vec![line()])).is_err());
        assert_eq!(RoofPoints::from_value(line()).expect("two points").0.len(), 2);
    }

    #[test]
    fn points_that_are_too_high_or_too_many_are_refused() {
        let high = Roof { apexes: RoofPoints(vec![DVec3::new(0.0, 0.0, 1e6)]), ..Roof::default() };
        assert!(roof_map(&high, DVec2::ZERO).is_err());
        let many = Roof { ridges: RoofLines(vec![vec![DVec3::ZERO; MOST_POINTS + 1]]), ..Roof::default() };
        assert!(roof_map(&many, DVec2::ZERO).is_err());
        assert_eq!(roof_map(&Roof::default(), DVec2::ZERO).expect("no lines"), None);
    }
}
