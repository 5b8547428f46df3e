//! Tests of streets that turn and change their width at the same junction.

use glam::DVec2;

use super::*;
use crate::plan::corner::StreetLine;
use crate::shape::shapes::StreetShapes;

/// Turns (degrees), and the street and sidewalk widths (m) before and after the turn.
const BENDS: [f64; 9] = [5.0, 20.0, 30.0, 36.0, 45.0, 60.0, 90.0, 120.0, 140.0];
const WIDTHS: [[[f64; 2]; 2]; 6] = [
    [[24.0, 3.0], [12.0, 2.0]],
    [[24.0, 4.0], [18.0, 3.0]],
    [[30.0, 3.0], [8.0, 2.0]],
    [[16.0, 3.0], [11.0, 2.0]],
    [[12.0, 1.0], [11.0, 3.0]],
    [[20.0, 0.0], [7.0, 1.0]],
];

/// Turns (degrees) where a third street leaves on the inside.
const FORKS: [f64; 6] = [36.0, 45.0, 60.0, 75.0, 90.0, 105.0];

/// Builds a street from the west that turns left by `bend` (degrees) at the origin and changes its widths there. If
/// `fork` is a width (m), a third street leaves halfway between the two.
fn bent(bend: f64, widths: [[f64; 2]; 2], fork: Option<f64>) -> StreetNetwork {
    let constraints = Constraints { min_angle: 30.0, snap: 0.0, clearance: 0.1, ..Constraints::default() };
    let mut network = StreetNetwork::new(constraints, Obstacles::default()).expect("constraints");
    let toward = |degrees: f64| DVec2::from_angle(degrees.to_radians()) * 200.0;
    let mut from = network.begin(DVec2::new(-200.0, 0.0)).expect("free ground");
    for (to, [width, sidewalk]) in [DVec2::ZERO, toward(bend)].into_iter().zip(widths) {
        let street = StreetAttributes { width, sidewalk, ..StreetAttributes::default() };
        from = network.grow(from, to, street).expect("room").end;
    }
    if let Some(width) = fork {
        let street = StreetAttributes { width, sidewalk: width * 0.15, ..StreetAttributes::default() };
        network.grow(1, toward(90.0 + bend / 2.0), street).expect("room");
    }
    assert_eq!(network.size(), 2 + usize::from(fork.is_some()));
    network
}

/// Returns the street's right kerb (m) in its direction, or its left kerb if no third street leaves there.
fn kerb(network: &StreetNetwork, is_left: bool) -> Vec<DVec2> {
    let shapes = StreetShapes::new(network, 0.0);
    let arms = &shapes.junction(1).arms;
    let far = [0, 2].map(|end| network.at(end));
    let [piece, next] = [u32::from(is_left), u32::from(!is_left)];
    let index = arms.iter().position(|arm| arm.piece == piece).expect("an arm");
    let [arm, next] = [&arms[index], arms.iter().find(|arm| arm.piece == next).expect("an arm")];
    let aside = |arm: &crate::shape::shapes::ArmShape| arm.arm.aside(StreetLine::Kerb);
    let [begin, end] = if is_left { [far[1], far[0]] } else { far };
    let mut kerb = vec![begin + arm.arm.way.perp() * aside(arm)];
    kerb.push(shapes.end(1, arm.piece, aside(arm)));
    kerb.extend(shapes.corner(1, index)[1].iter().copied());
    kerb.push(shapes.end(1, next.piece, -aside(next)));
    kerb.push(end - next.arm.way.perp() * aside(next));
    kerb.dedup();
    if is_left {
        kerb.reverse();
    }
    kerb
}

/// Returns the right and the left kerb (m) of a street without a fork.
fn kerbs(bend: f64, widths: [[f64; 2]; 2]) -> [Vec<DVec2>; 2] {
    let network = bent(bend, widths, None);
    [false, true].map(|is_left| kerb(&network, is_left))
}

/// Returns the total turn (radians) of a line to the left and to the right.
fn turns(line: &[DVec2]) -> [f64; 2] {
    let ways: Vec<DVec2> = line.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let turns = ways.windows(2).map(|pair| pair[0].angle_to(pair[1]));
    turns.fold([0.0; 2], |[left, right], turn| [left + turn.max(0.0), right - turn.min(0.0)])
}

/// Returns the distance (m) of a point outside the convex hull of `hull`; 0 inside.
fn outside(hull: &[DVec2], place: DVec2) -> f64 {
    let beyond = |a: DVec2, b: DVec2| (a != b).then(|| (place - a).perp_dot((b - a).normalize()));
    let sides = hull.iter().flat_map(|a| hull.iter().map(move |b| (*a, *b)));
    // All points are on the left of the hull's sides.
    let is_side = |a: DVec2, b: DVec2| hull.iter().all(|other| (b - a).perp_dot(*other - a) >= -1e-9);
    sides.filter(|(a, b)| is_side(*a, *b)).filter_map(|(a, b)| beyond(a, b)).fold(0.0, f64::max)
}

/// Returns the corners (m) of both carriageways of a street that turns at the origin.
fn spanned(bend: f64, widths: [[f64; 2]; 2]) -> Vec<DVec2> {
    let strip = |far: DVec2, [width, sidewalk]: [f64; 2]| {
        let across = far.normalize().perp() * (width / 2.0 - sidewalk);
        [-across, across, far - across, far + across]
    };
    let ways = [DVec2::NEG_X, DVec2::from_angle(bend.to_radians())];
    ways.into_iter().zip(widths).flat_map(|(way, widths)| strip(way * 201.0, widths)).collect()
}

#[test]
fn kerbs_of_bends_stay_within_what_both_streets_span() {
    for bend in BENDS {
        for widths in WIDTHS.into_iter().flat_map(|[a, b]| [[a, b], [b, a]]) {
            let hull = spanned(bend, widths);
            for at in kerbs(bend, widths).into_iter().flatten() {
                let outside = outside(&hull, at);
                assert!(outside < 0.01, "{bend} {widths:?}: {at} is {outside} m outside");
            }
        }
    }
}

#[test]
fn kerbs_of_bends_turn_only_as_the_street_does() {
    for bend in BENDS {
        for widths in WIDTHS.into_iter().flat_map(|[a, b]| [[a, b], [b, a]]) {
            let back = kerbs(bend, widths).map(|kerb| turns(&kerb)[1].to_degrees());
            // At a small turn, both kerbs approach the centreline and then follow it.
            let has_sidewalks = widths.iter().all(|[_, sidewalk]| *sidewalk > 0.0);
            let most = if bend < 34.4 {
                12.0
            } else if has_sidewalks {
                0.1
            } else {
                4.0
            };
            assert!(back.iter().all(|back| *back < most), "{bend} {widths:?}: {back:?} degrees back");
        }
    }
}

#[test]
fn the_kerb_on_the_outside_of_a_bend_is_as_smooth_where_another_street_leaves() {
    let mut count = 0;
    for (bend, fork) in FORKS.into_iter().flat_map(|bend| [6.0, 12.0, 20.0].map(|fork| (bend, fork))) {
        for widths in WIDTHS.into_iter().flat_map(|[a, b]| [[a, b], [b, a]]) {
            let kerb = kerb(&bent(bend, widths, Some(fork)), false);
            let hull = spanned(bend, widths);
            let outside = kerb.iter().map(|at| outside(&hull, *at)).fold(0.0, f64::max);
            let [left, right] = turns(&kerb).map(f64::to_degrees);
            assert!(outside < 0.01, "{bend} {widths:?} {fork}: {outside} m outside");
            assert!(right < 0.1 && left < bend + 0.1, "{bend} {widths:?} {fork}: {right} degrees back");
            count += 1;
        }
    }
    assert_eq!(count, 6 * 3 * 12);
}
