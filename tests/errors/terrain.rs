//! Errors of terrains: rules, views, terrain edits and queries.

use std::fmt::Write as _;

use crate::support::{Folder, refused};

/// Returns the error messages for terrains with these fields, each after the fields.
fn told(fields: &[&str]) -> String {
    let mut text = String::new();
    for fields in fields {
        let script = format!("local land = lsystem({{ object = terrain({{ {fields} }}) }})\nland:derive()\n");
        let _ = writeln!(text, "{fields}\n{}", refused(&script));
    }
    text
}

#[test]
fn rule_tables_are_checked_whole() {
    insta::assert_snapshot!(told(&[
        "size = 100",
        "rules = { A = { \"A\", \"A\", \"A\" } }",
        "rules = { Hill = { \"Hill\", \"Hil\", \"Hill\", \"Hill\" } }",
        "rules = { A = { \"A\", \"A\", \"A\", \"A\", chance = 1 } }",
        "rules = { A = { \"A\", \"A\", \"A\", \"A\", change = { 1, 2 } } }",
        "rules = { A = { \"A\", \"A\", \"A\", \"A\", change = { 1, 2, 3, { 5, 4 } } } }",
        "rules = { A = { \"A\", \"A\", \"A\", \"A\" } }, start = \"B\"",
        "rules = { { from = 2, rules = { A = { \"A\", \"A\", \"A\", \"A\" } } } }",
        "rules = 7",
    ]), @r#"
    size = 100
    error: s.lua:1:33: terrain: missing rules
      | local land = lsystem({ object = terrain({ size = 100 }) })
      |                                 ^^^^^^^
      help: write rules = { A = { "A", "A", "A", "A", change = { 1, -1, 0.5, -0.5 }, decay = 0.5 } }

    rules = { A = { "A", "A", "A" } }
    error: s.lua:1:53: terrain: rules must be a table whose rule for A has four symbols, one for each quadrant; it has 3, not {A={"A","A","A"}}
      | local land = lsystem({ object = terrain({ rules = { A = { "A", "A", "A" } } }) })
      |                                                     ^
      help: rules takes any, {} unless given: Rules that divide the cells: a rule table, a system, or a list of these by level

    rules = { Hill = { "Hill", "Hil", "Hill", "Hill" } }
    error: s.lua:1:53: terrain: rules must be a table with a rule for each symbol: the rule for Hill has the unknown symbol Hil (did you mean Hill?), not {Hill={"Hill","Hil","Hill","Hill"}}
      | local land = lsystem({ object = terrain({ rules = { Hill = { "Hill", "Hil", "Hill", "Hill" } } }) })
      |                                                     ^^^^
      help: rules takes any, {} unless given: Rules that divide the cells: a rule table, a system, or a list of these by level

    rules = { A = { "A", "A", "A", "A", chance = 1 } }
    error: s.lua:1:53: terrain: rules must be a table whose rules have change, decay and weight; the rule for A has chance, not {A={"A","A","A","A",chance=1}}
      | local land = lsystem({ object = terrain({ rules = { A = { "A", "A", "A", "A", chance = 1 } } }) })
      |                                                     ^
      help: rules takes any, {} unless given: Rules that divide the cells: a rule table, a system, or a list of these by level

    rules = { A = { "A", "A", "A", "A", change = { 1, 2 } } }
    error: s.lua:1:53: terrain: rules must be a table whose rule for A has change as a number, or a number or a range { min, max } for each quadrant, not {A={"A","A","A","A",change={1,2}}}
      | local land = lsystem({ object = terrain({ rules = { A = { "A", "A", "A", "A", change = { 1, 2 } } } }) })
      |                                                     ^
      help: rules takes any, {} unless given: Rules that divide the cells: a rule table, a system, or a list of these by level

    rules = { A = { "A", "A", "A", "A", change = { 1, 2, 3, { 5, 4 } } } }
    error: s.lua:1:33: terrain: rules must be a table whose rule for A has change as a number, or a number or a range { min, max } for each quadrant, not a table
      | local land = lsystem({ object = terrain({ rules = { A = { "A", "A", "A", "A", change = { 1, 2, 3, { 5, 4 } } } } }) })
      |                                 ^^^^^^^
      help: rules takes any, {} unless given: Rules that divide the cells: a rule table, a system, or a list of these by level

    rules = { A = { "A", "A", "A", "A" } }, start = "B"
    error: s.lua:1:33: terrain: no rule for the start symbol B
      | local land = lsystem({ object = terrain({ rules = { A = { "A", "A", "A", "A" } }, start = "B" }) })
      |                                 ^^^^^^^
      help: use A

    rules = { { from = 2, rules = { A = { "A", "A", "A", "A" } } } }
    error: s.lua:1:75: terrain: rules must be a list of rules that starts at level 0, in ascending order of levels, not {{from=2,rules={A={"A","A","A","A"}}}}
      | local land = lsystem({ object = terrain({ rules = { { from = 2, rules = { A = { "A", "A", "A", "A" } } } } }) })
      |                                                                           ^
      help: rules takes any, {} unless given: Rules that divide the cells: a rule table, a system, or a list of these by level

    rules = 7
    error: s.lua:1:33: terrain: rules must be a table of rules, such as { A = { "A", "B", "B", "A", change = { 1, -1, 0, 0.5 }, decay = 0.5 }, ... }, a system whose rules divide cells, or a list of { from = level, rules = ... }, not 7
      | local land = lsystem({ object = terrain({ rules = 7 }) })
      |                                 ^^^^^^^
      help: rules takes any, {} unless given: Rules that divide the cells: a rule table, a system, or a list of these by level
    "#);
}

#[test]
fn sizes_and_views_are_checked_with_their_numbers() {
    let rules = "rules = { A = { \"A\", \"A\", \"A\", \"A\" } }";
    insta::assert_snapshot!(told(&[
        &format!("size = 0, {rules}"),
        &format!("size = 1e7, levels = 28, {rules}"),
        &format!("levels = 40, {rules}"),
        rules,
        &format!("levels = 3, remap = {{ {{ 5, 0 }}, {{ 1, 2 }} }}, {rules}"),
        &format!("levels = 3, base = 10, {rules}"),
        &format!("levels = 3, covers = {{ {{ colour = \"#ffffff\" }} }}, {rules}"),
        &format!("levels = 3, covers = {{ {{ }}, {{ on = {{ symbols = {{ \"B\" }} }} }} }}, {rules}"),
        &format!("levels = 3, plants = {{ {{ density = 5 }} }}, {rules}"),
    ]), @r##"
    size = 0, rules = { A = { "A", "A", "A", "A" } }
    error: s.lua:1:33: terrain: size is 0 m
      | local land = lsystem({ object = terrain({ size = 0, rules = { A = { "A", "A", "A", "A" } } }) })
      |                                 ^^^^^^^
      help: use a length above 0 and up to 1e9 m

    size = 1e7, levels = 28, rules = { A = { "A", "A", "A", "A" } }
    error: s.lua:1:33: terrain: 72057594037927936 heights need 576.5 PB
      | local land = lsystem({ object = terrain({ size = 1e7, levels = 28, rules = { A = { "A", "A", "A", "A" } } }) })
      |                                 ^^^^^^^
      help: the maximum is 67108864 heights: use fewer levels, or focus on a part

    levels = 40, rules = { A = { "A", "A", "A", "A" } }
    error: s.lua:1:1: view: cells are divided 40 times in all
      | local land = lsystem({ object = terrain({ levels = 40, rules = { A = { "A", "A", "A", "A" } } }) })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: the maximum is 30

    rules = { A = { "A", "A", "A", "A" } }
    error: s.lua:1:33: terrain: nothing is expanded
      | local land = lsystem({ object = terrain({ rules = { A = { "A", "A", "A", "A" } } }) })
      |                                 ^^^^^^^
      help: set levels, or focus on a position: this:focus(x, y, view) in an interpretation rule

    levels = 3, remap = { { 5, 0 }, { 1, 2 } }, rules = { A = { "A", "A", "A", "A" } }
    error: s.lua:1:33: terrain: remap decreases from 5 to 1
      | local land = lsystem({ object = terrain({ levels = 3, remap = { { 5, 0 }, { 1, 2 } }, rules = { A = { "A", "A", "A", "A" } } }) })
      |                                 ^^^^^^^
      help: write remap = { { -100, 0 }, { 0, 10 }, { 100, 80 } }: pairs from lower to higher heights

    levels = 3, base = 10, rules = { A = { "A", "A", "A", "A" } }
    error: s.lua:1:33: terrain: base is 10 m, above the ground at its edge
      | local land = lsystem({ object = terrain({ levels = 3, base = 10, rules = { A = { "A", "A", "A", "A" } } }) })
      |                                 ^^^^^^^
      help: use a height below 0.0 m, or base = "auto"

    levels = 3, covers = { { colour = "#ffffff" } }, rules = { A = { "A", "A", "A", "A" } }
    error: s.lua:1:68: terrain: covers must be a list whose item 1 is a cover (unknown field `colour` in cover), not {colour="#ffffff"}
      | local land = lsystem({ object = terrain({ levels = 3, covers = { { colour = "#ffffff" } }, rules = { A = { "A", "A", "A", "A" } } }) })
      |                                                                    ^^^^^^
      help: covers takes { { color: Color?, on: Mask?, amount: number? } }, {} unless given: Ground covers, from bottom to top

    levels = 3, covers = { { }, { on = { symbols = { "B" } } } }, rules = { A = { "A", "A", "A", "A" } }
    error: s.lua:1:33: terrain: no rule produces B
      | local land = lsystem({ object = terrain({ levels = 3, covers = { { }, { on = { symbols = { "B" } } } }, rules = { A = { "A", "A", "A", "A" } } }) })
      |                                 ^^^^^^^
      help: the cells are A

    levels = 3, plants = { { density = 5 } }, rules = { A = { "A", "A", "A", "A" } }
    error: s.lua:1:33: terrain: plants must be a list whose item 1 is plants with at least one model: { models = { tree:derive() } }, not {density=5}
      | local land = lsystem({ object = terrain({ levels = 3, plants = { { density = 5 } }, rules = { A = { "A", "A", "A", "A" } } }) })
      |                                 ^^^^^^^
      help: plants takes { { models: { Model }, density: number?, on: Mask?, size: { number }?, sink: number? } }, {} unless given: Plants on the terrain
    "##);
}

/// Returns the error message for an interpretation rule that uses a terrain of 1024 m.
fn asked(body: &str) -> String {
    refused(&format!(
        "local Look = module(\"Look\")\n\
         local land = lsystem({{ object = terrain({{ levels = 4, rules = {{ A = {{ \"A\", \"A\", \"A\", \"A\" }} }} }}) }})\n\
         land:axiom(Look())\nland:interpret(\"Look()\", function(this) {body} end)\nland:derive()\n"
    ))
}

#[test]
fn what_lies_outside_is_told_where_it_is_asked() {
    let mut text = String::new();
    for body in [
        "this:focus(9000, 0, { cell = 128, rings = { { 2, 3 } } })",
        "this:focus(0, 0, { cell = 100, rings = { { 2, 3 } } })",
        "this:focus(0, 0, { cell = 128, rings = { { 4, 3 }, { 2, 1 } } })",
        "this:focus(0, 0, { cell = 1, rings = { { 1024, 12 } } })",
        "this:focus(0, 0)",
        "print(this:height({ 600, 0 }))",
        "this:flatten({ { 0, 0 }, { 1, 0 } })",
        "this:cut({ { 9000, 0, 3 }, { 9500, 0, 4 } }, 5)",
        "this:dig({ { 0, 0 }, { 9, 0 } }, 0, 4)",
        "this:river({ 0, 0 }, -2)",
    ] {
        let _ = writeln!(text, "{body}\n{}", asked(body));
    }
    insta::assert_snapshot!(text, @r#"
    this:focus(9000, 0, { cell = 128, rings = { { 2, 3 } } })
    error: s.lua:4:46: rule Look() (interpretation): the focus (9000, 0) is outside the terrain
      | land:interpret("Look()", function(this) this:focus(9000, 0, { cell = 128, rings = { { 2, 3 } } }) end)
      |                                              ^^^^^
      module: Look, step 0
      help: it extends from (-512, -512) to (512, 512) m

    this:focus(0, 0, { cell = 100, rings = { { 2, 3 } } })
    error: s.lua:4:1: rule Look() (interpretation): view: cells of 100 m do not divide a world of 1024 m
      | land:interpret("Look()", function(this) this:focus(0, 0, { cell = 100, rings = { { 2, 3 } } }) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: Look, step 0
      help: use the world's size divided by a power of two; the nearest is 128 m

    this:focus(0, 0, { cell = 128, rings = { { 4, 3 }, { 2, 1 } } })
    error: s.lua:4:46: rule Look() (interpretation): terrain:focus: view must be a view with growing rings that are divided less with distance, not {cell=128,rings={{4,3},{2,1}}}
      | land:interpret("Look()", function(this) this:focus(0, 0, { cell = 128, rings = { { 4, 3 }, { 2, 1 } } }) end)
      |                                              ^^^^^
      module: Look, step 0
      help: write this:focus(x: number, y: number, view: { cell: number, rings: { { number } } })

    this:focus(0, 0, { cell = 1, rings = { { 1024, 12 } } })
    error: s.lua:4:1: rule Look() (interpretation): terrain: 17592186044416 heights need 140.7 TB
      | land:interpret("Look()", function(this) this:focus(0, 0, { cell = 1, rings = { { 1024, 12 } } }) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: Look, step 0
      help: the maximum is 67108864 heights: use fewer levels, or focus on a part

    this:focus(0, 0)
    error: s.lua:4:46: rule Look() (interpretation): terrain:focus: view must be a view: { cell = 512, rings = { { 4, 8 }, { 8, 6 } } }, which divides the nearest 4 x 4 cells 8 times, not nothing
      | land:interpret("Look()", function(this) this:focus(0, 0) end)
      |                                              ^^^^^
      module: Look, step 0
      help: write this:focus(x: number, y: number, view: { cell: number, rings: { { number } } })

    print(this:height({ 600, 0 }))
    error: s.lua:4:1: rule Look() (interpretation): terrain: nothing is expanded at (600, 0)
      | land:interpret("Look()", function(this) print(this:height({ 600, 0 })) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: Look, step 0
      help: it extends from (-512, -512) to (512, 512) m; areas outside the focus are contracted

    this:flatten({ { 0, 0 }, { 1, 0 } })
    error: s.lua:4:1: rule Look() (interpretation): invalid terrain edit: the outline has fewer than three points
      | land:interpret("Look()", function(this) this:flatten({ { 0, 0 }, { 1, 0 } }) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: Look, step 0

    this:cut({ { 9000, 0, 3 }, { 9500, 0, 4 } }, 5)
    error: s.lua:4:1: rule Look() (interpretation): (8992.5, -7.5) is outside the terrain
      | land:interpret("Look()", function(this) this:cut({ { 9000, 0, 3 }, { 9500, 0, 4 } }, 5) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: Look, step 0
      help: it extends from (-512, -512) to (512, 512) m

    this:dig({ { 0, 0 }, { 9, 0 } }, 0, 4)
    error: s.lua:4:1: rule Look() (interpretation): invalid terrain edit: the width is 0
      | land:interpret("Look()", function(this) this:dig({ { 0, 0 }, { 9, 0 } }, 0, 4) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: Look, step 0

    this:river({ 0, 0 }, -2)
    error: s.lua:4:46: rule Look() (interpretation): terrain:river: width is -2 m
      | land:interpret("Look()", function(this) this:river({ 0, 0 }, -2) end)
      |                                              ^^^^^
      module: Look, step 0
      help: give metres above 0
    "#);
}

/// Returns the error message for a terrain that is divided by the rules `rules` of a system.
fn divided(rules: &str) -> String {
    refused(&format!(
        "local Hill = module(\"Hill\", \"height\")\nlocal Bush = module(\"Bush\")\nlocal cells = lsystem()\n{rules}\n\
         local land = lsystem({{ object = terrain({{ levels = 3, rules = cells }}) }})\nland:derive()\n"
    ))
}

#[test]
fn cells_that_a_system_divides_have_four_quadrants_and_a_height() {
    let mut text = String::new();
    for rules in [
        "cells:axiom(Hill(5)) cells:rule(\"Hill(h)\", function(this, h) return Hill(h), Hill(h), Hill(h) end)",
        "cells:axiom(Hill(5)) cells:rule(\"Hill(h)\", function(this, h) return nil end)",
        "cells:axiom(Hill(5)) cells:rule(\"Hill(h)\", function(this, h) return Hill(h), { Hill(h) }, Hill(h), Hill(h) end)",
        "cells:axiom(Hill(5)) cells:rule(\"Hill(h)\", function(this, h) return Hill(h), Hill(h), Hill(h), Bush() end)",
        "cells:axiom(Hill(5)) cells:rule(\"Hill(h)\", function(this, h) return Hill(h), Hill(h), Hill(h), Hill(1 / 0) end)",
        "cells:axiom(Hill(5)) cells:rule(\"Hill > Hill\", function(this) return nil end)",
        "cells:axiom(Hill(5), Hill(6))",
        "cells:axiom(Bush())",
        "",
    ] {
        let _ = writeln!(text, "{rules}\n{}", divided(rules));
    }
    insta::assert_snapshot!(text, @r#"
    cells:axiom(Hill(5)) cells:rule("Hill(h)", function(this, h) return Hill(h), Hill(h), Hill(h) end)
    error: s.lua:4:1: rule Hill(h): a cell must be replaced by four quadrants, not by 3 modules
      | cells:axiom(Hill(5)) cells:rule("Hill(h)", function(this, h) return Hill(h), Hill(h), Hill(h) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: Hill(5), step 1
      help: return four modules: north-west, north-east, south-west and south-east; or no value to keep the cell unchanged

    cells:axiom(Hill(5)) cells:rule("Hill(h)", function(this, h) return nil end)
    error: s.lua:4:1: rule Hill(h): a cell must be replaced by four quadrants, not by nothing
      | cells:axiom(Hill(5)) cells:rule("Hill(h)", function(this, h) return nil end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: Hill(5), step 1
      help: return four modules: north-west, north-east, south-west and south-east; or no value to keep the cell unchanged

    cells:axiom(Hill(5)) cells:rule("Hill(h)", function(this, h) return Hill(h), { Hill(h) }, Hill(h), Hill(h) end)
    error: s.lua:4:1: rule Hill(h): a cell must be replaced by four quadrants, not by 6 modules
      | cells:axiom(Hill(5)) cells:rule("Hill(h)", function(this, h) return Hill(h), { Hill(h) }, Hill(h), Hill(h) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: Hill(5), step 1
      help: return four modules: north-west, north-east, south-west and south-east; or no value to keep the cell unchanged

    cells:axiom(Hill(5)) cells:rule("Hill(h)", function(this, h) return Hill(h), Hill(h), Hill(h), Bush() end)
    error: s.lua:4:96: rule Hill(h): module Bush cannot be a terrain cell: missing parameter `height`
      | cells:axiom(Hill(5)) cells:rule("Hill(h)", function(this, h) return Hill(h), Hill(h), Hill(h), Bush() end)
      |                                                                                                ^^^^
      help: add it: module("Bush", "height", ...)

    cells:axiom(Hill(5)) cells:rule("Hill(h)", function(this, h) return Hill(h), Hill(h), Hill(h), Hill(1 / 0) end)
    error: s.lua:4:1: rule Hill(h): the height of Hill(inf) is not finite
      | cells:axiom(Hill(5)) cells:rule("Hill(h)", function(this, h) return Hill(h), Hill(h), Hill(h), Hill(1 / 0) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: set a height in metres for each quadrant

    cells:axiom(Hill(5)) cells:rule("Hill > Hill", function(this) return nil end)
    error: s.lua:3:7: rules for the cells of a terrain cannot have contexts
      | local cells = lsystem()
      |       ^^^^^
      help: write rules for single modules, without < and >

    cells:axiom(Hill(5), Hill(6))
    error: s.lua:3:1: a terrain must begin with one cell
      | local cells = lsystem()
      | ^^^^^^^^^^^^^^^^^^^^^^^
      help: use one module without branches as axiom: cells:axiom(Hill(0, 100))

    cells:axiom(Bush())
    error: s.lua:6:1: module Bush cannot be a terrain cell: missing parameter `height`
      | land:derive()
      | ^^^^^^^^^^^^^
      help: add it: module("Bush", "height", ...)


    error: s.lua:6:1: the system has no axiom
      | land:derive()
      | ^^^^^^^^^^^^^
      help: write system:axiom(A(1))
    "#);
}

#[test]
fn a_decay_that_does_not_converge_is_warned_of() {
    let folder = Folder::new().with(
        "s.lua",
        "local land = lsystem({ object = terrain({ levels = 3, rules = { A = { \"A\", \"A\", \"A\", \"A\", decay = 1.25 } } }) })\nland:derive()\n",
    );
    insta::assert_snapshot!(folder.warned(&["run", "s.lua"]), @r#"
    warning: s.lua:1:33: terrain: a decay of 1.25 does not converge: heights grow with every level
      | local land = lsystem({ object = terrain({ levels = 3, rules = { A = { "A", "A", "A", "A", decay = 1.25 } } }) })
      |                                 ^^^^^^^
      help: use a decay below 1, such as decay = 0.5
    "#);
}

/// Returns an ASCII grid of 33 by 33 samples, 10 m apart; the first sample is at the centre of its square.
fn grid() -> String {
    let height =
        |index: usize| 50.0 + ((index % 33) as f64 * 0.7).sin() * 20.0 + (index / 33 % 4) as f64 * 3.0;
    let heights: String = (0..33 * 33).map(|index| format!("{:.3}\n", height(index))).collect();
    format!("ncols 33\nnrows 33\nxllcorner -165\nyllcorner -165\ncellsize 10\n{heights}")
}

#[test]
fn cells_that_cannot_show_measured_samples_are_warned_of_and_the_ground_keeps_them_all() {
    let script = |levels: u32, more: &str| {
        format!(
            "local heights = elevation(\"a.asc\")\n\
             local land = lsystem({{ object = terrain({{ size = 300, levels = {levels}, elevation = heights{more} }}) }})\n\
             local ground = land:derive().objects[1]\n\
             for x = -140, 140, 10 do\n  for y = -140, 140, 10 do\n\
             assert(math.abs(ground:height({{ x, y }}) - heights:height({{ x, y }})) < 1e-3)\n  end\nend\n\
             if {levels} == 6 then\n  print(ground:height({{ 3, 4 }}))\nend\n"
        )
    };
    let rules =
        ", decay = 200, rules = { A = { \"A\", \"A\", \"A\", \"A\", change = { { -1, 1 }, 1, -1, 0.5 } } }";
    let folder = Folder::new()
        .with("a.asc", grid())
        .with("coarse.lua", script(3, ""))
        .with("rough.lua", script(7, rules))
        .with("smooth.lua", script(6, ""))
        .with("straight.lua", script(6, ", smooth = false"));
    insta::assert_snapshot!(folder.warned(&["run", "coarse.lua"]), @r"
    warning: coarse.lua:2:33: terrain: cells of 37.5 m cannot show samples that are 10 m apart: only height() returns each of them
      | local land = lsystem({ object = terrain({ size = 300, levels = 3, elevation = heights }) })
      |                                 ^^^^^^^
      help: write levels = 5 to show all of them
    ");
    let told = |name: &str| folder.burgeon(&["run", name, "--strict"]).done().stderr;
    let height = |name: &str| told(name).lines().next().and_then(|line| line.parse::<f64>().ok()).unwrap();
    assert!(!told("rough.lua").contains("warning"));
    // Position at 0.3 and 0.4 of the distance between four samples.
    let sample = |column: i32, row: i32| {
        grid().lines().nth((5 + row * 33 + column) as usize).unwrap().parse::<f64>().unwrap()
    };
    let (north, south) = ([sample(16, 15), sample(17, 15)], [sample(16, 16), sample(17, 16)]);
    let along = |[west, east]: [f64; 2]| west * 0.7 + east * 0.3;
    let straight = along(south) * 0.6 + along(north) * 0.4;
    assert!((height("straight.lua") - straight).abs() < 1e-4, "{} {straight}", height("straight.lua"));
    assert!((height("smooth.lua") - straight).abs() > 0.05);
}

#[test]
fn a_river_from_under_water_and_a_second_focus_are_warned_of() {
    let script = |options: &str, body: &str| {
        format!(
            "local Do = module(\"Do\")\n\
             local land = lsystem({{ object = terrain({{ {options}, rules = {{ A = {{ \"A\", \"A\", \"A\", \"A\", change = {{ 1, -1, 0, 0.5 }} }} }} }}) }})\n\
             land:axiom(Do())\nland:interpret(\"Do()\", function(this)\n{body}\nend)\nland:derive(0)\n"
        )
    };
    let view = "{ cell = 128, rings = { { 2, 3 } } }";
    let twice =
        format!("  this:focus(0, 0, {view})\n  this:focus(0, 0, {view})\n  this:focus(64, 0, {view})");
    let planet = "local Do = module(\"Do\")\n\
        local land = lsystem({ object = planet({ radius = 1000, levels = 6, rules = { A = { \"A\", \"A\", \"A\", \"A\" } } }) })\n\
        land:axiom(Do())\nland:interpret(\"Do()\", function(this)\n  this:focus(0, 0, 3000)\n  this:focus(0, 0, 2000)\nend)\nland:derive(0)\n";
    let folder = Folder::new()
        .with(
            "sea.lua",
            script("levels = 5, water = 500", "  this:river({ 10, 20 }, 5)\n  this:river({ 10, 20 }, 5)"),
        )
        .with("rim.lua", script("levels = 5", "  this:river({ 511, 20 }, 5)"))
        .with("focus.lua", script("size = 1024", &twice))
        .with("planet.lua", planet);
    let mut text = String::new();
    for name in ["sea.lua", "rim.lua", "focus.lua", "planet.lua"] {
        text += &folder.warned(&["run", name]);
    }
    insta::assert_snapshot!(text, @r"
    warning: sea.lua:5:8: rule Do() (interpretation): terrain:river: the source (10.0, 20.0) is 475.0 m under water, so no river is created (2 times)
      | this:river({ 10, 20 }, 5)
      |      ^^^^^
      module: Do, step 0
      help: use a position above the water: this:height({ x, y }) returns the height of the ground
    warning: rim.lua:5:8: rule Do() (interpretation): terrain:river: the source (511.0, 20.0) is at the edge of the map or at the shore, so no river is created
      | this:river({ 511, 20 }, 5)
      |      ^^^^^
      module: Do, step 0
      help: use a position farther up
    warning: focus.lua:7:8: rule Do() (interpretation): terrain:focus: this replaces the focus on (0, 0) in the same pass
      | this:focus(64, 0, { cell = 128, rings = { { 2, 3 } } })
      |      ^^^^^
      module: Do, step 0
      help: call focus once per pass: only the last call counts
    warning: planet.lua:6:8: rule Do() (interpretation): planet:focus: this replaces the focus on (0, 0, 3000) in the same pass
      | this:focus(0, 0, 2000)
      |      ^^^^^
      module: Do, step 0
      help: call focus once per pass: only the last call counts
    ");
}

const CUT: &str = "local Do = module(\"Do\")\n\
    local land = lsystem({ object = terrain({ size = SIZE, levels = 6, EDITS rules = { A = { \"A\", \"A\", \"A\", \"A\", change = { 3, -2, 1, 0 } } } }) })\n\
    land:axiom(Do())\nland:interpret(\"Do()\", function(this) BODY end)\nlocal made = land:derive(0)\n\
    print(made.objects[1]:height({ 3, 4 }))\n";

#[test]
fn edits_are_kept_in_a_file_and_are_those_of_one_world() {
    let script = |size: &str, edits: &str, body: &str| {
        CUT.replace("SIZE", size).replace("EDITS", edits).replace("BODY", body)
    };
    let square = "this:flatten({ { -50, -50 }, { 50, -50 }, { 50, 50 }, { -50, 50 } }, 12.5)";
    let kept = "edits = edits(\"kept.json\"),";
    let folder = Folder::new()
        .with("a.lua", script("1024", "", square))
        .with("b.lua", script("1024", kept, ""))
        .with("c.lua", script("2048", kept, ""))
        .with("d.lua", script("1024", "edits = edits(\"broken.json\"),", ""))
        .with("e.lua", "local nothing = 1")
        .with(
            "f.lua",
            script("1024", "edits = edits(\"drawn.json\"),", "")
                .replace("{ 3, -2, 1, 0 }", "{ { 1, 2 }, 0, 0, 0 }"),
        )
        .with("g.lua", script("1024", "", square).replace("{ 3, -2, 1, 0 }", "{ { 1, 2 }, 0, 0, 0 }"))
        .with("broken.json", "{ \"format\": 3");
    let height =
        |script: &str| folder.burgeon(&["run", script]).done().stderr.lines().next().map(str::to_owned);
    folder.burgeon(&["run", "a.lua", "--edits", "kept.json", "--heights", "a.r64"]).done();
    assert_eq!(height("a.lua").as_deref(), Some("12.5"));
    assert_eq!(height("b.lua").as_deref(), Some("12.5"));
    folder.burgeon(&["run", "b.lua", "--heights", "b.r64", "--edits", "again.json"]).done();
    let files = folder.files();
    assert_eq!(files["a.r64"], 64 * 64 * 8);
    assert_eq!(
        std::fs::read(folder.path().join("a.r64")).ok(),
        std::fs::read(folder.path().join("b.r64")).ok()
    );
    assert_eq!(folder.read("kept.json"), folder.read("again.json"));
    folder.burgeon(&["run", "g.lua", "--edits", "drawn.json"]).done();
    assert_eq!(height("f.lua").as_deref(), Some("12.5"));
    let mut text = folder.refuses(&["run", "c.lua"]);
    for arguments in [
        &["run", "d.lua"][..],
        &["run", "f.lua", "--seed", "3"],
        &["run", "e.lua", "--heights", "e.asc"],
        &["run", "a.lua", "--edits", "a.lua"],
    ] {
        text += &folder.refuses(arguments);
    }
    insta::assert_snapshot!(text, @r"
    error: c.lua:5:1: kept.json contains edits of another world: 1024 m from (-512, -512) on
      | local made = land:derive(0)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: this one is 2048 m from (-1024, -1024) on
    error: d.lua:5:1: broken.json contains no terrain edits: invalid type: integer `3`, expected a string at line 1 column 13
      | local made = land:derive(0)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: write such a file with burgeon run --edits FILE
    error: f.lua:5:1: drawn.json contains edits of another world: 1024 m from (-512, -512) on, seeded by e220a8397b1dcdaf
      | local made = land:derive(0)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: this one is 1024 m from (-512, -512) on, seeded by 1d0b14e4db018fed
    error: the script has no terrain whose heights or edits to write
      help: write lsystem({ object = terrain({ ... }) }):derive()
    error: the edits would overwrite the script a.lua
      help: specify another file: --edits ground.json, or - for standard output
    ");
}

#[test]
fn tiles_are_files_of_their_own_that_tell_where_they_are() {
    let script = "local Look = module(\"Look\")\n\
        local land = lsystem({ object = terrain({ rules = { A = { \"A\", \"A\", \"A\", \"A\", change = { 3, -2, 1, 0 } } } }) })\n\
        land:axiom(Look())\n\
        land:interpret(\"Look()\", function(this) this:focus(0, 0, { cell = 128, rings = { { 2, 4 }, { 4, 2 } } }) end)\n\
        land:derive(0)\n";
    let folder = Folder::new().with("s.lua", script);
    folder.burgeon(&["run", "s.lua", "--tiles", "tiles"]).done();
    let files = folder.files();
    let tiles: Vec<&String> = files.keys().filter(|name| name.starts_with("tiles/")).collect();
    assert_eq!(tiles.len(), 16);
    assert!(files["tiles/3_3_4.glb"] > files["tiles/3_2_2.glb"]);
    assert!(folder.refuses(&["run", "s.lua", "--tiles", "s.lua"]).contains("cannot create the folder s.lua"));
}

#[test]
fn a_script_that_asks_the_ground_can_be_checked() {
    let script = "local land = lsystem({ object = terrain({ levels = 3, rules = { A = { \"A\", \"A\", \"A\", \"A\", change = 1 } } }) })\n\
        local ground = land:derive().objects[1]\n\
        print(ground:height({ 3, 4 }) + ground:slope({ 3, 4 }), ground:symbol({ 3, 4 }))\n";
    let folder = Folder::new().with("s.lua", script);
    folder.burgeon(&["check", "s.lua"]).done();
    assert!(folder.burgeon(&["run", "s.lua"]).done().stderr.starts_with("175\tA\n"));
}

#[test]
fn an_automatic_underside_is_below_the_lowest_ground() {
    let script = "\
local function cell(low)
  local change = { 0, 0, 0, 0 }
  change[low] = -40
  return { \"E\", \"E\", \"E\", \"E\", change = change, decay = 0.5 }
end
local rules = { S = { \"A\", \"B\", \"C\", \"D\" }, A = cell(4), B = cell(3), C = cell(2), D = cell(1), E = { \"E\", \"E\", \"E\", \"E\" } }
local land = lsystem({
  object = terrain({ size = 100, levels = 5, decay = 1, start = \"S\", rules = rules, base = \"auto\" }),
})
land:derive()
";
    let folder = Folder::new().with("s.lua", script);
    folder.burgeon(&["run", "s.lua", "--strict", "-o", "s.obj"]).done();
    let model = String::from_utf8(folder.read_bytes("s.obj")).unwrap();
    // The first object is the ground, the second its sides and its underside.
    let lowest: Vec<f64> = model
        .split("\no ")
        .skip(1)
        .map(|object| {
            let heights =
                object.lines().filter_map(|line| line.strip_prefix("v ")?.split(' ').nth(1)?.parse().ok());
            heights.fold(f64::INFINITY, f64::min)
        })
        .collect();
    let [ground, sides] = lowest[..] else { panic!("{lowest:?}") };
    // The edge of the bowl is level, and its middle is deep.
    assert!(ground < -10.0 && (sides - (ground - 2.0)).abs() < 1e-3, "{lowest:?}");
    assert!(refused(&script.replace("\"auto\"", "\"deep\"")).contains("a height (m) or \"auto\""));
}
