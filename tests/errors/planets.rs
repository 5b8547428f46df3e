//! Planets that cannot be, and things that are asked of the universe in vain.

use insta::assert_snapshot;

use crate::support::Folder;

/// What a script is told whose third line is `line`.
fn told(line: &str) -> String {
    let rules = r#"local rules = { A = { "A", "A", "A", "A", change = 0, decay = 0.5 } }"#;
    let script = format!("{rules}\nlocal A = module(\"A\")\n{line}\n");
    Folder::new().with("s.lua", script).refuses(&["run", "s.lua"])
}

#[test]
fn a_planet_that_cannot_be_is_refused() {
    assert_snapshot!(told("planet({ radius = 0, rules = rules })"), @"");
    assert_snapshot!(told("planet({ radius = 1000 })"), @"");
    assert_snapshot!(told("planet({ levels = 40, rules = rules })"), @"");
    assert_snapshot!(told("planet({ start = \"B\", rules = rules })"), @"");
    assert_snapshot!(told("planet({ axis = { 0, 0, 0 }, rules = rules })"), @"");
    assert_snapshot!(told("planet({ seed = 1.5, rules = rules })"), @"");
}

#[test]
fn a_focus_inside_a_planet_is_refused() {
    let focus = "local s = lsystem({ object = planet({ radius = 1000, rules = rules }) }) s:axiom(A()) \
                 s:interpret(\"A\", function(this) this:focus(0, 10, 0) end) s:derive(0)";
    assert_snapshot!(told(focus), @"");
}

#[test]
fn a_planet_that_would_be_too_much_is_refused() {
    let near = "lsystem({ object = planet({ closeness = 100, levels = 20, rules = rules }) }):derive(0)";
    assert_snapshot!(told(near), @"");
}

#[test]
fn flat_ground_has_no_latitude() {
    let cover = "terrain({ levels = 3, rules = rules, covers = { { on = { latitude = { 0, 1 } } } } })";
    assert_snapshot!(told(cover), @"");
}

#[test]
fn what_the_universe_has_not_is_told() {
    let begin = "local all = universe({ seed = 3 }) local one = all:galaxy(0, 0, 0)";
    assert_snapshot!(told("universe({ seed = 3 }):galaxy(0.5, 0, 0)"), @"");
    assert_snapshot!(told(&format!("{begin} all:star(one, 0)")), @"");
    assert_snapshot!(told(&format!("{begin} all:planet(one, 1)")), @"");
}
