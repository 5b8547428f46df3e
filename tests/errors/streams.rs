//! Errors of named random streams and of the number of the step.

use std::fmt::Write as _;

use insta::assert_snapshot;

use super::packages::about;
use crate::support::{Folder, assert_decent, refused, refused_rules};

/// Returns the error messages of these calls in a rule, each after the call.
fn told(calls: &[&str]) -> String {
    let mut text = String::new();
    for call in calls {
        let said = refused_rules(&format!("s:rule(\"A(x)\", function(this, x)\n  return A({call})\nend)"));
        assert_decent(&said);
        let _ = writeln!(text, "{call}\n{said}");
    }
    text
}

#[test]
fn a_stream_has_a_name_and_keys_of_some_types() {
    assert_snapshot!(told(&[
        "stream()()",
        "stream(nil)()",
        "stream(7)()",
        "stream(\"\")()",
        "stream({})()",
        "stream(\"a\", nil)()",
        "stream(\"a\", 1, {})()",
        "stream(\"a\", 0 / 0)()",
        "stream(\"a\", -1 / 0)()",
        "stream(\"a\", B())()",
        "stream(\"a\", this)()",
        "stream(\"a\", print)()",
        "stream(\"a\", string.rep(\"b\", 100000))()",
        "stream(string.rep(\"b\", 1001))()",
        "stream(\"a\", table.unpack(table.create(40, 1)))()",
    ]), @"");
}

#[test]
fn a_stream_takes_no_bounds_or_two_numbers() {
    assert_snapshot!(told(&[
        "stream(\"a\")(3)",
        "stream(\"a\")(1, 2, 3)",
        "stream(\"a\")(1, \"2\")",
        "stream(\"a\")(0 / 0, 1)",
        "stream(\"a\")",
    ]), @"");
}

#[test]
fn a_guard_draws_from_no_stream() {
    assert_snapshot!(
        refused_rules("s:rule(\"A(x)\", { when = function(this, x)\n  return stream(\"a\")() > 0.5\nend }, function() return B() end)"),
        @r"
        error: s.lua:4: rule A(x): a guard draws no random numbers
          | return stream("a")() > 0.5
          module: A(1), step 1
          help: draw in the successor, or give the rules weights: { weight = 2 }
        "
    );
    assert_snapshot!(
        refused_rules("local r = stream(\"a\")\ns:rule(\"A(x)\", { when = function(this, x)\n  return r() > 0.5\nend }, function() return B() end)"),
        @""
    );
}

#[test]
fn a_stream_from_outside_a_rule_is_refused_with_the_remedy() {
    assert_snapshot!(
        refused_rules("local r = stream(\"a\")\ns:rule(\"A(x)\", function(this, x)\n  return A(r())\nend)"),
        @""
    );
    assert_snapshot!(
        refused_rules("local r = stream(\"a\")\ns:interpret(\"A(x)\", function(this, x)\n  this:forward(r())\nend)"),
        @""
    );
}

#[test]
fn the_number_of_the_step_needs_a_step_and_a_number_of_steps() {
    assert_snapshot!(refused("print(1)\nlocal n = step()\n"), @"");
    assert_snapshot!(
        refused("local A = module(\"A\")\nlocal s = lsystem()\ns:axiom(A())\ns:rule(\"A\", { when = function()\n  return step() > 3\nend }, function() return nil end)\ns:derive()\n"),
        @""
    );
}

#[test]
fn functions_of_packages_draw_from_streams_of_the_module_that_calls_them() {
    let script = "local towers = require(\"@castle/towers\")
        local A, B = module(\"A\"), module(\"B\", \"u\", \"same\")
        local s = lsystem()
        s:axiom(A(), A())
        s:rule(\"A\", function() return B(towers.height(), towers.height() == stream(\"height\", 2)(3, 9)) end)
        s:derive(1)
        print(towers.top == stream(\"height\", 2)(3, 9))";
    let package = "local function height() return stream(\"height\", 2)(3, 9) end
        return { height = height, top = height() }";
    let folder = Folder::new()
        .with("s.lua", script)
        .with("mods/castle/mod.toml", about("castle", ""))
        .with("mods/castle/towers.lua", package);
    let said = folder.burgeon(&["run", "s.lua", "--chain", "-"]).done();
    let heights: Vec<&str> = said.stdout.trim().split(") ").collect();
    assert!(heights.iter().all(|module| module.contains(", true")), "{heights:?}");
    assert!(heights.len() == 2 && heights[0] != heights[1], "{heights:?}");
    assert!(said.stderr.contains("true"), "{}", said.stderr);
}
