//! Street networks that grow from existing streets: faulty streets, and results.

use insta::assert_snapshot;

use crate::networks::grown;
use crate::support::{Folder, printed, refused, without_columns};
use crate::warnings::{silent, warned};

#[test]
fn streets_are_probed_and_walked_and_those_that_are_there_are_grown_onto() {
    let script = r#"
local F, Turn90 = module("F", "length"), module("Turn90")
local known = { { lines = { { { 0, 300 }, { 400, 300 } }, { { 200, 300 }, { 200, 420 } } }, depth = 1 } }
local s = lsystem({ object = network({ existing = known, shorten = false, obstacles = { { { 300, -50 }, { 360, -50 }, { 360, 50 }, { 300, 50 } } }, bend = 0 }), interpret = "last" })
s:axiom(F(100), { Turn90(), F(80), F(80), F(130) }, F(100), F(100))
s:interpret("F(length)", function(this, length)
  this:walk(length)
end)
s:interpret("Turn90", function(this)
  this:turn(90)
end)
local roads = s:derive(0).objects[1]
local function told(street)
  return `{street.outcome} {street.built} at {street.place.x}, {street.place.y}, junction {street.junction}`
end
print(roads:size(), roads:dead_ends(), roads:degree(1))
print(told(roads:probe(1, 180, 100, 0)))
print(told(roads:probe(1, 180, 5, 0)))
print(told(roads:probe(1, 90, 290, 0)))
for _, open in roads:open_ends() do
  print(`{open.place.x}, {open.place.y} to {math.floor(open.heading + 0.5)}, depth {open.depth}`)
end
local of = roads:measures()
print(of.length, of.dead_ends, of.segment, of.block)
"#;
    assert_snapshot!(printed(script).join("\n"), @r"
    9	5	1
    built true at -100, 0, junction nil
    too short false at 0, 0, junction nil
    snapped true at 0, 300, junction 2
    0, 0 to -180, depth 0
    0, 300 to -180, depth 1
    400, 300 to 0, depth 1
    200, 420 to 90, depth 1
    200, 0 to 0, depth 0
    1020	0.625	100	0
    ");
}

#[test]
fn existing_streets_that_cannot_be_are_told() {
    assert_snapshot!(refused("network({ existing = { { lines = { { 0, 0 }, { 90, 0 } }, dept = 1 } } })"), @r"
    error: s.lua:1:59: network: existing must be a list whose item 1 is a street (unknown field `dept` in a street of network { existing = ... }), not {dept=1,lines={{0,0},{90,0}}}
      | network({ existing = { { lines = { { 0, 0 }, { 90, 0 } }, dept = 1 } } })
      |                                                           ^^^^
      help: existing takes { { [string]: any } }, {} unless given: Existing streets, which stay unchanged regardless of the constraints: a list of { lines = ..., depth = ...,
    ");
    assert_snapshot!(refused("network({ existing = { { lines = 3 } } })"), @r"
    error: s.lua:1:1: network: existing must be a list whose item 1 is a street (a street of network { existing = ... }: lines must be a source of lines, a list of lines, or a list of points, not 3), not {lines=3}
      | network({ existing = { { lines = 3 } } })
      | ^^^^^^^
      help: existing takes { { [string]: any } }, {} unless given: Existing streets, which stay unchanged regardless of the constraints: a list of { lines = ..., depth = ...,
    ");
    assert_snapshot!(refused("network({ max_segments = 1, existing = { { lines = { { 0, 0 }, { 90, 0 }, { 90, 90 } } } } })"), @r"
    error: s.lua:1:29: the existing streets have more than 1 segments, which is the limit
      | network({ max_segments = 1, existing = { { lines = { { 0, 0 }, { 90, 0 }, { 90, 90 } } } } })
      |                             ^^^^^^^^
      help: omit some streets, or raise network { max_segments = ... }
    ");
    let sharp = "existing = { { lines = { { { 0, 0 }, { 200, 0 } }, { { 0, 0 }, { 200, 50 } } } } }";
    silent(&[&grown(sharp, "this:grow(1, 180, 90, 0)")]);
    let named = "existing = { { lines = { { name = \"High Street\", width = \"broad\", geometry = line({ { 0, 0 }, { 0.001, 0 } }) }, \
                 { name = \"Hill\", width = \"7.5 m\", geometry = line({ { 0, 0 }, { 90, 0 } }) } }, width = \"width\" } }";
    let told = warned(&[&grown(named, "this:grow(1, 180, 90, 0)")]);
    for expected in [
        "s.lua:2: network: existing: 0.0 of 90.0 m of streets are missing in the network: High Street at 0.0, 0.0 (0.00 m, no length)",
        "s.lua:2: network: existing: 1 line has no usable width, e.g. \"broad\" of High Street",
    ] {
        assert!(without_columns(&told).contains(expected), "{told}");
    }
    assert_snapshot!(refused(&grown("", "this:walk(0)")), @r"
    error: s.lua:5:8: rule A (interpretation): network:walk: invalid street length 0 m
      | this:walk(0)
      |      ^^^^
      module: A, step 0
      help: use a length above 0
    ");
    assert_snapshot!(refused(&grown("", "this:probe(1, 0, -4, 0)")), @r"
    error: s.lua:5:8: rule A (interpretation): network:probe: invalid street of -4 m with the heading 0 degrees
      | this:probe(1, 0, -4, 0)
      |      ^^^^^
      module: A, step 0
      help: use a finite heading, and a length above 0
    ");
    assert_snapshot!(refused(&grown("", "this:move_to(9, 0)")), @r"
    error: s.lua:5:3: rule A (interpretation): unknown junction 9
      | this:move_to(9, 0)
      | ^^^^^^^^^^^^^^^^^^
      module: A, step 0
      help: junctions are numbered from 1 to 1: network:open_end returns the junction at the end of a street
    ");
}

#[test]
fn a_network_goes_out_as_layers_that_another_grows_from() {
    let script = r#"
        local Square, Side = module("Square"), module("Side")
        local kinds = { { name = "avenue", width = 20, lanes = 4 }, { width = 12 } }
        local places = { { 0, 0 }, { 200, 0 }, { 200, 160 }, { 0, 160 }, { 300, 0 } }
        local town = lsystem({ object = network({ streets = kinds, starts = places }) })
        town:axiom(Square(), Side())
        town:interpret("Square", function(this)
          for from = 1, 4 do
            this:grow_to(from, places[from % 4 + 1], if from == 1 then 0 else 1)
          end
        end)
        town:interpret("Side", function(this)
          this:grow_to(2, places[5], 0)
          this:grow(1, 180, 90, 1)
        end)
        local grown = town:derive(0).objects[1]
        source(grown:lots({ width = 20 }), { table = "lots" })
    "#;
    let again = r#"
        local count = { streets = 0, junctions = 0, blocks = 0, lots = 0 }
        local existing, length, ends, kinds = {}, 0, 0, {}
        for name in count do
          for _, feature in source("a.gpkg", { layer = name, crs = 3067 }) do
            count[name] += 1
            assert(feature.id ~= "")
            if name == "streets" then
              table.insert(existing, { lines = { feature.geometry }, depth = feature.depth })
              length += feature.length
              kinds[feature.kind] = (kinds[feature.kind] or 0) + feature.lanes
            elseif name == "junctions" then
              ends += feature.degree
            else
              assert(feature.area > 0 and feature.street_depth <= 1)
            end
          end
        end
        assert(count.blocks == 1 and count.lots > 8 and ends == 2 * count.streets and count.streets == 4, `{count.blocks} {count.lots} {ends}`)
        assert(kinds["avenue"] == 4 * 2 and kinds["kind 2"] > 0)
        local second = lsystem({ object = network({ existing = existing, snap = 8, min_length = 5 }) })
        second:axiom(module("Nothing")())
        local network = second:derive(0).objects[1]
        assert(math.abs(network:measures().length - length) < 0.01, `{length}`)
        assert(#network:streets() == count.streets and #network:junctions() == count.junctions)
    "#;
    let folder = Folder::new().with("s.lua", script).with("t.lua", again);
    folder.burgeon(&["run", "s.lua", "-o", "a.gpkg", "--strict"]).done();
    folder.burgeon(&["run", "t.lua", "--lod", "0"]).done();
}
