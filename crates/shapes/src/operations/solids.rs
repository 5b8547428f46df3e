//! Union, difference and intersection of solids.

use std::panic::{AssertUnwindSafe, catch_unwind};

use boolmesh::prelude::{Manifold, OpType, compute_boolean};
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::{MemoryOwner, Stop};
use glam::DVec3;

use super::flat_faces::remove_flat_triangles;
use super::manifold_points::separate_surfaces;
use super::merge::{merge_coplanar, remove_opposite_faces};
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

/// Maximum number of triangles of both solids together.
const MOST_TRIANGLES: usize = 2_000_000;
/// Number of triangles of both solids from which an operation can take long, so that a thread of its own computes it.
const LONG: usize = 20_000;
/// Approximate memory (bytes) of an operation for each triangle of the solids.
const BYTES_OF_TRIANGLE: usize = 1000;
/// Number of faces between two checks for cancellation.
const STRETCH: usize = 4096;

impl Shape {
    /// Returns the union, difference or intersection of two solids; `None` if nothing remains.
    ///
    /// Faces keep their tags, and get "bool.a" or "bool.b" by the solid that they come from. Coplanar parts of a face
    /// are joined. Fails if a shape is open, or if the operation fails numerically.
    ///
    /// Method: the crate `boolmesh`, after E. Lalish's Manifold.
    ///
    /// ```
    /// use burgeon_shapes::{Shape, SolidOperation};
    /// use glam::DVec3;
    ///
    /// let block = Shape::cuboid(DVec3::splat(2.0));
    /// let cut = block.combine(&block.translate(DVec3::ONE), SolidOperation::Difference)?.expect("7 of 8 parts");
    /// assert!(cut.is_closed() && (cut.volume() - 7.0).abs() < 1e-9);
    /// assert_eq!(cut.body.faces(), 9);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn combine(&self, other: &Self, operation: SolidOperation) -> Result<Option<Self>> {
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
            return match operation {
                SolidOperation::Union => Self::join(&[&one, &two]),
                SolidOperation::Difference => Ok(Some(one)),
                SolidOperation::Intersection => Ok(None),
            };
        }
        let center = self.scope.center();
        let mut styles: Vec<SharedStyle> = Vec::new();
        let one = triangles(self, center, "bool.a", &mut styles)?;
        let two = triangles(other, center, "bool.b", &mut styles)?;
        if one.1.len() + two.1.len() > 3 * MOST_TRIANGLES {
            let message =
                format!("a set operation takes solids of at most {MOST_TRIANGLES} triangles together");
            return Err(Error::limit(Limit::Size, message).help("use simpler solids"));
        }
        Stop::check_current()?;
        let count = (one.1.len() + two.1.len()) / 3;
        MemoryOwner::ensure_room(count.saturating_mul(BYTES_OF_TRIANGLE))?;
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
        let failed = |cause: &str| {
            Error::geometry(format!("the set operation of two solids failed: {cause}"))
                .help("move one of the solids by a millimetre, or simplify it")
        };
        let solid = match result {
            Some(Ok(solid)) => solid,
            // The crate refuses empty results, too.
            Some(Err(_)) if self.leaves_nothing(other, operation)? => return Ok(None),
            Some(Err(cause)) => return Err(failed(&cause)),
            None => return Err(failed("numerical trouble")),
        };
        let points = solid.ps.iter().map(|at| DVec3::from_array(at.to_array()) + center).collect();
        let mut faces = Vec::with_capacity(solid.nf);
        for (corners, values) in solid.hs.chunks_exact(3).zip(solid.vals.chunks_exact(3)) {
            let ring: Vec<u32> = corners.iter().filter_map(|half| u32::try_from(half.tail).ok()).collect();
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "numbers of faces, interpolated"
            )]
            let face = values[0].round() as usize;
            faces.push(PolygonFace::of(&ring, styles.get(face).unwrap_or(&None)));
        }
        if faces.is_empty() {
            return Ok(None);
        }
        let mut mesh = PolygonMesh::new(points, faces);
        remove_flat_triangles(&mut mesh);
        let mut mesh = merge_coplanar(&mesh)?;
        // Coincident faces of the solids can leave both sides of a face without thickness.
        remove_opposite_faces(&mut mesh);
        if mesh.faces.is_empty() {
            return Ok(None);
        }
        if !mesh.is_closed() {
            return Err(failed("the result is open"));
        }
        Ok(Some(Self::of_mesh(mesh, self.scope.axes)))
    }

    /// Returns true if nothing is the result of an operation on two solids.
    fn leaves_nothing(&self, other: &Self, operation: SolidOperation) -> Result<bool> {
        match operation {
            SolidOperation::Union => Ok(false),
            SolidOperation::Intersection => Ok(!self.overlaps(other)?),
            SolidOperation::Difference => {
                let both =
                    self.combine(other, SolidOperation::Intersection)?.map_or(0.0, |both| both.volume());
                Ok(both >= self.volume() * (1.0 - 1e-9))
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
            let first = points.first().copied().unwrap_or(self.scope.origin);
            points.iter().fold([first; 2], |[low, high], at| [low.min(*at), high.max(*at)])
        };
        match &self.body {
            crate::ShapeBody::Mesh(mesh) => around(&mesh.points),
            _ => around(&self.scope.corners()),
        }
    }
}

/// Points, corners and the style number of each corner, as the crate `boolmesh` takes them.
type TriangleColumns = (Vec<f64>, Vec<usize>, Vec<f64>);

/// Returns the triangles of a solid relative to `center` (m), and adds the styles of its faces with another tag.
fn triangles(
    shape: &Shape,
    center: DVec3,
    tag: &'static str,
    styles: &mut Vec<SharedStyle>,
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
        faces.extend(std::iter::repeat_n(styles.len() as f64, 3 * own.len()));
        corners.extend(own.iter().flatten().map(|point| *point as usize));
        styles.push(FaceStyle::with_automatic_tag(&face.style, tag));
    }
    separate_surfaces(&mut points, &mut corners);
    let points = points.into_iter().flat_map(|at| at.to_array()).collect();
    Ok((points, corners, faces))
}
