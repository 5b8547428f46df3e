//! Repair of the patches of a finished roof as one mesh, so that no triangle is too thin for 32-bit
//! coordinates.

use glam::{DVec2, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};
use smallvec::SmallVec;

use super::Patch;
use super::fill::FilledPolygon;
use super::touching::{simple_rings, touching_parts};
use crate::planar::{Ring, edges};
use burgeon_base::Stop;
use burgeon_base::error::Result;

/// Minimum width (m) of triangles that are not slivers.
const SLIVER: f64 = 1.5e-4;
/// Width (m) above which a triangle needs no further check.
const WIDE: f64 = 0.01;
/// Distance (m) below which corners are merged; it is also the distance to which nearly touching corners are
/// moved.
const NEAR: f64 = 2.5e-4;
/// Maximum number of repair rounds.
const ROUNDS: usize = 64;
/// Number of faces between two checks for cancellation.
const STRETCH: usize = 256;

/// Repairs patches with slivers.
///
/// If two corners of a sliver nearly touch, they are merged. Otherwise the middle corner is inserted into the
/// border that it lies on, in the patches on both sides, or it is moved away from the border by the minimum
/// width.
///
/// Corners that the roof shares with the walls do not move.
///
/// Fails if the work of this thread is cancelled.
pub(super) fn mend(patches: &mut Vec<Patch>) -> Result<()> {
    let is_thin = |patch: &Patch| !is_wide(&patch.rings) && thin(&patch.rings, patch).is_some();
    if !patches.iter().any(is_thin) {
        return Ok(());
    }
    let mut mesh = RoofMesh::new(patches);
    for _ in 0..ROUNDS {
        if !mesh.mend(patches)? {
            break;
        }
    }
    mesh.finish(patches);
    Ok(())
}

/// A triangle that is too thin.
struct Sliver {
    /// Corners, the one opposite the longest side last.
    corners: [usize; 3],
    /// Direction from the longest side to the last corner.
    out: DVec3,
    /// Width (m).
    width: f64,
}

/// Returns true if a patch is a triangle or a quadrilateral whose triangles are much wider than slivers.
fn is_wide(rings: &[Ring<DVec3>]) -> bool {
    let [ring] = rings else { return false };
    let ([a, b, c] | [a, b, c, _]) = ring[..] else { return false };
    let d = ring[ring.len() - 1];
    let normals = [[a, b, c], [a, c, d]].map(|[a, b, c]| (b - a).cross(c - a));
    let longest =
        [a - b, b - c, a - c, c - d, a - d].map(DVec3::length_squared).into_iter().fold(0.0, f64::max);
    let wide = |normal: &DVec3| normal.length_squared() > WIDE * WIDE * longest;
    wide(&normals[0]) && (ring.len() == 3 || (wide(&normals[1]) && normals[0].dot(normals[1]) > 0.0))
}

/// Returns the thinnest triangle of a patch with these rings, if it is a sliver.
fn thin(rings: &[impl AsRef<[DVec3]>], patch: &Patch) -> Option<Sliver> {
    let origin = rings.first()?.as_ref().first()?;
    let flat = FilledPolygon::new(rings, patch.along.extend(0.0), *origin).ok()?;
    let widths = flat.triangles.iter().map(|&triangle| (flat.width(triangle), triangle));
    let (width, [a, b, c]) = widths.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|least| least.0 < SLIVER)?;
    let length = |from: usize, to: usize| flat.corners[from].distance_squared(flat.corners[to]);
    let turned = [[a, b, c], [b, c, a], [c, a, b]];
    let corners =
        turned.into_iter().max_by(|one, two| length(one[0], one[1]).total_cmp(&length(two[0], two[1])))?;
    let place = |corner: usize| rings.iter().flat_map(|ring| ring.as_ref()).nth(corner).copied();
    let side = place(corners[1])? - place(corners[0])?;
    Some(Sliver { corners, out: flat.normal.cross(side).normalize_or_zero(), width })
}

/// Unique corners of all patches, and the rings of their faces.
struct RoofMesh {
    points: Vec<DVec3>,
    /// Marks corners of the walls, by corner.
    fixed: Vec<bool>,
    /// Patch and rings of each face; a patch may be split into several faces.
    faces: Vec<(usize, Vec<Vec<usize>>)>,
}

impl RoofMesh {
    fn new(patches: &[Patch]) -> Self {
        let (mut points, mut known) = (Vec::new(), FxHashMap::default());
        let mut number = |at: &DVec3| {
            *known.entry((*at + DVec3::ZERO).to_array().map(f64::to_bits)).or_insert_with(|| {
                points.push(*at);
                points.len() - 1
            })
        };
        let rings =
            |patch: &Patch| patch.rings.iter().map(|ring| ring.iter().map(&mut number).collect()).collect();
        let faces: Vec<(usize, Vec<Vec<usize>>)> = patches.iter().map(rings).enumerate().collect();
        // Along the walls, a border has the roof on one side only.
        let borders: FxHashSet<[usize; 2]> =
            faces.iter().flat_map(|face| &face.1).flat_map(|ring| edges(ring)).collect();
        let mut fixed = vec![false; points.len()];
        for [a, b] in faces.iter().flat_map(|face| &face.1).flat_map(|ring| edges(ring)) {
            if !borders.contains(&[b, a]) {
                (fixed[a], fixed[b]) = (true, true);
            }
        }
        Self { points, fixed, faces }
    }

    fn places(&self, rings: &[Vec<usize>]) -> SmallVec<[Vec<DVec3>; 1]> {
        rings.iter().map(|ring| ring.iter().map(|&corner| self.points[corner]).collect()).collect()
    }

    /// Repairs the thinnest sliver of each face; returns true if anything changed.
    fn mend(&mut self, patches: &[Patch]) -> Result<bool> {
        let mut done = false;
        let mut face = 0;
        // Repairs may split faces meanwhile.
        while let Some((patch, rings)) = self.faces.get(face) {
            if face.is_multiple_of(STRETCH) {
                Stop::check_current()?;
            }
            if let Some(sliver) = thin(&self.places(rings), &patches[*patch]) {
                let all: SmallVec<[usize; 16]> = rings.iter().flatten().copied().collect();
                let corners = sliver.corners.map(|corner| all[corner]);
                Stop::check_current()?;
                done |=
                    self.joins(corners) || self.divides(corners, sliver.out) || self.widens(corners, &sliver);
            }
            face += 1;
        }
        Ok(done)
    }

    /// Merges the two closest of three corners if they nearly touch; returns true on success.
    fn joins(&mut self, [a, b, c]: [usize; 3]) -> bool {
        let distance = |[one, two]: [usize; 2]| self.points[one].distance_squared(self.points[two]);
        let pairs = [[a, b], [b, c], [c, a]];
        let Some([one, two]) = pairs.into_iter().min_by(|&a, &b| distance(a).total_cmp(&distance(b))) else {
            return false;
        };
        let rank = |corner: usize| (!self.fixed[corner], corner);
        let [kept, gone] = if rank(one) < rank(two) { [one, two] } else { [two, one] };
        if distance([one, two]) >= NEAR * NEAR || self.fixed[gone] {
            return false;
        }
        for ring in self.faces.iter_mut().flat_map(|face| &mut face.1) {
            ring.iter_mut().filter(|corner| **corner == gone).for_each(|corner| *corner = kept);
        }
        self.part();
        true
    }

    /// Inserts a corner into the border from `a` to `b` on both sides, if the corner lies on it; returns true
    /// on success.
    fn divides(&mut self, [a, b, corner]: [usize; 3], out: DVec3) -> bool {
        let runs = |ring: &Vec<usize>, ends: [usize; 2]| edges(ring).filter(|border| *border == ends).count();
        let count = |ends: [usize; 2]| -> usize {
            self.faces.iter().flat_map(|face| &face.1).map(|ring| runs(ring, ends)).sum()
        };
        let (way, off) = (self.points[b] - self.points[a], self.points[corner] - self.points[a]);
        let along = off.dot(way) / way.length_squared();
        let beside = !(along > 0.0 && along < 1.0) || off.dot(out).abs() >= NEAR;
        if beside || count([a, b]) != 1 || count([b, a]) != 1 {
            return false;
        }
        for ring in self.faces.iter_mut().flat_map(|face| &mut face.1) {
            let at = edges(ring).position(|[from, to]| [from, to] == [a, b] || [from, to] == [b, a]);
            if let Some(at) = at {
                ring.insert(at + 1, corner);
            }
        }
        self.part();
        true
    }

    /// Moves a corner away from the opposite side, or an end of that side away from the corner; returns true
    /// if either may move.
    fn widens(&mut self, [a, b, corner]: [usize; 3], sliver: &Sliver) -> bool {
        let by = sliver.out * (NEAR - sliver.width);
        let distance = |end: usize| self.points[end].distance_squared(self.points[corner]);
        let ends = if distance(a) < distance(b) { [(a, -1.0), (b, -1.0)] } else { [(b, -1.0), (a, -1.0)] };
        let mut all = [(corner, 1.0)].into_iter().chain(ends);
        let Some((moved, side)) = all.find(|(moved, _)| !self.fixed[*moved]) else { return false };
        self.points[moved] += by * side;
        true
    }

    /// Splits faces that touch themselves, and removes those without area.
    fn part(&mut self) {
        let mut faces = Vec::with_capacity(self.faces.len());
        for (patch, mut rings) in std::mem::take(&mut self.faces) {
            if let [ring] = rings.as_mut_slice() {
                faces.extend(simple_rings(ring).into_iter().map(|ring| (patch, vec![ring])));
            } else {
                rings.iter_mut().for_each(|ring| ring.dedup());
                let from = rings[0].first().map_or(DVec3::ZERO, |corner| self.points[*corner]);
                let off = |corner: usize| self.points[corner] - from;
                let normal: DVec3 = edges(&rings[0]).map(|[a, b]| off(a).cross(off(b))).sum();
                let right = normal.any_orthogonal_vector().normalize_or_zero();
                let up = normal.normalize_or_zero().cross(right);
                let place = |corner: usize| DVec2::new(off(corner).dot(right), off(corner).dot(up));
                faces.extend(touching_parts(rings, place).into_iter().map(|rings| (patch, rings)));
            }
        }
        self.faces = faces;
    }

    /// Replaces `patches` by the patches with the repaired corners.
    fn finish(&self, patches: &mut Vec<Patch>) {
        let patch = |(patch, rings): &(usize, Vec<Vec<usize>>)| {
            let rings: Option<Vec<Ring<DVec3>>> =
                self.places(rings).into_iter().map(Ring::without_repeats).collect();
            Some(Patch { rings: rings?, ..patches[*patch].clone() })
        };
        *patches = self.faces.iter().filter_map(patch).collect();
    }
}
