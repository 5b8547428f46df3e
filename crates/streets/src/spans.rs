//! Bridges: where a street is carried over what lies below it.

use glam::{DVec2, DVec3};

use crate::network::{PieceId, StreetNetwork};
use crate::profile::StreetProfiles;
use crate::rows::alongs_of;
use crate::shape::StreetShapes;
use crate::surface::SurfaceOptions;

/// How far apart (m) what carries a bridge stands at most.
const BAY: f64 = 24.0;
/// How closely (m) the shore is looked for.
const LOOK: f64 = 0.5;

/// A street that leads over an obstacle.
#[derive(Debug, Clone, PartialEq)]
pub struct StreetSpan {
    /// The piece that it is.
    pub piece: PieceId,
    /// The direction of its way, of length 1.
    pub way: DVec2,
    /// Its outer edges (m) on the right and on the left, from its first end to its last, at the height of the street.
    pub sides: [Vec<DVec3>; 2],
    /// Where it comes to what it leads over, and where it leaves that: the middles (m), at the height of the street.
    pub shores: Vec<DVec3>,
    /// The middles (m) of what carries it between, at the height of the street.
    pub piers: Vec<DVec3>,
}

impl StreetNetwork {
    /// The bridges of its streets.
    pub fn spans(&self, options: SurfaceOptions, profiles: &StreetProfiles) -> Vec<StreetSpan> {
        let shapes = StreetShapes::new(self, options.turning);
        let bridges = self.pieces().filter(|(_, piece)| piece.is_bridge);
        bridges.map(|(piece, _)| self.span(&shapes, profiles, piece)).collect()
    }

    fn span(&self, shapes: &StreetShapes<'_>, profiles: &StreetProfiles, piece: PieceId) -> StreetSpan {
        let [start, stop] = self.line(piece);
        let (way, length) = ((stop - start).normalize_or_zero(), start.distance(stop));
        let half = self.half(piece);
        let [from, to] = self.ends(piece);
        let (rows, _) = alongs_of(shapes, profiles, piece);
        let sides = [-half, half].map(|aside| {
            let mut line = vec![shapes.end(from, piece, aside).extend(profiles.junction(from))];
            let at = |along: &f64| start + way * *along + way.perp() * aside;
            line.extend(rows.iter().map(|along| at(along).extend(profiles.along(piece, *along))));
            line.push(shapes.end(to, piece, -aside).extend(profiles.junction(to)));
            line
        });
        // Over it where any of the three lines along the street is.
        let is_over = |along: f64| {
            [-half, 0.0, half]
                .iter()
                .any(|aside| self.obstacles.at(start + way * along + way.perp() * *aside).is_some())
        };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "pieces are short")]
        let count = (length / LOOK) as u32;
        let over = || (0..=count).map(|index| f64::from(index) * LOOK).filter(|along| is_over(*along));
        let middle = |along: f64| (start + way * along).extend(profiles.along(piece, along));
        let (mut shores, mut piers) = (Vec::new(), Vec::new());
        if let (Some(first), Some(last)) = (over().next(), over().next_back()) {
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
}
