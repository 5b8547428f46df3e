//! Tests of the surfaces of random networks: areas add up, without overlaps or gaps.

use std::collections::BTreeMap;

use burgeon_geometry::planar::twice_area;
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

use super::*;
use crate::tests::{grown, kinds};

/// Returns the area (m²) of a surface; asserts that all triangles face upwards.
fn area(surface: &StreetSurface) -> f64 {
    let twice = surface.triangles.iter().map(|corners| {
        let corners = corners.map(|corner| surface.points[corner as usize]);
        let twice = twice_area(corners);
        assert!(twice > 1e-7, "a triangle of {twice} at {corners:?}");
        twice
    });
    twice.sum::<f64>() / 2.0
}

/// Asserts that surfaces have no overlaps and no gaps: their areas add up to those of the faces, no triangle is
/// inverted, and each edge is shared with another surface.
pub(crate) fn check_surfaces(network: &StreetNetwork, options: SurfaceOptions, profiles: &StreetProfiles) {
    let surfaces = network.surfaces(options, profiles);
    let streets: f64 = surfaces.carriageways.iter().map(area).sum();
    let medians: f64 = surfaces.medians.iter().map(|median| area(&median.top)).sum();
    let mut walks = 0.0;
    let mut inside = 0.0;
    for walk in &surfaces.sidewalks {
        assert_eq!(walk.kerb.len(), walk.edge.len());
        for index in 0..walk.kerb.len() {
            let next = (index + 1) % walk.kerb.len();
            let [a, b, c, d] = [walk.kerb[index], walk.kerb[next], walk.edge[next], walk.edge[index]];
            for triangle in [[a, b, c], [a, c, d]] {
                let twice = twice_area(triangle);
                assert!(twice > -1e-6, "a triangle of {twice} at {triangle:?}");
                walks += twice / 2.0;
            }
        }
        let area = twice_area(walk.edge.iter().copied()) / 2.0;
        assert!(!walk.is_around_block || area > 0.0, "a block of {area}");
        inside += area;
    }
    // Blocks count with their areas, and the outer boundaries of networks with negative areas.
    let all = streets + medians + walks + inside;
    assert!(all.abs() < 1e-6 * streets.max(1.0), "{streets} + {medians} + {walks} + {inside} = {all}");
    check_edges(&surfaces);
}

/// Asserts that each edge of a carriageway or a median occurs once in each direction, or is a kerb.
fn check_edges(surfaces: &StreetSurfaces) {
    // Not a multiple of the grid steps, so no point is on the border between two keys.
    let key = |at: DVec3| (at * 9871.3).round().as_i64vec3();
    let mut balance: FxHashMap<_, i32> = FxHashMap::default();
    let mut walk = |from: DVec3, to: DVec3| {
        let (from, to) = (key(from), key(to));
        if from == to {
            return;
        }
        let (ends, sign) = if from.to_array() < to.to_array() { ((from, to), 1) } else { ((to, from), -1) };
        *balance.entry(ends).or_default() += sign;
    };
    let tops = surfaces.medians.iter().map(|median| &median.top);
    for surface in surfaces.carriageways.iter().chain(tops) {
        for corners in &surface.triangles {
            let [a, b, c] = corners.map(|corner| surface.points[corner as usize]);
            walk(a, b);
            walk(b, c);
            walk(c, a);
        }
    }
    for side in &surfaces.sidewalks {
        for index in 0..side.kerb.len() {
            walk(side.kerb[index], side.kerb[(index + 1) % side.kerb.len()]);
        }
    }
    let open: Vec<_> = balance.iter().filter(|(_, balance)| **balance != 0).collect();
    assert!(open.is_empty(), "{} open edges, such as {:?}", open.len(), open[0]);
}

#[test]
fn surfaces_fill_the_plane_without_overlaps() {
    let (flat, mut medians) = (StreetProfiles::default(), 0);
    for seed in 1..=40 {
        let mut network = grown(seed, 150, Constraints::default(), Obstacles::default());
        for turning in [0.0, 11.0] {
            check_surfaces(&network, SurfaceOptions { turning }, &flat);
        }
        network.join_dead_ends(DeadEndOptions::default());
        check_surfaces(&network, SurfaceOptions::default(), &flat);
        medians += network.surfaces(SurfaceOptions::default(), &flat).medians.len();
    }
    assert!(medians > 1000, "{medians} medians");
}

#[test]
fn each_street_has_sidewalks_of_its_own_width() {
    for seed in 1..=8 {
        let network = grown(seed, 100, Constraints::default(), Obstacles::default());
        let surfaces = network.surfaces(SurfaceOptions::default(), &StreetProfiles::default());
        for street in surfaces.carriageways.iter().filter_map(|part| Some((part, part.piece?))) {
            let (part, piece) = street;
            let [a, b] = network.line(piece);
            let aside = |at: &DVec3| (b - a).normalize().perp_dot(at.truncate() - a).abs();
            let half = part.points.iter().map(aside).fold(0.0, f64::max);
            let attributes = network.attributes(piece);
            assert!((half - (attributes.width / 2.0 - attributes.sidewalk)).abs() < 1e-9);
        }
    }
}

#[test]
fn kerbs_of_medians_go_around_them() {
    for seed in [1, 2, 3] {
        let network = grown(seed, 150, Constraints::default(), Obstacles::default());
        let surfaces = network.surfaces(SurfaceOptions::default(), &StreetProfiles::default());
        for median in &surfaces.medians {
            let wide = network.attributes(median.top.piece.expect("a piece")).median;
            for line in &median.kerbs {
                assert!(line.len() > 1);
                for pair in line.windows(2) {
                    // The top is on the left of each part of the kerb.
                    let on_left = (pair[1] - pair[0]).truncate().perp().normalize() * (wide / 4.0);
                    let inside = (pair[0] + pair[1]).truncate() / 2.0 + on_left;
                    let is_in = median.top.triangles.iter().any(|corners| {
                        let corners = corners.map(|corner| median.top.points[corner as usize].truncate());
                        (0..3).all(|at| {
                            (corners[(at + 1) % 3] - corners[at]).perp_dot(inside - corners[at]) > -1e-9
                        })
                    });
                    assert!(is_in, "{pair:?}");
                }
            }
        }
    }
}

/// Returns the position (m) of a point along a segment, and its distance (m) to the left.
fn on_piece(network: &StreetNetwork, piece: PieceId, place: DVec2) -> DVec2 {
    let [a, b] = network.line(piece);
    let way = (b - a).normalize();
    DVec2::new(way.dot(place - a), way.perp_dot(place - a))
}

#[test]
fn markings_lie_on_carriageways_and_never_on_one_another() {
    let mut count = 0;
    for seed in 1..=24 {
        let network = grown(seed, 100, Constraints::default(), Obstacles::default());
        let mut kinds = kinds(seed);
        if seed % 3 == 0 {
            kinds[0].parking = 2.2;
            kinds[0].lanes = Some(2);
        }
        let flat = StreetProfiles::default();
        let markings = network.markings(SurfaceOptions::default(), &flat, &kinds);
        let surfaces = network.surfaces(SurfaceOptions::default(), &flat);
        count += markings.len();
        let mut by_piece: BTreeMap<PieceId, Vec<[DVec2; 2]>> = BTreeMap::new();
        for Marking { corners, piece } in markings {
            assert!(twice_area(corners) > 1e-3, "{corners:?}");
            let middle = corners.iter().map(|at| at.truncate()).sum::<DVec2>() / 4.0;
            let corners = corners.map(|at| on_piece(&network, piece, at.truncate()));
            let (low, high) = corners
                .iter()
                .fold((DVec2::MAX, DVec2::MIN), |(low, high), at| (low.min(*at), high.max(*at)));
            by_piece.entry(piece).or_default().push([low, high]);
            let half = network.attributes(piece).carriageway() / 2.0;
            assert!(low.y >= -half && high.y <= half, "{low} {high}");
            // No marking overlaps a junction or a median.
            let is_in = |surface: &StreetSurface| {
                surface.triangles.iter().any(|corners| {
                    let corners = corners.map(|corner| surface.points[corner as usize].truncate());
                    (0..3).all(|at| {
                        (corners[(at + 1) % 3] - corners[at]).perp_dot(middle - corners[at]) > -1e-6
                    })
                })
            };
            let own = surfaces.carriageways.iter().filter(|part| part.piece == Some(piece));
            assert!(
                own.into_iter().any(is_in),
                "seed {seed}: {corners:?} is not on the carriageway of {piece}"
            );
        }
        for boxes in by_piece.values() {
            for (index, a) in boxes.iter().enumerate() {
                for b in &boxes[..index] {
                    let apart = a[0].x >= b[1].x - 1e-6
                        || b[0].x >= a[1].x - 1e-6
                        || a[0].y >= b[1].y - 1e-6
                        || b[0].y >= a[1].y - 1e-6;
                    assert!(apart, "seed {seed}: {a:?} and {b:?}");
                }
            }
        }
    }
    assert!(count > 20_000, "{count} markings");
}
