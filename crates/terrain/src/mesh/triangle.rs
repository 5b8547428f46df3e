//! Right triangles over the squares of cells, and their halving.

use crate::tiles::tile::TilePlace;

/// A corner of the smallest cells: column from the west and row from the north.
pub(crate) type GridCorner = [i64; 2];

/// A triangle with its right angle at `apex`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RightTriangle {
    pub a: GridCorner,
    pub b: GridCorner,
    pub apex: GridCorner,
}

impl RightTriangle {
    /// Returns the midpoint of its longest side, where it is halved; `None` if it cannot be halved.
    pub(crate) fn middle(&self) -> Option<GridCorner> {
        let sum = [self.a[0] + self.b[0], self.a[1] + self.b[1]];
        (sum[0] & 1 == 0 && sum[1] & 1 == 0).then(|| [sum[0] >> 1, sum[1] >> 1])
    }

    pub(crate) fn halves(&self, middle: GridCorner) -> [Self; 2] {
        [Self { a: self.apex, b: self.a, apex: middle }, Self { a: self.b, b: self.apex, apex: middle }]
    }
}

/// Returns the right-angled corners of the two triangles that are halved at a corner, and the ends of their
/// common longest side; `None` for the corners of a world of `across` smallest cells.
pub(crate) fn diamond([x, y]: GridCorner, across: i64) -> Option<([GridCorner; 2], [GridCorner; 2])> {
    let step = (x | y) & -(x | y);
    if step == 0 || step >= across {
        return None;
    }
    let (odd_x, odd_y) = (x & step != 0, y & step != 0);
    let beside = |right: i64, down: i64| [x + right * step, y + down * step];
    Some(if odd_x && odd_y {
        let (one, other) = ([beside(-1, -1), beside(1, 1)], [beside(1, -1), beside(-1, 1)]);
        let [cx, cy] = one[0];
        let even = ((cx / (2 * step)) + (cy / (2 * step))) & 1 == 0;
        if even { (other, one) } else { (one, other) }
    } else if odd_x {
        ([beside(0, -1), beside(0, 1)], [beside(-1, 0), beside(1, 0)])
    } else {
        ([beside(-1, 0), beside(1, 0)], [beside(0, -1), beside(0, 1)])
    })
}

/// Returns the corners of a tile, in cells of the level `finest`: north-west, north-east, south-west and
/// south-east.
pub(crate) fn corners(place: TilePlace, finest: u32) -> [GridCorner; 4] {
    let size = 1i64 << (finest - place.level);
    let [x, y] = [place.x * size, place.y * size];
    [[x, y], [x + size, y], [x, y + size], [x + size, y + size]]
}

/// Returns the two root triangles of a tile, counter-clockwise from above.
pub(crate) fn roots(place: TilePlace, finest: u32) -> [RightTriangle; 2] {
    let [a, b, c, d] = corners(place, finest);
    if (place.x + place.y) & 1 == 0 {
        [RightTriangle { a, b: d, apex: b }, RightTriangle { a: d, b: a, apex: c }].map(orient)
    } else {
        [RightTriangle { a: b, b: c, apex: a }, RightTriangle { a: c, b, apex: d }].map(orient)
    }
}

/// Orients a triangle counter-clockwise as seen from above, where rows run to the south.
pub(crate) fn orient(triangle: RightTriangle) -> RightTriangle {
    let RightTriangle { a, b, apex } = triangle;
    let [u, v] = [[b[0] - a[0], b[1] - a[1]], [apex[0] - a[0], apex[1] - a[1]]];
    if u[0] * v[1] - u[1] * v[0] < 0 { triangle } else { RightTriangle { a: b, b: a, apex } }
}
