//! Meshes and the accessors of their arrays.

use super::super::check::{Checked, shown_parts, triangles};
use super::body::{Block, Body, Shared, y_up};
use super::name;
use crate::scene::Part;
use glam::Vec3;
use gltf_json as json;
use json::accessor::{ComponentType, GenericComponentType, Type};
use json::mesh::{Mode, Primitive, Semantic};
use json::validation::Checked::Valid;
use json::validation::USize64;
use std::collections::BTreeMap;

/// Adds the meshes that are shown. Returns where each mesh of the scene is.
///
/// Texture coordinates are left out where no texture needs them, unless `measured`: then they are metres.
pub(super) fn write<'a>(
    checked: &Checked<'a>,
    measured: bool,
    materials: &[Option<json::Index<json::Material>>],
    root: &mut json::Root,
    body: &mut Body<'a>,
) -> Vec<Option<json::Index<json::Mesh>>> {
    let scene = checked.scene;
    let mut written = Vec::with_capacity(scene.meshes.len());
    for (mesh, shown) in scene.meshes.iter().zip(&checked.meshes) {
        written.push(shown.then(|| {
            let primitives = shown_parts(mesh)
                .map(|part| {
                    let texture = scene.materials[part.material].texture.as_ref();
                    let size = texture.map(|texture| texture.size).or(measured.then_some([1.0, 1.0]));
                    primitive(part, size, materials[part.material], root, body)
                })
                .collect();
            root.push(json::Mesh {
                extensions: None,
                extras: None,
                name: name(&mesh.name),
                primitives,
                weights: None,
            })
        }));
    }
    written
}

fn primitive<'a>(
    part: &'a Part,
    texture: Option<[f64; 2]>,
    index: Option<json::Index<json::Material>>,
    root: &mut json::Root,
    body: &mut Body<'a>,
) -> Primitive {
    let count = part.positions.len();
    let mut attributes = BTreeMap::new();
    let (low, high) = bounds(&part.positions);
    let positions = json::Accessor {
        min: Some(numbers(low.to_array())),
        max: Some(numbers(high.to_array())),
        ..accessor(ComponentType::F32, Type::Vec3, count)
    };
    let positions = at(body.share(Shared::Positions, Block::Positions(part)), positions);
    attributes.insert(Valid(Semantic::Positions), root.push(positions));
    let normals = accessor(ComponentType::F32, Type::Vec3, count);
    let normals = at(body.share(Shared::Normals, Block::Normals(part)), normals);
    attributes.insert(Valid(Semantic::Normals), root.push(normals));
    if let Some(size) = texture {
        let place = body.share(Shared::TexCoords, Block::TexCoords(part, size));
        let tex_coords = at(place, accessor(ComponentType::F32, Type::Vec2, count));
        attributes.insert(Valid(Semantic::TexCoords(0)), root.push(tex_coords));
    }
    // The highest u16 means the end of a strip, so it cannot be the index of a point.
    let (kind, place) = if count <= usize::from(u16::MAX) {
        (ComponentType::U16, body.share(Shared::Short, Block::Short(part)))
    } else {
        (ComponentType::U32, body.share(Shared::Long, Block::Long(part)))
    };
    let indices = at(place, accessor(kind, Type::Scalar, triangles(part).count() * 3));
    Primitive {
        attributes,
        extensions: None,
        extras: None,
        indices: Some(root.push(indices)),
        material: index,
        mode: Valid(Mode::Triangles),
        targets: None,
    }
}

/// An accessor of `count` items that is nowhere yet.
pub(super) fn accessor(component: ComponentType, kind: Type, count: usize) -> json::Accessor {
    json::Accessor {
        buffer_view: None,
        byte_offset: None,
        count: count.into(),
        component_type: Valid(GenericComponentType(component)),
        extensions: None,
        extras: None,
        type_: Valid(kind),
        min: None,
        max: None,
        name: None,
        normalized: false,
        sparse: None,
    }
}

fn at((view, offset): (json::Index<json::buffer::View>, u64), accessor: json::Accessor) -> json::Accessor {
    json::Accessor {
        buffer_view: Some(view),
        byte_offset: (offset > 0).then_some(USize64(offset)),
        ..accessor
    }
}

/// The box around `positions` in glTF's coordinates.
fn bounds(positions: &[Vec3]) -> (Vec3, Vec3) {
    let first = positions.first().map_or(Vec3::ZERO, |at| y_up(*at));
    positions.iter().fold((first, first), |(low, high), at| (low.min(y_up(*at)), high.max(y_up(*at))))
}

/// The shortest decimals that read back as these f32.
fn numbers(vector: [f32; 3]) -> json::Value {
    vector.iter().map(|number| number.to_string().parse().unwrap_or(f64::from(*number))).collect()
}
