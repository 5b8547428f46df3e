//! Faces below a roof: undersides, the faces along the outline, and gables.

use glam::{DVec2, DVec3};

use super::levels::at_level;
use super::plate::{border, part};
use super::shape::Profile;
use super::support::divide_feet;
use super::{Patch, PatchKind};
use crate::planar::{Polygon, Ring};

/// Minimum distance (m) of roof points beyond a wall.
const CLEAR: f64 = 5e-3;

/// The outline of a roof, relative to the outline of the walls below.
pub(super) struct Rim<'a> {
    pub walls: &'a Polygon,
    /// Outline of the roof, with the same number of edges as the walls.
    pub outer: &'a Polygon,
    pub profile: &'a Profile,
    /// Height (m) of the top of the walls.
    pub base: f64,
    /// Maximum distance (m) of the outline from the walls.
    pub overhang: f64,
    /// Overhang (m) over each edge.
    pub distances: &'a [f64],
    /// Height (m) of the faces along the outline.
    pub slab: f64,
}

/// Faces of a skeleton with corners where they reach the walls, as computed by [`super::plate::at_walls`].
#[derive(Clone, Copy)]
pub(super) struct SkeletonFaces<'a> {
    pub rings: &'a [Vec<usize>],
    /// Corners (m), with the distances from the outline as heights.
    pub points: &'a [DVec3],
}

/// Ends of two slopes with an overhang over a gable: first the left one as seen from outside.
#[derive(Debug, Clone)]
pub(super) struct Rake([SlopeSide; 2]);

/// Points of a slope's end from the eaves up to the ridge, with their distances from the outline as heights.
#[derive(Debug, Clone)]
struct SlopeSide {
    /// Points along the outline of the roof, from its corner on.
    outer: Vec<DVec3>,
    /// Points along the wall, from its corner on.
    wall: Vec<DVec3>,
}

/// Position of an edge in its ring.
struct RingPlace {
    ring: usize,
    index: usize,
    count: usize,
    first: usize,
}

impl RingPlace {
    fn previous_edge(&self) -> usize {
        self.first + (self.index + self.count - 1) % self.count
    }

    fn next_edge(&self) -> usize {
        self.first + (self.index + 1) % self.count
    }

    fn ends(&self, polygon: &Polygon) -> [DVec2; 2] {
        let ring = &polygon[self.ring];
        [ring[self.index], ring[(self.index + 1) % self.count]]
    }
}

impl Rim<'_> {
    fn place(&self, edge: usize) -> RingPlace {
        let mut first = 0;
        for (ring, corners) in self.walls.iter().enumerate() {
            if edge < first + corners.len() {
                return RingPlace { ring, index: edge - first, count: corners.len(), first };
            }
            first += corners.len();
        }
        RingPlace { ring: 0, index: 0, count: 1, first: 0 }
    }

    /// Returns the height (m) of the roof.
    fn top(&self, level: f64) -> f64 {
        self.base + self.profile.height(level)
    }

    /// Returns the height (m) of the underside.
    #[allow(clippy::float_cmp, reason = "levels are copies")]
    fn under(&self, level: f64) -> f64 {
        if level == 0.0 {
            self.base + self.profile.bottom
        } else if level == self.overhang {
            self.base
        } else {
            self.top(level) - self.slab
        }
    }

    /// Returns the ends of the two slopes next to the gable over `edge`; `None` if their shape is not simple.
    pub(super) fn rake(&self, edge: usize, faces: SkeletonFaces<'_>) -> Option<Rake> {
        if self.distances[edge] == 0.0 {
            return None;
        }
        let border = border(&faces.rings[edge], faces.points, f64::INFINITY);
        let highest = (0..border.len()).max_by(|&a, &b| border[a].z.total_cmp(&border[b].z))?;
        let apex = border[highest];
        let ends = [border[..highest].to_vec(), border[highest + 1..].iter().rev().copied().collect()];
        // Each end runs from the eaves to the top of the walls and on to the ridge, in one line.
        let [Some(from_right), Some(from_left)] = ends.map(|side| self.side(side)) else { return None };
        let place = self.place(edge);
        let [left, right] = place.ends(self.walls);
        let along = (right - left).normalize_or_zero();
        let neighbours = [place.previous_edge(), place.next_edge()];
        let beyond = |point: &DVec3| (point.truncate() - left).dot(along.perp()) < CLEAR;
        for neighbour in neighbours {
            let face = faces.rings[neighbour].iter().map(|&index| faces.points[index]);
            let within = |point: &DVec3| point.z > self.overhang && *point != apex;
            if face.filter(within).any(|point| beyond(&point)) {
                return None;
            }
        }
        // Speed at which the ends of the slopes approach each other along the wall.
        let speed = |neighbour: usize| {
            let [from, to] = self.place(neighbour).ends(self.walls);
            let inward = (to - from).normalize_or_zero().perp();
            1.0 / inward.dot(along).abs().max(1e-3)
        };
        let speeds = neighbours.map(speed);
        let mut ridge = self.overhang + left.distance(right) / (speeds[0] + speeds[1]);
        let top = left + along * (speeds[0] * (ridge - self.overhang));
        if (ridge - apex.z).abs() < CLEAR {
            ridge = apex.z;
        }
        let (low, high) = (ridge.min(apex.z), ridge.max(apex.z));
        let levels: Vec<f64> = self.profile.corners.iter().map(|corner| corner.x).collect();
        if low < self.overhang + CLEAR || levels.iter().any(|level| (low..high).contains(level)) {
            return None;
        }
        let side = |outer: Vec<DVec3>, from: DVec2, way: DVec2| {
            let mut side = SlopeSide { outer, wall: Vec::new() };
            for &level in levels.iter().filter(|level| (self.overhang..low).contains(*level)) {
                let last = side.outer[side.outer.len() - 1];
                if last.z < level {
                    side.outer.push(at_level(last, apex, level));
                }
                side.wall.push((from + way * (level - self.overhang)).extend(level));
            }
            side.outer.push(apex);
            side.wall.push(top.extend(ridge));
            side
        };
        Some(Rake([side(from_left, left, along * speeds[0]), side(from_right, right, -along * speeds[1])]))
    }

    /// Returns the end of a slope from the eaves to the top of the walls, if it has no other points up to the
    /// ridge.
    fn side(&self, points: Vec<DVec3>) -> Option<Vec<DVec3>> {
        let at_walls = points.last().is_some_and(|last| self.is_at_wall(*last));
        (at_walls && points.len() <= 2).then_some(points)
    }

    /// Adds all faces below the slopes, and the lower edges of gables that are in `patches`.
    ///
    /// `plate` has the faces of a roof whose slopes continue beyond the walls.
    pub(super) fn close(
        &self,
        patches: &mut Vec<Patch>,
        rakes: &[Option<Rake>],
        plate: Option<SkeletonFaces<'_>>,
    ) {
        let mut has_gable = vec![false; rakes.len()];
        for patch in patches.iter_mut().filter(|patch| patch.kind == PatchKind::Gable) {
            if std::mem::replace(&mut has_gable[patch.edge], true) {
                continue;
            }
            if let Some(faces) = plate {
                if let Some(strip) = Ring::without_repeats(self.strip(patch.edge, self.overhang, faces, [])) {
                    patch.rings[0] = strip;
                }
                continue;
            }
            let place = self.place(patch.edge);
            let ring = &mut patch.rings[0];
            let [a, b] = [ring[0], ring[1]];
            let [left, right] = place.ends(self.walls);
            let low = self.under(0.0);
            let below = [a.with_z(low), left.extend(self.base), right.extend(self.base), b.with_z(low)];
            let above = ring[1..].iter().copied().chain([a]);
            if let Some(whole) = Ring::without_repeats(below.into_iter().chain(above).collect()) {
                *ring = whole;
            }
        }
        for edge in 0..rakes.len() {
            let place = self.place(edge);
            if let Some(rake) = &rakes[edge] {
                self.add_rake(patches, edge, &place, rake);
            } else if !has_gable[edge] {
                match plate {
                    Some(faces) => self.add_plate(patches, edge, &place, faces, rakes),
                    None => self.add_eaves(patches, edge, &place),
                }
            }
        }
        if plate.is_none() && self.overhang > 0.0 && self.distances.contains(&0.0) {
            divide_feet(patches, self.walls, self.outer, self.base);
        }
    }

    /// Returns the upright face of the plate's rim over an edge, up to a level, between the top and the
    /// underside.
    ///
    /// At the top of the wall, the underside passes through `corners`.
    fn strip(
        &self,
        edge: usize,
        level: f64,
        faces: SkeletonFaces<'_>,
        corners: impl IntoIterator<Item = DVec3>,
    ) -> Vec<DVec3> {
        // Not `with_z`: rustc 1.95 lets it change the caller's point if the call is not inlined.
        let under = |point: &DVec3| point.truncate().extend(self.under(point.z));
        let top = |point: &DVec3| point.truncate().extend(self.top(point.z));
        let border = border(&faces.rings[edge], faces.points, level);
        let mut ring: Vec<DVec3> = border.iter().rev().map(under).collect();
        if let Some(first) = border.iter().position(|point| self.is_at_wall(*point)) {
            let last = border.len() - 1 - first;
            ring.splice(last..last, corners);
        }
        ring.extend(border.iter().map(top));
        ring
    }

    fn add_eaves(&self, patches: &mut Vec<Patch>, edge: usize, place: &RingPlace) {
        let ([a, b], [left, right]) = (place.ends(self.outer), place.ends(self.walls));
        let along = (right - left).normalize_or_zero();
        let mut push = |kind, ring: Vec<DVec3>| {
            patches.extend(Patch::new(kind, edge, 0, along, ring));
        };
        let (low, high) = (self.under(0.0), self.base + self.profile.corners[0].y);
        push(PatchKind::Fascia, vec![a.extend(low), b.extend(low), b.extend(high), a.extend(high)]);
        if self.distances[edge] > 0.0 {
            let ring = vec![b.extend(low), a.extend(low), left.extend(self.base), right.extend(self.base)];
            push(PatchKind::Underside, ring);
        }
    }

    /// Adds the rim and the underside of the plate over an edge.
    fn add_plate(
        &self,
        patches: &mut Vec<Patch>,
        edge: usize,
        place: &RingPlace,
        faces: SkeletonFaces<'_>,
        rakes: &[Option<Rake>],
    ) {
        let [left, right] = place.ends(self.walls);
        let along = (right - left).normalize_or_zero();
        let patch = |kind, ring| Patch::new(kind, edge, 0, along, ring);
        let from = self.overhang - self.distances[edge];
        let beside = |edge: usize| rakes[edge].is_some();
        // Next to a gable with an overhang, the top of the wall ends before the roof does.
        let corners = [(left, beside(place.previous_edge())), (right, beside(place.next_edge()))];
        let corners = corners.into_iter().filter(|(_, beside)| *beside).map(|(at, _)| at.extend(self.base));
        patches.extend(patch(PatchKind::Fascia, self.strip(edge, from, faces, corners.clone())));
        if self.distances[edge] > 0.0 {
            let mut ring = part(&faces.rings[edge], faces.points, [from, self.overhang]);
            ring.reverse();
            ring.rotate_right(2);
            let last = ring.iter().rposition(|point| self.is_at_wall(*point)).unwrap_or(ring.len() - 1);
            let under = |point: DVec3| point.truncate().extend(self.under(point.z));
            let mut ring: Vec<DVec3> = ring.into_iter().map(under).collect();
            ring.splice(last..last, corners);
            patches.extend(patch(PatchKind::Underside, ring));
        }
    }

    #[allow(clippy::float_cmp, reason = "levels are copies")]
    fn is_at_wall(&self, point: DVec3) -> bool {
        point.z == self.overhang
    }

    fn add_rake(&self, patches: &mut Vec<Patch>, edge: usize, place: &RingPlace, rake: &Rake) {
        let [left, right] = place.ends(self.walls);
        let along = (right - left).normalize_or_zero();
        let mut push = |kind, flap, along, ring: Vec<DVec3>| {
            patches.extend(Patch::new(kind, edge, flap, along, ring));
        };
        // Not `with_z`: rustc 1.95 lets it change the caller's point if the call is not inlined.
        let under = |point: DVec3| point.truncate().extend(self.under(point.z));
        let top = |point: DVec3| point.truncate().extend(self.top(point.z));
        for (number, side) in rake.0.iter().enumerate() {
            let turned = |mut ring: Vec<DVec3>| {
                if number == 1 {
                    ring.reverse();
                }
                ring
            };
            for (flap, pair) in side.outer.windows(2).enumerate() {
                let ring = vec![under(pair[0]), under(pair[1]), top(pair[1]), top(pair[0])];
                push(PatchKind::Fascia, flap, along, turned(ring));
            }
            let inward = if number == 0 { along.perp() } else { -along.perp() };
            let above = side.outer.iter().position(|point| self.is_at_wall(*point)).unwrap_or(0);
            for (flap, (outer, wall)) in side.outer[above..].windows(2).zip(side.wall.windows(2)).enumerate()
            {
                let ring = vec![under(wall[0]), under(wall[1]), under(outer[1]), under(outer[0])];
                push(PatchKind::Underside, flap, inward, turned(ring));
            }
        }
        let [rising, falling] = [&rake.0[1].wall, &rake.0[0].wall];
        let mut ring = vec![left.extend(self.base)];
        ring.extend(rising.iter().map(|&point| under(point)));
        ring.extend(falling[1..falling.len() - 1].iter().rev().map(|&point| under(point)));
        push(PatchKind::Gable, 0, along, ring);
    }
}
