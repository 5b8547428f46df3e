//! Grid of the tiles of all plans.

use super::tile_id::{DEEPEST, TileId};

/// Grid of tiles around the origin of a frame, which contains all places that a model can have. It does not depend on the data,
/// so a tile keeps its place when features are added.
#[derive(Debug, Clone, Copy)]
pub struct TileGrid;

/// Side (m) of the grid.
const SIDE: f64 = 4_194_304.0;

impl TileGrid {
    /// Returns the side (m) of the tiles of a level: 8,192 for the largest tiles of a plan, so that a vertex in f32 is exact to a
    /// third of a millimetre.
    pub fn side(level: u32) -> f64 {
        SIDE / f64::from(1_u32 << level)
    }

    /// Returns west, south, east and north (m) of a tile, relative to the origin of the frame. The sides of neighbours are the
    /// same numbers.
    pub fn bounds(tile: TileId) -> [f64; 4] {
        // All of these numbers are multiples of a power of two, so they are exact.
        let at = |number: u32| Self::side(tile.level) * f64::from(number) - SIDE / 2.0;
        [at(tile.x), at(tile.y), at(tile.x + 1), at(tile.y + 1)]
    }

    /// Returns the tile of the deepest level that contains a point (m); `None` outside the grid.
    pub(super) fn finest(place: [f64; 2]) -> Option<TileId> {
        let number = |axis: usize| {
            let number = ((place[axis] + SIDE / 2.0) / Self::side(DEEPEST)).floor();
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "the range is checked"
            )]
            (0.0..f64::from(1_u32 << DEEPEST)).contains(&number).then_some(number as u32)
        };
        let mut tile = TileId { level: DEEPEST, x: number(0)?, y: number(1)? };
        // The sum is rounded; the sides decide.
        let [west, south, east, north] = Self::bounds(tile);
        let most = (1 << DEEPEST) - 1;
        tile.x = (tile.x + u32::from(place[0] >= east)).saturating_sub(u32::from(place[0] < west)).min(most);
        tile.y =
            (tile.y + u32::from(place[1] >= north)).saturating_sub(u32::from(place[1] < south)).min(most);
        Some(tile)
    }
}
