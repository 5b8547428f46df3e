//! `grid { ... }`: one wall, repeated in rows and columns.

use std::sync::{Arc, LazyLock};

use super::size::{Count, Size};
use super::wall::{Wall, WallRule, wall_kind};
use burgeon_base::error::{Error, Result};
use burgeon_geometry::{SAME, Sizes};
use burgeon_kit::{Kind, fields};

/// Fields of `grid { ... }`.
#[fields("grid")]
pub struct GridOptions {
    /// Wall to repeat; all cells are equal.
    pub wall: Option<Wall>,
    /// Number of columns: a number or { minimum, maximum }.
    pub columns: Count,
    /// Number of rows: a number or { minimum, maximum }.
    pub rows: Count,
    /// Width of all cells together (m): preferred, { minimum, maximum } or { minimum, preferred, maximum }.
    pub width: Option<Size>,
    /// Height of all cells together (m), in the same form.
    pub height: Option<Size>,
}

/// Returns the script type of grids.
pub fn kind() -> &'static Arc<Kind> {
    static KIND: LazyLock<Arc<Kind>> = LazyLock::new(|| {
        let kind = Kind::new(
            "grid",
            "A wall that is repeated in rows and columns; the number of repetitions fits its preferred size best. `columns` and \
             `rows` are numbers of cells. `width` and `height` are sizes (m) of all cells together; the size of one cell is that \
             of its wall.",
        )
        .first("wall")
        .example(include_str!("../../scripts/grid.lua"));
        wall_kind(kind, GridOptions::fields(), |table| make(GridOptions::from_table(table)?))
    });
    &KIND
}

fn make(options: GridOptions) -> Result<Wall> {
    let Some(wall) = options.wall else {
        return Err(Error::argument("grid: missing wall to repeat").help("write grid { wall = panel { } }"));
    };
    let counts = [options.columns, options.rows].map(|count| count.low..=count.high);
    let sizes =
        |side: usize| wall.0.sizes[side].times(counts[side].clone()).map_err(|error| error.about("grid"));
    let sizes = [sizes(0)?, sizes(1)?];
    // The cells' preferred size determines the size of the whole only if the number of cells is fixed.
    let target = |side: usize| {
        let count = &counts[side];
        wall.0.targets[side]
            .filter(|_| count.start() == count.end())
            .map(|each| each * f64::from(*count.start()))
    };
    let targets = [target(0), target(1)];
    Wall::new(kind(), WallRule::Grid { counts, wall }, sizes, targets, [options.width, options.height], None)
}

/// Returns the number of cells of `sizes` that fill `whole` (m) with a cell size nearest to `target`, or `None` if no
/// number fits.
///
/// Without a target, the target is halfway between the minimum and maximum size. If there is no maximum, it is the
/// minimum; if there is no minimum either, the fewest cells are used.
pub(super) fn count(
    whole: f64,
    counts: &std::ops::RangeInclusive<u32>,
    sizes: &Sizes,
    target: Option<f64>,
) -> Option<u32> {
    let (low, high) = (sizes.low(), sizes.high());
    let target = target.unwrap_or(match (low > SAME, high.is_finite()) {
        (_, true) => f64::midpoint(low, high),
        (true, false) => low,
        (false, false) => whole,
    });
    // Outside these bounds, a cell is too small or too large.
    let ceiling = if low > SAME { whole / low + 1.0 } else { f64::INFINITY };
    let floor = if high.is_finite() { whole / high - 1.0 } else { 0.0 };
    let mut best: Option<(f64, u32)> = None;
    for count in counts.clone() {
        let number = f64::from(count);
        if number > ceiling {
            break;
        }
        let each = whole / number;
        let off = (each - target).abs();
        let fits = number >= floor && sizes.contains(each);
        if fits && best.is_none_or(|(least, _)| off < least) {
            best = Some((off, count));
        }
    }
    best.map(|(_, count)| count)
}
