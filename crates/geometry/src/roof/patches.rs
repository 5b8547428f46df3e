//! Faces of a skeleton, raised along a profile.

use glam::{DVec2, DVec3};

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::super::skeleton::{Pace, Skeleton};
use super::levels::{at_level, is_at};
use super::overhang::Rake;
use super::shape::{Profile, interpolate};
use super::{Patch, PatchKind};
use crate::planar::edges;

/// Distance (m) below which corners are snapped to a level of the profile.
const ON_LEVEL: f64 = 2e-3;

/// Returns the peaks of a skeleton with their times (m) as heights, snapped to nearby levels.
pub(super) fn level_peaks(skeleton: &Skeleton, paces: &[Pace], profile: &Profile) -> Vec<DVec3> {
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

/// Returns the slopes, gables and steps of a roof over `skeleton`, with the top of the walls at `base` (m).
///
/// They join without gaps: corners of neighbours are equal to the last bit. `points` are those of
/// [`leveled`]. Upright faces below a slope beyond the walls are omitted, and so are gables over edges with a
/// `rake`.
pub(super) fn patches(
    faces: &[Vec<usize>],
    paces: &[Pace],
    profile: &Profile,
    base: f64,
    mut points: Vec<DVec3>,
    rakes: &[Option<Rake>],
) -> Vec<Patch> {
    let spans: Vec<Spans> = paces.iter().map(|pace| spans(profile, pace)).collect();
    let pieces = cut(faces, &spans, &mut points);
    let mut patches = Vec::with_capacity(pieces.len());
    let mut rest = pieces.as_slice();
    for (edge, (face, pace)) in faces.iter().zip(paces).enumerate() {
        let along = (points[face[1]] - points[face[0]]).truncate().normalize_or_zero();
        let lowest = profile.first + usize::from(pace.rest > 0.0 && pace.rest < profile.plate_overhang());
        for (number, &ProfileSpan { line: [from, to], low, .. }) in spans[edge].iter().enumerate() {
            let flap = number.saturating_sub(lowest);
            let patch = |kind, ring| Patch::new(kind, edge, flap, along, ring);
            let is_step = spans[edge][number].is_step();
            let count = rest
                .partition_point(|piece| (piece.edge, piece.number) <= (edge, number + usize::from(is_step)));
            if is_step {
                // The faces above the step begin along it.
                for [a, b] in rest[..count].iter().flat_map(|piece| edges(&piece.ring)) {
                    let [a, b] = [points[a], points[b]];
                    if is_at(a, from.x) && is_at(b, from.x) {
                        let ([a, b], [low, high]) =
                            ([a.truncate(), b.truncate()], [base + from.y, base + to.y]);
                        let ring = vec![a.extend(low), b.extend(low), b.extend(high), a.extend(high)];
                        patches.extend(patch(PatchKind::Fascia, ring));
                    }
                }
                continue;
            }
            let kind = match number {
                // The top of a border.
                0 if profile.first > 1 => PatchKind::Fascia,
                _ if pace.moves_at(low) => PatchKind::Slope,
                _ => PatchKind::Gable,
            };
            let raise = |&index: &usize| {
                let point = points[index];
                point.truncate().extend(base + interpolate(from, to, point.z))
            };
            // The lowest part represents a gable that is drawn elsewhere, so that its position is known.
            let is_left_out = kind == PatchKind::Gable
                && (pace.moves_at(profile.plate_overhang()) || rakes[edge].is_some());
            for piece in rest[..count].iter().filter(|_| !is_left_out) {
                patches.extend(patch(kind, piece.ring.iter().map(raise).collect()));
            }
            rest = &rest[count..];
        }
    }
    patches
}

/// Divides all faces at the levels of their spans; returns the pieces by edge and span. A border crosses a
/// level in one point for both neighbours.
fn cut(faces: &[Vec<usize>], spans: &[Spans], points: &mut Vec<DVec3>) -> Vec<FacePiece> {
    let mut passes = FxHashMap::default();
    let mut all = Vec::with_capacity(faces.len());
    for (edge, face) in faces.iter().enumerate() {
        let mut pieces = vec![face.clone()];
        for (number, span) in spans[edge].iter().enumerate().filter(|(_, span)| !span.is_step()) {
            let last = number + 1 == spans[edge].len();
            let mut above = Vec::new();
            for piece in pieces {
                let ring =
                    if last { piece } else { divide(&piece, span.high, points, &mut passes, &mut above) };
                if ring.len() > 2 {
                    all.push(FacePiece { edge, number, ring });
                }
            }
            pieces = above;
        }
    }
    all
}

/// A part of a face.
struct FacePiece {
    /// Index of the edge of the outline that it belongs to.
    edge: usize,
    /// Index of the profile span that contains it.
    number: usize,
    /// Corners, counter-clockwise.
    ring: Vec<usize>,
}

type Spans = SmallVec<[ProfileSpan; 4]>;

/// A part of an interval of a profile.
struct ProfileSpan {
    /// Ends of the interval.
    line: [DVec2; 2],
    /// Lower and upper limit of the part (m from the outline).
    low: f64,
    high: f64,
}

impl ProfileSpan {
    /// Returns true if the interval is upright.
    fn is_step(&self) -> bool {
        self.line[0].x >= self.line[1].x
    }
}

/// Returns the intervals of the profile, divided where the edge begins to move.
fn spans(profile: &Profile, pace: &Pace) -> Spans {
    let mut spans = Spans::new();
    for pair in profile.corners.windows(2) {
        let (line, low, high) = ([pair[0], pair[1]], pair[0].x, pair[1].x);
        if pace.speed > 0.0 && low < pace.rest && pace.rest < high {
            spans.extend([[low, pace.rest], [pace.rest, high]].map(|[low, high]| ProfileSpan {
                line,
                low,
                high,
            }));
        } else {
            spans.push(ProfileSpan { line, low, high });
        }
    }
    spans
}

/// Returns the part of `piece` up to `level`, and adds the parts beyond to `above`. Each begins with its
/// lowest edge.
fn divide(
    piece: &[usize],
    level: f64,
    points: &mut Vec<DVec3>,
    passes: &mut FxHashMap<[usize; 2], usize>,
    above: &mut Vec<Vec<usize>>,
) -> Vec<usize> {
    let mut ring = Vec::with_capacity(piece.len() + 2);
    for [a, b] in edges(piece) {
        ring.push(a);
        let [low, high] = if points[a].z < points[b].z { [a, b] } else { [b, a] };
        if points[low].z < level && points[high].z > level {
            ring.push(*passes.entry([low, high]).or_insert_with(|| {
                points.push(at_level(points[low], points[high], level));
                points.len() - 1
            }));
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
