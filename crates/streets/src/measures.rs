//! Measures for comparing networks.

use std::f64::consts::PI;

use glam::DVec2;

use crate::plan::network::StreetNetwork;

/// Maximum area (m²) of a face that counts as a traffic island and not as a block.
const ISLAND: f64 = 150.0;

/// Measures of a network, as used for real cities.
///
/// Source: G. Boeing, "Urban spatial order: street network orientation, configuration, and entropy", 2019.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Measures {
    /// Total length (m) of the streets.
    pub length: f64,
    /// Mean number of streets at a junction, excluding mere turns.
    pub degree: f64,
    /// Fractions of dead ends, of junctions of 3 streets, and of junctions of 4 or more streets.
    pub shares: [f64; 3],
    /// Ratio of the length of the streets to the straight distance between their junctions; at least 1.
    pub circuity: f64,
    /// Ratio of the number of faces to the maximum possible number, from 0 for a tree to about 1.
    pub meshedness: f64,
    /// Similarity of street directions, from 0 for none to 1 for a grid.
    pub orientation_order: f64,
    /// Median area (m²) of the blocks: the faces without traffic islands of up to 150 m².
    pub block: f64,
    /// Standard deviation of the base-10 logarithm of the block areas.
    pub block_spread: f64,
    /// Median ratio of the area of a face to the area of its smallest enclosing circle, from 0 to 1.
    pub block_shape: f64,
    /// Median length (m) of the streets between junctions.
    pub segment: f64,
    /// Street length per area of the faces (km/km²).
    pub density: f64,
    /// Area (m²) of the largest face.
    pub largest: f64,
    /// Number of turns by 25° to one side and back to the other, per kilometre.
    pub zigzags: f64,
    /// Fraction of dead ends that are shorter than 25 m.
    pub stubs: f64,
    /// Fraction of faces that are triangles smaller than 1,500 m².
    pub triangles: f64,
    /// Fraction of faces smaller than 600 m² that have at least two neighbours smaller than 600 m².
    pub knots: f64,
}

impl StreetNetwork {
    /// Computes the measures. A junction where a street only turns counts as part of the street.
    ///
    /// ```
    /// use burgeon_streets::{Constraints, Obstacles, StreetAttributes, StreetNetwork};
    /// use glam::DVec2;
    ///
    /// // Four streets of 200 m from one place.
    /// let mut network = StreetNetwork::new(Constraints::default(), Obstacles::default())?;
    /// let middle = network.begin(DVec2::ZERO)?;
    /// for way in [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y] {
    ///     network.grow(middle, 200.0 * way, StreetAttributes::default())?;
    /// }
    /// let measures = network.measures();
    /// assert_eq!((measures.length, measures.degree, measures.circuity), (800.0, 8.0 / 5.0, 1.0));
    /// assert_eq!(measures.shares, [0.8, 0.0, 0.2]);
    /// assert!((measures.orientation_order - 1.0).abs() < 1e-9);
    /// assert_eq!((measures.density, measures.stubs), (0.0, 0.0));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn measures(&self) -> Measures {
        let StreetRuns { lengths, straight, bins } = self.runs();
        let length: f64 = lengths.iter().sum();
        let degrees: Vec<usize> = self
            .junctions
            .iter()
            .map(|junction| junction.degree())
            .filter(|degree| ![0, 2].contains(degree))
            .collect();
        #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
        let count = |of: &dyn Fn(usize) -> bool| degrees.iter().filter(|degree| of(**degree)).count() as f64;
        let all = count(&|_| true).max(1.0);
        #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
        let (vertices, edges, parts) = {
            let there = self.junctions.iter().filter(|junction| junction.degree() > 0).count();
            (there as f64, self.size() as f64, self.components() as f64)
        };
        #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
        let degree = degrees.iter().sum::<usize>() as f64 / all;
        // Turns are not vertices and add no edges.
        #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
        let turns = self.junctions.iter().filter(|junction| junction.degree() == 2).count() as f64;
        let meshedness = (edges - vertices + parts) / (2.0 * (vertices - turns) - 5.0).max(1.0);
        let (mut areas, mut shapes) = (Vec::new(), Vec::new());
        let faces = self.faces();
        for face in &faces {
            let corners = self.corners(&face.around);
            let area = self.area(&face.around);
            areas.push(area);
            shapes.push(area / (PI * circle_around(&corners).1.powi(2)));
        }
        let land: f64 = areas.iter().sum();
        let largest = areas.iter().copied().fold(0.0, f64::max);
        areas.retain(|area| *area > ISLAND);
        #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
        let block_spread = {
            let logs: Vec<f64> = areas.iter().map(|area| area.log10()).collect();
            let mean = logs.iter().sum::<f64>() / (logs.len() as f64).max(1.0);
            (logs.iter().map(|log| (log - mean).powi(2)).sum::<f64>() / (logs.len() as f64).max(1.0)).sqrt()
        };
        Measures {
            length,
            degree,
            shares: [count(&|n| n == 1) / all, count(&|n| n == 3) / all, count(&|n| n >= 4) / all],
            circuity: if straight > 0.0 { length / straight } else { 1.0 },
            meshedness,
            orientation_order: order(&bins),
            block: median(areas),
            block_spread,
            block_shape: median(shapes),
            segment: median(lengths),
            density: if land > 0.0 { 1000.0 * length / land } else { 0.0 },
            largest,
            #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
            zigzags: self.zigzags() as f64 / (length / 1000.0).max(1e-9),
            stubs: self.stubs(),
            triangles: self.triangles(&faces),
            knots: self.knots(&faces),
        }
    }

    /// Returns the streets between junctions.
    fn runs(&self) -> StreetRuns {
        let (mut lengths, mut straight, mut bins) = (Vec::new(), 0.0, [0.0; 36]);
        for way in self.ways_between(|junction| self.junctions[junction as usize].degree() != 2) {
            let (Some(first), Some(last)) = (way.first(), way.last()) else { continue };
            lengths.push(way.iter().map(|course| self.length(course.piece)).sum());
            let straight_way = self.at(self.across(last.piece, last.from)) - self.at(first.from);
            straight += straight_way.length();
            if straight_way.length() > 0.0 {
                for way in [straight_way, -straight_way] {
                    // North is 0, clockwise, with bins around the directions they are named by.
                    let bearing = way.x.atan2(way.y).to_degrees().rem_euclid(360.0);
                    #[allow(
                        clippy::cast_possible_truncation,
                        clippy::cast_sign_loss,
                        reason = "from 0 to 36"
                    )]
                    let bin = ((bearing + 5.0) / 10.0).floor() as usize % 36;
                    bins[bin] += 1.0;
                }
            }
        }
        StreetRuns { lengths, straight, bins }
    }
}

/// Computes the orientation order of direction bins: 1 minus the squared share of the entropy between a grid and
/// uniform directions.
fn order(bins: &[f64; 36]) -> f64 {
    let all: f64 = bins.iter().sum();
    if all == 0.0 {
        return 0.0;
    }
    let entropy: f64 = bins.iter().filter(|bin| **bin > 0.0).map(|bin| -(bin / all) * (bin / all).ln()).sum();
    let (most, grid) = (36.0_f64.ln(), 4.0_f64.ln());
    1.0 - ((entropy - grid) / (most - grid)).max(0.0).powi(2)
}

/// Streets of a network between junctions.
struct StreetRuns {
    /// Length (m) of each street.
    lengths: Vec<f64>,
    /// Sum (m) of the straight distances between their ends.
    straight: f64,
    /// Number of streets in each of 36 directions.
    bins: [f64; 36],
}

/// Returns the median; 0 for no numbers.
fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    let upper = numbers.len() / 2;
    let lower = if numbers.len().is_multiple_of(2) { upper.saturating_sub(1) } else { upper };
    numbers.get(lower).zip(numbers.get(upper)).map_or(0.0, |(lower, upper)| lower.midpoint(*upper))
}

/// Computes the centre and the radius (m) of the smallest circle around some positions.
///
/// Method: E. Welzl, "Smallest enclosing disks (balls and ellipsoids)", 1991, with loops instead of recursion.
fn circle_around(places: &[DVec2]) -> (DVec2, f64) {
    let outside =
        |(middle, radius): (DVec2, f64), place: DVec2| middle.distance(place) > radius * (1.0 + 1e-12);
    let mut circle = (places.first().copied().unwrap_or(DVec2::ZERO), 0.0);
    for (first, &a) in places.iter().enumerate() {
        if !outside(circle, a) {
            continue;
        }
        circle = (a, 0.0);
        for (second, &b) in places[..first].iter().enumerate() {
            if !outside(circle, b) {
                continue;
            }
            circle = (a.midpoint(b), a.distance(b) / 2.0);
            for &c in &places[..second] {
                if outside(circle, c) {
                    circle = circle_through(a, b, c).unwrap_or(circle);
                }
            }
        }
    }
    circle
}

/// Returns the circle through three positions; `None` if they are collinear.
fn circle_through(a: DVec2, b: DVec2, c: DVec2) -> Option<(DVec2, f64)> {
    let (b, c) = (b - a, c - a);
    let twice = 2.0 * b.perp_dot(c);
    let middle = DVec2::new(
        c.y * b.length_squared() - b.y * c.length_squared(),
        b.x * c.length_squared() - c.x * b.length_squared(),
    ) / twice;
    middle.is_finite().then(|| (a + middle, middle.length()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_circle_touches_what_it_has_to() {
        let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (1.0, 1.0)].map(DVec2::from);
        let (middle, radius) = circle_around(&square);
        assert!(middle.distance(DVec2::ONE) < 1e-12 && (radius - 2.0_f64.sqrt()).abs() < 1e-12);
        let flat = [(0.0, 0.0), (4.0, 0.5), (8.0, 0.0)].map(DVec2::from);
        assert!((circle_around(&flat).1 - 4.0).abs() < 1e-12);
    }
}
