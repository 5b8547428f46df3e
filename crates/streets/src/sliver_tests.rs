//! Tests of the surfaces of random networks with all constraints: no slivers, and no gaps between surfaces.

use glam::{DVec2, DVec3};

use super::*;
use crate::fit_tests::hills;
use crate::surface_tests::check_surfaces;
use crate::tests::TestNumbers;

/// Minimum size of a drawn face: area (m²), height over the longest edge (m), and shortest edge (m).
const LEAST: [f64; 3] = [1e-8, 1e-3, 1e-3];

/// Returns a network of stars whose arms turn, change their widths, and meet others.
///
/// About half of the angles are nearly those of a grid: streets meant to be straight or perpendicular are so only up to
/// the grid resolution, and their corners end at almost the same point.
fn stars(seed: u64) -> StreetNetwork {
    let mut random = TestNumbers(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) + 11);
    let mut pick = |of: &[f64]| of[random.below(of.len() as f64) as usize];
    let constraints = Constraints {
        snap: pick(&[0.0, 3.0, 25.0]),
        min_angle: pick(&[10.0, 30.0, 45.0]),
        min_length: pick(&[1.0, 12.0]),
        clearance: pick(&[0.5, 3.0]),
        corner: pick(&[0.0, 0.004, 0.03, 1.0, 4.0, 12.0]),
        ..Constraints::default()
    };
    let widths = [pick(&[5.0, 11.0, 18.0]), pick(&[8.0, 16.0]), pick(&[6.0, 24.0])];
    let kinds = widths.map(|width| StreetAttributes {
        width,
        sidewalk: width * pick(&[0.0, 0.1, 0.25]),
        median: if width > 10.0 { pick(&[0.0, 0.0, width * 0.1]) } else { 0.0 },
        ..StreetAttributes::default()
    });
    let mut network = StreetNetwork::new(constraints, Obstacles::default()).expect("constraints");
    let near = |random: &mut TestNumbers| {
        // From zero to a few degrees, uniform in the logarithm.
        if random.below(1.0) < 0.2 {
            0.0
        } else {
            (random.below(2.0) - 1.0) * 10_f64.powf(-random.below(7.0)) * 8.0
        }
    };
    for _ in 0..1 + random.below(4.0) as u32 {
        let middle = DVec2::new(random.below(240.0) - 120.0, random.below(240.0) - 120.0);
        let Ok(start) = network.begin(middle) else { continue };
        let arms = 2 + random.below(5.0) as u32;
        let step = [360.0 / f64::from(arms), 45.0, 60.0, 90.0][random.below(4.0) as usize];
        let first = random.below(360.0);
        for arm in 0..arms {
            let even = random.below(1.0) < 0.6;
            let mut heading =
                if even { first + f64::from(arm) * step + near(&mut random) } else { random.below(360.0) };
            let mut from = start;
            let mut kind = kinds[random.below(3.0) as usize];
            for _ in 0..1 + random.below(4.0) as u32 {
                let length = if random.below(1.0) < 0.4 {
                    3.0 + random.below(25.0)
                } else {
                    20.0 + random.below(80.0)
                };
                let to = network.at(from) + DVec2::from_angle(heading.to_radians()) * length;
                let growth = network.grow(from, to, kind).expect("room");
                if matches!(growth.fate, Fate::Refused(_)) {
                    break;
                }
                from = growth.end;
                if random.below(1.0) < 0.4 {
                    kind = kinds[random.below(3.0) as usize];
                }
                heading += match random.below(4.0) as u32 {
                    0 => near(&mut random),
                    1 => random.below(240.0) - 120.0,
                    2 => random.below(60.0) - 30.0,
                    _ => [30.0, 45.0, 90.0, -90.0][random.below(4.0) as usize] + near(&mut random),
                };
            }
        }
    }
    let _ = match random.below(4.0) as u32 {
        0 => network.join_dead_ends(DeadEndOptions::default()),
        1 => network.remove_dead_ends(),
        _ => 0,
    };
    network
}

/// Returns the drawn faces of surfaces (m): carriageways, medians, and sidewalks.
fn faces(surfaces: &StreetSurfaces) -> Vec<(&'static str, [DVec3; 3])> {
    let mut faces = Vec::new();
    let tops = surfaces.medians.iter().map(|median| ("median", &median.top));
    let carriageways = surfaces
        .carriageways
        .iter()
        .map(|surface| (if surface.piece.is_some() { "piece" } else { "junction" }, surface));
    for (name, surface) in carriageways.chain(tops) {
        faces.extend(
            surface.triangles.iter().map(|face| (name, face.map(|corner| surface.points[corner as usize]))),
        );
    }
    for walk in &surfaces.sidewalks {
        let next = |line: &[DVec3], index: usize| line[(index + 1) % line.len()];
        for index in 0..walk.kerb.len() {
            let [a, b] = [walk.kerb[index], next(&walk.kerb, index)];
            let [d, c] = [walk.edge[index], next(&walk.edge, index)];
            for face in [[a, b, c], [a, c, d]] {
                if face[0] != face[1] && face[1] != face[2] && face[2] != face[0] {
                    faces.push(("sidewalk", face));
                }
            }
        }
    }
    faces
}

/// Returns the area (m²) of a face, its height over its longest edge (m), and its shortest edge (m).
fn figures([a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let edges = [a.distance(b), b.distance(c), c.distance(a)];
    let area = (b - a).cross(c - a).length() / 2.0;
    let longest = edges.into_iter().fold(0.0, f64::max);
    [area, 2.0 * area / longest, edges.into_iter().fold(f64::INFINITY, f64::min)]
}

#[test]
fn no_face_of_a_street_is_a_sliver_and_nothing_between_them_is_open() {
    let (mut pieces, mut all) = (0, 0);
    for seed in 1..=500 {
        let network = stars(seed);
        let options = SurfaceOptions { turning: [0.0, 6.0, 14.0][seed as usize % 3] };
        let profiles = if seed % 2 == 0 {
            StreetProfiles::default()
        } else {
            let slopes = SlopeOptions { max_slope: 0.1, least: [None; 2] };
            network.lay(options, slopes, hills(seed, 0.4)).expect("ground").profiles
        };
        check_surfaces(&network, options, &profiles);
        let faces = faces(&network.surfaces(options, &profiles));
        for (name, face) in &faces {
            let found = figures(*face);
            let is_sliver = !found.iter().zip(LEAST).all(|(found, least)| *found >= least);
            assert!(!is_sliver, "seed {seed}: {name} {face:?}: {found:?}");
        }
        (pieces, all) = (pieces + network.size(), all + faces.len());
    }
    assert!(pieces > 4000 && all > 200_000, "{pieces} pieces, {all} faces");
}
