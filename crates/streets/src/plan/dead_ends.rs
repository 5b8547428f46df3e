//! Dead ends: joining them to nearby streets, and removing them.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec2;
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::grid::{GridPlace, crossing, foot};
use super::keeps::StreetEnd;
use super::network::{JunctionId, StreetNetwork};

/// Deviation (degrees) from straight ahead at which a connection counts as twice its length.
const DEVIATION: f64 = 45.0;

/// Options for joining dead ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeadEndOptions {
    /// Search radius (m) around a dead end.
    pub radius: f64,
    /// Minimum ratio of the path along the network to the length of the new street.
    pub detour: f64,
}

impl Default for DeadEndOptions {
    fn default() -> Self {
        Self { radius: 150.0, detour: 2.0 }
    }
}

impl StreetNetwork {
    /// Returns the junctions with exactly one segment.
    pub fn dead_ends(&self) -> impl Iterator<Item = JunctionId> + '_ {
        (0..).zip(&self.junctions).filter(|(_, junction)| junction.degree() == 1).map(|(id, _)| id)
    }

    /// Joins dead ends to nearby streets until no more can be joined; returns the number of joined dead ends.
    ///
    /// Candidates for a dead end are junctions, nearest points of streets, and the intersection straight ahead. They
    /// are tried by increasing length, where a turn of 45 degrees doubles the length. The first candidate that meets
    /// all constraints and saves a sufficient detour is built.
    ///
    /// ```
    /// use burgeon_streets::{Constraints, DeadEndOptions, Obstacles, StreetAttributes, StreetNetwork};
    /// use glam::DVec2;
    ///
    /// // Three sides of a rectangle.
    /// let mut network = StreetNetwork::new(Constraints::default(), Obstacles::default())?;
    /// let mut end = network.begin(DVec2::ZERO)?;
    /// for to in [(200.0, 0.0), (200.0, 100.0), (0.0, 100.0)] {
    ///     end = network.grow(end, DVec2::from(to), StreetAttributes::default())?.end;
    /// }
    /// assert_eq!(network.dead_ends().count(), 2);
    /// network.join_dead_ends(DeadEndOptions::default());
    /// assert_eq!(network.dead_ends().count(), 0);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn join_dead_ends(&mut self, options: DeadEndOptions) -> usize {
        let mut joined = 0;
        loop {
            let before = joined;
            let ends: Vec<JunctionId> = self.dead_ends().collect();
            for end in ends {
                // An earlier connection may have ended at this dead end.
                if self.junctions[end as usize].degree() == 1 && self.join(end, options) {
                    joined += 1;
                }
            }
            if joined == before {
                return joined;
            }
        }
    }

    /// Removes dead ends, including streets that become dead ends as a result, but no existing streets. Returns the
    /// number of removed segments.
    /// ```
    /// use burgeon_streets::{Constraints, Obstacles, StreetAttributes, StreetNetwork};
    /// use glam::DVec2;
    ///
    /// let mut network = StreetNetwork::new(Constraints::default(), Obstacles::default())?;
    /// let mut end = network.begin(DVec2::ZERO)?;
    /// // Around a square, and two streets that lead away from it.
    /// for to in [(200.0, 0.0), (200.0, 200.0), (0.0, 200.0), (0.0, 0.0), (-200.0, 0.0), (-400.0, 0.0)] {
    ///     end = network.grow(end, DVec2::from(to), StreetAttributes::default())?.end;
    /// }
    /// assert_eq!((network.size(), network.dead_ends().count()), (6, 1));
    /// assert_eq!(network.remove_dead_ends(), 2);
    /// assert_eq!((network.size(), network.dead_ends().count()), (4, 0));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn remove_dead_ends(&mut self) -> usize {
        let mut due: Vec<JunctionId> = self.dead_ends().collect();
        let mut removed = 0;
        while let Some(end) = due.pop() {
            let Some(&piece) = self.junctions[end as usize].pieces.first() else { continue };
            // Existing streets are kept.
            if self.pieces[piece as usize].is_existing {
                continue;
            }
            let far = self.across(piece, end);
            self.remove(piece);
            removed += 1;
            if self.junctions[far as usize].degree() == 1 {
                due.push(far);
            }
        }
        removed
    }

    /// Counts the dead ends that could be joined.
    pub fn joinable_dead_ends(&self, options: DeadEndOptions) -> usize {
        let ends = self.dead_ends();
        ends.filter(|end| self.way_out(*end, options).is_some()).count()
    }

    fn join(&mut self, from: JunctionId, options: DeadEndOptions) -> bool {
        let Some(end) = self.way_out(from, options) else { return false };
        let attributes = self.pieces[self.junctions[from as usize].pieces[0] as usize].attributes;
        self.connect(from, end, attributes).is_ok()
    }

    /// Returns the best end of a street from a dead end, if any.
    fn way_out(&self, from: JunctionId, options: DeadEndOptions) -> Option<StreetEnd> {
        let piece =
            *self.junctions[from as usize].pieces.first().filter(|piece| self.is_on_ground(**piece))?;
        let attributes = self.pieces[piece as usize].attributes;
        let (here, ahead) = (self.at(from), -self.leaves(piece, from));
        let mut ends: SmallVec<[(f64, u64, StreetEnd); 32]> = SmallVec::new();
        let mut add = |end: StreetEnd, place: DVec2, order: u64| {
            let way = place - here;
            let deviation = ahead.angle_to(way).abs().to_degrees();
            if way.length() <= options.radius && deviation <= 135.0 {
                ends.push((way.length() * (1.0 + deviation / DEVIATION), order, end));
            }
        };
        let around = [here; 2];
        for junction in self.junctions_near(around, options.radius) {
            if junction != from && self.has_ground(junction) {
                add(StreetEnd::Junction(junction), self.at(junction), u64::from(junction));
            }
        }
        for other in self.ground_near(around, options.radius) {
            if other == piece {
                continue;
            }
            let line = self.line(other);
            let places = [
                Some(line[0] + (line[1] - line[0]) * foot(here, line).1),
                crossing(line, [here, here + ahead])
                    .filter(|on| (0.0..=1.0).contains(on))
                    .map(|on| line[0] + (line[1] - line[0]) * on)
                    .filter(|place| (*place - here).dot(ahead) > 0.0),
            ];
            for (index, place) in (0..).zip(places) {
                if let Some((place, on)) = place.and_then(|place| Some((place, GridPlace::nearest(place)?))) {
                    add(StreetEnd::On(other, on), place, (1 << 40) + (u64::from(other) << 1) + index);
                }
            }
        }
        ends.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let found = ends.into_iter().find(|(_, _, end)| {
            let to = self.place_of(*end).metres();
            let line = [here, to];
            self.obstacles.first_on(line, attributes.width).is_none()
                && self.test(from, *end, attributes, &mut 0).is_ok()
                && self.is_detour(from, *end, here.distance(to) * options.detour)
        });
        found.map(|(_, _, end)| end)
    }

    /// Returns true if the path along the network is at least `least` (m) long.
    pub(crate) fn is_detour(&self, from: JunctionId, end: StreetEnd, least: f64) -> bool {
        let goals: SmallVec<[(JunctionId, f64); 2]> = match end {
            StreetEnd::Junction(junction) => SmallVec::from_slice(&[(junction, 0.0)]),
            StreetEnd::On(piece, place) => {
                let at = place.metres();
                self.ends(piece).into_iter().map(|goal| (goal, self.at(goal).distance(at))).collect()
            }
            StreetEnd::Free(_) => return true,
        };
        let mut best: FxHashMap<JunctionId, f64> = FxHashMap::default();
        let mut due = BinaryHeap::from([SearchItem(0.0, from)]);
        best.insert(from, 0.0);
        while let Some(SearchItem(length, junction)) = due.pop() {
            if length >= least {
                return true;
            }
            if best.get(&junction).is_some_and(|known| *known < length) {
                continue;
            }
            if goals.iter().any(|(goal, rest)| *goal == junction && length + rest < least) {
                return false;
            }
            for piece in &self.junctions[junction as usize].pieces {
                let (far, length) = (self.across(*piece, junction), length + self.length(*piece));
                if best.get(&far).is_none_or(|known| length < *known) {
                    best.insert(far, length);
                    due.push(SearchItem(length, far));
                }
            }
        }
        true
    }
}

/// Junction with the length (m) of a path to it; the shortest path is the greatest item.
struct SearchItem(f64, JunctionId);

impl PartialEq for SearchItem {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for SearchItem {}

impl PartialOrd for SearchItem {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for SearchItem {
    fn cmp(&self, other: &Self) -> Ordering {
        other.0.total_cmp(&self.0).then(other.1.cmp(&self.1))
    }
}
