//! Meshes that a script specifies as points and faces, in lists or in buffers, drawn in a frame.

use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::{MemoryOwner, Stop};
use burgeon_geometry::{CornerShading, shaded_face};
use burgeon_kit::{BufferBytes, Color, Drawing, Expectation, Field, Parameter, Table, Value, Vector, fields};
use burgeon_scene::{Material, Part};
use glam::{DAffine3, DVec2, DVec3};
use std::borrow::Cow;

/// Number of faces drawn between two checks for cancellation of the run.
const STRETCH: usize = 1024;
/// Maximum number of different colours in one call.
const MOST_COLORS: usize = 256;

/// Points or directions: a list of vectors, or a buffer of three 32-bit floats per vector.
#[derive(Debug, Clone, Default)]
pub struct MeshPoints(Vec<DVec3>);

/// Texture coordinates (m): a list of { u, v }, or a buffer of two 32-bit floats per point.
#[derive(Debug, Clone, Default)]
pub struct MeshPlaces(Vec<DVec2>);

/// Colours: a list, or a buffer of four bytes per colour.
#[derive(Debug, Clone, Default)]
pub struct MeshColors(Vec<Color>);

/// Faces: a list of lists of point numbers, from 1, or a buffer of three 32-bit integers per triangle, from 0.
#[derive(Debug, Clone, Default)]
pub struct MeshFaces {
    corners: Vec<u32>,
    /// End of each face's range in `corners`.
    ends: Vec<usize>,
    /// Number of the first point: 1 in lists, as is usual in Lua, and 0 in buffers, as is usual in mesh formats.
    first: u32,
}

/// Options of `mesh`, in addition to points and faces.
#[fields("mesh")]
pub struct MeshOptions {
    /// Normal of each point, as vectors or in a buffer like that of the points. If omitted, faces are flat.
    pub normals: Option<MeshPoints>,
    /// Texture coordinates (m) of each point, as { u, v }, or in a buffer of two 32-bit numbers per point.
    pub uvs: Option<MeshPlaces>,
    /// Colour of each face, or a buffer of four bytes per face: red, green, blue and opacity. At most 256 different
    /// colours.
    pub colors: Option<MeshColors>,
}

impl Parameter for MeshPoints {
    fn luau() -> String {
        "{ Vector } | buffer".into()
    }

    fn from_value(value: Value) -> std::result::Result<Self, Expectation> {
        if let Some(bytes) = BufferBytes::of(&value) {
            let read = BufferBytes::numbers::<3>(bytes, "point")?;
            return Ok(Self(read.into_iter().map(|at| DVec3::from_array(at.map(f64::from))).collect()));
        }
        Ok(Self(Vec::<Vector>::from_value(value)?.into_iter().map(|vector| vector.0).collect()))
    }

    fn into_value(self) -> Value {
        self.0.into_iter().map(Vector).collect::<Vec<_>>().into_value()
    }
}

impl Parameter for MeshPlaces {
    fn luau() -> String {
        "{ { number } } | buffer".into()
    }

    fn from_value(value: Value) -> std::result::Result<Self, Expectation> {
        if let Some(bytes) = BufferBytes::of(&value) {
            let read = BufferBytes::numbers::<2>(bytes, "point")?;
            return Ok(Self(read.into_iter().map(|at| DVec2::from_array(at.map(f64::from))).collect()));
        }
        Ok(Self(Vec::<Vector>::from_value(value)?.into_iter().map(|vector| vector.0.truncate()).collect()))
    }

    fn into_value(self) -> Value {
        self.0.into_iter().map(|at| at.to_array().to_vec()).collect::<Vec<_>>().into_value()
    }
}

impl Parameter for MeshColors {
    fn luau() -> String {
        "{ Color } | buffer".into()
    }

    fn from_value(value: Value) -> std::result::Result<Self, Expectation> {
        let Some(bytes) = BufferBytes::of(&value) else { return Ok(Self(Vec::from_value(value)?)) };
        let (found, rest) = bytes.as_chunks::<4>();
        if rest.is_empty() {
            return Ok(Self(found.iter().copied().map(Color::of_bytes).collect()));
        }
        Err(Expectation::new("a buffer of 4 bytes for each face")
            .but_was(format!("one of {} bytes", bytes.len())))
    }

    fn into_value(self) -> Value {
        self.0.into_value()
    }
}

impl Parameter for MeshFaces {
    fn luau() -> String {
        "{ { number } } | buffer".into()
    }

    fn from_value(value: Value) -> std::result::Result<Self, Expectation> {
        if let Some(bytes) = BufferBytes::of(&value) {
            let corners = BufferBytes::indices::<3>(bytes, "triangle")?.into_flattened();
            return Ok(Self { corners, ends: Vec::new(), first: 0 });
        }
        let mut faces = Self { first: 1, ..Self::default() };
        for face in Vec::<Vec<u32>>::from_value(value)? {
            faces.corners.extend(face);
            faces.ends.push(faces.corners.len());
        }
        Ok(faces)
    }

    fn into_value(self) -> Value {
        self.iter().map(<[u32]>::to_vec).collect::<Vec<_>>().into_value()
    }
}

impl MeshFaces {
    /// Returns the number of faces.
    fn len(&self) -> usize {
        if self.first == 0 { self.corners.len() / 3 } else { self.ends.len() }
    }

    /// Returns the point numbers of each face, as the script gave them.
    fn iter(&self) -> impl Iterator<Item = &[u32]> {
        let triangles = if self.first == 0 { self.corners.chunks_exact(3) } else { [].chunks_exact(3) };
        let begins = std::iter::once(0).chain(self.ends.iter().copied());
        triangles.chain(begins.zip(&self.ends).map(|(begin, end)| &self.corners[begin..*end]))
    }
}

impl Parameter for MeshOptions {
    fn luau() -> String {
        "{ [string]: any }".into()
    }

    fn fields() -> Vec<Field> {
        Self::fields()
    }

    fn from_value(value: Value) -> std::result::Result<Self, Expectation> {
        match value {
            Value::Table(table) => Self::from_table(&table).map_err(|error| {
                Expectation::new(format!("a table of normals, uvs and colors ({})", error.message()))
            }),
            _ => Err(Expectation::new("a table of normals, uvs and colors")),
        }
    }

    fn into_value(self) -> Value {
        Value::Table(std::sync::Arc::new(Table::default()))
    }
}

/// Draws `faces`, each a list of the numbers of its corners among `points` (m), counter-clockwise seen from outside.
///
/// `transform` converts the points to coordinates of the drawing. `kind` is the type name for error messages, and
/// `base` the material. Fails before drawing if a face has fewer than three corners or refers to a point that does not
/// exist. Faces without area are skipped.
pub(crate) fn draw_mesh(
    (kind, drawing, base): (&str, &mut Drawing, &Material),
    transform: &DAffine3,
    points: &MeshPoints,
    faces: &MeshFaces,
    options: &MeshOptions,
) -> Result<()> {
    MemoryOwner::ensure_room(points.0.len() * size_of::<DVec3>())?;
    let placed: Vec<DVec3> = points.0.iter().map(|point| transform.transform_point3(*point)).collect();
    let turned = |normal: &DVec3| transform.transform_vector3(*normal);
    let normals: Option<Vec<DVec3>> =
        options.normals.as_ref().map(|normals| normals.0.iter().map(turned).collect());
    let shading =
        CornerShading { normals: normals.as_deref(), uvs: options.uvs.as_ref().map(|uvs| uvs.0.as_slice()) };
    for (name, count, wanted, each) in [
        ("normals", shading.normals.map(<[_]>::len), placed.len(), "point"),
        ("uvs", shading.uvs.map(<[_]>::len), placed.len(), "point"),
        ("colors", options.colors.as_ref().map(|colors| colors.0.len()), faces.len(), "face"),
    ] {
        if let Some(count) = count.filter(|count| *count != wanted) {
            return Err(Error::argument(format!(
                "{kind}:mesh: {count} {name} do not match {wanted} {each}s"
            ))
            .help(format!("give one for each {each}, or omit {name}")));
        }
    }
    check(kind, placed.len(), faces)?;
    let parts = parts(kind, drawing, base, options.colors.as_ref())?;
    let mut corners: Vec<usize> = Vec::new();
    for (number, face) in faces.iter().enumerate() {
        if number.is_multiple_of(STRETCH) {
            Stop::check_current()?;
        }
        corners.clear();
        corners.extend(face.iter().map(|corner| (corner - faces.first) as usize));
        let part = drawing.part(parts[if options.colors.is_some() { number } else { 0 }]);
        match corners[..] {
            // Buffers hold triangles of imported meshes, some of which have no area.
            [a, b, c] if faces.first == 0 => triangle(part, &placed, shading, [a, b, c])?,
            _ => polygon(part, &placed, shading, &corners)?,
        }
    }
    Ok(())
}

/// Fails if a face has fewer than three corners, or a corner that is not one of `count` points.
fn check(kind: &str, count: usize, faces: &MeshFaces) -> Result<()> {
    let first = faces.first as usize;
    for (number, face) in (1..).zip(faces.iter()) {
        if face.len() < 3 {
            return Err(Error::argument(format!("{kind}:mesh: face {number} has {} corners", face.len()))
                .help("a face has at least three corners, such as { 1, 2, 3 }"));
        }
        if face.iter().any(|corner| !(first..first + count).contains(&(*corner as usize))) {
            let what = match count {
                0 => Cow::Borrowed("a point, but no points are given"),
                _ => format!("a point that is not one of {first} to {}", first + count - 1).into(),
            };
            let kept = if first == 0 { " in a buffer" } else { "" };
            return Err(Error::argument(format!("{kind}:mesh: face {number} refers to {what}"))
                .help(format!("points are numbered from {first}{kept}, in the given order")));
        }
    }
    Ok(())
}

/// Returns the number of the drawing's part for each face, or a single part for all faces.
fn parts(
    kind: &str,
    drawing: &mut Drawing,
    base: &Material,
    colors: Option<&MeshColors>,
) -> Result<Vec<usize>> {
    let Some(colors) = colors else { return Ok(vec![drawing.material(base)]) };
    let mut known: Vec<[f32; 4]> = Vec::new();
    let mut numbers = Vec::with_capacity(colors.0.len());
    for Color(color) in &colors.0 {
        // Neighbouring faces usually share a colour, so the search starts at the last one.
        let number = known.iter().rposition(|other| other == color).unwrap_or_else(|| {
            known.push(*color);
            known.len() - 1
        });
        if known.len() > MOST_COLORS {
            let message = format!("{kind}:mesh: the faces have more than {MOST_COLORS} different colours");
            return Err(
                Error::limit(Limit::Size, message).help("round the colours, or use a texture with uvs")
            );
        }
        numbers.push(number);
    }
    let material = |color: &[f32; 4]| Material { base_color: *color, ..base.clone() };
    let found: Vec<usize> = known.iter().map(|color| drawing.material(&material(color))).collect();
    Ok(numbers.into_iter().map(|number| found[number]).collect())
}

/// Adds a triangle, unless it has no area.
fn triangle(
    part: &mut Part,
    placed: &[DVec3],
    shading: CornerShading<'_>,
    corners: [usize; 3],
) -> Result<()> {
    let [a, b, c] = corners.map(|corner| placed[corner]);
    let normal = (b - a).cross(c - a).normalize_or_zero();
    if normal == DVec3::ZERO {
        return Ok(());
    }
    let base = u32::try_from(part.positions.len() + 2)
        .map_err(|_| Error::limit(Limit::Size, "a mesh has too many vertices"))?
        - 2;
    let right = normal.any_orthonormal_vector();
    let up = normal.cross(right);
    part.make_room(3, 1);
    for corner in corners {
        let at = placed[corner];
        let given = shading.normals.map_or(DVec3::ZERO, |normals| normals[corner].normalize_or_zero());
        let flat = || DVec2::new((at - a).dot(right), (at - a).dot(up));
        part.positions.push(at.as_vec3());
        part.normals.push(if given == DVec3::ZERO { normal } else { given }.into());
        part.uvs.push(shading.uvs.map_or_else(flat, |uvs| uvs[corner]).as_vec2());
    }
    part.triangles.push([base, base + 1, base + 2]);
    Ok(())
}

/// Adds a face of any number of corners.
fn polygon(part: &mut Part, placed: &[DVec3], shading: CornerShading<'_>, corners: &[usize]) -> Result<()> {
    let points: Vec<DVec3> = corners.iter().map(|corner| placed[*corner]).collect();
    let normals: Option<Vec<DVec3>> =
        shading.normals.map(|normals| corners.iter().map(|corner| normals[*corner]).collect());
    let uvs: Option<Vec<DVec2>> = shading.uvs.map(|uvs| corners.iter().map(|corner| uvs[*corner]).collect());
    shaded_face(part, &points, CornerShading { normals: normals.as_deref(), uvs: uvs.as_deref() })
}
