//! Street networks: errors, and outcomes of proposed streets.

use insta::assert_snapshot;

use crate::support::{Folder, printed, refused, without_columns};
use crate::warnings::{silent, warned};

/// Returns a script with one proposed street in a network with these fields.
pub(crate) fn grown(fields: &str, proposal: &str) -> String {
    format!(
        "local A = module(\"A\")\nlocal s = lsystem({{ object = network({{ {fields} }}) }})\ns:axiom(A())\n\
         s:interpret(\"A\", function(this)\n  {proposal}\nend)\ns:derive(0)"
    )
}

/// Returns a folder with a script that uses the library of roads.
fn with_roads(script: &str) -> Folder {
    let script = format!("local roads = require(\"templates/roads\")\n{script}\n");
    Folder::new().with_roads().with("s.lua", script)
}

/// Returns the error message for a script that uses the library of roads.
fn refused_by_roads(script: &str) -> String {
    with_roads(script).refuses(&["run", "s.lua"])
}

#[test]
fn fields_given_through_the_library_of_roads_are_refused_in_the_line_of_the_script() {
    let options = "{\n  network = { min_lenght = 3 },\n}";
    for function in ["grow", "system", "word"] {
        let said = refused_by_roads(&format!(
            "local function town()\n  return roads.{function}({options})\nend\ntown()"
        ));
        let expected = "error: s.lua:3: unknown field `min_lenght` in network\n";
        assert!(without_columns(&said).starts_with(expected), "{function}: {said}");
        assert!(said.contains("help: did you mean min_length?"), "{function}: {said}");
    }
    assert_snapshot!(refused_by_roads("roads.grow({ network = { snap = 3, clearance = 6 } })"), @r"
    error: s.lua:2:14: network: snap (3 m) is less than clearance (6 m), so a street that ends between the two can neither join nor remain
      | roads.grow({ network = { snap = 3, clearance = 6 } })
      |              ^^^^^^^
      help: use a greater snap, or a smaller clearance
    ");
    assert_snapshot!(refused_by_roads("roads.grow({ network = { streets = { { width = \"wide\" } } } })"), @r#"
    error: s.lua:2:49: network: streets must be a list whose item 1 is a street type (street: width must be a number, not "wide"), not {width="wide"}
      | roads.grow({ network = { streets = { { width = "wide" } } } })
      |                                                 ^^^^
      help: streets takes { { name: string?, width: number?, asphalt: Color?, sidewalk: number?, lanes: number?, median: number?, parking: number?, trees: number?, lamps: number? } }, { {}, {}, {} } unless given: Street types, by depth from 0
    "#);
    assert_snapshot!(refused_by_roads("roads.word({ network = { streets = { { width = 0 } } } })"), @r"
    error: s.lua:2:14: network: streets: kind 1: width must be from 2 to 200 m, not 0
      | roads.word({ network = { streets = { { width = 0 } } } })
      |              ^^^^^^^
      help: streets takes { { name: string?, width: number?, asphalt: Color?, sidewalk: number?, lanes: number?, median: number?, parking: number?, trees: number?, lamps: number? } }, { {}, {}, {} } unless given: Street types, by depth from 0
    ");
}

#[test]
fn a_word_tells_which_of_its_streets_are_missing_and_why() {
    let word = |width: u32| {
        with_roads(&format!(
            "local roads = roads.word({{ axiom = \"X\", productions = {{ X = \"F[+X]F[-X]+X\" }}, iterations = 5, bend = 20, \
             split = \"plain\", network = {{ streets = {{ {{ width = {width} }} }} }} }}):derive(5).objects[1]\nprint(roads:size())"
        ))
        .burgeon(&["run", "s.lua"])
        .done()
        .stderr
    };
    let narrow = word(4);
    let size: usize = narrow.lines().next().and_then(|line| line.parse().ok()).expect("a number");
    assert!(size > 40, "{narrow}");
    assert!(narrow.contains(" of 242 streets were added"), "{narrow}");
    assert!(word(16).contains("corners ("), "{}", word(16));
}

#[test]
fn a_symbol_without_a_production_or_a_meaning_is_copied() {
    let word = |production: &str| {
        with_roads(&format!(
            "local roads = roads.word({{ axiom = \"X\", productions = {{ X = \"{production}\" }}, iterations = 3, bend = 90 }})\n\
             print(roads:derive(3).objects[1]:size())"
        ))
        .burgeon(&["run", "s.lua"])
        .done()
        .stderr
    };
    assert_eq!(word("AF+ßX.").lines().next(), word("F+X").lines().next());
}

#[test]
fn exits_end_at_their_rim() {
    let square = "polygon({ { -500, -420 }, { 450, -470 }, { 520, 460 }, { -480, 500 } })";
    for rim in ["480", square] {
        let said = with_roads(&format!(
            "local rim = {rim}\n\
             local town = roads.grow({{ extent = 250, dead_ends = \"remove\", exits = {{ count = 4, rim = rim }} }}).objects[1]\n\
             local ends = town:open_ends()\n\
             for _, e in ends do\n\
               local x, y = e.place.x, e.place.y\n\
               local off = if type(rim) == \"number\" then math.abs(math.sqrt(x * x + y * y) - rim) else rim:boundary():distance(point(x, y))\n\
               assert(off < 0.01, `{{x}}, {{y}} is {{off}} m off`)\n\
             end\n\
             print(#ends)"
        ))
        .burgeon(&["run", "s.lua", "--seed", "3"])
        .done();
        assert!(said.stderr.starts_with("4\n"), "{rim}: {}", said.stderr);
    }
}

#[test]
fn a_rim_that_is_not_convex_is_refused() {
    let rim = "polygon({ { 0, 0 }, { 400, 0 }, { 100, 100 }, { 0, 400 } })";
    assert_snapshot!(refused_by_roads(&format!("roads.grow({{ exits = {{ rim = {rim} }} }})")), @r"
    error: s.lua:2:7: roads.grow: exits: rim must be a distance (m) or a convex polygon
      | roads.grow({ exits = { rim = polygon({ { 0, 0 }, { 400, 0 }, { 100, 100 }, { 0, 400 } }) } })
      |       ^^^^
    ");
}

#[test]
fn fields_that_contradict_one_another_are_refused() {
    assert_snapshot!(refused("network({ snap = 3, clearance = 6 })"), @r"
    error: s.lua:1:1: network: snap (3 m) is less than clearance (6 m), so a street that ends between the two can neither join nor remain
      | network({ snap = 3, clearance = 6 })
      | ^^^^^^^
      help: use a greater snap, or a smaller clearance
    ");
    assert_snapshot!(refused("network({ min_angle = 120 })"), @r"
    error: s.lua:1:1: network: min_angle must be from 10 to 90, not 120
      | network({ min_angle = 120 })
      | ^^^^^^^
      help: min_angle takes a number, 45 unless given: Minimum angle (degrees) between two streets at a junction
    ");
    assert_snapshot!(refused("network({ min_lenght = 3 })"), @r"
    error: s.lua:1:11: unknown field `min_lenght` in network
      | network({ min_lenght = 3 })
      |           ^^^^^^^^^^
      help: did you mean min_length?
    ");
}

#[test]
fn kinds_of_streets_whose_parts_do_not_fit_are_refused() {
    let street =
        |fields: &str| refused(&format!("network({{ streets = {{ {{ width = 14 }}, {{ {fields} }} }} }})"));
    assert_snapshot!(refused("network({ streets = {} })"), @r"
    error: s.lua:1:1: network: streets contains no street type
      | network({ streets = {} })
      | ^^^^^^^
      help: write streets = { { width = 20 }, { width = 14 } }
    ");
    assert_snapshot!(street("width = 0"), @r"
    error: s.lua:1:1: network: streets: kind 2: width must be from 2 to 200 m, not 0
      | network({ streets = { { width = 14 }, { width = 0 } } })
      | ^^^^^^^
      help: streets takes { { name: string?, width: number?, asphalt: Color?, sidewalk: number?, lanes: number?, median: number?, parking: number?, trees: number?, lamps: number? } }, { {}, {}, {} } unless given: Street types, by depth from 0
    ");
    assert_snapshot!(street("width = -3"), @r"
    error: s.lua:1:1: network: streets: kind 2: width must be from 2 to 200 m, not -3
      | network({ streets = { { width = 14 }, { width = -3 } } })
      | ^^^^^^^
      help: streets takes { { name: string?, width: number?, asphalt: Color?, sidewalk: number?, lanes: number?, median: number?, parking: number?, trees: number?, lamps: number? } }, { {}, {}, {} } unless given: Street types, by depth from 0
    ");
    assert_snapshot!(street("width = 0 / 0"), @r"
    error: s.lua:1:1: network: streets must be a list whose item 2 is a street type (street: width must be a finite number, not NaN), not {width=nan}
      | network({ streets = { { width = 14 }, { width = 0 / 0 } } })
      | ^^^^^^^
      help: streets takes { { name: string?, width: number?, asphalt: Color?, sidewalk: number?, lanes: number?, median: number?, parking: number?, trees: number?, lamps: number? } }, { {}, {}, {} } unless given: Street types, by depth from 0
    ");
    assert_snapshot!(street("width = 12, sidewalk = 6"), @r"
    error: s.lua:1:1: network: streets: kind 2: sidewalk = 6 on both sides leaves 0.00 m of width = 12 for the carriageway
      | network({ streets = { { width = 14 }, { width = 12, sidewalk = 6 } } })
      | ^^^^^^^
      help: leave at least 2 m between the sidewalks
    ");
    assert_snapshot!(street("width = 12, sidewalk = -1"), @r"
    error: s.lua:1:1: network: streets: kind 2: sidewalk must be from 0 to 50 m, not -1
      | network({ streets = { { width = 14 }, { width = 12, sidewalk = -1 } } })
      | ^^^^^^^
      help: streets takes { { name: string?, width: number?, asphalt: Color?, sidewalk: number?, lanes: number?, median: number?, parking: number?, trees: number?, lamps: number? } }, { {}, {}, {} } unless given: Street types, by depth from 0
    ");
    assert_snapshot!(street("width = 12, sidewalk = 2, lanes = 6"), @r"
    error: s.lua:1:1: network: streets: kind 2: lanes = 6 does not fit: 8.00 m remains for the lanes, 1.33 m for each
      | network({ streets = { { width = 14 }, { width = 12, sidewalk = 2, lanes = 6 } } })
      | ^^^^^^^
      help: 4 fit, each at least 2 m wide
    ");
    assert_snapshot!(street("width = 12, lanes = 0"), @r"
    error: s.lua:1:1: network: streets: kind 2: lanes must be from 1 to 24, not 0
      | network({ streets = { { width = 14 }, { width = 12, lanes = 0 } } })
      | ^^^^^^^
      help: streets takes { { name: string?, width: number?, asphalt: Color?, sidewalk: number?, lanes: number?, median: number?, parking: number?, trees: number?, lamps: number? } }, { {}, {}, {} } unless given: Street types, by depth from 0
    ");
    assert_snapshot!(street("width = 12, median = 9"), @r"
    error: s.lua:1:1: network: streets: kind 2: median = 9 does not fit into a carriageway of 7.20 m
      | network({ streets = { { width = 14 }, { width = 12, median = 9 } } })
      | ^^^^^^^
      help: leave at least 2 m for a lane on each side of it
    ");
    assert_snapshot!(street("width = 24, median = 2, lanes = 3"), @r"
    error: s.lua:1:1: network: streets: kind 2: with a median, lanes = 3 cannot be divided into two directions
      | network({ streets = { { width = 14 }, { width = 24, median = 2, lanes = 3 } } })
      | ^^^^^^^
      help: use an even number of lanes, or remove the median
    ");
    assert_snapshot!(street("width = 12, parking = 3.5"), @r"
    error: s.lua:1:1: network: streets: kind 2: parking = 3.5 on both sides leaves 0.20 m of a carriageway of 7.20 m
      | network({ streets = { { width = 14 }, { width = 12, parking = 3.5 } } })
      | ^^^^^^^
      help: leave at least 2 m between the parking strips
    ");
    assert_snapshot!(street("width = 12, sidewalk = 0, trees = 9"), @r"
    error: s.lua:1:1: network: streets: kind 2: trees need a sidewalk of 1 m, not 0 m
      | network({ streets = { { width = 14 }, { width = 12, sidewalk = 0, trees = 9 } } })
      | ^^^^^^^
      help: use a wider sidewalk, or set them to 0
    ");
    assert_snapshot!(street("width = 12, lamps = 0.2"), @r"
    error: s.lua:1:1: network: streets: kind 2: lamps must be from 1 to 1000 m, not 0.2
      | network({ streets = { { width = 14 }, { width = 12, lamps = 0.2 } } })
      | ^^^^^^^
      help: it is the distance between them along the street; 0 for none
    ");
    assert_snapshot!(street("width = 12, lane = 2"), @r"
    error: s.lua:1:53: network: streets must be a list whose item 2 is a street type (unknown field `lane` in street), not {lane=2,width=12}
      | network({ streets = { { width = 14 }, { width = 12, lane = 2 } } })
      |                                                     ^^^^
      help: streets takes { { name: string?, width: number?, asphalt: Color?, sidewalk: number?, lanes: number?, median: number?, parking: number?, trees: number?, lamps: number? } }, { {}, {}, {} } unless given: Street types, by depth from 0
    ");
    assert_snapshot!(refused("network({ streets = { 14 } })"), @r"
    error: s.lua:1:1: network: streets must be a list whose item 1 is a table of a street's fields: { width = 14, lanes = 2 }, not 14
      | network({ streets = { 14 } })
      | ^^^^^^^
      help: streets takes { { name: string?, width: number?, asphalt: Color?, sidewalk: number?, lanes: number?, median: number?, parking: number?, trees: number?, lamps: number? } }, { {}, {}, {} } unless given: Street types, by depth from 0
    ");
}

#[test]
fn a_street_does_not_begin_in_an_obstacle() {
    assert_snapshot!(
        refused("network({ obstacles = { { { -5, -5 }, { 5, -5 }, { 5, 5 }, { -5, 5 } } } })"), @r"
    error: s.lua:1:1: network: starts: street start [0, 0] is in an obstacle
      | network({ obstacles = { { { -5, -5 }, { 5, -5 }, { 5, 5 }, { -5, 5 } } } })
      | ^^^^^^^
      help: start elsewhere, or remove the obstacle
    ");
    assert_snapshot!(refused("network({ starts = { { 0, 0 / 0 } } })"), @r"
    error: s.lua:1:1: network: starts must be a list whose item 1 is a vector of finite numbers, not {0,nan}
      | network({ starts = { { 0, 0 / 0 } } })
      | ^^^^^^^
      help: starts takes { Vector }: Start positions of streets (m): junctions 1, 2, 3 and so on
    ");
    assert_snapshot!(refused("network({ starts = { { 1e9, 0 } } })"), @r"
    error: s.lua:1:1: network: starts: invalid street position [1000000000, 0]
      | network({ starts = { { 1e9, 0 } } })
      | ^^^^^^^
      help: use finite positions within 500 km of the origin
    ");
}

#[test]
fn a_proposal_that_cannot_be_is_refused_with_its_line() {
    assert_snapshot!(refused(&grown("", "this:grow(2, 0, 80, 0)")), @r"
    error: s.lua:5:3: rule A (interpretation): unknown junction 2
      | this:grow(2, 0, 80, 0)
      | ^^^^^^^^^^^^^^^^^^^^^^
      module: A, step 0
      help: junctions are numbered from 1 to 1: network:open_end returns the junction at the end of a street
    ");
    assert_snapshot!(refused(&grown("", "this:grow(1, 0, 0, 0)")), @r"
    error: s.lua:5:8: rule A (interpretation): network:grow: invalid street of 0 m with the heading 0 degrees
      | this:grow(1, 0, 0, 0)
      |      ^^^^
      module: A, step 0
      help: use a finite heading, and a length above 0
    ");
    assert_snapshot!(refused(&grown("", "this:grow(1, 0 / 0, 80, 0)")), @r"
    error: s.lua:5:8: rule A (interpretation): network:grow: heading must be a finite number, not NaN
      | this:grow(1, 0 / 0, 80, 0)
      |      ^^^^
      module: A, step 0
      help: write this:grow(junction: number, heading: number, length: number, depth: number)
    ");
    assert_snapshot!(
        refused(&grown("max_segments = 3", "for way = 0, 3 do this:grow(1, way * 90, 80, 0) end")), @r"
    error: s.lua:5:3: rule A (interpretation): the network has 3 street segments, which is the limit
      | for way = 0, 3 do this:grow(1, way * 90, 80, 0) end
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A, step 0
      help: grow fewer streets, or raise network { max_segments = ... }
    ");
    assert_snapshot!(refused(&grown("", "this:join_dead_ends(1e6)")), @r"
    error: s.lua:5:8: rule A (interpretation): network:join_dead_ends needs a radius from 0 to 2000 and a detour from 1 to 100
      | this:join_dead_ends(1e6)
      |      ^^^^^^^^^^^^^^
      module: A, step 0
      help: write this:join_dead_ends(radius: number? = 150, detour: number? = 2)
    ");
}

#[test]
fn rules_learn_in_the_next_step_what_became_of_a_street() {
    let script = r#"
local A = module("A", "junction", "heading", "length")
local pond = { { 200, -30 }, { 260, -30 }, { 260, 30 }, { 200, 30 } }
local s = lsystem({ object = network({ starts = { { 0, 0 }, { 0, 300 }, { 150, 0 } }, obstacles = { pond }, bend = 0 }) })
s:axiom(
  A(1, 90, 100), A(2, 270, 300), A(1, 60, 100), A(1, 0, 120), A(3, 0, 100), A(2, 0, 5),
  A(3, 90, 100), A(3, 180, 20), A(2, 45, 100)
)
s:interpret("A(junction, heading, length)", function(this, junction, heading, length)
  this:grow(junction, heading, length, 1)
end)
s:rule("A(junction, heading, length)", function(this, junction, heading, length)
  print(`{junction} {heading} {length}: {this:outcome(junction, heading)} {this:open_end(junction, heading)}`)
  return nil
end)
s:derive(1)
"#;
    assert_snapshot!(printed(script).join("\n"), @r"
    1 90 100: built 4
    2 270 300: snapped nil
    1 60 100: angle nil
    1 0 120: built 5
    3 0 100: shortened 6
    2 0 5: too short nil
    3 90 100: built 7
    3 180 20: snapped nil
    2 45 100: built 8
    ");
}

#[test]
fn a_network_of_which_no_street_is_built_says_why() {
    assert_snapshot!(warned(&[&grown("", "this:grow(1, 0, 1e9, 0)")]), @r#"
    local A = module("A")
    local s = lsystem({ object = network({  }) })
    s:axiom(A())
    s:interpret("A", function(this)
      this:grow(1, 0, 1e9, 0)
    end)
    s:derive(0)
    warning: s.lua:2:30: network: none of 1 proposed streets was built: outside
      | local s = lsystem({ object = network({  }) })
      |                              ^^^^^^^
      help: network:outcome returns the outcome of each
    "#);
}

#[test]
fn a_street_that_does_not_come_to_its_place_is_told() {
    let pond = "obstacles = { { { 80, -200 }, { 120, -200 }, { 120, 200 }, { 80, 200 } } }, bend = 0";
    let to = |x: f64| grown(pond, &format!("this:grow_to(1, {{ {x}, 0 }}, 0)"));
    silent(&[&to(60.0)]);
    assert_snapshot!(warned(&[&to(300.0), &to(1e9)]), @r#"
    local A = module("A")
    local s = lsystem({ object = network({ obstacles = { { { 80, -200 }, { 120, -200 }, { 120, 200 }, { 80, 200 } } }, bend = 0 }) })
    s:axiom(A())
    s:interpret("A", function(this)
      this:grow_to(1, { 300, 0 }, 0)
    end)
    s:derive(0)
    warning: s.lua:5:8: rule A (interpretation): network:grow_to: the street from 0.0, 0.0 to 300.0, 0.0 ends at 69.0, 0.0, before an obstacle
      | this:grow_to(1, { 300, 0 }, 0)
      |      ^^^^^^^
      module: A, step 0
      help: go around the obstacle, or remove the obstacle

    local A = module("A")
    local s = lsystem({ object = network({ obstacles = { { { 80, -200 }, { 120, -200 }, { 120, 200 }, { 80, 200 } } }, bend = 0 }) })
    s:axiom(A())
    s:interpret("A", function(this)
      this:grow_to(1, { 1000000000, 0 }, 0)
    end)
    s:derive(0)
    warning: s.lua:5:8: rule A (interpretation): network:grow_to: no street from 0.0, 0.0 to 1000000000.0, 0.0: outside
      | this:grow_to(1, { 1000000000, 0 }, 0)
      |      ^^^^^^^
      module: A, step 0
      help: choose a position within the `limit` of the network and within 500 km of the origin
    "#);
    let two =
        |y: f64| grown("", &format!("this:grow_to(1, {{ 90, 0 }}, 0) this:grow_to(1, {{ 40, {y} }}, 0)"));
    silent(&[&two(80.0)]);
    assert_snapshot!(warned(&[&two(38.0)]), @r#"
    local A = module("A")
    local s = lsystem({ object = network({  }) })
    s:axiom(A())
    s:interpret("A", function(this)
      this:grow_to(1, { 90, 0 }, 0) this:grow_to(1, { 40, 38 }, 0)
    end)
    s:derive(0)
    warning: s.lua:5:3: rule A (interpretation): network:grow_to: no street from 0.0, 0.0 to 40.0, 38.0: angle
      | this:grow_to(1, { 90, 0 }, 0) this:grow_to(1, { 40, 38 }, 0)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A, step 0
      help: choose another position, or set a smaller `min_angle`
    "#);
}

#[test]
fn highways_that_do_not_arrive_are_told() {
    let towns = |fields: &str, options: &str| {
        format!(
            "roads.grow({{ pattern = roads.raster(), network = {{ {fields} }}, centres = {{ {{ -600, 0 }}, {{ 600, 0 }} }}, {options}\n\
             extent = function(x, y) return (math.abs(x) - 600) ^ 2 + y ^ 2 < 150 ^ 2 end }})"
        )
    };
    let told = with_roads(&towns("", "")).burgeon(&["run", "s.lua", "--strict"]).done().stderr;
    assert!(!told.contains("warning"), "{told}");
    assert_snapshot!(refused_by_roads(&towns("", "steps = 12,")), @r"
    error: s.lua:2:7: roads.grow: the highway from centre 1 to centre 2, 1200 m, takes 15 steps or more, and there are 12; give more, or centres that are nearer
      | roads.grow({ pattern = roads.raster(), network = {  }, centres = { { -600, 0 }, { 600, 0 } }, steps = 12,
      |       ^^^^
    ");
    let lake = "obstacles = { { { -100, -900 }, { 100, -900 }, { 100, 900 }, { -100, 900 } } }";
    assert_snapshot!(with_roads(&towns(lake, "")).warned(&["run", "s.lua"]), @r"
    warning: templates/roads/highways.lua:125:14: rule Arrival(junction, heading, length, goal, tries) (interpretation): network:grow_to: no street from -113.0, -28.9 to 600.0, 0.0: obstacle
      | this:grow_to(junction, this:place(goal), 0)
      |      ^^^^^^^
      called at s.lua:2
      module: Arrival(8,-42.013161642443464,90,2,9), step 11
      help: go around the obstacle, or remove the obstacle
    ");
}

#[test]
fn areas_that_are_no_polygons_or_cross_themselves_are_told() {
    let told = |areas: &str| warned(&[&grown(areas, "this:grow(1, 180, 60, 0)")]);
    for name in ["obstacles", "water"] {
        let text = told(&format!("{name} = {{ {{ vec(10, 10), vec(40, 40), vec(40, 10), vec(10, 40) }} }}"));
        assert!(
            without_columns(&text)
                .contains(&format!("s.lua:2: network: {name}: an area is not a simple polygon")),
            "{text}"
        );
        assert!(text.contains("meet at (25.000, 25.000)"), "{text}");
    }
    let text = told("limit = { vec(0, 0), vec(100, 0), vec(200, 0) }");
    assert!(
        without_columns(&text).contains("s.lua:2: network: limit: skipped an area that is not a polygon"),
        "{text}"
    );
}

#[test]
fn what_stands_beside_streets_is_asked_for_by_name() {
    let kinds = "streets = { { width = 14, trees = 9, lamps = 16 } }";
    let script = grown(kinds, "this:grow(1, 0, 100, 0)")
        + r#".objects[1]
local function told(places)
  return #places, places[1].place.y, places[1].heading, places[1].street_depth
end
"#;
    let script = script.replace("s:derive(0).objects", "local roads = s:derive(0).objects");
    let asked = "print(told(roads:verge(\"tree\")))\nprint(told(roads:verge(\"lamp\")))";
    assert_snapshot!(printed(&format!("{script}{asked}")).join("\n"), @r"
    20	5.5	-90	0
    10	5	-90	0
    ");
    assert_snapshot!(refused(&format!("{script}roads:verge(\"bench\")")), @r#"
    error: s.lua:11:14: unknown object "bench" along streets
      | roads:verge("bench")
      |              ^^^^^
      help: use "tree" or "lamp"
    "#);
}

#[test]
fn blocks_around_one_another_that_are_too_many_to_be_compared_are_told() {
    let script = "local blocks, m = {}, 470 * 14 + 60\nfor i = 1, 470 do\n  local a, b = i * 14, i * 14 + 12\n\
        blocks[i] = polygon({ { a, a }, { m, a }, { m, b }, { b, b }, { b, m }, { a, m } })\nend\n\
        local A = module(\"A\")\nlocal s = lsystem({ object = network({}) })\ns:axiom(A())\n\
        s:interpret(\"A\", function(this) this:grow(1, 0, 60, 0) end)\nlocal streets = s:derive(0).objects[1]\n\
        print(#streets:lots({ blocks = blocks, elongation = 100, area = 1e5, reach = 1e5, all = true }))\n";
    let said = Folder::new().with("s.lua", script).burgeon(&["run", "s.lua"]);
    assert_eq!(said.status, 0, "{}", said.stderr);
    assert!(said.stderr.contains("only 100000 pairs were compared"), "{}", said.stderr);
}
