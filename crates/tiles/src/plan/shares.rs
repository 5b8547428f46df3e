//! Shares of the tiles for several processes.

use std::str::FromStr;

use burgeon_base::error::{Error, Result};

use super::PlannedTile;

/// Share of the tiles of a plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TileShare {
    /// Number of the share, from 1.
    pub number: u32,
    /// Number of shares.
    pub count: u32,
}

impl TileShare {
    /// All tiles.
    pub const ALL: Self = Self { number: 1, count: 1 };
}

impl FromStr for TileShare {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let numbers = text.split_once('/').and_then(|(number, count)| {
            Some((number.trim().parse::<u32>().ok()?, count.trim().parse::<u32>().ok()?))
        });
        match numbers {
            Some((number, count)) if (1..=count).contains(&number) && count <= 1_000_000 => {
                Ok(Self { number, count })
            }
            _ => Err(Error::argument(format!(
                "invalid share {text:?}: write the number of the share and the number of shares, such as 3/64"
            ))),
        }
    }
}

/// Returns the indices of the tiles of a share, ascending. Shares have about the same cost, and each tile is in one share.
///
/// Method: the most expensive tile goes to the share with the least cost so far (Graham, "Bounds on multiprocessing timing
/// anomalies", 1969).
pub fn share_of(tiles: &[&PlannedTile], share: TileShare) -> Vec<usize> {
    let mut order: Vec<usize> = (0..tiles.len()).collect();
    order.sort_by(|a, b| tiles[*b].cost.total_cmp(&tiles[*a].cost).then(a.cmp(b)));
    // Costs are tenths, so sums are compared exactly.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a cost is a small positive number"
    )]
    let tenths = |tile: usize| (tiles[tile].cost * 10.0).round() as u64;
    let mut loads: std::collections::BTreeSet<(u64, u32)> =
        (1..=share.count).map(|number| (0, number)).collect();
    let mut own = Vec::new();
    for tile in order {
        let Some((load, number)) = loads.pop_first() else { break };
        loads.insert((load + tenths(tile), number));
        if number == share.number {
            own.push(tile);
        }
    }
    own.sort_unstable();
    own
}

#[cfg(test)]
mod tests {
    use super::super::TileId;
    use super::*;

    #[test]
    fn shares_have_each_tile_once_and_about_the_same_cost() {
        let tile = |number: u32| PlannedTile {
            id: TileId { level: 6, x: number % 64, y: number / 64 },
            features: 1,
            cost: f64::from(1 + number * number % 97),
            region: [0.0; 4],
            ids: String::new(),
            data: String::new(),
            hash: String::new(),
            lod: None,
            tall: None,
        };
        let tiles: Vec<PlannedTile> = (0..500).map(tile).collect();
        let tiles: Vec<&PlannedTile> = tiles.iter().collect();
        let total: f64 = tiles.iter().map(|tile| tile.cost).sum();
        for count in [1, 2, 3, 7, 600] {
            let shares: Vec<Vec<usize>> =
                (1..=count).map(|number| share_of(&tiles, TileShare { number, count })).collect();
            let mut all: Vec<usize> = shares.iter().flatten().copied().collect();
            all.sort_unstable();
            assert_eq!(all, (0..500).collect::<Vec<_>>());
            if count < 10 {
                for share in shares {
                    let cost: f64 = share.iter().map(|tile| tiles[*tile].cost).sum();
                    assert!((cost * f64::from(count) / total - 1.0).abs() < 0.02, "{count}: {cost}");
                }
            }
        }
    }

    #[test]
    fn a_share_is_a_number_of_shares() {
        assert_eq!("3/64".parse::<TileShare>().unwrap(), TileShare { number: 3, count: 64 });
        for text in ["0/4", "5/4", "3", "a/b", "1/0", "-1/2"] {
            assert!(text.parse::<TileShare>().is_err(), "{text}");
        }
    }
}
