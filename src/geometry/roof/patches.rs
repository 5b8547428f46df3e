//! The faces of a skeleton raised along a profile.

use glam::{DVec2, DVec3};

use super::super::skeleton::{Pace, Skeleton};
use super::shape::{Profile, between};
use super::{Patch, PatchKind};

/// Corners that are as near to a level of the profile as this (m) are on it.
const ON_LEVEL: f64 = 2e-3;

/// The peaks of a skeleton with their times (m); those near a level are on it.
pub(super) fn leveled(skeleton: &Skeleton, paces: &[Pace], profile: &Profile) -> Vec<DVec3> {
    let rests = paces.iter().map(|pace| pace.rest);
    let mut levels: Vec<f64> = profile.corners.iter().map(|corner| corner.x).chain(rests).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let snapped = |time: f64| {
        let above = levels.partition_point(|level| *level < time);
        let near = |index: usize| levels.get(index).copied().filter(|level| (level - time).abs() <= ON_LEVEL);
        let [low, high] = [above.checked_sub(1).and_then(near), near(above)];
        match (low, high) {
            (Some(low), Some(high)) if time - low < high - time => low,
            (low, high) => high.or(low).unwrap_or(time),
        }
    };
    skeleton.peaks.iter().map(|peak| peak.at.extend(snapped(peak.time))).collect()
}

/// The slopes, gables and steps of a roof over `skeleton` with the top of the walls at `base` (m).
///
/// They join without gaps: corners of neighbours are equal to the last bit. `points` are those of [`leveled`].
pub(super) fn patches(
    skeleton: &Skeleton,
    paces: &[Pace],
    profile: &Profile,
    base: f64,
    mut points: Vec<DVec3>,
) -> Vec<Patch> {
    let mut patches = Vec::with_capacity(skeleton.faces.len() * profile.corners.len());
    for (edge, (face, pace)) in skeleton.faces.iter().zip(paces).enumerate() {
        let along = (points[face[1]] - points[face[0]]).truncate().normalize_or_zero();
        let corners = with_rest(profile, pace);
        let mut pieces = vec![face.clone()];
        for (number, pair) in corners.windows(2).enumerate() {
            let flap = number.saturating_sub(profile.first);
            let [from, to] = [pair[0], pair[1]];
            let patch = |kind, ring| Patch { kind, edge, flap, along, rings: vec![ring] };
            if from.x >= to.x {
                for piece in &pieces {
                    let [a, b] = [points[piece[0]].truncate(), points[piece[1]].truncate()];
                    let [low, high] = [base + from.y, base + to.y];
                    let ring = vec![a.extend(low), b.extend(low), b.extend(high), a.extend(high)];
                    patches.push(patch(PatchKind::Fascia, ring));
                }
                continue;
            }
            let kind = match number {
                // The top of a border.
                0 if profile.first > 1 => PatchKind::Fascia,
                _ if pace.moves_at(from.x) => PatchKind::Slope,
                _ => PatchKind::Gable,
            };
            let last = number + 2 == corners.len();
            let mut above = Vec::new();
            for piece in pieces {
                let below = if last { piece } else { divide(&piece, to.x, &mut points, &mut above) };
                let raise = |&index: &usize| {
                    let point = points[index];
                    point.truncate().extend(base + between(from, to, point.z))
                };
                if below.len() > 2 {
                    patches.push(patch(kind, below.iter().map(raise).collect()));
                }
            }
            pieces = above;
        }
    }
    patches
}

/// The corners of the profile, and one where the edge begins to move.
fn with_rest(profile: &Profile, pace: &Pace) -> Vec<DVec2> {
    let mut corners = profile.corners.clone();
    if pace.speed > 0.0 && pace.rest > 0.0 {
        let rank = corners.partition_point(|corner| corner.x < pace.rest);
        if corners.get(rank).is_some_and(|corner| corner.x > pace.rest) {
            corners.insert(rank, DVec2::new(pace.rest, profile.height(pace.rest)));
        }
    }
    corners
}

/// The place between `low` and `high` at `level`, which is between theirs.
pub(super) fn at_level(low: DVec3, high: DVec3, level: f64) -> DVec3 {
    low.truncate().lerp(high.truncate(), (level - low.z) / (high.z - low.z)).extend(level)
}

/// The part of `piece` up to `level`; the parts beyond are added to `above`. Each begins with its lowest edge.
fn divide(piece: &[usize], level: f64, points: &mut Vec<DVec3>, above: &mut Vec<Vec<usize>>) -> Vec<usize> {
    let mut ring = Vec::with_capacity(piece.len() + 2);
    for (index, &a) in piece.iter().enumerate() {
        ring.push(a);
        let b = piece[(index + 1) % piece.len()];
        // From the same end for both neighbours, so that they agree to the last bit.
        let [low, high] =
            if points[a].z < points[b].z { [points[a], points[b]] } else { [points[b], points[a]] };
        if low.z < level && high.z > level {
            ring.push(points.len());
            points.push(at_level(low, high, level));
        }
    }
    let mut below = Vec::with_capacity(ring.len());
    let mut index = 0;
    while index < ring.len() {
        below.push(ring[index]);
        let mut end = index + 1;
        while end < ring.len() && points[ring[end]].z > level {
            end += 1;
        }
        if end > index + 1 {
            let mut part = vec![ring[end % ring.len()]];
            part.extend_from_slice(&ring[index..end]);
            above.push(part);
        }
        index = end;
    }
    below
}
