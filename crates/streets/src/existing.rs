//! Streets that are there before a network grows: those of a survey, whose lines cross, touch and repeat one another.
//!
//! They keep their places, and need not keep the angles and distances that new streets keep. What they have in common
//! with new ones is that they meet at junctions only.

use glam::DVec2;

use crate::grid::{GridPlace, crossing, foot, meet};
use crate::network::{JunctionId, PieceId, StreetAttributes, StreetNetwork};

/// How near (m) a street comes to another or to a junction that it is meant to touch.
const TOLERANCE: f64 = 0.25;
/// How often a street may be divided on average, before what is left is given up.
const TRIES: usize = 200;

/// A street that is there.
#[derive(Debug, Clone, PartialEq)]
pub struct ExistingStreet {
    /// Its places (m) one after another.
    pub line: Vec<DVec2>,
    /// What it is.
    pub attributes: StreetAttributes,
    /// Whether it leads over or under others, so that it has no junction where it crosses them.
    pub is_bridge: bool,
}

/// What became of the pieces of existing streets that are not in the network.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ExistingLosses {
    /// Those with places that are not finite, or too far away.
    pub outside: usize,
    /// Those that lie where another does.
    pub repeated: usize,
    /// Those of bridges that cross other streets: a network is planar.
    pub over: usize,
    /// Those that lie among so many others that no order was found.
    pub tangled: usize,
}

/// A piece on its way into the network.
#[derive(Debug, Clone, Copy)]
struct ExistingPiece {
    ends: [GridPlace; 2],
    attributes: StreetAttributes,
    is_bridge: bool,
}

/// What stands between a piece and the network.
enum PieceObstacle {
    /// A place on it where it has to have a junction.
    Junction(GridPlace),
    /// A piece that has to have a junction at a place.
    Piece(PieceId, GridPlace),
    /// It is there already.
    Repeated,
    /// It leads over a street.
    Over,
}

impl StreetNetwork {
    /// Adds streets that are there, whose crossings become junctions unless one of the two is a bridge; says what was
    /// left out.
    ///
    /// Every place is moved to the grid, and to the street or junction that it comes within 0.25 m of. Streets that
    /// thereby turn a little are asked again, until nothing crosses.
    pub fn add_existing(&mut self, streets: &[ExistingStreet]) -> ExistingLosses {
        let mut losses = ExistingLosses::default();
        let mut due = Vec::new();
        // The last are the first: bridges come when everything that they cross is there.
        for street in [true, false]
            .into_iter()
            .flat_map(|is_bridge| streets.iter().rev().filter(move |street| street.is_bridge == is_bridge))
        {
            for pair in street.line.windows(2).rev() {
                let (Some(a), Some(b)) = (GridPlace::nearest(pair[0]), GridPlace::nearest(pair[1])) else {
                    losses.outside += 1;
                    continue;
                };
                let (attributes, is_bridge) = (street.attributes, street.is_bridge);
                due.push(ExistingPiece { ends: [a, b], attributes, is_bridge });
            }
        }
        let mut tries = due.len() * TRIES + 1000;
        while let Some(piece) = due.pop() {
            if tries == 0 {
                losses.tangled += 1;
                continue;
            }
            tries -= 1;
            // One after the other, so that no two junctions are nearer than the tolerance.
            let piece = ExistingPiece { ends: piece.ends.map(|end| self.settle(end)), ..piece };
            let [a, b] = piece.ends;
            if a == b {
                continue;
            }
            let half = |ends| ExistingPiece { ends, ..piece };
            match self.before(&piece) {
                None => {
                    let ends = piece.ends.map(|end| self.junction(end));
                    self.add(ends, piece.attributes, piece.is_bridge);
                }
                Some(PieceObstacle::Repeated) => losses.repeated += 1,
                Some(PieceObstacle::Over) => losses.over += 1,
                Some(PieceObstacle::Junction(place)) => {
                    due.extend([half([place, b]), half([a, place])]);
                }
                Some(PieceObstacle::Piece(other, place)) => {
                    due.push(piece);
                    // Its halves may turn enough to meet others, so they are asked like new ones.
                    let (ends, known) = (self.grid_line(other), self.pieces[other as usize]);
                    self.detach(other);
                    for ends in [[ends[0], place], [place, ends[1]]] {
                        due.push(ExistingPiece {
                            ends,
                            attributes: known.attributes,
                            is_bridge: known.is_bridge,
                        });
                    }
                }
            }
        }
        losses
    }

    /// Makes a place a junction, unless there is one that it is meant to be; gives where that is.
    fn settle(&mut self, place: GridPlace) -> GridPlace {
        let at = place.metres();
        let near = self
            .junctions_near([at; 2], TOLERANCE)
            .map(|junction| (self.at(junction).distance(at), junction));
        let near = near.filter(|(distance, _)| *distance <= TOLERANCE);
        let nearest = near.min_by(|(a, of_a), (b, of_b)| a.total_cmp(b).then(of_a.cmp(of_b)));
        let junction = nearest.map(|(_, junction)| junction);
        let junction = junction.unwrap_or_else(|| self.junction(place));
        self.junctions[junction as usize].place
    }

    /// The first thing that stands between a piece and the network; `None` if nothing does.
    fn before(&self, piece: &ExistingPiece) -> Option<PieceObstacle> {
        let [a, b] = piece.ends;
        let line = piece.ends.map(GridPlace::metres);
        let is_end = |place: GridPlace| place == a || place == b;
        // Junctions on its way.
        let on_way = self.junctions_near(line, TOLERANCE).filter_map(|junction| {
            let place = self.junctions[junction as usize].place;
            let along = foot(place.metres(), line).1;
            (!is_end(place) && is_between(place, piece.ends)).then_some((along, junction))
        });
        let first: Option<(f64, JunctionId)> =
            on_way.min_by(|(a, of_a), (b, of_b)| a.total_cmp(b).then(of_a.cmp(of_b)));
        if let Some((_, junction)) = first {
            return Some(PieceObstacle::Junction(self.junctions[junction as usize].place));
        }
        let mut near: Vec<PieceId> = self.pieces_near(line, TOLERANCE).collect();
        near.sort_unstable();
        for other in near {
            let ends = self.grid_line(other);
            if ends == [a, b] || ends == [b, a] {
                return Some(PieceObstacle::Repeated);
            }
            // An end on the other's way.
            let on_other = [a, b].into_iter().find(|end| !ends.contains(end) && is_between(*end, ends));
            if let Some(end) = on_other {
                return Some(PieceObstacle::Piece(other, end));
            }
            let meets = meet(piece.ends, ends) && !ends.iter().any(|end| is_end(*end));
            if meets && piece.is_bridge != self.pieces[other as usize].is_bridge {
                return Some(PieceObstacle::Over);
            }
            if meets
                && let Some(along) = crossing(self.line(other), line)
                && let Some(place) = GridPlace::nearest(self.line(other)[0].lerp(self.line(other)[1], along))
            {
                return Some(PieceObstacle::Piece(other, place));
            }
        }
        None
    }
}

/// Whether a place is on the way between two others: near enough, and not just near one of them, so that both halves
/// are shorter than the whole.
fn is_between(place: GridPlace, [a, b]: [GridPlace; 2]) -> bool {
    let [at, from, to] = [place, a, b].map(GridPlace::metres);
    foot(at, [from, to]).0 <= TOLERANCE && (from - at).dot(to - at) < 0.0
}
