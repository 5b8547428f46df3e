//! Part of a lot for a row of adjoining buildings: the lot up to a depth behind its front, minus a joint along its
//! border.

use glam::DVec2;

use super::divide::Lot;
use super::fine::{self, FinePlace};
use burgeon_geometry::{Polygon, Rings, planar};

/// Maximum displacement of a corner, as a multiple of the inset distance.
const SHARP: f64 = 4.0;

impl Lot {
    /// Returns the parts of the lot that are at least `joint` (m) inside its border and at most `depth` (m) behind its
    /// front; empty if the lot has no front. Parts of different lots do not touch.
    pub fn row(&self, depth: f64, joint: f64) -> Vec<Polygon> {
        if self.fronts.is_empty() {
            return Vec::new();
        }
        let inwards = -self.facing;
        let last = self.access.dot(inwards) + depth;
        let left = match inset_area(&self.rings, joint) {
            Some(part) => vec![part],
            None => Polygon::new(self.rings.clone()).map(|whole| whole.inset(joint)).unwrap_or_default(),
        };
        left.into_iter().flat_map(|part| part_before(part, inwards, last)).collect()
    }
}

/// Insets a single ring by `distance` (m) if all edges remain and none intersect; otherwise returns `None`.
fn inset_area(rings: &Rings<DVec2>, distance: f64) -> Option<Polygon> {
    let [ring] = &rings[..] else { return None };
    let count = ring.len();
    let ways: Option<Vec<DVec2>> = planar::edges(ring).map(|[a, b]| (b - a).try_normalize()).collect();
    let ways = ways?;
    let corner = |index: usize| {
        let [before, here] = [ways[(index + count - 1) % count], ways[index]];
        // The sum of both normals has the direction in which the corner moves.
        let sum = 1.0 + before.dot(here);
        (sum > 2.0 / (SHARP * SHARP)).then(|| ring[index] + (before + here).perp() * (distance / sum))
    };
    let moved: Vec<DVec2> = (0..count).map(corner).collect::<Option<_>>()?;
    let stays = |index: usize| (moved[(index + 1) % count] - moved[index]).dot(ways[index]) > 0.0;
    let fine: Vec<FinePlace> = moved.iter().map(|at| FinePlace::nearest(*at)).collect::<Option<_>>()?;
    ((0..count).all(stays) && fine::are_simple(&[fine])).then(|| Polygon::new(Rings(vec![moved])).ok())?
}

/// Returns the parts of a polygon up to the coordinate `last` (m) along a direction.
fn part_before(part: Polygon, way: DVec2, last: f64) -> Vec<Polygon> {
    let beyond = |at: &DVec2| at.dot(way) > last;
    let count = part.points().filter(beyond).count();
    if count == 0 {
        return vec![part];
    } else if count == part.size() {
        return Vec::new();
    }
    let crossings = part.edges().filter(|[a, b]| beyond(a) != beyond(b)).count();
    if crossings == 2 && part.holes().is_empty() {
        let mut ring = Vec::with_capacity(part.size() + 2);
        for [a, b] in part.edges() {
            if !beyond(&a) {
                ring.push(a);
            }
            if beyond(&a) != beyond(&b) {
                let [from, to] = [a, b].map(|end| end.dot(way));
                let place = a.lerp(b, (last - from) / (to - from));
                if ring.last() != Some(&place) && ring.first() != Some(&place) {
                    ring.push(place);
                }
            }
        }
        return Polygon::new(Rings(vec![ring])).into_iter().collect();
    }
    let Some([low, high]) = part.bounds() else { return Vec::new() };
    let size = (high - low).length() + 1.0;
    let from = way * last + way.perp() * way.perp().dot((low + high) / 2.0);
    let corners = [(0.0, size), (0.0, -size), (size, -size), (size, size)];
    let ring = corners.into_iter().map(|(along, aside)| from + way * along + way.perp() * aside);
    match Polygon::turned(Rings(vec![ring.collect()])) {
        Ok(behind) => part.without(&[behind]),
        Err(_) => Vec::new(),
    }
}
