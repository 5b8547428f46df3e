//! Tests of how thin triangles of roofs are: none is thinner than 0.1 mm.

use super::super::skeleton::samples::{Random, mixed};
use super::super::skeleton::tests::plan;
use super::super::solid;
use super::tests::{BENT, HEIGHT, building};
use super::*;
use burgeon_scene::Part;

/// Triangles are at least so wide (m).
const WIDE: f64 = 1e-4;

/// How wide the thinnest triangle of a roof is (m).
fn thinnest(cover: &RoofCover) -> f64 {
    let mut part = Part::default();
    for patch in &cover.patches {
        fill(&mut part, &patch.rings, patch.along.extend(0.0), patch.rings[0][0]).expect("a flat face");
    }
    let width = |corners: [u32; 3]| {
        let [a, b, c] = corners.map(|corner| part.positions[corner as usize].as_dvec3());
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        (b - a).cross(c - a).length() / longest
    };
    part.triangles.iter().map(width).fold(f64::INFINITY, f64::min)
}

/// Plans of a seed whose roofs have had corners in the middle of a border of the same face, spikes at a level, or corners
/// of a face almost in one line; and one of each 90 plans, or more of them: `BURGEON_CASES=90 cargo test --release sliver`.
fn faults(seed: u64, known: &[usize]) -> (usize, Vec<String>) {
    let times: usize = std::env::var("BURGEON_CASES").ok().and_then(|times| times.parse().ok()).unwrap_or(1);
    let border = Border { height: 0.5, width: 0.3 };
    let surfaces = [
        RoofSurface::Flat(Some(border)),
        RoofSurface::Sloped(Ends::Hips, &[]),
        RoofSurface::Sloped(Ends::Hips, BENT),
        RoofSurface::Sloped(Ends::Hips, &[(0.25, 0.7)]),
        RoofSurface::Sloped(Ends::Gables, &[]),
        RoofSurface::Sloped(Ends::Gables, BENT),
        RoofSurface::Sloped(Ends::DutchHips, &[]),
    ];
    let eaves = [(Eaves::Closed, 0.0), (Eaves::Slab, 0.2), (Eaves::Open, 0.15)];
    let mut random = Random(seed);
    let (mut count, mut faults) = (0, Vec::new());
    for round in 0..9000 {
        let rings = mixed(round, &mut random);
        let chosen = round % (90 / times.clamp(1, 90)) == 0 || known.contains(&round);
        let Some(walls) = Some(rings).filter(|_| chosen).and_then(|rings| plan(&rings)) else { continue };
        let (overhang, (eaves, slab)) = ([0.0, 0.3, 0.8][round / 8 % 3], eaves[round / 24 % 3]);
        for surface in surfaces {
            let thin = matches!(surface, RoofSurface::Flat(_)) && overhang > 0.0;
            let slab = if thin { 0.15 } else { slab };
            let shape = RoofShape { surface, rise: Rise::Slope(0.7), overhang, eaves, slab };
            let cover = shape.cover(&walls, HEIGHT).unwrap_or_else(|error| panic!("{round}: {error}"));
            let (check, width) = (solid::check([&building(&walls, &cover)]), thinnest(&cover));
            if !check.is_solid() || width < WIDE {
                faults.push(format!("{round}: {width} m {shape:?} {check:?}"));
            }
            count += 1;
        }
    }
    (count, faults)
}

#[test]
fn no_triangle_of_a_roof_is_thinner_than_a_tenth_of_a_millimetre() {
    for (seed, known) in [
        (11, &[469, 1558, 2620, 3658, 4078, 4237, 5038, 6043, 6757, 7117, 8842][..]),
        (23, &[463, 733, 1093, 1333, 1933, 2143, 2362, 2623, 3742, 3943, 4747, 5755, 6973, 7702, 8053, 8914]),
    ] {
        let (count, faults) = faults(seed, known);
        assert!(
            faults.is_empty(),
            "{} of {count} with {seed}: {:#?}",
            faults.len(),
            &faults[..faults.len().min(4)]
        );
        assert!(count >= 700, "{count}");
    }
}
