//! Exports with meaning: layers, city models, and features with attributes in glTF.

use insta::assert_snapshot;
use serde_json::{Value, json};

use super::support::Folder;

const PLOTS: &str = r#"{"type":"FeatureCollection","features":[
{"type":"Feature","id":"way/1","properties":{"use":"house","levels":2,"lit":true},
 "geometry":{"type":"Polygon","coordinates":[[[7.42,43.73],[7.4202,43.73],[7.4202,43.7301],[7.42,43.7301],[7.42,43.73]]]}},
{"type":"Feature","id":"way/2","properties":{"use":"shop \"&\u0007<b>","levels":3},
 "geometry":{"type":"Polygon","coordinates":[[[7.421,43.73],[7.4212,43.73],[7.4212,43.7301],[7.421,43.73]]]}}]}"#;

const SCRIPT: &str = r#"local Seed, Lot, Mast = module("Seed", "shape", "use", "floors"), module("Lot", "shape", "use", "floors"), module("Mast", "at", "tags")
local lots = lsystem({ object = footprint })
lots:axiom(source("plots.geojson"), function(feature)
  return footprint(feature.geometry), Seed(feature.geometry, feature.use, feature.levels)
end)
lots:rule("Seed(shape, use, floors)", function(this, shape, use, floors)
  return Lot(shape, use, floors), Mast(shape:centroid(), { "a", 2 }), Mast(shape:centroid(), { high = true })
end)
lots:interpret("Lot(shape, use, floors)", function(this, shape, use, floors)
  this:walls({ height = 3 * floors }):roof({ kind = "hip" })
end)
lots:interpret("Mast", function(this) end)
lots:derive()
"#;

fn folder() -> Folder {
    Folder::new().with("s.lua", SCRIPT).with("plots.geojson", PLOTS)
}

fn read(folder: &Folder, name: &str) -> Value {
    serde_json::from_slice(&std::fs::read(folder.path().join(name)).unwrap()).unwrap()
}

#[test]
fn modules_with_a_geometry_become_layers_that_read_back_where_they_were() {
    let folder = folder();
    let outputs =
        ["-o", "a.gpkg", "-o", "a.geojson", "-o", "a.city.json", "-o", "a.glb", "--metadata", "-o", "a.x3d"];
    let mut known: Option<Vec<Vec<u8>>> = None;
    for threads in ["1", "2", "7"] {
        let flags = ["run", "s.lua", "--strict", "--threads", threads, "--batch", "1"];
        folder.burgeon(&[&flags, &outputs[..]].concat()).done();
        let names = ["a.gpkg", "a.geojson", "a.city.json", "a.glb", "a.x3d"];
        let bytes: Vec<Vec<u8>> =
            names.iter().map(|name| std::fs::read(folder.path().join(name)).unwrap()).collect();
        assert!(known.get_or_insert_with(|| bytes.clone()) == &bytes, "{threads} threads");
    }
    let collection = read(&folder, "a.geojson");
    let features = collection["features"].as_array().unwrap();
    assert_eq!(features.len(), 6);
    let given: Value = serde_json::from_str(PLOTS).unwrap();
    let ring = |collection: &Value, index: usize| -> Vec<[f64; 2]> {
        serde_json::from_value(collection["features"][index]["geometry"]["coordinates"][0].clone()).unwrap()
    };
    for index in 0..2 {
        for (a, b) in ring(&collection, index).iter().zip(ring(&given, index)) {
            assert!((a[0] - b[0]).abs() < 2e-9 && (a[1] - b[1]).abs() < 2e-9, "{a:?} {b:?}");
        }
    }
    assert_eq!(features[1]["properties"], json!({ "layer": "Lot", "use": "shop \"&\u{7}<b>", "floors": 3 }));
    let masts: Vec<&Value> = features[2..].iter().map(|feature| &feature["id"]).collect();
    assert_eq!(masts, ["way/1", "way/1.2", "way/2", "way/2.2"]);
    assert_eq!(
        (&features[2]["properties"]["tags"], &features[3]["properties"]["tags"]),
        (&json!(["a", 2.0]), &json!({ "high": true }))
    );
    let listing = folder.burgeon(&["sources", "a.gpkg", "--json"]).done().json().to_string();
    assert!(
        listing.contains("\"Lot\"") && listing.contains("\"Mast\"") && listing.contains("EPSG:4326"),
        "{listing}"
    );
}

#[test]
fn buildings_of_a_city_have_surfaces_and_the_attributes_of_their_features() {
    let folder = folder();
    for (lod, kind) in [("0", "MultiSurface"), ("1", "Solid"), ("2", "Solid"), ("3", "Solid")] {
        folder.burgeon(&["run", "s.lua", "--lod", lod, "-o", "a.city.json"]).done();
        let city = read(&folder, "a.city.json");
        assert_eq!(city["metadata"]["referenceSystem"], "https://www.opengis.net/def/crs/EPSG/0/32632");
        let building = &city["CityObjects"]["way/1"];
        assert_eq!(building["type"], "Building");
        assert_eq!(building["attributes"], json!({ "use": "house", "levels": 2.0, "lit": true }));
        let geometry = &building["geometry"][0];
        let level = if lod == "2" { "2.2" } else { lod };
        assert_eq!((geometry["lod"].as_str(), geometry["type"].as_str()), (Some(level), Some(kind)));
        let surfaces = geometry["semantics"]["surfaces"].to_string();
        let has = |name: &str| surfaces.contains(name);
        assert!(
            has("GroundSurface") && has("WallSurface") == (lod != "0") && has("RoofSurface") == (lod != "0")
        );
    }
}

#[test]
fn lists_of_a_script_tell_their_attributes_and_systems_their_class() {
    let script = r#"local Trunk = module("Trunk")
local trees = lsystem({ object = turtle({ width = 0.2 }), city = "SolitaryVegetationObject" })
trees:axiom(source({ { id = "a", kind = "oak", age = 0 / 0 }, { id = "b", tall = true } }), function(feature) return Trunk() end)
trees:interpret("Trunk", function(this) this:forward(2) end)
trees:derive()
"#;
    let folder = Folder::new().with("s.lua", script);
    folder.burgeon(&["run", "s.lua", "--strict", "-o", "a.city.json", "-o", "a.gltf", "--metadata"]).done();
    let objects = &read(&folder, "a.city.json")["CityObjects"];
    assert_eq!(
        (&objects["a"]["type"], &objects["a"]["attributes"]),
        (&json!("SolitaryVegetationObject"), &json!({ "kind": "oak" }))
    );
    assert_eq!(objects["b"]["attributes"], json!({ "tall": true }));
    let classes = &read(&folder, "a.gltf")["extensions"]["EXT_structural_metadata"]["schema"]["classes"];
    assert_eq!(classes["system_1"]["properties"]["kind"]["noData"], "");
}

#[test]
fn metadata_has_the_attributes_that_are_asked_for_and_every_file_its_place() {
    let data = json!({
        "type": "FeatureCollection",
        "features": [{
            "type": "Feature", "id": "hut",
            "properties": { "height": 4, "height_source": "guess", "roof:colour": "red", "note": "n" },
            "geometry": { "type": "Polygon", "coordinates": [[[24.9, 60.1], [24.9002, 60.1], [24.9002, 60.1001], [24.9, 60.1001], [24.9, 60.1]]] }
        }]
    });
    let script = r#"local Walls = module("Walls", "height")
local huts = lsystem({ object = footprint })
huts:axiom(source("huts.geojson"), function(hut)
  return footprint(hut.geometry, { color = hut["roof:colour"] and "red" }), Walls(hut.height)
end)
huts:interpret("Walls(height)", function(this, height) this:walls({ height = height }) end)
huts:derive()
"#;
    let folder = Folder::new().with("s.lua", script).with("huts.geojson", data.to_string());
    let outputs = ["-o", "a.gltf", "-o", "a.obj", "-o", "a.x3d", "-o", "a.city.json", "--strict"];
    let columns = |metadata: &str| {
        folder.burgeon(&[&["run", "s.lua", metadata], &outputs[..]].concat()).done();
        let properties = &read(&folder, "a.gltf")["extensions"]["EXT_structural_metadata"]["schema"]["classes"]
            ["huts"]["properties"];
        let properties: Vec<String> = properties.as_object().unwrap().keys().cloned().collect();
        properties.join(" ")
    };
    assert_eq!(columns("--metadata"), "id height roof_colour");
    assert_eq!(columns("--metadata=note,height_source"), "id height_source note");
    assert_eq!(columns("--metadata=*"), "id height height_source roof_colour note");
    // City objects have the attributes of their features.
    let hut = &read(&folder, "a.city.json")["CityObjects"]["hut"]["attributes"];
    assert_eq!(hut.as_object().unwrap().len(), 4, "{hut}");
    assert_snapshot!(folder.refuses(&["run", "s.lua", "-o", "a.glb", "--metadata=hight"]), @r"
    error: --metadata: no feature has an attribute named `hight`
      help: did you mean height?
    ");

    let said = folder.burgeon(&["run", "s.lua", "--json"]).done().json();
    let place = &said["place"];
    assert_eq!((&place["origin"], &place["axes"]), (&json!([0.0, 0.0]), &json!("x east, y north, z up (m)")));
    let crs = place["crs"].as_str().unwrap();
    assert!(crs.starts_with("+proj=tmerc +lat_0=60.1 +lon_0=24.9 "), "{crs}");
    let near = |key: &str, known: f64| (place[key].as_f64().unwrap() - known).abs() < 1e-6;
    assert!(near("longitude", 24.9) && near("latitude", 60.1), "{place}");
    let told = &read(&folder, "a.gltf")["asset"]["extras"]["place"];
    assert_eq!((&told["crs"], &told["axes"]), (&place["crs"], &json!("x east, y up, z south (m)")));
    let text = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let sentence = format!("The origin is at 0, 0 in {crs} (longitude 24.9, latitude 60.1).");
    assert!(text("a.obj").contains(&format!("# {sentence}")) && text("a.x3d").contains(&sentence), "{crs}");
    let summary = folder.burgeon(&["run", "s.lua"]).done().stderr;
    assert!(
        summary.contains(&format!("origin at 0, 0 in {crs} (longitude 24.9, latitude 60.1)")),
        "{summary}"
    );
}

#[test]
fn modules_of_a_query_are_things_of_their_own_with_their_ids_and_attributes() {
    let hut = |id: &str, x: f64, levels: i32| {
        json!({ "type": "Feature", "id": id, "properties": { "levels": levels, "note": id },
            "geometry": { "type": "Polygon", "coordinates": [[[x, 60.1], [x + 0.0002, 60.1], [x + 0.0002, 60.1001], [x, 60.1001], [x, 60.1]]] } })
    };
    let features = [hut("north", 24.9, 2), hut("south", 24.901, 5), hut("east", 24.902, 3)];
    let data = json!({ "type": "FeatureCollection", "features": features });
    let script = |axiom: &str| {
        format!(
            r#"source("huts.geojson")
local Town, Hut, Storey = module("Town"), module("Hut", "geom", "levels"), module("Storey", "geom", "number")
local post = lsystem({{ object = extruder() }})
post:axiom(Town())
post:interpret("Town", function(this) this:scale(0.1):extrude(4) end)
local model = post:derive()
local town = lsystem({{ object = extruder, city = "Building" }})
town:axiom({axiom})
town:rule("Town", function() return query("select id, geom, levels, note from huts where levels > 2", Hut) end)
town:rule("Hut(geom, levels)", function(this, geom, levels)
  if levels == 0 then
    return nil
  end
  return Storey(geom, levels), Hut(geom, levels - 1)
end)
town:interpret("Storey(geom, number)", function(this, geom, number)
  this:polygon(geom):jump({{ 0, 0, number * 3 }}):extrude(2.9)
  if number == 1 then
    this:jump(geom:centroid():place()):place(model)
  end
end)
town:derive(8)
"#
        )
    };
    for (axiom, expected) in [
        ("Town()", ["east", "south"].as_slice()),
        (r#"query("select id, geom, levels, note from huts", Hut)"#, &["east", "north", "south"]),
    ] {
        let folder = Folder::new().with("s.lua", script(axiom)).with("huts.geojson", data.to_string());
        let outputs = ["-o", "a.city.json", "-o", "a.gltf", "--metadata=*", "--strict"];
        folder.burgeon(&[&["run", "s.lua"], &outputs[..]].concat()).done();
        let city = read(&folder, "a.city.json");
        let objects = city["CityObjects"].as_object().unwrap();
        let buildings: Vec<&str> =
            objects.keys().map(String::as_str).filter(|id| !id.contains(' ')).collect();
        let buildings: Vec<&str> =
            buildings.into_iter().filter(|id| objects[*id]["type"] == "Building").collect();
        assert_eq!(buildings, expected, "{axiom}");
        for id in expected {
            let object = &objects[*id];
            assert_eq!(object["attributes"]["note"], **id);
            assert!(!object["geometry"].as_array().unwrap().is_empty(), "{id} has no geometry");
        }
        let model = read(&folder, "a.gltf");
        let nodes = model["nodes"].as_array().unwrap();
        let mut ids: Vec<&str> = nodes.iter().filter_map(|node| node["extras"]["feature"].as_str()).collect();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids, expected, "{axiom}");
        let table = &model["extensions"]["EXT_structural_metadata"]["propertyTables"][0];
        assert_eq!(
            (&table["count"], &table["properties"]["levels"]["values"].is_u64()),
            (&json!(expected.len()), &true)
        );
    }
}

#[test]
fn what_goes_out_without_a_meaning_says_so() {
    let told = |script: &str, output: &str| {
        let folder = Folder::new().with("s.lua", script);
        folder.burgeon(&["run", "s.lua", "--strict", "-o", output]).failed()
    };
    let plain = "local A = module('A')\nlocal s = lsystem({ object = turtle() })\ns:axiom(A())\ns:interpret('A', function(this) this:forward(1) end)\ns:derive()\n";
    assert_snapshot!(told(plain, "a.gpkg"), @r"
    error: s.lua:2:1: no layers to write: no module of the final chains has a geometry
      | local s = lsystem({ object = turtle() })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: pass a geometry, such as Lot(feature.geometry, area)
    ");
    let nowhere = "local A = module('A', 'shape')\nlocal s = lsystem()\ns:axiom(A(geometry('POINT (1 2)')))\ns:derive()\n";
    assert_snapshot!(told(nowhere, "a.geojson"), @r#"
    error: the model has no location on the earth, which GeoJSON needs
      help: read data with a location, source(FILE), or write a .gpkg, which accepts metres without a location
    "#);
    Folder::new().with("s.lua", nowhere).burgeon(&["run", "s.lua", "--strict", "-o", "a.gpkg"]).done();
    assert_snapshot!(told("lsystem({ city = 'Raod' })", "a.glb"), @r#"
    error: s.lua:1:19: lsystem: city: unknown CityJSON class "Raod"
      | lsystem({ city = 'Raod' })
      |                   ^^^^
      help: did you mean Road?
    "#);
    assert_snapshot!(told("print(panel({ surface = 'roof' }))", "a.glb"), @r#"
    error: s.lua:1:26: panel: surface must be "wall", "window" or "door", not "roof"
      | print(panel({ surface = 'roof' }))
      |                          ^^^^
      help: surface takes a string: Meaning of the panel and its model in city models: "wall", "window" or "door"
    "#);
}

/// Script of a prototype with a parameter: a system is derived for each of its values, with an object type in
/// Lua.
const LANTERNS: &str = r#"local lantern = object("lantern", {
  doc = "A street lantern.",
  extends = extruder,
  fields = { height = { default = 4, min = 1, max = 12, unit = "m", doc = "From the ground to the lamp." } },
  changes = {
    stand = function(self)
      return self:scale(0.06):extrude(self.height)
    end,
  },
})
local Stand, Lamp = module("Stand"), module("Lamp", "height", "x")
local prototypes = {}
for _, height in { 4, 6 } do
  local made = lsystem({ object = lantern({ height = height }) })
  made:axiom(Stand())
  made:interpret("Stand", function(this) this:stand() end)
  prototypes[height] = made:derive()
end
local street = lsystem({ object = turtle() })
street:axiom(Lamp(4, 0), Lamp(4, 5), Lamp(6, 10), Lamp(4, 15), Lamp(6, 20))
street:interpret("Lamp(height, x)", function(this, height, x)
  this:jump({ x, 0, 0 }):place(prototypes[height])
end)
street:derive()
"#;

#[test]
fn modules_become_instances_of_prototypes_and_stay_such() {
    let folder = Folder::new().with("s.lua", LANTERNS);
    folder.burgeon(&["run", "s.lua", "--strict", "-o", "a.x3d", "-o", "a.gltf", "-o", "a.city.json"]).done();
    let text = folder.read("a.x3d");
    assert_eq!((text.matches("<ProtoDeclare ").count(), text.matches("<ProtoInstance ").count()), (2, 5));
    assert_eq!(text.matches("<IndexedTriangleSet ").count(), 2);
    assert_eq!(read(&folder, "a.gltf")["meshes"].as_array().unwrap().len(), 2);
    let city = read(&folder, "a.city.json");
    assert_eq!(city["geometry-templates"]["templates"].as_array().unwrap().len(), 2);
    assert_eq!(city["CityObjects"]["system 3 chain 1"]["geometry"].as_array().unwrap().len(), 5);
}

/// Forty closed posts, of a model with caps, or without.
fn posts(caps: &str) -> Folder {
    let script = r#"local Post, Row = module("Post"), module("Row")
local posts = lsystem({ object = extruder({ sides = 4 }) })
posts:axiom(Post())
posts:interpret("Post", function(this) this:caps(CAPS, CAPS):extrude(2) end)
local post = posts:derive()
local rows = lsystem({ object = turtle() })
rows:axiom(Row())
rows:interpret("Row", function(this)
  for number = 1, 40 do this:jump({ number * 3, 0, 0 }):place(post) end
end)
rows:derive()
"#;
    Folder::new().with("s.lua", script.replace("CAPS", caps))
}

#[test]
fn open_edges_are_a_warning_of_the_run_and_prevent_a_strict_one() {
    for file in ["a.stl", "a.3mf", "a.ply"] {
        let closed = posts("true").burgeon(&["run", "s.lua", "--strict", "-o", file, "--json"]).done().json();
        assert_eq!(closed["warnings"], json!([]), "{file}");
        let folder = posts("false");
        let open = folder.burgeon(&["run", "s.lua", "-o", file, "--json"]).done().json();
        let message = open["warnings"][0]["message"].as_str().unwrap();
        // Each post has four open edges at each end.
        let begin = format!("{file}: 40 shapes are not closed, with 320 open edges (");
        assert!(message.starts_with(&begin), "{message}");
        let folder = posts("false");
        let refused = folder.burgeon(&["run", "s.lua", "--strict", "-o", file, "--json"]);
        assert_eq!(
            (refused.status, refused.json()["errors"][0]["code"].as_str()),
            (1, Some("warning.open-edges"))
        );
        assert!(!folder.path().join(file).exists(), "{file}");
    }
}

#[test]
fn the_run_states_the_storage_of_instances() {
    let note = |flags: &[&str]| {
        let run = posts("true")
            .burgeon(&[&["run", "s.lua", "-o", "a.glb", "--json"], flags].concat())
            .done()
            .json();
        run["notes"].as_array().unwrap().iter().map(|it| it.as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    let plain = ["a.glb: 40 repeated instances are plain nodes"];
    assert_eq!(note(&[]), plain);
    assert_eq!(note(&["--instances", "nodes"]), plain);
    assert_eq!(
        note(&["--instances", "extension"]),
        [
            "a.glb: 40 instances need EXT_mesh_gpu_instancing; for programs without it, use --instances nodes or expanded"
        ]
    );
    assert_eq!(note(&["--instances", "expanded"]), [""; 0]);
}

#[test]
fn drawings_for_cad_programs_have_a_layer_for_each_symbol() {
    let folder = folder();
    folder.burgeon(&["run", "s.lua", "-o", "a.dxf"]).done();
    let text = folder.read("a.dxf");
    assert!(text.contains("\n999\nMetres of EPSG:32632\n"), "{}", &text[..200]);
    assert_eq!(
        (text.matches("\nPOLYLINE\n8\nLOT\n").count(), text.matches("\nPOINT\n8\nMAST\n").count()),
        (2, 4)
    );
}
