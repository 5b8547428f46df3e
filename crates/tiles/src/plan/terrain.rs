//! Terrain tiles of a plan.

use serde::{Deserialize, Serialize};

use super::grid::TileGrid;
use super::planned_file::PlannedFile;
use super::tile_id::{DEEPEST, TileId};

/// Terrain of a plan: squares of a height grid, in a quadtree with its own levels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlannedTerrain {
    /// File of the heights.
    pub file: PlannedFile,
    /// West, south, east and north (m) of the heights, relative to the origin of the frame.
    pub area: [f64; 4],
    /// Level of the largest tiles.
    pub coarsest: u32,
    /// Level of the smallest tiles.
    pub finest: u32,
    /// Set if tiles have the colours of a terrain of the script.
    #[serde(default)]
    pub is_colored: bool,
}

impl PlannedTerrain {
    /// Number of squares along a side of a tile.
    pub const SQUARES: u32 = 64;

    /// Returns the terrain of heights in `area` (m) that are `step` (m) apart. The smallest tiles have at least as many points as the
    /// file, and at most four of the largest tiles cover the area.
    ///
    /// ```
    /// use burgeon_tiles::plan::{PlannedFile, PlannedTerrain};
    ///
    /// let file = PlannedFile { path: "hills.tif".into(), hash: String::new() };
    /// let terrain = PlannedTerrain::new(file, [-3000.0, -2000.0, 3000.0, 2000.0], 10.0);
    /// let tiles = terrain.tile_ids();
    /// assert_eq!((terrain.coarsest, terrain.finest), (9, 13));
    /// assert_eq!(tiles.iter().filter(|tile| tile.level == 9).count(), 4);
    /// assert_eq!(tiles.iter().filter(|tile| tile.level == 13).count(), 12 * 8);
    /// ```
    pub fn new(file: PlannedFile, area: [f64; 4], step: f64) -> Self {
        let [west, south, east, north] = area;
        let wide = (east - west).max(north - south);
        let level =
            |is_enough: &dyn Fn(f64) -> bool| (0..=DEEPEST).find(|level| is_enough(TileGrid::side(*level)));
        let finest = level(&|side| Self::spacing_of(side) <= step).unwrap_or(DEEPEST);
        // The first level with sides smaller than the area is one too many.
        let coarsest = level(&|side| side < wide).unwrap_or(DEEPEST).saturating_sub(1).min(finest);
        Self { file, area, coarsest, finest, is_colored: false }
    }

    fn spacing_of(side: f64) -> f64 {
        side / f64::from(Self::SQUARES)
    }

    /// Returns the distance (m) of the points of the tiles of a level.
    pub fn spacing(level: u32) -> f64 {
        Self::spacing_of(TileGrid::side(level))
    }

    /// Returns the tiles that share more than a border with the area, in the order of the curve.
    pub fn tile_ids(&self) -> Vec<TileId> {
        let mut tiles = Vec::new();
        for level in self.coarsest..=self.finest {
            let most = (1_u32 << level) - 1;
            let [half, side] = [TileGrid::side(0) / 2.0, TileGrid::side(level)];
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the grid")]
            let index = |number: f64| number.clamp(0.0, f64::from(most)) as u32;
            let first = |low: f64| index(((low + half) / side).floor());
            let last = |high: f64| index(((high + half) / side).ceil() - 1.0);
            let [west, south, east, north] = self.area;
            for y in first(south)..=last(north) {
                tiles.extend((first(west)..=last(east)).map(|x| TileId { level, x, y }));
            }
        }
        tiles.sort_by_key(|tile| tile.curve());
        tiles
    }

    /// Returns west, south, east and north (m) of the part of a tile that is in the area.
    pub(super) fn part(&self, tile: TileId) -> [f64; 4] {
        let ([a, b, c, d], [west, south, east, north]) = (TileGrid::bounds(tile), self.area);
        [a.max(west), b.max(south), c.min(east), d.min(north)]
    }
}
