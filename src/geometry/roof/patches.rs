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
/// They join without gaps: corners of neighbours are equal to the last bit. `points` are those of [`leveled`]. What is
/// upright below a slope beyond the walls is left out.
pub(super) fn patches(
    faces: &[Vec<usize>],
    paces: &[Pace],
    profile: &Profile,
    base: f64,
    mut points: Vec<DVec3>,
) -> Vec<Patch> {
    let mut patches = Vec::with_capacity(faces.len() * profile.corners.len());
    for (edge, (face, pace)) in faces.iter().zip(paces).enumerate() {
        let along = (points[face[1]] - points[face[0]]).truncate().normalize_or_zero();
        let spans = spans(profile, pace);
        let first = profile.first + usize::from(pace.rest > 0.0 && pace.rest < profile.beyond());
        let mut pieces = vec![face.clone()];
        for (number, &Span { line: [from, to], low, high }) in spans.iter().enumerate() {
            let flap = number.saturating_sub(first);
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
                _ if pace.moves_at(low) => PatchKind::Slope,
                _ => PatchKind::Gable,
            };
            let last = number + 1 == spans.len();
            let is_eaves = kind == PatchKind::Gable && pace.moves_at(profile.beyond());
            let mut above = Vec::new();
            for piece in pieces {
                let below = if last { piece } else { divide(&piece, high, &mut points, &mut above) };
                let raise = |&index: &usize| {
                    let point = points[index];
                    point.truncate().extend(base + between(from, to, point.z))
                };
                if below.len() > 2 && !is_eaves {
                    patches.push(patch(kind, below.iter().map(raise).collect()));
                }
            }
            pieces = above;
        }
    }
    patches
}

/// A part of a profile's interval.
struct Span {
    /// The ends of the interval.
    line: [DVec2; 2],
    /// From where to where (m from the outline) the part goes.
    low: f64,
    high: f64,
}

/// The intervals of the profile, divided where the edge begins to move.
fn spans(profile: &Profile, pace: &Pace) -> Vec<Span> {
    let mut spans = Vec::with_capacity(profile.corners.len());
    for pair in profile.corners.windows(2) {
        let (line, low, high) = ([pair[0], pair[1]], pair[0].x, pair[1].x);
        if pace.speed > 0.0 && low < pace.rest && pace.rest < high {
            spans.extend([[low, pace.rest], [pace.rest, high]].map(|[low, high]| Span { line, low, high }));
        } else {
            spans.push(Span { line, low, high });
        }
    }
    spans
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
