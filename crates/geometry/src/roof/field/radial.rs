//! Heights around an apex.

use glam::DVec2;

use super::heights::HeightPlane;
use crate::planar::{Polygon, edges};
use burgeon_base::error::{Error, Result};

/// Minimum distance (m) of an apex from the lines of the edges.
const CLEAR: f64 = 0.05;

/// Place of an apex, and the outline at which the slopes around it begin.
#[derive(Debug, Clone)]
pub(super) struct Apex {
    /// Place of the apex.
    pub at: DVec2,
    /// Corners of the outline, counter-clockwise; the apex sees all of them.
    pub outline: Vec<DVec2>,
    /// Set if the outline is the convex hull of the walls.
    pub is_hull: bool,
}

impl Apex {
    /// Finds an apex of a plan: the centroid of its outer outline if all corners are visible from it, otherwise the centroid of
    /// the area from which they are, otherwise that of the convex hull. Holes have no influence.
    pub(super) fn new(walls: &Polygon) -> Result<Self> {
        let empty =
            || Error::argument("a roof around an apex needs an outline").help("give at least 3 corners");
        let outer = walls.outer().ok_or_else(empty)?.to_vec();
        let centroid = centroid(&outer);
        if sees(&outer, centroid) {
            return Ok(Self { at: centroid, outline: outer, is_hull: false });
        }
        let mut kernel = walls.hull().ok_or_else(empty)?.to_vec();
        for [a, b] in edges(&outer) {
            kernel = clipped(&kernel, a, (b - a).normalize_or_zero());
        }
        if kernel.len() > 2 {
            let at = self::centroid(&kernel);
            if sees(&outer, at) {
                return Ok(Self { at, outline: outer, is_hull: false });
            }
        }
        let hull = walls.hull().ok_or_else(empty)?.to_vec();
        Ok(Self { at: self::centroid(&hull), outline: hull, is_hull: true })
    }

    /// Returns the distance (m) of the apex from the nearest edge's line.
    pub(super) fn radius(&self) -> f64 {
        edges(&self.outline)
            .map(|[a, b]| (b - a).normalize_or_zero().perp_dot(self.at - a).max(CLEAR))
            .fold(f64::INFINITY, f64::min)
    }
}

/// Returns the centroid of a ring.
fn centroid(ring: &[DVec2]) -> DVec2 {
    let from = ring.first().copied().unwrap_or_default();
    let (mut sum, mut area) = (DVec2::ZERO, 0.0);
    for [a, b] in edges(ring) {
        let part = (a - from).perp_dot(b - from);
        (sum, area) = (sum + (a + b - 2.0 * from) * part, area + part);
    }
    if area.abs() < 1e-12 { from } else { from + sum / (3.0 * area) }
}

/// Returns true if all edges of a ring face a place.
fn sees(ring: &[DVec2], place: DVec2) -> bool {
    edges(ring).all(|[a, b]| (b - a).normalize_or_zero().perp_dot(place - a) > CLEAR)
}

/// Returns the part of a ring to the left of a line.
fn clipped(ring: &[DVec2], from: DVec2, way: DVec2) -> Vec<DVec2> {
    let mut kept = Vec::new();
    for [a, b] in edges(ring) {
        let [one, other] = [a, b].map(|at| way.perp_dot(at - from));
        if one >= 0.0 {
            kept.push(a);
        }
        if (one < 0.0) != (other < 0.0) {
            kept.push(a.lerp(b, one / (one - other)));
        }
    }
    kept
}

/// Sectors around an apex between the corners of an outline, divided into rings: scaled copies of the outline.
#[derive(Debug, Clone)]
pub(in crate::roof) struct RadialGauge {
    apex: DVec2,
    outline: Vec<DVec2>,
    /// Scales of the rings, from 0 to 1.
    shares: Vec<f64>,
}

impl RadialGauge {
    /// Creates the sectors and rings around an apex.
    pub(super) fn new(apex: &Apex, shares: Vec<f64>) -> Self {
        Self { apex: apex.at, outline: apex.outline.clone(), shares }
    }

    /// Returns the number of bands between two rings.
    fn bands(&self) -> usize {
        self.shares.len().saturating_sub(1).max(1)
    }

    /// Returns the plane of each band of each sector, for the height (m) at each share of the outline.
    pub(super) fn planes(&self, profile: &[(f64, f64)]) -> Vec<HeightPlane> {
        let mut planes = Vec::new();
        for [a, b] in edges(&self.outline) {
            let inward = (b - a).normalize_or_zero().perp();
            let far = inward.dot(self.apex - a).max(1e-6);
            for pair in profile.windows(2) {
                let [(near, high), (share, low)] = [pair[0], pair[1]];
                planes.push(HeightPlane {
                    at: self.apex + (a - self.apex) * share,
                    height: low,
                    gradient: inward * ((high - low) / ((share - near).max(1e-9) * far)),
                });
            }
        }
        planes
    }

    /// Returns the index of the plane at a place.
    pub(super) fn index(&self, place: DVec2) -> usize {
        let off = place - self.apex;
        let is_in = |[a, b]: [DVec2; 2]| {
            let [a, b] = [a - self.apex, b - self.apex];
            a.perp_dot(off) >= 0.0 && b.perp_dot(off) < 0.0
        };
        let sector = edges(&self.outline).position(is_in).unwrap_or(0);
        let (a, b) = (self.outline[sector], self.outline[(sector + 1) % self.outline.len()]);
        let inward = (b - a).normalize_or_zero().perp();
        let share = inward.dot(off) / inward.dot(a - self.apex).min(-1e-9);
        let inner = &self.shares[1..self.shares.len().saturating_sub(1).max(1)];
        sector * self.bands() + inner.partition_point(|limit| *limit < share)
    }

    /// Returns the lines between sectors, up to a distance (m), and the rings.
    pub(super) fn lines(&self, reach: f64) -> Vec<Vec<DVec2>> {
        let spoke = |corner: &DVec2| {
            let way = (*corner - self.apex).normalize_or_zero();
            // The corner itself is on the line, so that the line passes through it exactly.
            vec![self.apex, *corner, *corner + way * reach]
        };
        let mut lines: Vec<Vec<DVec2>> = self.outline.iter().map(spoke).collect();
        for share in self.shares.iter().filter(|share| **share > 0.0 && **share < 1.0) {
            let mut ring: Vec<DVec2> =
                self.outline.iter().map(|corner| self.apex + (*corner - self.apex) * *share).collect();
            ring.extend(ring.first().copied());
            lines.push(ring);
        }
        lines
    }
}
