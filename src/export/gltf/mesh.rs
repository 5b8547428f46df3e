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
use std::fmt::Write;

/// Adds the meshes that are shown. Returns where each mesh of the scene is.
///
/// Texture coordinates are left out where no texture needs them, unless `arrays` says that they are metres there.
pub(super) fn write<'a>(
    checked: &Checked<'a>,
    arrays: Arrays,
    materials: &[Option<json::Index<json::Material>>],
    root: &mut json::Root,
    body: &mut Body<'a>,
) -> Vec<Option<json::Index<json::Mesh>>> {
    let scene = checked.scene;
    let mut written = Vec::with_capacity(scene.meshes.len());
    let parts: usize = scene.meshes.iter().map(|mesh| mesh.parts.len()).sum();
    root.accessors.reserve(3 * scene.meshes.len() + parts);
    for (mesh, shown) in scene.meshes.iter().zip(&checked.meshes) {
        written.push(shown.then(|| {
            let parts = shown_parts(mesh).map(|part| {
                let texture = scene.materials[part.material].texture.as_ref();
                Shown {
                    part,
                    texture: texture.map(|texture| texture.size).or(arrays.measured.then_some([1.0, 1.0])),
                }
            });
            let parts: Vec<Shown<'a>> = parts.collect();
            let vertices = Vertices::of(&parts, arrays, root, body);
            let primitives = parts.iter().zip(&vertices);
            let primitives = primitives
                .map(|(shown, vertices)| {
                    shown.primitive(vertices, materials[shown.part.material], root, body)
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

/// Which arrays are written, and how.
#[derive(Clone, Copy, Default)]
pub(super) struct Arrays {
    /// Whether surfaces without a texture have texture coordinates too, in metres.
    pub(super) measured: bool,
    /// Whether normals are integers, which `KHR_mesh_quantization` allows: a viewer waits for each byte.
    pub(super) small: bool,
}

/// A part, and the width and height (m) of its texture if it has texture coordinates.
struct Shown<'a> {
    part: &'a Part,
    texture: Option<[f64; 2]>,
}

/// Where the vertices of a part are.
#[derive(Clone, Copy)]
struct Vertices {
    positions: json::Index<json::Accessor>,
    normals: json::Index<json::Accessor>,
    tex_coords: Option<json::Index<json::Accessor>>,
    /// The number of the part's first vertex there.
    first: usize,
    /// How many vertices there are.
    count: usize,
}

/// The highest u16 means the end of a strip, so it cannot be the index of a point.
const SHORT: usize = u16::MAX as usize;

impl Vertices {
    /// Adds the vertices of the parts of a mesh. Small parts of a kind share their arrays: what describes an array
    /// takes as much as four vertices, and cities have many small parts.
    fn of<'a>(parts: &[Shown<'a>], arrays: Arrays, root: &mut json::Root, body: &mut Body<'a>) -> Vec<Self> {
        let mut found: Vec<Option<Self>> = vec![None; parts.len()];
        for textured in [false, true] {
            let alike: Vec<usize> =
                (0..parts.len()).filter(|index| parts[*index].texture.is_some() == textured).collect();
            let sum: usize = alike.iter().map(|index| parts[*index].part.positions.len()).sum();
            let groups: Vec<&[usize]> =
                if sum <= SHORT { vec![alike.as_slice()] } else { alike.chunks(1).collect() };
            for group in groups.into_iter().filter(|group| !group.is_empty()) {
                let members: Vec<&Shown<'a>> = group.iter().map(|index| &parts[*index]).collect();
                let mut vertices = Self::together(&members, arrays, root, body);
                for index in group {
                    found[*index] = Some(vertices);
                    vertices.first += parts[*index].part.positions.len();
                }
            }
        }
        found.into_iter().flatten().collect()
    }

    /// Adds the vertices of `parts`, one after another.
    fn together<'a>(
        parts: &[&Shown<'a>],
        arrays: Arrays,
        root: &mut json::Root,
        body: &mut Body<'a>,
    ) -> Self {
        let count = parts.iter().map(|shown| shown.part.positions.len()).sum();
        let (low, high) = bounds(parts.iter().flat_map(|shown| &shown.part.positions));
        let mut add = |shared: Shared,
                       (component, kind): (ComponentType, Type),
                       block: &dyn Fn(&Shown<'a>) -> Block<'a>| {
            let mut place = None;
            for shown in parts {
                let added = body.share(shared, block(shown));
                place.get_or_insert(added);
            }
            place.map(|place| at(place, accessor(component, kind, count)))
        };
        let vec3 = (ComponentType::F32, Type::Vec3);
        let positions = add(Shared::Positions, vec3, &|shown| Block::Positions(shown.part));
        let normals = match arrays.small {
            false => add(Shared::Normals, vec3, &|shown| Block::Normals(shown.part)),
            true if parts.iter().all(|shown| is_faceted(shown.part)) => {
                let kind = (ComponentType::I8, Type::Vec3);
                add(Shared::ByteNormals, kind, &|shown| Block::ByteNormals(shown.part))
            }
            true => {
                let kind = (ComponentType::I16, Type::Vec3);
                add(Shared::ShortNormals, kind, &|shown| Block::ShortNormals(shown.part))
            }
        };
        let normals = normals.map(|it| json::Accessor { normalized: arrays.small, ..it });
        let textured = parts.first().is_some_and(|shown| shown.texture.is_some());
        let tex_coords = textured.then(|| {
            add(Shared::TexCoords, (ComponentType::F32, Type::Vec2), &|shown| {
                Block::TexCoords(shown.part, shown.texture.unwrap_or([1.0, 1.0]))
            })
        });
        let nowhere = || accessor(ComponentType::F32, Type::Vec3, 0);
        let positions = json::Accessor {
            min: Some(numbers(low.to_array())),
            max: Some(numbers(high.to_array())),
            ..positions.unwrap_or_else(nowhere)
        };
        Self {
            positions: root.push(positions),
            normals: root.push(normals.unwrap_or_else(nowhere)),
            tex_coords: tex_coords.flatten().map(|accessor| root.push(accessor)),
            first: 0,
            count,
        }
    }
}

impl<'a> Shown<'a> {
    fn primitive(
        &self,
        vertices: &Vertices,
        index: Option<json::Index<json::Material>>,
        root: &mut json::Root,
        body: &mut Body<'a>,
    ) -> Primitive {
        let mut attributes = BTreeMap::new();
        attributes.insert(Valid(Semantic::Positions), vertices.positions);
        attributes.insert(Valid(Semantic::Normals), vertices.normals);
        if let Some(tex_coords) = vertices.tex_coords {
            attributes.insert(Valid(Semantic::TexCoords(0)), tex_coords);
        }
        let (kind, place) = if vertices.count <= SHORT {
            (ComponentType::U16, body.share(Shared::Short, Block::Short(self.part, vertices.first as u16)))
        } else {
            (ComponentType::U32, body.share(Shared::Long, Block::Long(self.part)))
        };
        let indices = at(place, accessor(kind, Type::Scalar, triangles(self.part).count() * 3));
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

/// Whether all triangles of `part` are flat. Rounding a normal turns the light on a face by less than can be seen, but
/// highlights wander over smooth surfaces.
fn is_faceted(part: &Part) -> bool {
    let normal = |corner: u32| part.normals[corner as usize];
    part.triangles.iter().all(|[a, b, c]| normal(*a) == normal(*b) && normal(*b) == normal(*c))
}

/// The box around `positions` in glTF's coordinates.
fn bounds<'a>(mut positions: impl Iterator<Item = &'a Vec3>) -> (Vec3, Vec3) {
    let first = positions.next().map_or(Vec3::ZERO, |at| y_up(*at));
    positions.fold((first, first), |(low, high), at| (low.min(y_up(*at)), high.max(y_up(*at))))
}

/// The shortest decimals that read back as these f32.
fn numbers(vector: [f32; 3]) -> json::Value {
    let mut text = String::with_capacity(32);
    let mut shortest = |number: f32| {
        text.clear();
        // Writing to a text does not fail.
        let _ = write!(text, "{number}");
        text.parse().unwrap_or(f64::from(number))
    };
    vector.map(&mut shortest).to_vec().into()
}
