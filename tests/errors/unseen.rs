//! Rules and contexts that can never match say so.

use super::warnings::{silent, warned, with};

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
    warning: s.lua:4: rule A(y): it is never used, for the rule A(x) in s.lua:3 always comes first
      | s:rule("A(y)", function(this, y) return F(1), F(y) end)
      help: give the earlier rule a guard, or both a weight, or put this one before it
    warning: s.lua:5: rule B < A(y): it is never used, for the rule A(x) in s.lua:3 always comes first
      | s:rule("B < A(y)", { when = function(this, y) return true end, weight = 2 }, function() return F(1) end)
      help: give the earlier rule a guard, or both a weight, or put this one before it

    s:rule("A(x)", { weight = 3 }, function(this, x) return F(x) end)
    s:rule("A(x)", function(this, x) return F(x), F(x) end)
    s:derive(1)
    warning: s.lua:4: rule A(x): it is never used, for the rule A(x) in s.lua:3 always comes first
      | s:rule("A(x)", function(this, x) return F(x), F(x) end)
      help: give both rules a weight: { weight = 1 }

    s:rule("B < A(x) > [B] A(y)", function(this, x) return F(x) end)
    s:rule("B < A(k) > [B] A(l)", function(this, k) return F(k) end)
    s:rule("A(x)", function() return F(1) end)
    s:derive(1)
    warning: s.lua:4: rule B < A(k) > [B] A(l): it is never used, for the rule B < A(x) > [B] A(y) in s.lua:3 always comes first
      | s:rule("B < A(k) > [B] A(l)", function(this, k) return F(k) end)
      help: give the earlier rule a guard, or both a weight, or put this one before it
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
    warning: s.lua:4: rule B < A(x): B is ignored, so this context never occurs
      | s:rule("B < A(x)", function() return F(2) end)
      help: take it out of system:ignore(...), or out of the context

    s:consider("A")
    s:rule("A(x) > [A(y) B]", function() return F(2) end)
    s:rule("A(x)", function() return F(1) end)
    s:derive(1)
    warning: s.lua:4: rule A(x) > [A(y) B]: B is not among the modules to consider, so this context never occurs
      | s:rule("A(x) > [A(y) B]", function() return F(2) end)
      help: add it: system:consider("B")
    "#);
    // What is ignored may be rewritten itself.
    silent(&[&with(
        "s:ignore(\"A\")\ns:rule(\"B < A(x)\", function() return F(2) end)\ns:rule(\"A(x)\", function() return F(1) end) s:derive(1)",
    )]);
}
