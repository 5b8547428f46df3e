//! Drawing of shapes.

use std::sync::Arc;

use burgeon_base::Stop;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::{Color, Drawing};
use burgeon_scene::{Material, Normal, Part, SurfaceMeaning};
use burgeon_shapes::{FaceStyle, PolygonMesh, Scope, ShapeBody, SharedStyle};
use glam::{DAffine3, DMat3, DVec2, DVec3};

use super::object::ShapeObject;
use super::smooth_normals::SmoothNormals;

/// Number of faces between two checks for cancellation.
const STRETCH: usize = 4096;
/// Distance (m) from which shapes are not drawn.
const FARTHEST: f64 = 1e12;

/// Target of the faces of a shape.
pub(crate) struct ShapeTarget<'a> {
    pub drawing: &'a mut Drawing,
    /// Material of the faces without a material of their own.
    pub base: &'a Arc<Material>,
    /// Colour of the faces without a colour or a material of their own, if it differs from that of the material.
    pub color: Option<Color>,
}

/// Draws the faces of a shape like [`draw_shape`], with the meanings of surfaces of a building by their tags.
pub(crate) fn draw_building(
    to: ShapeTarget<'_>,
    transform: &DAffine3,
    shape: &ShapeObject,
) -> Result<Option<Warning>> {
    draw(to, transform, shape, |style| {
        let has = |pattern: &str| FaceStyle::has_tag(style, pattern);
        Some(if has("roof") {
            SurfaceMeaning::Roof
        } else if has("window") {
            SurfaceMeaning::Window
        } else if has("door") {
            SurfaceMeaning::Door
        } else if has("extrude.bottom") {
            SurfaceMeaning::Ground
        } else {
            SurfaceMeaning::Wall
        })
    })
}

/// Draws the faces of a shape at `transform`. Texture coordinates are metres in the plane of each face, x to the right seen
/// from outside and y upwards, unless a projection gives others.
///
/// Returns a warning if the shape draws nothing, or if a face lacks the set of texture coordinates that its dirt map uses.
pub(crate) fn draw_shape(
    to: ShapeTarget<'_>,
    transform: &DAffine3,
    shape: &ShapeObject,
) -> Result<Option<Warning>> {
    draw(to, transform, shape, |_| None)
}

/// Draws the faces of a shape with a meaning of each.
fn draw(
    to: ShapeTarget<'_>,
    transform: &DAffine3,
    shape: &ShapeObject,
    meaning: impl Fn(&SharedStyle) -> Option<SurfaceMeaning>,
) -> Result<Option<Warning>> {
    let shape = shape.shape();
    if matches!(shape.body, ShapeBody::Edge(..)) {
        let text = "an edge has no faces, so it draws nothing";
        let help = "sweep a section along it: an extruder at its position, with its length";
        return Ok(Some(Warning::new(WarningKind::DrawsNothing, text).help(help)));
    }
    let farthest = transform.transform_point3(shape.scope().center()).abs().max_element()
        + shape.scope().size.max_element();
    if farthest.is_nan() || farthest >= FARTHEST {
        return Err(Error::geometry(
            "the shape is more than 1e12 m away or large, beyond the range of coordinates",
        )
        .help("draw it near the origin: look for an offset or a size that grows"));
    }
    let mut parts = StyledParts { to, without_set: None };
    // Most shapes of a facade are rectangles and boxes, which need no mesh.
    let is_plain = |style: &SharedStyle| {
        parts.dirt_set(style).is_none()
            && style.as_deref().is_none_or(|style| !style.is_projected() && style.smooth.is_none())
    };
    if let Some(quads) = shape.body.quads(&shape.scope())
        && quads.clone().all(|(_, style)| is_plain(style))
    {
        for (corners, style) in quads {
            let corners = corners.map(|corner| transform.transform_point3(corner));
            draw_quad(parts.part(style, meaning(style)), corners)?;
        }
        return Ok(None);
    }
    let mesh = shape.mesh();
    let smooth = SmoothNormals::of(&mesh);
    for (number, face) in mesh.faces.iter().enumerate() {
        if number.is_multiple_of(STRETCH) {
            Stop::check_current()?;
        }
        let tile = parts.tile(&face.style);
        let dirt = parts.dirt_set(&face.style);
        let part = parts.part(&face.style, meaning(&face.style));
        let has_set = draw_face(part, (&mesh, number), transform, (tile, dirt.as_ref()), smooth.as_ref())?;
        if !has_set {
            parts.without_set = parts.without_set.or(dirt);
        }
    }
    if let Some((set, _)) = parts.without_set {
        let text = format!("a face has no set {set:?}, which the dirt map of its material uses");
        let help =
            format!("give its shape the set: shape:project(8, 4, {{ set = {set:?} }}), or omit dirt_set");
        return Ok(Some(Warning::new(WarningKind::NoEffect, text).help(help)));
    }
    Ok(None)
}

/// Parts of a drawing by the colours and materials of faces.
struct StyledParts<'a> {
    to: ShapeTarget<'a>,
    /// Set of the dirt map of a face that has no such set.
    without_set: Option<DirtSet>,
}

/// Name of the set of texture coordinates of a dirt map, and the size (m) of its image.
type DirtSet = (Arc<str>, DVec2);

impl StyledParts<'_> {
    /// Returns the part for a face with this style, and marks its surface with the meaning.
    fn part(&mut self, style: &SharedStyle, meaning: Option<SurfaceMeaning>) -> &mut Part {
        let ShapeTarget { drawing, base, color } = &mut self.to;
        let own = style.as_deref().and_then(|style| style.material.as_ref());
        let given = if own.is_none() { color.map(|color| color.0) } else { None };
        let color = style.as_deref().and_then(|style| style.color).or(given);
        let index = drawing.part_of(own.unwrap_or(base), color);
        match meaning {
            Some(meaning) => drawing.surface(index, meaning),
            None => drawing.part(index),
        }
    }

    /// Returns the size (m) of a repetition of the image on a face with this style.
    fn tile(&self, style: &SharedStyle) -> DVec2 {
        self.material(style).image_size().map_or(DVec2::ONE, DVec2::from)
    }

    /// Returns the set that the dirt map of a face with this style names.
    fn dirt_set(&self, style: &SharedStyle) -> Option<DirtSet> {
        let dirt = self.material(style).dirt_map.as_ref().filter(|dirt| !dirt.set.is_empty())?;
        Some((Arc::clone(&dirt.set), DVec2::from(dirt.image.size)))
    }

    /// Returns the material of a face with this style.
    fn material<'a>(&'a self, style: &'a SharedStyle) -> &'a Material {
        let own = style.as_deref().and_then(|style| style.material.as_deref());
        own.unwrap_or(self.to.base)
    }
}

/// Adds the two triangles of a rectangle.
fn draw_quad(part: &mut Part, corners: [DVec3; 4]) -> Result<()> {
    let [a, b, c, d] = corners;
    let normal = (c - a).cross(d - b).normalize_or_zero();
    if normal == DVec3::ZERO {
        return Ok(());
    }
    let axes = Scope::face_axes(normal, DMat3::IDENTITY);
    let base = first_vertex(part, 4)?;
    part.make_room(4, 0);
    part.positions.extend(corners.map(|at| at.as_vec3()));
    part.normals.extend([Normal::from(normal); 4]);
    part.uvs.extend(corners.map(|at| in_plane(at, &axes).as_vec2()));
    let [a, b, c, d] = corners.map(|at| at.as_vec3());
    if a != b && b != c && c != d && d != a && a != c {
        part.triangles.quad(base);
    } else {
        add_triangle(part, [base, base + 1, base + 2]);
        add_triangle(part, [base, base + 2, base + 3]);
    }
    Ok(())
}

/// Adds the triangles of a face, with the coordinates of the set that its dirt map names. Returns false if the face has no such
/// set.
fn draw_face(
    part: &mut Part,
    (mesh, number): (&PolygonMesh, usize),
    transform: &DAffine3,
    (tile, dirt): (DVec2, Option<&DirtSet>),
    smooth: Option<&SmoothNormals>,
) -> Result<bool> {
    let face = &mesh.faces[number];
    let own = mesh.normal(face);
    let normal = transform.transform_vector3(own).normalize_or_zero();
    if normal == DVec3::ZERO {
        return Ok(true);
    }
    let axes = Scope::face_axes(normal, DMat3::IDENTITY);
    let map = face.style.as_deref().and_then(|style| style.uv).filter(|map| map.shows(own));
    let count = face.rings.iter().map(Vec::len).sum();
    let base = first_vertex(part, count)?;
    let triangles = mesh.corner_triangles(face)?;
    part.make_room(count, triangles.len());
    if dirt.is_some() {
        part.fill_second_uvs();
    }
    let set = dirt.and_then(|(name, size)| Some((face.style.as_deref()?.set(name)?, *size)));
    let second = set.filter(|(map, _)| map.shows(own));
    for point in face.rings.iter().flatten() {
        let at = transform.transform_point3(mesh.at(*point));
        let turned = smooth.and_then(|smooth| smooth.at(mesh, number, *point));
        let turned = turned.map_or(normal, |turned| transform.transform_vector3(turned).normalize_or(normal));
        // Coordinates of a scene are metres on the image at its real size.
        let uv = map.map_or_else(|| in_plane(at, &axes), |map| map.at(mesh.at(*point)) * tile);
        add_vertex(part, at, turned, uv);
        if dirt.is_some() {
            let uv = second.map_or(uv, |(map, size)| map.at(mesh.at(*point)) * size);
            part.second_uvs.push(uv.as_vec2());
        }
    }
    for corners in triangles {
        add_triangle(part, corners.map(|corner| base + corner));
    }
    Ok(dirt.is_none() || set.is_some())
}

/// Returns the number of the next vertex; fails if a mesh cannot hold `count` more.
fn first_vertex(part: &Part, count: usize) -> Result<u32> {
    u32::try_from(part.positions.len() + count)
        .map(|end| end - u32::try_from(count).unwrap_or(end))
        .map_err(|_| Error::limit(Limit::Size, "a mesh has too many vertices"))
}

/// Returns the coordinates (m) of a position along the x and the y axis.
fn in_plane(at: DVec3, axes: &DMat3) -> DVec2 {
    DVec2::new(at.dot(axes.x_axis), at.dot(axes.y_axis))
}

/// Adds a vertex of a face at `at` (m).
fn add_vertex(part: &mut Part, at: DVec3, normal: DVec3, uv: DVec2) {
    part.positions.push(at.as_vec3());
    part.normals.push(normal.into());
    part.uvs.push(uv.as_vec2());
}

/// Adds a triangle, unless corners coincide at the precision of files.
fn add_triangle(part: &mut Part, [a, b, c]: [u32; 3]) {
    let at = |vertex: u32| part.positions[vertex as usize];
    if at(a) != at(b) && at(b) != at(c) && at(c) != at(a) {
        part.triangles.push([a, b, c]);
    }
}
