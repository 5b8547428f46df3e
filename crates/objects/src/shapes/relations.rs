//! Relations between shapes, as scripts ask for them.

use std::sync::Arc;

use burgeon_kit::{Expectation, Parameter, Value, Vector};
use glam::DVec3;

use super::object::ShapeObject;

/// A position (m) or a shape.
#[derive(Clone)]
pub enum ShapeOrPlace {
    /// Position (m).
    Place(DVec3),
    /// Shape.
    Shape(Arc<ShapeObject>),
}

impl Parameter for ShapeOrPlace {
    fn luau() -> String {
        "Shape | Vector".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        if let Ok(shape) = Arc::<ShapeObject>::read_value(&value) {
            return Ok(Self::Shape(shape));
        }
        Vector::read_value(&value)
            .map(|place| Self::Place(place.0))
            .map_err(|_| Expectation::new("a shape or a position, such as vec(1, 2, 3)"))
    }

    fn into_value(self) -> Value {
        match self {
            Self::Place(place) => Vector(place).into_value(),
            Self::Shape(shape) => Value::Object(shape),
        }
    }
}
