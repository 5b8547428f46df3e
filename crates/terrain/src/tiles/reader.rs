//! Reading of the ground at points that are near each other.

use glam::{DVec2, DVec3};

use super::ground::Ground;
use super::tile::Tile;

/// Ground at a point.
#[derive(Debug, Clone, Copy)]
pub struct GroundReading<'a> {
    /// Height (m), as [`Ground::height`] returns it.
    pub height: f64,
    /// Surface normal (a unit vector), as [`Ground::way_up`] returns it.
    pub normal: DVec3,
    /// Name of the symbol of the cell.
    pub symbol: &'a str,
}

/// Reader of the ground at one point after another. Points in the same cell or in the next one share the corners of cells,
/// whose normals take most of the time.
pub struct GroundReader<'a> {
    ground: &'a Ground,
    last: Option<CellCorners<'a>>,
}

/// Heights (m) and normals at the corners of a cell: north-west, north-east, south-west and south-east.
#[derive(Debug, Clone, Copy)]
struct CellCorners<'a> {
    level: u32,
    cell: (i64, i64),
    /// Name of the symbol of the cell.
    symbol: &'a str,
    heights: [Option<f64>; 4],
    normals: [DVec3; 4],
}

impl<'a> GroundReader<'a> {
    /// Creates a reader of `ground`.
    pub fn new(ground: &'a Ground) -> Self {
        Self { ground, last: None }
    }

    /// Returns the ground that is read.
    pub fn ground(&self) -> &'a Ground {
        self.ground
    }

    /// Returns the ground at `place` (m); `None` outside the expanded area.
    pub fn at(&mut self, place: DVec2) -> Option<GroundReading<'a>> {
        let ground = self.ground;
        let (tile, cell, part) = ground.find(place)?;
        self.load_corners(tile, cell);
        let corners = self.last.as_ref()?;
        let shift = ground.finest() - tile.level();
        let height = |x: i64, y: i64| {
            let at = ((x >> shift) - cell.0) + 2 * ((y >> shift) - cell.1);
            usize::try_from(at).ok().and_then(|at| corners.heights.get(at).copied().flatten())
        };
        let laid = ground.interpolate(tile, cell, part, height)?;
        let [north_west, north_east, south_west, south_east] = corners.normals;
        let north = north_west.lerp(north_east, part.x);
        let south = south_west.lerp(south_east, part.x);
        Some(GroundReading {
            height: ground.complete(tile, place, laid),
            normal: north.lerp(south, part.y).normalize(),
            symbol: corners.symbol,
        })
    }

    /// Keeps the corners of a cell of `tile`.
    fn load_corners(&mut self, tile: &Tile, cell: (i64, i64)) {
        let (ground, level) = (self.ground, tile.level());
        let in_row = |last: &CellCorners<'_>| last.level == level && last.cell.1 == cell.1;
        if self.last.as_ref().is_some_and(|last| last.cell.0 == cell.0 && in_row(last)) {
            return;
        }
        let shift = ground.finest() - level;
        let corner = |right: i64, down: i64| {
            let (x, y) = ((cell.0 + right) << shift, (cell.1 + down) << shift);
            (ground.surface_height(x, y), ground.normal(x, y))
        };
        let all = match self.last {
            Some(last) if last.cell.0 + 1 == cell.0 && in_row(&last) => {
                let west = |at: usize| (last.heights[at], last.normals[at]);
                [west(1), corner(1, 0), west(3), corner(1, 1)]
            }
            _ => [corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)],
        };
        self.last = Some(CellCorners {
            level,
            cell,
            symbol: ground.world().name(level, tile.symbol(cell.0, cell.1)),
            heights: all.map(|(height, _)| height),
            normals: all.map(|(_, normal)| normal),
        });
    }
}
