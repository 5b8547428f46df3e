//! Meshes and the accessors of their arrays.

use super::super::check::{PartExtent, SceneCheck};
use super::attribute::{AttributeType, with_extremes};
use super::body::{ArrayKind, Body, BodyArray};
use super::coordinates::{TexCoordMap, y_up};
use super::corners::{self, CornerRange, FaceChoice, FaceCorners, PartFaces, flat_faces};
use super::description::{Accessor, Attributes, Description, MeshDescription, Primitive, ShadingExtras};
use super::metadata::{FeaturePlace, Metadata};
use super::quantize::{PositionGrid, TexCoordRanges, round_together};
use super::weld::FlatPart;
use crate::SceneFacts;
use burgeon_base::stop::Stop;
use burgeon_scene::Part;
use glam::Vec3;
use gltf_json as json;
use json::accessor::{ComponentType, Type};
use rayon::prelude::*;
use std::sync::Arc;

/// Indices of the meshes in a document, and the grids of their positions if these are integers, by the number of the mesh in
/// the scene.
pub(super) type WrittenMeshes = (Vec<Option<usize>>, Vec<Option<PositionGrid>>);

/// Adds the shown meshes. `costs` are the bytes that each instance of a mesh takes more if the positions are integers.
///
/// Texture coordinates are omitted if no texture needs them, unless `arrays` requests them in metres.
pub(super) fn write<'a>(
    checked: &SceneCheck<'a>,
    metadata: Option<&Metadata>,
    (arrays, ranges, costs): (Arrays, &TexCoordRanges, &[usize]),
    materials: &[Option<json::Index<json::Material>>],
    description: &mut Description<'a>,
    body: &mut Body<'a>,
    stop: &Stop,
) -> WrittenMeshes {
    let scene = checked.scene;
    let measure = |(part, measured): (&'a Part, &PartExtent)| {
        let image_size = scene.materials[part.material].image_size();
        let size = image_size.or(arrays.measured.then_some([1.0, 1.0]));
        let welded = (arrays.small && size.is_none()).then(|| FlatPart::of(part)).flatten().map(Arc::new);
        let [range, second_range] = ranges.of(part.material);
        let texture = size.map(|size| TexCoordMap { range, ..TexCoordMap::exact(size) });
        let dirt = scene.materials[part.material].dirt_map.as_ref();
        let second =
            dirt.map(|dirt| TexCoordMap { range: second_range, ..TexCoordMap::exact(dirt.image.size) });
        PartView { part, texture, second, measured: *measured, welded, which: None, corners: None }
    };
    let shown = scene.meshes.par_iter().zip(&checked.parts).map(|(mesh, parts)| {
        let is_shown = |(_, measured): &(&Part, &PartExtent)| measured.triangles > 0;
        match arrays.small {
            _ if stop.is_stopped() => Vec::new(),
            true => mesh.parts.par_iter().zip(parts).filter(is_shown).map(measure).collect(),
            false => {
                let mut shown: Vec<_> = mesh.parts.iter().zip(parts).filter(is_shown).map(measure).collect();
                if arrays.quantized {
                    round_together(shown.iter_mut().filter_map(|shown| shown.texture.as_mut()));
                    round_together(shown.iter_mut().filter_map(|shown| shown.second.as_mut()));
                }
                divide(shown)
            }
        }
    });
    let shown: Vec<Vec<PartView<'a>>> = shown.collect();
    let parts: usize = shown.iter().map(Vec::len).sum();
    description.accessors.reserve(2 * scene.meshes.len() + parts);
    description.meshes.reserve(scene.meshes.len());
    let mut written = Vec::with_capacity(scene.meshes.len());
    let mut grids = Vec::with_capacity(scene.meshes.len());
    for (number, (mesh, parts)) in scene.meshes.iter().zip(&shown).enumerate() {
        body.begin_mesh();
        let is_shorter = arrays.quantized && saved_bytes(parts) > costs.get(number).copied().unwrap_or(0);
        let grid = is_shorter.then(|| PositionGrid::of(&checked.parts[number]));
        grids.push(grid);
        written.push((!parts.is_empty()).then(|| {
            let mut vertices = Vertices::of(parts, (arrays, grid), description, body);
            let feature = metadata.and_then(|metadata| metadata.of_mesh(number));
            if let Some(feature) = feature {
                Vertices::note(&mut vertices, feature, description, body);
            }
            let primitives = parts.iter().zip(&vertices);
            let primitives = primitives
                .map(|(shown, vertices)| {
                    let material = materials[shown.part.material];
                    let primitive = shown.primitive(vertices, (arrays, material), description, body);
                    Primitive { extensions: feature.map(FeaturePlace::of_primitive), ..primitive }
                })
                .collect();
            description.meshes.push(MeshDescription { name: &mesh.name, primitives });
            description.meshes.len() - 1
        }));
    }
    (written, grids)
}

/// Returns the number of bytes by which the positions of parts of a mesh are shorter as integers.
fn saved_bytes(parts: &[PartView<'_>]) -> usize {
    let mut known: Vec<&Arc<FaceCorners<'_>>> = Vec::new();
    let vertices = parts.iter().map(|shown| match &shown.corners {
        Some((corners, _)) if known.iter().any(|known| Arc::ptr_eq(known, corners)) => 0,
        Some((corners, _)) => {
            known.push(corners);
            corners.range(false).count
        }
        None => shown.vertices(),
    });
    4 * vertices.sum::<usize>()
}

/// Selection and encoding of arrays.
#[derive(Clone, Copy, Default)]
pub(super) struct Arrays {
    /// Set if surfaces without a texture also have texture coordinates (m).
    pub(super) measured: bool,
    /// Set to minimise the size for a viewer: normals are integers, which `KHR_mesh_quantization` allows, and parts
    /// with flat triangles become [`FlatPart`] unless they have texture coordinates. Rotations of instances are not
    /// quantised.
    pub(super) small: bool,
    /// Set if positions, normals and texture coordinates are integers. Positions stay numbers if their integers would take
    /// more bytes, with the transforms of the instances.
    pub(super) quantized: bool,
    /// Set if indices are bytes where these suffice. They cannot be compressed.
    pub(super) short_indices: bool,
}

impl Arrays {
    /// Returns the arrays that the facts of an export select.
    pub(super) fn of(facts: &SceneFacts<'_>) -> Self {
        let quantized = facts.is_quantized;
        Self { quantized, short_indices: quantized && !facts.is_compressed, ..Self::default() }
    }
}

/// Part, with the map of its texture coordinates if it has any.
struct PartView<'a> {
    part: &'a Part,
    texture: Option<TexCoordMap>,
    /// Map of its second texture coordinates, if its material has a dirt map.
    second: Option<TexCoordMap>,
    measured: PartExtent,
    /// Welded part that is written instead.
    welded: Option<Arc<FlatPart>>,
    /// Selected faces of the part, if they are written by corners.
    which: Option<FaceChoice>,
    /// Corners of the part, and its index among the faces that share them.
    corners: Option<(Arc<FaceCorners<'a>>, usize)>,
}

/// Divides each mostly flat part into its flat faces and the others, if there are any.
fn divide(parts: Vec<PartView<'_>>) -> Vec<PartView<'_>> {
    let mut divided = Vec::with_capacity(parts.len());
    for shown in parts {
        let (part, all) = (shown.part, shown.measured.triangles);
        let flat = if part.positions.len() <= corners::MOST { flat_faces(part) } else { 0 };
        // Corners have one set of texture coordinates.
        if 2 * flat < all || shown.second.is_some() {
            divided.push(shown);
            continue;
        }
        let some = |which: FaceChoice, triangles: usize| {
            let measured = PartExtent { triangles, ..shown.measured };
            PartView {
                part,
                texture: shown.texture,
                second: None,
                measured,
                welded: None,
                which: Some(which),
                corners: None,
            }
        };
        divided.push(some(if flat == all { FaceChoice::All } else { FaceChoice::Flat }, flat));
        if flat < all {
            divided.push(some(FaceChoice::Shaded, all - flat));
        }
    }
    for shaded in [false, true] {
        let alike = |shown: &&mut PartView<'_>| {
            shown.which.is_some_and(|which| (which == FaceChoice::Shaded) == shaded)
        };
        share_corners(divided.iter_mut().filter(alike).collect());
    }
    divided
}

/// Lets parts of a mesh share their corners, or gives each part separate corners if they are too many for short
/// indices.
fn share_corners(mut parts: Vec<&mut PartView<'_>>) {
    if parts.is_empty() {
        return;
    }
    parts.sort_by_key(|shown| shown.texture.is_none());
    let vertices: usize = parts.iter().map(|shown| shown.part.positions.len()).sum();
    let faces = parts.iter().filter_map(|shown| shown.faces()).collect();
    let together = (vertices <= corners::MOST).then(|| FaceCorners::of(faces, SHORT)).flatten();
    match together.map(Arc::new) {
        Some(together) => {
            for (number, shown) in parts.into_iter().enumerate() {
                shown.corners = Some((Arc::clone(&together), number));
            }
        }
        None => {
            let mut kept = 0;
            for shown in parts {
                let corners = shown.faces().and_then(|faces| FaceCorners::of(vec![faces], usize::MAX));
                // Corners beyond these are computed again when they are written.
                kept += shown.part.positions.len();
                if let Some(corners) = corners.as_ref().filter(|_| kept > corners::MOST) {
                    corners.release();
                }
                shown.corners = corners.map(|corners| (Arc::new(corners), 0));
            }
        }
    }
}

/// Location of the vertices of a part.
#[derive(Clone, Copy)]
struct Vertices {
    accessors: Attributes,
    /// Number of the part's first vertex in the accessors.
    first: usize,
    /// Number of vertices.
    count: usize,
}

/// Maximum number of vertices for u16 indices. The highest u16 marks the end of a strip, so it cannot be an index.
const SHORT: usize = u16::MAX as usize;

impl Vertices {
    /// Adds the vertices of the parts of a mesh. Small parts of the same type share their arrays, because describing an
    /// array takes as many bytes as four vertices, and cities have many small parts.
    fn of<'a>(
        parts: &[PartView<'a>],
        (arrays, grid): (Arrays, Option<PositionGrid>),
        description: &mut Description<'a>,
        body: &mut Body<'a>,
    ) -> Vec<Self> {
        let mut found: Vec<Option<Self>> = vec![None; parts.len()];
        let mut known: Vec<(&Arc<FaceCorners<'a>>, [Option<Self>; 2])> = Vec::new();
        for (shown, found) in parts.iter().zip(&mut found) {
            let Some((corners, _)) = &shown.corners else { continue };
            let place = known.iter().position(|(known, _)| Arc::ptr_eq(known, corners));
            let place = place.unwrap_or_else(|| {
                known.push((corners, Self::at_corners(corners, (arrays, grid), description, body)));
                known.len() - 1
            });
            *found = known[place].1[usize::from(shown.texture.is_some())];
        }
        const KINDS: [[bool; 3]; 4] =
            [[false, false, false], [false, true, false], [true, false, false], [true, false, true]];
        for kind in KINDS {
            let is_alike = |shown: &PartView<'_>| {
                let own = [shown.texture.is_some(), shown.welded.is_some(), shown.second.is_some()];
                shown.corners.is_none() && own == kind
            };
            let alike: Vec<usize> = (0..parts.len()).filter(|index| is_alike(&parts[*index])).collect();
            let sum: usize = alike.iter().map(|index| parts[*index].vertices()).sum();
            let groups: Vec<&[usize]> =
                if sum <= SHORT { vec![alike.as_slice()] } else { alike.chunks(1).collect() };
            for group in groups.into_iter().filter(|group| !group.is_empty()) {
                let members: Vec<&PartView<'a>> = group.iter().map(|index| &parts[*index]).collect();
                let mut vertices = Self::join(&members, (arrays, grid), description, body);
                for index in group {
                    found[*index] = Some(vertices);
                    vertices.first += parts[*index].vertices();
                }
            }
        }
        found.into_iter().flatten().collect()
    }

    /// Assigns all vertices of a mesh to one feature.
    fn note(all: &mut [Self], feature: FeaturePlace, description: &mut Description<'_>, body: &mut Body<'_>) {
        let mut known: Vec<(usize, usize)> = Vec::new();
        for vertices in all {
            let positions = vertices.accessors.positions;
            let array = known.iter().find(|(known, _)| *known == positions).map(|(_, array)| *array);
            vertices.accessors.features = Some(array.unwrap_or_else(|| {
                let block = BodyArray::Same(feature.row as f32, vertices.count);
                let place = body.share(ArrayKind::Features, block);
                let array = accessor(place, ComponentType::F32, Type::Scalar, vertices.count);
                let array = description.accessor(array);
                known.push((positions, array));
                array
            }));
        }
    }

    /// Adds corners for parts without and with texture coordinates, if there are such parts. Parts without texture
    /// coordinates also refer to the corners of the others.
    fn at_corners<'a>(
        corners: &Arc<FaceCorners<'a>>,
        (arrays, grid): (Arrays, Option<PositionGrid>),
        description: &mut Description<'a>,
        body: &mut Body<'a>,
    ) -> [Option<Self>; 2] {
        body.show(corners);
        let (at, normal, tex_coord) =
            AttributeType::all(arrays.quantized, grid, corners.are_tex_coords_rounded());
        let places = at.share(BodyArray::CornerPlaces(Arc::clone(corners)), body);
        let normals =
            corners.are_shaded().then(|| normal.share(BodyArray::CornerNormals(Arc::clone(corners)), body));
        [false, true].map(|textured| {
            let CornerRange { count, low, high } = corners.range(textured);
            corners.has_parts(textured).then(|| {
                let positions = with_extremes(at.accessor(places, count), (low, high), grid);
                let positions = description.accessor(positions);
                let normals = normals.map(|place| description.accessor(normal.accessor(place, count)));
                let tex_coords = textured.then(|| {
                    let place = tex_coord.share(BodyArray::CornerTexCoords(Arc::clone(corners)), body);
                    description.accessor(tex_coord.accessor(place, count))
                });
                let accessors =
                    Attributes { positions, normals, tex_coords, second_tex_coords: None, features: None };
                Self { accessors, first: 0, count }
            })
        })
    }

    /// Adds the vertices of `parts`, one after another.
    fn join<'a>(
        parts: &[&PartView<'a>],
        (arrays, grid): (Arrays, Option<PositionGrid>),
        description: &mut Description<'a>,
        body: &mut Body<'a>,
    ) -> Self {
        let count = parts.iter().map(|shown| shown.vertices()).sum();
        let low = parts.iter().fold(Vec3::INFINITY, |low, shown| low.min(shown.measured.low));
        let high = parts.iter().fold(Vec3::NEG_INFINITY, |high, shown| high.max(shown.measured.high));
        // The scene's z axis is glTF's y axis and its y axis is -z, so the corners of the box are sorted again.
        let (a, b) = (y_up(low), y_up(high));
        let (low, high) = (a.min(b), a.max(b));
        let mut add = |stored: AttributeType, block: &dyn Fn(&PartView<'a>) -> BodyArray<'a>| {
            let mut place = None;
            for shown in parts {
                let added = stored.share(block(shown), body);
                place.get_or_insert(added);
            }
            stored.accessor(place.unwrap_or_default(), count)
        };
        let are_rounded = parts.iter().filter_map(|shown| shown.texture).all(|map| map.is_rounded);
        let (at, normal, tex_coord) = AttributeType::all(arrays.quantized, grid, are_rounded);
        let positions = add(at, &|shown| match &shown.welded {
            Some(welded) => BodyArray::Places(Arc::clone(welded)),
            None => BodyArray::Positions(shown.part),
        });
        let normals = match arrays.small {
            false => add(normal, &|shown| BodyArray::Normals(shown.part)),
            true if parts.iter().all(|shown| shown.welded.is_some() || is_faceted(shown.part)) => {
                add(AttributeType::BYTE_NORMALS, &|shown| match &shown.welded {
                    Some(welded) => BodyArray::FaceNormals(Arc::clone(welded)),
                    None => BodyArray::ByteNormals(shown.part),
                })
            }
            true => add(AttributeType::SHORT_NORMALS, &|shown| BodyArray::ShortNormals(shown.part)),
        };
        let textured = parts.first().is_some_and(|shown| shown.texture.is_some());
        let tex_coords = textured.then(|| {
            add(tex_coord, &|shown| {
                BodyArray::TexCoords(shown.part, shown.texture.unwrap_or(TexCoordMap::exact([1.0, 1.0])))
            })
        });
        let are_rounded = parts.iter().filter_map(|shown| shown.second).all(|map| map.is_rounded);
        let (.., second) = AttributeType::all(arrays.quantized, grid, are_rounded);
        let has_second = parts.first().is_some_and(|shown| shown.second.is_some());
        let second = has_second.then(|| {
            add(second, &|shown| {
                let map = shown.second.unwrap_or(TexCoordMap::exact([1.0, 1.0]));
                BodyArray::SecondTexCoords(shown.part, map)
            })
        });
        let positions = with_extremes(positions, (low, high), grid);
        let accessors = Attributes {
            positions: description.accessor(positions),
            normals: Some(description.accessor(normals)),
            tex_coords: tex_coords.map(|accessor| description.accessor(accessor)),
            second_tex_coords: second.map(|accessor| description.accessor(accessor)),
            features: None,
        };
        Self { accessors, first: 0, count }
    }
}

impl<'a> PartView<'a> {
    /// Returns the number of vertices to write.
    fn vertices(&self) -> usize {
        self.welded.as_ref().map_or(self.part.positions.len(), |welded| welded.positions.len())
    }

    /// Returns the faces that are written by corners, if any.
    fn faces(&self) -> Option<PartFaces<'a>> {
        self.which.map(|which| PartFaces { part: self.part, texture: self.texture, which })
    }

    fn primitive(
        &self,
        vertices: &Vertices,
        (arrays, material): (Arrays, Option<json::Index<json::Material>>),
        description: &mut Description<'a>,
        body: &mut Body<'a>,
    ) -> Primitive {
        let (first, triangles) = (vertices.first as u16, self.measured.triangles);
        let short = vertices.count <= SHORT;
        let (shared, kind) = if short {
            (ArrayKind::Short, ComponentType::U16)
        } else {
            (ArrayKind::Long, ComponentType::U32)
        };
        let block = match (self.welded.clone(), self.corners.clone()) {
            (_, Some((corners, part))) if short => BodyArray::ShortFaces(corners, part, triangles),
            (_, Some((corners, part))) => BodyArray::LongFaces(corners, part, triangles),
            (Some(welded), _) if short => BodyArray::ShortCorners(welded, first),
            (Some(welded), _) => BodyArray::LongCorners(welded),
            (None, _) if short => BodyArray::Short(self.part, triangles, first),
            (None, _) => BodyArray::Long(self.part, triangles),
        };
        // The highest u8 would mark the end of a strip, too.
        let (shared, kind, block) = match arrays.short_indices && vertices.count <= usize::from(u8::MAX) {
            true => (ArrayKind::Byte, ComponentType::U8, BodyArray::ByteIndices(Box::new(block))),
            false => (shared, kind, block),
        };
        let indices = accessor(body.share(shared, block), kind, Type::Scalar, triangles * 3);
        let shading = self.welded.is_some().then_some(ShadingExtras { flat: true });
        Primitive {
            attributes: vertices.accessors,
            extensions: None,
            shading,
            indices: description.accessor(indices),
            material,
        }
    }
}

/// Returns an accessor of `count` items at an offset (bytes) in a view.
pub(super) fn accessor(
    (buffer_view, byte_offset): (u32, u64),
    component_type: ComponentType,
    kind: Type,
    count: usize,
) -> Accessor {
    Accessor {
        buffer_view,
        byte_offset,
        count,
        component_type,
        kind,
        normalized: false,
        min: None,
        max: None,
    }
}

/// Returns true if all triangles of `part` are flat. Rounding a normal changes the light on a flat face invisibly, but
/// makes highlights move on smooth surfaces.
fn is_faceted(part: &Part) -> bool {
    let normal = |corner: u32| part.normals[corner as usize];
    part.triangles.iter().all(|[a, b, c]| normal(a) == normal(b) && normal(b) == normal(c))
}
