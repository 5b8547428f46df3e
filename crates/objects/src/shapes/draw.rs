//! Drawing of shapes.

use burgeon_base::Stop;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::{Color, Drawing};
use burgeon_scene::{Material, Part, SurfaceMeaning};
use burgeon_shapes::{FaceStyle, PolygonFace, PolygonMesh, Scope, ShapeBody, SharedStyle};
use glam::{DAffine3, DMat3, DVec3};

use super::object::ShapeObject;

/// Number of faces between two checks for cancellation.
const STRETCH: usize = 4096;

/// Target of the faces of a shape.
pub(crate) struct ShapeTarget<'a> {
    pub drawing: &'a mut Drawing,
    /// Material of the faces.
    pub base: &'a Material,
    /// Colour of faces without a colour of their own, if it differs from that of the material.
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

/// Draws the faces of a shape at `transform`. Texture coordinates are
/// metres in the plane of each face, x to the right seen from outside and y upwards.
///
/// Returns a warning if the shape draws nothing.
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
    let mut parts = ColoredParts { to, last: None };
    // Most shapes of a facade are rectangles and boxes, which need no mesh.
    if let Some(quads) = shape.body.quads(&shape.scope) {
        for (corners, style) in quads {
            draw_quad(
                parts.part(style, meaning(style)),
                corners.map(|corner| transform.transform_point3(corner)),
            )?;
        }
        return Ok(None);
    }
    let mesh = shape.mesh();
    for (number, face) in mesh.faces.iter().enumerate() {
        if number.is_multiple_of(STRETCH) {
            Stop::check_current()?;
        }
        draw_face(parts.part(&face.style, meaning(&face.style)), &mesh, face, transform)?;
    }
    Ok(None)
}

/// Parts of a drawing by the colours of faces.
struct ColoredParts<'a> {
    to: ShapeTarget<'a>,
    /// Colour of the last face, and the index of its part.
    last: Option<(Option<[f32; 4]>, usize)>,
}

impl ColoredParts<'_> {
    /// Returns the part for a face with this style, and marks its surface with the meaning.
    fn part(&mut self, style: &SharedStyle, meaning: Option<SurfaceMeaning>) -> &mut Part {
        let color = style.as_deref().and_then(|style| style.color).or(self.to.color.map(|color| color.0));
        let ShapeTarget { drawing, base, .. } = &mut self.to;
        let index = match self.last {
            Some((last, index)) if last == color => index,
            _ => match color {
                Some(color) => drawing.material(&Material { base_color: color, ..base.clone() }),
                None => drawing.material(base),
            },
        };
        self.last = Some((color, index));
        match meaning {
            Some(meaning) => drawing.surface(index, meaning),
            None => drawing.part(index),
        }
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
    part.make_room(4, 2);
    for at in corners {
        add_vertex(part, at, normal, &axes);
    }
    add_triangle(part, [base, base + 1, base + 2]);
    add_triangle(part, [base, base + 2, base + 3]);
    Ok(())
}

/// Returns the number of the next vertex; fails if a mesh cannot hold `count` more.
fn first_vertex(part: &Part, count: usize) -> Result<u32> {
    u32::try_from(part.positions.len() + count)
        .map(|end| end - u32::try_from(count).unwrap_or(end))
        .map_err(|_| Error::limit(Limit::Size, "a mesh has too many vertices"))
}

/// Adds a vertex of a face at `at` (m).
fn add_vertex(part: &mut Part, at: DVec3, normal: DVec3, axes: &DMat3) {
    part.positions.push(at.as_vec3());
    part.normals.push(normal.into());
    part.uvs.push(glam::DVec2::new(at.dot(axes.x_axis), at.dot(axes.y_axis)).as_vec2());
}

/// Adds a triangle, unless corners coincide at the precision of files.
fn add_triangle(part: &mut Part, [a, b, c]: [u32; 3]) {
    let at = |vertex: u32| part.positions[vertex as usize];
    if at(a) != at(b) && at(b) != at(c) && at(c) != at(a) {
        part.triangles.push([a, b, c]);
    }
}

/// Adds the triangles of a face.
fn draw_face(part: &mut Part, mesh: &PolygonMesh, face: &PolygonFace, transform: &DAffine3) -> Result<()> {
    let normal = transform.transform_vector3(mesh.normal(face)).normalize_or_zero();
    if normal == DVec3::ZERO {
        return Ok(());
    }
    let axes = Scope::face_axes(normal, DMat3::IDENTITY);
    let count = face.rings.iter().map(Vec::len).sum();
    let base = first_vertex(part, count)?;
    let triangles = mesh.corner_triangles(face)?;
    part.make_room(count, triangles.len());
    for point in face.rings.iter().flatten() {
        add_vertex(part, transform.transform_point3(mesh.at(*point)), normal, &axes);
    }
    for corners in triangles {
        add_triangle(part, corners.map(|corner| base + corner));
    }
    Ok(())
}
