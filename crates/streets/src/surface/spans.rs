//! Bridges that carry a street over an obstacle.

use glam::{DVec2, DVec3};

use super::parts::SurfaceOptions;
use super::rows::alongs_of;
use crate::plan::network::{PieceId, StreetNetwork};
use crate::shape::profile::StreetProfiles;
use crate::shape::shapes::{ArmShape, StreetShapes};

/// Maximum distance (m) between piers of a bridge.
const BAY: f64 = 24.0;
/// Sampling distance (m) for finding the shore.
const LOOK: f64 = 0.5;
/// Distance (m) before the shore at which a bridge begins.
const LANDING: f64 = 3.0;

/// Street that crosses an obstacle on a bridge.
#[derive(Debug, Clone, PartialEq)]
pub struct StreetSpan {
    /// Street segment.
    pub piece: PieceId,
    /// Direction (unit vector).
    pub way: DVec2,
    /// Outer edges (m) on the right and on the left, from a little before the obstacle to a little beyond it, at the
    /// height of the street.
    pub sides: [Vec<DVec3>; 2],
    /// Points of the centreline (m) at both shores of the obstacle, at the height of the street.
    pub shores: Vec<DVec3>,
    /// Centres (m) of the piers between the shores, at the height of the street.
    pub piers: Vec<DVec3>,
}

impl StreetNetwork {
    /// Returns the bridges of streets on the ground; bridges over other streets are decks of the surfaces.
    pub fn spans(&self, options: SurfaceOptions, profiles: &StreetProfiles) -> Vec<StreetSpan> {
        let shapes = StreetShapes::new(self, options.turning);
        let bridges = self.pieces().filter(|(_, piece)| piece.is_bridge && piece.attributes.level == 0);
        bridges.map(|(piece, _)| self.span(&shapes, profiles, piece)).collect()
    }

    fn span(&self, shapes: &StreetShapes<'_>, profiles: &StreetProfiles, piece: PieceId) -> StreetSpan {
        let [start, stop] = self.line(piece);
        let (way, length) = ((stop - start).normalize_or_zero(), start.distance(stop));
        let half = self.half(piece);
        let ends = self.ends(piece);
        let over = self.covered_range(piece);
        let carried = bridge_range(over, length);
        let clear = ends.map(|end| shapes.arm(end, piece).map_or(0.0, ArmShape::clear));
        // If there is little land in between, the bridge begins at the end of the junction.
        let [from, to] = [0, 1].map(|side| {
            let along = if side == 0 { carried[0] } else { length - carried[1] };
            (along > clear[side] + LANDING).then_some(carried[side])
        });
        let (rows, _) = alongs_of(shapes, profiles, piece);
        let is_between = |along: &&f64| {
            from.is_none_or(|from| **along > from + LOOK) && to.is_none_or(|to| **along < to - LOOK)
        };
        let sides = [-half, half].map(|aside| {
            let at = |along: f64| {
                (start + way * along + way.perp() * aside).extend(profiles.height_along(piece, along))
            };
            let end = |side: usize, aside: f64| {
                shapes.end(ends[side], piece, aside).extend(profiles.junction(ends[side]))
            };
            let mut line = vec![from.map_or_else(|| end(0, aside), at)];
            line.extend(rows.iter().filter(is_between).map(|along| at(*along)));
            line.push(to.map_or_else(|| end(1, -aside), at));
            line
        });
        let middle = |along: f64| (start + way * along).extend(profiles.height_along(piece, along));
        let (mut shores, mut piers) = (Vec::new(), Vec::new());
        if let Some([first, last]) = over {
            shores = vec![middle(first), middle(last)];
            let bays = ((last - first) / BAY).ceil().max(1.0);
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "bridges have few bays"
            )]
            let inner = 1..bays as u32;
            piers = inner.map(|index| middle(first + (last - first) * f64::from(index) / bays)).collect();
        }
        StreetSpan { piece, way, sides, shores, piers }
    }

    /// Returns the range (m) along a segment that is over obstacles, if any.
    fn covered_range(&self, piece: PieceId) -> Option<[f64; 2]> {
        let [start, stop] = self.line(piece);
        let (way, length, half) =
            ((stop - start).normalize_or_zero(), start.distance(stop), self.half(piece));
        // A position is over an obstacle if any of three lines along the street is.
        let is_over = |along: &f64| {
            let at = |aside: f64| start + way * *along + way.perp() * aside;
            [-half, 0.0, half].into_iter().any(|aside| self.obstacles.at(at(aside)).is_some())
        };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "pieces are short")]
        let count = (length / LOOK) as u32;
        let mut over = (0..=count).map(|index| f64::from(index) * LOOK).filter(is_over);
        let first = over.next()?;
        Some([first, over.next_back().unwrap_or(first)])
    }

    /// Returns the range (m) along a segment that a bridge carries; `None` if it is not a bridge.
    pub(crate) fn carried_range(&self, piece: PieceId) -> Option<[f64; 2]> {
        self.is_bridge(piece).then(|| bridge_range(self.covered_range(piece), self.length(piece)))
    }
}

/// Returns the range (m) that a bridge carries of a street of a length (m), from the range over obstacles; the whole
/// street if that range is unknown.
fn bridge_range(over: Option<[f64; 2]>, length: f64) -> [f64; 2] {
    over.map_or([0.0, length], |[first, last]| [(first - LANDING).max(0.0), (last + LANDING).min(length)])
}
