//! Triangulation of unions of rectangles in one plane.

use glam::DVec2;

use super::planar::twice_area;

/// A rectangle between lines, which are identified by their numbers in ascending order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct UnionCell {
    /// Lower and upper line.
    pub y: [u32; 2],
    /// Left and right line.
    pub x: [u32; 2],
}

/// Crossing of two lines, by their numbers: x and y.
pub type Crossing = [u32; 2];

/// Triangulation of the union of rectangles; its memory is reused by the next union.
///
/// The vertices are the corners of the union's outline and requested positions on the outline, each only
/// once. Geometry that meets the outline at these positions has no T-junctions with it, and the inside has
/// none.
///
/// ```
/// use burgeon_geometry::{UnionCell, Union};
///
/// // A storey of three panes with a window in the middle: lines 0 to 3 across, 0 to 3 up.
/// let mut cells = vec![
///     UnionCell { y: [0, 1], x: [0, 3] },
///     UnionCell { y: [1, 2], x: [0, 1] },
///     UnionCell { y: [1, 2], x: [2, 3] },
///     UnionCell { y: [2, 3], x: [0, 3] },
/// ];
/// cells.sort_unstable();
/// let mut union = Union::default();
/// union.triangulate(&cells, &[], [&[0.0, 1.0, 2.0, 3.0], &[0.0, 0.9, 2.1, 3.0]]);
/// // The corners of the wall and of the window, and no others.
/// assert_eq!((union.vertices.len(), union.triangles.len()), (8, 8));
/// ```
#[derive(Debug, Default)]
pub struct Union {
    /// Vertices.
    pub vertices: Vec<Crossing>,
    /// Counter-clockwise triangles of indices of vertices.
    pub triangles: Vec<[u32; 3]>,
    /// Lines on which a rectangle begins or ends or a requested position lies.
    lines: Vec<u32>,
    /// Rectangles above the current line, from left to right.
    open: Vec<UnionCell>,
    /// Intervals of the union just below the current line, and just above it.
    below: Vec<[u32; 2]>,
    above: Vec<[u32; 2]>,
    /// Upper border of the triangulated area, from left to right, over all that is just below the line.
    front: Vec<u32>,
    next: Vec<u32>,
    /// Vertices on the current line: x, whether the union is just below, and whether it is just above on the
    /// left.
    line: Vec<(u32, bool, bool)>,
}

/// Minimum ratio of the height of a triangle to its longest side.
const THIN: f64 = 1e-8;

impl Union {
    /// Reports the corners of the union's outline.
    ///
    /// `cells` are sorted and do not overlap.
    pub fn corners(&mut self, cells: &[UnionCell], mut found: impl FnMut(Crossing)) {
        self.begin(cells, &[]);
        let mut rest = cells;
        for line in 0..self.lines.len() {
            let y = self.lines[line];
            rest = self.advance(y, rest);
            self.find_line(&[]);
            self.line.iter().for_each(|(x, ..)| found([*x, y]));
        }
    }

    /// Triangulates `cells` between lines at `places` (m); `cells` are sorted and do not overlap.
    ///
    /// Those of `others` that lie on the outline also become vertices; `others` are sorted by y, then x.
    ///
    /// Method: a sweep with a front that is a chain of vertices from left to right, as in the triangulation
    /// of monotone polygons (M. R. Garey and others, "Triangulating a simple polygon", 1978).
    pub fn triangulate(&mut self, cells: &[UnionCell], others: &[Crossing], places: [&[f64]; 2]) {
        self.begin(cells, others);
        let (mut rest, mut others) = (cells, others);
        for line in 0..self.lines.len() {
            let y = self.lines[line];
            rest = self.advance(y, rest);
            let (here, later) = others.split_at(others.partition_point(|at| at[1] <= y));
            others = later;
            self.find_line(here);
            self.move_front(y, places);
        }
    }

    fn begin(&mut self, cells: &[UnionCell], others: &[Crossing]) {
        self.lines.clear();
        self.lines.extend(cells.iter().flat_map(|cell| cell.y).chain(others.iter().map(|at| at[1])));
        self.lines.sort_unstable();
        self.lines.dedup();
        self.vertices.clear();
        self.triangles.clear();
        self.open.clear();
        self.above.clear();
        self.front.clear();
    }

    /// Advances to line `y`, and returns the cells of `rest` that begin above it.
    fn advance<'a>(&mut self, y: u32, rest: &'a [UnionCell]) -> &'a [UnionCell] {
        std::mem::swap(&mut self.below, &mut self.above);
        self.open.retain(|cell| cell.y[1] > y);
        let (begun, rest) = rest.split_at(rest.partition_point(|cell| cell.y[0] <= y));
        self.open.extend(begun);
        self.open.sort_unstable_by_key(|cell| cell.x);
        self.above.clear();
        for cell in &self.open {
            match self.above.last_mut() {
                Some(last) if last[1] >= cell.x[0] => last[1] = last[1].max(cell.x[1]),
                _ => self.above.push(cell.x),
            }
        }
        rest
    }

    /// Finds the vertices on the current line; some of them may be `others`.
    fn find_line(&mut self, others: &[Crossing]) {
        let Self { below, above, line, .. } = self;
        line.clear();
        let mut ends =
            [below.iter().flatten().copied().peekable(), above.iter().flatten().copied().peekable()];
        let mut others = others.iter().map(|at| at[0]).peekable();
        // Position relative to the union on the left of x, below and above the line.
        let mut inside = [false; 2];
        loop {
            let [low, high] = &mut ends;
            let next = [low.peek(), high.peek(), others.peek()];
            let Some(x) = next.into_iter().flatten().copied().min() else { break };
            let left = inside;
            for (inside, ends) in inside.iter_mut().zip(&mut ends) {
                while ends.next_if_eq(&x).is_some() {
                    *inside = !*inside;
                }
            }
            let asked = others.next_if_eq(&x).is_some();
            let is_straight = left == inside || (left[0] == left[1] && inside[0] == inside[1]);
            let is_on = left != inside || left[0] != left[1];
            if !is_straight || (asked && is_on) {
                line.push((x, left[0] || inside[0], left[1]));
            }
        }
    }

    /// Triangulates the area between the front and line `y`.
    fn move_front(&mut self, y: u32, places: [&[f64]; 2]) {
        let Self { vertices, triangles, below, above, front, next, line, .. } = self;
        let first = vertices.len();
        vertices.extend(line.iter().map(|(x, ..)| [*x, y]));
        let x_of = |vertices: &[Crossing], vertex: u32| vertices[vertex as usize][0];
        next.clear();
        let mut chain = front.as_slice();
        let mut points = (first as u32..).zip(line.iter()).peekable();
        for &[left, right] in below.iter() {
            while let Some((lone, _)) = points.next_if(|(_, (x, ..))| *x < left) {
                next.push(lone);
            }
            let begin = next.len();
            // Index in `next` of the previous vertex on this line.
            let mut before = None;
            while let Some((point, &(x, _, above_left))) = points.next_if(|(_, (x, ..))| *x <= right) {
                let corner = |vertex: u32| {
                    let [x, y] = vertices[vertex as usize];
                    DVec2::new(places[0][x as usize], places[1][y as usize])
                };
                if x > left {
                    let passed = chain.partition_point(|vertex| x_of(vertices, *vertex) <= x);
                    next.extend(&chain[..passed]);
                    chain = &chain[passed..];
                    if let (Some(&from), Some(&to), true) = (next.last(), chain.first(), x < right) {
                        triangles.push([from, to, point]);
                    }
                }
                let closes = before.filter(|_| !above_left);
                while let [.., a, b] = next[begin..]
                    && is_wide([a, b, point].map(corner))
                {
                    triangles.push([a, b, point]);
                    next.pop();
                }
                if let Some(before) = closes {
                    next.push(point);
                    close(next, before, triangles, corner);
                    next.pop();
                }
                before = Some(next.len());
                next.push(point);
                while let [a, b, ..] = *chain
                    && x_of(vertices, b) <= right
                    && is_wide([point, a, b].map(corner))
                {
                    triangles.push([point, a, b]);
                    chain = &chain[1..];
                }
            }
            let passed = chain.partition_point(|vertex| x_of(vertices, *vertex) <= right);
            next.extend(&chain[..passed]);
            chain = &chain[passed..];
        }
        next.extend(points.map(|(lone, _)| lone));
        let mut intervals = above.iter().peekable();
        next.retain(|vertex| {
            let x = x_of(vertices, *vertex);
            while intervals.next_if(|[_, right]| *right < x).is_some() {}
            intervals.peek().is_some_and(|[left, _]| *left <= x)
        });
        std::mem::swap(front, next);
    }
}

/// Triangulates the area below the straight line from the vertex at `from` in `chain` to its last vertex.
fn close(chain: &mut Vec<u32>, from: usize, triangles: &mut Vec<[u32; 3]>, corner: impl Fn(u32) -> DVec2) {
    while chain.len() > from + 2 {
        let widest = (from + 1..chain.len() - 1).max_by(|a, b| {
            let area = |at: &usize| twice_area([chain[at - 1], chain[*at], chain[at + 1]].map(&corner));
            area(a).total_cmp(&area(b))
        });
        let Some(at) = widest else { break };
        triangles.push([chain[at - 1], chain[at], chain[at + 1]]);
        chain.remove(at);
    }
}

/// Returns true if a triangle is counter-clockwise and not thin.
fn is_wide([a, b, c]: [DVec2; 3]) -> bool {
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    twice_area([a, b, c]) > THIN * longest
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use proptest::prelude::*;

    use super::*;

    /// A grid of squares; true if a square is in the union.
    type Squares = Vec<Vec<bool>>;

    /// Converts squares to rectangles; `long` selects those that extend over several squares.
    fn cells(squares: &Squares, long: &[bool]) -> Vec<UnionCell> {
        let mut cells: Vec<UnionCell> = Vec::new();
        for (y, row) in (0u32..).zip(squares) {
            for (x, _) in (0u32..).zip(row).filter(|(_, inside)| **inside) {
                let beside = |cell: &&mut UnionCell| cell.y == [y, y + 1] && cell.x[1] == x;
                let joins = long[cells.len() % long.len()];
                match cells.last_mut().filter(beside).filter(|_| joins) {
                    Some(cell) => cell.x[1] = x + 1,
                    None => cells.push(UnionCell { x: [x, x + 1], y: [y, y + 1] }),
                }
            }
        }
        cells.sort_unstable();
        cells
    }

    /// Returns the four squares around a crossing: lower left, lower right, upper left, upper right.
    fn around(squares: &Squares, [x, y]: Crossing) -> [bool; 4] {
        let inside = |x: Option<u32>, y: Option<u32>| {
            let row = squares.get(y? as usize)?;
            row.get(x? as usize).copied()
        };
        let (left, low) = (x.checked_sub(1), y.checked_sub(1));
        let found = [(left, low), (Some(x), low), (left, Some(y)), (Some(x), Some(y))];
        found.map(|(x, y)| inside(x, y).unwrap_or(false))
    }

    fn squares() -> impl Strategy<Value = Squares> {
        (1usize..8, 1usize..8).prop_flat_map(|(width, height)| {
            let row = prop::collection::vec(prop::bool::weighted(0.7), width);
            prop::collection::vec(row, height)
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn a_union_has_the_corners_of_its_outline_and_triangles_without_t_junctions(
            squares in squares(),
            long in prop::collection::vec(any::<bool>(), 1..9),
            steps in prop::collection::vec(prop::sample::select(vec![0.01, 1.0, 2.5, 30.0]), 16),
            asked in prop::collection::vec(any::<bool>(), 64),
        ) {
            let (width, height) = (squares[0].len() as u32, squares.len() as u32);
            let places = |steps: &[f64]| -> Vec<f64> {
                steps.iter().scan(0.0, |sum, step| { *sum += step; Some(*sum) }).collect()
            };
            let (xs, ys) = (places(&steps[..8]), places(&steps[8..]));
            let crossings = || (0..=height).flat_map(|y| (0..=width).map(move |x| [x, y]));
            let others: Vec<Crossing> = crossings().zip(&asked).filter(|it| *it.1).map(|it| it.0).collect();
            let is_corner = |at: &Crossing| {
                let [a, b, c, d] = around(&squares, *at);
                !((a == b && c == d) || (a == c && b == d))
            };
            let is_on = |at: &Crossing| {
                let found = around(&squares, *at);
                found.contains(&true) && found.contains(&false)
            };
            let mut union = Union::default();
            let cells = cells(&squares, &long);
            let mut corners = Vec::new();
            union.corners(&cells, |at| corners.push(at));
            prop_assert_eq!(corners, crossings().filter(is_corner).collect::<Vec<_>>());
            union.triangulate(&cells, &others, [&xs, &ys]);
            let expected = crossings().filter(|at| is_corner(at) || (others.contains(at) && is_on(at)));
            prop_assert_eq!(&union.vertices, &expected.collect::<Vec<_>>());

            let place = |[x, y]: Crossing| DVec2::new(xs[x as usize], ys[y as usize]);
            let mut area = 0.0;
            let mut sides = HashSet::new();
            for triangle in &union.triangles {
                let corners = triangle.map(|vertex| place(union.vertices[vertex as usize]));
                prop_assert!(twice_area(corners) > 1e-9);
                area += twice_area(corners) / 2.0;
                for side in 0..3 {
                    prop_assert!(sides.insert([triangle[side], triangle[(side + 1) % 3]]), "a side is there twice");
                }
            }
            let size = |cell: &UnionCell| {
                (place([cell.x[1], cell.y[1]]) - place([cell.x[0], cell.y[0]])).element_product()
            };
            let whole: f64 = cells.iter().map(size).sum();
            prop_assert!((area - whole).abs() < 1e-9 * whole.max(1.0), "{area} m², not {whole} m²");
            for &[from, to] in sides.iter().filter(|[from, to]| !sides.contains(&[*to, *from])) {
                let [[a, b], [c, d]] = [from, to].map(|vertex| union.vertices[vertex as usize]);
                prop_assert!(a == c || b == d, "a side that no other triangle has is on the outline");
                let between = union.vertices.iter().filter(|[x, y]| {
                    let within = |at: u32, a: u32, b: u32| (a.min(b)..=a.max(b)).contains(&at);
                    within(*x, a, c) && within(*y, b, d)
                });
                prop_assert_eq!(between.count(), 2, "no vertex is between its ends");
            }
        }
    }

    #[test]
    fn a_row_of_windows_takes_six_triangles_for_each_and_two() {
        for count in [1u32, 5, 40] {
            let mut cells = vec![UnionCell { x: [2 * count, 2 * count + 1], y: [0, 3] }];
            for left in (0..count).map(|number| 2 * number) {
                cells.push(UnionCell { x: [left, left + 1], y: [0, 3] });
                cells.extend([[0, 1], [2, 3]].map(|y| UnionCell { x: [left + 1, left + 2], y }));
            }
            cells.sort_unstable();
            let places: Vec<f64> = (0..2 * count + 2).map(f64::from).collect();
            let mut union = Union::default();
            union.triangulate(&cells, &[], [&places, &places]);
            let found = (union.vertices.len() as u32, union.triangles.len() as u32);
            assert_eq!(found, (4 * count + 4, 6 * count + 2));
        }
    }
}
