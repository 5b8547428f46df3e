//! Tests of streets on random hills: slopes, level junctions, and surfaces without gaps.

use burgeon_geometry::{Polygon, Rings};
use glam::{DVec2, DVec3};

use super::*;
use crate::surface_tests::check_surfaces;
use crate::tests::{TestNumbers, grown, kinds};

/// Returns hills of a few waves with the given maximum slope (m/m).
pub(crate) fn hills(seed: u64, steep: f64) -> impl Fn(DVec2) -> Option<f64> {
    let mut random = TestNumbers(seed * 7 + 3);
    let mut wave = |length: f64| {
        (DVec2::from_angle(random.below(6.3)) / length, random.below(6.3), length * steep / 2.0)
    };
    let waves = [wave(40.0), wave(90.0), wave(160.0), wave(400.0)];
    move |at| Some(waves.iter().map(|(way, phase, height)| (at.dot(*way) + phase).sin() * height / 2.0).sum())
}

#[test]
fn no_street_is_steeper_than_it_may_be() {
    for seed in 1..=40 {
        let network = grown(seed, 120, Constraints::default(), Obstacles::default());
        let max_slope = [0.03, 0.06, 0.1, 0.15][seed as usize % 4];
        let options = SurfaceOptions { turning: if seed % 2 == 0 { 11.0 } else { 0.0 } };
        let slopes = SlopeOptions { max_slope, least: [None; 2] };
        let fit = network.lay(options, slopes, hills(seed, 0.4)).expect("ground everywhere");
        let surfaces = network.surfaces(options, &fit.profiles);
        let mut steepest = 0.0_f64;
        for surface in &surfaces.carriageways {
            for corners in &surface.triangles {
                let [a, b, c] = corners.map(|corner| surface.points[corner as usize]);
                let normal = (b - a).cross(c - a).normalize();
                steepest = steepest.max(normal.truncate().length() / normal.z);
                // Segments are level across: the steepest direction is along the street.
                if let (Some(piece), true) = (surface.piece, normal.z < 0.9999) {
                    let [from, to] = network.line(piece);
                    let across = normal.truncate().normalize().perp_dot((to - from).normalize()).abs();
                    assert!(across < 0.01, "seed {seed}: {across} across");
                }
            }
        }
        assert!(steepest <= max_slope + 1e-6, "seed {seed}: {steepest} > {max_slope}");
        assert!(steepest > max_slope * 0.9, "seed {seed}: {steepest} uses what it may of {max_slope}");
        if seed % 4 == 0 {
            check_surfaces(&network, options, &fit.profiles);
        }
    }
}

#[test]
fn streets_on_gentle_ground_lie_on_it() {
    for seed in 1..=10 {
        let network = grown(seed, 120, Constraints::default(), Obstacles::default());
        let slopes = SlopeOptions { max_slope: 0.12, least: [None; 2] };
        let plane = |at: DVec2| Some(at.x * 0.05 - at.y * 0.03 + 7.0);
        let fit = network.lay(SurfaceOptions::default(), slopes, plane).expect("ground everywhere");
        let deepest = fit.depths.iter().copied().fold(0.0, f64::max);
        assert!(deepest < 2.5, "{deepest}");
    }
}

#[test]
fn bridges_and_shores_are_no_lower_than_they_may_be() {
    for seed in 1..=10 {
        let mut network = grown(seed, 120, Constraints::default(), Obstacles::default());
        let bridge = network.pieces().map(|(id, _)| id).nth(20).expect("many pieces");
        network.pieces[bridge as usize].is_bridge = true;
        let slopes = SlopeOptions { max_slope: 0.08, least: [Some(0.5), Some(4.0)] };
        let fit =
            network.lay(SurfaceOptions::default(), slopes, hills(seed, 0.3)).expect("ground everywhere");
        for (piece, known) in network.pieces() {
            let least = if known.is_bridge { 4.0 } else { 0.5 };
            for [_, height] in fit.profiles.stations(piece) {
                assert!(*height >= least - 1e-9, "{height}");
            }
        }
    }
}

#[test]
fn what_stands_beside_streets_stands_on_sidewalks() {
    let flat = StreetProfiles::default();
    let (mut trees, mut lamps) = (0, 0);
    for seed in 1..=20 {
        let network = grown(seed, 120, Constraints::default(), Obstacles::default());
        let mut kinds = kinds(seed);
        for kind in kinds.iter_mut().filter(|kind| kind.sidewalk >= 1.0) {
            (kind.trees, kind.lamps) = (9.0, 16.0);
        }
        let options = SurfaceOptions { turning: 11.0 };
        let [of_trees, of_lamps] =
            [VergeKind::Tree, VergeKind::Lamp].map(|thing| network.verge(options, &flat, &kinds, thing));
        (trees, lamps) = (trees + of_trees.len(), lamps + of_lamps.len());
        let surfaces = network.surfaces(options, &flat);
        for (index, found) in of_trees.iter().chain(&of_lamps).enumerate() {
            let place = found.place.truncate();
            let [a, b] = network.line(found.piece);
            let aside = (b - a).normalize().perp_dot(place - a).abs();
            let attributes = network.attributes(found.piece);
            if aside > 1e-9 {
                assert!(aside > attributes.carriageway() / 2.0 && aside < attributes.width / 2.0, "{aside}");
                let toward = DVec2::from_angle(found.heading.to_radians());
                assert!((b - a).normalize().perp_dot(place - a + toward).abs() < aside);
            }
            // No other street is nearer.
            for (piece, other) in network.pieces().filter(|(piece, _)| *piece != found.piece) {
                let (distance, on) = crate::plan::grid::foot(place, network.line(piece));
                let beside = (0.001..0.999).contains(&on);
                assert!(
                    !beside || distance > other.attributes.width / 2.0 - 1e-9,
                    "seed {seed}: {index} is on {piece}"
                );
            }
            for surface in &surfaces.carriageways {
                for corners in &surface.triangles {
                    let corners = corners.map(|corner| surface.points[corner as usize].truncate());
                    let inside = (0..3)
                        .all(|at| (corners[(at + 1) % 3] - corners[at]).perp_dot(place - corners[at]) > 0.0);
                    assert!(!inside, "seed {seed}: {index} is on a carriageway");
                }
            }
        }
        for tree in &of_trees {
            assert!(of_lamps.iter().all(|lamp| lamp.place.distance(tree.place) > 1.0));
        }
    }
    assert!(trees > 5000 && lamps > 3000, "{trees} trees, {lamps} lamps");
}

#[test]
fn bridges_stand_in_the_water_that_they_lead_over() {
    let (mut found, mut landed) = (0, 0);
    for seed in 1..=40_u32 {
        let (low, high) = (60.0 + f64::from(seed % 7), 95.0 + f64::from(seed % 5) * 9.0);
        let river =
            [(-900.0, low), (900.0, low + 20.0), (900.0, high + 20.0), (-900.0, high)].map(DVec2::from);
        let area = Polygon::new(Rings(vec![river.to_vec()])).expect("a river");
        let water = Obstacle { area: area.clone(), is_limit: false, can_be_bridged: true };
        let constraints = Constraints { bridge: 120.0, ..Constraints::default() };
        let network = grown(u64::from(seed), 120, constraints, Obstacles::new(vec![water]));
        let options = SurfaceOptions::default();
        check_surfaces(&network, options, &StreetProfiles::default());
        let bridges = network.pieces().filter(|(_, piece)| piece.is_bridge).count();
        let spans = network.spans(options, &StreetProfiles::default());
        assert_eq!(spans.len(), bridges);
        found += bridges;
        let footings = network.footings(options, &StreetProfiles::default());
        for span in spans {
            // The part that a bridge carries has no footing on the ground; the footing is as wide before and after it.
            let of_span = footings.iter().filter(|footing| footing.piece == Some(span.piece));
            let lengths =
                of_span.clone().map(|footing| footing.line[0].distance(footing.line[footing.line.len() - 1]));
            let length = network.length(span.piece);
            assert!((lengths.sum::<f64>() - length).abs() < 0.2, "seed {seed}");
            let on_ground = of_span.filter(|footing| !footing.is_below).flat_map(|footing| &footing.line);
            assert!(on_ground.map(|at| at.truncate()).all(|at| !area.contains(at)), "seed {seed}");
            let [right, left] = &span.sides;
            assert_eq!(right.len(), left.len());
            assert!(right.windows(2).all(|pair| span.way.dot((pair[1] - pair[0]).truncate()) > 0.0));
            let [from, to] = network.line(span.piece);
            if area.contains((from + to) / 2.0) {
                assert_eq!(span.shores.len(), 2, "seed {seed}");
            }
            // The bridge spans the water, and does not continue along houses.
            let along = |at: &DVec3| span.way.dot(at.truncate() - from);
            if let [first, last] = span.shores[..] {
                for side in &span.sides {
                    let land = [along(&first) - along(&side[0]), along(&side[side.len() - 1]) - along(&last)];
                    assert!(land.iter().all(|land| *land < 10.0), "seed {seed}: {land:?}");
                    // A junction may be located on the shore.
                    landed += land.iter().filter(|land| **land >= 3.0 - 1e-9).count();
                }
            }
            let half = network.attributes(span.piece).width / 2.0;
            for pier in &span.piers {
                let beside = [-half, 0.0, half].map(|aside| pier.truncate() + span.way.perp() * aside);
                assert!(beside.iter().any(|at| area.contains(*at)), "seed {seed}: {pier}");
            }
        }
    }
    assert!(found > 40 && landed > 2 * found, "{found} bridges, {landed} ends of sides on land");
}
