//! Streets between junctions, including the turns in between.

use glam::DVec2;

use super::faces::Course;
use super::network::{JunctionId, PieceId, StreetAttributes, StreetNetwork};

/// Street between two junctions or ends, with constant attributes.
#[derive(Debug, Clone, PartialEq)]
pub struct StreetStretch {
    /// Start and end junctions; equal for a ring.
    pub junctions: [JunctionId; 2],
    /// Line (m): the positions of both junctions, and of the turns in between.
    pub line: Vec<DVec2>,
    /// Attributes of the street.
    pub attributes: StreetAttributes,
    /// Marks a bridge over an obstacle.
    pub is_bridge: bool,
}

impl StreetStretch {
    /// Returns the length (m).
    pub fn length(&self) -> f64 {
        self.line.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
    }
}

impl StreetNetwork {
    /// Returns the streets between junctions, each once. A junction of two segments with equal attributes is a turn.
    ///
    /// ```
    /// use burgeon_streets::{Constraints, Obstacles, StreetAttributes, StreetNetwork};
    /// use glam::DVec2;
    ///
    /// let mut network = StreetNetwork::new(Constraints::default(), Obstacles::default())?;
    /// let start = network.begin(DVec2::ZERO)?;
    /// let turn = network.grow(start, DVec2::new(100.0, 0.0), StreetAttributes::default())?.end;
    /// network.grow(turn, DVec2::new(100.0, 80.0), StreetAttributes::default())?;
    /// let stretches = network.stretches();
    /// assert_eq!((network.size(), stretches.len(), stretches[0].length()), (2, 1, 180.0));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn stretches(&self) -> Vec<StreetStretch> {
        let kind = |piece: PieceId| (self.attributes(piece), self.is_bridge(piece));
        let ways = self.ways_between(|junction| {
            let pieces = &self.junctions[junction as usize].pieces;
            pieces.len() != 2 || kind(pieces[0]) != kind(pieces[1])
        });
        let stretch = |way: Vec<Course>| {
            let (first, last) = (way.first()?, way.last()?);
            let end = self.across(last.piece, last.from);
            let mut line = self.corners(&way);
            line.push(self.at(end));
            let (attributes, is_bridge) = kind(first.piece);
            Some(StreetStretch { junctions: [first.from, end], line, attributes, is_bridge })
        };
        ways.into_iter().filter_map(stretch).collect()
    }

    /// Returns the paths between junctions for which `is_end` returns true, each once, followed by the rings without
    /// such a junction.
    pub(crate) fn ways_between(&self, is_end: impl Fn(JunctionId) -> bool) -> Vec<Vec<Course>> {
        let mut ways = Vec::new();
        let mut seen = vec![false; self.pieces.len()];
        for ends in [true, false] {
            for (from, junction) in (0..).zip(&self.junctions) {
                if junction.pieces.is_empty() || is_end(from) != ends {
                    continue;
                }
                for &first in &junction.pieces {
                    let mut way = Vec::new();
                    let mut course = Course { piece: first, from };
                    while !std::mem::replace(&mut seen[course.piece as usize], true) {
                        way.push(course);
                        let at = self.across(course.piece, course.from);
                        if is_end(at) {
                            break;
                        }
                        let onward = self.junctions[at as usize].pieces.iter().copied();
                        let Some(piece) = onward.rev().find(|piece| *piece != course.piece) else { break };
                        course = Course { piece, from: at };
                    }
                    if !way.is_empty() {
                        ways.push(way);
                    }
                }
            }
        }
        ways
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Constraints, Obstacles};

    fn network(lines: &[(&[(f64, f64)], u32)]) -> StreetNetwork {
        let constraints = Constraints { snap: 10.0, ..Constraints::default() };
        let mut network = StreetNetwork::new(constraints, Obstacles::default()).unwrap();
        for (line, depth) in lines {
            let attributes = StreetAttributes { width: 8.0, depth: *depth, ..StreetAttributes::default() };
            let mut from = network.begin(DVec2::from(line[0])).unwrap();
            for to in &line[1..] {
                from = network.grow(from, DVec2::from(*to), attributes).unwrap().end;
            }
        }
        network
    }

    #[test]
    fn a_street_leads_over_its_turns_from_junction_to_junction() {
        let network = network(&[
            (&[(0.0, 0.0), (100.0, 0.0), (200.0, 40.0), (300.0, 0.0)], 0),
            (&[(200.0, 40.0), (200.0, 140.0), (260.0, 220.0)], 1),
        ]);
        let stretches = network.stretches();
        let lines: Vec<usize> = stretches.iter().map(|stretch| stretch.line.len()).collect();
        assert_eq!(lines, [3, 2, 3]);
        let length: f64 = stretches.iter().map(StreetStretch::length).sum();
        let pieces: f64 = network.pieces().map(|(piece, _)| network.length(piece)).sum();
        assert!((length - pieces).abs() < 1e-9);
    }

    #[test]
    fn a_street_ends_where_its_kind_does_and_a_ring_is_one() {
        let changed = network(&[(&[(0.0, 0.0), (100.0, 0.0)], 0), (&[(100.0, 0.0), (200.0, 0.0)], 1)]);
        assert_eq!(changed.stretches().len(), 2);
        let corners = [(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0), (0.0, 0.0)];
        let ring = network(&[(&corners, 0)]).stretches();
        assert_eq!(ring.len(), 1);
        assert_eq!((ring[0].junctions[0], ring[0].line.len()), (ring[0].junctions[1], 5));
    }
}
