//! Roofs of one slope.

use glam::{DVec2, DVec3};

use super::{Patch, PatchKind, edges};

/// Heights (m) below this are none.
const LOWEST: f64 = 2e-3;

/// A roof of one slope over walls that end at `base` (m): highest over the longest edge, with nothing added at the
/// place furthest from it. `outer` is the outline of the roof, as many edges as the walls.
///
/// `rise` gives the height (m) at that edge for the distance (m) between the two.
pub(super) fn patches(
    walls: &[Vec<DVec2>],
    outer: &[Vec<DVec2>],
    rise: impl Fn(f64) -> f64,
    base: f64,
    slab: f64,
) -> Vec<Patch> {
    let longest =
        walls.first().into_iter().flat_map(|ring| edges(ring)).fold([DVec2::ZERO; 2], |best, edge| {
            let [a, b] = [best, edge].map(|[from, to]| from.distance(to));
            if b > a + 1e-6 { edge } else { best }
        });
    let inward = (longest[1] - longest[0]).normalize_or_zero().perp();
    let depth = |at: DVec2| inward.dot(at - longest[0]);
    let (near, far) = walls.iter().flatten().fold((f64::INFINITY, f64::NEG_INFINITY), |(near, far), &at| {
        (near.min(depth(at)), far.max(depth(at)))
    });
    let slope = rise(far - near) / (far - near).max(1e-9);
    let height = |at: DVec2| slope * (far - depth(at));
    let juts_out = walls != outer;
    // Under a plate the walls end below it, otherwise they go on to its top.
    let wall_top = |at: DVec2| {
        let height = height(at) + if juts_out { 0.0 } else { slab };
        at.extend(base + if height < LOWEST { 0.0 } else { height })
    };
    let under = |at: DVec2| at.extend(base + height(at));
    let top = |at: DVec2| if juts_out { at.extend(base + height(at) + slab) } else { wall_top(at) };

    let rings = outer.iter().map(|ring| ring.iter().map(|&at| top(at)).collect()).collect();
    // Along the eaves, which are opposite.
    let along = longest[0] - longest[1];
    let mut patches =
        vec![Patch { kind: PatchKind::Slope, edge: 0, flap: 0, along: along.normalize_or_zero(), rings }];
    let pairs = walls.iter().flat_map(|ring| edges(ring)).zip(outer.iter().flat_map(|ring| edges(ring)));
    for (edge, ([a, b], [c, d])) in pairs.enumerate() {
        let along = (b - a).normalize_or_zero();
        let mut push = |kind, corners: Vec<DVec3>| {
            let ring = without_repeats(corners);
            if ring.len() > 2 {
                patches.push(Patch { kind, edge, flap: 0, along, rings: vec![ring] });
            }
        };
        push(PatchKind::Gable, vec![a.extend(base), b.extend(base), wall_top(b), wall_top(a)]);
        if juts_out {
            push(PatchKind::Underside, vec![under(d), under(c), wall_top(a), wall_top(b)]);
            push(PatchKind::Fascia, vec![under(c), under(d), top(d), top(c)]);
        }
    }
    patches
}

/// The ring without corners that repeat the one before.
pub(super) fn without_repeats(mut ring: Vec<DVec3>) -> Vec<DVec3> {
    ring.dedup();
    if ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    ring
}
