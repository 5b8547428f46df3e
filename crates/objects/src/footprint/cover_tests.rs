//! Tests of walls next to neighbours: windows remain where no neighbour covers the wall.

use std::sync::Arc;

use super::options::FootprintOptions;
use super::*;
use crate::facade;
use crate::roofs::Height;
use burgeon_base::error::Result;
use burgeon_geometry::Rings;
use burgeon_kit::declare::as_mut;
use burgeon_kit::{Kind, Object, Parameter, Table, TableKey, Value};
use glam::{DVec2, DVec3};

/// Distance (m) by which windows are set back.
const BACK: f64 = 0.2;

fn table(entries: &[(&str, Value)]) -> Arc<Table> {
    let entries = entries.iter().map(|(name, value)| (TableKey::Name((*name).into()), value.clone()));
    Arc::new(Table { class: None, entries: entries.collect() })
}

/// Returns a facade of windows, each about 3 m by 3 m, with a plain wall for blind parts.
fn templates() -> Value {
    let object = |made: Result<Box<dyn Object>>| Value::Object(Arc::from(made.expect("a wall")));
    let make = |kind: &Kind, entries: &[(&str, Value)]| object(kind.make(&table(entries)));
    let size = |low: f64, high: f64| vec![low, high].into_value();
    let glass = make(facade::panel::kind(), &[("width", size(0.5, 2.0)), ("height", size(0.5, 2.5))]);
    let niche = make(facade::extruded::kind(), &[("wall", glass), ("depth", Value::Number(-BACK))]);
    let margins = ["left", "right", "bottom", "top"].map(|side| (side, Value::Number(0.8)));
    let window = make(facade::bordered::kind(), &[&[("wall", niche)], margins.as_slice()].concat());
    let bay = make(facade::grid::kind(), &[("wall", window)]);
    let front = make(facade::Template::kind(), &[("wall", bay)]);
    let plain = make(facade::panel::kind(), &[]);
    let blind = vec!["blind".to_owned()].into_value();
    let party = make(facade::Template::kind(), &[("wall", plain), ("keywords", blind)]);
    vec![front, party].into_value()
}

/// A rectangle with its height, and the number of storeys in which its walls are raised.
#[derive(Debug, Clone, Copy)]
struct BlockSketch {
    low: DVec2,
    size: DVec2,
    height: f64,
    raised: u32,
}

impl BlockSketch {
    fn corners(&self) -> [DVec2; 4] {
        let Self { low, size, .. } = *self;
        [low, low + size * DVec2::X, low + size, low + size * DVec2::Y]
    }
}

/// Returns the centres of the window panes of adjacent buildings, by building.
fn windows(blocks: &[BlockSketch]) -> Vec<Vec<DVec3>> {
    let make = |block: &BlockSketch| {
        let ring = block.corners().map(|at| at.extend(0.0)).to_vec();
        let height = Some(Height(block.height));
        let options =
            FootprintOptions { geometry: Rings(vec![ring]).into(), height, ..FootprintOptions::default() };
        Box::new(Footprint::new(options).expect("a footprint")) as Box<dyn Object>
    };
    let mut objects: Vec<Box<dyn Object>> = blocks.iter().map(make).collect();
    object::gather(&mut objects);
    let templates = templates();
    let mut all = Vec::new();
    for (object, block) in objects.iter_mut().zip(blocks) {
        let house = as_mut::<Footprint>(&mut **object).expect("a footprint");
        house.begin();
        let height = block.height / f64::from(block.raised);
        for _ in 0..block.raised {
            let walls = table(&[("height", Value::Number(height)), ("templates", templates.clone())]);
            house.walls(Some(walls.into())).expect("walls");
        }
        house.end().expect("an end");
        assert!(house.notes.is_empty(), "{:?}", house.notes);
        let origin = house.origin();
        let mut found: Vec<DVec3> = Vec::new();
        for part in house.drawing.parts() {
            for corners in &part.triangles {
                let corners = corners.map(|corner| part.positions[corner as usize].as_dvec3() + origin);
                let middle = corners.iter().sum::<DVec3>() / 3.0;
                let [low, high] = [block.low, block.low + block.size];
                let inside = (middle.truncate() - low).min(high - middle.truncate()).min_element();
                let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
                if (inside - BACK).abs() < 1e-3 && normal.z.abs() < 1e-3 {
                    found.push(middle);
                }
            }
        }
        all.push(found);
    }
    all
}

/// Returns the windows in the wall at x = `x`, up to the depth by which they are set back.
fn on_wall(windows: &[DVec3], x: f64) -> Vec<DVec3> {
    windows.iter().copied().filter(|at| (at.x - x).abs() < BACK + 0.01).collect()
}

#[test]
fn a_nave_keeps_its_clerestory_and_a_tower_its_windows() {
    for raised in [1, 4] {
        let nave = BlockSketch { low: DVec2::ZERO, size: DVec2::new(10.0, 30.0), height: 12.0, raised };
        let aisle =
            BlockSketch { low: DVec2::new(10.0, 0.0), size: DVec2::new(5.0, 30.0), height: 5.0, raised: 1 };
        let found = windows(&[nave, aisle]);
        let (free, shared) = (on_wall(&found[0], 0.0), on_wall(&found[0], 10.0));
        let levels = |windows: &[DVec3]| {
            let mut levels: Vec<i64> = windows.iter().map(|at| (at.z * 10.0).round() as i64).collect();
            levels.sort_unstable();
            levels.dedup();
            levels
        };
        // A window has two triangles; the template alone makes five storeys of 12 m. Two are wholly above the aisle.
        let (all, above) = (levels(&free), levels(&shared));
        assert_eq!((all.len(), above.len()), (if raised == 1 { 10 } else { 8 }, 4), "{raised}");
        assert_eq!(all[all.len() - 4..], above, "{raised}");
        assert!(on_wall(&found[1], 10.0).is_empty() && !on_wall(&found[1], 15.0).is_empty());

        let base = BlockSketch { low: DVec2::ZERO, size: DVec2::new(24.0, 20.0), height: 8.0, raised: 2 };
        let tower = BlockSketch {
            low: DVec2::new(24.0, 6.0),
            size: DVec2::splat(8.0),
            height: 24.0,
            raised: 2 * raised,
        };
        let found = windows(&[base, tower]);
        let (of_base, of_tower) = (on_wall(&found[0], 24.0), on_wall(&found[1], 24.0));
        assert!(of_tower.iter().all(|at| at.z > 8.0) && of_tower.iter().any(|at| at.z < 15.0));
        assert!(of_tower.len() >= 16 && of_base.len() >= 16, "{} {}", of_tower.len(), of_base.len());
        assert!(of_base.iter().all(|at| !(6.0..14.0).contains(&at.y)));
    }
}

#[test]
fn windows_of_random_blocks_are_nowhere_behind_a_neighbour_and_everywhere_else() {
    let mut state = 7u64;
    let mut between = |from: f64, to: f64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        from + (to - from) * ((state >> 33) as f64 / (1u64 << 31) as f64)
    };
    let (mut hidden, mut free) = (0, 0);
    for round in 0..120 {
        let raised = [1, 2, 4][round % 3];
        let main = BlockSketch {
            low: DVec2::ZERO,
            size: DVec2::new(10.0, 24.0),
            height: between(6.0, 20.0),
            raised,
        };
        let mut blocks = vec![main];
        let mut y = between(-6.0, 8.0);
        for _ in 0..2 {
            let size = DVec2::new(8.0, between(4.0, 12.0));
            blocks.push(BlockSketch {
                low: DVec2::new(10.0, y),
                size,
                height: between(3.0, 22.0),
                raised: 1,
            });
            y += size.y + [0.0, between(1.5, 6.0)][round % 2];
        }
        let found = on_wall(&windows(&blocks)[0], 10.0);
        let cover = |y: f64| {
            let over =
                blocks[1..].iter().filter(|block| (block.low.y..block.low.y + block.size.y).contains(&y));
            over.map(|block| block.height).fold(0.0, f64::max)
        };
        for at in &found {
            assert!(at.z > cover(at.y) - 0.31 * main.height / f64::from(raised), "{round}: {at} {blocks:?}");
        }
        // Every area of 8 m by 8 m that is not covered has a window.
        for (row, column) in (0..3).flat_map(|row| (0..3).map(move |column| (row, column))) {
            let low = DVec2::new(8.0 * f64::from(column), 8.0 * f64::from(row));
            let is_free = (0..=16).all(|step| cover(low.x + 0.5 * f64::from(step)) < low.y + 0.5);
            let seen = found
                .iter()
                .any(|at| (low.x..low.x + 8.0).contains(&at.y) && (low.y..low.y + 8.0).contains(&at.z));
            if is_free && low.y + 8.0 <= main.height {
                assert!(seen, "{round}: {low} {blocks:?}");
                free += 1;
            }
            hidden += usize::from(!is_free);
        }
    }
    assert!(free > 60 && hidden > 300, "{free} {hidden}");
}

#[test]
fn walls_that_rise_above_the_height_of_a_storey_stay_blind() {
    // The given height is the height of one storey here.
    let house = |x: f64| BlockSketch {
        low: DVec2::new(x, 0.0),
        size: DVec2::new(10.0, 12.0),
        height: 3.0,
        raised: 1,
    };
    let make = |block: BlockSketch| {
        let ring = block.corners().map(|at| at.extend(0.0)).to_vec();
        let options = FootprintOptions {
            geometry: Rings(vec![ring]).into(),
            height: Some(Height(block.height)),
            ..FootprintOptions::default()
        };
        Box::new(Footprint::new(options).expect("a footprint")) as Box<dyn Object>
    };
    let mut objects = vec![make(house(0.0)), make(house(10.0))];
    object::gather(&mut objects);
    let any: &dyn std::any::Any = &*objects[0];
    let first = any.downcast_ref::<Footprint>().expect("a footprint");
    for storey in 0..4 {
        let from = 3.0 * f64::from(storey);
        let spans = first.spans(1, 12.0, [from, from + 3.0]);
        assert_eq!((spans.len(), spans[0].covered), (1, 3.0), "{storey}");
    }
}
