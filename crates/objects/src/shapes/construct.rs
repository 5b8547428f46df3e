//! Functions with which scripts make shapes.

use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_base::warning::{Warning, WarningKind, defer_warning};
use burgeon_geometry::Rings;
use burgeon_kit::{Constructor, Expectation, Model, Parameter, Table, Value, Vector};
use burgeon_scene::Part;
use burgeon_shapes::{Scope, Shape};
use burgeon_spatial::{GeometryObject, PolygonArgument};
use glam::{DAffine3, DMat3, DVec2, DVec3};

use super::object::ShapeObject;

/// Sides of round shapes, unless given.
const SIDES: u32 = 32;

/// Returns the functions.
pub(super) fn constructors() -> [Constructor; 9] {
    [
        Constructor { name: "shape", make: shape },
        Constructor { name: "cuboid", make: cuboid },
        Constructor { name: "rectangle", make: rectangle },
        Constructor { name: "disk", make: disk },
        Constructor { name: "cylinder", make: cylinder },
        Constructor { name: "cone", make: cone },
        Constructor { name: "ball", make: ball },
        Constructor { name: "revolve", make: super::revolve::revolve },
        Constructor { name: "text", make: super::text::text },
    ]
}

/// Makes a shape of a polygon, a list of shapes, a model, or points with faces.
fn shape(given: &[Value]) -> Result<Value> {
    let what = "a polygon, a list of shapes, a model, or { points = ..., faces = ... }";
    let (value, height) = match given {
        [value] => (value, 0.0),
        [value, Value::Nil] => (value, 0.0),
        [value, height] => {
            (value, f64::read_value(height).map_err(|error| error.refuse("shape", "height", height))?)
        }
        _ => {
            let count = given.len();
            return Err(Error::argument(format!("shape takes 1 or 2 arguments, not {count}"))
                .help("write shape(feature.geometry), or shape({ { 0, 0 }, { 8, 0 }, { 8, 5 } }, height)"));
        }
    };
    let made = match value {
        Value::Object(object) if ShapeObject::of(&**object).is_some() => return Ok(value.clone()),
        Value::Object(object) if GeometryObject::of(&**object).is_some() => plan(value, height)?,
        Value::Object(_) => match Arc::<Model>::read_value(value) {
            Ok(model) => of_model(&model)?,
            Err(_) => return Err(Expectation::new(what).refuse("shape", "what it is given", value)),
        },
        Value::Table(table) if table.get("faces").is_some() || table.get("points").is_some() => {
            of_faces(table)?
        }
        Value::Table(table) => match shapes(table) {
            Some(parts) => return joined(&parts),
            None => plan(value, height)?,
        },
        _ => return Err(Expectation::new(what).refuse("shape", "what it is given", value)),
    };
    Ok(Value::Object(Arc::new(ShapeObject::new(made))))
}

/// Returns the items of a list, if the first is a shape.
fn shapes(table: &Table) -> Option<Vec<&Value>> {
    let list = table.list();
    let is_shape =
        |value: &&Value| matches!(value, Value::Object(object) if ShapeObject::of(&**object).is_some());
    list.first().filter(|first| is_shape(first))?;
    Some(list)
}

/// Joins a list of shapes; the first gives the named values.
fn joined(parts: &[&Value]) -> Result<Value> {
    let mut shapes = Vec::with_capacity(parts.len());
    for part in parts {
        let read = Arc::<ShapeObject>::read_value(part);
        shapes.push(read.map_err(|error| error.refuse("shape", "an item of the list", part))?);
    }
    let own: Vec<&Shape> = shapes.iter().map(|part| part.shape()).collect();
    match Shape::join(&own).map_err(|error| error.about("shape"))? {
        Some(whole) => Ok(Value::Object(Arc::new(shapes[0].with_shape(whole)))),
        None => Err(Error::argument("shape: the list is empty").help("give at least one shape")),
    }
}

/// Makes the face of a polygon at a height (m).
fn plan(value: &Value, height: f64) -> Result<Shape> {
    let polygon = PolygonArgument::read_value(value);
    let rings = polygon.map_err(|error| error.refuse("shape", "what it is given", value))?.0;
    if let Some(face) = upright_face(&rings, height).map_err(|error| error.about("shape"))? {
        return Ok(face);
    }
    let flat: Vec<Vec<DVec2>> = rings.iter().map(|ring| flat_ring(ring)).collect();
    let face = Shape::plan(&flat, height).map_err(|error| error.about("shape"))?;
    // Points of two numbers have the height 0.
    let differs = |at: f64, other: f64| (at - other).abs() > 1e-9 * (1.0 + other.abs());
    let is_moved = |at: &DVec3| differs(at.z, 0.0) && differs(at.z, height);
    if matches!(value, Value::Table(_)) && rings.iter().flatten().any(is_moved) {
        let text =
            format!("shape: the points of an outline that is not upright are moved to the height {height} m");
        let help = "give the height after the points: shape({ { 0, 0 }, { 8, 0 }, { 8, 5 } }, height)";
        defer_warning(Warning::new(WarningKind::Doubtful, text).help(help));
    }
    Ok(face)
}

/// Makes the face of rings in an upright plane, which looks to the side from where the outer ring is counter-clockwise; `None`
/// for rings in another plane.
fn upright_face(rings: &Rings<DVec3>, height: f64) -> Result<Option<Shape>> {
    let Some(outer) = rings.first().filter(|ring| ring.len() > 2) else { return Ok(None) };
    let origin = outer[0];
    let edges = outer.iter().zip(outer.iter().cycle().skip(1));
    let area: DVec3 = edges.map(|(from, to)| (*from - origin).cross(*to - origin)).sum();
    let Some(normal) = area.try_normalize().filter(|normal| normal.z.abs() < 1e-6) else { return Ok(None) };
    if height != 0.0 {
        return Err(Error::argument(format!(
            "an upright outline has its own height, so {height} m is not used"
        ))
        .help("leave out the height"));
    }
    let axes = Scope::face_axes(normal, DMat3::IDENTITY);
    let local = |at: &DVec3| axes.transpose() * (*at - origin);
    let (mut farthest, mut size) = (0.0_f64, 0.0_f64);
    for at in rings.iter().flatten().map(local) {
        farthest = farthest.max(at.z.abs());
        size = size.max(at.length());
    }
    if farthest > (size * 1e-3).max(1e-3) {
        return Err(Error::geometry(format!(
            "the outline is not flat: a corner is {farthest:.3} m beside its plane"
        ))
        .help("move the corners into one plane"));
    }
    let turned = |ring: &Vec<DVec3>| flat_ring(&ring.iter().map(local).collect::<Vec<_>>());
    let flat: Vec<Vec<DVec2>> = rings.iter().map(turned).collect();
    let frame = DAffine3::from_mat3_translation(axes, origin);
    Ok(Some(Shape::plan(&flat, 0.0)?.transform(&frame)))
}

/// Returns the points of a ring in the plane, without repeated points.
pub(super) fn flat_ring(ring: &[DVec3]) -> Vec<DVec2> {
    let mut flat: Vec<DVec2> = ring.iter().map(|at| at.truncate()).collect();
    flat.dedup();
    if flat.len() > 1 && flat.first() == flat.last() {
        flat.pop();
    }
    flat
}

/// Makes a shape of { points = { vectors }, faces = { lists of numbers from 1 } }.
fn of_faces(table: &Table) -> Result<Shape> {
    let read = |name: &str| table.get(name).cloned().unwrap_or(Value::Nil);
    let (points, faces) = (read("points"), read("faces"));
    let places =
        Vec::<Vector>::read_value(&points).map_err(|error| error.refuse("shape", "points", &points))?;
    let lists =
        Vec::<Vec<u32>>::read_value(&faces).map_err(|error| error.refuse("shape", "faces", &faces))?;
    if let Some(number) = lists.iter().position(|face| face.contains(&0)) {
        let message = format!("shape: face {} refers to point 0", number + 1);
        return Err(Error::argument(message).help("points are numbered from 1"));
    }
    let faces: Vec<Vec<u32>> =
        lists.into_iter().map(|face| face.into_iter().map(|point| point - 1).collect()).collect();
    let places = places.into_iter().map(|place| place.0).collect();
    Shape::of_faces(places, &faces).map_err(|error| error.about("shape"))
}

/// Makes a shape of all triangles of a model.
fn of_model(model: &Model) -> Result<Shape> {
    burgeon_base::MemoryOwner::ensure_room(model.size().saturating_mul(200))?;
    let mut placed: Vec<(Part, Option<[f32; 4]>)> = Vec::new();
    for (parts, transform) in model.meshes() {
        for (part, material) in parts {
            let mut moved = Part { triangles: part.triangles.clone(), ..Part::default() };
            let place = |at: &glam::Vec3| transform.transform_point3(at.as_dvec3()).as_vec3();
            moved.positions = part.positions.iter().map(place).collect();
            placed.push((moved, Some(material.base_color)));
        }
    }
    Shape::of_parts(placed.iter().map(|(part, color)| (part, *color)))?.ok_or_else(|| {
        Error::argument("shape: the model has no triangles").help("give a model that draws something")
    })
}

/// Reads between `least` and `names.len()` numbers.
fn numbers<const N: usize>(
    name: &str,
    names: [&str; N],
    least: usize,
    given: &[Value],
) -> Result<[Option<f64>; N]> {
    let given = match given {
        [rest @ .., Value::Nil] if rest.len() >= least => rest,
        all => all,
    };
    if !(least..=N).contains(&given.len()) {
        let count = if least == N { format!("{N}") } else { format!("{least} to {N}") };
        return Err(Error::argument(format!("{name} takes {count} numbers, not {}", given.len()))
            .help(format!("write {name}({})", names[..least].join(", "))));
    }
    let mut read = [None; N];
    for (slot, (value, label)) in read.iter_mut().zip(given.iter().zip(names)) {
        *slot = Some(f64::read_value(value).map_err(|error| error.refuse(name, label, value))?);
    }
    Ok(read)
}

/// Fails unless a length (m) is above 0 and below 1e7.
fn length(name: &str, label: &str, value: Option<f64>) -> Result<f64> {
    match value {
        Some(length) if length > 0.0 && length < 1e7 => Ok(length),
        other => Err(Error::argument(format!("{name}: {label} is {} m", other.unwrap_or(0.0)))
            .help("use a length above 0 and below 1e7 m")),
    }
}

/// Returns the number of sides.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
fn sides(name: &str, value: Option<f64>) -> Result<u32> {
    match value {
        None => Ok(SIDES),
        Some(sides) if sides.fract() == 0.0 && (3.0..=1024.0).contains(&sides) => Ok(sides as u32),
        Some(sides) => {
            Err(Error::argument(format!("{name}: sides is {sides}")).help("use an integer from 3 to 1024"))
        }
    }
}

/// Makes the value of a shape.
fn value(name: &str, shape: Result<Shape>) -> Result<Value> {
    let shape = shape.map_err(|error| error.about(name))?;
    Ok(Value::Object(Arc::new(ShapeObject::new(shape))))
}

fn cuboid(given: &[Value]) -> Result<Value> {
    let [x, y, z] = numbers("cuboid", ["x", "y", "z"], 3, given)?;
    let size = DVec3::new(length("cuboid", "x", x)?, length("cuboid", "y", y)?, length("cuboid", "z", z)?);
    value("cuboid", Ok(Shape::cuboid(size)))
}

fn rectangle(given: &[Value]) -> Result<Value> {
    let [x, y] = numbers("rectangle", ["x", "y"], 2, given)?;
    let size = DVec2::new(length("rectangle", "x", x)?, length("rectangle", "y", y)?);
    value("rectangle", Ok(Shape::rectangle(size)))
}

fn disk(given: &[Value]) -> Result<Value> {
    let [radius, count] = numbers("disk", ["radius", "sides"], 1, given)?;
    value("disk", Shape::disk(length("disk", "radius", radius)?, sides("disk", count)?))
}

fn cylinder(given: &[Value]) -> Result<Value> {
    let [radius, height, count] = numbers("cylinder", ["radius", "height", "sides"], 2, given)?;
    let (radius, height) = (length("cylinder", "radius", radius)?, length("cylinder", "height", height)?);
    value("cylinder", Shape::cylinder(radius, radius, height, sides("cylinder", count)?))
}

fn cone(given: &[Value]) -> Result<Value> {
    let [radius, height, count] = numbers("cone", ["radius", "height", "sides"], 2, given)?;
    let (radius, height) = (length("cone", "radius", radius)?, length("cone", "height", height)?);
    value("cone", Shape::cylinder(radius, 0.0, height, sides("cone", count)?))
}

fn ball(given: &[Value]) -> Result<Value> {
    let [radius, count] = numbers("ball", ["radius", "sides"], 1, given)?;
    value("ball", Shape::sphere(length("ball", "radius", radius)?, sides("ball", count)?))
}
