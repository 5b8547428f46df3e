//! Former names of the scripting API: they still work, with one warning at the first line that uses them.

use crate::support::{Folder, printed, refused, without_columns};

/// Script with all former names.
const FORMER: &str = r##"
local width = param("width", { default = 90, text = "Width of a street" })
local A = module("A", "step")
local hidden = lsystem({ object = terrain({ size = 64, levels = 1, rules = { A = { "A", "A", "A", "A" } }, shown = false }) })
hidden:derive()
local roads = network({ most = 100, ground = "#5f6f48" })
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

/// Former names: the text in the script, the name and the line of the warning, and the present name.
const NAMES: [(&str, &str, u32, &str); 9] = [
    ("text =", "param.text", 2, "doc"),
    ("shown =", "terrain.shown", 4, "visible"),
    ("most =", "network.most", 6, "max_segments"),
    ("ground =", "network.ground", 6, "block_color"),
    (":fate(", "network:fate", 11, "network:outcome"),
    (":reached(", "network:reached", 11, "network:open_end"),
    (":arrived(", "network:arrived", 12, "network:end_junction"),
    (":lead(", "network:lead", 20, "network:grow_to"),
    (":stand(", "network:stand", 21, "network:move_to"),
];

#[test]
fn each_former_name_works_and_warns_once_at_its_first_line() {
    let said = Folder::new().with("s.lua", FORMER).burgeon(&["run", "s.lua"]).done().stderr;
    assert_eq!(said.matches("is deprecated since").count(), NAMES.len(), "{said}");
    let mut present = FORMER.to_owned();
    for (written, name, line, instead) in NAMES {
        let warning = format!("s.lua:{line}: {name} is deprecated since version 1.1 of the script API");
        assert!(without_columns(&said).contains(&warning), "{warning}\n{said}");
        assert!(said.contains(&format!("help: use {instead} instead")), "{instead}\n{said}");
        let short = instead.rsplit(':').next().unwrap();
        let replacement = written.replace(name.rsplit([':', '.']).next().unwrap(), short);
        assert!(present.contains(written), "{written}");
        present = present.replace(written, &replacement);
    }
    let said = Folder::new().with("s.lua", &present).burgeon(&["run", "s.lua"]).done().stderr;
    assert!(!said.contains("is deprecated since"), "{said}");
    assert_eq!(printed(FORMER), printed(&present));
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
    let script = "local ways = object(\"ways\", { extends = network })\n\
                  local A = module(\"A\")\nlocal s = lsystem({ object = ways({ most = 20 }) })\ns:axiom(A())\n\
                  s:interpret(\"A\", function(this)\n  this:lead(1, { 90, 0 }, 0)\nend)\ns:derive(0)";
    let said = Folder::new().with("s.lua", script).burgeon(&["run", "s.lua"]).done().stderr;
    assert!(
        without_columns(&said).contains("s.lua:3: ways.most is deprecated")
            && said.contains("use max_segments"),
        "{said}"
    );
    assert!(
        without_columns(&said).contains("s.lua:6: ways:lead is deprecated")
            && said.contains("network:grow_to"),
        "{said}"
    );
}

#[test]
fn both_names_of_a_field_are_refused() {
    for (script, message, help) in [
        ("network({ most = 10, max_segments = 20 })", "network: `max_segments`", "remove `most`"),
        ("terrain({ shown = true, visible = true })", "terrain: `visible`", "remove `shown`"),
        ("network({ ground = \"red\", block_color = \"red\" })", "network: `block_color`", "remove `ground`"),
        ("param(\"n\", { default = 1, text = \"a\", doc = \"b\" })", "param: `doc`", "remove `text`"),
    ] {
        let said = refused(script);
        assert!(said.contains(message) && said.contains(" are both set") && said.contains(help), "{said}");
    }
}

#[test]
fn former_names_are_not_suggested() {
    for script in ["network({ mostt = 10 })", "terrain({ show = true })"] {
        let said = refused(script);
        let help = said.split("help: ").nth(1).unwrap_or_default();
        assert!(!help.split([' ', ',', '?', '\n']).any(|word| word == "most" || word == "shown"), "{said}");
    }
}
