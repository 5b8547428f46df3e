//! Tests the shipped scripts and the scripts in README.md and the book: each runs, gives a valid model, and
//! repeats it.

#![allow(clippy::unwrap_used, reason = "a test stops at what is wrong")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use burgeon::picture::Picture;
use burgeon::script::{RunInputs, RunOptions};
use burgeon::{Run, export};
use burgeon_data::{Layer, Source, SourceOptions};
use burgeon_spatial::ReferenceFrame;

const README: &str = include_str!("../README.md");

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Returns the scripts whose data is available.
fn runnable() -> Vec<PathBuf> {
    let mut scripts = scripts();
    if !root().join("../shared/data").is_dir() {
        eprintln!("skipped monaco.lua: there is no ../shared/data");
        scripts.retain(|path| path.file_stem().is_none_or(|name| name != "monaco"));
    }
    scripts
}

/// Returns the scripts in `scripts/`, sorted by name.
fn scripts() -> Vec<PathBuf> {
    lua_files("scripts")
}

/// Returns the Lua files of a folder, sorted by name.
fn lua_files(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join(folder)).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "lua"));
    paths.sort();
    paths
}

fn run(script: &Path, threads: usize) -> Run {
    let data = vec![root().join("examples/data"), root().join("../shared/data")];
    let data = data.into_iter().filter(|folder| folder.is_dir()).collect();
    let inputs = RunInputs { data, ..RunInputs::default() };
    let options = RunOptions { threads: Some(threads), inputs, ..burgeon::options() };
    burgeon::run(script, options).unwrap_or_else(|error| panic!("{}: {error}", script.display()))
}

/// Returns the scene in .glb format.
fn glb(run: &Run, folder: &Path) -> Vec<u8> {
    let path = folder.join("model.glb");
    export::write(&run.scene, &path, &Picture::default()).unwrap();
    fs::read(path).unwrap()
}

/// Returns the parts of `text` between `before` and `after`.
fn named(text: &str, before: &str, after: &str) -> BTreeSet<String> {
    let links = text.split(before).skip(1).filter_map(|rest| rest.split_inclusive(')').next());
    links.filter_map(|link| Some(link.strip_suffix(after)?.to_owned())).collect()
}

#[test]
fn the_gallery_shows_every_script_and_no_other() {
    let shipped: BTreeSet<String> =
        scripts().iter().map(|path| path.file_stem().unwrap().to_string_lossy().into_owned()).collect();
    assert_eq!(shipped.len(), 26);
    assert_eq!(named(README, "](scripts/", ".lua)"), shipped);
    let mut shown = named(&guide(), "](docs/pictures/", ".jpg)");
    assert!(shown.remove("quay"), "{shown:?}");
    let mut in_book = named(&guide().replace("](docs/book/src/", "]("), "](pictures/", ".png)");
    for path in quarter() {
        let name = path.file_stem().unwrap().to_string_lossy();
        assert!(guide().contains(&format!("| `{name}.lua` |")), "{name}");
        assert!(in_book.remove(&format!("geospatial/{name}")), "{name} has no picture");
    }
    let rest = "environments events facade features films joints lantern leaf neighbours network phases pipes ported roofs subsystems terrain tileset tower tree variations";
    assert_eq!(in_book, rest.split(' ').map(str::to_owned).collect::<BTreeSet<_>>());
    let types: Vec<PathBuf> = lua_files("examples/types");
    assert!(
        types.iter().all(|path| shown.remove(&*path.file_stem().unwrap().to_string_lossy())),
        "{shown:?}"
    );
    assert_eq!(shown, shipped);
    for name in &shipped {
        assert!(root().join(format!("docs/pictures/{name}.jpg")).is_file(), "{name} has no picture");
    }
}

/// Returns the scripts that use the data of the town quarter, without required files.
fn quarter() -> Vec<PathBuf> {
    let mut paths = lua_files("scripts/geospatial");
    paths.retain(|path| {
        !["details", "layers", "models", "town"].iter().any(|part| path.ends_with(format!("{part}.lua")))
    });
    paths
}

#[test]
fn the_scripts_of_a_quarter_ask_its_data_and_make_the_same_with_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let scripts = quarter();
    assert_eq!(scripts.len(), 8);
    for script in scripts {
        let shown = script.display();
        let first = run(&script, 1);
        assert!(first.scene.triangles() > 1000 || first.scene.instances.len() > 30, "{shown}");
        assert!(first.warnings.is_empty(), "{shown}: {}", first.warnings[0]);
        assert!(glb(&first, folder.path()) == glb(&run(&script, 3), folder.path()), "{shown}");
    }
}

/// Returns a layer of the quarter in the metres of `frame`, which the first layer sets.
fn quarter_layer(name: &str, frame: &mut Option<ReferenceFrame>) -> Layer {
    let path = root().join(format!("examples/data/quarter/{name}.geojson"));
    let table = Source::open(&path, name).and_then(|source| source.read(name, &SourceOptions::default()));
    Layer::new(table.unwrap(), frame).unwrap()
}

#[test]
fn every_piece_of_furniture_without_a_direction_looks_to_the_nearest_point_of_all_roads() {
    let mut frame = None;
    let [_, roads, furniture] =
        ["buildings", "roads", "furniture"].map(|name| quarter_layer(name, &mut frame));
    let run = run(&root().join("scripts/geospatial/orientation.lua"), 2);
    let column = furniture.names.iter().position(|name| name == "direction").unwrap();
    let mut count = 0;
    for item in &furniture.features {
        if item.attributes.iter().any(|(name, _)| *name == column) {
            continue;
        }
        let near = roads.features.iter().filter_map(|road| {
            let [from, to] = item.geometry.nearest_points(&road.geometry)?;
            Some((to - from).truncate())
        });
        let wanted = near.min_by(|a, b| a.length().total_cmp(&b.length())).unwrap().normalize();
        let at = item.geometry.points().next().unwrap().truncate();
        let stands = run.scene.instances.iter().find(|instance| {
            let moved = instance.transform.translation;
            moved.z > 0.1 && (moved.truncate() - at).length() < 0.01
        });
        let stands = stands.unwrap_or_else(|| panic!("{} is not there", item.id));
        let looks = stands.transform.transform_vector3(glam::DVec3::X).truncate();
        assert!(looks.dot(wanted) > 1.0 - 1e-6, "{}: {looks}, not {wanted}", item.id);
        count += 1;
    }
    assert_eq!(count, 65);
}

#[test]
fn every_script_gives_a_finite_model_that_reads_back_whole() {
    let folder = tempfile::tempdir().unwrap();
    for script in runnable() {
        let shown = script.display();
        let run = run(&script, 2);
        assert!(run.scene.triangles() > 0, "{shown} draws nothing");
        // A word that is chosen at random can lead close to its own streets, which causes a warning.
        let is_known = |warning: &burgeon::Warning| {
            script.ends_with("charroads.lua") && warning.message().starts_with("network:walk: ")
        };
        let unknown: Vec<_> = run.warnings.iter().filter(|warning| !is_known(warning)).collect();
        assert!(unknown.is_empty(), "{shown}: {}", unknown[0]);
        for part in run.scene.meshes.iter().flat_map(|mesh| &mesh.parts) {
            assert!(part.positions.iter().all(|position| position.is_finite()), "{shown}");
            assert!(part.normals.iter().all(|normal| normal.vector().is_finite()), "{shown}");
        }
        // The check of the crate refuses instancing, which it does not support.
        let file = gltf::Gltf::from_slice_without_validation(&glb(&run, folder.path())).unwrap();
        let buffers = gltf::import_buffers(&file.document, None, file.blob).unwrap();
        let mut triangles = 0;
        for primitive in file.document.meshes().flat_map(|mesh| mesh.primitives()) {
            let reader = primitive.reader(|buffer| buffers.get(buffer.index()).map(|data| &data.0[..]));
            let positions = reader.read_positions().unwrap();
            let count = positions.len();
            assert!(positions.flatten().all(f32::is_finite), "{shown}");
            let corners: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
            assert!(corners.iter().all(|corner| (*corner as usize) < count), "{shown}");
            triangles += corners.len() / 3;
        }
        let drawn: usize = {
            let shown: BTreeSet<usize> = run.scene.instances.iter().map(|instance| instance.mesh).collect();
            shown.iter().map(|mesh| run.scene.meshes[*mesh].triangles()).sum()
        };
        assert_eq!(triangles, drawn, "{shown}");
    }
}

#[test]
fn an_extract_is_as_high_as_tagged_and_each_unknown_value_is_named_once() {
    let script = root().join("scripts/osm.lua");
    let highest = |run: &Run| {
        let instances = run.scene.instances.iter();
        let heights = instances.flat_map(|instance| {
            let positions = run.scene.meshes[instance.mesh].parts.iter().flat_map(|part| &part.positions);
            positions.map(|at| instance.transform.transform_point3(at.as_dvec3()).z)
        });
        heights.fold(f64::NEG_INFINITY, f64::max)
    };
    let tagged = run(&script, 2);
    assert!(tagged.warnings.is_empty(), "{}", tagged.warnings[0]);
    // The onion of the tower, which is a building part, reaches 34 m.
    assert!((highest(&tagged) - 34.0).abs() < 0.01, "{} m", highest(&tagged));

    let folder = tempfile::tempdir().unwrap();
    let text = fs::read_to_string(root().join("examples/data/roofs.osm")).unwrap();
    fs::write(folder.path().join("roofs.osm"), text.replace("\"pyramidal\"", "\"tented\"")).unwrap();
    let inputs = RunInputs { data: vec![folder.path().to_path_buf()], ..RunInputs::default() };
    let options = RunOptions { threads: Some(2), inputs, ..burgeon::options() };
    let run = burgeon::run(&script, options).unwrap();
    let texts: Vec<String> = run.warnings.iter().map(|warning| warning.message().to_owned()).collect();
    let [text] = texts.as_slice() else { panic!("{texts:?}") };
    assert!(text.contains("cannot draw roof:shape = tented on 3 features, the first is way/"), "{text}");
}

#[test]
fn the_roof_of_a_building_with_a_mapped_apex_has_its_height_at_its_place() {
    let run = run(&root().join("scripts/osm.lua"), 2);
    let places = run.scene.instances.iter().flat_map(|instance| {
        let positions = run.scene.meshes[instance.mesh].parts.iter().flat_map(|part| &part.positions);
        positions.map(|at| instance.transform.transform_point3(at.as_dvec3()))
    });
    let above: Vec<glam::DVec3> = places.filter(|at| at.z > 1.0).collect();
    let easternmost = |places: &[glam::DVec3]| places.iter().map(|at| at.x).fold(f64::NEG_INFINITY, f64::max);
    // The southern building of the easternmost two: its apex is 5 m above walls of 3 m, 7 m from its eastern wall.
    let column = easternmost(&above) - 17.0;
    let own: Vec<glam::DVec3> = above.into_iter().filter(|at| at.x > column && at.y < -35.0).collect();
    let east = easternmost(&own);
    let top = own.iter().max_by(|a, b| a.z.total_cmp(&b.z)).unwrap();
    assert!((top.z - 8.0).abs() < 0.01 && (east - top.x - 7.0).abs() < 0.2, "{top} of {east}");
}

/// Returns the file names in a model at `path`, each between `before` and `after`.
fn files_of(path: &Path, before: &str, after: &str) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap();
    let names = text.split(before).skip(1).filter_map(|rest| rest.split_once(after));
    names.map(|(name, _)| name.replace("%20", " ")).collect()
}

#[test]
fn every_script_writes_every_format_of_models_and_all_files_that_these_name() {
    let mut scripts = runnable();
    scripts.push(root().join("examples/village.lua"));
    let mut textures = 0;
    for script in scripts {
        let shown = script.display();
        let run = run(&script, 2);
        let folder = tempfile::tempdir().unwrap();
        for format in ["glb", "gltf", "obj", "x3d", "city.json", "gpkg", "geojson"] {
            let path = folder.path().join(format!("a model.{format}"));
            export::write(&run.scene, &path, &Picture::default())
                .unwrap_or_else(|error| panic!("{shown} as .{format}: {error}"));
            assert!(fs::metadata(&path).unwrap().len() > 0, "{shown}");
        }
        let mut named = files_of(&folder.path().join("a model.gltf"), "\"uri\":\"", "\"");
        named.extend(files_of(&folder.path().join("a model.obj"), "mtllib ", "\n"));
        named.extend(files_of(&folder.path().join("a model.x3d"), "url='&quot;", "&quot;'"));
        let images = files_of(&folder.path().join("a_model.mtl"), "map_Kd ", "\n");
        textures += images.len();
        for file in named.iter().chain(&images) {
            let length = fs::metadata(folder.path().join(file)).map(|meta| meta.len());
            assert!(length.is_ok_and(|length| length > 0), "{shown}: there is no file {file:?}");
        }
    }
    assert!(textures > 20, "{textures} images");
}

#[test]
fn the_town_takes_few_bytes_for_a_triangle_that_it_stores() {
    let folder = tempfile::tempdir().unwrap();
    let run = run(&root().join("scripts/town.lua"), 2);
    let bytes = glb(&run, folder.path()).len();
    let stored: usize = run.scene.meshes.iter().map(|mesh| mesh.triangles()).sum();
    // With separate corners for every face, each with a normal, a triangle would take 60 bytes.
    assert!(stored > 200_000 && bytes < 27 * stored, "{bytes} bytes for {stored} triangles");
}

#[test]
fn every_script_gives_the_same_bytes_for_one_thread_and_for_two() {
    let folder = tempfile::tempdir().unwrap();
    for script in runnable() {
        let [one, two] = [1, 2].map(|threads| glb(&run(&script, threads), folder.path()));
        assert!(one == two, "{} depends on the number of threads", script.display());
    }
}

/// Returns README.md and the manually written pages of the book, with the files that they include.
fn guide() -> String {
    let pages = fs::read_dir(root().join("docs/book/src")).unwrap().map(|entry| entry.unwrap().path());
    let mut pages: Vec<PathBuf> = pages.filter(|path| path.is_file()).collect();
    pages.sort();
    assert!(pages.len() > 8, "{pages:?}");
    let text = pages.iter().fold(README.to_owned(), |text, page| text + &fs::read_to_string(page).unwrap());
    let mut parts = text.split("{{#include ../../../");
    let mut guide = parts.next().unwrap().to_owned();
    for part in parts {
        let (file, rest) = part.split_once("}}").unwrap();
        guide += fs::read_to_string(root().join(file)).unwrap().trim_end();
        guide += rest;
    }
    guide
}

#[test]
fn every_lua_block_of_the_guide_runs() {
    let folder = tempfile::tempdir().unwrap();
    // Files that the scripts in the guide require.
    fs::create_dir_all(folder.path().join("templates/roads")).unwrap();
    let library = Path::new("templates/roads");
    let rooms = fs::read_dir(root().join("scripts").join(library)).unwrap();
    let rooms = rooms.map(|room| library.join(room.unwrap().file_name()));
    for file in rooms.chain([library.with_extension("lua")]) {
        fs::copy(root().join("scripts").join(&file), folder.path().join(file)).unwrap();
    }
    let buildings = root().join("examples/data/quarter/buildings.geojson");
    fs::copy(buildings, folder.path().join("buildings.geojson")).unwrap();
    let package = root().join("examples/shapes/mods/elements");
    let copied = folder.path().join("mods/elements");
    fs::create_dir_all(&copied).unwrap();
    for file in fs::read_dir(package).unwrap() {
        let path = file.unwrap().path();
        fs::copy(&path, copied.join(path.file_name().unwrap())).unwrap();
    }
    let guide = guide();
    let mut count = 0;
    for (index, rest) in guide.split("\n```lua\n").skip(1).enumerate() {
        let (block, _) = rest.split_once("\n```").unwrap();
        let script = folder.path().join(format!("block{}.lua", index + 1));
        fs::write(&script, block).unwrap();
        burgeon::check(&script, burgeon::options()).unwrap_or_else(|error| panic!("{error}"));
        let run = run(&script, 2);
        let modules: usize = run.systems.iter().map(|system| system.modules()).sum();
        assert!(modules + run.scene.triangles() > 0, "{block}");
        count += 1;
    }
    assert_eq!(count, 97);
    assert_eq!(count, guide.matches("```lua").count(), "a fragment would go untested");
}

#[test]
fn what_the_readme_says_of_a_context_is_what_comes_out() {
    let folder = tempfile::tempdir().unwrap();
    let guide = guide();
    let block = guide.split("\n```lua\n").find(|block| block.contains("local wire")).unwrap();
    let (block, behind) = block.split_once("\n```").unwrap();
    let script = folder.path().join("wire.lua");
    fs::write(&script, block).unwrap();
    let run = run(&script, 1);
    let [wire] = run.systems.as_slice() else { panic!("one system") };
    let printed = format!("It prints `{}\t{}`", wire.steps, wire.chain_text().trim_end());
    assert!(behind.contains(&printed), "{printed}");
}

#[test]
fn the_guide_names_every_object_its_fields_and_its_methods() {
    let guide = guide();
    let words: BTreeSet<&str> = guide.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').collect();
    for kind in burgeon::registry().kinds() {
        let fields = kind.fields.iter().map(|field| &*field.name);
        let names = fields.chain(kind.methods.iter().map(|method| &*method.name)).chain([&*kind.name]);
        // The guide shows the present names only.
        for name in names.filter(|name| kind.deprecation(name).is_none()) {
            assert!(words.contains(name), "{}: {name} is not in the guide", kind.name);
        }
    }
}

#[path = "terrain/landscapes.rs"]
mod landscapes;

#[test]
fn landscapes_of_all_kinds_and_sizes_come_out_and_no_tree_stands_in_the_sea() {
    let mut trees = 0;
    for seed in 1..=4 {
        for (kind, _) in landscapes::KINDS {
            for size in landscapes::SIZES {
                trees += landscapes::check(kind, size, seed).unwrap_or_else(|what| panic!("{what}"));
            }
        }
    }
    assert!(trees > 10_000, "{trees} trees");
}

#[path = "terrain/rivers.rs"]
mod rivers;

#[test]
fn rivers_raise_no_ground_and_nothing_grows_in_their_beds() {
    let (mut lowered, mut cleared, mut count) = (0, 0, 0);
    for seed in 1..=8 {
        for (width, decay) in [(8.0, 0.5), (25.0, 0.6)] {
            let (low, clear) = rivers::check(seed, width, decay);
            (lowered, cleared, count) = (lowered + low, cleared + clear, count + usize::from(clear > 0));
        }
    }
    assert!(
        count >= 12 && lowered > 200 && cleared > 500,
        "{count} rivers, {lowered} lower, {cleared} plants fewer"
    );
}

#[test]
fn the_castle_of_the_examples_is_built_with_two_packages() {
    let script = root().join("examples/castle.lua");
    let made = run(&script, 2);
    assert!(made.warnings.is_empty() && made.report().is_clean(), "{:?} {}", made.warnings, made.report());
    assert!(made.scene.triangles() > 20_000, "{}", made.scene.triangles());
    let textures: BTreeSet<String> = made
        .scene
        .materials
        .iter()
        .filter_map(|material| {
            Some(material.texture.as_ref()?.path.file_name()?.to_string_lossy().into_owned())
        })
        .collect();
    assert_eq!(textures, BTreeSet::from(["ashlar.png", "oak.png", "slate.png"].map(str::to_owned)));
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(glb(&made, folder.path()), glb(&run(&script, 1), folder.path()));
    for package in ["masonry", "castle"] {
        let inputs = RunInputs { mods: vec![root().join("examples/mods")], ..RunInputs::default() };
        let options = RunOptions { inputs, ..burgeon::options() };
        burgeon::check_package(&root().join("examples/mods").join(package), options).unwrap();
    }
}

#[test]
fn every_shape_grammar_of_the_examples_draws_without_warnings() {
    let mut count = 0;
    for script in lua_files("examples/shapes") {
        let made = run(&script, 2);
        let shown = script.display();
        assert!(made.warnings.is_empty(), "{shown}: {}", made.warnings[0]);
        assert!(made.scene.triangles() > 4_000, "{shown}: {}", made.scene.triangles());
        count += 1;
    }
    assert_eq!(count, 12);
    let mods = root().join("examples/shapes/mods");
    let inputs = RunInputs { mods: vec![mods.clone()], ..RunInputs::default() };
    burgeon::check_package(&mods.join("elements"), RunOptions { inputs, ..burgeon::options() }).unwrap();
}

#[test]
fn the_village_of_the_examples_stands() {
    let run = run(&root().join("examples/village.lua"), 2);
    assert!(run.scene.triangles() > 1000 && run.systems.iter().any(|system| system.features.len() > 40));
}
