//! Union, difference and intersection of solids.

use std::borrow::Cow;
use std::panic::{AssertUnwindSafe, catch_unwind};

use boolmesh::prelude::{Manifold, OpType, compute_boolean};
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::{MemoryOwner, Stop};
use glam::DVec3;
use rustc_hash::FxHashSet;

use super::flat_faces::remove_flat_triangles;
use super::manifold_points::separate_surfaces;
use super::merge::{merge_coplanar, merge_fillable, remove_opposite_faces, weld};
use super::source_planes::SourcePlane;
use crate::Shape;
use crate::mesh::{PolygonFace, PolygonMesh};
use crate::own_thread::run_abandonable;
use crate::style::{FaceStyle, SharedStyle};

/// Set operation of two solids.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SolidOperation {
    /// Points in either solid.
    Union,
    /// Points in the first solid only.
    Difference,
    /// Points in both solids.
    Intersection,
}

/// Result of a set operation.
#[derive(Debug, Clone)]
pub struct CombinedSolid {
    /// Solid; `None` if nothing remains.
    pub solid: Option<Shape>,
    /// Distance (m) by which the second solid was moved; 0 unless the operation fails numerically without it.
    pub shift: f64,
}

impl CombinedSolid {
    /// Creates the result of an operation on solids that were not moved.
    fn exact(solid: Option<Shape>) -> Self {
        Self { solid, shift: 0.0 }
    }

    /// Returns true if nothing remains, or at most a layer on a surface of `area` (m²) that is as thick as the shift.
    pub(crate) fn leaves_less_than(&self, area: f64) -> bool {
        self.solid.as_ref().is_none_or(|rest| rest.volume() < NOTHING + self.shift * area)
    }
}

/// Maximum number of triangles of both solids together.
const MOST_TRIANGLES: usize = 2_000_000;
/// Number of triangles of both solids from which an operation can take long, so that a thread of its own computes it.
const LONG: usize = 20_000;
/// Approximate memory (bytes) of an operation for each triangle of the solids.
const BYTES_OF_TRIANGLE: usize = 1000;
/// Distance (m) within which points of a result almost coincide.
const NEAR: f64 = 1e-7;
/// Volume (m³) below which nothing remains.
const NOTHING: f64 = 1e-9;
/// Largest difference of equal volumes, as a fraction.
const SAME_VOLUME: f64 = 1e-9;
/// Number of faces between two checks for cancellation.
const STRETCH: usize = 4096;

impl Shape {
    /// Returns the union, difference or intersection of two solids.
    ///
    /// Faces keep their tags, and get "bool.a" or "bool.b" by the solid that they come from. Coplanar parts of a face
    /// are joined, unless a face would be too narrow. If the operation fails numerically, or a part of the result is not in a face of
    /// the solids, it is tried with points joined that almost coincide, with the axes exchanged, and with the second solid moved by
    /// up to 40 millionths of its size. Fails if a shape is open, or if all of that fails.
    ///
    /// Method: the crate `boolmesh`, after E. Lalish's Manifold.
    ///
    /// ```
    /// use burgeon_shapes::{Shape, SolidOperation};
    /// use glam::DVec3;
    ///
    /// let block = Shape::cuboid(DVec3::splat(2.0));
    /// let cut = block.combine(&block.translate(DVec3::ONE), SolidOperation::Difference)?;
    /// let solid = cut.solid.expect("7 of 8 parts");
    /// assert!(solid.is_closed() && (solid.volume() - 7.0).abs() < 1e-9 && cut.shift == 0.0);
    /// assert_eq!(solid.body.faces(), 9);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn combine(&self, other: &Self, operation: SolidOperation) -> Result<CombinedSolid> {
        for shape in [self, other] {
            if !shape.is_closed() {
                let open = shape.mesh().open_edges().count();
                let message = format!("a set operation takes solids, and the shape has {open} open edges");
                return Err(Error::geometry(message).help("extrude faces first"));
            }
        }
        if self.is_apart(other) {
            let [one, two] = [(self, "bool.a"), (other, "bool.b")]
                .map(|(shape, tag)| shape.with_styles(|style| FaceStyle::with_automatic_tag(style, tag)));
            let solid = match operation {
                SolidOperation::Union => Self::join_separate(&[&one, &two])?,
                SolidOperation::Difference => Some(one),
                SolidOperation::Intersection => None,
            };
            return Ok(CombinedSolid::exact(solid));
        }
        self.combine_by(&SolidAttempt::ALL, other, operation)
    }

    /// Returns the result of the first of these attempts that succeeds, for closed solids whose boxes touch.
    fn combine_by(
        &self,
        attempts: &[SolidAttempt],
        other: &Self,
        operation: SolidOperation,
    ) -> Result<CombinedSolid> {
        let (mut cause, mut unsound) = (String::new(), None);
        for attempt in attempts.iter().copied() {
            let Some([one, two]) = attempt.solids(self, other) else { continue };
            let shift = attempt.shift(other).length();
            match one.combine_once(&two, operation, attempt.turns())? {
                Ok(found) if !found.is_in_faces && !one.has_volumes_of(&two, operation, &found)? => {
                    if cause.is_empty() {
                        cause = "a part of the result is not in a face of the solids".into();
                    }
                }
                Ok(AttemptOutcome { solid: Some(solid), .. }) if !solid.is_sound()? => {
                    unsound = unsound.or(Some(CombinedSolid { solid: Some(solid), shift }));
                }
                Ok(found) => return Ok(CombinedSolid { solid: found.solid, shift }),
                // The crate refuses empty results, too.
                Err(_) if attempt == SolidAttempt::Exact && self.leaves_nothing(other, operation)? => {
                    return Ok(CombinedSolid::exact(None));
                }
                Err(found) if cause.is_empty() => cause = found,
                Err(_) => {}
            }
        }
        // A closed solid is better than none, even if it can hardly be combined with others.
        match unsound {
            Some(found) => Ok(found),
            None => Err(Error::geometry(format!("the set operation of two solids failed: {cause}"))
                .help("move one of the solids by a millimetre, or simplify it")),
        }
    }

    /// Returns true if the volumes of the result and of another operation on the solids add up to those of the solids.
    fn has_volumes_of(
        &self,
        other: &Self,
        operation: SolidOperation,
        found: &AttemptOutcome,
    ) -> Result<bool> {
        let second = match operation {
            SolidOperation::Union => SolidOperation::Intersection,
            SolidOperation::Difference | SolidOperation::Intersection => SolidOperation::Union,
        };
        let Ok(second) = self.combine_once(other, second, 0)? else { return Ok(false) };
        let whole = self.volume() + other.volume();
        let error = match operation {
            SolidOperation::Difference => second.volume() - found.volume() - other.volume(),
            SolidOperation::Union | SolidOperation::Intersection => second.volume() + found.volume() - whole,
        };
        // Points of both results that almost coincide were joined.
        let most = SAME_VOLUME * whole + NEAR * (self.area() + other.area());
        Ok(error.abs() <= most)
    }

    /// Returns true if a solid can be combined with others: at most two faces share an edge, or surfaces that touch can be separated.
    fn is_sound(&self) -> Result<bool> {
        let mesh = self.mesh();
        let mut sides: FxHashSet<[u32; 2]> = FxHashSet::default();
        if mesh.faces.iter().flat_map(|face| face.edges()).all(|edge| sides.insert(edge)) {
            return Ok(true);
        }
        let (points, corners, faces) = triangles(self, self.scope().center(), "bool.a", &mut Vec::new())?;
        let check = || Manifold::new_with_values(&points, &corners, &faces).is_ok();
        Ok(catch_unwind(AssertUnwindSafe(check)).unwrap_or(false))
    }

    /// Returns the result of an operation on solids whose boxes touch, computed with the axes exchanged so often, or the cause of a
    /// numerical failure.
    fn combine_once(
        &self,
        other: &Self,
        operation: SolidOperation,
        turns: usize,
    ) -> Result<std::result::Result<AttemptOutcome, String>> {
        let center = self.scope().center();
        let mut sources: Vec<SourceFace> = Vec::new();
        let mut one = triangles(self, center, "bool.a", &mut sources)?;
        let first_of_two = sources.len();
        let mut two = triangles(other, center, "bool.b", &mut sources)?;
        // Such a turn is exact, and the crate meets the edges in another order.
        [&mut one, &mut two].into_iter().for_each(|solid| {
            solid.0.chunks_exact_mut(3).for_each(|at| at.rotate_left(turns));
        });
        if one.1.len() + two.1.len() > 3 * MOST_TRIANGLES {
            let message =
                format!("a set operation takes solids of at most {MOST_TRIANGLES} triangles together");
            return Err(Error::limit(Limit::Size, message).help("use simpler solids"));
        }
        Stop::check_current()?;
        let count = (one.1.len() + two.1.len()) / 3;
        MemoryOwner::ensure_room(count.saturating_mul(BYTES_OF_TRIANGLE))?;
        let is_difference = operation == SolidOperation::Difference;
        let compute = move || {
            let [one, two] = [one, two]
                .map(|(points, corners, faces)| Manifold::new_with_values(&points, &corners, &faces));
            let operation = match operation {
                SolidOperation::Union => OpType::Add,
                SolidOperation::Difference => OpType::Subtract,
                SolidOperation::Intersection => OpType::Intersect,
            };
            compute_boolean(&one?, &two?, operation)
        };
        let result = if count < LONG {
            catch_unwind(AssertUnwindSafe(compute)).ok()
        } else {
            run_abandonable(compute)?
        };
        let solid = match result {
            Some(Ok(solid)) => solid,
            Some(Err(cause)) => return Ok(Err(cause)),
            None => return Ok(Err("numerical trouble".into())),
        };
        let turned_back = |mut at: [f64; 3]| {
            at.rotate_right(turns);
            DVec3::from_array(at)
        };
        let points: Vec<DVec3> = solid.ps.iter().map(|at| turned_back(at.to_array())).collect();
        let mut faces = Vec::with_capacity(solid.nf);
        let mut is_in_faces = true;
        for (corners, values) in solid.hs.chunks_exact(3).zip(solid.vals.chunks_exact(3)) {
            let ring: Vec<u32> = corners.iter().filter_map(|half| u32::try_from(half.tail).ok()).collect();
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "numbers of faces, interpolated"
            )]
            let face = values[0].round() as usize;
            let source = sources.get(face);
            let is_reversed = is_difference && face >= first_of_two;
            if let (Some(source), [a, b, c]) = (source, ring.as_slice())
                && !source.plane.has_triangle([a, b, c].map(|point| points[*point as usize]), is_reversed)
            {
                // The crate can move points if it removes edges that occur twice.
                is_in_faces = false;
            }
            faces.push(PolygonFace::of(&ring, source.map_or(&None, |source| &source.style)));
        }
        if faces.is_empty() {
            return Ok(Ok(AttemptOutcome { solid: None, is_in_faces }));
        }
        let points = points.into_iter().map(|at| at + center).collect();
        let mut whole = weld_closed(PolygonMesh::new(points, faces));
        remove_flat_triangles(&mut whole, NEAR)?;
        let mut mesh = merge_coplanar(&whole)?;
        if !mesh.is_fillable() {
            mesh = merge_fillable(&whole)?;
        }
        // Coincident faces of the solids can leave both sides of a face without thickness.
        remove_opposite_faces(&mut mesh);
        if mesh.faces.is_empty() {
            return Ok(Ok(AttemptOutcome { solid: None, is_in_faces }));
        }
        if !mesh.is_closed() {
            return Ok(Err("the result is open".into()));
        }
        if !mesh.is_fillable() {
            return Ok(Err("a face is too narrow".into()));
        }
        Ok(Ok(AttemptOutcome { solid: Some(Self::of_mesh(mesh, self.scope().axes)), is_in_faces }))
    }

    /// Returns true if nothing is the result of an operation on two solids.
    fn leaves_nothing(&self, other: &Self, operation: SolidOperation) -> Result<bool> {
        match operation {
            SolidOperation::Union => Ok(false),
            SolidOperation::Intersection if !self.overlaps(other)? => Ok(true),
            // An overlap that is thinner than the rounding errors.
            SolidOperation::Intersection => {
                let rest = self.combine_once(other, SolidOperation::Difference, 0)?;
                let (rest, own) = (rest.map_or(0.0, |rest| rest.volume()), self.volume());
                Ok((rest - own).abs() <= SAME_VOLUME * own)
            }
            SolidOperation::Difference => {
                let both = self.combine(other, SolidOperation::Intersection)?.solid;
                let both = both.map_or(0.0, |both| both.volume());
                Ok(both >= self.volume() * (1.0 - SAME_VOLUME))
            }
        }
    }

    /// Returns true if the bounding boxes along the world's axes do not touch.
    pub(crate) fn is_apart(&self, other: &Self) -> bool {
        let [one, two] = [self, other].map(Self::bounds);
        one[1].cmplt(two[0]).any() || two[1].cmplt(one[0]).any()
    }

    /// Returns the least and the greatest coordinates (m) in the world.
    pub fn bounds(&self) -> [DVec3; 2] {
        let around = |points: &[DVec3]| {
            let first = points.first().copied().unwrap_or(self.scope().origin);
            points.iter().fold([first; 2], |[low, high], at| [low.min(*at), high.max(*at)])
        };
        match &self.body {
            crate::ShapeBody::Mesh(mesh) => around(&mesh.points),
            _ => around(&self.scope().corners()),
        }
    }
}

/// Result of an attempt.
struct AttemptOutcome {
    /// Solid; `None` if nothing remains.
    solid: Option<Shape>,
    /// True if each triangle, before the repair of the result, was in the face of a solid that it comes from.
    is_in_faces: bool,
}

impl AttemptOutcome {
    /// Returns the volume (m³).
    fn volume(&self) -> f64 {
        self.solid.as_ref().map_or(0.0, Shape::volume)
    }
}

/// Way to compute an operation, after which the next one is tried if it fails.
#[derive(Debug, Clone, Copy, PartialEq)]
enum SolidAttempt {
    /// The solids as they are.
    Exact,
    /// The solids as they are, computed with the axes exchanged so often.
    Turned(usize),
    /// Points that almost coincide are joined.
    Welded,
    /// The same, and the second solid is moved by a fraction of its size, so that faces of both that almost coincide cross properly.
    Moved(f64),
}

impl SolidAttempt {
    const ALL: [Self; 7] = [
        Self::Exact,
        Self::Welded,
        Self::Turned(1),
        Self::Turned(2),
        Self::Moved(1e-6),
        Self::Moved(-7e-6),
        Self::Moved(4e-5),
    ];

    /// Returns the number of times that the axes are exchanged.
    fn turns(self) -> usize {
        if let Self::Turned(turns) = self { turns } else { 0 }
    }

    /// Returns the solids to combine; `None` if they are those of the attempt before.
    fn solids<'a>(self, one: &'a Shape, two: &'a Shape) -> Option<[Cow<'a, Shape>; 2]> {
        let weld_both = || [one, two].map(|shape| weld_solid(shape).map_or(Cow::Borrowed(shape), Cow::Owned));
        match self {
            Self::Exact | Self::Turned(_) => Some([one, two].map(Cow::Borrowed)),
            Self::Welded => {
                let solids = weld_both();
                solids.iter().any(|shape| matches!(shape, Cow::Owned(_))).then_some(solids)
            }
            Self::Moved(_) => {
                let [one, two] = weld_both();
                let moved = two.translate(self.shift(&two));
                Some([one, Cow::Owned(moved)])
            }
        }
    }

    /// Returns the vector (m) by which the second solid is moved.
    fn shift(self, two: &Shape) -> DVec3 {
        let Self::Moved(fraction) = self else { return DVec3::ZERO };
        let [low, high] = two.bounds();
        // No plane of a usual model has this direction.
        DVec3::new(0.531, 0.677, 0.509) * ((high - low).max_element() * fraction)
    }
}

/// Returns a solid whose points that almost coincide are joined, without pairs of opposite faces; `None` if it is the same or would
/// be open.
fn weld_solid(shape: &Shape) -> Option<Shape> {
    let crate::ShapeBody::Mesh(mesh) = &shape.body else { return None };
    let mut joined = weld(mesh, NEAR);
    remove_opposite_faces(&mut joined);
    let is_other = joined.points.len() != mesh.points.len() || joined.faces.len() != mesh.faces.len();
    (is_other && !joined.faces.is_empty() && joined.is_closed())
        .then(|| Shape::of_mesh(joined, shape.scope().axes))
}

/// Returns a closed mesh with points that almost coincide joined, unless that opens it.
fn weld_closed(mesh: PolygonMesh) -> PolygonMesh {
    let joined = weld(&mesh, NEAR);
    if joined.points.len() < mesh.points.len() && joined.is_closed() { joined } else { mesh }
}

/// Face of a solid from which triangles of a result come.
struct SourceFace {
    style: SharedStyle,
    plane: SourcePlane,
}

/// Points, corners and the number of the source face of each corner, as the crate `boolmesh` takes them.
type TriangleColumns = (Vec<f64>, Vec<usize>, Vec<f64>);

/// Returns the triangles of a solid relative to `center` (m), and adds its faces to `sources`, with another tag.
fn triangles(
    shape: &Shape,
    center: DVec3,
    tag: &'static str,
    sources: &mut Vec<SourceFace>,
) -> Result<TriangleColumns> {
    let mesh = shape.mesh();
    let mut points: Vec<DVec3> = mesh.points.iter().map(|at| *at - center).collect();
    let (mut corners, mut faces): (Vec<usize>, Vec<f64>) = (Vec::new(), Vec::new());
    for (number, face) in mesh.faces.iter().enumerate() {
        if number.is_multiple_of(STRETCH) {
            Stop::check_current()?;
        }
        let own: Vec<[u32; 3]> = mesh.triangles(face)?;
        #[allow(clippy::cast_precision_loss, reason = "fewer than 2^52 faces")]
        faces.extend(std::iter::repeat_n(sources.len() as f64, 3 * own.len()));
        corners.extend(own.iter().flatten().map(|point| *point as usize));
        let style = FaceStyle::with_automatic_tag(&face.style, tag);
        sources.push(SourceFace { style, plane: SourcePlane::of_face(&mesh, face, center) });
    }
    separate_surfaces(&mut points, &mut corners, &mut faces);
    let points = points.into_iter().flat_map(|at| at.to_array()).collect();
    Ok((points, corners, faces))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moved_solid_is_reported_with_its_distance_and_the_volume_is_almost_the_same() {
        let [one, two] = [0.0, 1.0].map(|x| Shape::cuboid(DVec3::splat(2.0)).translate(DVec3::X * x));
        let exact = one.combine(&two, SolidOperation::Union).expect("a union");
        assert!(exact.shift == 0.0);
        for fraction in [1e-6, -7e-6, 4e-5] {
            let moved = one.combine_by(&[SolidAttempt::Moved(fraction)], &two, SolidOperation::Union);
            let CombinedSolid { solid: Some(solid), shift } = moved.expect("a union") else {
                panic!("nothing")
            };
            assert!((shift - 2.0 * fraction.abs()).abs() < 0.01 * shift, "{shift}");
            let inside = one.combine_by(&[SolidAttempt::Moved(fraction)], &one, SolidOperation::Difference);
            let inside = inside.expect("a layer");
            assert!(inside.leaves_less_than(one.area()) && !inside.leaves_less_than(0.0));
            assert!(solid.is_closed() && (solid.volume() - 12.0).abs() < 24.0 * shift, "{}", solid.volume());
        }
    }
}
