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
    ]), @r#"
    stream()()
    error: s.lua:4:12: rule A(x): stream begins with a name, not nothing
      | return A(stream()())
      |          ^^^^^^
      module: A(1), step 1
      help: write stream("windows"), or with further keys, stream("windows", 3)

    stream(nil)()
    error: s.lua:4:12: rule A(x): stream begins with a name, not nothing
      | return A(stream(nil)())
      |          ^^^^^^
      module: A(1), step 1
      help: write stream("windows"), or with further keys, stream("windows", 3)

    stream(7)()
    error: s.lua:4:12: rule A(x): stream begins with a name, not the number 7
      | return A(stream(7)())
      |          ^^^^^^
      module: A(1), step 1
      help: write stream("windows"), or with further keys, stream("windows", 3)

    stream("")()
    error: s.lua:4:12: rule A(x): stream begins with a name, not the string ""
      | return A(stream("")())
      |          ^^^^^^
      module: A(1), step 1
      help: write stream("windows"), or with further keys, stream("windows", 3)

    stream({})()
    error: s.lua:4:12: rule A(x): stream begins with a name, not a table
      | return A(stream({})())
      |          ^^^^^^
      module: A(1), step 1
      help: write stream("windows"), or with further keys, stream("windows", 3)

    stream("a", nil)()
    error: s.lua:4:12: rule A(x): key 1 of the stream a is nothing
      | return A(stream("a", nil)())
      |          ^^^^^^
      module: A(1), step 1
      help: keys are finite numbers, strings and booleans

    stream("a", 1, {})()
    error: s.lua:4:12: rule A(x): key 2 of the stream a is a table
      | return A(stream("a", 1, {})())
      |          ^^^^^^
      module: A(1), step 1
      help: keys are finite numbers, strings and booleans

    stream("a", 0 / 0)()
    error: s.lua:4:12: rule A(x): key 1 of the stream a is NaN
      | return A(stream("a", 0 / 0)())
      |          ^^^^^^
      module: A(1), step 1
      help: check where it comes from, such as a division by 0

    stream("a", -1 / 0)()
    error: s.lua:4:12: rule A(x): key 1 of the stream a is -inf
      | return A(stream("a", -1 / 0)())
      |          ^^^^^^
      module: A(1), step 1
      help: check where it comes from, such as a division by 0

    stream("a", B())()
    error: s.lua:4:12: rule A(x): key 1 of the stream a is a module
      | return A(stream("a", B())())
      |          ^^^^^^
      module: A(1), step 1
      help: keys are finite numbers, strings and booleans

    stream("a", this)()
    error: s.lua:4:12: rule A(x): key 1 of the stream a is a table
      | return A(stream("a", this)())
      |          ^^^^^^
      module: A(1), step 1
      help: keys are finite numbers, strings and booleans

    stream("a", print)()
    error: s.lua:4:12: rule A(x): key 1 of the stream a is a function
      | return A(stream("a", print)())
      |          ^^^^^^
      module: A(1), step 1
      help: keys are finite numbers, strings and booleans

    stream("a", string.rep("b", 100000))()
    error: s.lua:4:12: rule A(x): key 1 of the stream a is a string of 100000 bytes
      | return A(stream("a", string.rep("b", 100000))())
      |          ^^^^^^
      module: A(1), step 1
      help: give it keys of at most 1000 bytes

    stream(string.rep("b", 1001))()
    error: s.lua:4:12: rule A(x): the name of a stream is a string of 1001 bytes
      | return A(stream(string.rep("b", 1001))())
      |          ^^^^^^
      module: A(1), step 1
      help: give it a name of at most 1000 bytes

    stream("a", table.unpack(table.create(40, 1)))()
    error: s.lua:4:12: rule A(x): the stream a has 40 keys
      | return A(stream("a", table.unpack(table.create(40, 1)))())
      |          ^^^^^^
      module: A(1), step 1
      help: give it at most 31 keys after its name
    "#);
}

#[test]
fn a_stream_takes_no_bounds_or_two_numbers() {
    assert_snapshot!(told(&[
        "stream(\"a\")(3)",
        "stream(\"a\")(1, 2, 3)",
        "stream(\"a\")(1, \"2\")",
        "stream(\"a\")(0 / 0, 1)",
    ]), @r#"
    stream("a")(3)
    error: s.lua:4:12: rule A(x): a random stream takes no bounds or two, not 1
      | return A(stream("a")(3))
      |          ^^^^^^
      module: A(1), step 1
      help: write r() or r(low, high)

    stream("a")(1, 2, 3)
    error: s.lua:4:12: rule A(x): a random stream takes no bounds or two, not 3
      | return A(stream("a")(1, 2, 3))
      |          ^^^^^^
      module: A(1), step 1
      help: write r() or r(low, high)

    stream("a")(1, "2")
    error: s.lua:4:28: rule A(x): a random stream takes two numbers, not the number 1 and the string "2"
      | return A(stream("a")(1, "2"))
      |                          ^
      module: A(1), step 1
      help: write r() or r(low, high)

    stream("a")(0 / 0, 1)
    error: s.lua:4:12: rule A(x): a random stream takes two finite numbers, not NaN and 1
      | return A(stream("a")(0 / 0, 1))
      |          ^^^^^^
      module: A(1), step 1
      help: check where they come from, such as a division by 0
    "#);
}

#[test]
fn a_guard_draws_from_no_stream() {
    assert_snapshot!(
        refused_rules("s:rule(\"A(x)\", { when = function(this, x)\n  return stream(\"a\")() > 0.5\nend }, function() return B() end)"),
        @r#"
    error: s.lua:4:3: rule A(x): a guard draws no random numbers
      | return stream("a")() > 0.5
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A(1), step 1
      help: draw in the successor, or give the rules weights: { weight = 2 }
    "#
    );
    assert_snapshot!(
        refused_rules("local r = stream(\"a\")\ns:rule(\"A(x)\", { when = function(this, x)\n  return r() > 0.5\nend }, function() return B() end)"),
        @r"
    error: s.lua:5:3: rule A(x): a guard draws no random numbers
      | return r() > 0.5
      | ^^^^^^^^^^^^^^^^
      module: A(1), step 1
      help: draw in the successor, or give the rules weights: { weight = 2 }
    "
    );
}

#[test]
fn a_stream_from_outside_a_rule_is_refused_with_the_remedy() {
    assert_snapshot!(
        refused_rules("local r = stream(\"a\")\ns:rule(\"A(x)\", function(this, x)\n  return A(r())\nend)"),
        @r#"
    error: s.lua:5:3: rule A(x): a rule uses a random stream that was created outside it
      | return A(r())
      | ^^^^^^^^^^^^^
      module: A(1), step 1
      help: create the stream where it is used: local r = stream("name")
    "#
    );
    assert_snapshot!(
        refused_rules("local r = stream(\"a\")\ns:interpret(\"A(x)\", function(this, x)\n  this:forward(r())\nend)"),
        @r#"
    error: s.lua:5:3: rule A(x) (interpretation): an interpretation rule uses a random stream that was created outside it
      | this:forward(r())
      | ^^^^^^^^^^^^^^^^^
      module: A(1), step 0
      help: create the stream where it is used: local r = stream("name")
    "#
    );
}

#[test]
fn the_number_of_the_step_needs_a_step_and_a_number_of_steps() {
    assert_snapshot!(refused("local one = 1\nlocal n = step()\n"), @r"
    error: s.lua:2:11: step() is known only while a rule, a guard or an interpretation rule runs
      | local n = step()
      |           ^^^^
      help: call it inside one of them, and pass the number to other functions
    ");
    assert_snapshot!(
        refused("local A = module(\"A\")\nlocal s = lsystem()\ns:axiom(A())\ns:rule(\"A\", { when = function()\n  return step() > 3\nend }, function() return nil end)\ns:derive()\n"),
        @r"
    error: s.lua:5:10: rule A: step() needs a number of steps, but this derivation runs until nothing changes
      | return step() > 3
      |        ^^^^
      module: A, step 1
      help: pass a number to derive: system:derive(20), or set --steps 20
    "
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
    assert!(heights.iter().all(|module| module.contains(",true")), "{heights:?}");
    assert!(heights.len() == 2 && heights[0] != heights[1], "{heights:?}");
    assert!(said.stderr.contains("true"), "{}", said.stderr);
}
