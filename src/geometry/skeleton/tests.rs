//! Tests of straight skeletons.

use super::samples::{Random, plan};
use super::*;

fn ring(points: &[(f64, f64)]) -> Vec<DVec2> {
    points.iter().map(|&(x, y)| DVec2::new(x, y)).collect()
}

fn hip(rings: &[Vec<DVec2>]) -> Skeleton {
    let paces = vec![Pace::default(); rings.iter().map(Vec::len).sum()];
    Skeleton::new(rings, &paces).expect("a skeleton")
}

#[test]
fn twelve_thousand_random_plans_have_sound_skeletons_and_few_are_moved() {
    let mut random = Random(7);
    let (mut moved, mut count, mut failed) = (0, 0, Vec::new());
    for round in 0.. {
        let Some(rings) = plan(round, &mut random) else { continue };
        let paces = vec![Pace::default(); rings.iter().map(Vec::len).sum()];
        match Skeleton::new(&rings, &paces) {
            Ok(found) => moved += u32::from(found.moved),
            Err(error) => failed.push(format!("{round}: {error}: {rings:?}")),
        }
        count += 1;
        if count == 12_000 {
            break;
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
    assert!(moved <= 24, "{moved} plans had to be moved");
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
    let found = hip(&[ring(&comb)]);
    assert_eq!((found.faces.len(), found.moved), (comb.len(), false));
}

#[test]
fn a_square_an_l_and_a_courtyard_have_their_ridges() {
    let square = hip(&[ring(&[(0., 0.), (2., 0.), (2., 2.), (0., 2.)])]);
    assert_eq!((square.peaks.len(), square.duration()), (5, 1.0));
    let l = hip(&[ring(&[(0., 0.), (6., 0.), (6., 2.), (2., 2.), (2., 6.), (0., 6.)])]);
    assert_eq!(l.duration(), 1.0);
    let u = hip(&[
        ring(&[(0., 0.), (9., 0.), (9., 9.), (0., 9.)]),
        ring(&[(3., 3.), (3., 6.), (6., 6.), (6., 3.)]),
    ]);
    assert_eq!(u.duration(), 1.5);
}

#[test]
fn an_edge_that_stands_still_has_a_face_without_area_until_it_begins_to_move() {
    let rectangle = ring(&[(0., 0.), (8., 0.), (8., 4.), (0., 4.)]);
    let area = |skeleton: &Skeleton, edge: usize| {
        faces::twice_area(skeleton.faces[edge].iter().map(|&peak| skeleton.peaks[peak].at)) / 2.0
    };
    let mut paces = [Pace::default(); 4];
    paces[1] = Pace::STILL;
    let gable = Skeleton::new(std::slice::from_ref(&rectangle), &paces).expect("a skeleton");
    assert_eq!((gable.faces[1].len(), gable.duration()), (3, 2.0));
    assert!(area(&gable, 1).abs() < 1e-9 && (area(&gable, 0) - 14.0).abs() < 1e-6);
    paces[1] = Pace { speed: 1.0, rest: 1.0 };
    let half = Skeleton::new(std::slice::from_ref(&rectangle), &paces).expect("a skeleton");
    // A triangle 2 m wide and 1 m deep.
    assert!((area(&half, 1) - 1.0).abs() < 1e-6, "{}", area(&half, 1));
}

#[test]
fn a_face_may_go_around_the_end_of_an_edge_that_stands_still() {
    let corners = [(6.9, 0.1), (0.5, 6.7), (-6.5, -0.2), (-1.0, -6.0), (-0.5, -6.8)];
    let mut paces = [Pace::default(); 5];
    paces[2] = Pace::STILL;
    let found = Skeleton::new(&[ring(&corners)], &paces).expect("a skeleton");
    assert!(!found.moved && found.faces[2].len() > 3);
}
