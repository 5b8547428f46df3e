//! Former names of the scripting API: they still work, with one warning at the first line that uses them.

use insta::assert_snapshot;

use crate::support::{Folder, refused};

/// Script with all former names.
const FORMER: &str = r##"
local width = param("width", { default = 90, text = "Width of a street" })
local A = module("A", "step")
local hidden = lsystem({ object = terrain({ size = 64, levels = 1, decay = 1, rules = { A = { "A", "A", "A", "A" } }, shown = false }) })
hidden:derive()
local roads = network({
  most = 100,
  ground = "#5f6f48",
})
local s = lsystem({ object = roads })
s:axiom(A(1))
s:rule("A(step)", function(this, step)
  if step == 1 then
    print(this:fate(1, 0), this:reached(1, 0), this:reached(1, 90))
    print(this:arrived(1, 0))
    return A(2)
  end
end)
s:interpret("A(step)", function(this, step)
  if step == 1 then
    this:grow(1, 0, width, 0)
  else
    this:lead(2, { 90, 90 }, 0)
    this:stand(2, -90):walk(50)
  end
end)
local derived = s:derive(1).objects[1]
print(derived:size())
print(derived:reached(1, 0))
"##;

#[test]
fn each_former_name_works_and_warns_once_at_its_first_line() {
    let former = Folder::new().with("s.lua", FORMER);
    assert_snapshot!(former.warned(&["run", "s.lua"]), @r"");
    let present = [
        ("text =", "doc ="),
        ("shown =", "visible ="),
        ("most =", "max_segments ="),
        ("ground =", "block_color ="),
        (":fate(", ":outcome("),
        (":reached(", ":open_end("),
        (":arrived(", ":end_junction("),
        (":lead(", ":grow_to("),
        (":stand(", ":move_to("),
    ];
    let script = present.iter().fold(FORMER.to_owned(), |script, (former, name)| {
        assert!(script.contains(former), "{former}");
        script.replace(former, name)
    });
    let present = Folder::new().with("s.lua", script);
    let [former, present] = [former, present].map(|folder| folder.burgeon(&["run", "s.lua"]).done().stderr);
    let printed = |text: &str| text.lines().take_while(|line| !line.contains("warning")).collect::<String>();
    assert_eq!(printed(&former), printed(&present));
    assert!(!present.contains("deprecated"), "{present}");
}

#[test]
fn the_outcome_of_a_probe_has_its_former_name_too() {
    let script = "local A = module(\"A\")\nlocal s = lsystem({ object = network() })\ns:axiom(A())\n\
                  s:interpret(\"A\", function(this)\n  local found = this:probe(1, 0, 90, 0)\n\
                  assert(found.fate == \"built\" and found.outcome == \"built\")\n  this:grow(1, 0, 90, 0)\nend)\ns:derive(0)";
    Folder::new().with("s.lua", script).burgeon(&["run", "s.lua"]).done();
}

#[test]
fn a_type_that_extends_another_has_its_former_names() {
    let script = "local grid = object(\"grid_of_streets\", { extends = network })\n\
                  local A = module(\"A\")\nlocal s = lsystem({ object = grid({ most = 20 }) })\ns:axiom(A())\n\
                  s:interpret(\"A\", function(this)\n  this:lead(1, { 90, 0 }, 0)\nend)\ns:derive(0)";
    assert_snapshot!(Folder::new().with("s.lua", script).warned(&["run", "s.lua"]), @r"");
}

#[test]
fn both_names_of_a_field_are_refused() {
    assert_snapshot!(refused("network({ most = 10, max_segments = 20 })"), @r"");
    assert_snapshot!(refused("terrain({ shown = true, visible = true })"), @r"");
    assert_snapshot!(refused("network({ ground = \"red\", block_color = \"red\" })"), @r"");
    assert_snapshot!(refused("param(\"width\", { default = 1, text = \"a\", doc = \"b\" })"), @r"");
}

#[test]
fn former_names_are_not_suggested() {
    assert_snapshot!(refused("network({ mostt = 10 })"), @r"");
    assert_snapshot!(refused("param(\"width\", { default = 1, tex = \"a\" })"), @r"");
}
