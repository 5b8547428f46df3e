//! The faces that a network divides the plane into.

use rustc_hash::FxHashMap;

use crate::network::{JunctionId, PieceId, StreetNetwork};
use burgeon_geometry::planar::{contains, twice_area};
use glam::DVec2;

/// A way along a piece, from one of its junctions to the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Course {
    /// The piece.
    pub piece: PieceId,
    /// Where it leaves.
    pub from: JunctionId,
}

/// An area that streets enclose, with its boundary on its left.
#[derive(Debug, Clone, PartialEq)]
pub struct StreetFace {
    /// The way around it, counter-clockwise. A dead end inside of it is walked in both directions.
    pub around: Vec<Course>,
    /// The ways around networks that lie inside of it and are joined to nothing, clockwise.
    pub islands: Vec<Vec<Course>>,
}

impl StreetNetwork {
    /// Every closed way with the same area on its left, each once, in the order of the least course of each.
    pub(crate) fn ways(&self) -> Vec<Vec<Course>> {
        let mut next: FxHashMap<Course, Course> = FxHashMap::default();
        #[allow(clippy::cast_possible_truncation, reason = "pieces are limited far below")]
        for junction in 0..self.junctions.len() as JunctionId {
            let mut arms = self.arms(junction);
            // What passes over the ground bounds nothing on it.
            arms.retain(|(piece, _)| self.is_on_ground(*piece));
            for (index, (piece, _)) in arms.iter().enumerate() {
                // Whoever arrives by an arm leaves by the one before it, counted counter-clockwise.
                let before = arms[(index + arms.len() - 1) % arms.len()].0;
                let arrives = Course { piece: *piece, from: self.across(*piece, junction) };
                next.insert(arrives, Course { piece: before, from: junction });
            }
        }
        let mut courses: Vec<Course> = next.keys().copied().collect();
        courses.sort_unstable();
        let mut ways = Vec::new();
        for first in courses {
            let mut way = Vec::new();
            let mut course = first;
            while let Some(after) = next.remove(&course) {
                way.push(course);
                course = after;
            }
            if !way.is_empty() {
                ways.push(way);
            }
        }
        ways
    }

    /// Returns the way around the area on the left of the street that leaves a junction nearest to a direction; empty if no
    /// street leaves it.
    ///
    /// The way is counter-clockwise around a face, and clockwise around the network if the area lies outside of it.
    ///
    /// ```
    /// use burgeon_streets::{Constraints, Obstacles, StreetAttributes, StreetNetwork};
    /// use glam::DVec2;
    ///
    /// let mut network = StreetNetwork::new(Constraints::default(), Obstacles::default())?;
    /// let start = network.begin(DVec2::ZERO)?;
    /// let mut end = start;
    /// for to in [(200.0, 0.0), (200.0, 100.0), (0.0, 100.0), (0.0, 0.0)] {
    ///     end = network.grow(end, DVec2::from(to), StreetAttributes::default())?.end;
    /// }
    /// assert_eq!(network.area(&network.way_from(start, DVec2::X)), 20_000.0);
    /// assert_eq!(network.area(&network.way_from(start, DVec2::Y)), -20_000.0);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn way_from(&self, junction: JunctionId, towards: DVec2) -> Vec<Course> {
        let arms = self.arms(junction);
        let off = |way: &DVec2| way.angle_to(towards).abs();
        let Some(&(piece, _)) = arms.iter().min_by(|a, b| off(&a.1).total_cmp(&off(&b.1))) else {
            return Vec::new();
        };
        let first = Course { piece, from: junction };
        let (mut course, mut way) = (first, Vec::new());
        loop {
            way.push(course);
            let end = self.across(course.piece, course.from);
            let arms = self.arms(end);
            let Some(index) = arms.iter().position(|(piece, _)| *piece == course.piece) else { return way };
            let before = arms[(index + arms.len() - 1) % arms.len()].0;
            course = Course { piece: before, from: end };
            if course == first {
                return way;
            }
        }
    }

    /// The corners (m) of a way.
    pub fn corners(&self, way: &[Course]) -> Vec<DVec2> {
        way.iter().map(|course| self.at(course.from)).collect()
    }

    /// The area (m²) on the left of a way; negative if that is what lies outside of a network.
    pub fn area(&self, way: &[Course]) -> f64 {
        twice_area(way.iter().map(|course| self.at(course.from))) / 2.0
    }

    /// The areas that the streets enclose, in a fixed order.
    ///
    /// What a network without a closed way encloses is nothing. A network inside of a face is one of its islands.
    pub fn faces(&self) -> Vec<StreetFace> {
        let mut faces = Vec::new();
        let mut outsides = Vec::new();
        for way in self.ways() {
            if self.area(&way) > 0.0 {
                faces.push(StreetFace { around: way, islands: Vec::new() });
            } else {
                outsides.push(way);
            }
        }
        let rings: Vec<(Vec<DVec2>, f64)> =
            faces.iter().map(|face| (self.corners(&face.around), self.area(&face.around))).collect();
        for way in outsides {
            let place = self.at(way[0].from);
            let own: Vec<JunctionId> = way.iter().map(|course| course.from).collect();
            let around = rings.iter().enumerate().filter(|(index, (ring, _))| {
                let shares = faces[*index].around.iter().any(|course| own.contains(&course.from));
                !shares && contains(ring, place)
            });
            let smallest = around.min_by(|(_, (_, a)), (_, (_, b))| a.total_cmp(b));
            if let Some((index, _)) = smallest {
                faces[index].islands.push(way);
            }
        }
        faces
    }

    /// How many networks there are that are not joined with one another.
    pub fn components(&self) -> usize {
        self.component_of().1
    }

    /// The number of the component of each junction, and how many there are; junctions without streets have none.
    pub(crate) fn component_of(&self) -> (Vec<u32>, usize) {
        let mut of = vec![u32::MAX; self.junctions.len()];
        let mut count = 0;
        for start in 0..self.junctions.len() {
            if of[start] != u32::MAX || self.junctions[start].pieces.is_empty() {
                continue;
            }
            #[allow(clippy::cast_possible_truncation, reason = "pieces are limited far below")]
            let mut due = vec![start as JunctionId];
            of[start] = count;
            while let Some(junction) = due.pop() {
                for piece in &self.junctions[junction as usize].pieces {
                    let far = self.across(*piece, junction);
                    if of[far as usize] == u32::MAX {
                        of[far as usize] = count;
                        due.push(far);
                    }
                }
            }
            count += 1;
        }
        (of, count as usize)
    }
}
