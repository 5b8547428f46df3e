//! Faults that draw a plausible model or none: each warns in its line, with a remedy.

use insta::assert_snapshot;

use crate::support::*;
use crate::warnings::{silent, warned};

const PLANT: &str = "local A, B = module(\"A\"), module(\"B\")\nlocal s = lsystem({ object = turtle() })\n";

fn plant(rest: &str) -> String {
    format!("{PLANT}{rest}\n")
}

#[test]
fn a_cut_that_an_interpretation_returns_warns_in_its_line() {
    assert_snapshot!(warned(&[&plant(
        "s:axiom(A())\ns:interpret(\"A\", function(this)\n  return F(1), Cut()\nend)\ns:derive(0)"
    )]), @r#"
    local A, B = module("A"), module("B")
    local s = lsystem({ object = turtle() })
    s:axiom(A())
    s:interpret("A", function(this)
      return F(1), Cut()
    end)
    s:derive(0)
    warning: s.lua:4:1: rule A (interpretation): Cut, which an interpretation returned, cuts nothing: interpretations do not change the chain
      | s:interpret("A", function(this)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A, step 0
      help: return Cut() from a rule
    "#);
    silent(&[&plant(
        "s:axiom(A(), F(1))\ns:interpret(\"A\", function() return F(1), Cut() end)\n\
         s:interpret(\"Cut\", function(this) this:turn(3) end)\ns:derive(0)",
    )]);
}

#[test]
fn a_chain_that_rules_or_cuts_emptied_has_its_own_remedy() {
    assert_snapshot!(warned(&[
        &plant("s:axiom(A(), F(1))\ns:rule(\"A\", function() return Cut() end)\ns:derive(2)"),
        &plant("s:axiom(A())\ns:rule(\"A\", function() return nil end)\ns:derive(2)"),
    ]), @r#"
    local A, B = module("A"), module("B")
    local s = lsystem({ object = turtle() })
    s:axiom(A(), F(1))
    s:rule("A", function() return Cut() end)
    s:derive(2)
    warning: s.lua:2:1: the model is empty: this system draws nothing
      | local s = lsystem({ object = turtle() })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: its final chain is empty, because Cut() erases itself and all that follows in its branch: put it into a branch, or behind what remains

    local A, B = module("A"), module("B")
    local s = lsystem({ object = turtle() })
    s:axiom(A())
    s:rule("A", function() return nil end)
    s:derive(2)
    warning: s.lua:2:1: the model is empty: this system draws nothing
      | local s = lsystem({ object = turtle() })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: its final chain is empty, because its rules erase all modules: return a module that is drawn, not nil
    "#);
}

#[test]
fn ignore_and_consider_of_one_system_or_rule_warn_in_the_second_line() {
    let rest = "s:axiom(A(), B(), F(1))\n";
    let rule = "function() return F(1) end)\ns:interpret(\"B\", function() end)\ns:derive(1)";
    assert_snapshot!(warned(&[
        &plant(&format!("{rest}s:ignore(\"F\")\ns:consider(\"A B\")\ns:rule(\"A < B\", {rule}")),
        &plant(&format!("{rest}s:consider(\"A B\")\ns:ignore(\"F\")\ns:rule(\"A < B\", {rule}")),
        &plant(&format!("{rest}s:rule(\"A < B\", {{ ignore = \"F\", consider = \"A B\" }}, {rule}")),
    ]), @r#"
    local A, B = module("A"), module("B")
    local s = lsystem({ object = turtle() })
    s:axiom(A(), B(), F(1))
    s:ignore("F")
    s:consider("A B")
    s:rule("A < B", function() return F(1) end)
    s:interpret("B", function() end)
    s:derive(1)
    warning: s.lua:5:3: the system has both ignore and consider, the first in s.lua:4: contexts see only the modules of consider that ignore does not name
      | s:consider("A B")
      |   ^^^^^^^^
      help: remove one of the two

    local A, B = module("A"), module("B")
    local s = lsystem({ object = turtle() })
    s:axiom(A(), B(), F(1))
    s:consider("A B")
    s:ignore("F")
    s:rule("A < B", function() return F(1) end)
    s:interpret("B", function() end)
    s:derive(1)
    warning: s.lua:5:3: the system has both ignore and consider, the first in s.lua:4: contexts see only the modules of consider that ignore does not name
      | s:ignore("F")
      |   ^^^^^^
      help: remove one of the two

    local A, B = module("A"), module("B")
    local s = lsystem({ object = turtle() })
    s:axiom(A(), B(), F(1))
    s:rule("A < B", { ignore = "F", consider = "A B" }, function() return F(1) end)
    s:interpret("B", function() end)
    s:derive(1)
    warning: s.lua:4:3: the rule has both ignore and consider: contexts see only the modules of consider that ignore does not name
      | s:rule("A < B", { ignore = "F", consider = "A B" }, function() return F(1) end)
      |   ^^^^
      help: remove one of the two
    "#);
    silent(&[&plant(&format!("{rest}s:rule(\"A < B\", {{ ignore = {{}}, consider = \"A B\" }}, {rule}"))]);
}

#[test]
fn a_rule_that_yields_is_refused_with_a_remedy() {
    assert_snapshot!(refused(&plant(
        "s:axiom(A())\ns:rule(\"A\", function()\n  coroutine.yield()\n  return F(1)\nend)\ns:derive(1)"
    )), @r"
    error: s.lua:5:13: rule A: attempt to yield across metamethod/C-call boundary
      | coroutine.yield()
      |           ^^^^^
      module: A, step 1
      help: rules, guards, interpretations and hooks cannot pause: return modules that continue in the next step, or wrap the code in a coroutine of its own, coroutine.wrap(function() ... end)
    ");
}

#[test]
fn growth_that_meets_the_memory_limit_names_its_rule_and_line() {
    // Two runs may notice the limit in different modules, so the messages in text and in JSON are not compared.
    let error_of = |script: String| {
        let said =
            Folder::new().with("s.lua", script).burgeon(&["run", "s.lua", "--memory-limit", "100"]).failed();
        without_columns(&said)
    };
    let grown = |rule: &str, end: &str| {
        let script = format!(
            "local C = module(\"C\", \"x\", \"list\")\nlocal s = lsystem({{ object = turtle() }})\ns:axiom(C(1, {{ 1 }}))\n\
             s:{rule}(\"C(x, list)\", function() return C(1, {{ 1 }}), C(1, {{ 1 }}) end)\ns:derive({end})\n"
        );
        error_of(script)
    };
    for (rule, end) in [("decompose", "1"), ("rule", "60")] {
        let said = grown(rule, end);
        assert!(said.starts_with("error: s.lua:4: rule C(x, list)"), "{said}");
        assert!(said.contains("the run exceeds the memory limit of 100 MB"), "{said}");
    }
    let plain = plant("s:axiom(A())\ns:decompose(\"A\", function() return A(), A() end)\ns:derive(1)");
    let said = error_of(plain);
    assert!(said.starts_with("error: s.lua:4: rule A"), "{said}");
    assert!(said.contains("the run exceeds the memory limit of 100 MB"), "{said}");
}

#[test]
fn numbers_in_place_of_a_vector_are_shown_as_one_vector() {
    let of = |call: &str| {
        refused(&plant(&format!(
            "s:axiom(A())\ns:interpret(\"A\", function(this)\n  {call}\nend)\ns:derive(0)"
        )))
    };
    assert_snapshot!(of("this:jump(1, 0, 2.5)"), @r"
    error: s.lua:5:8: rule A (interpretation): turtle:jump: position must be a vector: { x, y, z } or vec(x, y, z), not 1
      | this:jump(1, 0, 2.5)
      |      ^^^^
      module: A, step 0
      help: give `position` as one vector: vec(1, 0, 2.5)
    ");
    assert_snapshot!(of("this:tropism(0, -1)"), @r"
    error: s.lua:5:8: rule A (interpretation): turtle:tropism: direction must be a vector: { x, y, z } or vec(x, y, z), not 0
      | this:tropism(0, -1)
      |      ^^^^^^^
      module: A, step 0
      help: give `direction` as one vector: vec(0, -1)
    ");
    assert_snapshot!(of("this:jump(1)"), @r"
    error: s.lua:5:8: rule A (interpretation): turtle:jump: position must be a vector: { x, y, z } or vec(x, y, z), not 1
      | this:jump(1)
      |      ^^^^
      module: A, step 0
      help: write this:jump(position: Vector)
    ");
    assert_snapshot!(of("this:shape(cuboid(1, 1, 1):translate(1, 2, 3))"), @r"
    error: s.lua:5:30: rule A (interpretation): shape:translate: offset must be a vector: { x, y, z } or vec(x, y, z), not 1
      | this:shape(cuboid(1, 1, 1):translate(1, 2, 3))
      |                            ^^^^^^^^^
      module: A, step 0
      help: give `offset` as one vector: vec(1, 2, 3)
    ");
}

#[test]
fn a_letter_that_is_no_pattern_is_marked_in_the_line() {
    assert_snapshot!(refused(&plant("s:axiom(A())\ns:rule(\"A > B ?x B\", \"A\")\ns:derive(1)")), @r#"
    error: s.lua:4:15: malformed pattern: unexpected '?' at character 7
        A > B ?x B
              ^
      | s:rule("A > B ?x B", "A")
      |               ^
      help: expected a module's name
    "#);
}

#[test]
fn a_line_to_the_position_of_the_turtle_draws_nothing_and_warns() {
    assert_snapshot!(warned(&[&plant(
        "s:axiom(A(), F(1))\ns:interpret(\"A\", function(this)\n  this:line_to({ 0, 0, 0 })\nend)\ns:derive(0)"
    )]), @r#"
    local A, B = module("A"), module("B")
    local s = lsystem({ object = turtle() })
    s:axiom(A(), F(1))
    s:interpret("A", function(this)
      this:line_to({ 0, 0, 0 })
    end)
    s:derive(0)
    warning: s.lua:5:8: rule A (interpretation): turtle:line_to: the turtle is already at this position, so nothing is drawn
      | this:line_to({ 0, 0, 0 })
      |      ^^^^^^^
      module: A, step 0
      help: use a position at a distance
    "#);
}

#[test]
fn polar_gives_the_position_at_an_angle_in_degrees_and_refuses_other_values() {
    let rest = "s:axiom(F(1))\ns:derive(0)";
    silent(&[&plant(&format!(
        "local p = polar(2, 90, 1)\nexpect(p.x, 0, 1e-9)\nexpect(p.y, 2, 1e-9)\nexpect(p.z, 1)\nexpect(polar(2, 180).z, 0)\n{rest}"
    ))]);
    assert_snapshot!(refused("local p = polar(\"2\", 90)"), @r#"
    error: s.lua:1:18: polar takes numbers, but argument 1 is the string "2"
      | local p = polar("2", 90)
      |                  ^
    "#);
    assert_snapshot!(refused("local p = polar(2, 0 / 0)"), @r"
    error: s.lua:1:11: polar takes finite numbers
      | local p = polar(2, 0 / 0)
      |           ^^^^^
      help: write polar(radius, angle, z), with the angle in degrees
    ");
}

#[test]
fn a_shape_turns_about_a_point_unless_it_turns_about_its_centre() {
    let rest = "s:axiom(Draw(box))\ns:derive(0)";
    silent(&[&plant(&format!(
        "local box = cuboid(2, 1, 4)\nlocal turned = box:rotate(90, nil, vec(0, 0, 0))\n\
         expect(turned:center().x, -0.5, 1e-9)\nexpect(turned:center().y, 1, 1e-9)\n\
         expect(box:rotate(90):center().x, 1, 1e-9)\n{rest}"
    ))]);
}

/// Returns a folder with a town and the library of roads.
fn town(options: &str) -> Folder {
    let script = format!("local roads = require(\"templates/roads\")\nroads.grow({{ {options} }})\n");
    Folder::new().with_roads().with("s.lua", script)
}

#[test]
fn a_town_with_too_few_steps_warns_of_the_streets_that_would_continue() {
    let raster = "pattern = roads.raster(), extent = 300, steps = ";
    assert_snapshot!(town(&format!("{raster}5")).warned(&["run", "s.lua"]), @r"
    warning: templates/roads/reports.lua:34:3: roads.grow: growth stops after 5 steps, while 6 streets continue within the extent
      | warn(
      | ^^^^^
      called at s.lua:2
      help: derive more steps: give a greater `steps`, or a smaller `extent`
    ");
    let said = town(&format!("{raster}40")).burgeon(&["run", "s.lua", "--strict", "--json"]);
    assert_eq!(said.status, 0, "{}", said.stderr);
}

#[test]
fn a_town_whose_outline_stays_open_warns_and_does_not_fail() {
    let wide =
        "pattern = roads.organic({ block = 40 }), extent = 250, network = { clearance = 40, snap = 45 }";
    assert_snapshot!(town(wide).warned(&["run", "s.lua"]), @r"
    warning: templates/roads/reports.lua:25:3: roads.grow: the outline of the town stays open in 5 places, the first near -50, 14 (m), and land there has no streets
      | warn(
      | ^^^^^
      called at s.lua:2
      help: try another seed, a greater extent or a smaller block
    ");
}
