//! Tests of mapped roofs: they close their walls, have the volumes of the same roofs by kind, and name lines that are left out.

use glam::{DVec2, DVec3};

use super::super::tests::{HEIGHT, around, building};
use super::super::{Eaves, Ends, Rise, RoofCover, RoofLineKind, RoofShape, RoofSurface, Support, lines};
use super::{MapLineKind, MapProblem, RoofMap};
use crate::planar::Polygon;
use crate::skeleton::samples::{Random, mixed};
use crate::skeleton::tests::plan;
use crate::skeleton::{Pace, Skeleton};
use crate::solid;

const BOX: [(f64, f64); 4] = [(0., 0.), (12., 0.), (12., 8.), (0., 8.)];

fn shape(overhang: f64) -> RoofShape {
    let slab = if overhang > 0.0 { 0.15 } else { 0.0 };
    RoofShape {
        surface: RoofSurface::Sloped(Ends::Hips, &[]),
        rise: Rise::Height(4.0),
        overhang,
        eaves: Eaves::Open,
        slab,
    }
}

fn line(points: &[(f64, f64)]) -> Vec<DVec3> {
    points.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect()
}

/// Returns the roof over walls, which closes them, and its volume (m³).
fn cover(walls: &Polygon, map: &RoofMap, shape: &RoofShape) -> (RoofCover, f64) {
    let support = Support { map: Some(map), ..Support::new(walls, HEIGHT) };
    let cover = shape.cover_on(&support).expect("a roof");
    let part = building(walls, &cover);
    let check = solid::check([&part]);
    assert!(check.is_solid(), "{check:?} {map:?} {walls:?}");
    let volume = solid::volume([&part]) - walls.area() * HEIGHT;
    (cover, volume)
}

#[test]
fn a_ridge_between_two_walls_has_gables_and_a_shorter_one_has_hips() {
    let walls = around(&BOX);
    for (ridge, share, gables, hips) in
        [(line(&[(0., 4.), (12., 4.)]), 0.5, 2, 0), (line(&[(4., 4.), (8., 4.)]), 0.5 - 8.0 / 72.0, 0, 4)]
    {
        let map = RoofMap { ridges: vec![ridge], ..RoofMap::default() };
        let (cover, volume) = cover(&walls, &map, &shape(0.0));
        assert!((volume - 12.0 * 8.0 * 4.0 * share).abs() < 1e-6, "{volume} m³");
        assert!(cover.unused.is_empty());
        let count =
            |kind: RoofLineKind| lines(&cover.patches).iter().filter(|line| line.kind == kind).count();
        assert_eq!(
            [RoofLineKind::Ridge, RoofLineKind::Hip, RoofLineKind::Eaves].map(count),
            [1, hips, 4 - gables]
        );
    }
}

#[test]
fn ends_near_the_outline_are_on_it_and_overhangs_are_plates_of_one_thickness() {
    let walls = around(&BOX);
    let map = RoofMap { ridges: vec![line(&[(-0.03, 4.), (12.02, 4.)])], ..RoofMap::default() };
    let low = RoofShape { rise: Rise::Height(2.0), ..shape(0.5) };
    let (cover, volume) = cover(&walls, &map, &low);
    assert!((volume - 12.0 * 8.0 - 13.0 * 9.0 * 0.15).abs() < 1e-2 && cover.unused.is_empty(), "{volume} m³");
}

#[test]
fn valleys_and_hips_of_a_corner_are_edges_between_ridges_and_outline() {
    let walls = around(&[(0., 0.), (12., 0.), (12., 6.), (6., 6.), (6., 12.), (0., 12.)]);
    let map = RoofMap {
        ridges: vec![line(&[(3., 12.), (3., 3.), (12., 3.)])],
        edges: vec![line(&[(0., 0.), (3., 3.)]), line(&[(6., 6.), (3., 3.)])],
        apexes: Vec::new(),
    };
    for overhang in [0.0, 0.4] {
        let low = RoofShape { rise: Rise::Height(2.0), ..shape(overhang) };
        let (cover, volume) = cover(&walls, &map, &low);
        let count =
            |kind: RoofLineKind| lines(&cover.patches).iter().filter(|line| line.kind == kind).count();
        assert_eq!([RoofLineKind::Ridge, RoofLineKind::Hip, RoofLineKind::Valley].map(count), [2, 1, 1]);
        // Two gable roofs of 6 by 12 m less the square at the corner, where their lowest parts count.
        let expected = 2.0 * 6.0 * 6.0 * 1.0 + 36.0 * 2.0 / 2.0;
        assert!(overhang > 0.0 || (volume - expected).abs() < 1e-6, "{volume} m³, not {expected} m³");
    }
}

#[test]
fn heights_of_points_win_over_that_of_the_roof() {
    let walls = around(&BOX);
    let ridge = vec![DVec3::new(0., 4., 2.), DVec3::new(12., 4., 6.)];
    let map = RoofMap { ridges: vec![ridge], ..RoofMap::default() };
    let (cover, volume) = cover(&walls, &map, &shape(0.0));
    let top =
        cover.patches.iter().flat_map(|patch| &patch.rings).flatten().map(|at| at.z).fold(0.0, f64::max);
    assert!((top - HEIGHT - 6.0).abs() < 1e-9 && (159.0..225.0).contains(&volume), "{top} m, {volume} m³");
    let apex = RoofMap { apexes: vec![DVec3::new(6., 4., 0.)], ..RoofMap::default() };
    let (_, volume) = self::cover(&walls, &apex, &shape(0.0));
    assert!((volume - 12.0 * 8.0 * 4.0 / 3.0).abs() < 1e-6, "{volume} m³");
}

#[test]
fn lines_that_cannot_be_used_are_named_with_their_place() {
    let walls = around(&BOX);
    let map = RoofMap {
        ridges: vec![line(&[(2., 4.), (10., 4.)]), line(&[(6., 1.), (6., 7.)]), line(&[(3., 3.), (3., 20.)])],
        edges: vec![line(&[(5., 2.)]), line(&[(7., 1.), (8., 2.)]), vec![DVec3::new(1., 1., -2.); 2]],
        apexes: vec![DVec3::new(40., 4., 0.), DVec3::new(2., 4., 3.)],
    };
    let (cover, _) = cover(&walls, &map, &shape(0.0));
    let found: Vec<(MapLineKind, usize, MapProblem)> =
        cover.unused.iter().map(|line| (line.kind, line.number, line.problem)).collect();
    assert_eq!(
        found,
        [
            (MapLineKind::Ridge, 2, MapProblem::Crossing),
            (MapLineKind::Ridge, 3, MapProblem::Outside),
            (MapLineKind::Edge, 1, MapProblem::Empty),
            (MapLineKind::Edge, 2, MapProblem::NoHeight),
            (MapLineKind::Edge, 3, MapProblem::BelowEaves),
            (MapLineKind::Apex, 1, MapProblem::Outside),
        ]
    );
    assert!(cover.unused[0].at.distance(DVec2::new(6., 4.)) < 1e-9);
    let text = cover.unused[0].text(DVec2::new(100., 0.));
    assert!(text.contains("ridge 2 crosses another line at (106.00, 4.00)"), "{text}");
}

#[test]
fn a_map_without_usable_lines_leaves_the_kind_of_the_roof() {
    let walls = around(&BOX);
    let map = RoofMap { ridges: vec![line(&[(20., 4.), (30., 4.)])], ..RoofMap::default() };
    let (cover, volume) = cover(&walls, &map, &shape(0.0));
    let hips = shape(0.0).cover(&walls, HEIGHT).expect("a roof");
    assert!(cover.patches == hips.patches && cover.unused.len() == 1 && volume > 0.0);
}

/// Returns the skeleton of a plan as ridges and other edges.
fn map_of(walls: &Polygon, random: &mut Random) -> Option<RoofMap> {
    let skeleton = Skeleton::new(walls, &vec![Pace::default(); walls.size()]).ok()?;
    let mut map = RoofMap::default();
    for face in &skeleton.faces {
        for index in 0..face.len() {
            let ends = [face[index], face[(index + 1) % face.len()]].map(|peak| &skeleton.peaks[peak]);
            if ends[0].at.x > ends[1].at.x || ends[0].at.distance(ends[1].at) < 0.2 || random.next() < 0.1 {
                continue;
            }
            let points: Vec<DVec3> = ends.iter().map(|peak| peak.at.extend(peak.time * 0.8)).collect();
            let lines = if random.next() < 0.5 { &mut map.ridges } else { &mut map.edges };
            lines.push(points);
        }
    }
    Some(map)
}

#[test]
fn skeletons_with_missing_lines_close_random_plans_with_holes() {
    let mut random = Random(41);
    let (mut count, mut mapped) = (0, 0);
    for round in 0..600 {
        let Some(walls) = plan(&mixed(round, &mut random)) else { continue };
        let Some(map) = map_of(&walls, &mut random) else { continue };
        let (cover, volume) = cover(&walls, &map, &shape([0.0, 0.4][round % 2]));
        assert!(volume > -1e-3, "{round}: {volume} m³");
        count += 1;
        mapped += usize::from(cover.unused.len() < map.ridges.len() + map.edges.len());
    }
    assert!(count > 500 && mapped > 450, "{count}, {mapped} with lines");
}

#[test]
fn random_lines_close_random_plans_with_holes() {
    let mut random = Random(43);
    let (mut count, mut mapped) = (0, 0);
    for round in 0..600 {
        let Some(walls) = plan(&mixed(round, &mut random)) else { continue };
        let Some([low, high]) = walls.bounds() else { continue };
        let mut place = || {
            let share = DVec2::new(random.next(), random.next());
            let at = low + (high - low) * share;
            at.extend((random.next() * 3.0).floor() * random.next() * 4.0)
        };
        let mut many = || (0..1 + round % 4).map(|_| (0..2 + round % 3).map(|_| place()).collect()).collect();
        let map = RoofMap { ridges: many(), edges: many(), apexes: many().into_iter().flatten().collect() };
        let (cover, _) = cover(&walls, &map, &shape([0.0, 0.4][round % 2]));
        count += 1;
        mapped += usize::from(cover.unused.len() < map.ridges.len() + map.edges.len() + map.apexes.len());
    }
    assert!(count > 500 && mapped > 400, "{count}, {mapped} with lines");
}
