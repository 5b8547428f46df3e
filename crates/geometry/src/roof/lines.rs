//! Lines of a roof for the placement of objects: ridges, hips, valleys and eaves.

use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

use super::{Patch, PatchKind};
use crate::planar::Ring;

/// Type of a roof line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RoofLineKind {
    /// Nearly level line from which both slopes fall to opposite sides.
    Ridge,
    /// Line from which both slopes fall, as over a corner.
    Hip,
    /// Line from which both slopes rise.
    Valley,
    /// Lower edge of a roof.
    Eaves,
}

/// A line of a roof.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoofLine {
    /// Type of the line.
    pub kind: RoofLineKind,
    /// Ends (m); eaves run to the right as seen from outside, hips and valleys upwards.
    pub ends: [DVec3; 2],
    /// Upward normals of the slopes to the left and to the right; equal for eaves.
    pub normals: [DVec3; 2],
}

impl RoofLine {
    /// Returns the line of two parts, if the second one continues the first one.
    fn join(&self, other: &Self) -> Option<Self> {
        let way = |line: &Self| (line.ends[1] - line.ends[0]).normalize_or_zero();
        let is_straight = self.kind == other.kind && way(self).dot(way(other)) > 1.0 - 1e-9;
        let ends = match (self.ends, other.ends) {
            ([from, a], [b, to]) if is_straight && a == b => [from, to],
            ([a, to], [from, b]) if is_straight && a == b => [from, to],
            _ => return None,
        };
        Some(Self { ends, ..*self })
    }
}

/// Cosine of the angle between the directions of the parts of one slope.
const ALIKE: f64 = 0.999;
/// Maximum gradient of a nearly level line.
const LEVEL: f64 = 0.2;

/// Returns the lines of a roof, in the order of its patches.
///
/// ```
/// use burgeon_geometry::roof::{Eaves, Ends, Rise, RoofLineKind, RoofShape, RoofSurface, lines};
/// use burgeon_geometry::{Polygon, Rings};
/// use glam::DVec2;
///
/// let walls = [(0.0, 0.0), (12.0, 0.0), (12.0, 8.0), (0.0, 8.0)].map(DVec2::from);
/// let walls = Polygon::new(Rings(vec![walls.to_vec()]))?;
/// let surface = RoofSurface::Sloped(Ends::Hips, &[]);
/// let roof = RoofShape { surface, rise: Rise::Slope(1.0), overhang: 0.0, eaves: Eaves::Closed, slab: 0.0 };
/// let lines = lines(&roof.cover(&walls, 3.0)?.patches);
/// let count = |kind| lines.iter().filter(|line| line.kind == kind).count();
/// assert_eq!([RoofLineKind::Ridge, RoofLineKind::Hip, RoofLineKind::Eaves].map(count), [1, 4, 4]);
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
pub fn lines(patches: &[Patch]) -> Vec<RoofLine> {
    let key = |at: DVec3| at.as_vec3().to_array().map(f32::to_bits);
    let mut owner = FxHashMap::default();
    let slopes = || patches.iter().enumerate().filter(|(_, patch)| patch.kind == PatchKind::Slope);
    for (number, patch) in slopes() {
        for [a, b] in patch.rings.iter().flat_map(Ring::edges) {
            owner.insert((key(a), key(b)), number);
        }
    }
    let mut lines: Vec<RoofLine> = Vec::new();
    for (number, patch) in slopes() {
        let normal = normal(patch);
        // Lines of this patch, by the patch on the other side.
        let mut own: Vec<(usize, usize)> = Vec::new();
        // Every edge of a level roof is a lowest edge.
        let is_level = normal.z > 1.0 - 1e-9;
        for [a, b] in patch.rings.iter().flat_map(Ring::edges) {
            match owner.get(&(key(b), key(a))) {
                Some(&other) if other > number && are_slopes(patch, &patches[other]) => {
                    let away = normal.cross((b - a).normalize_or_zero());
                    // The area to the right of the edge belongs to the other slope.
                    let across = self::normal(&patches[other]);
                    let bend = across.dot(-away);
                    let opposite = patch.along.dot(patches[other].along) < -0.5;
                    let level = opposite && (b.z - a.z).abs() <= LEVEL * a.truncate().distance(b.truncate());
                    let kind = match (bend < 0.0, level) {
                        (true, _) => RoofLineKind::Valley,
                        (false, true) => RoofLineKind::Ridge,
                        (false, false) => RoofLineKind::Hip,
                    };
                    let (ends, normals) = if b.z < a.z - 1e-9 {
                        ([b, a], [across, normal])
                    } else {
                        ([a, b], [normal, across])
                    };
                    if bend.abs() <= 1e-3 {
                        continue;
                    }
                    let line = RoofLine { kind, ends, normals };
                    let known = own.iter().filter(|(beside, _)| *beside == other);
                    let joined =
                        known.copied().find_map(|(_, index)| Some((index, lines[index].join(&line)?)));
                    if let Some((index, longer)) = joined {
                        lines[index] = longer;
                    } else {
                        own.push((other, lines.len()));
                        lines.push(line);
                    }
                }
                None if patch.flap == 0 && (is_level || direction(a, b).dot(patch.along) > 0.99) => {
                    lines.push(RoofLine { kind: RoofLineKind::Eaves, ends: [a, b], normals: [normal; 2] });
                }
                _ => {}
            }
        }
    }
    lines
}

/// Returns true if two patches are different slopes, and not parts of one slope.
fn are_slopes(one: &Patch, other: &Patch) -> bool {
    // Roofs with one ridge or an apex number no edges.
    one.edge != other.edge || (one.flap == other.flap && one.along.dot(other.along) < ALIKE)
}

fn direction(a: DVec3, b: DVec3) -> DVec2 {
    (b - a).truncate().normalize_or_zero()
}

/// Returns the unit normal of a patch, which points upwards for slopes.
pub fn normal(patch: &Patch) -> DVec3 {
    let sum = patch.rings.iter().flat_map(|ring| {
        let from = ring[0];
        ring.windows(2).map(move |pair| (pair[0] - from).cross(pair[1] - from))
    });
    sum.sum::<DVec3>().normalize_or_zero()
}
