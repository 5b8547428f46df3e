//! Lots at random, held against all that they promise.

use glam::DVec2;

use super::fine::{self, FinePlace};
use super::*;
use crate::tests::{TestNumbers, grown};
use crate::{Constraints, Obstacles, StreetNetwork, SurfaceOptions};
use burgeon_geometry::{Polygon, Rings};

fn places(lot: &Lot) -> Vec<Vec<FinePlace>> {
    let ring = |ring: &Vec<DVec2>| ring.iter().map(|at| FinePlace::nearest(*at).expect("near")).collect();
    lot.rings.iter().map(ring).collect()
}

/// Asserts all that lots promise, exactly.
pub(super) fn check(block: &Block, lots: &[Lot], options: &LotOptions) {
    let whole = Polygon::new(block.rings.clone()).expect("a block").area();
    let sum: f64 = lots.iter().map(|lot| lot.area).sum();
    assert!((sum - whole).abs() <= 1e-6 * whole.max(1.0), "{} m² of {whole} m² in {}", sum, block.id);
    let placed: Vec<Vec<Vec<FinePlace>>> = lots.iter().map(places).collect();
    let edges: Vec<Vec<[FinePlace; 2]>> = placed
        .iter()
        .map(|rings| {
            let of = |ring: &Vec<FinePlace>| -> Vec<[FinePlace; 2]> {
                (0..ring.len()).map(|index| [ring[index], ring[(index + 1) % ring.len()]]).collect()
            };
            rings.iter().flat_map(of).collect()
        })
        .collect();
    for (index, lot) in lots.iter().enumerate() {
        assert!(fine::are_simple(&placed[index]), "lot {} of {} meets itself", lot.number, block.id);
        assert!(lot.area > 0.0);
        let around = |rings: &[Vec<FinePlace>]| {
            Polygon::new(Rings(vec![rings[0].iter().map(|at| at.metres()).collect()]))
                .expect("a lot")
                .bounds()
        };
        let [low, high] = around(&placed[index]).expect("corners");
        for (other, theirs) in edges.iter().enumerate().take(index) {
            let [from, to] = around(&placed[other]).expect("corners");
            if low.cmpgt(to).any() || from.cmpgt(high).any() {
                continue;
            }
            for edge in &edges[index] {
                for their in theirs {
                    let same = edge[0] == their[1] && edge[1] == their[0];
                    assert!(edge != their, "two lots are on the same side of an edge");
                    assert!(
                        same || !fine::meet(*edge, *their),
                        "lots {index} and {other} of {} meet",
                        block.id
                    );
                }
            }
        }
        if lot.purpose == LotUse::Building {
            assert!(lot.front_length >= options.min_width - 1e-9, "front {}", lot.front_length);
            assert!(lot.area >= options.min_area - 1e-6, "area {}", lot.area);
            let front: f64 = lot.fronts[0].windows(2).map(|pair| pair[0].distance(pair[1])).sum();
            assert!((front - lot.front_length).abs() < 1e-9);
        }
    }
}

/// A polygon whose corners lie around a place at random distances.
fn star(random: &mut TestNumbers, size: f64) -> Rings<DVec2> {
    let count = 3 + random.below(20.0) as usize;
    let middle = DVec2::new(random.below(4000.0) - 2000.0, random.below(4000.0) - 2000.0);
    let ring = (0..count).map(|number| {
        let way =
            DVec2::from_angle((number as f64 + random.below(0.8)) / count as f64 * std::f64::consts::TAU);
        middle + way * size * (0.25 + random.below(0.75))
    });
    Rings(vec![ring.collect()])
}

#[test]
fn lots_of_polygons_at_random_are_disjoint_and_fill_them() {
    let empty = StreetNetwork::new(Constraints::default(), Obstacles::default()).expect("a network");
    let mut random = TestNumbers(7);
    let mut count = 0;
    for number in 0..400 {
        let size = [8.0, 40.0, 120.0, 500.0][number % 4];
        let rings = star(&mut random, size);
        let Some(block) = empty.block(None, &rings, 6.0) else { continue };
        let usual = LotOptions::new(8.0 + random.below(20.0), 15.0 + random.below(30.0));
        let options = LotOptions { pattern: LotPattern::ALL[number / 4 % 3].1, ..usual };
        let lots = block.divide(&options, &mut || random.below(1.0));
        check(&block, &lots, &options);
        count += lots.len();
    }
    assert!(count > 5000, "{count} lots");
}

#[test]
fn lots_of_networks_at_random_have_fronts_on_their_streets() {
    let mut count = 0;
    for seed in 1..=30 {
        let network = grown(seed, 150, Constraints::default(), Obstacles::default());
        let mut random = TestNumbers(seed + 1000);
        for block in network.lot_blocks(SurfaceOptions::default()) {
            let pattern = LotPattern::ALL[seed as usize % 3].1;
            let options = LotOptions { pattern, ..LotOptions::new(18.0, 28.0) };
            let lots = block.divide(&options, &mut || random.below(1.0));
            check(&block, &lots, &options);
            count += lots.iter().filter(|lot| lot.purpose == LotUse::Building).count();
            for lot in lots.iter().filter(|lot| lot.purpose == LotUse::Building) {
                let piece = lot.piece.expect("a street");
                let (distance, _) = crate::grid::foot(lot.access, network.line(piece));
                assert!(distance <= network.half(piece) + 6.0, "{distance} m from the street");
            }
        }
    }
    assert!(count > 5000, "{count} lots");
}
