//! A rectangle of cells of one level, in columns.

use burgeon_rewriting::{ModuleKey, Symbol};

/// A rectangle of cells, by column from the west and row from the north.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Area {
    /// Column of its first cell.
    pub x: i64,
    /// Row of its first cell.
    pub y: i64,
    /// Number of columns.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
}

impl Area {
    /// The number of cells.
    pub fn len(self) -> usize {
        self.columns * self.rows
    }

    /// Whether it has no cells.
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }

    /// The cells whose quadrants cover this area, and `margin` more on each side; none outside a world of `across`
    /// cells.
    #[must_use]
    pub fn parents(self, margin: i64, across: i64) -> Self {
        let span = |first: i64, count: usize| {
            let last = first + count_of(count) - 1;
            let low = (first.div_euclid(2) - margin).max(0);
            let high = (last.div_euclid(2) + margin).min(across - 1);
            (low, usize::try_from(high - low + 1).unwrap_or(0))
        };
        let ((x, columns), (y, rows)) = (span(self.x, self.columns), span(self.y, self.rows));
        Self { x, y, columns, rows }
    }

    /// The area with `margin` cells more on each side; none outside a world of `across` cells.
    #[must_use]
    pub fn widened(self, margin: i64, across: i64) -> Self {
        let span = |first: i64, count: usize| {
            let low = (first - margin).max(0);
            let high = (first + count_of(count) + margin).min(across);
            (low, usize::try_from(high - low).unwrap_or(0))
        };
        let ((x, columns), (y, rows)) = (span(self.x, self.columns), span(self.y, self.rows));
        Self { x, y, columns, rows }
    }

    /// The cells whose quadrants cover this area, and `margin` more on each side, also outside the world.
    #[must_use]
    pub fn above(self, margin: i64) -> Self {
        let span = |first: i64, count: usize| {
            let low = first.div_euclid(2) - margin;
            let high = (first + count_of(count) - 1).div_euclid(2) + margin;
            (low, usize::try_from(high - low + 1).unwrap_or(0))
        };
        if self.is_empty() {
            return self;
        }
        let ((x, columns), (y, rows)) = (span(self.x, self.columns), span(self.y, self.rows));
        Self { x, y, columns, rows }
    }

    /// The area with `margin` cells more on each side, also outside the world.
    #[must_use]
    pub fn grown(self, margin: u32) -> Self {
        let (less, more) = (i64::from(margin), 2 * margin as usize);
        Self { x: self.x - less, y: self.y - less, columns: self.columns + more, rows: self.rows + more }
    }

    /// The smallest area that holds this one and another.
    #[must_use]
    pub fn joined(self, other: Self) -> Self {
        match (self.is_empty(), other.is_empty()) {
            (true, _) => other,
            (_, true) => self,
            _ => Self::around([self, other].into_iter().flat_map(|it| [it.at(0), it.at(it.len() - 1)])),
        }
    }

    /// The quadrants of its cells.
    #[must_use]
    pub fn quadrants(self) -> Self {
        Self { x: self.x * 2, y: self.y * 2, columns: self.columns * 2, rows: self.rows * 2 }
    }

    /// Its cells, row by row.
    pub fn cells(self) -> impl Iterator<Item = (i64, i64)> {
        (0..self.len()).map(move |index| self.at(index))
    }

    /// The cell with this number, row by row.
    pub fn at(self, index: usize) -> (i64, i64) {
        let columns = self.columns.max(1);
        (self.x + count_of(index % columns), self.y + count_of(index / columns))
    }

    /// Whether it holds a cell.
    #[inline]
    pub fn contains(self, x: i64, y: i64) -> bool {
        (self.x..self.x + count_of(self.columns)).contains(&x)
            && (self.y..self.y + count_of(self.rows)).contains(&y)
    }

    /// The smallest area that holds all of `cells`; empty without any.
    pub fn around(cells: impl Iterator<Item = (i64, i64)>) -> Self {
        let spans = cells.fold(None, |spans: Option<[i64; 4]>, (x, y)| {
            let [west, north, east, south] = spans.unwrap_or([x, y, x, y]);
            Some([west.min(x), north.min(y), east.max(x), south.max(y)])
        });
        let count = |low: i64, high: i64| usize::try_from(high - low + 1).unwrap_or(0);
        spans.map_or(Self { x: 0, y: 0, columns: 0, rows: 0 }, |[west, north, east, south]| Self {
            x: west,
            y: north,
            columns: count(west, east),
            rows: count(north, south),
        })
    }

    /// Where the cell at `x`, `y` is among its cells, row by row; the nearest one for a cell outside.
    #[inline]
    pub fn index(self, x: i64, y: i64) -> usize {
        let within = |at: i64, first: i64, count: usize| {
            usize::try_from(at - first).unwrap_or(0).min(count.saturating_sub(1))
        };
        within(y, self.y, self.rows) * self.columns + within(x, self.x, self.columns)
    }
}

#[allow(clippy::cast_possible_wrap, reason = "no block has 2^63 cells")]
fn count_of(count: usize) -> i64 {
    count as i64
}

/// The cells of an area at one level of the tree, row by row.
#[derive(Debug, Clone)]
pub struct Block {
    /// How often the world has been divided.
    pub level: u32,
    /// Which cells they are.
    pub area: Area,
    /// The symbol of each.
    pub symbols: Vec<Symbol>,
    /// The height (m) of each.
    pub heights: Vec<f64>,
    /// The other parameters of each, `stride` for every cell: of a rule table its decay. Empty for cells that nobody
    /// divides any more.
    pub rest: Vec<f64>,
    /// How many other parameters each has.
    pub stride: usize,
    /// The random key of each; empty where no rule draws.
    pub keys: Vec<ModuleKey>,
    /// What is added to the height (m) of each as it is, without smoothing; empty for nothing.
    pub forms: Vec<f64>,
    /// The height (m) of the smooth surface at the middle of each; empty for the cells' own heights.
    pub smooth: Vec<f64>,
}

impl Block {
    /// The height (m) of the surface at the middle of each cell.
    pub fn surface(&self) -> &[f64] {
        if self.smooth.is_empty() { &self.heights } else { &self.smooth }
    }
}
