//! Features of cells, compared with those of the whole run.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use burgeon::Run;
use burgeon::script::{FeaturePart, RunOptions};
use burgeon::sources::{DataSources, SourceWindow, WindowBox};
use burgeon::tiles::TilePlan;
use burgeon::tiles::plan::{PlannedSource, TileGrid};
use burgeon_spatial::{Crs, ReferenceFrame};

use crate::city::{City, city, write_geojson};

/// Drawings of each feature as text with all numbers.
fn features(run: &Run) -> BTreeMap<String, Vec<String>> {
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for instance in &run.scene.instances {
        let parts = run.scene.meshes[instance.mesh].parts.iter().map(|part| {
            let bits: Vec<u32> =
                part.positions.iter().flat_map(|point| point.to_array()).map(f32::to_bits).collect();
            format!("{:?} {bits:?} {:?}", run.scene.materials[part.material], part.normals)
        });
        let text = format!("{:?} {:?}", instance.transform, parts.collect::<Vec<_>>());
        found.entry(instance.feature.clone().unwrap_or_default()).or_default().push(text);
    }
    found
}

/// Runs the script for each tile of the plan in `folder`, and asserts that the features are those of the whole run.
fn compare(city: &City, folder: &str) -> usize {
    let script = city.path("city.lua");
    let run = |options: RunOptions| burgeon::run(&script, options).unwrap();
    let whole = features(&run(burgeon::options()));
    let plan = TilePlan::read(&city.path(folder).join("plan.json")).unwrap();
    let mut shown = BTreeMap::new();
    for tile in &plan.tiles {
        let frame: ReferenceFrame = plan.frame.reference().unwrap();
        let needed = plan.needed(tile);
        let of = |it: &PlannedSource| WindowBox { needed, in_parts: it.in_parts, bounds: it.bounds };
        let boxes = plan.sources.iter().map(|it| (it.key.clone(), of(it)));
        let window = Arc::new(SourceWindow::new(frame, boxes.collect()));
        let mut options = burgeon::options();
        options.registry.set_sources(Arc::new(DataSources::cached().windowed(&window)));
        let cell = Some(TileGrid::bounds(tile.id));
        options.part = Some(FeaturePart { number: 1, count: 1, reach: plan.reach, cell });
        for (id, drawing) in features(&run(options)) {
            assert!(shown.insert(id.clone(), drawing).is_none(), "{id} is in two tiles");
        }
        let read: usize = window.served().iter().map(|(_, layer)| layer.features.len()).sum();
        assert!(read < whole.len(), "tile {} reads {read} features", tile.id);
    }
    assert_eq!(shown.keys().collect::<Vec<_>>(), whole.keys().collect::<Vec<_>>());
    for (id, drawing) in &whole {
        assert!(shown[id] == *drawing, "feature {id} differs");
    }
    plan.tiles.len()
}

#[test]
fn the_features_of_tiles_have_the_bits_of_the_run_without_tiles() {
    let city = City::new(300);
    city.plan("out");
    assert!(compare(&city, "out") > 9);
}

#[test]
fn files_that_are_read_whole_and_chosen_from_have_the_same_bits_too() {
    let city = City::new(1);
    write_geojson(&city.path("city.geojson"), &self::city(200, [652_000.0, 6_862_000.0]));
    let city = city.script("\"city.geojson\", { crs = 2154 }", "");
    city.plan("out");
    assert!(compare(&city, "out") > 5);
}

#[test]
fn the_frame_of_pieces_is_that_of_the_whole_file() {
    let city = City::new(20_000);
    let (path, name) = (city.path("city.gpkg"), "city.gpkg");
    let options = burgeon_data::SourceOptions::default();
    let whole = burgeon_data::Source::open(&path, name).unwrap().read(name, &options).unwrap();
    let (mut extent, mut pieces, mut count) = (burgeon_data::FrameExtent::default(), 0, 0);
    let in_pieces = burgeon_data::each_piece(Path::new(&path), name, &options, |mut table| {
        (pieces, count) = (pieces + 1, count + table.features.len());
        extent.add(&mut table)?;
        Ok(std::ops::ControlFlow::Continue(()))
    });
    assert_eq!((in_pieces.unwrap(), count), (true, 20_000));
    assert!(pieces > 1);
    let mut frame: Option<ReferenceFrame> = None;
    burgeon_data::Layer::new(whole, &mut frame).unwrap();
    let frame = frame.unwrap();
    let of_pieces = extent.frame(name).unwrap();
    assert_eq!((frame.origin, frame.definition()), (of_pieces.origin, of_pieces.definition()));
    assert_eq!(extent.centre(name).unwrap().0, Crs::epsg(2154).unwrap());
}
