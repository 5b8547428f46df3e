//! Tests of globes with random rules, seen from random points.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::leaves::DETAIL;
use super::*;
use crate::CellSymbol;
use crate::{DivisionRules, LevelRules, NumberRange, Quadrants, RuleTable, Tables, Tile, World};
use burgeon_base::ModuleKey;
use burgeon_base::random::Stream;

const RADIUS: f64 = 50_000.0;

/// Returns rules of two symbols, equal for all quadrants, so that only the faces could cause edges.
fn world(seed: u64, smooth: bool) -> World {
    let rule = |symbol: CellSymbol, reach: f64, decay: f64| Quadrants {
        weight: 1.0,
        symbols: [symbol; 4],
        change: [NumberRange { low: -reach, high: reach }; 4],
        decay: [NumberRange { low: decay - 0.05, high: decay + 0.05 }; 4],
    };
    let table = RuleTable {
        names: ["A", "B"].map(str::to_owned).to_vec(),
        rules: vec![vec![rule(0, 1.0, 0.5), rule(1, 1.0, 0.6)], vec![rule(0, 0.5, 0.5)]],
    };
    World {
        corner: DVec2::ZERO,
        size: 1.0,
        layers: vec![LevelRules {
            from: 0,
            rules: DivisionRules::Table(Arc::new(table)),
            start: 0,
            height: 0.0,
            rest: vec![800.0],
            names: Arc::default(),
        }],
        smooth,
        key: Some(ModuleKey::seed(seed)),
        remap: Vec::new(),
        measured: None,
    }
}

fn view(eye: Option<DVec3>, closeness: f64, levels: u32) -> GlobeView {
    GlobeView { eye, clearance: 0.0, closeness, levels, horizon: false }
}

fn way(stream: &mut Stream) -> DVec3 {
    let number = |stream: &mut Stream| stream.uniform() * 2.0 - 1.0;
    DVec3::new(number(stream), number(stream), number(stream)).normalize()
}

/// Returns a point above the ground, at a height (m) of random magnitude.
fn eye(stream: &mut Stream) -> DVec3 {
    way(stream) * (RADIUS + 10f64.powf(1.0 + 4.0 * stream.uniform()))
}

/// Asserts that each edge of a globe's triangles has exactly one opposite edge with the same ends; returns
/// the number of triangles.
fn check_closed(globe: &Globe, error: f64) -> usize {
    let mesh = GlobeMesh::new(globe, error);
    let mut edges: BTreeMap<[[u64; 3]; 2], i32> = BTreeMap::new();
    let (mut count, mut volume) = (0, 0.0);
    for (face, tile) in globe.tiles() {
        let pieces = mesh.write(face, tile, 0.0, None);
        for part in [&pieces.land, &pieces.water] {
            let point = |at: u32| pieces.origin + part.positions[at as usize].as_dvec3();
            let bits = |at: u32| point(at).to_array().map(|number| (number + 0.0).to_bits());
            for [a, b, c] in &part.triangles {
                count += 1;
                volume += point(a).cross(point(b)).dot(point(c)) / 6.0;
                assert!((point(b) - point(a)).cross(point(c) - point(a)).dot(point(a)) > 0.0);
                for [from, to] in [[a, b], [b, c], [c, a]].map(|edge| edge.map(bits)) {
                    assert!(from != to);
                    *edges.entry([from, to]).or_default() += 1;
                }
            }
        }
    }
    for (&[from, to], number) in &edges {
        assert!(*number == 1 && edges.get(&[to, from]) == Some(&1), "{from:?} {to:?}: {number}");
    }
    let whole = std::f64::consts::PI * 4.0 / 3.0 * RADIUS.powi(3);
    assert!((volume / whole - 1.0).abs() < 0.1, "{volume} of {whole}");
    count
}

#[test]
fn a_globe_at_mixed_detail_has_no_open_edge() {
    let mut stream = Stream::new(12);
    let mut eyes: Vec<DVec3> = (0..4).map(|_| eye(&mut stream)).collect();
    // Where three faces meet, where two do, and a pole.
    eyes.extend([DVec3::ONE, DVec3::new(1.0, 0.0, 1.0), DVec3::Z].map(|at| at.normalize() * (RADIUS + 30.0)));
    for (round, eye) in (0u64..).zip(eyes) {
        let sea = (round % 2 == 0).then_some(50.0);
        let mut globe = Globe::new(world(round, round % 3 > 0), RADIUS, sea);
        globe.focus(&view(Some(eye), 0.9, 12), &Tables).unwrap();
        let levels = globe.tiles().map(|(_, tile)| tile.place.level);
        let (low, high) = levels.fold((99, 0), |(low, high), level| (level.min(low), level.max(high)));
        assert!(high - low >= 2, "{low} {high}");
        let fine = check_closed(&globe, 0.01);
        let coarse = check_closed(&globe, 0.1);
        assert!(coarse < fine, "{coarse} {fine}");
    }
}

#[test]
fn the_way_to_a_place_does_not_matter() {
    let mut stream = Stream::new(5);
    let mut walker = Globe::new(world(3, true), RADIUS, None);
    for _ in 0..3 {
        let at = eye(&mut stream);
        for _ in 0..3 {
            let near = at + way(&mut stream) * stream.uniform() * 2000.0;
            walker.focus(&view(Some(near), 1.2, 14), &Tables).unwrap();
        }
        walker.focus(&view(Some(at), 1.2, 14), &Tables).unwrap();
        let mut fresh = Globe::new(world(3, true), RADIUS, None);
        fresh.focus(&view(Some(at), 1.2, 14), &Tables).unwrap();
        assert_eq!(walker.tiles().count(), fresh.tiles().count());
        for ((face, one), (there, other)) in walker.tiles().zip(fresh.tiles()) {
            assert!(face == there && one.place == other.place);
            let cells = Tile::own_cells(one.place, DETAIL).grow(1);
            assert!(cells.cells().all(|(x, y)| one.cell(x, y).to_bits() == other.cell(x, y).to_bits()));
        }
    }
}

#[test]
fn the_edges_of_the_cube_do_not_show() {
    for seed in 0..3 {
        let mut globe = Globe::new(world(seed, true), RADIUS, None);
        globe.focus(&view(None, 6.0, 9), &Tables).unwrap();
        let step = globe.world().cell(globe.finest()) / RADIUS;
        // Steps across each edge of the cube, and across as many other great circles.
        let measured = |normal: DVec3, at: &dyn Fn(f64) -> DVec3| -> (f64, f64) {
            let (mut first, mut second) = (0.0, 0.0);
            for along in 0..400 {
                let place = at(f64::from(along) / 400.0);
                let height = |steps: f64| globe.height(place + normal * step * steps).unwrap();
                let [a, b, c, d] = [-1.5, -0.5, 0.5, 1.5].map(height);
                first += (c - b).powi(2);
                second += (a - b - c + d).powi(2);
            }
            (first, second)
        };
        let mut stream = Stream::new(2);
        let (mut edges, mut others) = ((0.0, 0.0), (0.0, 0.0));
        for axis in 0..12 {
            let turned = |at: DVec3| match axis % 3 {
                0 => at,
                1 => DVec3::new(at.z, at.x, at.y),
                _ => DVec3::new(at.y, at.z, at.x),
            };
            let (side, up) =
                (if axis / 3 % 2 == 0 { 1.0 } else { -1.0 }, if axis / 6 == 0 { 1.0 } else { -1.0 });
            let normal = turned(DVec3::new(side, -up, 0.0)).normalize();
            let edge = |along: f64| turned(DVec3::new(side, up, 1.9 * along - 0.95)).normalize();
            let found = measured(normal, &edge);
            edges = (edges.0 + found.0, edges.1 + found.1);
            let (from, to) = (way(&mut stream), way(&mut stream));
            let normal = from.cross(to).normalize();
            let other = |along: f64| from.lerp(from.reject_from(normal).cross(normal), along).normalize();
            let found = measured(normal, &other);
            others = (others.0 + found.0, others.1 + found.1);
        }
        // Edges are as steep and as bent as other places.
        let (steep, bent) = (edges.0 / others.0, edges.1 / others.1);
        assert!((0.4..2.0).contains(&steep) && bent < 1.5, "{seed}: {edges:?} {others:?}");
    }
}

#[test]
fn an_eye_near_the_ground_sees_it_closely() {
    let mut globe = Globe::new(world(4, true), RADIUS, Some(0.0));
    let way = DVec3::new(0.2, -0.7, 0.5).normalize();
    globe.focus(&view(Some(way * RADIUS), 2.0, 18), &Tables).unwrap();
    let height = globe.height(way).unwrap();
    globe.focus(&view(Some(way * (RADIUS + height.max(0.0) + 2.0)), 2.0, 18), &Tables).unwrap();
    assert_eq!(globe.finest(), 18);
    assert_eq!(globe.height(way).unwrap().to_bits(), height.to_bits());
    assert!(globe.heights() < 5_000_000);
}

#[test]
fn what_is_behind_the_horizon_can_be_left_out() {
    let mut globe = Globe::new(world(4, true), RADIUS, None);
    let eye = DVec3::X * (RADIUS * 1.05);
    globe.focus(&view(Some(eye), 2.0, 12), &Tables).unwrap();
    let mesh = GlobeMesh::new(&globe, 0.1);
    let seen = |face, tile| !mesh.write(face, tile, 0.0, Some(eye)).is_empty();
    let count = globe.tiles().filter(|(face, tile)| seen(*face, tile)).count();
    assert!(count > 10 && count < globe.tiles().count());
    assert!(globe.tiles().all(|(face, tile)| face != 2 || !seen(face, tile)));
}

#[test]
fn origins_of_tiles_are_numbers_that_files_hold_exactly() {
    let mut stream = Stream::new(8);
    for radius in [900.0, 50_000.0, 1_200_000.0, 6_371_000.0, 11_000_000.0, 6e7, 1e9] {
        for levels in [7, 16, 28] {
            let mut globe = Globe::new(world(7, true), radius, None);
            let eye = way(&mut stream) * radius * (1.0 + 10f64.powf(-7.0 * stream.uniform()));
            globe.focus(&view(Some(eye), 0.9, levels), &Tables).unwrap();
            let mesh = GlobeMesh::new(&globe, 0.1);
            for (face, tile) in globe.tiles() {
                let pieces = mesh.write(face, tile, 0.0, None);
                for number in pieces.origin.to_array() {
                    assert_eq!(number, f64::from(number as f32), "radius {radius}, levels {levels}");
                }
            }
        }
    }
}

#[test]
fn the_horizon_bounds_what_is_expanded_and_changes_nothing_above_it() {
    let mut stream = Stream::new(21);
    for _ in 0..6 {
        let direction = way(&mut stream);
        let mut open = Globe::new(world(4, true), RADIUS, None);
        let mut bounded = open.clone();
        open.focus(&view(Some(direction * RADIUS * 1.1), 2.0, 18), &Tables).unwrap();
        let height = RADIUS + open.height(direction).unwrap() + 20.0;
        let eye = Some(direction * height);
        open.focus(&view(eye, 2.0, 18), &Tables).unwrap();
        bounded.focus(&GlobeView { horizon: true, ..view(eye, 2.0, 18) }, &Tables).unwrap();
        assert!(bounded.heights() < open.heights());
        let above = height - RADIUS - open.height(direction).unwrap();
        for _ in 0..400 {
            let spread = 0.02 * stream.uniform();
            let place = (direction + way(&mut stream) * spread).normalize();
            let ground = open.height(place).unwrap();
            if open.is_above_horizon(direction * (RADIUS + above), place * (RADIUS + ground)) {
                assert_eq!(bounded.height(place).unwrap().to_bits(), ground.to_bits());
            }
        }
        check_closed(&bounded, 0.1);
    }
}

#[test]
fn an_eye_below_finer_ground_looks_from_its_clearance() {
    let direction = DVec3::new(0.2, -0.7, 0.5).normalize();
    let heights = |depth: f64, clearance: f64| {
        let mut globe = Globe::new(world(4, true), RADIUS, Some(0.0));
        let eye = Some(direction * (RADIUS - depth));
        globe.focus(&GlobeView { clearance, ..view(eye, 1.0, 12) }, &Tables).unwrap();
        globe.heights()
    };
    assert_eq!(heights(4000.0, 900.0), heights(2000.0, 900.0));
    assert!(heights(4000.0, 9000.0) < heights(4000.0, 1.0));
}
