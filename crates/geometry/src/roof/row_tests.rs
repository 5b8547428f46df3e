//! Tests of roofs next to neighbours, in rows whose walls bend slightly or step, and of roofs over projecting
//! storeys.

use super::super::skeleton::samples::{Random, mixed};
use super::super::skeleton::tests::plan;
use super::super::solid;
use super::super::{Plan, Polygon, Rings};
use super::tests::{HEIGHT, around, building};
use super::*;
use crate::planar::Ring;
use glam::{DVec2, DVec3};

const SURFACES: [RoofSurface; 5] = [
    RoofSurface::Sloped(Ends::Hips, &[]),
    RoofSurface::Sloped(Ends::Gables, &[]),
    RoofSurface::Sloped(Ends::Hips, &[(0.25, 0.7)]),
    RoofSurface::Sloped(Ends::DutchHips, &[]),
    RoofSurface::Shed,
];
const EAVES: [(Eaves, f64); 3] = [(Eaves::Open, 0.15), (Eaves::Closed, 0.0), (Eaves::Slab, 0.2)];

/// Returns `least` rounds, multiplied by `BURGEON_CASES` if it is set: `BURGEON_CASES=10 cargo test --release
/// --lib roof`.
fn rounds(least: usize) -> std::ops::Range<usize> {
    let times = std::env::var("BURGEON_CASES").ok().and_then(|times| times.parse().ok()).unwrap_or(1);
    0..least * times
}

/// A plan next to others, and its edges along them.
struct TerraceHouse {
    walls: Polygon,
    party: Vec<usize>,
    reach: Vec<f64>,
}

/// Returns points from one end of a party wall to the other: straight, with slight bends, or with steps.
fn side(random: &mut Random, from: DVec2, to: DVec2) -> Vec<DVec2> {
    let (way, across) = (to - from, (to - from).normalize_or_zero().perp());
    let mut points = vec![from];
    match (random.next() * 4.0) as u32 {
        0 => {}
        1 => points.push(from + way * (0.2 + 0.6 * random.next()) + across * (random.next() - 0.5) * 0.3),
        2 => {
            for part in [0.3, 0.6] {
                points.push(from + way * (part + 0.2 * random.next()) + across * (random.next() - 0.5) * 0.2);
            }
        }
        _ => {
            let (part, step) = (0.25 + 0.5 * random.next(), (random.next() - 0.5) * 3.0);
            points.extend([from + way * part, from + way * part + across * step, to + across * step]);
            return points;
        }
    }
    points.push(to);
    points
}

/// Returns a house of a row, with party walls to its right and to its left.
fn house(random: &mut Random) -> Option<TerraceHouse> {
    let (width, depth) = (4.0 + 8.0 * random.next(), 6.0 + 8.0 * random.next());
    let lean = (random.next() - 0.5) * 1.5;
    let right = side(random, DVec2::new(width, 0.0), DVec2::new(width + lean, depth));
    let longer = random.next();
    let mut left = side(random, DVec2::new(0.0, 0.0), DVec2::new(lean, depth + longer));
    left.reverse();
    let turn = DVec2::from_angle(6.3 * random.next());
    let ring: Vec<DVec2> = right.iter().chain(&left).map(|at| turn.rotate(*at)).collect();
    let given: Vec<usize> = (0..right.len() - 1).chain(right.len()..ring.len() - 1).collect();
    // In some houses one segment of a party wall is free.
    let free = if random.next() < 0.3 { (random.next() * given.len() as f64) as usize } else { usize::MAX };
    let plan = Plan::new(&Rings(vec![ring.iter().map(|at| at.extend(0.0)).collect()])).ok()?;
    let stands = plan.given_edges();
    let is_party = |edges: &[usize]| {
        edges.iter().any(|edge| given.iter().enumerate().any(|(index, known)| known == edge && index != free))
    };
    let blind: Vec<bool> = stands.iter().map(|edges| is_party(edges)).collect();
    let party: Vec<usize> = (0..blind.len()).filter(|&edge| blind[edge]).collect();
    let reach = blind.iter().map(|&blind| if blind { 0.0 } else { f64::INFINITY }).collect();
    (plan.repairs().0.is_empty()).then(|| TerraceHouse { walls: plan.flat(), party, reach })
}

/// Describes the defects of a building that must be one closed solid without self-intersections.
fn fault(cover: &RoofCover, walls: &Polygon) -> Option<String> {
    let part = building(walls, cover);
    let (check, clashes) = (solid::check([&part]), solid::clashes([&part], 2e-3));
    let sound = check.is_solid() && clashes.is_empty();
    (!sound).then(|| format!("{check:?} {clashes:?} {walls:?}"))
}

/// Returns the horizontal area (m²) that a roof covers.
fn covered(cover: &RoofCover) -> f64 {
    let rings =
        cover.patches.iter().filter(|patch| patch.kind == PatchKind::Slope).flat_map(|patch| &patch.rings);
    rings.map(Ring::area).sum()
}

#[test]
fn roofs_in_rows_with_bent_and_stepped_party_walls_never_meet_themselves() {
    let mut random = Random(23);
    let (mut count, mut full, mut gabled, mut faults) = (0, 0, 0, Vec::new());
    for round in rounds(900) {
        let Some(TerraceHouse { walls, party, reach }) = house(&mut random) else { continue };
        let (surface, (eaves, slab)) = (SURFACES[round % 5], EAVES[round / 5 % 3]);
        let shape = RoofShape {
            surface,
            rise: Rise::Slope(0.7),
            overhang: [0.3, 0.5, 0.8][round / 15 % 3],
            eaves,
            slab,
        };
        let party = if round / 45 % 4 == 0 { &[][..] } else { &party };
        let support = Support { party, reach: &reach, ..Support::new(&walls, HEIGHT) };
        let cover = shape.cover_on(&support).unwrap_or_else(|error| panic!("{round}: {error}"));
        faults.extend(
            fault(&cover, &walls).map(|fault| format!("{round}: {shape:?} {party:?} {reach:?} {fault}")),
        );
        count += 1;
        let front = cover.overhangs.iter().filter(|overhang| **overhang == shape.overhang).count();
        full += usize::from(front >= 1);
        gabled += usize::from(cover.patches.iter().any(|patch| patch.kind == PatchKind::Gable));
        // No overhang over neighbours.
        assert!(cover.overhangs.iter().zip(&reach).all(|(overhang, reach)| overhang <= reach), "{round}");
        let least = walls.area();
        assert!(covered(&cover) > least * (1.0 - 1e-4), "{round}: {} of {least} m²", covered(&cover));
    }
    assert!(faults.is_empty(), "{} of {count}: {:#?}", faults.len(), &faults[..faults.len().min(4)]);
    assert!(count > 800 && full * 10 > count * 9 && gabled > count / 2, "{count}: {full} full, {gabled}");
}

#[test]
fn roofs_over_random_plans_between_neighbours_never_meet_themselves() {
    let mut random = Random(31);
    let (mut count, mut juts_out, mut faults) = (0, 0, Vec::new());
    for round in rounds(1200) {
        let Some(walls) = plan(&mixed(round, &mut random)) else { continue };
        let (surface, (eaves, slab)) = (SURFACES[round % 5], EAVES[round / 5 % 3]);
        let overhang = [0.3, 0.5, 0.8][round / 15 % 3];
        let shape = RoofShape { surface, rise: Rise::Slope(0.7), overhang, eaves, slab };
        let edges = walls.size();
        let near = |random: &mut Random| match (random.next() * 6.0) as u32 {
            0 => 0.0,
            1 => 0.4 * random.next(),
            _ => f64::INFINITY,
        };
        let reach: Vec<f64> = (0..edges).map(|_| near(&mut random)).collect();
        let party: Vec<usize> = (0..edges).filter(|&edge| reach[edge] == 0.0 && round % 2 == 0).collect();
        let support = Support { party: &party, reach: &reach, ..Support::new(&walls, HEIGHT) };
        let cover = shape.cover_on(&support).unwrap_or_else(|error| panic!("{round}: {error}"));
        faults.extend(
            fault(&cover, &walls).map(|fault| format!("{round}: {shape:?} {party:?} {reach:?} {fault}")),
        );
        count += 1;
        juts_out += usize::from(cover.overhangs.iter().any(|by| *by > 0.0));
    }
    assert!(faults.is_empty(), "{} of {count}: {:#?}", faults.len(), &faults[..faults.len().min(4)]);
    assert!(count > 1000 && juts_out * 4 > count * 3, "{count}, {juts_out} jut out");
}

/// Returns a rectangle with narrow notches, its full roof area, and the area that the notches may remove from
/// a roof with a maximum `overhang` (m²).
fn notched(random: &mut Random, overhang: f64) -> (Vec<DVec2>, f64, f64) {
    let (width, depth) = (8.0 + 20.0 * random.next(), 7.0 + 10.0 * random.next());
    let corners = [(0.0, 0.0), (width, 0.0), (width, depth), (0.0, depth)].map(DVec2::from);
    let (mut ring, mut taken) = (Vec::new(), 0.0);
    for (index, &from) in corners.iter().enumerate() {
        let to = corners[(index + 1) % 4];
        let (way, length) = ((to - from).normalize_or_zero(), from.distance(to));
        ring.push(from);
        if index == 0 || random.next() < 0.3 {
            let (wide, deep) = (0.05 + 0.7 * random.next(), 0.3 + 2.0 * random.next());
            let at = from + way * (1.5 + (length - 4.0) * random.next());
            let inward = way.perp() * deep;
            ring.extend([at, at + inward, at + way * wide + inward, at + way * wide]);
            taken += wide * (deep + overhang);
        }
    }
    let full = (width + 2.0 * overhang) * (depth + 2.0 * overhang);
    let turn = DVec2::from_angle(6.3 * random.next());
    (ring.into_iter().map(|at| turn.rotate(at)).collect(), full, taken)
}

#[test]
fn a_narrow_notch_takes_the_overhang_of_its_own_edges_only() {
    let mut random = Random(41);
    let surfaces = [SURFACES[0], SURFACES[2], RoofSurface::Flat(None)];
    let mut faults = Vec::new();
    for round in rounds(600) {
        let overhang = [0.2, 0.4, 0.6, 0.9][round % 4];
        let (ring, full, taken) = notched(&mut random, overhang);
        let walls = Polygon::new(vec![ring]).expect("a polygon");
        let (surface, (eaves, slab)) = (surfaces[round / 4 % 3], EAVES[round / 12 % 3]);
        let slab = if round / 4 % 3 == 2 { 0.15 } else { slab };
        let shape = RoofShape { surface, rise: Rise::Slope(0.7), overhang, eaves, slab };
        let cover = shape.cover(&walls, HEIGHT).unwrap_or_else(|error| panic!("{round}: {error}"));
        faults.extend(fault(&cover, &walls).map(|fault| format!("{round}: {shape:?} {fault}")));
        let covered = covered(&cover);
        assert!(
            covered > full - taken - 1e-3,
            "{round}: {covered} of {full} m² {walls:?} {:?}",
            cover.overhangs
        );
        assert!(cover.tight.len() <= 3 * (walls[0].len() - 4) / 4, "{round}: {:?}", cover.tight);
    }
    assert!(faults.is_empty(), "{}: {:#?}", faults.len(), &faults[..faults.len().min(4)]);
}

#[test]
fn a_roof_begins_where_the_outermost_storey_ends() {
    let mut random = Random(53);
    let (mut count, mut faults) = (0, Vec::new());
    for round in rounds(900) {
        let Some(walls) = plan(&mixed(round, &mut random)) else { continue };
        let (surface, (eaves, slab)) = (SURFACES[round % 5], EAVES[round / 5 % 3]);
        let shape = RoofShape { surface, rise: Rise::Slope(0.7), overhang: 0.4, eaves, slab };
        let edges: usize = walls.size();
        let even = round % 2 == 0;
        let juts: Vec<f64> = (0..edges)
            .map(|_| if even { 0.5 } else { [0.0, 0.3, 0.5][(random.next() * 3.0) as usize] })
            .collect();
        let support = Support { juts: &juts, ..Support::new(&walls, HEIGHT) };
        let cover = shape.cover_on(&support).unwrap_or_else(|error| panic!("{round}: {error}"));
        faults.extend(fault(&cover, &walls).map(|fault| format!("{round}: {shape:?} {juts:?} {fault}")));
        count += 1;
    }
    assert!(faults.is_empty(), "{} of {count}: {:#?}", faults.len(), &faults[..faults.len().min(4)]);
    let walls = around(&[(0., 0.), (10., 0.), (10., 6.), (0., 6.)]);
    for (surface, (eaves, slab)) in
        SURFACES.into_iter().flat_map(|surface| EAVES.map(|eaves| (surface, eaves)))
    {
        let shape = RoofShape { surface, rise: Rise::Slope(0.7), overhang: 0.4, eaves, slab };
        let cover =
            shape.cover_on(&Support { juts: &[0.5; 4], ..Support::new(&walls, HEIGHT) }).expect("a roof");
        let over = DVec2::new(10.0, 6.0) + 2.0 * DVec2::splat(0.5);
        let points = || cover.patches.iter().flat_map(|patch| &patch.rings).flatten();
        let is_out =
            |at: &&DVec3| (at.truncate() - DVec2::new(5.0, 3.0)).abs().cmpgt(over / 2.0 + 1e-6).any();
        // Projecting parts are below the roof, and the overhang is beyond them.
        assert!(points().filter(|at| at.z < HEIGHT - 1e-6).all(|at| is_out(&at)), "{shape:?}");
        let furthest = points().map(|at| (at.y - 3.0).abs()).fold(0.0, f64::max);
        assert!((furthest - 3.9).abs() < 1e-9, "{shape:?}: {furthest} m");
    }
}
