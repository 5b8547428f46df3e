//! Functions with which scripts make geometries: `geometry`, `point`, `line` and `polygon`.

use std::borrow::Cow;
use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_geometry::Rings;
use burgeon_kit::{Answer, Constructor, Expectation, Parameter, Value, Vector};
use glam::DVec3;

use super::geometry_input::GeometryInput;
use super::object::GeometryObject;
use super::polygon::PolygonArgument;
use crate::Geometry;

/// Returns the functions.
pub fn constructors() -> [Constructor; 4] {
    [
        Constructor { name: "geometry", make: geometry },
        Constructor { name: "point", make: point },
        Constructor { name: "line", make: line },
        Constructor { name: "polygon", make: polygon },
    ]
}

/// Makes a geometry from text, a feature or a table; returns a geometry unchanged.
fn geometry(given: &[Value]) -> Result<Value> {
    let what = "a string such as \"POINT (1 2)\", a feature, or a table with rings or points";
    match given {
        [Value::Text(text)] => Geometry::from_wkt(text).map_err(|error| error.about("geometry"))?.answer(),
        [value @ (Value::Object(_) | Value::Table(_))] => {
            let shape = GeometryInput::read_value(value);
            let shape =
                shape.map_err(|_| Expectation::new(what).refuse("geometry", "what it is given", value))?;
            shape.geometry().check().map_err(|error| error.about("geometry"))?;
            Ok(shape.into_value())
        }
        [value] => Err(Expectation::new(what).refuse("geometry", "what it is given", value)),
        _ => Err(Error::argument(format!("geometry takes 1 argument, not {}", given.len()))
            .help("write geometry(\"LINESTRING (0 0, 5 0)\")")),
    }
}

/// Makes a point from two or three numbers, or from a vector.
fn point(given: &[Value]) -> Result<Value> {
    if let [value @ (Value::Table(_) | Value::Object(_))] = given {
        let place = Vector::read_value(value);
        let place = place.map_err(|error| error.refuse("point", "what it is given", value))?;
        return sound("point", Geometry::Point(Some(place.0)));
    }
    if !(2..=3).contains(&given.len()) {
        return Err(Error::argument(format!("point takes 2 or 3 numbers, not {}", given.len()))
            .help("write point(x, y), or point(x, y, height)"));
    }
    let mut place = DVec3::ZERO;
    for ((value, name), number) in given.iter().zip(["x", "y", "z"]).zip(place.as_mut()) {
        *number = f64::read_value(value).map_err(|error| error.refuse("point", name, value))?;
    }
    sound("point", Geometry::Point(Some(place)))
}

/// Makes a line through points, passed one by one or as a list.
fn line(given: &[Value]) -> Result<Value> {
    let points = points("line", given)?;
    if points.len() < 2 {
        return Err(Error::argument(format!("line needs at least 2 points, not {}", points.len()))
            .help("write line({ { 0, 0 }, { 5, 0 } })"));
    }
    sound("line", Geometry::Line(points))
}

/// Makes a polygon from its outer ring, or from a list of rings; the rings after the first are holes.
fn polygon(given: &[Value]) -> Result<Value> {
    let rings = match given {
        [value] => {
            let polygon = PolygonArgument::read_value(value);
            polygon.map_err(|error| error.refuse("polygon", "what it is given", value))?.0
        }
        _ => Rings(vec![points("polygon", given)?]),
    };
    let few = rings.iter().position(|ring| {
        let closed = ring.len() > 1 && ring.first() == ring.last();
        ring.len() - usize::from(closed) < 3
    });
    if few.is_some() || rings.is_empty() {
        let name = match few {
            Some(0) | None => Cow::Borrowed("its outer ring"),
            Some(number) => format!("hole {number}").into(),
        };
        return Err(Error::argument(format!("polygon: {name} has fewer than 3 points"))
            .help("write polygon({ { 0, 0 }, { 4, 0 }, { 4, 3 } })"));
    }
    let mut made = Geometry::polygon(rings).unwrap_or(Geometry::empty(2));
    made.turn();
    sound("polygon", made)
}

/// Reads points that are passed one by one or as a list.
fn points(name: &str, given: &[Value]) -> Result<Vec<DVec3>> {
    let one_by_one = |value: &Value| Vector::read_value(value);
    if let [only @ Value::Table(table)] = given
        && one_by_one(only).is_err()
    {
        let items = table.list();
        if items.len() != table.entries.len() {
            return Err(Expectation::new("a list of points").refuse(name, "what it is given", only));
        }
        return items
            .into_iter()
            .enumerate()
            .map(|(index, item)| {
                let number = format!("point {}", index + 1);
                one_by_one(item).map(|place| place.0).map_err(|error| error.refuse(name, &number, item))
            })
            .collect();
    }
    let numbered = given.iter().enumerate();
    numbered
        .map(|(index, item)| {
            let number = format!("point {}", index + 1);
            one_by_one(item).map(|place| place.0).map_err(|error| error.refuse(name, &number, item))
        })
        .collect()
}

/// Returns the geometry as a script value. Fails if a coordinate is outside of the range for computations.
fn sound(name: &str, geometry: Geometry) -> Result<Value> {
    geometry.check().map_err(|error| error.about(name))?;
    Ok(Value::Object(Arc::new(GeometryObject::new(geometry))))
}
