//! Division of the sides of a sweep: columns of vertices, joined into strips between sharp edges.

use std::ops::Range;

use glam::{DVec2, DVec3};
use smallvec::{SmallVec, smallvec};

use super::point::Knot;
use crate::limits::FEW;

/// One vertex of each row: a point of the section and the outline's direction there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SkinColumn {
    pub(crate) point: usize,
    pub(crate) tangent: Tangent,
}

/// A weighted mean of the directions of up to three edges.
///
/// The mean is computed after the edges are scaled, so that the direction stays between them.
pub(crate) type Tangent = [(DVec2, f64); 3];

/// Consecutive columns without a sharp edge between them.
#[derive(Debug, Clone)]
pub(crate) struct Strip {
    /// Range of columns; faces join each column to the next one.
    pub(crate) columns: Range<usize>,
    /// Index of the section's ring.
    pub(crate) ring: usize,
    /// Marks a strip along a straight line.
    pub(crate) straight: bool,
}

/// Texture coordinates (m) around the section.
pub(crate) type SkinCoordinates = SmallVec<[f64; 2 * FEW]>;

/// Division of a section's outline.
#[derive(Debug, Clone)]
pub(crate) struct Skin {
    pub(crate) columns: Vec<SkinColumn>,
    pub(crate) strips: Vec<Strip>,
}

impl Skin {
    /// Divides the outline `rings` at the sharp points, or at every point unless the surface is smooth `around`.
    ///
    /// A ring without sharp points is divided at its first point, because texture coordinates begin there.
    pub(crate) fn new(rings: &[Vec<Knot>], open: bool, around: bool) -> Self {
        let mut skin = Self { columns: Vec::new(), strips: Vec::new() };
        let mut first = 0;
        for (index, ring) in rings.iter().enumerate() {
            skin.add_ring(index, first, ring, open, around);
            first += ring.len();
        }
        skin
    }

    fn add_ring(&mut self, index: usize, first: usize, ring: &[Knot], open: bool, around: bool) {
        let count = ring.len();
        let is_sharp = |knot: &Knot| !around || !(knot.smooth || knot.inserted);
        let start = if open { 0 } else { ring.iter().position(is_sharp).unwrap_or(0) };
        let edges = if open { count - 1 } else { count };
        let tangents = Tangents { ring, open, around };
        let mut begin = self.columns.len();
        for step in 0..edges {
            let (from, to) = ((start + step) % count, (start + step + 1) % count);
            if self.columns.len() == begin {
                self.columns.push(SkinColumn { point: first + from, tangent: tangents.tangent_after(from) });
            }
            self.columns.push(SkinColumn { point: first + to, tangent: tangents.tangent_before(to) });
            if step + 1 == edges || is_sharp(&ring[to]) {
                let own = &self.columns[begin..];
                let first = own[0].tangent[0].0;
                let mut tangents = own.iter().flat_map(|column| column.tangent);
                let straight = tangents.all(|(edge, weight)| weight == 0.0 || edge.dot(first) > 1.0 - 1e-9);
                let columns = begin..self.columns.len();
                begin = columns.end;
                self.strips.push(Strip { columns, ring: index, straight });
            }
        }
    }

    /// Returns the columns of a strip.
    pub(crate) fn columns_of(&self, strip: &Strip) -> &[SkinColumn] {
        &self.columns[strip.columns.clone()]
    }

    /// Returns the texture coordinates (m) of all columns along a ring of points, relative to the strips'
    /// centres `middles`.
    ///
    /// They run to both sides from the centre of each strip, so that a tapering face is not sheared.
    pub(crate) fn coordinates_across(&self, points: &[DVec3], middles: &[f64]) -> SkinCoordinates {
        let mut across: SkinCoordinates = smallvec![0.0; self.columns.len()];
        for (strip, middle) in self.strips.iter().zip(middles) {
            let mut sum = 0.0;
            for column in strip.columns.start + 1..strip.columns.end {
                sum += points[self.columns[column].point].distance(points[self.columns[column - 1].point]);
                across[column] = sum;
            }
            strip.columns.clone().for_each(|column| across[column] += middle - sum / 2.0);
        }
        across
    }

    /// Returns the position (m) of each strip's centre along its ring.
    pub(crate) fn middles(&self, points: &[DVec3]) -> SkinCoordinates {
        let (mut ring, mut sum) = (0, 0.0);
        let middle = |strip: &Strip| {
            if strip.ring != ring {
                (ring, sum) = (strip.ring, 0.0);
            }
            let columns = self.columns_of(strip).windows(2);
            let length: f64 = columns.map(|pair| points[pair[0].point].distance(points[pair[1].point])).sum();
            sum += length;
            sum - length / 2.0
        };
        self.strips.iter().map(middle).collect()
    }
}

fn single_tangent(edge: DVec2) -> Tangent {
    [(edge, 1.0), (edge, 0.0), (edge, 0.0)]
}

/// Directions of a ring's outline at its points.
struct Tangents<'a> {
    ring: &'a [Knot],
    open: bool,
    around: bool,
}

impl Tangents<'_> {
    /// Returns the direction at a point for the edge that ends there.
    fn tangent_before(&self, point: usize) -> Tangent {
        self.at(point, self.edge(self.previous(point)))
    }

    /// Returns the direction at a point for the edge that begins there.
    fn tangent_after(&self, point: usize) -> Tangent {
        self.at(point, self.edge(point))
    }

    fn at(&self, point: usize, edge: DVec2) -> Tangent {
        let knot = self.ring[point];
        if !self.around {
            single_tangent(edge)
        } else if knot.inserted {
            self.between_corners(point)
        } else if self.is_round(point) {
            [(self.edge(self.previous(point)), 0.5), (self.edge(point), 0.5), (edge, 0.0)]
        } else {
            single_tangent(edge)
        }
    }

    /// Returns true if the direction at a corner is the mean of both edges.
    fn is_round(&self, corner: usize) -> bool {
        let end = self.open && (corner == 0 || corner + 1 == self.ring.len());
        self.ring[corner].smooth && !end
    }

    /// Returns the direction at an inserted point, interpolated between the corners at both ends of its edge.
    fn between_corners(&self, point: usize) -> Tangent {
        let (mut from, mut to) = (self.previous(point), self.next(point));
        while self.ring[from].inserted {
            from = self.previous(from);
        }
        while self.ring[to].inserted {
            to = self.next(to);
        }
        let [a, here, b] = [from, point, to].map(|index| self.ring[index].at);
        let fraction = a.distance(here) / a.distance(b);
        let before = if self.is_round(from) { 0.5 - 0.5 * fraction } else { 0.0 };
        let after = if self.is_round(to) { 0.5 * fraction } else { 0.0 };
        let edge = (b - a).normalize_or_zero();
        [(edge, 1.0 - before - after), (self.edge(self.previous(from)), before), (self.edge(to), after)]
    }

    /// Returns the direction of the edge that begins at a point.
    fn edge(&self, point: usize) -> DVec2 {
        (self.ring[self.next(point)].at - self.ring[point].at).normalize_or_zero()
    }

    fn next(&self, point: usize) -> usize {
        (point + 1) % self.ring.len()
    }

    fn previous(&self, point: usize) -> usize {
        (point + self.ring.len() - 1) % self.ring.len()
    }
}
