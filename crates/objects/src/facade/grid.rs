//! `grid { ... }`: one wall, repeated in rows and columns.

use std::sync::{Arc, LazyLock};

use super::size::{Count, Size};
use super::wall::{Wall, WallRule, wall_kind};
use burgeon_base::error::{Error, Result};
use burgeon_geometry::{SAME, Sizes};
use burgeon_kit::{Kind, fields};

/// What `grid { ... }` takes.
#[fields("grid")]
pub struct GridOptions {
    /// The wall that is repeated; all cells are equal.
    pub wall: Option<Wall>,
    /// How many stand side by side: a number or { least, greatest }.
    pub columns: Count,
    /// How many stand above each other.
    pub rows: Count,
    /// Width (m): preferred, { least, greatest } or { least, preferred, greatest }.
    pub width: Option<Size>,
    /// Height (m), in the same way.
    pub height: Option<Size>,
}

/// The type, as scripts see it.
pub fn kind() -> &'static Arc<Kind> {
    static KIND: LazyLock<Arc<Kind>> = LazyLock::new(|| {
        let kind = Kind::new(
            "grid",
            "One wall, repeated in rows and columns as often as fits its preferred size best.",
        )
        .first("wall")
        .example(include_str!("../../scripts/grid.lua"));
        wall_kind(kind, GridOptions::fields(), |table| make(&GridOptions::from_table(table)?))
    });
    &KIND
}

fn make(options: &GridOptions) -> Result<Wall> {
    let Some(wall) = options.wall.clone() else {
        return Err(
            Error::argument("grid: there is no wall to repeat").help("write grid { wall = panel { } }")
        );
    };
    let counts = [options.columns, options.rows].map(|count| count.low..=count.high);
    let sizes =
        |side: usize| wall.0.sizes[side].times(counts[side].clone()).map_err(|error| error.about("grid"));
    let sizes = [sizes(0)?, sizes(1)?];
    // Only where the number is given, the cells' preferred size tells that of the whole.
    let target = |side: usize| {
        let count = &counts[side];
        wall.0.targets[side]
            .filter(|_| count.start() == count.end())
            .map(|each| each * f64::from(*count.start()))
    };
    let targets = [target(0), target(1)];
    Wall::new(WallRule::Grid { counts, wall }, sizes, targets, [options.width, options.height], None)
}

/// How many cells of `sizes` fill `whole` (m), each as near to `target` as can be; `None` if no number does.
///
/// Without a target, cells are halfway between their least and greatest size, or as small as can be if they have
/// no greatest, or as few as can be if they have no least size either.
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
    // Beyond these bounds a cell is too small or too large.
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
