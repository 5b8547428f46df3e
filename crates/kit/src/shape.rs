//! temporary
use std::sync::Arc;

use super::Value;
use burgeon_macros::{methods, object};
use burgeon_spatial::Geometry;

/// A geometry.
#[object("geometry", given)]
pub struct GeometryShape(pub Arc<Geometry>);

#[methods("geometry")]
impl GeometryShape {}

/// Of a value.
pub fn geometry_of(value: &Value) -> Option<&Arc<Geometry>> {
    let Value::Object(object) = value else { return None };
    let any: &dyn std::any::Any = &**object;
    any.downcast_ref::<GeometryShape>().map(|shape| &shape.0)
}

/// As a value.
pub fn geometry_value(geometry: &Arc<Geometry>) -> Value {
    Value::Object(Arc::new(GeometryShape(Arc::clone(geometry))))
}
