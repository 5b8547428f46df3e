//! Tests of existing streets of all types found in towns: each street keeps its position, and streets of one level meet
//! only at junctions.

use std::f64::consts::TAU;

use proptest::prelude::*;

use glam::DVec2;

use super::snapping::END;
use super::*;
use crate::plan::grid::touch;
use crate::plan::network::{PieceId, StreetAttributes, StreetNetwork};
use crate::tests::TestNumbers;
use crate::{Constraints, Obstacles};

/// Returns a street of a width (m) and a level.
pub(crate) fn street(line: &[DVec2], width: f64, level: i32) -> ExistingStreet {
    let attributes = StreetAttributes { width, sidewalk: width / 5.0, level, ..StreetAttributes::default() };
    ExistingStreet {
        line: line.to_vec(),
        attributes,
        is_bridge: level > 0,
        name: format!("street {width} {level}"),
    }
}

pub(crate) fn network() -> StreetNetwork {
    StreetNetwork::new(Constraints::default(), Obstacles::default()).expect("defaults")
}

/// Returns random streets as found in towns: crossings, forks of any angle, roundabouts, dual carriageways, ends just
/// before or just beyond other streets, overlapping streets, bridges, tunnels, curves and tangles.
pub(crate) fn town(seed: u64) -> Vec<ExistingStreet> {
    let mut random = TestNumbers(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    let mut below = move |limit: f64| random.below(limit);
    let mut streets = Vec::new();
    let extent = 60.0 + below(400.0);
    let place = |below: &mut dyn FnMut(f64) -> f64| DVec2::new(below(extent), below(extent));
    let count = 3.0 + below(9.0);
    for _ in 0..count as usize {
        let kind = below(9.0) as u32;
        let (from, heading) = (place(&mut below), below(TAU));
        let way = DVec2::from_angle(heading);
        let (length, width) = (10.0 + below(200.0), 4.0 + below(18.0));
        match kind {
            0 => streets.push(street(&[from, from + way * length], width, 0)),
            1 => {
                // A fork.
                let aside = DVec2::from_angle(heading + 0.01 + below(0.8));
                streets.push(street(&[from, from + way * length], width, 0));
                streets.push(street(&[from, from + aside * length * 0.8], 4.0 + below(10.0), 0));
            }
            2 => {
                // A roundabout with its arms.
                let radius = 4.0 + below(25.0);
                let points = 8 + below(24.0) as u32;
                let at = |part: f64| from + DVec2::from_angle(TAU * part) * radius;
                let ring: Vec<DVec2> =
                    (0..=points).map(|point| at(f64::from(point % points) / f64::from(points))).collect();
                for arm in 0..3 {
                    let begin = ring[(arm * 5) % points as usize];
                    streets.push(street(&[begin, begin + (begin - from) * (1.0 + below(6.0))], width, 0));
                }
                streets.push(street(&ring, width, 0));
            }
            3 => {
                // Two carriageways, and a street that joins and crosses them.
                let apart = way.perp() * (1.0 + below(14.0));
                streets.push(street(&[from, from + way * length], width, 0));
                streets.push(street(&[from + apart, from + apart + way * length], width, 0));
                let middle = from + way * length * 0.5;
                streets.push(street(&[middle - apart * 3.0, middle + apart * 4.0], width, 0));
            }
            4 => {
                // Streets that end just before another street, or just beyond it.
                streets.push(street(&[from, from + way * length], width, 0));
                for _ in 0..3 {
                    let at = from
                        + way * below(length)
                        + way.perp() * (below(1.0) - 0.5) * [0.01, 0.1, 1.0, 20.0][below(4.0) as usize];
                    streets.push(street(&[at + way.perp() * 40.0, at], width, 0));
                }
            }
            5 => {
                // A bridge or a tunnel between two streets on the ground.
                let level = if below(1.0) < 0.6 { 1 } else { -1 };
                let (a, b) = (from, from + way * length);
                streets.push(street(&[a - way * 40.0, a], width, 0));
                streets.push(street(&[a, b], width, level));
                streets.push(street(&[b, b + way * 40.0], width, 0));
            }
            6 => {
                // A curve with many points.
                let radius = 10.0 + below(60.0);
                let arc =
                    (0..40).map(|point| from + DVec2::from_angle(heading + f64::from(point) * 0.08) * radius);
                streets.push(street(&arc.collect::<Vec<_>>(), width, 0));
            }
            7 => {
                // Two streets that partly overlap.
                streets.push(street(&[from, from + way * length], width, 0));
                streets.push(street(&[from + way * length * 0.3, from + way * length * 1.4], width * 0.8, 0));
            }
            _ => {
                // A tangle.
                let line: Vec<DVec2> =
                    (0..2 + below(8.0) as u32).map(|_| from + place(&mut below) * 0.3).collect();
                streets.push(street(&line, width, [0, 0, 0, 1, -1][below(5.0) as usize]));
            }
        }
    }
    streets
}

/// Fails if a point on a line is farther than the tolerance from the segments of its level.
fn check_covered(network: &StreetNetwork, streets: &[ExistingStreet], about: &str) {
    for street in streets {
        for pair in street.line.windows(2) {
            let count = (pair[0].distance(pair[1]) / 0.7).ceil() as u32;
            for step in 0..=count {
                let at = pair[0].lerp(pair[1], f64::from(step) / f64::from(count.max(1)));
                let (_, off) = network.nearest_of_level(at, street.attributes.level).expect("a street");
                // A segment whose end moves onto another street turns by that distance.
                let most = END;
                assert!(off <= most + 0.06, "{about}: {} is {off} m off at {at}", street.name);
            }
        }
    }
}

/// Fails if segments of one level meet other than at junctions, or if two of them join the same junctions.
pub(crate) fn check_planar(network: &StreetNetwork, about: &str) {
    let pieces: Vec<PieceId> = network.pieces().map(|(id, _)| id).collect();
    for (index, &a) in pieces.iter().enumerate() {
        for &b in &pieces[..index] {
            if network.attributes(a).level != network.attributes(b).level {
                continue;
            }
            let shared = network.ends(a).iter().filter(|end| network.ends(b).contains(end)).count();
            assert!(shared < 2, "{about}: twice the same");
            let (one, other) = (network.grid_line(a), network.grid_line(b));
            assert!(
                shared == 1 || !touch(one, other),
                "{about}: {:?} {:?}",
                network.line(a),
                network.line(b)
            );
        }
    }
}

/// Returns statistics of the streets of level 0.
fn on_ground(network: &StreetNetwork) -> [usize; 4] {
    let ground: Vec<PieceId> =
        network.pieces().map(|(id, _)| id).filter(|id| network.is_on_ground(*id)).collect();
    let mut junctions: Vec<u32> = ground.iter().flat_map(|piece| network.ends(*piece)).collect();
    junctions.sort_unstable();
    junctions.dedup();
    let mut part: Vec<usize> = (0..network.junctions.len()).collect();
    fn root(part: &[usize], mut at: usize) -> usize {
        while part[at] != at {
            at = part[at];
        }
        at
    }
    for piece in &ground {
        let [a, b] = network.ends(*piece).map(|end| root(&part, end as usize));
        part[a] = b;
    }
    let parts =
        junctions.iter().filter(|junction| root(&part, **junction as usize) == **junction as usize).count();
    [junctions.len(), network.faces().len(), ground.len(), parts]
}

#[test]
fn every_metre_of_every_kind_of_street_stays_where_it_is() {
    for seed in 0..300 {
        let streets = town(seed);
        let mut network = network();
        let report = network.add_existing(&streets).expect("room");
        let about = format!("seed {seed}");
        assert_eq!(report.losses, [], "{about}");
        check_covered(&network, &streets, &about);
        check_planar(&network, &about);
        let [junctions, faces, pieces, parts] = on_ground(&network);
        assert_eq!(junctions + faces, pieces + parts, "{about}");
    }
}

#[test]
fn a_fork_a_roundabout_and_two_carriageways_stay_as_they_are() {
    let at = |places: &[(f64, f64)]| -> Vec<DVec2> { places.iter().copied().map(DVec2::from).collect() };
    let mut network = network();
    let streets = [
        street(&at(&[(0.0, 0.0), (200.0, 0.0)]), 14.0, 0),
        street(&at(&[(0.0, 0.0), (200.0, 12.0)]), 10.0, 0),
        street(&at(&[(0.0, -6.0), (200.0, -6.0)]), 14.0, 0),
        street(&at(&[(100.0, -60.0), (100.0, -6.4)]), 8.0, 0),
    ];
    assert_eq!(network.add_existing(&streets).expect("room").losses, []);
    let length: f64 = network.pieces().map(|(piece, _)| network.length(piece)).sum();
    assert!((length - (200.0 + 200.0_f64.hypot(12.0) + 200.0 + 54.0)).abs() < 0.01, "{length}");
    assert_eq!((network.size(), network.components(), network.dead_ends().count()), (5, 2, 5));
}

#[test]
fn streets_of_different_levels_cross_without_a_junction_and_join_at_their_ends() {
    let at = |places: &[(f64, f64)]| -> Vec<DVec2> { places.iter().copied().map(DVec2::from).collect() };
    let mut network = network();
    let streets = [
        street(&at(&[(0.0, 0.0), (200.0, 0.0)]), 14.0, 0),
        street(&at(&[(100.0, -90.0), (100.0, -40.0)]), 14.0, 0),
        street(&at(&[(100.0, -40.0), (100.0, 40.0)]), 14.0, 1),
        street(&at(&[(100.0, 40.0), (100.0, 90.0)]), 14.0, 0),
        street(&at(&[(50.0, -40.0), (50.0, 40.0)]), 14.0, -1),
    ];
    assert_eq!(network.add_existing(&streets).expect("room").losses, []);
    assert_eq!((network.size(), network.components()), (5, 3));
    // A growing street also passes below the bridge.
    let start = network.begin(DVec2::new(60.0, -20.0)).expect("free ground");
    let small = StreetAttributes { width: 6.0, ..StreetAttributes::default() };
    let growth = network.grow(start, DVec2::new(160.0, -25.0), small).expect("room");
    assert_eq!(growth.fate, crate::Fate::Built);
    check_planar(&network, "grown");
}

#[test]
fn what_has_no_place_or_no_length_is_reported_with_its_name() {
    let mut network = network();
    let good = [DVec2::ZERO, DVec2::new(50.0, 0.0)];
    let streets = [
        street(
            &[
                DVec2::ZERO,
                DVec2::new(50.0, 0.0),
                DVec2::new(f64::NAN, 0.0),
                DVec2::new(90.0, 0.0),
                DVec2::new(99.0, 0.0),
            ],
            9.0,
            0,
        ),
        street(&[DVec2::new(5.0, 5.0)], 8.0, 0),
        street(&[], 7.0, 0),
        street(&good, 6.0, 0),
    ];
    let report = network.add_existing(&streets).expect("room");
    let losses: Vec<_> = report.losses.iter().map(|loss| (loss.name.as_str(), loss.at, loss.why)).collect();
    assert_eq!(
        losses,
        [
            ("street 9 0", Some(good[1]), ExistingLossReason::Outside),
            ("street 8 0", Some(DVec2::new(5.0, 5.0)), ExistingLossReason::NoLength),
            ("street 7 0", None, ExistingLossReason::NoLength),
        ]
    );
    assert_eq!(network.size(), 2);
}

#[test]
fn a_start_beside_an_existing_street_is_on_it_and_moves_nothing() {
    for (start, expected) in
        [((100.0, 0.3), (100.0, 0.0)), ((0.2, 0.2), (0.0, 0.0)), ((50.0, 8.0), (50.0, 8.0))]
    {
        let mut network = network();
        let number = network.begin(DVec2::from(start)).expect("free ground");
        let line = [DVec2::ZERO, DVec2::new(200.0, 0.0)];
        assert_eq!(network.add_existing(&[street(&line, 10.0, 0)]).expect("room").losses, []);
        assert_eq!((number, network.at(number)), (0, DVec2::from(expected)));
        let on = network.junctions()[0].degree();
        assert_eq!(
            on,
            match start.0 as u32 {
                100 => 2,
                0 => 1,
                _ => 0,
            }
        );
    }
}

#[test]
fn the_same_streets_again_are_nothing_new() {
    let at = |places: &[(f64, f64)]| -> Vec<DVec2> { places.iter().copied().map(DVec2::from).collect() };
    let mut network = network();
    let streets = [
        street(&at(&[(0.0, 0.0), (200.0, 0.0), (260.0, 70.0)]), 14.0, 0),
        street(&at(&[(50.0, -90.0), (50.0, 90.0)]), 8.0, 0),
        street(&at(&[(90.0, -90.0), (90.0, 90.0)]), 8.0, 1),
    ];
    for _ in 0..3 {
        assert_eq!(network.add_existing(&streets).expect("room").losses, []);
        assert_eq!((network.size(), network.components(), network.has_existing()), (6, 2, true));
    }
    // Streets that grew earlier remain, and are joined to the added street.
    let start = network.begin(DVec2::new(150.0, -60.0)).expect("free ground");
    let grown = network.grow(start, DVec2::new(230.0, -60.0), streets[1].attributes).expect("room");
    assert_eq!(grown.fate, crate::Fate::Built);
    network.add_existing(&[street(&at(&[(190.0, -90.0), (190.0, 0.0)]), 8.0, 0)]).expect("room");
    assert_eq!((network.size(), network.components()), (11, 2));
    check_planar(&network, "grown");
}

#[test]
fn lines_without_a_cycle_enclose_nothing_however_large_their_coordinates() {
    let lines = [[(10, -10), (-58, -43)], [(22, 15), (-55, -7)], [(-40, 0), (41, -45)]];
    for scale in [11.3, 1000.0, 4000.0] {
        let mut network = network();
        let streets = lines
            .map(|line| street(&line.map(|(x, y)| DVec2::new(f64::from(x), f64::from(y)) * scale), 10.0, 0));
        network.add_existing(&streets).expect("room");
        assert_eq!((network.faces().len(), network.size(), network.components()), (0, 7, 1), "{scale}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn lines_at_random_meet_only_at_junctions_however_small(
        lines in prop::collection::vec(prop::collection::vec((-60_i32..60, -60_i32..60), 0..5), 1..25),
        scale in prop::sample::select(vec![0.001, 0.01, 0.37, 1.0, 5.3, 11.3, 4000.0]),
    ) {
        let mut network = network();
        let streets: Vec<ExistingStreet> = lines.iter().map(|line| {
            let places = line.iter().map(|(x, y)| DVec2::new(f64::from(*x), f64::from(*y)) * scale);
            street(&places.collect::<Vec<_>>(), 10.0, 0)
        }).collect();
        let report = network.add_existing(&streets).expect("room");
        prop_assert!(report.losses.iter().all(|loss| loss.why == ExistingLossReason::NoLength), "{:?}", report.losses);
        check_planar(&network, "random");
        let there = network.junctions().iter().filter(|junction| junction.degree() > 0).count();
        prop_assert_eq!(there + network.faces().len(), network.size() + network.components());
    }
}
