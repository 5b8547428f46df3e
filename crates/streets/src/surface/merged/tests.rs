//! Tests of the surfaces of existing streets: adjacent surfaces share their edges even if streets overlap or run side
//! by side.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec2;

use crate::existing::tests::{network, town};
use crate::plan::merge_cache::{MergeOptions, MergedLevel};
use crate::{StreetProfiles, SurfaceOptions};
use burgeon_geometry::planar::twice_area;

const OPTIONS: MergeOptions = MergeOptions { turning: 0.0, longest: f64::INFINITY };

/// Returns a description of the first error in the surfaces of a level, if any.
fn fault(level: &MergedLevel) -> Option<String> {
    let of_streets = level.carriageways.iter().flat_map(|(_, triangles)| triangles).chain(&level.walks);
    let all: Vec<[u32; 3]> =
        of_streets.chain(level.blocks.iter().flat_map(|block| &block.triangles)).copied().collect();
    let mut sides = BTreeSet::new();
    for corners in &all {
        if twice_area(corners.map(|corner| level.points[corner as usize])) <= 0.0 {
            return Some(format!("a triangle has no area: {corners:?}"));
        }
        for side in 0..3 {
            if !sides.insert([corners[side], corners[(side + 1) % 3]]) {
                return Some("two triangles lie on one another".into());
            }
        }
    }
    // An edge without an adjacent triangle is on the outer border of the streets.
    let edges: BTreeSet<[u32; 2]> = level.edges.iter().copied().collect();
    let mut ways: BTreeMap<u32, i32> = BTreeMap::new();
    for [a, b] in sides.iter().filter(|[a, b]| !sides.contains(&[*b, *a])) {
        if !edges.contains(&[*b, *a]) {
            return Some("an edge of a street is open".into());
        }
        *ways.entry(*a).or_default() += 1;
        *ways.entry(*b).or_default() -= 1;
    }
    ways.values().any(|sum| *sum != 0).then(|| "the outline is not closed".into())
}

#[test]
fn surfaces_of_every_kind_of_street_meet_edge_to_edge() {
    let mut blocks = 0;
    for seed in 0..60 {
        let streets = town(seed);
        let mut network = network();
        network.add_existing(&streets).expect("room");
        let merged = network.merge_levels(OPTIONS).expect("existing streets");
        for level in &merged.levels {
            assert_eq!(fault(level), None, "seed {seed}, level {}", level.level);
        }
        // The centres of streets are carriageways.
        for (piece, known) in
            network.pieces().filter(|(id, piece)| piece.attributes.level == 0 && id % 7 == 0)
        {
            let [a, b] = network.line(piece);
            let at = a.midpoint(b);
            let ground = &merged.levels[0];
            let covered = ground.carriageways.iter().flat_map(|(_, triangles)| triangles).any(|corners| {
                let corners = corners.map(|corner| ground.points[corner as usize]);
                (0..3).all(|side| {
                    (corners[(side + 1) % 3] - corners[side]).perp_dot(at - corners[side]) >= -1e-6
                })
            });
            assert!(covered, "seed {seed}: {at} of {:?}", known.attributes);
        }
        for block in network.lot_blocks(SurfaceOptions::default()) {
            let area: f64 = block.rings.iter().map(|ring| twice_area(ring.iter().copied()) / 2.0).sum();
            let around: f64 = block
                .rings
                .iter()
                .flat_map(|ring| burgeon_geometry::planar::edges(ring))
                .map(|[a, b]| a.distance(b))
                .sum();
            assert!(area > 10.0 && 2.0 * area / around > 1.2, "seed {seed}: a sliver of {area} m²");
            blocks += 1;
        }
        let surfaces = network.surfaces(SurfaceOptions::default(), &StreetProfiles::default());
        assert!(!surfaces.carriageways.is_empty() && surfaces.sidewalks.is_empty());
    }
    assert!(blocks > 50, "{blocks} blocks");
}

#[test]
fn what_is_free_of_a_piece_lies_between_the_streets_that_cross_it() {
    use crate::existing::tests::street;
    let at = |places: &[(f64, f64)]| -> Vec<DVec2> { places.iter().copied().map(DVec2::from).collect() };
    let mut network = network();
    let streets = [
        street(&at(&[(0.0, 0.0), (100.0, 0.0)]), 10.0, 0),
        street(&at(&[(100.0, -50.0), (100.0, 50.0)]), 20.0, 0),
    ];
    network.add_existing(&streets).expect("room");
    let piece =
        network.pieces().map(|(id, _)| id).find(|id| network.length(*id) == 100.0).expect("the first");
    let clear = network.clear_lengths()[piece as usize];
    assert!(clear[0].abs() < 1e-9 && (clear[1] - 10.0).abs() <= 1.0, "{clear:?}");
}
