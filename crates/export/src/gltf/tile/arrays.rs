//! Arrays of the vertices and triangles of a tile.

use gltf_json::accessor::{ComponentType, Type};

use super::super::body::{ArrayKind, Body, BodyArray};
use super::super::description::{Accessor, Attributes, Description, Extreme, Primitive};
use super::super::mesh::accessor;
use super::super::metadata::mesh_features;
use super::merge::{MergedPart, PrimitiveKey};
use super::vertex::{PlaceFormat, VertexFormat};

/// Number of vertices from which on indices have 32 bits. The highest 16-bit number marks the end of a strip.
const LONG: usize = 65_535;

/// Adds the arrays of a primitive, whose features are less than `rows`. Feature numbers are left out if the key has no table.
pub(super) fn add_primitive<'a>(
    (key, part): (PrimitiveKey, &MergedPart),
    rows: usize,
    format: &VertexFormat,
    description: &mut Description<'a>,
    body: &mut Body<'a>,
) -> Primitive {
    let count = part.vertices.len();
    let positions = positions(part, format, description, body);
    let normals = {
        let mut bytes = Vec::with_capacity(count * 12);
        part.vertices.iter().for_each(|vertex| format.put_normal(vertex.normal, &mut bytes));
        let (kind, component) = match format.byte_normals {
            true => (ArrayKind::ByteNormals, ComponentType::I8),
            false => (ArrayKind::Normals, ComponentType::F32),
        };
        let place = body.share(kind, BodyArray::Blob(bytes));
        let array = accessor(place, component, Type::Vec3, count);
        description.accessor(Accessor { normalized: format.byte_normals, ..array })
    };
    let tex_coords = part.is_textured.then(|| {
        let bytes =
            part.vertices.iter().flat_map(|vertex| vertex.tex_coord).flat_map(u32::to_le_bytes).collect();
        let place = body.share(ArrayKind::TexCoords, BodyArray::Blob(bytes));
        description.accessor(accessor(place, ComponentType::F32, Type::Vec2, count))
    });
    let second_tex_coords = (!part.second_tex_coords.is_empty()).then(|| {
        let bytes = part.second_tex_coords.iter().flatten().flat_map(|bits| bits.to_le_bytes()).collect();
        let place = body.share(ArrayKind::TexCoords, BodyArray::Blob(bytes));
        description.accessor(accessor(place, ComponentType::F32, Type::Vec2, count))
    });
    let features = key.table.map(|_| features(part, rows, description, body));
    let indices = {
        let short = count < LONG;
        let corners = part.triangles.iter().flatten();
        let (kind, component, bytes) = match short {
            true => {
                let bytes = corners.flat_map(|corner| (*corner as u16).to_le_bytes()).collect();
                (ArrayKind::Short, ComponentType::U16, bytes)
            }
            false => (
                ArrayKind::Long,
                ComponentType::U32,
                corners.flat_map(|corner| corner.to_le_bytes()).collect(),
            ),
        };
        let place = body.share(kind, BodyArray::Blob(bytes));
        description.accessor(accessor(place, component, Type::Scalar, part.triangles.len() * 3))
    };
    let none = rows as u32;
    let extensions = key.table.map(|table| {
        let has_others = part.vertices.iter().any(|vertex| vertex.feature == none);
        mesh_features(part.features(none), has_others.then_some(none), table)
    });
    Primitive {
        attributes: Attributes { positions, normals: Some(normals), tex_coords, second_tex_coords, features },
        extensions,
        shading: None,
        indices,
        material: None,
    }
}

/// Adds the positions of a primitive.
fn positions<'a>(
    part: &MergedPart,
    format: &VertexFormat,
    description: &mut Description<'a>,
    body: &mut Body<'a>,
) -> usize {
    let (count, places) = (part.vertices.len(), || part.vertices.iter().map(|vertex| vertex.place));
    let mut bytes = Vec::with_capacity(count * 12);
    places().for_each(|place| format.put_place(place, &mut bytes));
    let (kind, component, min, max) = match format.places {
        PlaceFormat::Short { .. } => {
            let least = |a: [u32; 3], b: [u32; 3]| std::array::from_fn(|axis| a[axis].min(b[axis]));
            let most = |a: [u32; 3], b: [u32; 3]| std::array::from_fn(|axis| a[axis].max(b[axis]));
            let (min, max) = (places().reduce(least), places().reduce(most));
            let whole = |corner: Option<[u32; 3]>| Extreme::Whole(corner.unwrap_or_default());
            (ArrayKind::ShortPositions, ComponentType::U16, whole(min), whole(max))
        }
        _ => {
            let points = || places().map(|place| glam::Vec3::from(place.map(f32::from_bits)));
            let (min, max) = (points().reduce(glam::Vec3::min), points().reduce(glam::Vec3::max));
            let point = |corner: Option<glam::Vec3>| Extreme::Point(corner.unwrap_or_default().to_array());
            (ArrayKind::Positions, ComponentType::F32, point(min), point(max))
        }
    };
    let place = body.share(kind, BodyArray::Blob(bytes));
    let array = accessor(place, component, Type::Vec3, count);
    description.accessor(Accessor { min: Some(min), max: Some(max), ..array })
}

/// Adds the feature numbers of a primitive, four bytes each: 16-bit integers with padding, or single-precision numbers if there
/// are more.
fn features<'a>(
    part: &MergedPart,
    rows: usize,
    description: &mut Description<'a>,
    body: &mut Body<'a>,
) -> usize {
    let numbers = part.vertices.iter().map(|vertex| vertex.feature);
    let (kind, component, bytes) = match rows <= usize::from(u16::MAX) {
        true => {
            let bytes = numbers.flat_map(u32::to_le_bytes).collect();
            (ArrayKind::Features, ComponentType::U16, bytes)
        }
        false => {
            let bytes = numbers.flat_map(|number| (number as f32).to_le_bytes()).collect();
            (ArrayKind::Features, ComponentType::F32, bytes)
        }
    };
    let place = body.share(kind, BodyArray::Blob(bytes));
    description.accessor(accessor(place, component, Type::Scalar, part.vertices.len()))
}
