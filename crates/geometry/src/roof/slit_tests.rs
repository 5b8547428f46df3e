//! Tests of roofs over plans with slits: slits of at most 1 cm are filled, roofs follow wider ones.

use super::super::skeleton::samples::Random;
use super::super::{Plan, Rings, solid};
use super::tests::{HEIGHT, building};
use super::*;
use crate::planar::{self, Polygon, Ring};
use glam::DVec2;

/// Returns rotated rectangles and plans in the shape of an L, a T or a U.
fn outline(random: &mut Random) -> Vec<DVec2> {
    let mut between = |from: f64, to: f64| from + (to - from) * random.next();
    let (w, d) = (between(8.0, 16.0), between(7.0, 14.0));
    let (a, b) = (between(0.35, 0.6) * w, between(0.4, 0.6) * d);
    let (left, right) = (between(0.2, 0.35) * w, between(0.65, 0.8) * w);
    let ring = match (between(0.0, 4.0)) as u32 {
        0 => vec![(0., 0.), (w, 0.), (w, d), (0., d)],
        1 => vec![(0., 0.), (w, 0.), (w, b), (a, b), (a, d), (0., d)],
        2 => vec![(0., 0.), (w, 0.), (w, b), (right, b), (right, d), (left, d), (left, b), (0., b)],
        _ => vec![(0., 0.), (w, 0.), (w, d), (right, d), (right, b), (left, b), (left, d), (0., d)],
    };
    let turn = DVec2::from_angle(between(0.0, std::f64::consts::TAU));
    ring.into_iter().map(|at| turn.rotate(DVec2::from(at)) + DVec2::new(37.0, -12.0)).collect()
}

/// Adds a slit of a width (m) to the outline at a random position; `None` if it is too close to another wall.
fn slit(outline: &[DVec2], width: f64, random: &mut Random) -> Option<Vec<DVec2>> {
    let mut between = |from: f64, to: f64| from + (to - from) * random.next();
    let index = between(0.0, outline.len() as f64) as usize % outline.len();
    let (a, b) = (outline[index], outline[(index + 1) % outline.len()]);
    let along = (b - a).normalize();
    let lean = between(-0.7, 0.7);
    let into = DVec2::from_angle(lean).rotate(along.perp());
    let [mouth, other] = {
        let first = a + (b - a) * between(0.15, 0.85);
        [first, first + along * (width / lean.cos())]
    };
    let depth = between(0.5, 7.0);
    let oblique = between(-0.5, 0.5) * width;
    let ends = [mouth + into * (depth + oblique), other + into * depth];
    let ring = Ring::new(outline.to_vec()).expect("a ring");
    let is_free = |part: f64| {
        let at = mouth + into * (depth + 0.4) * part;
        let clear = |(number, [from, to]): (usize, [DVec2; 2])| {
            number == index || planar::distance([from, to], at) > 0.4
        };
        ring.contains(at) && planar::edges(outline).enumerate().all(clear)
    };
    if !(1..=40).all(|step| is_free(f64::from(step) / 40.0))
        || b.distance(other) < 0.4
        || a.distance(mouth) < 0.4
    {
        return None;
    }
    let mut ring = outline.to_vec();
    ring.splice(index + 1..index + 1, [mouth, ends[0], ends[1], other]);
    Some(ring)
}

/// Returns the ring with a point every `step` metres.
fn dense(ring: &[DVec2], step: f64) -> Vec<DVec2> {
    let points = planar::edges(ring).flat_map(|[a, b]| {
        let count = (a.distance(b) / step).ceil().max(1.0) as usize;
        (0..count).map(move |index| a.lerp(b, index as f64 / count as f64))
    });
    points.collect()
}

/// Returns the volume (m³) of a roof and the height (m) of its ridge.
fn measured(walls: &Polygon, ends: Ends) -> (f64, f64) {
    let surface = RoofSurface::Sloped(ends, &[]);
    let shape = RoofShape { surface, rise: Rise::Slope(0.7), overhang: 0.0, eaves: Eaves::Closed, slab: 0.0 };
    let cover = shape.cover(walls, HEIGHT).expect("a roof");
    let part = building(walls, &cover);
    assert!(solid::check([&part]).is_solid(), "{walls:?}");
    let top = part.positions.iter().map(|at| f64::from(at.z)).fold(0.0, f64::max);
    (solid::volume([&part]) - walls.area() * HEIGHT, top)
}

/// Returns `count`, multiplied by the environment variable `BURGEON_CASES` if it is set.
fn cases(count: usize) -> usize {
    count * std::env::var("BURGEON_CASES").ok().and_then(|times| times.parse().ok()).unwrap_or(1)
}

fn raised(ring: &[DVec2]) -> Rings {
    Rings(vec![ring.iter().map(|at| at.extend(0.0)).collect()])
}

#[test]
fn roofs_over_plans_with_slits_have_the_volume_of_the_plan_that_is_meant() {
    let mut random = Random(29);
    let (mut filled, mut followed, mut faults) = (0, 0, Vec::new());
    for round in 0..cases(500) {
        let outline = outline(&mut random);
        let width = [0.5e-3, 1e-3, 2e-3, 3e-3, 5e-3, 7e-3, 9.7e-3, 10.5e-3, 14e-3, 20e-3][round % 10];
        let Some(ring) = slit(&outline, width, &mut random) else { continue };
        let given = if round % 3 == 0 { dense(&ring, 0.07) } else { ring.clone() };
        let is_filled = width <= 0.01;
        let plan = Plan::new(&raised(&given)).unwrap_or_else(|error| panic!("{round}: {error}"));
        let meant = if is_filled { outline } else { ring };
        let meant = Polygon::new(vec![meant]).expect("a polygon");
        let ends = [Ends::Hips, Ends::Gables][round % 2];
        let ((volume, top), (wanted, ridge)) = (measured(&plan.flat(), ends), measured(&meant, ends));
        let is_reported = plan.repairs().0.contains(&"slits of at most 1 cm filled");
        if (volume / wanted - 1.0).abs() > 0.01 || (top - ridge).abs() > 0.02 || is_reported != is_filled {
            faults.push(format!(
                "{round}: {width} m {volume} for {wanted}, {top} for {ridge}, {:?} {:?}",
                plan.repairs(),
                plan.flat()
            ));
        }
        (filled, followed) = (filled + usize::from(is_filled), followed + usize::from(!is_filled));
    }
    assert!(
        faults.is_empty(),
        "{} of {}: {:#?}",
        faults.len(),
        filled + followed,
        &faults[..faults.len().min(8)]
    );
    assert!(filled > 120 && followed > 50, "{filled} {followed}");
}

#[test]
fn a_slit_that_bends_or_leads_into_a_courtyard_is_filled() {
    let square = [(0., 0.), (10., 0.), (10., 10.), (0., 10.)];
    let make = |corners: &[(f64, f64)]| {
        let ring: Vec<DVec2> = corners.iter().copied().map(DVec2::from).collect();
        Plan::new(&raised(&ring)).expect("a plan")
    };
    // From the bottom up to y = 4 and then to the right.
    let bent = [
        &square[..1],
        &[(4., 0.), (4., 4.), (7., 4.), (7., 3.995), (4.005, 3.995), (4.005, 0.)],
        &square[1..],
    ]
    .concat();
    let plan = make(&bent);
    assert_eq!(plan.polygon().size(), 4, "{plan:?}");
    assert!((plan.polygon().area() - 100.0).abs() < 1e-3);
    let court = [
        &square[..1],
        &[(4., 0.), (4., 3.), (3., 3.), (3., 7.), (7., 7.), (7., 3.), (4.004, 3.), (4.004, 0.)],
        &square[1..],
    ]
    .concat();
    let plan = make(&court);
    assert_eq!((plan.polygon().len(), plan.polygon().size()), (2, 8), "{plan:?}");
    assert!((plan.polygon().area() - 84.0).abs() < 1e-3);
    assert_eq!(plan.given_edges().len(), 8);
}

#[test]
fn sharp_notches_and_narrow_openings_that_are_meant_stay() {
    for (mouth, tip) in [(0.5, 0.0), (0.1, 0.0), (0.03, 0.0), (0.012, 0.011), (0.3, 0.02)] {
        let ring = [
            (0., 0.),
            (5.0 - mouth / 2.0, 0.),
            (5.0 - tip / 2.0, 3.),
            (5.0 + tip / 2.0, 3.),
            (5.0 + mouth / 2.0, 0.),
            (10., 0.),
            (10., 8.),
            (0., 8.),
        ];
        let mut ring: Vec<DVec2> = ring.map(DVec2::from).to_vec();
        ring.dedup();
        let plan = Plan::new(&raised(&ring)).expect("a plan");
        assert_eq!(plan.repairs().0, [""; 0], "{mouth}");
        let area = 80.0 - 3.0 * (mouth + tip) / 2.0;
        assert!((plan.polygon().area() - area).abs() < 1e-6, "{mouth}");
    }
}
