//! What is below a roof: undersides, the faces along its outline, and gables.

use glam::{DVec2, DVec3};

use super::super::skeleton::Skeleton;
use super::patches::at_level;
use super::shape::Profile;
use super::shed::without_repeats;
use super::{Patch, PatchKind};

/// Places of a roof nearer than this (m) to the wall are not beyond it.
const CLEAR: f64 = 5e-3;

/// The outline of a roof, beside that of the walls below.
pub(super) struct Rim<'a> {
    pub walls: &'a [Vec<DVec2>],
    /// As many edges as the walls have.
    pub outer: &'a [Vec<DVec2>],
    pub profile: &'a Profile,
    /// Where the walls end (m).
    pub base: f64,
    /// How far (m) the outline is from the walls, but for flush gables.
    pub overhang: f64,
    /// How high (m) the faces along the outline are.
    pub slab: f64,
}

/// The ends of two slopes that jut out over a gable: first the one on the left as seen from outside.
#[derive(Debug, Clone)]
pub(super) struct Rake([Side; 2]);

/// Points of a slope's end from the eaves up to the ridge, with their distances from the outline as heights.
#[derive(Debug, Clone)]
struct Side {
    /// Along the outline of the roof, from its corner on.
    outer: Vec<DVec3>,
    /// Along the wall, from its corner on.
    wall: Vec<DVec3>,
}

/// The neighbours of an edge in its ring.
struct Place {
    ring: usize,
    index: usize,
    count: usize,
    first: usize,
}

impl Place {
    fn before(&self) -> usize {
        self.first + (self.index + self.count - 1) % self.count
    }

    fn after(&self) -> usize {
        self.first + (self.index + 1) % self.count
    }

    fn ends(&self, rings: &[Vec<DVec2>]) -> [DVec2; 2] {
        [rings[self.ring][self.index], rings[self.ring][(self.index + 1) % self.count]]
    }
}

impl Rim<'_> {
    fn place(&self, edge: usize) -> Place {
        let mut first = 0;
        for (ring, corners) in self.walls.iter().enumerate() {
            if edge < first + corners.len() {
                return Place { ring, index: edge - first, count: corners.len(), first };
            }
            first += corners.len();
        }
        Place { ring: 0, index: 0, count: 1, first: 0 }
    }

    /// The height (m) of the roof.
    fn top(&self, level: f64) -> f64 {
        self.base + self.profile.height(level)
    }

    /// The height (m) of the underside.
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

    /// How the slopes beside the gable over `edge` jut out over it; none if they are not simply two.
    pub(super) fn rake(&self, edge: usize, skeleton: &Skeleton, points: &[DVec3]) -> Option<Rake> {
        if self.overhang == 0.0 {
            return None;
        }
        let &[a, b, apex] = skeleton.faces[edge].as_slice() else { return None };
        let place = self.place(edge);
        let [left, right] = place.ends(self.walls);
        let along = (right - left).normalize_or_zero();
        let neighbours = [place.before(), place.after()];
        let beyond = |peak: &&usize| (points[**peak].truncate() - left).dot(along.perp()) < CLEAR;
        for neighbour in neighbours {
            let face = &skeleton.faces[neighbour];
            if face.iter().filter(|peak| ![a, b, apex].contains(peak)).any(|peak| beyond(&peak)) {
                return None;
            }
        }
        // How fast the slopes' ends come nearer to each other along the wall.
        let speed = |neighbour: usize| {
            let [from, to] = self.place(neighbour).ends(self.walls);
            let inward = (to - from).normalize_or_zero().perp();
            1.0 / inward.dot(along).abs().max(1e-3)
        };
        let speeds = neighbours.map(speed);
        let mut ridge = self.overhang + left.distance(right) / (speeds[0] + speeds[1]);
        let top = left + along * (speeds[0] * (ridge - self.overhang));
        if (ridge - points[apex].z).abs() < CLEAR {
            ridge = points[apex].z;
        }
        let (low, high) = (ridge.min(points[apex].z), ridge.max(points[apex].z));
        let levels: Vec<f64> = self.profile.corners.iter().map(|corner| corner.x).collect();
        if low < self.overhang + CLEAR || levels.iter().any(|level| (low..high).contains(level)) {
            return None;
        }
        let side = |corner: usize, from: DVec2, way: DVec2| {
            let mut side = Side { outer: vec![points[corner]], wall: Vec::new() };
            for &level in levels.iter().filter(|level| **level > 0.0 && **level < low) {
                let last = side.outer[side.outer.len() - 1];
                side.outer.push(at_level(last, points[apex], level));
                side.wall.push((from + way * (level - self.overhang)).extend(level));
            }
            side.outer.push(points[apex]);
            side.wall.push(top.extend(ridge));
            side
        };
        Some(Rake([side(a, left, along * speeds[0]), side(b, right, -along * speeds[1])]))
    }

    /// Adds all that is below the slopes; gables that are in `patches` get their lower edges.
    pub(super) fn close(&self, patches: &mut Vec<Patch>, rakes: &[Option<Rake>]) {
        let mut has_gable = vec![false; rakes.len()];
        for patch in patches.iter_mut().filter(|patch| patch.kind == PatchKind::Gable) {
            if std::mem::replace(&mut has_gable[patch.edge], true) {
                continue;
            }
            let place = self.place(patch.edge);
            let ring = &mut patch.rings[0];
            let [a, b] = [ring[0], ring[1]];
            let [left, right] = place.ends(self.walls);
            let low = self.under(0.0);
            let below = [a.with_z(low), left.extend(self.base), right.extend(self.base), b.with_z(low)];
            let above = ring[1..].iter().copied().chain([a]);
            *ring = without_repeats(below.into_iter().chain(above).collect());
        }
        for edge in 0..rakes.len() {
            let place = self.place(edge);
            if let Some(rake) = &rakes[edge] {
                self.add_rake(patches, edge, &place, rake);
            } else if !has_gable[edge] {
                self.add_eaves(patches, edge, &place, rakes);
            }
        }
    }

    fn add_eaves(&self, patches: &mut Vec<Patch>, edge: usize, place: &Place, rakes: &[Option<Rake>]) {
        let ([a, b], [left, right]) = (place.ends(self.outer), place.ends(self.walls));
        let along = (right - left).normalize_or_zero();
        let mut push = |kind, ring: Vec<DVec3>| {
            let ring = without_repeats(ring);
            if ring.len() > 2 {
                patches.push(Patch { kind, edge, flap: 0, along, rings: vec![ring] });
            }
        };
        let (low, high) = (self.under(0.0), self.base + self.profile.corners[0].y);
        push(PatchKind::Fascia, vec![a.extend(low), b.extend(low), b.extend(high), a.extend(high)]);
        if self.overhang > 0.0 {
            // Beside a gable that the roof juts out over, the underside goes on to the outline.
            let corner = |edge: usize, side: usize| {
                rakes[edge].as_ref().map(|rake| rake.0[side].outer[1].with_z(self.base))
            };
            let mut ring = vec![b.extend(low), a.extend(low)];
            ring.extend(corner(place.before(), 1));
            ring.extend([left.extend(self.base), right.extend(self.base)]);
            ring.extend(corner(place.after(), 0));
            push(PatchKind::Underside, ring);
        }
    }

    fn add_rake(&self, patches: &mut Vec<Patch>, edge: usize, place: &Place, rake: &Rake) {
        let [left, right] = place.ends(self.walls);
        let along = (right - left).normalize_or_zero();
        let mut push = |kind, flap, along, ring: Vec<DVec3>| {
            patches.push(Patch { kind, edge, flap, along, rings: vec![ring] });
        };
        // Not with_z: rustc 1.95 lets it change the caller's point where it is not inlined.
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
            for (flap, (outer, wall)) in side.outer[1..].windows(2).zip(side.wall.windows(2)).enumerate() {
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
