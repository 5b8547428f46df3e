//! Warnings about rules and contexts that never match.

use super::warnings::{silent, warned, with};
use crate::support::Folder;

#[test]
fn rules_that_others_forestall() {
    insta::assert_snapshot!(warned(&[
        &with("s:rule(\"A(x)\", function(this, x) return F(x) end)\ns:rule(\"A(y)\", function(this, y) return F(1), F(y) end)\n\
            s:rule(\"B < A(y)\", { when = function(this, b, y) return true end, weight = 2 }, function() return F(1) end)\ns:derive(1)")
            .replace("this, b, y", "this, y"),
        &with("s:rule(\"A(x)\", { weight = 3 }, function(this, x) return F(x) end)\ns:rule(\"A(x)\", function(this, x) return F(x), F(x) end)\ns:derive(1)"),
        &with("s:rule(\"B < A(x) > [B] A(y)\", function(this, x) return F(x) end)\ns:rule(\"B < A(k) > [B] A(l)\", function(this, k) return F(k) end)\n\
            s:rule(\"A(x)\", function() return F(1) end)\ns:derive(1)"),
    ]), @r#"
    s:rule("A(x)", function(this, x) return F(x) end)
    s:rule("A(y)", function(this, y) return F(1), F(y) end)
    s:rule("B < A(y)", { when = function(this, y) return true end, weight = 2 }, function() return F(1) end)
    s:derive(1)
    warning: s.lua:4:3: rule A(y): this rule is never applied: A(x) in s.lua:3 always applies first
      | s:rule("A(y)", function(this, y) return F(1), F(y) end)
      |   ^^^^
      help: add a guard to the earlier rule, set a weight for both, or put this rule before it
    warning: s.lua:5:3: rule B < A(y): this rule is never applied: A(x) in s.lua:3 always applies first
      | s:rule("B < A(y)", { when = function(this, y) return true end, weight = 2 }, function() return F(1) end)
      |   ^^^^
      help: add a guard to the earlier rule, set a weight for both, or put this rule before it

    s:rule("A(x)", { weight = 3 }, function(this, x) return F(x) end)
    s:rule("A(x)", function(this, x) return F(x), F(x) end)
    s:derive(1)
    warning: s.lua:4:3: rule A(x): this rule is never applied: A(x) in s.lua:3 always applies first
      | s:rule("A(x)", function(this, x) return F(x), F(x) end)
      |   ^^^^
      help: set a weight for both rules: { weight = 1 }

    s:rule("B < A(x) > [B] A(y)", function(this, x) return F(x) end)
    s:rule("B < A(k) > [B] A(l)", function(this, k) return F(k) end)
    s:rule("A(x)", function() return F(1) end)
    s:derive(1)
    warning: s.lua:4:3: rule B < A(k) > [B] A(l): this rule is never applied: B < A(x) > [B] A(y) in s.lua:3 always applies first
      | s:rule("B < A(k) > [B] A(l)", function(this, k) return F(k) end)
      |   ^^^^
      help: add a guard to the earlier rule, set a weight for both, or put this rule before it
    "#);
    silent(&[
        &with(
            "s:rule(\"A(x)\", { when = function(this, x) return x > 3 end }, function(this, x) return F(x) end)\ns:rule(\"A(x)\", function() return F(1) end) s:derive(1)",
        ),
        &with(
            "s:rule(\"B < A(x)\", function() return F(2) end)\ns:rule(\"A(x) > B\", function() return F(2) end)\ns:rule(\"A(x)\", function() return F(1) end) s:derive(1)",
        ),
        &with(
            "s:rule(\"A(x)\", { weight = 0 }, function() return F(2) end)\ns:rule(\"A(x)\", function() return F(1) end) s:derive(1)",
        ),
        &with(
            "s:rule(\"A(x)\", { weight = 2 }, function() return F(2) end)\ns:rule(\"A(x)\", { weight = 1 }, function() return F(1) end) s:derive(1)",
        ),
        &with(
            "s:rule(\"A(x) > [B]\", function() return F(2) end)\ns:rule(\"A(x) > B\", function() return F(2) end)\ns:rule(\"A(x)\", function() return F(1) end) s:derive(1)",
        ),
    ]);
}

#[test]
fn contexts_that_cannot_occur() {
    insta::assert_snapshot!(warned(&[
        &with("s:ignore(\"B\")\ns:rule(\"B < A(x)\", function() return F(2) end)\ns:rule(\"A(x)\", function() return F(1) end)\ns:derive(1)"),
        &with("s:consider(\"A\")\ns:rule(\"A(x) > [A(y) B]\", function() return F(2) end)\ns:rule(\"A(x)\", function() return F(1) end)\ns:derive(1)"),
    ]), @r#"
    s:ignore("B")
    s:rule("B < A(x)", function() return F(2) end)
    s:rule("A(x)", function() return F(1) end)
    s:derive(1)
    warning: s.lua:4:1: rule B < A(x): B is ignored, so this context never occurs
      | s:rule("B < A(x)", function() return F(2) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: remove it from system:ignore(...), or from the context

    s:consider("A")
    s:rule("A(x) > [A(y) B]", function() return F(2) end)
    s:rule("A(x)", function() return F(1) end)
    s:derive(1)
    warning: s.lua:4:1: rule A(x) > [A(y) B]: B is not among the modules to consider, so this context never occurs
      | s:rule("A(x) > [A(y) B]", function() return F(2) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: add it: system:consider("B")
    "#);
    // An ignored module can be rewritten itself.
    silent(&[&with(
        "s:ignore(\"A\")\ns:rule(\"B < A(x)\", function() return F(2) end)\ns:rule(\"A(x)\", function() return F(1) end) s:derive(1)",
    )]);
}

#[test]
fn a_rule_with_the_guard_of_an_earlier_one_is_never_applied() {
    insta::assert_snapshot!(warned(&[
        &with("s:rule(\"A(x)\", { when = function(this, x) return x > 0 end }, function(this, x) return F(x) end)\n\
            s:rule(\"A(y)\", { when = function(this, x)\n  return x > 0 -- again\nend, weight = 2 }, function(this, y) return F(y) end)\ns:derive(1)"),
        &with("local function large(this, x) return x > 0 end\ns:rule(\"A(x)\", { when = large }, function(this, x) return F(x) end)\n\
            s:rule(\"A(x)\", { when = large }, function(this, x) return F(2 * x) end)\ns:derive(1)"),
    ]), @r#"
    s:rule("A(x)", { when = function(this, x) return x > 0 end }, function(this, x) return F(x) end)
    s:rule("A(y)", { when = function(this, x)
      return x > 0 -- again
    end, weight = 2 }, function(this, y) return F(y) end)
    s:derive(1)
    warning: s.lua:4:3: rule A(y): this rule is never applied: A(x) in s.lua:3 applies first and has the same guard
      | s:rule("A(y)", { when = function(this, x)
      |   ^^^^
      help: join the two rules, change the guard of one, or set a weight for both

    local function large(this, x) return x > 0 end
    s:rule("A(x)", { when = large }, function(this, x) return F(x) end)
    s:rule("A(x)", { when = large }, function(this, x) return F(2 * x) end)
    s:derive(1)
    warning: s.lua:5:3: rule A(x): this rule is never applied: A(x) in s.lua:4 applies first and has the same guard
      | s:rule("A(x)", { when = large }, function(this, x) return F(2 * x) end)
      |   ^^^^
      help: join the two rules, change the guard of one, or set a weight for both
    "#);
    silent(&[
        // The guards capture different values or have different arguments, or the first rule has a weight.
        &with(
            "for i = 1, 3 do\n  s:rule(\"A(x)\", { when = function(this, x) return x == i end }, function(this, x) return F(i) end)\nend s:derive(1)",
        ),
        &with(
            "local n = 1\ns:rule(\"A(x)\", { when = function(this, x) return x == n end }, function(this, x) return F(1) end)\n\
            local n = 2\ns:rule(\"A(x)\", { when = function(this, x) return x == n end }, function(this, x) return F(n) end) s:derive(1)",
        ),
        &with(
            "s:rule(\"A(x)\", { when = function(this, x) return x > 0 end, weight = 1 }, function(this, x) return F(1) end)\n\
            s:rule(\"A(x)\", { when = function(this, x) return x > 0 end, weight = 1 }, function(this, x) return F(2) end) s:derive(1)",
        ),
        &with(
            "s:rule(\"A(x)\", { when = function(this, x) return x > 0 end }, function(this, x) return F(1) end)\n\
            s:rule(\"A(x)\", { when = function(this, x) return x > 1 end }, function(this, x) return F(2) end) s:derive(1)",
        ),
        &with(
            "s:rule(\"B < A(x)\", { when = function(this, x) return x > 0 end }, function(this, x) return F(1) end)\n\
            s:rule(\"A(x)\", { when = function(this, x) return x > 0 end }, function(this, x) return F(2) end) s:derive(1)",
        ),
    ]);
}

#[test]
fn an_axiom_that_replaces_another_is_told() {
    let script = "local A = module(\"A\", \"x\")\nlocal s = lsystem({ object = turtle() })\n\
        s:interpret(\"A(x)\", function(this, x) this:forward(x) end)\ns:axiom(A(1))\ns:axiom(A(2))\ns:derive(0)\n";
    insta::assert_snapshot!(warned(&[script]), @r#"
    local A = module("A", "x")
    local s = lsystem({ object = turtle() })
    s:interpret("A(x)", function(this, x) this:forward(x) end)
    s:axiom(A(1))
    s:axiom(A(2))
    s:derive(0)
    warning: s.lua:5:3: this axiom replaces the axiom in s.lua:4, which was never derived
      | s:axiom(A(2))
      |   ^^^^^
      help: set one axiom with all modules, or derive the system before the next axiom
    "#);
    silent(&["local A = module(\"A\", \"x\")\nlocal s = lsystem({ object = turtle() })\n\
        s:interpret(\"A(x)\", function(this, x) this:forward(x) end)\n\
        for x = 1, 2 do\n  s:axiom(A(x))\n  s:derive(0)\nend\n"]);
}

#[test]
fn a_system_that_rules_only_place_is_not_drawn_at_the_origin() {
    let script = |count: &str| {
        format!(
            "local A, N = module(\"A\"), module(\"N\", \"n\")\nlocal stone = lsystem({{ object = extruder() }}) stone:axiom(A())\n\
             stone:interpret(\"A\", function(this) this:extrude(1) end)\nlocal models = {{ stone = stone:derive() }}\n\
             local s = lsystem({{ object = turtle() }}) s:axiom(N({count}))\n\
             s:interpret(\"N(n)\", function(this, n)\n  this:forward(1)\n  for i = 1, n do this:place(models.stone) end\nend)\ns:derive()\n"
        )
    };
    let counts = |script: String| {
        let document = Folder::new().with("s.lua", script).burgeon(&["run", "s.lua", "--json"]).done().json();
        document["instances"].as_u64().unwrap()
    };
    let drawn = ["0", "1", "3"].map(|count| counts(script(count)));
    assert_eq!(drawn, [1, 2, 4]);
    // The top level may read the model too.
    let read = |count: &str| script(count).replace("local s =", "print(models.stone.modules)\nlocal s =");
    assert_eq!(["0", "1"].map(|count| counts(read(count))), [1, 2]);
    // A model that no rule captures for placing is drawn, and so is a model that rules only read.
    let read = "local A = module(\"A\") local stone = lsystem({ object = extruder() }) stone:axiom(A())\n\
        stone:interpret(\"A\", function(this) this:extrude(1) end)\nlocal model = stone:derive()\n\
        local s = lsystem({ object = turtle() }) s:axiom(A())\n\
        s:interpret(\"A\", function(this) this:forward(model.modules) end)\ns:derive()\n";
    assert_eq!(counts(read.to_owned()), 2);
}

#[test]
fn print_writes_control_characters_out_and_takes_any_bytes() {
    let lines = crate::support::printed(
        "print(\"a\\27[2Jb\\r\\0\", \"\\255\\254x\\195\", \"\\u{202e}é\")\nprint({ 1 }, nil, true, 0 / 0, vec(1, 2, 3))\nprint(\"two\\nlines\")\n",
    );
    let expected = [
        "a\\u{1b}[2Jb\\r\\u{0}\t\\xff\\xfex\\xc3\t\\u{202e}é",
        "{ 1 }\tnil\ttrue\tnan\tvec(1, 2, 3)",
        "two",
        "lines",
    ];
    assert_eq!(lines, expected);
}
