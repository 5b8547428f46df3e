//! A rectangle of cells of one level, as a structure of arrays.

use burgeon_base::ModuleKey;

/// A rectangle of cells, by column from the west and row from the north.
///
/// ```
/// use burgeon_terrain::Area;
///
/// let area = Area { x: 2, y: 4, columns: 2, rows: 1 };
/// assert_eq!((area.len(), area.at(1), area.index(3, 4)), (2, (3, 4), 1));
/// assert_eq!(area.quadrants(), Area { x: 4, y: 8, columns: 4, rows: 2 });
/// assert_eq!(area.parent_area(0), Area { x: 1, y: 2, columns: 1, rows: 1 });
/// assert_eq!(area.join(Area { x: 0, y: 4, columns: 1, rows: 1 }), Area { x: 0, y: 4, columns: 4, rows: 1 });
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Area {
    /// Column of the first cell.
    pub x: i64,
    /// Row of the first cell.
    pub y: i64,
    /// Number of columns.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
}

impl Area {
    /// Returns the number of cells.
    pub fn len(self) -> usize {
        self.columns * self.rows
    }

    /// Returns true if the area has no cells.
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }

    /// Returns the parent cells of this area, expanded by `margin` cells per side and clipped to a world of
    /// `across` cells.
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

    /// Returns the area expanded by `margin` cells per side and clipped to a world of `across` cells.
    #[must_use]
    pub fn widen(self, margin: i64, across: i64) -> Self {
        let span = |first: i64, count: usize| {
            let low = (first - margin).max(0);
            let high = (first + count_of(count) + margin).min(across);
            (low, usize::try_from(high - low).unwrap_or(0))
        };
        let ((x, columns), (y, rows)) = (span(self.x, self.columns), span(self.y, self.rows));
        Self { x, y, columns, rows }
    }

    /// Returns the parent cells of this area, expanded by `margin` cells per side, also beyond the world.
    #[must_use]
    pub fn parent_area(self, margin: i64) -> Self {
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

    /// Returns the area expanded by `margin` cells per side, also beyond the world.
    #[must_use]
    pub fn grow(self, margin: u32) -> Self {
        let (less, more) = (i64::from(margin), 2 * margin as usize);
        Self { x: self.x - less, y: self.y - less, columns: self.columns + more, rows: self.rows + more }
    }

    /// Returns the smallest area that contains both areas.
    #[must_use]
    pub fn join(self, other: Self) -> Self {
        match (self.is_empty(), other.is_empty()) {
            (true, _) => other,
            (_, true) => self,
            _ => Self::bounding([self, other].into_iter().flat_map(|it| [it.at(0), it.at(it.len() - 1)])),
        }
    }

    /// Returns the area of the quadrants of all cells.
    #[must_use]
    pub fn quadrants(self) -> Self {
        Self { x: self.x * 2, y: self.y * 2, columns: self.columns * 2, rows: self.rows * 2 }
    }

    /// Returns the cells, row by row.
    pub fn cells(self) -> impl Iterator<Item = (i64, i64)> {
        (0..self.len()).map(move |index| self.at(index))
    }

    /// Returns the cell with this index, row by row.
    pub fn at(self, index: usize) -> (i64, i64) {
        let columns = self.columns.max(1);
        (self.x + count_of(index % columns), self.y + count_of(index / columns))
    }

    /// Returns true if the area contains a cell.
    #[inline]
    pub fn contains(self, x: i64, y: i64) -> bool {
        (self.x..self.x + count_of(self.columns)).contains(&x)
            && (self.y..self.y + count_of(self.rows)).contains(&y)
    }

    /// Returns the smallest area that contains all `cells`; empty without cells.
    pub fn bounding(cells: impl Iterator<Item = (i64, i64)>) -> Self {
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

    /// Returns the index of the cell at `x`, `y`, row by row; for a cell outside, the index of the nearest
    /// cell.
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

/// Symbol of a cell, as an index of the names of its layer.
pub type CellSymbol = u16;

/// Cells of an area at one level of the tree, row by row.
#[derive(Debug, Clone)]
pub struct Block {
    /// Level: number of divisions of the world.
    pub level: u32,
    /// Area of the cells.
    pub area: Area,
    /// Symbol of each cell.
    pub symbols: Vec<CellSymbol>,
    /// Height (m) of each cell.
    pub heights: Vec<f64>,
    /// Other parameters of each cell, `stride` per cell: for a rule table, the decay. Empty for cells that
    /// are not divided further.
    pub rest: Vec<f64>,
    /// Number of other parameters per cell.
    pub stride: usize,
    /// Random key of each cell; empty if no rule uses random numbers.
    pub keys: Vec<ModuleKey>,
    /// Addition to the height (m) of each cell, without smoothing; empty if there is none.
    pub forms: Vec<f64>,
    /// Height (m) of the smooth surface at the centre of each cell; empty if the surface has the cells' own
    /// heights.
    pub smooth: Vec<f64>,
}

impl Block {
    /// Returns the height (m) of the surface at the centre of each cell.
    pub fn surface(&self) -> &[f64] {
        if self.smooth.is_empty() { &self.heights } else { &self.smooth }
    }
}
