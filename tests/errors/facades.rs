//! Errors for facades that can never fit or have wrong arguments, at the line that creates them.

use crate::support::*;
use crate::warnings::silent;

/// Returns the error message for a script that ends with `expression`, without the script line.
fn told(expression: &str) -> String {
    let script = format!(
        "local wall = panel({{ width = {{ 1, 2 }}, height = {{ 3, 3 }} }})\nlocal made = {expression}\n"
    );
    let told = refused(&script);
    told.lines().filter(|line| !line.starts_with("  |")).collect::<Vec<_>>().join("\n")
}

#[test]
fn walls_and_templates_are_checked_when_they_are_made() {
    let cases = [
        "panel({ widht = 2 })",
        "panel({ width = { 3, 2 } })",
        "panel({ model = wall })",
        "panel({ at = \"middle\" })",
        "bordered(wall, { left = { 0.5, \"most\" } })",
        "bordered(wall, { left = 2, width = { 1, 2 } })",
        "bordered({ left = 0.5 })",
        "extruded(wall, { depth = 1000 })",
        "extruded(wall, { depth = 0 / 0 })",
        "list({ wall, panel({ height = { 4, 5 } }) })",
        "list({ wall, 7 })",
        "list({ wall }, { direction = \"upwards\" })",
        "grid(wall, { columns = { 0, 4 } })",
        "grid(wall, { rows = 2.5 })",
        "template({ wall = wall, keywords = \"blind\" })",
        "template({ wall = wall, weight = -1 })",
        "facade({})",
        "facade({ wall })",
    ];
    let all: Vec<String> = cases.iter().map(|case| format!("{case}\n{}", told(case))).collect();
    insta::assert_snapshot!(all.join("\n\n"), @r#"
    panel({ widht = 2 })
    error: s.lua:2:22: unknown field `widht` in panel
      help: did you mean width?

    panel({ width = { 3, 2 } })
    error: s.lua:2:14: panel: width must be a preferred length (m), { min, max } or { min, preferred, max }, not {3,2}
      help: width takes number | { number }: Width (m): preferred, { minimum, maximum } or { minimum, preferred, maximum }

    panel({ model = wall })
    error: s.lua:2:14: panel: model must be what derive returned, or model("window.glb"), not a panel
      help: model takes Model: Model in the middle of the panel: x to the right, z up, y into the wall

    panel({ at = "middle" })
    error: s.lua:2:28: panel: at must be "bottom", "center" or "top", not "middle"
      help: at takes a string, "center" unless given: Vertical position of the model: "bottom", "center" or "top"

    bordered(wall, { left = { 0.5, "most" } })
    error: s.lua:2:46: bordered: left must be a size (m), or a size and "min", "max" or "fixed": { 0.5, "max" }, not {0.5,"most"}
      help: left takes number | { any }, 0 unless given: Left margin: a size (m), or { size, "min" | "max" | "fixed" }

    bordered(wall, { left = 2, width = { 1, 2 } })
    error: s.lua:2:14: bordered: it can never fit: its parts are at least 3 m wide, but it must be 1 to 2 m wide
      help: allow a larger range of sizes for the parts or the wall

    bordered({ left = 0.5 })
    error: s.lua:2:14: bordered: missing wall between the margins
      help: write bordered { wall = panel { }, left = 0.5 }

    extruded(wall, { depth = 1000 })
    error: s.lua:2:14: extruded: depth is 1000 m
      help: give metres from -100 to 100

    extruded(wall, { depth = 0 / 0 })
    error: s.lua:2:14: extruded: depth must be a finite number, not NaN
      help: depth takes a number, 0 unless given: Projection (m); negative for a recess

    list({ wall, panel({ height = { 4, 5 } }) })
    error: s.lua:2:14: list: it can never fit: wall 2 is 4 to 5 m high, the walls before it are 3 m high
      help: add a margin around one of them: bordered { ... }

    list({ wall, 7 })
    error: s.lua:2:14: list: walls must be a list whose item 2 is a wall: panel, bordered, extruded, list or grid, not 7
      help: walls takes { Wall }, {} unless given: Walls, from left to right or from the bottom up

    list({ wall }, { direction = "upwards" })
    error: s.lua:2:44: list: unknown direction "upwards"
      help: use "horizontal" or "vertical"

    grid(wall, { columns = { 0, 4 } })
    error: s.lua:2:14: grid: columns must be an integer from 1 to 1000, or { min, max }, not {0,4}
      help: columns takes number | { number }, {1,1000} unless given: Number of columns: a number or { minimum, maximum }

    grid(wall, { rows = 2.5 })
    error: s.lua:2:14: grid: rows must be an integer from 1 to 1000, or { min, max }, not 2.5
      help: rows takes number | { number }, {1,1000} unless given: Number of rows: a number or { minimum, maximum }

    template({ wall = wall, keywords = "blind" })
    error: s.lua:2:50: template: keywords must be a list, not "blind"
      help: keywords takes { string }, {} unless given: Keywords of the frontages that the template is for, such as "entry door" or "blind"

    template({ wall = wall, weight = -1 })
    error: s.lua:2:14: template: weight is -1
      help: use a number of at least 0

    facade({})
    error: s.lua:2:14: facade: missing templates
      help: write facade({ template { wall = panel { } } })

    facade({ wall })
    error: s.lua:2:14: facade: templates must be a list whose item 1 is a template: template { wall = ... }, not a panel
      help: templates takes { Template }, {} unless given: Templates to choose from
    "#);
}

#[test]
fn walls_take_templates_or_a_photo() {
    let told = |walls: &str| {
        let script = format!(
            "local House = module(\"House\")\nlocal s = lsystem({{ object = footprint({{ {{ 0, 0 }}, {{ 8, 0 }}, {{ 8, 8 }} }}) }})\n\
             s:axiom(House())\ns:interpret(\"House\", function(this)\n  this:walls({walls})\nend)\ns:derive()\n"
        );
        refused(&script)
    };
    insta::assert_snapshot!(told("{ height = 3, templates = { 7 } }"), @r"
    error: s.lua:5:8: rule House (interpretation): footprint:walls: templates must be a facade, a template or a list of templates, not {7}
      | this:walls({ height = 3, templates = { 7 } })
      |      ^^^^^
      module: House, step 0
      help: write this:walls(options: { [string]: any }?)
    ");
    insta::assert_snapshot!(
        told("{ height = 3, templates = template({ wall = panel({}) }), photo = { texture = \"front.jpg\" } }"), @r#"
    error: s.lua:5:8: rule House (interpretation): footprint:walls: templates and photo are both set
      | this:walls({ height = 3, templates = template({ wall = panel({}) }), photo = { texture = "front.jpg" } })
      |      ^^^^^
      module: House, step 0
      help: remove one of them
    "#
    );
    insta::assert_snapshot!(told("{ height = 3, photo = { texture = \"front.jpg\" } }"), @r#"
    error: s.lua:5:49: texture not found: "front.jpg"
      | this:walls({ height = 3, photo = { texture = "front.jpg" } })
      |                                               ^^^^^^^^^
      help: textures are files next to the script: put the file there, or change its name in the script
    "#);
}

#[test]
fn a_frontage_of_millions_of_faces_is_refused_before_it_takes_the_memory() {
    let script = r#"
local tiny = panel({ width = { 0.002, 0.003 }, height = { 0.002, 0.003 } })
local House = module("House")
local s = lsystem({ object = footprint({ { 0, 0 }, { 8, 0 }, { 8, 8 } }, { height = 3 }) })
s:axiom(House())
s:interpret("House", function(this)
  this:walls({ templates = template(grid(grid(tiny))) })
end)
s:derive()
"#;
    insta::assert_snapshot!(refused(script), @r"
    error: s.lua:7:8: rule House (interpretation): footprint:walls: a frontage has more than 2000000 faces
      | this:walls({ templates = template(grid(grid(tiny))) })
      |      ^^^^^
      module: House, step 0
      help: repeat fewer or larger walls in its template
    ");
}

#[test]
fn walls_within_walls_without_end_are_refused() {
    let nested = "local wall = panel({})\nfor _ = 1, 200000 do\n  wall = bordered(wall)\nend";
    insta::assert_snapshot!(refused(nested), @r"
    error: s.lua:3:10: bordered: walls are nested more than 100 deep
      | wall = bordered(wall)
      |        ^^^^^^^^
      help: repeat a wall with grid or list
    ");
    let long = "local walls = table.create(1000, panel({}))\nlocal all = list(walls)";
    insta::assert_snapshot!(refused(long), @r"
    error: s.lua:2:13: list: 1000 walls are too many
      | local all = list(walls)
      |             ^^^^
      help: use at most 500, or repeat a wall with grid
    ");
}

#[test]
fn a_wall_that_no_template_fits_warns_unless_the_script_has_a_plain_template() {
    let house = |templates: &str| {
        format!(
            "local high = panel({{ height = {{ 5, 6 }} }})\nlocal House = module(\"House\")\n\
             local s = lsystem({{ object = footprint({{ {{ 0, 0 }}, {{ 8, 0 }}, {{ 8, 8 }} }}) }})\n\
             s:axiom(House())\ns:interpret(\"House\", function(this)\n  \
             this:walls({{ height = 3, templates = {templates} }}):roof()\nend)\ns:derive()\n"
        )
    };
    insta::assert_snapshot!(Folder::new().with("s.lua", house("template(high)")).warned(&["run", "s.lua"]), @r"
    warning: s.lua:6:8: rule House (interpretation): footprint:walls: no template fits a frontage, so its wall stays plain
      | this:walls({ height = 3, templates = template(high) }):roof()
      |      ^^^^^
      module: House, step 0
      help: the first is 8.00 m wide and 3.00 m high: allow this size in a template, or give a template that fits all sizes, such as template(panel({}), { weight = 0 }); --report FILE lists the others
    ");
    silent(&[&house("{ template(high), template(panel({}), { weight = 0 }) }")]);
}
