//! Extracts of OpenStreetMap: choice of layers, and unusual data.

use insta::assert_snapshot;

use crate::data::{folder, told};

#[test]
fn extracts_of_openstreetmap() {
    assert_snapshot!(told(r#"source("town.osm.pbf")"#), @r#"
    error: in/s.lua:2:1: town.osm.pbf is an OpenStreetMap extract, which needs a layer
      | source("town.osm.pbf")
      | ^^^^^^^^^^^^^^^^^^^^^^
      help: specify a layer: "town.osm.pbf:buildings"; it has buildings, building_parts, roads, railways, squares, water, waterways, coastlines, green, landuse, trees, tree_rows, barriers, furniture; or select by tags: source("town.osm.pbf", { tags = { building = true } })
    "#);
    assert_snapshot!(told(r#"source("town.osm.pbf:houses")"#), @r#"
    error: in/s.lua:2:22: town.osm.pbf: no layer named `houses`
      | source("town.osm.pbf:houses")
      |                      ^^^^^^
      help: it has buildings, building_parts, roads, railways, squares, water, waterways, coastlines, green, landuse, trees, tree_rows, barriers, furniture; or select by tags: source("town.osm.pbf", { tags = { building = true } })
    "#);
    assert_snapshot!(told(r#"source("town.osm.pbf:buildings", { where = "floors > 10" })"#), @r#"
    error: in/s.lua:2:45: where "floors > 10" of town.osm.pbf:buildings: no such column: floors
      | source("town.osm.pbf:buildings", { where = "floors > 10" })
      |                                             ^^^^^^^^^^^
      help: write an SQL condition on the layer's columns, such as where = "height > 10"
    "#);
    assert_snapshot!(told(r#"source("town.osm.pbf", { tags = "building" })"#), @r#"
    error: in/s.lua:2:1: source: tags must be a table, not a string
      | source("town.osm.pbf", { tags = "building" })
      | ^^^^^^
      help: write { tags = { building = true, ["roof:shape"] = { "gabled", "hipped" } } }: true for any value but no, "*" for any, false for none, a text, or a list of strings; a list of such tables for one or another
    "#);
    assert_snapshot!(told(r#"source("town.osm.pbf", { tags = {} })"#), @r#"
    error: in/s.lua:2:1: source: tags is empty, which chooses nothing
      | source("town.osm.pbf", { tags = {} })
      | ^^^^^^
      help: write { tags = { building = true, ["roof:shape"] = { "gabled", "hipped" } } }: true for any value but no, "*" for any, false for none, a text, or a list of strings; a list of such tables for one or another
    "#);
    assert_snapshot!(told(r#"source("town.osm.pbf", { tags = { building = { a = 1 } } })"#), @r#"
    error: in/s.lua:2:1: source: tags: building is a table that is no list of texts
      | source("town.osm.pbf", { tags = { building = { a = 1 } } })
      | ^^^^^^
      help: write { tags = { building = true, ["roof:shape"] = { "gabled", "hipped" } } }: true for any value but no, "*" for any, false for none, a text, or a list of strings; a list of such tables for one or another
    "#);
    assert_snapshot!(told(r#"source("town.osm.pbf", { tags = { "building" } })"#), @r#"
    error: in/s.lua:2:1: source: a list of tags must have tables, not a string
      | source("town.osm.pbf", { tags = { "building" } })
      | ^^^^^^
      help: write { tags = { building = true, ["roof:shape"] = { "gabled", "hipped" } } }: true for any value but no, "*" for any, false for none, a text, or a list of strings; a list of such tables for one or another
    "#);
    assert_snapshot!(told(r#"source("town.osm.pbf", { tags = { { building = true }, height = "*" } })"#), @r#"
    error: in/s.lua:2:1: source: tags is a list of tables and has keys too
      | source("town.osm.pbf", { tags = { { building = true }, height = "*" } })
      | ^^^^^^
      help: write { tags = { building = true, ["roof:shape"] = { "gabled", "hipped" } } }: true for any value but no, "*" for any, false for none, a text, or a list of strings; a list of such tables for one or another
    "#);
    assert_snapshot!(told(r#"source("town.osm.pbf", { tags = { aeroway = true } })"#), @r#"
    error: in/s.lua:2:26: no feature of town.osm.pbf has these tags
      | source("town.osm.pbf", { tags = { aeroway = true } })
      |                          ^^^^
      help: look up the tags: https://wiki.openstreetmap.org/wiki/Map_features
    "#);
    assert_snapshot!(told(r#"source("town.osm.pbf:buildings", { within = { 1, 2 } })"#), @r#"
    error: in/s.lua:2:1: source: within must be { west, south, east, north }, the lesser number first
      | source("town.osm.pbf:buildings", { within = { 1, 2 } })
      | ^^^^^^
      help: write { within = { 24.94, 60.16, 24.95, 60.17 } }, in the coordinates of the file
    "#);
    assert_snapshot!(told(r#"source("town.osm.pbf:buildings", { within = { 1, 2, 3, 4 } })"#), @r#"
    error: in/s.lua:2:36: no feature of town.osm.pbf:buildings touches within = { 1, 2, 3, 4 }
      | source("town.osm.pbf:buildings", { within = { 1, 2, 3, 4 } })
      |                                    ^^^^^^
      help: within is { west, south, east, north } in the coordinates of the file; run burgeon sources FILE to list them
    "#);
    assert_snapshot!(told(r#"source("village.geojson", { tags = { building = true } })"#), @r#"
    error: in/s.lua:2:29: village.geojson is GeoJSON, so tags are not allowed
      | source("village.geojson", { tags = { building = true } })
      |                             ^^^^
      help: tags are only for OpenStreetMap extracts (.osm.pbf and .osm); remove them
    "#);
    let script = r#"
local houses = source("town.osm.pbf", { tags = { { building = { "house", "hut" } }, { building = true, height = "*" } } })
local all = source("town.osm.pbf:buildings")
local roads = source("town.osm.pbf", { tags = { highway = true, bridge = false }, kind = "line" })
print(#houses, #all, #roads, houses.features[1].id, houses.features[1].levels, houses.features[1].roof_shape)
print(all.features[2].id, #all.features[2].geometry.rings, roads.features[1].width + 1)
"#;
    let said = folder().with("in/s.lua", script).burgeon(&["run", "in/s.lua"]).done().stderr;
    assert!(said.starts_with("1\t2\t1\tway/1\t2\tgabled\nrelation/1\t2\t8\n"), "{said}");
    for told in [
        "relation/2 of town.osm.pbf:buildings lacks its part way/77",
        "1 line ends at the boundary of the extract",
    ] {
        assert!(said.contains(told), "{said}");
    }
}
