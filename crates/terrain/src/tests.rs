//! Tests of worlds with random rules, seen from random points.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::*;
use crate::CellSymbol;
use burgeon_base::ModuleKey;
use burgeon_base::random::Stream;
use burgeon_scene::Part;

/// Returns a rule table of four symbols.
fn table(seed: u64, drawn: bool) -> RuleTable {
    let mut stream = Stream::new(seed);
    let mut rule = || {
        let mut change = || {
            let low = stream.uniform() * 2.0 - 1.0;
            NumberRange { low, high: if drawn { low + 0.5 } else { low } }
        };
        Quadrants {
            weight: 1.0,
            change: std::array::from_fn(|_| change()),
            symbols: std::array::from_fn(|_| CellSymbol::try_from(stream.below(4)).unwrap()),
            decay: std::array::from_fn(|_| NumberRange::exactly(0.4 + 0.2 * stream.uniform())),
        }
    };
    RuleTable {
        names: ["A", "B", "C", "D"].map(str::to_owned).to_vec(),
        rules: (0..4).map(|_| (0..=usize::from(drawn)).map(|_| rule()).collect()).collect(),
    }
}

fn world(seed: u64, drawn: bool, smooth: bool) -> World {
    World {
        corner: DVec2::new(-1000.0, 500.0),
        size: 65_536.0,
        layers: vec![LevelRules {
            from: 0,
            rules: DivisionRules::Table(Arc::new(table(seed, drawn))),
            start: 0,
            height: 100.0,
            rest: vec![2000.0],
            names: Arc::default(),
        }],
        smooth,
        key: drawn.then(|| ModuleKey::seed(seed)),
        remap: Vec::new(),
        measured: None,
    }
}

/// Returns a view with tiles of 512 m: 4 x 4 of 5 levels, 8 x 8 of 3, 12 x 12 of 2 and 16 x 16 of 1.
fn view() -> View {
    let ring = |(across, levels)| TileRing { across, levels };
    View { cell: 512.0, rings: [(4, 5), (8, 3), (12, 2), (16, 1)].map(ring).to_vec() }
}

fn eye(stream: &mut Stream) -> DVec2 {
    DVec2::new(-1000.0, 500.0) + DVec2::new(stream.uniform(), stream.uniform()) * 65_536.0
}

#[test]
fn the_way_to_a_place_does_not_matter() {
    for (drawn, smooth) in [(false, false), (true, false), (true, true)] {
        let world = Arc::new(world(5, drawn, smooth));
        let mut stream = Stream::new(9);
        let mut walker = Ground::new(Arc::clone(&world));
        for _ in 0..100 {
            let at = eye(&mut stream);
            for _ in 0..10 {
                let step = DVec2::new(stream.uniform() - 0.5, stream.uniform() - 0.5) * 3000.0;
                let near = (at + step).clamp(world.corner, world.corner + world.size);
                walker.focus(near, &view(), &Tables).unwrap();
            }
            walker.focus(at, &view(), &Tables).unwrap();
            let mut fresh = Ground::new(Arc::clone(&world));
            fresh.focus(at, &view(), &Tables).unwrap();
            assert_eq!(walker.tiles().len(), fresh.tiles().len());
            for (one, other) in walker.tiles().iter().zip(fresh.tiles()) {
                assert!(one.place == other.place && one.detail == other.detail);
                let own = Tile::own_cells(one.place, one.detail).widen(1, World::across(one.level()));
                assert!(own.cells().all(|(x, y)| one.cell(x, y).to_bits() == other.cell(x, y).to_bits()));
            }
        }
    }
}

#[test]
fn a_part_of_the_tree_is_as_the_whole_one() {
    for (drawn, smooth) in [(false, false), (true, false), (true, true), (false, true)] {
        let world = world(7, drawn, smooth);
        let whole = world.cells(8, Area { x: 0, y: 0, columns: 256, rows: 256 }, &Tables).unwrap();
        let mut stream = Stream::new(1);
        for _ in 0..100 {
            let span = |stream: &mut Stream| {
                let first = stream.below(256);
                (i64::try_from(first).unwrap(), 1 + stream.below(256 - first))
            };
            let ((x, columns), (y, rows)) = (span(&mut stream), span(&mut stream));
            let area = Area { x, y, columns, rows };
            let part = world.cells(8, area, &Tables).unwrap();
            for (x, y) in area.cells() {
                let (here, there) = (part.area.index(x, y), whole.area.index(x, y));
                assert_eq!(part.surface()[here].to_bits(), whole.surface()[there].to_bits());
                assert_eq!(part.symbols[here], whole.symbols[there]);
            }
        }
    }
}

#[test]
fn a_rule_table_gives_what_its_text_says() {
    // Recursive reference implementation for single cells.
    fn naive(
        table: &RuleTable,
        (symbol, height, decay): (CellSymbol, f64, f64),
        levels: u32,
        x: usize,
        y: usize,
    ) -> f64 {
        if levels == 0 {
            return height;
        }
        let half = 1 << (levels - 1);
        let quadrant = usize::from(x >= half) + 2 * usize::from(y >= half);
        let rule = &table.rules[usize::from(symbol)][0];
        let child = (
            rule.symbols[quadrant],
            height + rule.change[quadrant].low * decay,
            decay * rule.decay[quadrant].low,
        );
        naive(table, child, levels - 1, x % half, y % half)
    }
    let world = world(3, false, false);
    let cells = world.cells(7, Area { x: 0, y: 0, columns: 128, rows: 128 }, &Tables).unwrap();
    for (index, (x, y)) in cells.area.cells().enumerate() {
        let (x, y) = (usize::try_from(x).unwrap(), usize::try_from(y).unwrap());
        let expected = naive(&table(3, false), (0, 100.0, 2000.0), 7, x, y);
        assert_eq!(cells.heights[index].to_bits(), expected.to_bits(), "{x}, {y}");
    }
}

#[test]
fn the_reference_view_has_the_heights_of_the_paper() {
    let size = 512.0 * 65_536.0;
    let world = World { size, corner: DVec2::ZERO, ..world(1, true, true) };
    let ring = |(across, levels)| TileRing { across, levels };
    let view = View { cell: 512.0, rings: [(4, 8), (8, 6), (12, 4), (16, 2)].map(ring).to_vec() };
    let mut ground = Ground::new(Arc::new(world));
    ground.focus(DVec2::new(10_000_300.0, 9_000_200.0), &view, &Tables).unwrap();
    let mut counts = BTreeMap::new();
    for tile in ground.tiles() {
        *counts.entry(tile.heights()).or_insert(0) += 1;
    }
    assert_eq!(counts.into_iter().collect::<Vec<_>>(), [(16, 112), (256, 80), (4096, 48), (65_536, 16)]);
    assert_eq!(ground.heights(), 1_267_456);
}

/// Returns the edges of triangles without an adjacent triangle, as pairs of points.
fn open_edges(part: &Part) -> Vec<[DVec3; 2]> {
    let mut edges: BTreeMap<[[u32; 3]; 2], i32> = BTreeMap::new();
    let bits = |at: u32| part.positions[at as usize].to_array().map(f32::to_bits);
    for [a, b, c] in &part.triangles {
        for [from, to] in [[a, b], [b, c], [c, a]].map(|edge| edge.map(bits)) {
            *edges.entry([from, to]).or_default() += 1;
            *edges.entry([to, from]).or_default() -= 1;
        }
    }
    let point = |bits: [u32; 3]| DVec3::from(bits.map(f32::from_bits).map(f64::from));
    let open = edges.into_iter().filter(|(_, count)| *count > 0);
    open.map(|(edge, _)| edge.map(point)).collect()
}

#[test]
fn triangles_leave_no_gap_and_stay_within_the_error() {
    let mut stream = Stream::new(4);
    let mut sizes = Vec::new();
    for round in 0..24 {
        let world = Arc::new(world(round, round % 2 == 0, round % 3 > 0));
        let mut ground = Ground::new(Arc::clone(&world));
        ground.focus(eye(&mut stream), &view(), &Tables).unwrap();
        let error = [0.0, 0.5, 5.0, 40.0][round as usize % 4];
        let mesh = GroundMesh::new(&ground, error);
        let (low, high) = ground
            .tiles()
            .iter()
            .map(|tile| tile.bounds(&world))
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), (corner, size)| {
                (low.min(corner), high.max(corner + size))
            });
        let origin = low.extend(0.0);
        let mut part = Part::default();
        for number in 0..ground.tiles().len() {
            mesh.write(number, origin, 0.0, &GroundCuts::default(), &mut part);
        }
        sizes.push(part.triangles.len());
        let span = high - low;
        for edge in open_edges(&part) {
            let on = |of: fn(DVec3) -> f64, rim: f64| edge.iter().all(|end| (of(*end) - rim).abs() < 0.01);
            let rim =
                on(|at| at.x, 0.0) || on(|at| at.y, 0.0) || on(|at| at.x, span.x) || on(|at| at.y, span.y);
            assert!(rim, "{round}: {edge:?}");
        }
        // Every corner of cells is near the triangle above or below it.
        let mut area = 0.0;
        let mut met = 0;
        for corners in &part.triangles {
            let [a, b, c] = corners.map(|corner| part.positions[corner as usize].as_dvec3());
            let normal = (b - a).cross(c - a);
            assert!(normal.z > 0.0, "{round}: {a} {b} {c}");
            area += normal.z / 2.0;
            let step = 512.0 / 32.0;
            let low = a.min(b).min(c);
            let high = a.max(b).max(c);
            let count = |span: f64| (span / step).round() as usize;
            for (row, column) in (0..=count(high.y - low.y))
                .flat_map(|row| (0..=count(high.x - low.x)).map(move |column| (row, column)))
            {
                let at = low.truncate() + DVec2::new(column as f64, row as f64) * step;
                let inside = [(a, b), (b, c), (c, a)]
                    .iter()
                    .all(|(from, to)| (to - from).truncate().perp_dot(at - from.truncate()) >= -1e-6);
                if !inside {
                    continue;
                }
                let on_plane = a.z - (normal.truncate().dot(at - a.truncate())) / normal.z;
                let height = ground.height(at + low_of(&origin)).unwrap();
                assert!((on_plane - height).abs() <= error + 0.01, "{round}: {at} {on_plane} {height}");
                met += 1;
            }
        }
        assert!((area - span.x * span.y).abs() < 1e-4 * area, "{round}: {area} of {}", span.x * span.y);
        assert!(met > 10_000);
    }
    assert!(sizes[3] < sizes[0] / 4, "{sizes:?}");
}

fn low_of(origin: &DVec3) -> DVec2 {
    origin.truncate()
}

#[test]
fn rivers_never_rise_and_end_at_the_rim_in_water_or_in_another() {
    let mut stream = Stream::new(2);
    let (mut count, mut dry) = (0, 0);
    for seed in 0..8 {
        let world = Arc::new(World { size: 4096.0, ..world(seed, true, true) });
        let mut ground = Ground::new(Arc::clone(&world));
        let middle = world.corner + world.size / 2.0;
        ground.focus(middle, &View::whole(&world, 7), &Tables).unwrap();
        let map = ground.map().unwrap();
        let mut sorted = map.heights.clone();
        sorted.sort_by(f64::total_cmp);
        let water = sorted[sorted.len() / 10];
        let mut drainage = Drainage::new(&map, Some(water));
        let mut ways: Vec<Vec<DVec3>> = Vec::new();
        for _ in 0..12 {
            let source = world.corner + DVec2::new(stream.uniform(), stream.uniform()) * world.size;
            let is_source = drainage.is_source(source);
            let way = drainage.river(source);
            assert_eq!(is_source, way.is_ok(), "{seed}: {source}");
            let Ok(way) = way else {
                dry += 1;
                continue;
            };
            assert!(way.windows(2).all(|pair| pair[1].z <= pair[0].z + 1e-9), "{seed}");
            assert!(way[0].truncate().distance(source) < 64.0);
            let end = way[way.len() - 1];
            let to_rim = (end.truncate() - middle).abs().max_element();
            let joins = ways.iter().flatten().any(|at| at.truncate().distance(end.truncate()) < 64.0);
            assert!(to_rim > world.size / 2.0 - 64.0 || end.z <= water || joins, "{seed}: {end}");
            ways.push(way);
            count += 1;
        }
    }
    assert!(count > 60 && dry > 0, "{count} rivers, {dry} places without");
}

#[test]
fn edits_act_in_their_order_whatever_is_expanded_and_come_back_from_a_file() {
    let world = Arc::new(world(3, true, true));
    let middle = world.corner + DVec2::splat(20_000.0);
    let square = |half: f64| {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| (middle + DVec2::new(x, y) * half).to_array())
    };
    let mut edits = Edits::default();
    let outline = square(300.0).to_vec();
    edits.add(&world, Edit::Flatten { outline, height: 700.0, margin: 50.0 }).unwrap();
    let path = vec![(middle - 900.0).to_array(), (middle + 900.0).to_array()];
    edits.add(&world, Edit::Dig { path, width: 80.0, depth: 30.0 }).unwrap();
    let edits = Arc::new(edits);
    let mut ground = Ground::new(Arc::clone(&world));
    ground.edit(&edits);
    ground.focus(middle, &view(), &Tables).unwrap();
    let beside = middle + DVec2::new(200.0, -200.0);
    assert_eq!(ground.height(beside), Some(700.0));
    // The ditch was dug into the level area.
    let bottom = ground.height(middle).unwrap();
    assert!((669.0..675.0).contains(&bottom), "{bottom}");
    let before: Vec<Option<f64>> =
        ground.tiles().iter().map(|tile| ground.height(tile.bounds(&world).0)).collect();
    // Away, so that all tiles are contracted, and back.
    ground.focus(world.corner + 1.0, &view(), &Tables).unwrap();
    assert_eq!(ground.height(beside), None);
    ground.focus(middle, &view(), &Tables).unwrap();
    let after: Vec<Option<f64>> =
        ground.tiles().iter().map(|tile| ground.height(tile.bounds(&world).0)).collect();
    assert_eq!(before, after);
    let text = edits.to_json(&world);
    let read = Edits::from_json(&text, "ground.json", &world).unwrap();
    assert_eq!(read, *edits);
    assert_eq!(read.to_json(&world), text);
    let elsewhere = World { size: 1000.0, ..(*world).clone() };
    assert!(Edits::from_json(&text, "ground.json", &elsewhere).is_err());
    // Without edits the affected tiles have their original heights.
    ground.edit(&Arc::default());
    ground.focus(middle, &view(), &Tables).unwrap();
    let mut plain = Ground::new(Arc::clone(&world));
    plain.focus(middle, &view(), &Tables).unwrap();
    assert_eq!(ground.height(beside), plain.height(beside));
    assert_ne!(ground.height(beside), Some(700.0));
}

#[test]
fn cells_are_called_as_the_rules_of_their_level_call_them() {
    let mut world = world(3, false, false);
    let named = |names: [&str; 4]| Arc::new(names.map(str::to_owned).to_vec());
    let first = LevelRules { names: named(["A", "B", "C", "D"]), ..world.layers[0].clone() };
    let fine = LevelRules { from: 9, start: 2, names: named(["E", "F", "G", "H"]), ..first.clone() };
    world.layers = vec![first, fine];
    let mut ground = Ground::new(Arc::new(world));
    let ring = |(across, levels)| TileRing { across, levels };
    let view = View { cell: 512.0, rings: [(2, 3), (4, 1)].map(ring).to_vec() };
    let eye = ground.world().corner + 20_000.0;
    ground.focus(eye, &view, &Tables).unwrap();
    // Tiles are of level 7: the outer tiles end at level 8, before the other rules begin.
    let name = |away: f64| ground.symbol(eye + DVec2::new(away, 0.0)).unwrap();
    assert!("EFGH".contains(name(0.0)) && "ABCD".contains(name(900.0)), "{} {}", name(0.0), name(900.0));
    assert!(!name(0.0).is_empty() && !name(900.0).is_empty());
}

#[test]
fn a_reader_of_rows_finds_the_ground_of_each_point() {
    let mut stream = Stream::new(9);
    let mut ground = Ground::new(Arc::new(world(3, false, false)));
    let eye = eye(&mut stream);
    ground.focus(eye, &view(), &Tables).unwrap();
    let mut read = 0;
    for row in 0..200 {
        // Rows pass tiles of each level, their borders, corners of cells and the end of the expanded area.
        let mut place = eye + DVec2::new(-9000.0, stream.uniform() * 4000.0 - 2000.0);
        let step = if row % 2 == 0 { 32.0 } else { stream.uniform() * 60.0 };
        if row % 4 == 0 {
            place = (place / 32.0).floor() * 32.0;
        }
        let mut reader = GroundReader::new(&ground);
        for _ in 0..600 {
            let sample = reader.at(place);
            assert_eq!(sample.map(|sample| sample.height.to_bits()), ground.height(place).map(f64::to_bits));
            assert_eq!(sample.map(|sample| sample.normal), ground.way_up(place), "at {place}");
            assert_eq!(sample.map(|sample| sample.symbol), ground.symbol(place));
            read += usize::from(sample.is_some());
            place.x += step;
        }
    }
    assert!(read > 20_000, "{read} points");
}
