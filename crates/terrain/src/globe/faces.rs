//! The six faces of a cube, and the adjacency of their sides.

/// A face: its axes and its adjacent sides.
pub(super) struct CubeFace {
    /// East, north and outward directions.
    pub axes: [[i8; 3]; 3],
    /// Adjacent sides beyond its west, east, north and south.
    beyond: [FaceSide; 4],
}

/// The adjacent side of another face.
struct FaceSide {
    face: usize,
    side: usize,
    /// Set if columns or rows run in the opposite direction along it.
    reversed: bool,
}

const WEST: usize = 0;
const EAST: usize = 1;
const NORTH: usize = 2;
const SOUTH: usize = 3;

const fn same(face: usize, side: usize) -> FaceSide {
    FaceSide { face, side, reversed: false }
}

const fn reverse_side(face: usize, side: usize) -> FaceSide {
    FaceSide { face, side, reversed: true }
}

/// The faces: four around the equator, the north pole and the south pole.
pub(super) static FACES: [CubeFace; 6] = [
    CubeFace {
        axes: [[0, 1, 0], [0, 0, 1], [1, 0, 0]],
        beyond: [same(3, EAST), same(1, WEST), same(4, SOUTH), same(5, NORTH)],
    },
    CubeFace {
        axes: [[-1, 0, 0], [0, 0, 1], [0, 1, 0]],
        beyond: [same(0, EAST), same(2, WEST), reverse_side(4, EAST), same(5, EAST)],
    },
    CubeFace {
        axes: [[0, -1, 0], [0, 0, 1], [-1, 0, 0]],
        beyond: [same(1, EAST), same(3, WEST), reverse_side(4, NORTH), reverse_side(5, SOUTH)],
    },
    CubeFace {
        axes: [[1, 0, 0], [0, 0, 1], [0, -1, 0]],
        beyond: [same(2, EAST), same(0, WEST), same(4, WEST), reverse_side(5, WEST)],
    },
    CubeFace {
        axes: [[0, 1, 0], [-1, 0, 0], [0, 0, 1]],
        beyond: [same(3, NORTH), reverse_side(1, NORTH), reverse_side(2, NORTH), same(0, NORTH)],
    },
    CubeFace {
        axes: [[0, 1, 0], [1, 0, 0], [0, 0, -1]],
        beyond: [reverse_side(3, SOUTH), same(1, SOUTH), same(0, SOUTH), reverse_side(2, SOUTH)],
    },
];

/// A cell or a corner of cells: the face, the column from its west and the row from its north.
pub(super) type CubeCell = (usize, i64, i64);

/// Converts a cell that may lie beyond one side of a face with `across` cells per side to the cell of the
/// adjacent face; `None` beyond two sides.
pub(super) fn cell((face, x, y): CubeCell, across: i64) -> Option<CubeCell> {
    let last = across - 1;
    let outside = |at: i64| if at < 0 { -1 - at } else { at - across };
    match (side(x, last, WEST), side(y, last, NORTH)) {
        (None, None) => Some((face, x, y)),
        (Some(side), None) => Some(cell_beyond(face, side, (outside(x), y), last)),
        (None, Some(side)) => Some(cell_beyond(face, side, (outside(y), x), last)),
        (Some(_), Some(_)) => None,
    }
}

/// Converts a corner of cells that may lie beyond one side of a face with `across` cells per side to the
/// corner of the adjacent face; `None` beyond two sides.
pub(super) fn corner((face, x, y): CubeCell, across: i64) -> Option<CubeCell> {
    let outside = |at: i64| if at < 0 { -at } else { at - across };
    match (side(x, across, WEST), side(y, across, NORTH)) {
        (None, None) => Some((face, x, y)),
        (Some(side), None) => Some(cell_beyond(face, side, (outside(x), y), across)),
        (None, Some(side)) => Some(cell_beyond(face, side, (outside(y), x), across)),
        (Some(_), Some(_)) => None,
    }
}

/// Returns all names of a corner of cells: its own, and on the boundary of its face also those of the
/// adjacent faces.
pub(super) fn aliases((face, x, y): CubeCell, across: i64) -> impl Iterator<Item = CubeCell> {
    let on = |at: i64, low: usize| match at {
        0 => Some(low),
        _ if at == across => Some(low + 1),
        _ => None,
    };
    let one = on(x, WEST).map(|side| cell_beyond(face, side, (0, y), across));
    let other = on(y, NORTH).map(|side| cell_beyond(face, side, (0, x), across));
    [Some((face, x, y)), one, other].into_iter().flatten()
}

/// Returns the side beyond which a column or row outside 0 to `last` lies: `low` or the next side.
fn side(at: i64, last: i64, low: usize) -> Option<usize> {
    if at < 0 { Some(low) } else { (at > last).then_some(low + 1) }
}

/// Returns the cell or corner beyond a side, by its distance from the side and its position along it.
fn cell_beyond(face: usize, side: usize, (depth, along): (i64, i64), last: i64) -> CubeCell {
    let FaceSide { face, side, reversed } = FACES[face].beyond[side];
    let along = if reversed { last - along } else { along };
    match side {
        WEST => (face, depth, along),
        EAST => (face, last - depth, along),
        NORTH => (face, along, depth),
        _ => (face, along, last - depth),
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::super::sphere::direction;
    use super::*;

    const ACROSS: i64 = 16;

    fn point((face, x, y): CubeCell, half: f64) -> DVec3 {
        let at = |at: i64| (at as f64 + half) * 2.0 / ACROSS as f64 - 1.0;
        direction(face, DVec2::new(at(x), -at(y)))
    }

    #[test]
    fn neighbouring_faces_meet() {
        for face in 0..6 {
            for at in 0..=ACROSS {
                for spot in [(face, 0, at), (face, ACROSS, at), (face, at, 0), (face, at, ACROSS)] {
                    let known: Vec<CubeCell> = aliases(spot, ACROSS).collect();
                    assert_eq!(known.len(), if at % ACROSS == 0 { 3 } else { 2 });
                    for alias in &known {
                        assert!(point(*alias, 0.0).distance(point(spot, 0.0)) < 1e-12, "{spot:?} {alias:?}");
                        let mut back: Vec<CubeCell> = aliases(*alias, ACROSS).collect();
                        let mut there = known.clone();
                        back.sort_unstable();
                        there.sort_unstable();
                        assert_eq!(back, there);
                    }
                }
            }
        }
    }

    #[test]
    fn a_cell_beyond_a_side_is_beside_the_cell_at_that_side() {
        for face in 0..6 {
            for at in 0..ACROSS {
                for (inside, out) in [
                    ((face, 0, at), (face, -1, at)),
                    ((face, ACROSS - 1, at), (face, ACROSS, at)),
                    ((face, at, 0), (face, at, -1)),
                    ((face, at, ACROSS - 1), (face, at, ACROSS)),
                ] {
                    let there = cell(out, ACROSS).unwrap();
                    assert!(there.0 != face);
                    let apart = point(there, 0.5).distance(point(inside, 0.5));
                    assert!(apart < 1.6 * 1.45 / ACROSS as f64, "{out:?} {there:?} {apart}");
                }
            }
            assert_eq!(cell((face, -1, -1), ACROSS), None);
            assert_eq!(corner((face, -1, ACROSS + 1), ACROSS), None);
        }
    }

    #[test]
    fn a_corner_beyond_a_side_is_on_a_straight_way() {
        for face in 0..6 {
            let (inside, rim, out) = ((face, 1, 8), (face, 0, 8), (face, -1, 8));
            let [a, b] = [(inside, rim), (rim, corner(out, ACROSS).unwrap())]
                .map(|(from, to)| point(to, 0.0) - point(from, 0.0));
            assert!(a.angle_between(b) < 0.2);
        }
    }
}
