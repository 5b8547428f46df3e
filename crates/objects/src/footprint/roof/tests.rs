//! Tests of roof replacements and of objects on roofs.

use crate::roofs::RoofDetail;
use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};

use super::*;
use burgeon_base::error::Error;
use burgeon_base::random::Stream;
use burgeon_geometry::roof::{Eaves, Patch, PatchKind, Support};
use burgeon_geometry::roof::{Ends, Rise, RoofCover, RoofShape, RoofSurface, fill, floor};
use burgeon_geometry::{Polygon, Ring, solid};
use burgeon_kit::{Model, Parameter, Value};
use burgeon_scene::{Instance, Material, Mesh, Part, Scene};

const RECTANGLE: [(f64, f64); 4] = [(0., 0.), (12., 0.), (12., 8.), (0., 8.)];

fn around(corners: &[(f64, f64)]) -> Polygon {
    Polygon::new(vec![corners.iter().copied().map(DVec2::from).collect()]).expect("a polygon")
}

fn hip() -> RoofShape {
    RoofShape {
        surface: RoofSurface::Sloped(Ends::Hips, &[]),
        rise: Rise::Slope(0.7),
        overhang: 0.4,
        eaves: Eaves::Closed,
        slab: 0.0,
    }
}

/// Returns a model whose bounding box runs from 0 to `size` (m).
fn model(size: DVec3) -> Arc<Model> {
    let positions = [DVec3::ZERO, size.with_y(0.0).with_z(0.0), size].map(|at| at.as_vec3()).to_vec();
    let part = Part { positions, triangles: vec![[0, 1, 2]].into(), ..Part::default() };
    let mesh = Mesh { parts: vec![part], ..Mesh::default() };
    let instance = Instance {
        mesh: 0,
        transform: DAffine3::IDENTITY,
        name: String::new(),
        feature: None,
        origin: None,
        placement: None,
        meaning: None,
    };
    Arc::new(Model::new(Scene {
        materials: vec![Material::default()],
        meshes: vec![mesh],
        instances: vec![instance],
        ..Scene::default()
    }))
}

fn detail(on: &str) -> RoofDetail {
    RoofDetail { model: Some(model(DVec3::new(2.0, 1.0, 1.0))), on: on.into(), ..RoofDetail::default() }
}

fn patches(ends: Ends) -> Vec<Patch> {
    let shape = RoofShape {
        surface: RoofSurface::Sloped(ends, &[]),
        overhang: 0.0,
        rise: Rise::Height(4.0),
        ..hip()
    };
    shape.cover(&around(&RECTANGLE), 3.0).expect("a roof").patches
}

#[test]
fn a_roof_that_fails_is_replaced_over_a_simpler_outline_then_by_a_deck() {
    // The walls form an L with a corner that is 10 cm off.
    let walls = around(&[(0., 0.), (12., 0.), (12., 5.), (8.5, 5.1), (5., 5.), (5., 12.), (0., 12.)]);
    for (least, what) in [
        (7, None),
        (6, Some("a hip roof over an outline simplified to 0.2 m")),
        (4, Some("a flat roof instead of a hip roof")),
    ] {
        let mut make = |shape: &RoofShape, support: &Support<'_>| {
            let refused = support.walls[0].len() > least && matches!(shape.surface, RoofSurface::Sloped(..));
            if refused { Err(Error::other("too hard")) } else { shape.cover_on(support) }
        };
        let made = replace::cover(&hip(), "hip", &Support::new(&walls, 3.0), &mut make);
        assert_eq!(made.replaced.as_ref().map(|(what, _)| what.as_str()), what);
        assert!(made.replaced.iter().all(|(_, why)| why == "too hard"));
        let check = solid::check([&closed(&walls, &made.cover)]);
        assert!(check.is_solid(), "{what:?}: {check:?}");
    }
}

#[test]
fn what_stands_in_for_a_roof_covers_no_courtyard_and_nothing_beside_the_plan() {
    let mut random = Stream::new(3);
    let mut counts = [0; 2];
    for _ in 0..300 {
        // Wings enclose one to four courtyards, and their corners are off by up to 30 cm.
        let (columns, rows) = (1 + random.below(2), 1 + random.below(2));
        let (wing, court) = (3.0 + 5.0 * random.uniform(), 4.0 + 8.0 * random.uniform());
        let mut off = |x: f64, y: f64| {
            DVec2::new(x, y) + DVec2::new(random.uniform() - 0.5, random.uniform() - 0.5) * 0.6
        };
        let size = |count: usize| wing + count as f64 * (wing + court);
        let (width, depth) = (size(columns), size(rows));
        let mut walls =
            vec![vec![off(0., 0.), off(width / 3., 0.), off(width, 0.), off(width, depth), off(0., depth)]];
        for (column, row) in (0..columns).flat_map(|column| (0..rows).map(move |row| (column, row))) {
            let (x, y) = (size(column), size(row));
            walls.push(vec![off(x, y), off(x, y + court), off(x + court, y + court), off(x + court, y)]);
        }
        let walls = Polygon::new(walls).expect("a polygon");
        // Roofs fail for outlines with as many corners as the plan; every third time, all roofs fail.
        let corners: usize = walls.size();
        let all = random.below(3) == 0;
        let mut make = |shape: &RoofShape, support: &Support<'_>| {
            let many = support.walls.size() >= corners;
            let refused = (many || all) && matches!(shape.surface, RoofSurface::Sloped(..));
            if refused { Err(Error::other("too hard")) } else { shape.cover_on(support) }
        };
        let made = replace::cover(&hip(), "hip", &Support::new(&walls, 3.0), &mut make);
        let what = made.replaced.expect("something in place of the roof").0;
        counts[usize::from(what.starts_with("a flat roof"))] += 1;
        assert!(solid::check([&closed(&walls, &made.cover)]).is_solid(), "{what} {walls:?}");
        for at in made.cover.patches.iter().flat_map(|patch| &patch.rings).flatten() {
            assert!(inside(&walls, at.truncate()), "{what}: {at} {walls:?}");
        }
        // Each courtyard is open to the sky in its middle.
        for court in &walls[1..] {
            let middle = court.iter().sum::<DVec2>() / court.len() as f64;
            let above = made.cover.patches.iter().filter(|patch| patch.kind == PatchKind::Slope);
            for patch in above {
                let rings = patch.rings.iter();
                let around = rings.filter(|ring| ring.contains(middle)).count();
                assert!(around % 2 == 0, "{what}: {walls:?}");
            }
        }
    }
    assert!(counts.iter().all(|count| *count > 50), "{counts:?}");
}

/// Reports whether a position is inside a polygon, or within a millimetre of its edges.
fn inside(polygon: &Polygon, at: DVec2) -> bool {
    let is_near = |[a, b]: [DVec2; 2]| {
        let way = b - a;
        let near = a + way * ((at - a).dot(way) / way.length_squared()).clamp(0.0, 1.0);
        near.distance(at) < 1e-3
    };
    polygon.contains(at) || polygon.edges().any(is_near)
}

fn closed(walls: &Polygon, cover: &RoofCover) -> Part {
    let mut part = Part::default();
    let mut add = |rings: &[Ring<DVec3>]| {
        let right = rings[0][1] - rings[0][0];
        fill(&mut part, rings, right, rings[0][0]).expect("a flat face");
    };
    add(&floor(walls, 0.0));
    for [a, b] in walls.edges() {
        let wall = vec![a.extend(0.0), b.extend(0.0), b.extend(3.0), a.extend(3.0)];
        add(&[Ring::new(wall).expect("a wall")]);
    }
    cover.patches.iter().for_each(|patch| add(&patch.rings));
    part
}

#[test]
fn things_stand_on_the_lines_that_they_are_asked_for() {
    let places = |detail: RoofDetail, ends: Ends| -> Vec<DVec3> {
        detail.check().expect("sound fields");
        detail.frames(&patches(ends), 1).iter().map(|(_, frame)| frame.translation).collect()
    };
    let ridge = RoofDetail { every: Some(3.0), ..detail("ridge") };
    assert_eq!(
        places(ridge.clone(), Ends::Gables),
        [1.5, 4.5, 7.5, 10.5].map(|x| DVec3::new(x, 4.0, 7.0)).iter().rev().copied().collect::<Vec<_>>()
    );
    // The ridge is 4 to 8 m long, with half a metre free at each end.
    assert_eq!(places(ridge, Ends::Hips).len(), 2);
    assert_eq!(places(detail("hip"), Ends::Hips).len(), 4);
    assert_eq!(places(detail("gable"), Ends::Gables).len(), 2);
    let eaves = places(detail("eaves"), Ends::Hips);
    assert_eq!(eaves[0], DVec3::new(6.0, 0.0, 3.0));
    assert_eq!(eaves.len(), 4);
    let slope = places(RoofDetail { offset: Some(1.0), ..detail("slope") }, Ends::Gables);
    assert!(slope[0].distance(DVec3::new(6.0, 1.0, 4.0)) < 1e-9 && slope.len() == 2, "{slope:?}");
}

#[test]
fn a_gutter_is_stretched_to_its_eaves_and_looks_outwards() {
    let gutter = RoofDetail { stretch: true, ..detail("eaves") };
    let (_, frame) = gutter.frames(&patches(Ends::Hips), 1).remove(0);
    let ends = [0.0, 2.0].map(|x| frame.transform_point3(DVec3::new(x, 0.0, 0.0)));
    assert!(ends[0].distance(DVec3::new(0.0, 0.0, 3.0)) < 1e-6, "{ends:?}");
    assert!(ends[1].distance(DVec3::new(12.0, 0.0, 3.0)) < 1e-6, "{ends:?}");
    assert!((frame.transform_vector3(-DVec3::Y) + DVec3::Y).length() < 1e-9);
}

#[test]
fn what_is_left_to_chance_follows_from_the_seed() {
    let few = RoofDetail { every: Some(0.1), chance: 0.5, count: Some(7), ..detail("ridge") };
    let places = |seed: u64| -> Vec<DVec3> {
        few.frames(&patches(Ends::Gables), seed).iter().map(|(_, frame)| frame.translation).collect()
    };
    assert_eq!(places(1), places(1));
    assert_ne!(places(1), places(2));
    assert_eq!(places(3).len(), 7);
}

#[test]
fn details_refuse_what_they_cannot_place() {
    assert!(RoofDetail::default().check().is_err());
    assert!(RoofDetail { on: "rigde".into(), ..detail("ridge") }.check().is_err());
    assert!(RoofDetail { every: Some(0.0), ..detail("ridge") }.check().is_err());
    assert!(RoofDetail { chance: 1.5, ..detail("ridge") }.check().is_err());
    assert!(RoofDetail { flap: 0, ..detail("ridge") }.check().is_err());
    assert!(<Arc<Model>>::from_value(Value::Number(1.0)).is_err());
}
