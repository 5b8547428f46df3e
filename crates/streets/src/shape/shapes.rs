//! Shapes of streets at junctions, computed once for all surfaces: corners, and the start of each street.

use glam::DVec2;
use smallvec::SmallVec;

use crate::plan::corner::{Arm, Corner, LINES};
use crate::plan::grid::foot;
use crate::plan::network::{JunctionId, PieceId, StreetNetwork};

/// Distance (m) below which points are merged, because the area between them would be a sliver.
pub(crate) const SAME: f64 = 0.02;
/// Radius (m) below which corners are sharp.
const LEAST_RADIUS: f64 = 0.1;
/// Distance (m) between the circle around a dead end and adjacent streets.
const BESIDE_CIRCLE: f64 = 0.5;

/// Shapes of all junctions of a network, by index.
pub(crate) struct StreetShapes<'a> {
    pub(crate) network: &'a StreetNetwork,
    junctions: Vec<JunctionShape>,
}

/// Shape of a junction.
#[derive(Debug, Clone, Default)]
pub(crate) struct JunctionShape {
    at: DVec2,
    /// Streets at the junction, counter-clockwise.
    pub(crate) arms: SmallVec<[ArmShape; 4]>,
    /// Set if a street only turns slightly or has a square end: there is no surface between its segments or beyond it.
    pub(crate) is_mitred: bool,
}

/// Street at a junction.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ArmShape {
    pub(crate) piece: PieceId,
    pub(crate) arm: Arm,
    /// Corner between this street and the next one counter-clockwise.
    pub(crate) corner: Corner,
    /// Distance (m) from the junction at which the street begins, beyond its corners.
    pub(crate) reach: f64,
    /// Additional distance (m) of the start per metre to the left.
    skew: f64,
}

impl ArmShape {
    /// Returns the distance (m) from the junction at which the street has its full width.
    pub(crate) fn clear(&self) -> f64 {
        if self.skew == 0.0 { self.reach } else { self.reach + self.skew.abs() * self.arm.half + BEHIND_SKEW }
    }
}

/// Distance (m) beyond a skew end at which a segment counts as having its full width.
const BEHIND_SKEW: f64 = 0.05;
/// Maximum fraction of the free length of a segment that each of its ends may take.
const SHARE: f64 = 0.45;
/// Maximum distance (m) of a row before the end of a skew segment.
const BEFORE_CLEAR: f64 = 1e-6;

impl ArmShape {
    /// Returns the minimum distance (m) from the junction for rows across the street, excluding the row at its end.
    pub(crate) fn first_row(&self) -> f64 {
        // A skew end is not perpendicular, so it does not count as the first row.
        if self.skew == 0.0 { self.reach + SAME } else { self.clear() - BEFORE_CLEAR }
    }
}

impl<'a> StreetShapes<'a> {
    /// Computes the shapes of `network`; dead ends get a circle of the radius `turning` (m) as far as there is space.
    pub(crate) fn new(network: &'a StreetNetwork, turning: f64) -> Self {
        #[allow(clippy::cast_possible_truncation, reason = "pieces are limited far below")]
        let count = network.junctions.len() as JunctionId;
        if network.has_existing() {
            let clear = network.clear_lengths();
            let junctions =
                (0..count).map(|junction| JunctionShape::with_existing(network, junction, &clear)).collect();
            return Self { network, junctions };
        }
        let junctions = (0..count).map(|junction| JunctionShape::new(network, junction, turning)).collect();
        let mut shapes = Self { network, junctions };
        shapes.change(|shape| shape.arms.iter().any(|arm| arm.corner.is_taper()), JunctionShape::shorten);
        shapes.change(|shape| shape.arms.len() == 2 && !shape.is_mitred, JunctionShape::bend);
        shapes.change(JunctionShape::has_uneven_bend, JunctionShape::curve_bends);
        shapes
    }

    /// Changes the selected junctions. `changed` receives the additional length (m) that they may take of each segment;
    /// it is negative if both ends of a segment need more than its length.
    fn change(
        &mut self,
        which: impl Fn(&JunctionShape) -> bool,
        changed: impl Fn(&JunctionShape, &[f64]) -> JunctionShape,
    ) {
        let which = (0..).zip(&self.junctions).filter(|(_, shape)| which(shape));
        let changed: Vec<(usize, JunctionShape)> = which
            .map(|(junction, shape)| {
                let share = |room: f64| if room > 0.0 { room * SHARE } else { room };
                let more: SmallVec<[f64; 4]> =
                    shape.arms.iter().map(|arm| share(self.clear_length(arm.piece))).collect();
                (junction, changed(shape, &more))
            })
            .collect();
        for (junction, shape) in changed {
            self.junctions[junction] = shape;
        }
    }

    pub(crate) fn junction(&self, junction: JunctionId) -> &JunctionShape {
        &self.junctions[junction as usize]
    }

    /// Returns a segment as it leaves a junction.
    pub(crate) fn arm(&self, junction: JunctionId, piece: PieceId) -> Option<&ArmShape> {
        self.junction(junction).arms.iter().find(|arm| arm.piece == piece)
    }

    /// Returns the length (m) of a segment with full width; 0 if its ends coincide.
    pub(crate) fn room(&self, piece: PieceId) -> f64 {
        let room = self.clear_length(piece);
        if room < SAME { 0.0 } else { room }
    }

    /// Returns the distance (m) between the ends of a segment; negative if they overlap.
    fn clear_length(&self, piece: PieceId) -> f64 {
        let clear = |end| self.arm(end, piece).map_or(0.0, ArmShape::clear);
        self.network.length(piece) - self.network.ends(piece).map(clear).iter().sum::<f64>()
    }

    /// Returns the end of a segment's line at a junction (m), `aside` (m) to the left of the centreline as it leaves.
    pub(crate) fn end(&self, junction: JunctionId, piece: PieceId, aside: f64) -> DVec2 {
        // If the corners at both ends take the whole segment, the ends coincide.
        let ends = self.network.ends(piece);
        let aside = if ends[0] == junction { aside } else { -aside };
        let both =
            [(ends[0], aside), (ends[1], -aside)].map(|(end, aside)| self.junction(end).end(piece, aside));
        let [a, b] = both.map(|(place, _)| place);
        match both.map(|(_, is_shared)| is_shared) {
            [false, false] if is_same(a, b) => a.midpoint(b),
            [true, false] if is_same(a, b) => a,
            [false, true] if is_same(a, b) => b,
            _ if ends[0] == junction => a,
            _ => b,
        }
    }

    /// Returns the edge and the kerb of the corner between an arm of a junction and the next one counter-clockwise,
    /// with the same number of points (m).
    ///
    /// Points that are almost equal are made exactly equal, and points at the ends of streets are exactly these ends.
    pub(crate) fn corner(&self, junction: JunctionId, index: usize) -> [Vec<DVec2>; 2] {
        let shape = self.junction(junction);
        let (arm, next) = (&shape.arms[index], &shape.arms[(index + 1) % shape.arms.len()]);
        let [mut edge, mut kerb] = LINES.map(|line| arm.corner.points(line));
        // A street without a sidewalk has a single line, so the points of both lines coincide.
        let farther = |arm: Arm, a: DVec2, b: DVec2| if arm.way.dot(a) >= arm.way.dot(b) { a } else { b };
        if arm.arm.walk < SAME {
            let begin = farther(arm.arm, edge[0], kerb[0]);
            edge.insert(0, begin);
            kerb.insert(0, begin);
        }
        if next.arm.walk < SAME {
            let last = edge.len() - 1;
            let end = farther(next.arm, edge[last], kerb[last]);
            edge.push(end);
            kerb.push(end);
        }
        for (edge, kerb) in edge.iter_mut().zip(&kerb) {
            if is_same(*edge, *kerb) {
                *edge = *kerb;
            }
        }
        for (line, points) in LINES.into_iter().zip([&mut edge, &mut kerb]) {
            for point in points.iter_mut() {
                *point += shape.at;
            }
            merge(self.end(junction, arm.piece, arm.arm.aside(line)), points.iter_mut());
            merge(self.end(junction, next.piece, -next.arm.aside(line)), points.iter_mut().rev());
        }
        // Merging may have moved a point of one line away from the same point of the other.
        for index in 0..edge.len() {
            let (a, b) = (edge[index], kerb[index]);
            if a != b && is_same(a, b) {
                kerb.iter_mut().filter(|point| **point == b).for_each(|point| *point = a);
            }
        }
        [edge, kerb]
    }
}

/// Merges each point with the previous one if they are almost equal; `first` precedes the points.
fn merge<'a>(first: DVec2, points: impl Iterator<Item = &'a mut DVec2>) {
    let mut before = first;
    for point in points {
        if is_same(*point, before) {
            *point = before;
        }
        before = *point;
    }
}

/// Returns the maximum radius (m), up to `turning`, of a circle around a dead end that touches neither other streets
/// nor their circles.
pub(crate) fn room_around(network: &StreetNetwork, dead_end: JunctionId, turning: f64) -> f64 {
    let at = network.at(dead_end);
    let streets = network.pieces_near([at; 2], turning + network.widest() / 2.0);
    let beside = streets
        .filter(|piece| !network.ends(*piece).contains(&dead_end))
        .map(|piece| foot(at, network.line(piece)).0 - network.half(piece));
    let ends = network.junctions_near([at; 2], 2.0 * turning);
    let others = ends
        .filter(|other| *other != dead_end && network.junctions[*other as usize].degree() == 1)
        .map(|other| network.at(other).distance(at) / 2.0);
    beside.chain(others).map(|room| room - BESIDE_CIRCLE).fold(turning, f64::min)
}

impl JunctionShape {
    fn new(network: &StreetNetwork, junction: JunctionId, turning: f64) -> Self {
        let at = network.at(junction);
        let arms = network.corner_arms(junction);
        if let [(piece, arm)] = arms[..] {
            // The circle leaves space for the corners at the other end of the segment, or for the circle there.
            let far = network.across(piece, junction);
            let room = match network.junctions[far as usize].degree() {
                1 => network.length(piece) * 0.45,
                _ => (network.length(piece) - network.reach_at(far, piece)) * 0.9,
            };
            let radius = turning.min(room.hypot(arm.half)).min(room_around(network, junction, turning));
            let corner = Corner::around(arm, radius);
            let arm = ArmShape { piece, arm, corner, reach: corner.reaches[0], skew: 0.0 };
            let is_square = network.constraints.square_ends && arm.reach == 0.0;
            return Self { at, arms: SmallVec::from_iter([arm]), is_mitred: is_square };
        }
        let count = arms.len();
        let radius = network.constraints.corner;
        let radius = if radius < LEAST_RADIUS { 0.0 } else { radius };
        let corners: SmallVec<[Corner; 4]> = (0..count)
            .map(|index| Corner::new([arms[index].1, arms[(index + 1) % count].1], radius))
            .collect();
        let is_mitred = count == 2 && corners.iter().all(Corner::is_sharp);
        let shapes = arms.iter().enumerate().map(|(index, &(piece, arm))| {
            let (corner, before) = (corners[index], corners[(index + count - 1) % count]);
            let (reach, skew) = if is_mitred {
                (0.0, 1.0 / (corner.angle / 2.0).tan())
            } else {
                (corner.reaches[0].max(before.reaches[1]), 0.0)
            };
            ArmShape { piece, arm, corner, reach, skew }
        });
        Self { at, arms: shapes.collect(), is_mitred }
    }

    /// Computes a junction of a network with existing streets: each segment begins beyond the overlap with others,
    /// without its own corner.
    fn with_existing(network: &StreetNetwork, junction: JunctionId, clear: &[[f64; 2]]) -> Self {
        let at = network.at(junction);
        let arms = network.corner_arms(junction);
        let count = arms.len();
        let reach = |piece: PieceId| {
            let [first, last] = clear[piece as usize];
            let [begin, end] = network.ends(piece);
            let room = network.length(piece) - first - last;
            let own = if begin == junction { first } else { last };
            let is_corner = |end: JunctionId| network.junctions[end as usize].degree() > 2;
            let share = if is_corner(begin) && is_corner(end) { 0.5 } else { 1.0 };
            let corner = if count > 2 { network.constraints.corner.min(room * share * SHARE) } else { 0.0 };
            own + corner.max(0.0)
        };
        let is_mitred = network.goes_on(junction) && arms.iter().all(|(piece, _)| reach(*piece) == 0.0);
        let is_mitred = is_mitred || (count == 1 && network.constraints.square_ends);
        let shapes = arms.iter().enumerate().map(|(index, &(piece, arm))| {
            let corner = Corner::new([arm, arms[(index + 1) % count].1], 0.0);
            let skew = if is_mitred && count == 2 { 1.0 / (corner.angle / 2.0).tan() } else { 0.0 };
            ArmShape { piece, arm, corner, reach: reach(piece), skew }
        });
        Self { at, arms: shapes.collect(), is_mitred }
    }

    /// Returns the shape with shorter tapers where `more` (m) is negative.
    fn shorten(&self, more: &[f64]) -> Self {
        let mut shorter = self.clone();
        let count = self.arms.len();
        for index in 0..count {
            let less = [index, (index + 1) % count].map(|arm| (-more[arm]).max(0.0));
            shorter.arms[index].corner = self.arms[index].corner.shorten(less);
        }
        for index in 0..count {
            let before = shorter.arms[(index + count - 1) % count].corner.reaches[1];
            shorter.arms[index].reach = shorter.arms[index].corner.reaches[0].max(before);
        }
        shorter
    }

    /// Returns the shape of a turning street, with up to `more` (m) of both segments for the transition of its kerbs
    /// between widths.
    fn bend(&self, more: &[f64]) -> Self {
        let mut reaches = [0, 1].map(|arm| self.arms[arm].reach);
        for arm in 0..2 {
            // The second corner is between the second arm and the first.
            if let Some(mut taper) = self.arms[arm].corner.taper() {
                taper.rotate_left(arm);
                reaches =
                    [0, 1].map(|arm| reaches[arm] + (taper[arm] - reaches[arm]).min(more[arm]).max(0.0));
            }
        }
        let mut bent = self.clone();
        for (arm, shape) in bent.arms.iter_mut().enumerate() {
            shape.reach = reaches[arm];
            shape.corner = shape.corner.of_bend([reaches[arm], reaches[1 - arm]]);
        }
        bent
    }

    /// Returns true if more than two streets meet, and two of them with different widths enclose the outside of a bend.
    fn has_uneven_bend(&self) -> bool {
        self.arms.len() > 2 && self.arms.iter().any(|arm| arm.corner.is_uneven_bend())
    }

    /// Returns the shape of a junction of more than two streets, with up to `more` (m) of their segments for kerb
    /// transitions around the outside of bends.
    fn curve_bends(&self, more: &[f64]) -> Self {
        let mut curved = self.clone();
        let bends = || (0..self.arms.len()).filter(|index| self.arms[*index].corner.is_uneven_bend());
        let both = |index: usize| [index, (index + 1) % self.arms.len()];
        for index in bends() {
            for (arm, wanted) in both(index).into_iter().zip(self.arms[index].corner.around_bend()) {
                let reach = self.arms[arm].reach + (wanted - self.arms[arm].reach).min(more[arm]).max(0.0);
                curved.arms[arm].reach = curved.arms[arm].reach.max(reach);
            }
        }
        for index in bends() {
            let reaches = both(index).map(|arm| curved.arms[arm].reach);
            curved.arms[index].corner = self.arms[index].corner.of_bend(reaches);
        }
        curved
    }

    /// Returns the end of a segment's line (m), and true if another segment begins there too.
    fn end(&self, piece: PieceId, aside: f64) -> (DVec2, bool) {
        let place = |arm: &ArmShape, aside: f64| {
            self.at + arm.arm.way * (arm.reach + aside * arm.skew) + arm.arm.way.perp() * aside
        };
        // Both segments of a mitre use the first one's computation, so their ends are exactly equal.
        if let [first, second] = &self.arms[..]
            && self.is_mitred
        {
            return (place(first, if second.piece == piece { -aside } else { aside }), true);
        }
        let Some(index) = self.arms.iter().position(|arm| arm.piece == piece) else {
            return (self.at, false);
        };
        let at = place(&self.arms[index], aside);
        // If a corner takes no length, two streets begin at one point, which is taken from the first.
        let (count, is_first) = (self.arms.len(), aside > 0.0);
        let beside = &self.arms[(index + if is_first { 1 } else { count - 1 }) % count];
        let of_beside = LINES.map(|line| place(beside, beside.arm.aside(line) * -aside.signum()));
        match of_beside.into_iter().find(|other| aside != 0.0 && is_same(at, *other)) {
            Some(other) => (if is_first { at } else { other }, true),
            None => (at, false),
        }
    }
}

/// Removes points that repeat the previous one, including across the end of the ring.
pub(crate) fn without_repeats<T: Copy>(ring: &mut Vec<T>, is_same: impl Fn(T, T) -> bool) {
    ring.dedup_by(|a, b| is_same(*a, *b));
    while ring.len() > 1 && is_same(ring[0], ring[ring.len() - 1]) {
        ring.pop();
    }
}

/// Returns true if two points are almost equal.
pub(crate) fn is_same(a: DVec2, b: DVec2) -> bool {
    a.distance(b) < SAME
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::constraints::Constraints;
    use crate::plan::network::StreetAttributes;
    use crate::plan::obstacles::Obstacles;
    use crate::shape::profile::StreetProfiles;
    use crate::surface::parts::SurfaceOptions;
    use crate::tests::grown;

    #[test]
    fn circles_around_dead_ends_meet_no_other_street() {
        let mut shortened = 0;
        for (seed, turning) in (1..=20).flat_map(|seed| [(seed, 14.0), (seed, 100.0)]) {
            let network = grown(seed, 150, Constraints::default(), Obstacles::default());
            let shapes = StreetShapes::new(&network, turning);
            let circle = |end: JunctionId| -> f64 {
                let arm = shapes.junction(end).arms[0];
                arm.reach.hypot(arm.arm.half)
            };
            let ends: Vec<JunctionId> = network.dead_ends().collect();
            for &end in &ends {
                let (at, radius) = (network.at(end), circle(end));
                shortened += usize::from(radius < turning - 1e-9);
                let half = shapes.junction(end).arms[0].arm.half;
                if radius <= half + 1e-9 {
                    continue;
                }
                for (piece, _) in network.pieces().filter(|(piece, _)| !network.ends(*piece).contains(&end)) {
                    assert!(
                        foot(at, network.line(piece)).0 >= radius + network.half(piece),
                        "seed {seed}: {end}"
                    );
                }
                for &other in ends.iter().filter(|other| **other != end) {
                    assert!(
                        network.at(other).distance(at) >= radius + circle(other),
                        "seed {seed}: {end}, {other}"
                    );
                }
            }
        }
        assert!(shortened > 100, "{shortened} circles had less room");
    }

    #[test]
    fn a_square_end_has_no_circle_and_no_walk_around_it() {
        let end_of = |square_ends| {
            let constraints = Constraints { square_ends, ..Constraints::default() };
            let mut network = StreetNetwork::new(constraints, Obstacles::default()).expect("a network");
            let start = network.begin(DVec2::ZERO).expect("a start");
            network.grow(start, DVec2::new(100.0, 0.0), StreetAttributes::default()).expect("a street");
            let surfaces = network.surfaces(SurfaceOptions::default(), &StreetProfiles::default());
            let edges = surfaces.sidewalks.iter().flat_map(|walk| walk.edge.iter().chain(&walk.kerb));
            (surfaces.carriageways.len(), edges.map(|at| at.x).fold(0.0, f64::max))
        };
        let half = StreetAttributes::default().width / 2.0;
        let (surfaces, far) = end_of(false);
        assert!(surfaces == 3 && (far - 100.0 - half).abs() < 1e-9, "{surfaces} surfaces, {far} m");
        assert_eq!(end_of(true), (1, 100.0));
    }
}
