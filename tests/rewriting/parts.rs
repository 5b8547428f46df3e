//! Runs over parts of the features, compared with the whole run.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use burgeon::Run;
use burgeon::scene::Scene;
use burgeon::script::{FeaturePart, RunOptions};

/// Instances of each system and feature, as text with all numbers. An empty feature stands for systems without
/// features.
fn features(scene: &Scene) -> BTreeMap<(usize, String), Vec<String>> {
    let mut found: BTreeMap<(usize, String), Vec<String>> = BTreeMap::new();
    for instance in &scene.instances {
        let parts = scene.meshes[instance.mesh].parts.iter().map(|part| {
            let bits: Vec<u32> =
                part.positions.iter().flat_map(|point| point.to_array()).map(f32::to_bits).collect();
            let uvs: Vec<u32> = part.uvs.iter().flat_map(|uv| uv.to_array()).map(f32::to_bits).collect();
            let triangles: Vec<[u32; 3]> = part.triangles.iter().collect();
            let material = &scene.materials[part.material];
            format!("{material:?} {bits:?} {:?} {uvs:?} {triangles:?}", part.normals)
        });
        let text = format!("{:?} {:?}", instance.transform, parts.collect::<Vec<_>>());
        let system = instance.origin.map_or(0, |origin| origin.system);
        found.entry((system, instance.feature.clone().unwrap_or_default())).or_default().push(text);
    }
    found
}

fn run(script: &Path, part: Option<FeaturePart>) -> Run {
    let mut options = RunOptions { part, seed: 5, ..burgeon::options() };
    options.inputs.data = vec![Path::new("examples/data").canonicalize().expect("the data")];
    burgeon::run(script, options).unwrap_or_else(|error| panic!("{}: {error}", script.display()))
}

/// Asserts that `count` parts give the features, remarks and chains of the whole run, each once.
fn check(script: &Path, count: usize, reach: f64) -> usize {
    let whole = run(script, None);
    let (mut shown, mut chains) = (BTreeMap::new(), vec![String::new(); whole.systems.len()]);
    let (mut given, mut remarks) = (0, Vec::new());
    for number in 1..=count {
        let part = run(script, Some(FeaturePart { number, count, reach, cell: None }));
        for (key, instances) in features(&part.scene) {
            assert!(shown.insert(key.clone(), instances).is_none(), "{key:?} is shown twice");
        }
        for (system, chain) in part.systems.iter().zip(&mut chains) {
            if system.features.iter().any(Option::is_some) || number == 1 {
                chain.push_str(&system.chain_text());
                given += system.given;
                remarks.extend(system.feature_warnings.iter().map(|remark| format!("{remark:?}")));
            }
        }
    }
    let expected = features(&whole.scene);
    let names = |of: &BTreeMap<(usize, String), Vec<String>>| of.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&shown), names(&expected), "{}", script.display());
    for (key, instances) in &expected {
        assert!(shown[key] == *instances, "{key:?} of {} differs with {count} parts", script.display());
    }
    for (index, system) in whole.systems.iter().enumerate() {
        assert_eq!(chains[index], system.chain_text(), "system {index}");
    }
    assert_eq!(given, whole.systems.iter().map(|system| system.given).sum::<usize>());
    let mut all: Vec<String> = whole
        .systems
        .iter()
        .flat_map(|it| &it.feature_warnings)
        .map(|remark| format!("{remark:?}"))
        .collect();
    all.sort();
    remarks.sort();
    assert_eq!(remarks, all);
    expected.len()
}

fn write(name: &str, text: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("burgeon-parts-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join(name);
    std::fs::write(&path, text).expect("a script");
    path
}

#[test]
fn a_town_in_four_parts_has_the_features_of_the_whole_town() {
    assert!(check(Path::new("scripts/town.lua"), 4, 60.0) > 50);
}

/// Rows of houses with common walls, whose axiom draws random numbers; every seventh has no area.
const ROWS: &str = "local houses = {}
for row = 0, 4 do
  for number = 0, 19 do
    local x, y, width = number * 8, row * 40, if (row * 20 + number) % 7 == 3 then 0 else 8
    table.insert(houses, {
      id = row .. '-' .. number,
      geometry = polygon({ { x, y }, { x + width, y }, { x + width, y + 12 }, { x, y + 12 } }),
      storeys = 1 + number % 3,
    })
  end
end
local Walls, Roof = module('Walls', 'height'), module('Roof', 'height')
local s = lsystem { object = footprint }
s:axiom(source(houses), function(feature)
  return footprint(feature.geometry), Walls(3 * feature.storeys + EXTRA)
end)
s:rule('Walls(height)', function(this, height) return Walls(height), Roof(random(1, 3)) end)
s:interpret('Walls(height)', function(this, height) this:walls({ height = height }) end)
s:interpret('Roof(height)', function(this, height) this:roof({ kind = 'hip', height = height }) end)
s:derive(1)";

#[test]
fn parts_of_rows_of_houses_keep_common_walls_remarks_and_random_numbers() {
    for (name, extra) in [("plain.lua", "0"), ("random.lua", "random()")] {
        let script = write(name, &ROWS.replace("EXTRA", extra));
        for count in [1, 3, 7] {
            assert!(check(&script, count, 1.0) > 80, "{name}");
        }
    }
}

#[test]
fn a_part_without_reach_lacks_the_neighbours_of_its_edge() {
    let script = write("edge.lua", &ROWS.replace("EXTRA", "0"));
    let whole = features(&run(&script, None).scene);
    let part =
        |reach| features(&run(&script, Some(FeaturePart { number: 2, count: 3, reach, cell: None })).scene);
    let differs = |part: &BTreeMap<(usize, String), Vec<String>>| {
        part.iter().filter(|(key, instances)| whole[*key] != **instances).count()
    };
    assert_eq!(differs(&part(1.0)), 0);
    assert!(differs(&part(0.0)) > 0, "the walls to the next part are common walls");
}

#[test]
fn an_empty_part_says_so_without_a_warning() {
    let script = write(
        "tower.lua",
        "local A = module('A')
         local s = lsystem { object = extruder() }
         s:axiom(A())
         s:interpret('A', function(this) this:extrude(1) end)
         s:derive()",
    );
    let part = |number| run(&script, Some(FeaturePart { number, count: 4, reach: 0.0, cell: None }));
    let (first, second) = (part(1), part(2));
    assert!(first.scene.triangles() > 0 && first.notes.is_empty());
    assert_eq!((second.scene.triangles(), second.warnings.len()), (0, 0));
    assert!(second.notes[0].starts_with("part 2 of 4 is empty"), "{:?}", second.notes);
    assert!(second.emptiness().is_none());
}

#[test]
fn there_may_be_more_parts_than_features() {
    let script = write(
        "few.lua",
        "local A = module('A')
         local s = lsystem { object = extruder() }
         s:axiom(source({ { id = 'a' }, { id = 'b' } }), function() return A() end)
         s:interpret('A', function(this) this:extrude(1) end)
         s:derive()",
    );
    assert_eq!(check(&script, 5, 10.0), 2);
}
