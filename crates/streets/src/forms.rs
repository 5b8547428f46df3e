//! Artefacts of grown networks: zigzags, stubs, small triangles, knots and voids; and the decrease of density with
//! distance.

use std::f64::consts::PI;

use glam::DVec2;
use rustc_hash::FxHashMap;

use crate::plan::faces::{Course, StreetFace};
use crate::plan::network::{JunctionId, StreetNetwork};

/// Distance (m) between samples of a street for zigzags, and the number of samples that a direction spans.
const STEP: f64 = 10.0;
const SPAN: usize = 3;
/// Minimum turn (degrees) of a swing to one side.
const SWING: f64 = 25.0;
/// Maximum deviation (degrees) from straight ahead at which a street continues beyond a junction.
const STRAIGHT: f64 = 45.0;
/// Maximum areas (m²) of a small triangle, and of a block in a knot.
const TRIANGLE: f64 = 1500.0;
const KNOT: f64 = 600.0;
/// Maximum length (m) of a stub.
const STUB: f64 = 25.0;

impl StreetNetwork {
    /// Computes the street length per area (m/m²) in rings of equal width around a point, up to the distance `reach`
    /// (m).
    /// ```
    /// use burgeon_streets::StreetNetwork;
    /// use glam::DVec2;
    ///
    /// let network = StreetNetwork::survey(&[vec![DVec2::ZERO, DVec2::new(200.0, 0.0)]])?;
    /// let rings = network.density_by_distance(DVec2::ZERO, 200.0, 2);
    /// let inner = 100.0 / (std::f64::consts::PI * 100.0 * 100.0);
    /// assert!((rings[0] - inner).abs() < 1e-9 && (rings[1] - inner / 3.0).abs() < 1e-9);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn density_by_distance(&self, middle: DVec2, reach: f64, rings: usize) -> Vec<f64> {
        let mut lengths = vec![0.0; rings];
        #[allow(clippy::cast_precision_loss, reason = "a few rings")]
        let wide = reach / rings.max(1) as f64;
        for (piece, _) in self.pieces() {
            let [a, b] = self.line(piece);
            let length = a.distance(b);
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a length of a street"
            )]
            let parts = (length / 2.0).ceil().max(1.0) as u32;
            for part in 0..parts {
                let at = a.lerp(b, (f64::from(part) + 0.5) / f64::from(parts));
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "never negative")]
                let ring = (at.distance(middle) / wide) as usize;
                if let Some(sum) = lengths.get_mut(ring) {
                    *sum += length / f64::from(parts);
                }
            }
        }
        #[allow(clippy::cast_precision_loss, reason = "a few rings")]
        let area = |ring: usize| PI * wide * wide * (2 * ring + 1) as f64;
        lengths.iter().enumerate().map(|(ring, length)| length / area(ring)).collect()
    }

    /// Counts turns by [`SWING`] to one side and back to the other, along streets that continue across junctions.
    pub(crate) fn zigzags(&self) -> usize {
        self.strokes().iter().map(|line| swings(line).saturating_sub(1)).sum()
    }

    /// Returns the fraction of dead ends that are shorter than [`STUB`], from the last junction.
    pub(crate) fn stubs(&self) -> f64 {
        let (mut ends, mut short) = (0.0_f64, 0.0);
        for way in self.ways_between(|junction| self.junctions[junction as usize].degree() != 2) {
            let (Some(first), Some(last)) = (way.first(), way.last()) else { continue };
            let both = [first.from, self.across(last.piece, last.from)];
            if both.iter().any(|end| self.junctions[*end as usize].degree() == 1) {
                ends += 1.0;
                let length: f64 = way.iter().map(|course| self.length(course.piece)).sum();
                short += if length < STUB { 1.0 } else { 0.0 };
            }
        }
        short / ends.max(1.0)
    }

    /// Returns the fraction of faces that are triangles smaller than [`TRIANGLE`], ignoring small bends.
    pub(crate) fn triangles(&self, faces: &[StreetFace]) -> f64 {
        let is_one = |face: &&StreetFace| {
            let area = self.area(&face.around);
            area < TRIANGLE && corner_count(self.corners(&face.around), 0.1 * area.sqrt()) == 3
        };
        share(faces.iter().filter(is_one).count(), faces.len())
    }

    /// Returns the fraction of faces smaller than [`KNOT`] that have at least two such faces on the other side of their
    /// streets.
    pub(crate) fn knots(&self, faces: &[StreetFace]) -> f64 {
        let small: Vec<&StreetFace> = faces.iter().filter(|face| self.area(&face.around) < KNOT).collect();
        let mut of: FxHashMap<Course, usize> = FxHashMap::default();
        for (index, face) in small.iter().enumerate() {
            of.extend(face.around.iter().map(|course| (*course, index)));
        }
        let is_one = |(index, face): &(usize, &&StreetFace)| {
            let across = face.around.iter().filter_map(|course| {
                let back = Course { piece: course.piece, from: self.across(course.piece, course.from) };
                of.get(&back).copied().filter(|other| other != index)
            });
            let mut others: Vec<usize> = across.collect();
            others.sort_unstable();
            others.dedup();
            others.len() >= 2
        };
        share(small.iter().enumerate().filter(is_one).count(), faces.len())
    }

    /// Returns the strokes of the network: at a junction, each street continues with the street that is most nearly
    /// straight ahead.
    fn strokes(&self) -> Vec<Vec<DVec2>> {
        let mut onward: FxHashMap<(JunctionId, u32), u32> = FxHashMap::default();
        for (junction, _) in (0..).zip(&self.junctions) {
            let arms = self.arms(junction);
            let mut pairs = Vec::new();
            for (index, (piece, way)) in arms.iter().enumerate() {
                for (other, other_way) in &arms[..index] {
                    let off = 180.0 - way.angle_to(*other_way).abs().to_degrees();
                    if off <= STRAIGHT || arms.len() == 2 {
                        pairs.push((off, *piece, *other));
                    }
                }
            }
            pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
            for (_, one, other) in pairs {
                if !onward.contains_key(&(junction, one)) && !onward.contains_key(&(junction, other)) {
                    onward.insert((junction, one), other);
                    onward.insert((junction, other), one);
                }
            }
        }
        let mut seen = vec![false; self.pieces.len()];
        let mut strokes = Vec::new();
        // Closed strokes have no end and come last.
        for ends in [true, false] {
            for (first, piece) in self.pieces() {
                for from in piece.ends {
                    if seen[first as usize] || onward.contains_key(&(from, first)) == ends {
                        continue;
                    }
                    let (mut at, mut piece, mut line) = (from, first, vec![self.at(from)]);
                    while !std::mem::replace(&mut seen[piece as usize], true) {
                        at = self.across(piece, at);
                        line.push(self.at(at));
                        let Some(next) = onward.get(&(at, piece)) else { break };
                        piece = *next;
                    }
                    strokes.push(line);
                }
            }
        }
        strokes
    }
}

fn share(part: usize, all: usize) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    let share = part as f64 / all.max(1) as f64;
    share
}

/// Counts the turns of a line by [`SWING`] that change sides.
fn swings(line: &[DVec2]) -> usize {
    let mut places = Vec::new();
    let mut rest = 0.0;
    for pair in line.windows(2) {
        let length = pair[0].distance(pair[1]);
        while rest <= length {
            places.push(pair[0] + (pair[1] - pair[0]) * (rest / length.max(1e-9)));
            rest += STEP;
        }
        rest -= length;
    }
    let mut ways = places.windows(SPAN + 1).map(|span| span[SPAN] - span[0]);
    let Some(mut last) = ways.next() else { return 0 };
    let mut turned = 0.0_f64;
    // Extreme headings on each side since the last swing; during a swing to one side, only that side's extreme is
    // updated.
    let (mut low, mut high, mut side, mut count) = (0.0_f64, 0.0_f64, 0, 0);
    for way in ways {
        turned += last.angle_to(way).to_degrees();
        last = way;
        (low, high) = match side {
            0 => (low.min(turned), high.max(turned)),
            1 => (high.max(turned), high.max(turned)),
            _ => (low.min(turned), low.min(turned)),
        };
        let is_left = side <= 0 && turned - low >= SWING;
        if is_left || side >= 0 && high - turned >= SWING {
            (side, low, high, count) = (if is_left { 1 } else { -1 }, turned, turned, count + 1);
        }
    }
    count
}

/// Returns the number of corners of a ring, ignoring bends of up to `tolerance` (m).
fn corner_count(mut ring: Vec<DVec2>, tolerance: f64) -> usize {
    while ring.len() > 3 {
        let count = ring.len();
        let bend = |index: usize| {
            let [before, at, after] =
                [ring[(index + count - 1) % count], ring[index], ring[(index + 1) % count]];
            let base = before.distance(after).max(1e-9);
            let aside = (after - before).perp_dot(at - before).abs() / base;
            aside.min(at.distance(before)).min(at.distance(after))
        };
        let least = (0..count).map(|index| (bend(index), index)).min_by(|a, b| a.0.total_cmp(&b.0));
        match least {
            Some((aside, index)) if aside <= tolerance => ring.remove(index),
            _ => break,
        };
    }
    ring.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: &[(f64, f64)]) -> Vec<DVec2> {
        points.iter().map(|point| DVec2::from(*point)).collect()
    }

    #[test]
    fn a_zigzag_swings_back_and_forth_and_a_bend_or_an_arc_does_not() {
        let zigzag = line(&[(0.0, 0.0), (60.0, 40.0), (120.0, 0.0), (180.0, 40.0), (240.0, 0.0)]);
        assert_eq!(swings(&zigzag), 3);
        assert_eq!(swings(&line(&[(0.0, 0.0), (100.0, 0.0), (100.0, 100.0)])), 1);
        let arc: Vec<DVec2> = (0..40).map(|step| 200.0 * DVec2::from_angle(f64::from(step) * 0.05)).collect();
        assert_eq!(swings(&arc), 1);
        assert_eq!(swings(&line(&[(0.0, 0.0), (300.0, 0.0)])), 0);
    }

    #[test]
    fn triangles_stubs_and_knots_are_found() {
        // A triangle whose sides bend slightly, with a stub at a corner.
        let mut lines = vec![line(&[(0.0, 0.0), (20.0, 1.0), (40.0, 0.0), (20.0, 30.0), (0.0, 0.0)])];
        lines.push(line(&[(40.0, 0.0), (60.0, 0.0)]));
        let network = StreetNetwork::survey(&lines).unwrap();
        let of = network.measures();
        assert_eq!((of.triangles, of.stubs, of.knots), (1.0, 1.0, 0.0));
        // A grid of nine squares of 20 m: each has at least two neighbours.
        let grid: Vec<Vec<DVec2>> = (0..4)
            .map(|at| 20.0 * f64::from(at))
            .flat_map(|at| [line(&[(at, 0.0), (at, 60.0)]), line(&[(0.0, at), (60.0, at)])])
            .collect();
        let of = StreetNetwork::survey(&grid).unwrap().measures();
        assert_eq!((of.triangles, of.knots, of.zigzags), (0.0, 1.0, 0.0));
        assert!((of.density - 480.0 / 3600.0 * 1000.0).abs() < 1e-9 && (of.largest - 400.0).abs() < 1e-9);
    }
}
