//! Quadtree that divides features by their expected cost.

use std::collections::BTreeMap;

use burgeon_base::error::{Error, Result};
use burgeon_spatial::{BoundingBox, representative_point};

use super::digest::FeatureDigest;
use super::grid::TileGrid;
use super::tile::PlannedTile;
use super::tile_id::{DEEPEST, TileId};

/// Sums over features.
#[derive(Debug, Clone, Copy)]
struct CellSums {
    features: u64,
    /// Tenths of the cost.
    cost: u64,
    region: [f64; 4],
    ids: FeatureDigest,
    data: FeatureDigest,
}

impl CellSums {
    const NOTHING: Self = Self {
        features: 0,
        cost: 0,
        region: [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY],
        ids: FeatureDigest::ZERO,
        data: FeatureDigest::ZERO,
    };

    fn add(&mut self, other: &Self) {
        self.features += other.features;
        self.cost += other.cost;
        let [west, south, east, north] = other.region;
        let [a, b, c, d] = self.region;
        self.region = [a.min(west), b.min(south), c.max(east), d.max(north)];
        self.ids.add(other.ids);
        self.data.add(other.data);
    }
}

/// TileDivision of features among tiles. Memory grows with the area that features cover, and not with their number.
///
/// ```
/// use burgeon_tiles::plan::{TileDivision, id_digest};
///
/// let mut division = TileDivision::default();
/// for number in 0..1000 {
///     let place = [f64::from(number % 30) * 30.0, f64::from(number / 30) * 20.0].into();
///     let digest = id_digest("trees", &number.to_string());
///     division.add([place, place], 10, digest, digest)?;
/// }
/// let tiles = division.tiles(50);
/// assert_eq!(tiles.iter().map(|tile| tile.features).sum::<u64>(), 1000);
/// assert!(tiles.len() > 20 && tiles.iter().all(|tile| tile.features <= 50));
/// # Ok::<(), burgeon_base::Error>(())
/// ```
#[derive(Debug, Default)]
pub struct TileDivision {
    /// Sums of the tiles of the deepest level, in the order of the curve.
    cells: CellMap,
    /// The same of tall features.
    tall: CellMap,
}

/// Sums of tiles of the deepest level by their positions on the curve.
type CellMap = BTreeMap<u64, (TileId, CellSums)>;

impl TileDivision {
    /// Adds a feature with these bounds (m), its number of points, and the digests of its id and its content.
    ///
    /// Fails if its representative point is outside the grid.
    pub fn add(
        &mut self,
        bounds: BoundingBox,
        points: usize,
        ids: FeatureDigest,
        data: FeatureDigest,
    ) -> Result<()> {
        add(&mut self.cells, bounds, points, ids, data)
    }

    /// Adds a tall feature; see [`add`](Self::add).
    pub fn add_tall(
        &mut self,
        bounds: BoundingBox,
        points: usize,
        ids: FeatureDigest,
        data: FeatureDigest,
    ) -> Result<()> {
        add(&mut self.tall, bounds, points, ids, data)
    }

    /// Adds the features of another division.
    pub fn merge(&mut self, other: Self) {
        for (own, other) in [(&mut self.cells, other.cells), (&mut self.tall, other.tall)] {
            if own.is_empty() {
                // Two copies of the cells of a country are large.
                *own = other;
                continue;
            }
            for (place, (tile, sums)) in other {
                own.entry(place).or_insert((tile, CellSums::NOTHING)).1.add(&sums);
            }
        }
    }

    /// Returns the number of features.
    pub fn features(&self) -> u64 {
        self.cells.values().chain(self.tall.values()).map(|(_, sums)| sums.features).sum()
    }

    /// Returns the tiles in the order of the curve, without hashes. A tile has about `target` features of average cost at
    /// most, unless it is as small as tiles can be.
    ///
    /// Tall features are in the largest tiles that they do not exceed. The other features of these tiles are in tiles inside.
    pub fn tiles(&self, target: u64) -> Vec<PlannedTile> {
        let list = |cells: &CellMap| cells.values().copied().collect::<Vec<(TileId, CellSums)>>();
        let (cells, tall) = (list(&self.cells), list(&self.tall));
        let mut all = CellSums::NOTHING;
        cells.iter().chain(&tall).for_each(|(_, sums)| all.add(sums));
        let most = u128::from(all.cost) * u128::from(target.max(1)) / u128::from(all.features.max(1));
        let mut tiles = Vec::new();
        divide(TileId::ROOT, &cells, Some(&tall), most, &mut tiles);
        tiles
    }
}

fn add(
    cells: &mut CellMap,
    bounds: BoundingBox,
    points: usize,
    ids: FeatureDigest,
    data: FeatureDigest,
) -> Result<()> {
    let place = representative_point(bounds);
    let tile = TileGrid::finest(place).ok_or_else(|| {
        Error::data(format!("the feature at {}, {} is outside the grid of tiles", place[0], place[1]))
            .help("features lie at most 2,000 km from the centre of their layer")
    })?;
    let [low, high] = bounds;
    let region = [low.x, low.y, high.x, high.y];
    let feature = CellSums { features: 1, cost: 10 + points as u64, region, ids, data };
    cells.entry(tile.curve().0).or_insert((tile, CellSums::NOTHING)).1.add(&feature);
    Ok(())
}

/// Sums of tiles of the deepest level, in the order of the curve.
type CellList<'a> = &'a [(TileId, CellSums)];

/// Adds the tiles of `id`, whose `cells` and `tall` cells are those of the deepest level. `tall` is `None` inside a tile with the tall
/// features.
fn divide<'a>(
    id: TileId,
    cells: CellList<'a>,
    tall: Option<CellList<'a>>,
    most: u128,
    tiles: &mut Vec<PlannedTile>,
) {
    let sum = |cells: CellList<'_>| {
        let mut sums = CellSums::NOTHING;
        cells.iter().for_each(|(_, cell)| sums.add(cell));
        sums
    };
    let high = tall.map_or(CellSums::NOTHING, sum);
    let mut all = sum(cells);
    all.add(&high);
    if all.features == 0 {
        return;
    }
    let is_few = |sums: &CellSums| u128::from(sums.cost) <= most && id.level >= TileId::ANCHOR;
    if id.level == DEEPEST || is_few(&all) {
        tiles.push(plan_tile(id, &all, if tall.is_some() { None } else { Some(false) }));
        return;
    }
    let (mut rest, mut tall_rest) = (cells, tall);
    if high.features > 0 && is_few(&high) {
        tiles.push(plan_tile(id, &high, Some(true)));
        tall_rest = None;
    }
    for child in id.children() {
        let split = |cells: &mut CellList<'a>| -> CellList<'a> {
            let end = cells.partition_point(|(tile, _)| tile.ancestor(child.level).curve() <= child.curve());
            let (own, later) = cells.split_at(end);
            *cells = later;
            own
        };
        let own = split(&mut rest);
        let own_tall = tall_rest.as_mut().map(split);
        divide(child, own, own_tall, most, tiles);
    }
}

/// Returns the tile with these sums, without a hash.
fn plan_tile(id: TileId, sums: &CellSums, tall: Option<bool>) -> PlannedTile {
    #[allow(clippy::cast_precision_loss, reason = "the cost is a weight")]
    let cost = sums.cost as f64 / 10.0;
    let CellSums { features, region, ids, data, .. } = *sums;
    let (ids, data, hash) = (ids.text(), data.text(), String::new());
    PlannedTile { id, features, cost, region, ids, data, hash, lod: None, tall }
}

#[cfg(test)]
mod tests {
    use super::super::id_digest;
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn each_point_is_in_exactly_one_tile_and_its_digest_too(
            points in prop::collection::vec((-5000.0..5000.0_f64, 0.0..3000.0_f64), 1..200),
            target in 1..40_u64,
        ) {
            let mut division = TileDivision::default();
            for (number, at) in points.iter().enumerate() {
                let digest = id_digest("a", &number.to_string());
                division.add([[at.0, at.1].into(); 2], number % 7, digest, digest).unwrap();
            }
            let tiles = division.tiles(target);
            for (number, at) in points.iter().enumerate() {
                let inside = |tile: &&PlannedTile| {
                    let [west, south, east, north] = TileGrid::bounds(tile.id);
                    (west..east).contains(&at.0) && (south..north).contains(&at.1)
                };
                prop_assert_eq!(tiles.iter().filter(inside).count(), 1, "{}", number);
            }
            for tile in &tiles {
                let [west, south, east, north] = TileGrid::bounds(tile.id);
                let (mut ids, mut count) = (FeatureDigest::default(), 0);
                for (number, at) in points.iter().enumerate() {
                    if (west..east).contains(&at.0) && (south..north).contains(&at.1) {
                        ids.add(id_digest("a", &number.to_string()));
                        count += 1;
                    }
                }
                prop_assert_eq!((&tile.ids, tile.features), (&ids.text(), count));
            }
            let ordered = tiles.windows(2).all(|pair| pair[0].id.curve() < pair[1].id.curve());
            prop_assert!(ordered);
        }
    }

    proptest! {
        #[test]
        fn tall_features_are_in_the_largest_tiles_and_each_feature_is_in_one(
            points in prop::collection::vec((-9000.0..9000.0_f64, 0.0..9000.0_f64, 0..10_u32), 1..200),
            target in 1..20_u64,
        ) {
            let mut division = TileDivision::default();
            let mut whole = FeatureDigest::default();
            for (number, (x, y, kind)) in points.iter().enumerate() {
                let (bounds, digest) = ([[*x, *y].into(); 2], id_digest("a", &number.to_string()));
                match kind {
                    0 => division.add_tall(bounds, 1, digest, digest).unwrap(),
                    _ => division.add(bounds, 1, digest, digest).unwrap(),
                }
                whole.add(digest);
            }
            let tiles = division.tiles(target);
            let mut sum = FeatureDigest::default();
            for tile in &tiles {
                let [west, south, east, north] = TileGrid::bounds(tile.id);
                let (mut ids, mut count) = (FeatureDigest::default(), 0);
                for (number, (x, y, kind)) in points.iter().enumerate() {
                    let is_chosen = tile.tall.is_none_or(|tall| tall == (*kind == 0));
                    if (west..east).contains(x) && (south..north).contains(y) && is_chosen {
                        ids.add(id_digest("a", &number.to_string()));
                        count += 1;
                    }
                }
                prop_assert_eq!((&tile.ids, tile.features), (&ids.text(), count));
                sum.add(ids);
                let is_inside = |other: &PlannedTile| tile.id.level > other.id.level && tile.id.ancestor(other.id.level) == other.id;
                let above = tiles.iter().filter(|other| is_inside(other)).map(|other| other.tall);
                let wanted: Vec<Option<bool>> = if tile.tall == Some(false) { vec![Some(true)] } else { Vec::new() };
                prop_assert_eq!(above.collect::<Vec<_>>(), wanted);
            }
            prop_assert_eq!(sum, whole);
            prop_assert!(tiles.windows(2).all(|pair| pair[0].id.curve() < pair[1].id.curve()));
        }
    }

    #[test]
    fn the_sides_of_tiles_are_the_same_numbers_on_every_level() {
        let of = |level, x| TileGrid::bounds(TileId { level, x, y: 0 });
        assert_eq!(of(16, 32_768)[0].to_bits(), of(1, 1)[0].to_bits());
        assert_eq!(of(7, 64)[0].to_bits(), of(1, 0)[2].to_bits());
        for x in [0, 77, 40_000, 65_535] {
            let west = of(16, x)[0];
            assert_eq!(TileGrid::finest([west, 20.0]).unwrap().x, x);
            assert_eq!(TileGrid::finest([west.next_down(), 20.0]).map(|tile| tile.x), x.checked_sub(1));
        }
        assert_eq!(TileGrid::finest([f64::NAN, 0.0]), None);
    }
}
