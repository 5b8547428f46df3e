//! Script object of a shape.

use std::hash::Hasher;
use std::sync::Arc;

use burgeon_base::error::Result;
use burgeon_base::warning::{Warning, WarningKind, defer_warning};
use burgeon_kit::declare::as_ref;
use burgeon_kit::{
    Answer, IntoParts, Object, ObjectContent, ObjectParameter, Table, TableKey, Value, object,
};
use burgeon_shapes::{Shape, ShapeBody};
use glam::DVec3;

use super::construct::constructors;

/// A solid, faces or an edge with a scope, an oriented box, which rules divide into parts.
///
/// It never changes. Its methods return new shapes, and modules carry them. The module Draw draws one.
#[object("shape", given, can(ObjectContent, IntoParts), functions = constructors(), example = include_str!("../../scripts/shape.lua"))]
pub struct ShapeObject {
    pub(super) shape: Shape,
    /// Named values that parts inherit.
    pub(super) values: Option<Arc<Table>>,
    /// Place among the parts of the operation that made it.
    pub(super) place: PartPlace,
    /// Selectors that match a face among the faces of the shape that it comes from, as bits of [`burgeon_shapes::Selector::bit`]; 0 for others.
    pub(super) matching: u32,
}

/// Place of a part among the parts of an operation.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct PartPlace {
    /// Number, from 0.
    pub index: u32,
    /// Number of parts.
    pub count: u32,
    /// Number of the size that made it, from 0.
    pub entry: u32,
}

impl ShapeObject {
    /// Creates the object of a shape.
    pub fn new(shape: Shape) -> Self {
        Self { shape, values: None, place: PartPlace { index: 0, count: 1, entry: 0 }, matching: 0 }
    }

    /// Returns the shape.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Returns the shape of `object`, if it is a shape object.
    pub fn of(object: &dyn Object) -> Option<&Self> {
        as_ref::<Self>(object)
    }

    /// Returns another shape with the values and the place of this one.
    pub(super) fn with_shape(&self, shape: Shape) -> Self {
        Self { shape, values: self.values.clone(), place: self.place, matching: self.matching }
    }

    /// Returns parts of this shape with its values, numbered in their order.
    pub(super) fn parts(&self, shapes: impl IntoIterator<Item = Shape>) -> Vec<Arc<Self>> {
        self.number_parts(shapes.into_iter().map(|shape| (0, shape)).collect())
    }

    /// Returns parts of this shape with its values, numbered in their order, with the numbers of their sizes.
    #[allow(clippy::cast_possible_truncation, reason = "an operation makes fewer than 2^32 parts")]
    pub(super) fn number_parts(&self, shapes: Vec<(usize, Shape)>) -> Vec<Arc<Self>> {
        let count = shapes.len() as u32;
        let numbered = shapes.into_iter().enumerate().map(|(index, (entry, shape))| {
            let place = PartPlace { index: index as u32, count, entry: entry as u32 };
            Arc::new(Self { shape, values: self.values.clone(), place, matching: 0 })
        });
        numbered.collect()
    }

    /// Returns the named value.
    pub(super) fn value(&self, name: &str) -> Value {
        self.values.as_ref().and_then(|values| values.get(name)).cloned().unwrap_or(Value::Nil)
    }

    /// Returns the shape with another named value; nil removes it.
    pub(super) fn with_value(&self, name: &str, value: Value) -> Self {
        let mut entries = self.values.as_ref().map_or_else(Vec::new, |values| values.entries.clone());
        entries.retain(|(key, _)| !matches!(key, TableKey::Name(known) if **known == *name));
        if !matches!(value, Value::Nil) {
            entries.push((TableKey::Name(name.into()), value));
            entries.sort_by(|a, b| a.0.cmp(&b.0));
        }
        let values = (!entries.is_empty()).then(|| Arc::new(Table { class: None, entries }));
        Self { shape: self.shape.clone(), values, place: self.place, matching: self.matching }
    }
}

/// Reports something that differs from the request, at the line of the call.
pub(super) fn warn(method: &str, text: &str, help: &str) {
    defer_warning(Warning::new(WarningKind::Doubtful, format!("shape:{method}: {text}")).help(help));
}

impl ObjectContent for ShapeObject {
    fn equals(&self, other: &dyn Object) -> bool {
        let Some(other) = Self::of(other) else { return false };
        self.shape.scope() == other.shape.scope()
            && self.values == other.values
            && self.place == other.place
            && self.matching == other.matching
            && self.shape.has_trim_of(&other.shape)
            && match (&self.shape.body, &other.shape.body) {
                (ShapeBody::Box(a), ShapeBody::Box(b)) => a == b,
                (ShapeBody::Recess(a), ShapeBody::Recess(b)) => a == b,
                (ShapeBody::Rectangle(a), ShapeBody::Rectangle(b)) => a == b,
                (ShapeBody::Edge(kind, a), ShapeBody::Edge(other, b)) => kind == other && a == b,
                (ShapeBody::Mesh(a), ShapeBody::Mesh(b)) => Arc::ptr_eq(a, b),
                _ => false,
            }
    }

    fn hash(&self, state: &mut dyn Hasher) {
        let scope = &self.shape.scope();
        let numbers = scope.origin.to_array().into_iter().chain(scope.size.to_array());
        // One number for the hasher, since each call of it is a virtual one. The two zeros are equal.
        let mixed = numbers.fold(u64::from(self.place.index), |mixed, number| {
            (mixed.rotate_left(7) ^ (number + 0.0).to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        });
        state.write_u64(mixed);
    }

    fn text(&self) -> String {
        let size = self.shape.scope().size;
        let round = |length: f64| (length * 1000.0).round() / 1000.0;
        let [x, y, z] = size.to_array().map(round);
        match &self.shape.body {
            ShapeBody::Box(_) => format!("box of {x} x {y} x {z} m"),
            ShapeBody::Recess(_) => format!("recess of {x} x {y} x {z} m"),
            ShapeBody::Rectangle(_) => format!("rectangle of {x} x {y} m"),
            ShapeBody::Edge(kind, _) => format!("{} of {x} m", kind.name()),
            ShapeBody::Mesh(mesh) => {
                let faces = mesh.faces.len();
                let what = if mesh.is_closed() { "solid" } else { "surface" };
                format!("{what} of {faces} faces, {x} x {y} x {z} m")
            }
        }
    }

    fn memory(&self) -> usize {
        self.shape.memory()
    }

    fn position(&self) -> Option<DVec3> {
        None
    }

    fn fragments(&self) -> Option<Vec<Value>> {
        None
    }
}

impl ObjectParameter for ShapeObject {
    const LUAU: &str = "Shape";
    const EXPECTED: &str = "a shape, such as cuboid(10, 6, 3)";
}

impl Answer for ShapeObject {
    fn luau() -> String {
        Self::LUAU.into()
    }

    fn answer(self) -> Result<Value> {
        Ok(Value::Object(Arc::new(self)))
    }
}
