//! Tests of random lots against all guarantees.

use glam::DVec2;

use super::fine::{self, FinePlace};
use super::*;
use crate::tests::{TestNumbers, grown};
use crate::{Constraints, Obstacles, SiteOptions, StreetNetwork, SurfaceOptions};
use burgeon_geometry::{Polygon, Rings};

fn places(lot: &Lot) -> Vec<Vec<FinePlace>> {
    let ring = |ring: &Vec<DVec2>| ring.iter().map(|at| FinePlace::nearest(*at).expect("near")).collect();
    lot.rings.iter().map(ring).collect()
}

/// Asserts all guarantees for lots exactly.
pub(super) fn check(block: &StreetBlock, lots: &[Lot], options: &LotOptions) {
    let whole = Polygon::new(block.rings.clone()).expect("a block").area();
    let sum: f64 = lots.iter().map(|lot| lot.area).sum();
    assert!((sum - whole).abs() <= 1e-6 * whole.max(1.0), "{} m² of {whole} m² in {}", sum, block.id);
    let placed: Vec<Vec<Vec<FinePlace>>> = lots.iter().map(places).collect();
    let edges: Vec<Vec<[FinePlace; 2]>> = placed
        .iter()
        .map(|rings| rings.iter().flat_map(|ring| burgeon_geometry::planar::edges(ring)).collect())
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

/// Returns a polygon whose corners are at random distances around a centre.
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

/// Returns the rings with additional corners on their edges or off them by about the rounding error, and with corners
/// cut off and bent.
fn bent(random: &mut TestNumbers, rings: &Rings<DVec2>) -> Rings<DVec2> {
    let ring = &rings.0[0];
    let mut bent = Vec::new();
    for [from, to] in burgeon_geometry::planar::edges(ring) {
        let across = (to - from).normalize_or_zero().perp();
        bent.push(from);
        let mut at: Vec<f64> = (0..random.below(4.0) as usize).map(|_| random.below(1.0)).collect();
        at.sort_by(f64::total_cmp);
        let off = [0.0, 1e-6, 1e-4, 0.1][random.below(4.0) as usize];
        bent.extend(at.iter().map(|at| from.lerp(to, *at) + across * (random.below(2.0) - 1.0) * off));
    }
    Rings(vec![bent])
}

#[test]
fn lots_of_polygons_with_corners_that_hardly_turn_are_disjoint_and_fill_them() {
    let empty = StreetNetwork::new(Constraints::default(), Obstacles::default()).expect("a network");
    let mut random = TestNumbers(11);
    let mut count = 0;
    for number in 0..600 {
        let plain = star(&mut random, [40.0, 120.0, 300.0][number % 3]);
        let rings = bent(&mut random, &plain);
        let Some(mut block) = empty.block(None, &rings, 6.0) else { continue };
        // As next to water, some sides have no street.
        let dry: Vec<bool> = block.sides.iter().map(|_| random.below(1.0) < 0.6).collect();
        block
            .edge_sides
            .iter_mut()
            .flatten()
            .for_each(|side| *side = side.filter(|side| dry[*side as usize]));
        let usual = LotOptions::new(8.0 + random.below(20.0), 15.0 + random.below(30.0));
        let options = LotOptions { pattern: LotPattern::ALL[number / 3 % 3].1, ..usual };
        let lots = block.divide(&options, &mut || random.below(1.0));
        check(&block, &lots, &options);
        count += lots.len();
    }
    assert!(count > 5000, "{count} lots");
}

#[test]
fn lots_of_networks_at_random_have_fronts_on_their_streets() {
    let (mut count, mut long) = (0, 0);
    for seed in 1..=150 {
        let network = grown(seed, 30 + seed as usize % 40, Constraints::default(), Obstacles::default());
        let mut random = TestNumbers(seed + 1000);
        for block in network.lot_blocks(SurfaceOptions::default()) {
            let pattern = LotPattern::ALL[seed as usize % 3].1;
            let options = LotOptions { pattern, ..LotOptions::new(18.0, 28.0) };
            let lots = block.divide(&options, &mut || random.below(1.0));
            check(&block, &lots, &options);
            count += lots.iter().filter(|lot| lot.purpose == LotUse::Building).count();
            for lot in lots.iter().filter(|lot| lot.purpose == LotUse::Building) {
                let ratio = (lot.width / lot.depth).max(lot.depth / lot.width);
                long += usize::from(ratio > options.elongation * 1.5);
                let piece = lot.piece.expect("a street");
                let (distance, _) = crate::plan::grid::foot(lot.access, network.line(piece));
                assert!(distance <= network.half(piece) + 6.0, "{distance} m from the street");
            }
        }
    }
    assert!(count > 5000, "{count} lots");
    assert!(long * 200 < count, "{long} of {count} lots are too long");
}

/// Returns a random river: a band along a winding line whose banks have a point every few metres.
fn river(random: &mut TestNumbers) -> Option<Polygon> {
    let from = DVec2::new(random.below(300.0) - 150.0, random.below(300.0) - 150.0);
    let heading = random.below(6.3);
    let (half, step) = (3.0 + random.below(12.0), 1.5 + random.below(8.0));
    let (swing, wave) = (random.below(0.5), 20.0 + random.below(60.0));
    let count = (600.0 / step) as u32;
    let (mut at, mut left, mut right) = (from - DVec2::from_angle(heading) * 300.0, Vec::new(), Vec::new());
    for index in 0..count {
        let way = DVec2::from_angle(heading + swing * (f64::from(index) * step / wave).sin());
        at += way * step;
        left.push(at + way.perp() * half);
        right.push(at - way.perp() * half);
    }
    right.reverse();
    let ring: Vec<DVec2> = right.into_iter().rev().chain(left.into_iter().rev()).collect();
    Polygon::new(Rings(vec![ring])).ok()
}

#[test]
fn lots_whose_front_a_river_cuts_have_their_access_on_the_street() {
    let (mut count, mut cut, mut worst) = (0, 0, 0.0_f64);
    for seed in 1..=60 {
        let network = grown(seed, 30 + seed as usize % 40, Constraints::default(), Obstacles::default());
        let mut random = TestNumbers(seed + 77);
        let rivers: Vec<Polygon> = (0..2).filter_map(|_| river(&mut random)).collect();
        for block in network.lot_blocks(SurfaceOptions::default()) {
            let whole = Polygon::new(block.rings.clone()).expect("a block");
            let parts = whole.without(&rivers);
            let is_cut = parts.len() != 1 || (parts[0].area() - whole.area()).abs() > 1.0;
            for part in parts.iter().filter(|_| is_cut) {
                let Some(block) = network.block(None, &Rings::from(part), 6.0) else { continue };
                let options = LotOptions {
                    pattern: LotPattern::ALL[seed as usize % 3].1,
                    ..LotOptions::new(16.0, 24.0)
                };
                for lot in block.divide(&options, &mut || random.below(1.0)) {
                    if lot.purpose != LotUse::Building {
                        continue;
                    }
                    let off = |at: DVec2| {
                        let each = network.pieces().map(|(piece, _)| {
                            crate::plan::grid::foot(at, network.line(piece)).0 - network.half(piece)
                        });
                        each.fold(f64::INFINITY, f64::min)
                    };
                    count += 1;
                    worst = worst.max(off(lot.access));
                    cut += usize::from(off(lot.access) > 2.0);
                    let on = lot.fronts[0].edges().map(|edge| crate::plan::grid::foot(lot.access, edge).0);
                    assert!(on.fold(f64::INFINITY, f64::min) < 1e-6, "the access is not on the front");
                }
            }
        }
    }
    assert!(count > 400, "{count} lots");
    assert_eq!(cut, 0, "of {count} lots the farthest access is {worst} m off its street");
}

#[test]
fn terraces_keep_apart_inside_of_their_lots() {
    let (mut count, mut area_of_rows) = (0, 0.0);
    for seed in 1..=60 {
        let network = grown(seed, 40, Constraints::default(), Obstacles::default());
        let mut random = TestNumbers(seed);
        for block in network.lot_blocks(SurfaceOptions::default()) {
            let pattern = LotPattern::ALL[seed as usize % 3].1;
            let options = LotOptions { pattern, ..LotOptions::new(9.0, 18.0) };
            let depth = 6.0 + random.below(20.0);
            for lot in block.divide(&options, &mut || random.below(1.0)) {
                let whole = Polygon::new(lot.rings.clone()).expect("a lot");
                let inwards = -lot.facing;
                for part in lot.row(depth, 0.02) {
                    assert!(
                        part.without(std::slice::from_ref(&whole)).iter().all(|rest| rest.area() < 1e-9),
                        "{lot:?}"
                    );
                    for at in part.points() {
                        assert!((at - lot.access).dot(inwards) < depth + 1e-9, "{lot:?}");
                        let near = whole.edges().map(|edge| crate::plan::grid::foot(at, edge).0);
                        assert!(near.fold(f64::INFINITY, f64::min) > 0.02 - 1e-6, "{lot:?}");
                    }
                    count += 1;
                    area_of_rows += part.area();
                }
                // The general method yields the same area, except for corners that it blunts.
                let [low, high] = whole.bounds().expect("corners");
                let (size, last) = ((high - low).length(), lot.access.dot(inwards) + depth);
                let from = inwards * last + inwards.perp() * inwards.perp().dot((low + high) / 2.0);
                let beyond = [(0.0, size), (0.0, -size), (size, -size), (size, size)]
                    .map(|(along, aside)| from + inwards * along + inwards.perp() * aside);
                let beyond = Polygon::turned(Rings(vec![beyond.to_vec()])).expect("a square");
                let general: f64 = whole
                    .inset(0.02)
                    .iter()
                    .flat_map(|part| part.without(std::slice::from_ref(&beyond)))
                    .map(|part| part.area())
                    .sum();
                let quick: f64 = lot.row(depth, 0.02).iter().map(|part| part.area()).sum();
                let none = if lot.fronts.is_empty() { 0.0 } else { general };
                assert!((quick - none).abs() < 0.02, "{quick} m² for {none} m²: {lot:?}");
            }
        }
    }
    assert!(count > 5000 && area_of_rows > 100_000.0, "{count} parts, {area_of_rows} m²");
}

#[test]
fn thin_blocks_are_cut_into_lots_that_are_short_enough() {
    let empty = StreetNetwork::new(Constraints::default(), Obstacles::default()).expect("a network");
    let mut random = TestNumbers(11);
    for (_, pattern) in LotPattern::ALL {
        for number in 0..60 {
            let (long, deep) = (60.0 + random.below(60.0), 7.0 + random.below(5.0));
            let corners = [(0.0, 0.0), (long, 0.0), (long, deep), (0.0, deep)].map(DVec2::from);
            let block = empty.block(None, &Rings(vec![corners.to_vec()]), 6.0).expect("an area");
            let options = LotOptions { pattern, ..LotOptions::new(16.0, 28.0) };
            let lots = block.divide(&options, &mut || random.below(1.0));
            check(&block, &lots, &options);
            for lot in lots.iter().filter(|lot| lot.purpose == LotUse::Building) {
                assert!(lot.elongation <= options.elongation, "{number} by {pattern:?}: {}", lot.elongation);
            }
        }
    }
}

/// Returns a random number stream derived from the id of a block.
fn stream_of(id: &str) -> TestNumbers {
    TestNumbers(id.bytes().fold(7_u64, |sum, byte| sum.wrapping_mul(31) + u64::from(byte)) | 1)
}

#[test]
fn great_tiny_and_hollow_areas_are_divided_too() {
    let empty = StreetNetwork::new(Constraints::default(), Obstacles::default()).expect("a network");
    let square = |x: f64, y: f64, size: f64| {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
            .map(|(u, v)| DVec2::new(x + u * size, y + v * size))
            .to_vec()
    };
    let hole = |x: f64, y: f64, size: f64| square(x, y, size).into_iter().rev().collect::<Vec<_>>();
    let angle =
        [(0.0, 0.0), (300.0, 0.0), (300.0, 40.0), (50.0, 60.0), (40.0, 280.0), (0.0, 300.0)].map(DVec2::from);
    let cases = [
        (vec![square(400_000.0, -300_000.0, 1000.0)], 100),
        (vec![square(0.0, 0.0, 1000.0), hole(300.0, 420.0, 200.0)], 100),
        (vec![square(0.0, 0.0, 100.0), hole(20.0, 20.0, 30.0), hole(60.0, 50.0, 25.0)], 4),
        (vec![angle.to_vec()], 20),
        (vec![square(5.0, 5.0, 3.0)], 0),
    ];
    for (rings, least) in cases {
        for (_, pattern) in LotPattern::ALL {
            let block = empty.block(None, &Rings(rings.clone()), 6.0).expect("an area");
            let options = LotOptions { pattern, ..LotOptions::new(15.0, 25.0) };
            let mut stream = stream_of(&block.id);
            let lots = block.divide(&options, &mut || stream.below(1.0));
            check(&block, &lots, &options);
            let count = lots.iter().filter(|lot| lot.purpose == LotUse::Building).count();
            assert!(count >= least, "{count} lots of {} by {pattern:?}", block.id);
        }
    }
}

#[test]
fn a_street_elsewhere_leaves_the_lots_of_a_block_as_they_were() {
    let lots_of = |network: &StreetNetwork| {
        let blocks = network.lot_blocks(SurfaceOptions::default());
        let all = blocks.iter().map(|block| {
            let mut stream = stream_of(&block.id);
            let options = LotOptions { pattern: LotPattern::Strips, ..LotOptions::new(15.0, 25.0) };
            (block.id.clone(), block.divide(&options, &mut || stream.below(1.0)))
        });
        all.collect::<std::collections::BTreeMap<_, _>>()
    };
    let mut changed = 0;
    for seed in 1..=20 {
        let mut network = grown(seed, 120, Constraints::default(), Obstacles::default());
        let before = lots_of(&network);
        let pieces: Vec<u32> = network.pieces().map(|(piece, _)| piece).collect();
        network.remove(pieces[pieces.len() / 2]);
        let after = lots_of(&network);
        let gone = before.keys().filter(|id| !after.contains_key(*id)).count();
        let same =
            before.iter().filter(|(id, lots)| after.get(*id).is_some_and(|now| same_lots(now, lots))).count();
        // The blocks on both sides of the street, and those at junctions that no longer exist.
        assert!(
            before.len() - same <= 6,
            "{} of {} blocks have other lots",
            before.len() - same,
            before.len()
        );
        changed += gone;
    }
    assert!(changed > 10, "{changed} blocks gone");
}

/// Returns true if lots are unchanged, ignoring the numbers of their streets.
fn same_lots(a: &[Lot], b: &[Lot]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.rings == b.rings && a.number == b.number)
}

#[test]
fn sites_beside_streets_are_disjoint_and_on_no_street() {
    let mut count = 0;
    for seed in 1..=25 {
        let network = grown(seed, 120, Constraints::default(), Obstacles::default());
        let mut random = TestNumbers(seed);
        let options = SiteOptions {
            sizes: vec![
                DVec2::new(24.0, 18.0),
                DVec2::new(14.0 + random.below(6.0), 12.0),
                DVec2::new(10.0, 9.0),
            ],
            along: 5.0 + random.below(10.0),
            away: 16.0,
            distance: random.below(50.0) + 3.0,
            setback: random.below(3.0),
            gap: [0.0, 2.5][seed as usize % 2],
            shrink: 0.5,
        };
        let mut stream = |name: &str| -> Box<dyn FnMut() -> f64> {
            let mut own =
                TestNumbers(name.bytes().fold(7_u64, |sum, byte| sum.wrapping_mul(31) + u64::from(byte)) | 1);
            Box::new(move || own.below(1.0))
        };
        let found = network.sites(SurfaceOptions::default(), &options, &mut stream).expect("options");
        let placed: Vec<Vec<FinePlace>> = found
            .sites
            .iter()
            .map(|site| site.corners.map(|at| FinePlace::nearest(at).expect("near")).to_vec())
            .collect();
        let surfaces = network.surfaces(SurfaceOptions::default(), &crate::StreetProfiles::default());
        let borders: Vec<[FinePlace; 2]> = surfaces
            .sidewalks
            .iter()
            .flat_map(|sidewalk| burgeon_geometry::planar::edges(&sidewalk.edge).collect::<Vec<_>>())
            .map(|edge| edge.map(|end| FinePlace::nearest(end.truncate()).expect("near")))
            .filter(|[a, b]| a != b)
            .collect();
        for (index, site) in found.sites.iter().enumerate() {
            for other in &placed[..index] {
                assert!(!crate::placement::overlap(&placed[index], other), "sites overlap");
            }
            for edge in 0..4 {
                let edge = [placed[index][edge], placed[index][(edge + 1) % 4]];
                assert!(
                    borders.iter().all(|border| !fine::meet(edge, *border)),
                    "a site reaches into a street"
                );
            }
            let middle = (site.corners[0] + site.corners[2]) / 2.0;
            for (piece, _) in network.pieces() {
                let (distance, _) = crate::plan::grid::foot(middle, network.line(piece));
                assert!(distance > network.half(piece), "a site is in a street");
            }
        }
        count += found.sites.len();
        assert!(found.looked_at < found.tried * 40, "{} for {} places", found.looked_at, found.tried);
    }
    assert!(count > 3000, "{count} sites");
}
