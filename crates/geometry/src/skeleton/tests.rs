//! Tests of straight skeletons.

use super::super::{Plan, Polygon, Rings};
use super::samples::{FAMILIES, Random, mixed, still};
use super::*;
use crate::planar::twice_area;
use glam::DVec2;

/// Returns the plan of rings; `None` if the random rings cross.
pub(crate) fn plan(rings: &[Vec<DVec2>]) -> Option<Polygon> {
    let rings: Rings = rings.iter().map(|ring| ring.iter().map(|at| at.extend(0.0)).collect()).collect();
    Plan::new(&rings).ok().map(|plan| plan.flat())
}

fn polygon(rings: &[&[(f64, f64)]]) -> Polygon {
    let ring = |points: &&[(f64, f64)]| points.iter().copied().map(DVec2::from).collect();
    Polygon::new(rings.iter().map(ring).collect::<Rings<DVec2>>()).expect("a polygon")
}

fn hip(rings: &[&[(f64, f64)]]) -> Skeleton {
    let polygon = polygon(rings);
    Skeleton::new(&polygon, &vec![Pace::default(); polygon.size()]).expect("a skeleton")
}

/// Checks the uniform skeletons of plans, and skeletons with some edges that stand still, rest or are slow;
/// returns the number of plans.
fn all_are_sound(plans: impl Iterator<Item = Polygon>, random: &mut Random) -> usize {
    let (mut count, mut failed, mut stuck) = (0, Vec::new(), Vec::new());
    for rings in plans {
        let mut paces = vec![Pace::default(); rings.size()];
        if let Err(error) = Skeleton::new(&rings, &paces) {
            failed.push(format!("{error}: {rings:?}"));
        }
        count += 1;
        if count % 4 > 0 {
            continue;
        }
        for index in 1..paces.len() {
            let chance = random.next();
            if paces[index - 1] != Pace::default() || chance > 0.2 {
                continue;
            }
            paces[index] = match chance {
                chance if chance < 0.1 => Pace::STILL,
                chance if chance < 0.15 => Pace { speed: 1.0, rest: (chance * 1024.0).round() / 64.0 },
                chance => Pace { speed: chance * 4.0, rest: 0.0 },
            };
        }
        if let Err(error) = Skeleton::new(&rings, &paces) {
            stuck.push(format!("{error}: {rings:?} {paces:?}"));
        }
    }
    assert!(failed.is_empty(), "{} of {count}: {}", failed.len(), failed[0]);
    assert!(stuck.is_empty(), "{} of {count}: {}", stuck.len(), stuck[0]);
    count
}

#[test]
fn twelve_thousand_random_plans_have_sound_skeletons() {
    let mut random = Random(7);
    let plans: Vec<_> =
        (0..14_000).filter_map(|round| plan(&mixed(round, &mut random))).take(12_000).collect();
    assert_eq!(all_are_sound(plans.into_iter(), &mut random), 12_000);
}

#[test]
fn regular_plans_with_and_without_noise_have_sound_skeletons_at_every_size_and_place() {
    for family in &FAMILIES {
        let mut random = Random(3);
        let plans: Vec<_> = (0..200)
            .filter_map(|round| {
                let mut rings = (family.make)(&mut random);
                let size = rings.iter().flatten().map(|at| at.abs().max_element()).fold(0.0, f64::max);
                let scale = [1.0, 1.0 / size, 1000.0 / size, 1.0][round % 4];
                let offset = if round % 4 == 3 { DVec2::new(1e6, -1.37e6) } else { DVec2::ZERO };
                rings.iter_mut().flatten().for_each(|at| *at = *at * scale + offset);
                plan(&rings)
            })
            .collect();
        let count = all_are_sound(plans.into_iter(), &mut random);
        assert!(count > 150, "{count} {}", family.name);
    }
}

/// Returns the paces of a plan's edges, some of which stand still.
fn paces(polygon: &Polygon, still: &[[f64; 2]]) -> Vec<Pace> {
    still.iter().map(|&[speed, rest]| Pace { speed, rest }).take(polygon.size()).collect()
}

#[test]
fn regular_plans_with_edges_that_rest_or_stand_still_have_sound_skeletons() {
    for family in &FAMILIES {
        let mut random = Random(5);
        let mut count = 0;
        for round in 0..60 {
            let (rings, still) = ((family.make)(&mut random), still(&mut random));
            let Some(polygon) = plan(&rings).filter(|polygon| polygon.size() <= still.len()) else {
                continue;
            };
            let found = Skeleton::new(&polygon, &paces(&polygon, &still));
            assert!(found.is_ok(), "{} {round}: {found:?} {polygon:?}", family.name);
            count += 1;
        }
        assert!(count > 45, "{count} {}", family.name);
    }
}

#[test]
fn an_edge_that_is_gone_before_it_begins_to_move_hides_nothing_that_others_reach() {
    // A corner of a wheel reaches the line of such an edge before it reaches an edge that still exists.
    let wheels = FAMILIES.iter().find(|family| family.name == "wheels").expect("wheels");
    let mut random = Random(3);
    let mut next = || ((wheels.make)(&mut random), still(&mut random));
    let (rings, still) = (0..=984).map(|_| next()).last().expect("a wheel");
    let polygon = plan(&rings).expect("a polygon");
    assert_eq!(polygon.size(), 18);
    assert!(Skeleton::new(&polygon, &paces(&polygon, &still)).is_ok());
}

#[test]
fn a_comb_of_400_teeth_is_roofed() {
    let mut comb = Vec::new();
    for tooth in 0..400 {
        let x = 2.0 * f64::from(tooth);
        comb.extend([(x, -5.0), (x + 1.0, -5.0), (x + 1.0, 0.0), (x + 2.0, 0.0)]);
    }
    comb.truncate(comb.len() - 2);
    comb.extend([(799.0, 5.0), (0.0, 5.0)]);
    let found = hip(&[&comb]);
    assert_eq!(found.faces.len(), comb.len());
}

#[test]
fn a_square_an_l_and_a_courtyard_have_their_ridges() {
    let square = hip(&[&[(0., 0.), (2., 0.), (2., 2.), (0., 2.)]]);
    assert_eq!((square.peaks.len(), square.duration()), (5, 1.0));
    let l = hip(&[&[(0., 0.), (6., 0.), (6., 2.), (2., 2.), (2., 6.), (0., 6.)]]);
    assert_eq!(l.duration(), 1.0);
    let u = hip(&[&[(0., 0.), (9., 0.), (9., 9.), (0., 9.)], &[(3., 3.), (3., 6.), (6., 6.), (6., 3.)]]);
    assert_eq!(u.duration(), 1.5);
}

#[test]
fn an_edge_that_stands_still_has_a_face_without_area_until_it_begins_to_move() {
    let rectangle = polygon(&[&[(0., 0.), (8., 0.), (8., 4.), (0., 4.)]]);
    let area = |skeleton: &Skeleton, edge: usize| {
        twice_area(skeleton.faces[edge].iter().map(|&peak| skeleton.peaks[peak].at)) / 2.0
    };
    let mut paces = [Pace::default(); 4];
    paces[1] = Pace::STILL;
    let gable = Skeleton::new(&rectangle, &paces).expect("a skeleton");
    assert_eq!((gable.faces[1].len(), gable.duration()), (3, 2.0));
    assert!(area(&gable, 1).abs() < 1e-9 && (area(&gable, 0) - 14.0).abs() < 1e-6);
    paces[1] = Pace { speed: 1.0, rest: 1.0 };
    let half = Skeleton::new(&rectangle, &paces).expect("a skeleton");
    // A triangle 2 m wide and 1 m deep.
    assert!((area(&half, 1) - 1.0).abs() < 1e-6, "{}", area(&half, 1));
}

#[test]
fn edges_around_an_area_that_nothing_else_sweeps_begin_to_move_at_last() {
    // A wing whose long sides and one end stand still: after its other end has vanished, nothing moves in it.
    let corners = [(0., 0.), (12., 0.), (12., 4.), (8., 4.), (8., 9.), (4., 9.), (4., 4.), (0., 4.)];
    let still = |edges: &[usize]| {
        let mut paces = [Pace::default(); 8];
        edges.iter().for_each(|&edge| paces[edge] = Pace::STILL);
        let found = Skeleton::new(&polygon(&[&corners]), &paces).expect("a skeleton");
        let late: Vec<usize> = (0..8).filter(|&edge| found.paces[edge] != paces[edge]).collect();
        (late, found)
    };
    assert!(still(&[1, 4, 7]).0.is_empty());
    let (late, found) = still(&[0, 1, 2, 3, 4, 5, 6, 7]);
    assert_eq!(late, [0, 1, 2, 3, 4, 5, 6, 7]);
    assert!(found.faces.iter().all(|face| face.len() > 2) && found.duration() > 2.0);
}

#[test]
fn a_face_may_go_around_the_end_of_an_edge_that_stands_still() {
    let corners = [(6.9, 0.1), (0.5, 6.7), (-6.5, -0.2), (-1.0, -6.0), (-0.5, -6.8)];
    let mut paces = [Pace::default(); 5];
    paces[2] = Pace::STILL;
    let found = Skeleton::new(&polygon(&[&corners]), &paces).expect("a skeleton");
    assert!(found.faces[2].len() > 3);
}

#[test]
fn edges_in_one_line_have_a_straight_border_from_where_they_meet() {
    // A square with points on its edges, and a notch that closes before the ridge is reached.
    let square = hip(&[&[(0., 0.), (1., 0.), (4., 0.), (4., 4.), (2., 4.), (0., 4.), (0., 3.)]]);
    assert!(square.duration() == 2.0 && square.faces.iter().all(|face| face.len() >= 3));
    let notched = hip(&[&[(0., 0.), (4., 0.), (4., -1.), (5., -1.), (5., 0.), (9., 0.), (9., 6.), (0., 6.)]]);
    // The border between the two parts of the front ends on the ridge.
    let [left, right] = [&notched.faces[0], &notched.faces[4]];
    let mut shared = left.iter().filter(|peak| right.contains(peak)).map(|&peak| notched.peaks[peak]);
    assert!(shared.any(|peak| peak.at == DVec2::new(4.5, 3.0) && peak.time == 3.0));
}

#[test]
fn the_faster_of_two_edges_in_one_line_sweeps_what_the_slower_one_has_left() {
    // A step of 1 m closes when its lower edge has reached the line of the upper edge, which stands still.
    let step = polygon(&[&[(0., 0.), (5., 0.), (5., 1.), (9., 1.), (9., 7.), (0., 7.)]]);
    let mut paces = [Pace::default(); 6];
    (paces[1], paces[2]) = (Pace::STILL, Pace::STILL);
    let found = Skeleton::new(&step, &paces).expect("a skeleton");
    let upper: Vec<DVec2> = found.faces[2].iter().map(|&peak| found.peaks[peak].at).collect();
    assert!(upper.iter().all(|at| at.y == 1.0), "{upper:?}");
}

#[test]
fn an_outline_that_turns_back_on_itself_is_refused() {
    let spike = polygon(&[&[(0., 0.), (4., 0.), (4., 4.), (4., 2.), (0., 2.)]]);
    assert!(Skeleton::new(&spike, &[Pace::default(); 5]).is_err());
}

/// Measures the volume below a hip roof, the height of its highest ridge, and the maximum distance of corners
/// from the planes of their faces, all relative to the extent.
fn measured(polygon: &Polygon) -> [f64; 3] {
    let skeleton = Skeleton::new(polygon, &vec![Pace::default(); polygon.size()]).expect("a skeleton");
    let [low, high] = polygon.bounds().expect("points");
    let extent = (high - low).max_element();
    let (mut volume, mut off) = (0.0, 0f64);
    for (face, [a, b]) in skeleton.faces.iter().zip(polygon.edges()) {
        let inwards = (b - a).normalize().perp();
        let at = |index: usize| skeleton.peaks[face[index]];
        for index in 0..face.len() {
            off = off.max((inwards.dot(at(index).at - a) - at(index).time).abs());
        }
        for index in 2..face.len() {
            let [one, two, three] = [at(0), at(index - 1), at(index)];
            let area = (two.at - one.at).perp_dot(three.at - one.at) / 2.0;
            volume += area * (one.time + two.time + three.time) / 3.0;
        }
    }
    [volume / extent.powi(3), skeleton.duration() / extent, off / extent]
}

#[test]
fn skeletons_of_any_size_are_alike() {
    let mut random = Random(31);
    let mut count = 0;
    for round in 0..240 {
        let rings = if round % 2 == 0 {
            mixed(round / 2, &mut random)
        } else {
            (FAMILIES[round / 2 % FAMILIES.len()].make)(&mut random)
        };
        let Some(polygon) = plan(&rings) else { continue };
        let scaled = |scale: f64| {
            let rings = polygon.iter().map(|ring| ring.iter().map(|at| *at * scale).collect());
            Polygon::new(rings.collect::<Rings<DVec2>>()).expect("a polygon")
        };
        let wanted = measured(&polygon);
        assert!(wanted[2] < 4e-6, "{round}: {wanted:?}");
        for scale in [1e-6, 1e-4, 1e-3, 1e-2, 0.07, 0.7, 30.0, 1e3, 1e6] {
            let found = measured(&scaled(scale));
            let alike = (0..2).all(|index| (found[index] / wanted[index] - 1.0).abs() < 1e-4);
            assert!(alike && found[2] < 4e-6, "{round} at {scale}: {found:?} for {wanted:?}");
            count += 1;
        }
        for power in [-40, -7, 5, 60] {
            let (scale, paces) = (2f64.powi(power), vec![Pace::default(); polygon.size()]);
            let [one, two] =
                [&polygon, &scaled(scale)].map(|polygon| Skeleton::new(polygon, &paces).expect("one"));
            assert_eq!(one.faces, two.faces);
            assert!(one.peaks.iter().zip(&two.peaks).all(|(a, b)| a.time * scale == b.time));
        }
    }
    assert!(count > 1500, "{count}");
    let huge = polygon(&[&[(0., 0.), (1e100, 0.), (0., 1e100)]]);
    let error = Skeleton::new(&huge, &[Pace::default(); 3]).expect_err("too large");
    assert!(error.to_string().contains("1e-90 to 1e90"), "{error}");
}

#[test]
fn a_skeleton_ends_when_its_run_is_stopped() {
    let stop = std::sync::Arc::new(burgeon_base::Stop::new());
    let _work = stop.at_work();
    let square = polygon(&[&[(0., 0.), (2., 0.), (2., 2.), (0., 2.)]]);
    assert!(Skeleton::new(&square, &[Pace::default(); 4]).is_ok());
    stop.stop(burgeon_base::error::Error::cancellation("time is up"));
    let error = Skeleton::new(&square, &[Pace::default(); 4]).expect_err("stopped");
    assert_eq!(error.message(), "time is up");
}
