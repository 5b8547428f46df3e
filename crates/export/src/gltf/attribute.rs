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

    /// Returns the types of positions, normals and texture coordinates, as integers if there is a `grid` of positions, and
    /// if texture coordinates are `rounded`.
    pub(super) fn all(grid: Option<PositionGrid>, rounded: bool) -> (Self, Self, Self) {
        let tex_coords = Self::float(ArrayKind::TexCoords, Type::Vec2);
        let Some(grid) = grid else {
            let (positions, normals) = (ArrayKind::Positions, ArrayKind::Normals);
            return (Self::float(positions, Type::Vec3), Self::float(normals, Type::Vec3), tex_coords);
        };
        let positions = Self::integer(ArrayKind::ShortPositions, ComponentType::U16, Type::Vec3);
        let rounded_tex_coords = Self::integer(ArrayKind::ShortTexCoords, ComponentType::U16, Type::Vec2);
        let integers = |stored: Self, kind: IntegerArray| Self { integers: Some(kind), ..stored };
        (
            Self { normalized: false, ..integers(positions, IntegerArray::Positions(grid)) },
            integers(Self::BYTE_NORMALS, IntegerArray::Normals),
            if rounded { integers(rounded_tex_coords, IntegerArray::TexCoords) } else { tex_coords },
        )
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
