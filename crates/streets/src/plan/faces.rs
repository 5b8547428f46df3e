//! Faces of the planar subdivision that a network forms.

use rustc_hash::FxHashMap;

use super::grid::WholePlace as _;
use super::network::{JunctionId, PieceId, StreetNetwork};
use burgeon_geometry::planar::{contains, twice_area};
use glam::DVec2;

/// Directed segment, from one of its junctions to the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Course {
    /// Segment.
    pub piece: PieceId,
    /// Start junction.
    pub from: JunctionId,
}

/// Area enclosed by streets; the boundary has the area on its left.
#[derive(Debug, Clone, PartialEq)]
pub struct StreetFace {
    /// Boundary, counter-clockwise. A dead end inside the face is traversed in both directions.
    pub around: Vec<Course>,
    /// Clockwise boundaries of separate networks inside the face.
    pub islands: Vec<Vec<Course>>,
}

impl StreetNetwork {
    /// Returns all closed walks with one area on the left, each once, ordered by their smallest courses.
    pub(crate) fn ways(&self) -> Vec<Vec<Course>> {
        let mut next: FxHashMap<Course, Course> = FxHashMap::default();
        #[allow(clippy::cast_possible_truncation, reason = "pieces are limited far below")]
        for junction in 0..self.junctions.len() as JunctionId {
            let mut arms = self.arms(junction);
            // Streets above or below the ground do not bound areas on it.
            arms.retain(|(piece, _)| self.is_on_ground(*piece));
            for (index, (piece, _)) in arms.iter().enumerate() {
                // A walk that arrives by an arm leaves by the previous arm, counted counter-clockwise.
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

    /// Returns the walk around the area on the left of the street whose direction at a junction is nearest to
    /// `towards`; empty if the junction has no street.
    ///
    /// The walk is counter-clockwise around a face, and clockwise around the network if the area lies outside it.
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

    /// Returns the corners (m) of a walk.
    pub fn corners(&self, way: &[Course]) -> Vec<DVec2> {
        way.iter().map(|course| self.at(course.from)).collect()
    }

    /// Returns the area (m²) on the left of a walk; negative if it is the area outside a network.
    pub fn area(&self, way: &[Course]) -> f64 {
        twice_area(way.iter().map(|course| self.at(course.from))) / 2.0
    }

    /// Returns true if a walk has an area on its left, which a walk around streets without a cycle has not. Exact.
    fn encloses_area(&self, way: &[Course]) -> bool {
        let places =
            || way.iter().map(|course| self.junctions[course.from as usize].place.steps().map(i128::from));
        let next = places().cycle().skip(1);
        places().zip(next).map(|([ax, ay], [bx, by])| ax * by - ay * bx).sum::<i128>() > 0
    }

    /// Returns the areas that the streets enclose, in a fixed order.
    ///
    /// A network without cycles encloses no area. A network inside a face is an island of that face.
    ///
    /// ```
    /// use burgeon_streets::{Constraints, Obstacles, StreetAttributes, StreetNetwork};
    /// use glam::DVec2;
    ///
    /// let mut network = StreetNetwork::new(Constraints::default(), Obstacles::default())?;
    /// let mut end = network.begin(DVec2::ZERO)?;
    /// for to in [(200.0, 0.0), (200.0, 100.0), (0.0, 100.0)] {
    ///     end = network.grow(end, DVec2::from(to), StreetAttributes::default())?.end;
    /// }
    /// assert!(network.faces().is_empty());
    /// network.grow(end, DVec2::ZERO, StreetAttributes::default())?;
    /// assert_eq!(network.area(&network.faces()[0].around), 20_000.0);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn faces(&self) -> Vec<StreetFace> {
        let mut faces = Vec::new();
        let mut outsides = Vec::new();
        for way in self.ways() {
            if self.encloses_area(&way) {
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

    /// Returns the number of connected components.
    pub fn components(&self) -> usize {
        self.component_of().1
    }

    /// Returns the component of each junction, and the number of components. Junctions without streets have no
    /// component (`u32::MAX`).
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
