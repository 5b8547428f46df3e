//! The triangles of a glTF file.

use glam::{Vec2, Vec3};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index};

use super::bytes::{MANY, NumberColumns};
use super::tints;
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_scene::{Normal, Part};

/// Maximum distance (m) of a point from the model's origin.
const FARTHEST: f32 = 1e7;

/// The triangles of a primitive with the same vertex colour.
pub(super) struct TintedPart {
    /// Factor for the material's colour.
    pub tint: [f32; 4],
    pub part: Part,
}

/// Reads the triangles of a primitive, z up. Returns nothing for lines and points, and for triangles without area.
///
/// `set` is the number of the texture coordinates that its material uses. Memory depends only on the primitive's own
/// triangles, because several primitives of a file may share one long list of points.
pub(super) fn shapes(
    columns: &mut NumberColumns<'_>,
    primitive: &Primitive,
    set: u32,
) -> Result<Vec<TintedPart>> {
    let attribute = |wanted: Semantic| -> Option<Index<Accessor>> {
        primitive.attributes.get(&Checked::Valid(wanted)).copied()
    };
    let Some(positions) = attribute(Semantic::Positions) else { return Ok(Vec::new()) };
    let positions = columns.triples(positions)?;
    let uvs = attribute(Semantic::TexCoords(set)).map(|uvs| columns.pairs(uvs)).transpose()?;
    let normals = attribute(Semantic::Normals).map(|normals| columns.triples(normals)).transpose()?;
    let same = |length: usize| length == positions.len();
    if !uvs.as_ref().is_none_or(|uvs| same(uvs.len())) || !normals.as_ref().is_none_or(|it| same(it.len())) {
        return Err(Error::data(
            "its number of normals or texture coordinates differs from its number of points",
        ));
    }
    let triangles = triangles(columns, primitive, &positions)?;
    let mut shapes = Vec::new();
    for (tint, triangles) in
        tints::group_by_tint(columns, attribute(Semantic::Colors(0)), positions.len(), triangles)?
    {
        let budget = columns.budget;
        // Corners may become separate points, and are traversed several times.
        budget.take(triangles.len().saturating_mul(size_of::<[u32; 3]>() + 3 * POINT))?;
        let given =
            PrimitiveColumns { positions: &positions, normals: normals.as_deref(), uvs: uvs.as_deref() };
        shapes.push(TintedPart { tint, part: given.part(triangles)? });
    }
    Ok(shapes)
}

/// Approximate memory of a point (bytes).
const POINT: usize = size_of::<Vec3>() + size_of::<Vec2>() + size_of::<Normal>();

/// Returns the triangles of a primitive that have an area, as indices into its points.
fn triangles(
    columns: &mut NumberColumns<'_>,
    primitive: &Primitive,
    positions: &[[f32; 3]],
) -> Result<Vec<[u32; 3]>> {
    let count = u32::try_from(positions.len())
        .map_err(|_| Error::limit(Limit::Size, "it has more than 2^32 points"))?;
    let indices = primitive.indices.map(|indices| columns.indices(indices)).transpose()?;
    let length = indices.as_ref().map_or(positions.len(), |indices| indices.len());
    let corner = |at: usize| match &indices {
        Some(indices) => indices[at],
        #[allow(clippy::cast_possible_truncation, reason = "the number of points fits")]
        None => at as u32,
    };
    let places: Box<dyn Iterator<Item = [usize; 3]>> = match primitive.mode {
        Checked::Valid(Mode::Triangles) => {
            Box::new((0..length / 3).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]))
        }
        Checked::Valid(Mode::TriangleStrip) => Box::new((0..length.saturating_sub(2)).map(|at| {
            let (first, second) = if at.is_multiple_of(2) { (at, at + 1) } else { (at + 1, at) };
            [first, second, at + 2]
        })),
        Checked::Valid(Mode::TriangleFan) => {
            Box::new((1..length.saturating_sub(1)).map(|at| [0, at, at + 1]))
        }
        _ => return Ok(Vec::new()),
    };
    if let Some(odd) = (0..length).map(corner).find(|corner| *corner >= count) {
        return Err(Error::data(format!("a triangle refers to point {odd} of {count}")));
    }
    let budget = columns.budget;
    let _held = budget.hold(length.saturating_mul(size_of::<[u32; 3]>()))?;
    let mut triangles = Vec::new();
    for (number, places) in places.enumerate() {
        if number.is_multiple_of(MANY) {
            budget.check()?;
        }
        let corners = places.map(corner);
        let points = corners.map(|corner| z_up(Vec3::from(positions[corner as usize])));
        if let Some(point) = points.iter().find(|point| !point.abs().cmple(Vec3::splat(FARTHEST)).all()) {
            return Err(Error::data(format!(
                "a point has the position {}, {}, {}",
                point.x, point.y, point.z
            )));
        }
        // A triangle without area is invisible and has no normal.
        if area_vector(points).length_squared() > 0.0 {
            triangles.push(corners);
        }
    }
    Ok(triangles)
}

/// Concatenates pieces into the empty part `whole`, column by column, so that at most one column exists twice at a
/// time.
pub(super) fn join(whole: &mut Part, mut pieces: Vec<Part>, budget: &Budget) -> Result<()> {
    if let [piece] = &mut pieces[..] {
        *whole = Part { material: whole.material, ..std::mem::take(piece) };
        return Ok(());
    }
    let points: usize = pieces.iter().map(|piece| piece.positions.len()).sum();
    if u32::try_from(points).is_err() {
        return Err(Error::data("a mesh has more than 2^32 points"));
    }
    let count: usize = pieces.iter().map(|piece| piece.triangles.len()).sum();
    let mut first = 0;
    let _held = budget.hold(count.saturating_mul(size_of::<[u32; 3]>()))?;
    whole.triangles.make_room(count);
    for piece in &mut pieces {
        let triangles = std::mem::take(&mut piece.triangles);
        whole.triangles.extend(triangles.iter().map(|corners| corners.map(|corner| corner + first)));
        first = first.saturating_add(u32::try_from(piece.positions.len()).unwrap_or(u32::MAX));
    }
    whole.positions = column(&mut pieces, points, budget, |piece| &mut piece.positions)?;
    whole.normals = column(&mut pieces, points, budget, |piece| &mut piece.normals)?;
    whole.uvs = column(&mut pieces, points, budget, |piece| &mut piece.uvs)?;
    Ok(())
}

/// Concatenates a column of the pieces, with `count` values in total.
fn column<T>(
    pieces: &mut [Part],
    count: usize,
    budget: &Budget,
    of: impl Fn(&mut Part) -> &mut Vec<T>,
) -> Result<Vec<T>> {
    budget.check()?;
    let _held = budget.hold(count.saturating_mul(size_of::<T>()))?;
    let mut whole = Vec::with_capacity(count);
    pieces.iter_mut().for_each(|piece| whole.append(&mut std::mem::take(of(piece))));
    Ok(whole)
}

/// The columns of a primitive.
struct PrimitiveColumns<'a> {
    positions: &'a [[f32; 3]],
    normals: Option<&'a [[f32; 3]]>,
    uvs: Option<&'a [[f32; 2]]>,
}

impl PrimitiveColumns<'_> {
    /// Creates the part of these triangles, with only the points that they use.
    fn part(&self, triangles: Vec<[u32; 3]>) -> Result<Part> {
        let mut part = Part::default();
        let used: Vec<u32> = match self.normals {
            // Each triangle gets separate points with the normal of its face.
            None => triangles.iter().flatten().copied().collect(),
            Some(_) => {
                let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
                used.sort_unstable();
                used.dedup();
                used
            }
        };
        let used = || used.iter().map(|point| *point as usize);
        part.positions = used().map(|point| z_up(Vec3::from(self.positions[point]))).collect();
        if let Some(uvs) = self.uvs {
            // The v coordinate points up here, but down in a file.
            part.uvs = used().map(|point| Vec2::new(uvs[point][0], 1.0 - uvs[point][1])).collect();
            if part.uvs.iter().any(|uv| !uv.abs().cmple(Vec2::splat(FARTHEST)).all()) {
                return Err(Error::data("a texture coordinate is not finite"));
            }
        }
        match self.normals {
            None => {
                for (first, points) in (0u32..).step_by(3).zip(part.positions.chunks_exact(3)) {
                    part.triangles.push([first, first + 1, first + 2]);
                    let normal = area_vector([points[0], points[1], points[2]]).try_normalize();
                    part.normals.extend([Normal::from(normal.unwrap_or(Vec3::Z)); 3]);
                }
            }
            Some(normals) => {
                let places: Vec<u32> = used().map(|point| u32::try_from(point).unwrap_or(u32::MAX)).collect();
                let place = |point: u32| {
                    u32::try_from(places.partition_point(|known| *known < point)).unwrap_or(u32::MAX)
                };
                let all = places.len() == self.positions.len();
                let triangles =
                    triangles.into_iter().map(|triangle| if all { triangle } else { triangle.map(place) });
                part.triangles = triangles.collect();
                take_normals(&mut part, used().map(|point| normals[point]));
            }
        }
        if part.uvs.is_empty() {
            let points = part.positions.iter().zip(&part.normals);
            part.uvs = points.map(|(at, normal)| along(*at, normal.vector())).collect();
        }
        Ok(part)
    }
}

fn z_up(vector: Vec3) -> Vec3 {
    Vec3::new(vector.x, -vector.z, vector.y)
}

/// Returns a normal vector of a triangle, with a length of twice its area.
fn area_vector([a, b, c]: [Vec3; 3]) -> Vec3 {
    (b - a).cross(c - a)
}

/// Sets the normals of the file, or the average of the adjacent faces for an invalid normal.
fn take_normals(part: &mut Part, normals: impl Iterator<Item = [f32; 3]>) {
    let mut around = vec![Vec3::ZERO; part.positions.len()];
    for triangle in &part.triangles {
        let vector = area_vector(triangle.map(|corner| part.positions[corner as usize]));
        for corner in triangle {
            around[corner as usize] += vector;
        }
    }
    let unit = |(normal, around): ([f32; 3], Vec3)| {
        let normal = z_up(Vec3::from(normal)).try_normalize();
        Normal::from(normal.or_else(|| around.try_normalize()).unwrap_or(Vec3::Z))
    };
    part.normals = normals.zip(around).map(unit).collect();
}

/// Returns texture coordinates in metres, projected along the dominant axis of the normal.
fn along(at: Vec3, normal: Vec3) -> Vec2 {
    let size = normal.abs();
    if size.z >= size.x && size.z >= size.y {
        Vec2::new(at.x, at.y)
    } else if size.x >= size.y {
        Vec2::new(at.y, at.z)
    } else {
        Vec2::new(at.x, at.z)
    }
}
