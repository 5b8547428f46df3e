//! Types of vertex attributes in a file.

use super::body::{ArrayKind, Body, BodyArray};
use super::description::{Accessor, Extreme};
use super::mesh::accessor;
use super::quantize::{IntegerArray, PositionGrid};
use glam::Vec3;
use gltf_json::accessor::{ComponentType, Type};

/// Type of a vertex attribute: the view that contains its arrays, and their numbers.
#[derive(Clone, Copy)]
pub(super) struct AttributeType {
    shared: ArrayKind,
    component: ComponentType,
    kind: Type,
    normalized: bool,
    /// Integers that replace the numbers of an array.
    integers: Option<IntegerArray>,
}

impl AttributeType {
    /// Normals that are written as bytes.
    pub(super) const BYTE_NORMALS: Self =
        Self::integer(ArrayKind::ByteNormals, ComponentType::I8, Type::Vec3);
    /// Normals that are written as i16.
    pub(super) const SHORT_NORMALS: Self =
        Self::integer(ArrayKind::ShortNormals, ComponentType::I16, Type::Vec3);

    const fn float(shared: ArrayKind, kind: Type) -> Self {
        Self { shared, component: ComponentType::F32, kind, normalized: false, integers: None }
    }

    const fn integer(shared: ArrayKind, component: ComponentType, kind: Type) -> Self {
        Self { shared, component, kind, normalized: true, integers: None }
    }

    /// Returns the types of positions, normals and texture coordinates. Positions are integers if there is a `grid`, normals if
    /// the file is `quantized`, and texture coordinates if they are `rounded`.
    pub(super) fn all(quantized: bool, grid: Option<PositionGrid>, rounded: bool) -> (Self, Self, Self) {
        let short = |shared: ArrayKind, kind: Type| Self::integer(shared, ComponentType::U16, kind);
        let integers = |stored: Self, kind: IntegerArray| Self { integers: Some(kind), ..stored };
        let positions = match grid {
            Some(grid) => {
                let positions = short(ArrayKind::ShortPositions, Type::Vec3);
                Self { normalized: false, ..integers(positions, IntegerArray::Positions(grid)) }
            }
            None => Self::float(ArrayKind::Positions, Type::Vec3),
        };
        let normals = match quantized {
            true => integers(Self::BYTE_NORMALS, IntegerArray::Normals),
            false => Self::float(ArrayKind::Normals, Type::Vec3),
        };
        let tex_coords = match rounded {
            true => integers(short(ArrayKind::ShortTexCoords, Type::Vec2), IntegerArray::TexCoords),
            false => Self::float(ArrayKind::TexCoords, Type::Vec2),
        };
        (positions, normals, tex_coords)
    }

    /// Adds `array` to the view of the type, as integers if the type has them. Returns the view and the offset in it (bytes).
    pub(super) fn share<'a>(self, array: BodyArray<'a>, body: &mut Body<'a>) -> (u32, u64) {
        match self.integers {
            Some(integers) => body.share(self.shared, BodyArray::Integers(Box::new(array), integers)),
            None => body.share(self.shared, array),
        }
    }

    /// Returns an accessor of `count` items at a place in a view.
    pub(super) fn accessor(self, place: (u32, u64), count: usize) -> Accessor {
        Accessor { normalized: self.normalized, ..accessor(place, self.component, self.kind, count) }
    }
}

/// Adds the corners of the bounding box (m) of positions, as integers if there is a `grid`.
pub(super) fn with_extremes(
    positions: Accessor,
    (low, high): (Vec3, Vec3),
    grid: Option<PositionGrid>,
) -> Accessor {
    let extreme = |at: Vec3| match grid {
        Some(grid) => Extreme::Whole(grid.place(at).map(u32::from)),
        None => Extreme::Point(at.to_array()),
    };
    Accessor { min: Some(extreme(low)), max: Some(extreme(high)), ..positions }
}
