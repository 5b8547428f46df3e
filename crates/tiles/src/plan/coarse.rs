//! Tiles of coarser levels of detail.

use super::{FeatureDigest, PlannedTile, TileId};

/// Part of the cost of a tile that its features have in a coarser level of detail.
const PART: f64 = 0.5;

/// Returns the coarser tiles above `tiles`, in the order of the curve, without hashes.
///
/// `tiles` are in the order of the curve, and `lods` are levels of detail, from fine to coarse. A tile of the quadtree whose
/// tiles are in several of its quarters has the first level of detail; those above such tiles have the next, until there are no
/// more. A coarser tile has the features of all tiles inside.
///
/// ```
/// use burgeon_tiles::plan::{TileDivision, coarse_tiles, id_digest};
///
/// let mut division = TileDivision::default();
/// for number in 0..1000 {
///     let place = [f64::from(number % 30) * 30.0, f64::from(number / 30) * 20.0].into();
///     let digest = id_digest("trees", &number.to_string());
///     division.add([place, place], 10, digest, digest)?;
/// }
/// let coarse = coarse_tiles(&division.tiles(50), &[2]);
/// assert!(coarse.len() > 2 && coarse.iter().all(|tile| tile.lod == Some(2) && tile.features > 0));
/// # Ok::<(), burgeon_base::Error>(())
/// ```
pub fn coarse_tiles(tiles: &[PlannedTile], lods: &[u8]) -> Vec<PlannedTile> {
    let mut coarse = Vec::new();
    if !lods.is_empty() {
        add(tiles, lods, &mut coarse);
        coarse.sort_by_key(|tile| tile.id.curve());
    }
    coarse
}

/// Adds the coarser tiles above `tiles`, and returns the number of tiles one above the other.
fn add(tiles: &[PlannedTile], lods: &[u8], coarse: &mut Vec<PlannedTile>) -> usize {
    let [first, .., last] = tiles else { return 0 };
    let id = first.id.common(last.id);
    let (mut rest, mut height) = (tiles, 0);
    for child in id.children() {
        let (own, later) = rest.split_at(rest.partition_point(|tile| child.is_not_before(tile.id)));
        height = height.max(add(own, lods, coarse));
        rest = later;
    }
    if let Some(lod) = lods.get(height) {
        coarse.push(sum(id, tiles, *lod));
    }
    height + 1
}

/// Returns the tile with the features of `tiles`.
fn sum(id: TileId, tiles: &[PlannedTile], lod: u8) -> PlannedTile {
    let [mut ids, mut data] = [FeatureDigest::default(); 2];
    let (mut features, mut cost) = (0, 0.0);
    let mut region = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    for tile in tiles {
        features += tile.features;
        cost += tile.cost * PART;
        let [west, south, east, north] = tile.region;
        region = [region[0].min(west), region[1].min(south), region[2].max(east), region[3].max(north)];
        for (sum, text) in [(&mut ids, &tile.ids), (&mut data, &tile.data)] {
            sum.add(FeatureDigest::parse(text).unwrap_or_default());
        }
    }
    let (ids, data, hash) = (ids.text(), data.text(), String::new());
    PlannedTile { id, features, cost, region, ids, data, hash, lod: Some(lod), tall: None }
}

#[cfg(test)]
mod tests {
    use super::super::{TileDivision, id_digest};
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn coarse_tiles_have_the_features_of_the_tiles_inside_and_grow_coarser_upwards(
            points in prop::collection::vec((-9000.0..9000.0_f64, 0.0..9000.0_f64), 1..200),
            target in 1..20_u64,
        ) {
            let mut division = TileDivision::default();
            for (number, (x, y)) in points.iter().enumerate() {
                let (place, digest) = ([*x, *y].into(), id_digest("a", &number.to_string()));
                division.add([place, place], 1, digest, digest).unwrap();
            }
            let tiles = division.tiles(target);
            let coarse = coarse_tiles(&tiles, &[2, 1]);
            let is_inside = |tile: &PlannedTile, id: TileId| tile.id.level >= id.level && tile.id.ancestor(id.level) == id;
            for tile in &coarse {
                let inside: Vec<&PlannedTile> = tiles.iter().filter(|leaf| is_inside(leaf, tile.id)).collect();
                prop_assert!(inside.len() > 1);
                prop_assert_eq!(tile.features, inside.iter().map(|leaf| leaf.features).sum::<u64>());
                let mut ids = FeatureDigest::default();
                for (number, (x, y)) in points.iter().enumerate() {
                    let [west, south, east, north] = super::super::TileGrid::bounds(tile.id);
                    if (west..east).contains(x) && (south..north).contains(y) {
                        ids.add(id_digest("a", &number.to_string()));
                    }
                }
                prop_assert_eq!(&tile.ids, &ids.text());
                let finer = coarse.iter().filter(|other| other.id != tile.id && is_inside(other, tile.id));
                for other in finer {
                    prop_assert!(other.lod > tile.lod);
                }
            }
            // Without coarser tiles, one tile alone has no parent.
            prop_assert_eq!(coarse.is_empty(), tiles.len() == 1);
        }
    }
}
