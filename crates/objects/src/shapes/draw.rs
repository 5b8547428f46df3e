//! Drawing of shapes.

use std::sync::Arc;

use burgeon_base::Stop;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::Drawing;
use burgeon_scene::{Material, Part, SurfaceMeaning};
use burgeon_shapes::{FaceStyle, PolygonMesh, Scope, ShapeBody, SharedStyle};
use glam::{DAffine3, DVec2, DVec3};

use super::object::ShapeObject;
use super::smooth_normals::SmoothNormals;

/// Number of faces between two checks for cancellation.
const STRETCH: usize = 4096;

/// Draws the faces of a shape like [`draw_shape`], with the meanings of surfaces of a building by their tags.
pub(crate) fn draw_building(
    to: (&mut Drawing, &Material),
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

/// Draws the faces of a shape at `transform`, in their colours or with the material `base`. Texture coordinates are
/// metres in the plane of each face, x to the right seen from outside and y upwards, unless a projection gives others.
///
/// Returns a warning if the shape draws nothing.
pub(crate) fn draw_shape(
    to: (&mut Drawing, &Material),
    transform: &DAffine3,
    shape: &ShapeObject,
) -> Result<Option<Warning>> {
    draw(to, transform, shape, |_| None)
}

/// Draws the faces of a shape with a meaning of each.
fn draw(
    (drawing, base): (&mut Drawing, &Material),
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
    let mesh = shape.mesh();
    let plain = drawing.material(base);
    let smooth = SmoothNormals::of(&mesh);
    let own_look = |style: &SharedStyle| {
        style
            .as_deref()
            .map(|style| (style.color, style.material.as_ref().map(Arc::as_ptr)))
            .unwrap_or_default()
    };
    // Faces of the same look often follow each other.
    let mut last = ((None, None), plain);
    for (number, face) in mesh.faces.iter().enumerate() {
        if number.is_multiple_of(STRETCH) {
            Stop::check_current()?;
        }
        let look = own_look(&face.style);
        let own = face.style.as_deref().and_then(|style| style.material.as_deref());
        if look != last.0 {
            let material = match (look.0, own) {
                (Some(color), own) => {
                    drawing.material(&Material { base_color: color, ..own.unwrap_or(base).clone() })
                }
                (None, Some(own)) => drawing.material(own),
                (None, None) => plain,
            };
            last = (look, material);
        }
        let tile = own.unwrap_or(base).texture.as_ref().map_or(DVec2::ONE, |texture| texture.size.into());
        let part = match meaning(&face.style) {
            Some(meaning) => drawing.surface(last.1, meaning),
            None => drawing.part(last.1),
        };
        draw_face(part, (&mesh, number), transform, tile, smooth.as_ref())?;
    }
    Ok(None)
}

/// Adds the triangles of a face.
fn draw_face(
    part: &mut Part,
    (mesh, number): (&PolygonMesh, usize),
    transform: &DAffine3,
    tile: DVec2,
    smooth: Option<&SmoothNormals>,
) -> Result<()> {
    let face = &mesh.faces[number];
    let own = mesh.normal(face);
    let normal = transform.transform_vector3(own).normalize_or_zero();
    if normal == DVec3::ZERO {
        return Ok(());
    }
    let axes = Scope::face_axes(normal, glam::DMat3::IDENTITY);
    let map = face.style.as_deref().and_then(|style| style.uv).filter(|map| map.shows(own));
    let points: Vec<u32> = face.rings.iter().flatten().copied().collect();
    let base = u32::try_from(part.positions.len() + points.len())
        .map_err(|_| Error::limit(Limit::Size, "a mesh has too many vertices"))?
        - u32::try_from(points.len()).unwrap_or(0);
    let triangles = mesh.triangles(face)?;
    part.make_room(points.len(), triangles.len());
    for point in &points {
        let at = transform.transform_point3(mesh.at(*point));
        part.positions.push(at.as_vec3());
        let turned = smooth.and_then(|smooth| smooth.at(mesh, number, *point));
        let turned = turned.map_or(normal, |turned| transform.transform_vector3(turned).normalize_or(normal));
        part.normals.push(turned.into());
        // Coordinates of a scene are metres on the image at its real size.
        let uv = match map {
            Some(map) => map.at(mesh.at(*point)) * tile,
            None => DVec2::new(at.dot(axes.x_axis), at.dot(axes.y_axis)),
        };
        part.uvs.push(uv.as_vec2());
    }
    // A face of one ring has each point once, so its first place is the only one.
    let place = |point: u32| points.iter().position(|known| *known == point).unwrap_or(0);
    for corners in triangles {
        #[allow(clippy::cast_possible_truncation, reason = "the sum fits, as checked above")]
        let [a, b, c] = corners.map(|corner| base + place(corner) as u32);
        let at = |vertex: u32| part.positions[vertex as usize];
        // Points that coincide at the precision of files leave no triangle.
        if at(a) != at(b) && at(b) != at(c) && at(c) != at(a) {
            part.triangles.push([a, b, c]);
        }
    }
    Ok(())
}
