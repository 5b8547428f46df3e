//! Planes that divide meshes.

use burgeon_base::Stop;
use burgeon_base::error::Result;
use glam::DVec3;
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::crossing::{FaceCutter, PlaneSide};
use crate::Scope;
use crate::mesh::{EdgeSums, PolygonFace, PolygonMesh, trace_loops};
use crate::style::SharedStyle;

/// Distance (m) from a plane within which a point lies on it.
const ON_PLANE: f64 = 1e-6;
/// Number of faces between two checks for cancellation.
const STRETCH: usize = 4096;

/// A plane: the points whose product with the normal is the offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutPlane {
    /// Unit normal.
    pub normal: DVec3,
    /// Distance (m) from the origin along the normal.
    pub offset: f64,
}

/// The parts of a mesh on both sides of a plane; `None` without a part.
#[derive(Debug, Default)]
pub(crate) struct Halves {
    /// Part against the normal.
    pub below: Option<PolygonMesh>,
    /// Part along the normal.
    pub above: Option<PolygonMesh>,
    /// Set if a closed mesh could not be closed again.
    pub open: bool,
}

impl CutPlane {
    /// Creates the plane through `point` (m) with a unit normal.
    pub fn through(point: DVec3, normal: DVec3) -> Self {
        Self { normal, offset: point.dot(normal) }
    }

    /// Returns the distance (m) of a place along the normal.
    #[inline]
    pub fn distance(&self, place: DVec3) -> f64 {
        place.dot(self.normal) - self.offset
    }

    /// Divides a mesh. Parts of a closed mesh are closed by new faces with `style`.
    ///
    /// Points are classified once, so the topology of both parts is exact.
    pub(crate) fn cut(&self, mesh: &PolygonMesh, style: &SharedStyle) -> Result<Halves> {
        let sides: Vec<PlaneSide> =
            mesh.points.iter().map(|point| PlaneSide::of(self.distance(*point), ON_PLANE)).collect();
        let above = sides.contains(&PlaneSide::Above);
        let below = sides.contains(&PlaneSide::Below);
        if !above || !below {
            let whole = || Some(mesh.clone());
            return Ok(match (below, above) {
                (_, true) => Halves { above: whole(), ..Halves::default() },
                _ => Halves { below: whole(), ..Halves::default() },
            });
        }
        let mut halves = Halves::default();
        for side in [PlaneSide::Below, PlaneSide::Above] {
            let (part, open) = self.part(mesh, &sides, side, style)?;
            halves.open |= open;
            *if side == PlaneSide::Above { &mut halves.above } else { &mut halves.below } = part;
        }
        Ok(halves)
    }

    /// Returns the part of a mesh on one side, and whether it should be closed and is not.
    fn part(
        &self,
        mesh: &PolygonMesh,
        sides: &[PlaneSide],
        side: PlaneSide,
        style: &SharedStyle,
    ) -> Result<(Option<PolygonMesh>, bool)> {
        let outward = if side == PlaneSide::Above { -self.normal } else { self.normal };
        let mut cutter = FaceCutter {
            plane: self,
            mesh,
            sides,
            side,
            points: mesh.points.clone(),
            new: FxHashMap::default(),
        };
        let (mut faces, mut rim) = (Vec::new(), EdgeSums::default());
        for (number, face) in mesh.faces.iter().enumerate() {
            if number.is_multiple_of(STRETCH) {
                Stop::check_current()?;
            }
            let all =
                |wanted: PlaneSide| face.rings.iter().flatten().all(|point| sides[*point as usize] == wanted);
            if all(side) {
                faces.push(face.clone());
            } else if all(PlaneSide::On) {
                // The face lies on the plane: it belongs to the part that it closes.
                if mesh.area_vector(face).dot(outward) > 0.0 {
                    face.edges().for_each(|[from, to]| rim.add([to, from]));
                    faces.push(face.clone());
                }
            } else if face.rings.iter().flatten().any(|point| sides[*point as usize] == side) {
                let first = faces.len();
                cutter.cut(face, &mut faces, &mut rim);
                // Copies of the style are shared.
                faces[first..].iter_mut().for_each(|part| part.style.clone_from(&face.style));
            }
        }
        if faces.is_empty() {
            return Ok((None, false));
        }
        let mut open = false;
        if mesh.is_closed() {
            let axes = Scope::face_axes(outward, glam::DMat3::IDENTITY);
            let turn = axes.transpose();
            let edges: Vec<[u32; 2]> = rim.rest().collect();
            let points = &cutter.points;
            match trace_loops(&edges, |point| (turn * points[point as usize]).truncate()) {
                Some(caps) => {
                    faces.extend(caps.into_iter().map(|rings| PolygonFace { rings, style: style.clone() }));
                }
                None => open = true,
            }
        }
        let part = PolygonMesh::new(cutter.points, faces);
        let count = part.faces.len();
        let part = part.select(0..count);
        open |= mesh.is_closed() && !part.is_closed();
        Ok((Some(part), open))
    }
}

/// Rings of a face.
pub(super) type FaceRings = SmallVec<[Vec<u32>; 1]>;
