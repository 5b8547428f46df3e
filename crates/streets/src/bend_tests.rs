//! Streets that turn and change their widths where they do.

use glam::DVec2;

use super::*;
use crate::corner::StreetLine;
use crate::shape::StreetShapes;

/// How many degrees streets turn, and the widths (m) of both and of their sidewalks.
const BENDS: [f64; 9] = [5.0, 20.0, 30.0, 36.0, 45.0, 60.0, 90.0, 120.0, 140.0];
const WIDTHS: [[[f64; 2]; 2]; 6] = [
    [[24.0, 3.0], [12.0, 2.0]],
    [[24.0, 4.0], [18.0, 3.0]],
    [[30.0, 3.0], [8.0, 2.0]],
    [[16.0, 3.0], [11.0, 2.0]],
    [[12.0, 1.0], [11.0, 3.0]],
    [[20.0, 0.0], [7.0, 1.0]],
];

/// The kerbs (m) around a street that comes from the west, turns by `bend` (degrees) to the left at the origin, and is of
/// other widths from there: the one on the right of it and the one on the left, each as the street goes.
fn kerbs(bend: f64, widths: [[f64; 2]; 2]) -> [Vec<DVec2>; 2] {
    let constraints = Constraints { min_angle: 30.0, snap: 0.0, clearance: 0.1, ..Constraints::default() };
    let mut network = StreetNetwork::new(constraints, Obstacles::default()).expect("constraints");
    let far = DVec2::from_angle(bend.to_radians()) * 200.0;
    let mut from = network.begin(DVec2::new(-200.0, 0.0)).expect("free ground");
    for (to, [width, sidewalk]) in [DVec2::ZERO, far].into_iter().zip(widths) {
        let street = StreetAttributes { width, sidewalk, ..StreetAttributes::default() };
        from = network.grow(from, to, street).expect("room").end;
    }
    assert_eq!(network.size(), 2);
    let shapes = StreetShapes::new(&network, 0.0);
    let arms = &shapes.junction(1).arms;
    [0, 1].map(|piece| {
        let index = arms.iter().position(|arm| arm.piece == piece).expect("two arms");
        let [arm, next] = [&arms[index], &arms[1 - index]];
        let aside = |arm: &crate::shape::ArmShape| arm.arm.aside(StreetLine::Kerb);
        let mut kerb = vec![network.at(if piece == 0 { 0 } else { 2 }) + arm.arm.way.perp() * aside(arm)];
        kerb.push(shapes.end(1, arm.piece, aside(arm)));
        kerb.extend(shapes.corner(1, index)[1].iter().copied());
        kerb.push(shapes.end(1, next.piece, -aside(next)));
        kerb.push(network.at(if piece == 0 { 2 } else { 0 }) - next.arm.way.perp() * aside(next));
        kerb.dedup();
        if piece == 1 {
            kerb.reverse();
        }
        kerb
    })
}

/// By how much (radians) a line turns to the left in all, and to the right.
fn turns(line: &[DVec2]) -> [f64; 2] {
    let ways: Vec<DVec2> = line.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let turns = ways.windows(2).map(|pair| pair[0].angle_to(pair[1]));
    turns.fold([0.0; 2], |[left, right], turn| [left + turn.max(0.0), right - turn.min(0.0)])
}

/// How far (m) a place is outside of the hull of some places.
fn outside(hull: &[DVec2], place: DVec2) -> f64 {
    let beyond = |a: DVec2, b: DVec2| (a != b).then(|| (place - a).perp_dot((b - a).normalize()));
    let sides = hull.iter().flat_map(|a| hull.iter().map(move |b| (*a, *b)));
    // All of it lies on the left of the sides of the hull.
    let is_side = |a: DVec2, b: DVec2| hull.iter().all(|other| (b - a).perp_dot(*other - a) >= -1e-9);
    sides.filter(|(a, b)| is_side(*a, *b)).filter_map(|(a, b)| beyond(a, b)).fold(0.0, f64::max)
}

#[test]
fn kerbs_of_bends_stay_within_what_both_streets_span() {
    for bend in BENDS {
        for widths in WIDTHS.into_iter().flat_map(|[a, b]| [[a, b], [b, a]]) {
            let way = DVec2::from_angle(bend.to_radians());
            let strip = |far: DVec2, half: f64| {
                let across = far.normalize().perp() * half;
                [-across, across, far - across, far + across]
            };
            let [a, b] = widths.map(|[width, sidewalk]| width / 2.0 - sidewalk);
            let hull: Vec<DVec2> =
                [strip(DVec2::new(-201.0, 0.0), a), strip(way * 201.0, b)].into_iter().flatten().collect();
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
            // Of a street that turns a little both kerbs come nearer to its middle, and then go on along it.
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
