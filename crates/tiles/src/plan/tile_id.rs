//! Places of tiles in the quadtree.

use std::fmt;
use std::str::FromStr;

use burgeon_base::error::{Error, Result};
use serde::{Deserialize, Serialize};

/// Place of a tile in the quadtree: level 0 is the whole grid; x counts to the east and y to the north.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct TileId {
    /// Level, from 0.
    pub level: u32,
    /// Column, from 0.
    pub x: u32,
    /// Row, from 0.
    pub y: u32,
}

/// Largest level.
pub(super) const DEEPEST: u32 = 16;

impl TileId {
    /// Whole grid.
    pub const ROOT: Self = Self { level: 0, x: 0, y: 0 };

    /// Level of the largest tiles of a plan. The tiles of such a tile have its axes, so that tiling can be implicit below it.
    pub const ANCHOR: u32 = 9;

    /// Returns the largest tile that contains this one; larger tiles, of coarser levels of detail, are their own.
    #[must_use]
    pub fn anchor(self) -> Self {
        self.ancestor(self.level.min(Self::ANCHOR))
    }

    /// Returns the place of the tile in the quadtree that begins with `root`, which contains it.
    #[must_use]
    pub fn within(self, root: Self) -> Self {
        let level = self.level.saturating_sub(root.level);
        Self { level, x: self.x.wrapping_sub(root.x << level), y: self.y.wrapping_sub(root.y << level) }
    }

    /// Returns the four tiles inside, in the order of the curve.
    #[must_use]
    pub fn children(self) -> [Self; 4] {
        [0, 1, 2, 3].map(|quarter| Self {
            level: self.level + 1,
            x: self.x * 2 + (quarter & 1),
            y: self.y * 2 + (quarter >> 1),
        })
    }

    /// Returns the tile that contains this one; `None` for the root.
    pub fn parent(self) -> Option<Self> {
        Some(Self { level: self.level.checked_sub(1)?, x: self.x / 2, y: self.y / 2 })
    }

    /// Returns the tile of a level that contains this one, or this one.
    #[must_use]
    pub fn ancestor(self, level: u32) -> Self {
        let up = self.level.saturating_sub(level);
        Self { level: self.level - up, x: self.x >> up, y: self.y >> up }
    }

    /// Returns the smallest tile that contains this one and another.
    #[must_use]
    pub fn common(self, other: Self) -> Self {
        let mut level = self.level.min(other.level);
        while self.ancestor(level) != other.ancestor(level) {
            level -= 1;
        }
        self.ancestor(level)
    }

    /// Returns true if `tile`, which has at least the level of this one, is inside this one or before it on the curve.
    pub(crate) fn is_not_before(self, tile: Self) -> bool {
        tile.ancestor(self.level).curve() <= self.curve()
    }

    /// Returns the positions on the curve of the tiles inside.
    pub(crate) fn span(self) -> std::ops::Range<u64> {
        let begin = self.curve().0;
        begin..begin + (1 << (2 * DEEPEST.saturating_sub(self.level)))
    }

    /// Returns the position of the tile on a curve through all tiles that keeps neighbours together (Morton's order).
    pub fn curve(self) -> (u64, u32) {
        let shift = DEEPEST.saturating_sub(self.level);
        let spread = |value: u32| {
            (0..DEEPEST).fold(0_u64, |bits, bit| bits | u64::from(value << shift >> bit & 1) << (2 * bit))
        };
        (spread(self.x) | spread(self.y) << 1, self.level)
    }
}

impl fmt::Display for TileId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}/{}", self.level, self.x, self.y)
    }
}

impl FromStr for TileId {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let numbers: Vec<u32> = text.split('/').filter_map(|part| part.parse().ok()).collect();
        match numbers[..] {
            [level, x, y] if level <= DEEPEST && x < 1 << level && y < 1 << level => Ok(Self { level, x, y }),
            _ => Err(Error::argument(format!(
                "{text:?} is not a tile: write level, column and row, such as 5/17/9"
            ))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_are_written_and_read_as_level_column_and_row() {
        let tile: TileId = "5/17/9".parse().unwrap();
        assert_eq!((tile, tile.to_string().as_str()), (TileId { level: 5, x: 17, y: 9 }, "5/17/9"));
        assert_eq!((tile.parent().unwrap().to_string(), TileId::ROOT.parent()), ("4/8/4".to_owned(), None));
        assert_eq!(tile.ancestor(2).to_string(), "2/2/1");
        assert_eq!(tile.within(tile.ancestor(3)).to_string(), "2/1/1");
        assert!(tile.children().iter().all(|child| child.parent() == Some(tile)));
        for text in ["", "1/2", "1/2/0", "99/0/0", "a/b/c", "1/0/0/0"] {
            assert!(text.parse::<TileId>().is_err(), "{text}");
        }
    }

    #[test]
    fn the_curve_visits_a_tile_completely_before_the_next() {
        let mut all: Vec<TileId> =
            (0..8).flat_map(|x| (0..8).map(move |y| TileId { level: 3, x, y })).collect();
        all.sort_by_key(|tile| tile.curve());
        let quarters: Vec<TileId> = all.iter().map(|tile| tile.ancestor(1)).collect();
        let mut distinct = quarters.clone();
        distinct.dedup();
        assert_eq!((all.len(), distinct.len()), (64, 4));
    }
}
