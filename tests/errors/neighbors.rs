//! Neighbours, streets and edges of footprints in scripts.

use crate::support::{printed, refused};

const ROW: &str = r#"
local House, Wall = module("House"), module("Wall", "edge", "words")
local row = {}
for i = 0, 2 do
  local x = i * 8
  row[i + 1] = { id = i, name = `h{i}`, ring = { { x, 0 }, { x + 8, 0 }, { x + 8, 10 }, { x, 10 } } }
end
local ways = streets({ { { -50, 14 }, { 50, 14 } } })
local town = lsystem({ object = footprint })
town:axiom(source(row), function(f)
  local doors = if f.id == 2 then { [2] = { "entry door" } } else nil
  return footprint(f.ring, { streets = ways, attributes = f, edge_keywords = doors }), House()
end)
town:rule("House", function(this)
  local words = { this:attribute("name"), tostring(this:neighbors()), tostring(this:street_edge()) }
  for edge = 1, this:edges() do
    for _, word in { "blind", "street", "entry door" } do
      if this:edge_has(edge, word) then
        table.insert(words, `{edge} {word}`)
      end
    end
  end
  return Wall(this:shared(2), table.concat(words, ", "))
end)
local made = town:derive()
for _, chain in made.chains do
  print(chain)
end
"#;

#[test]
fn a_row_of_houses_knows_its_party_walls_and_its_street() {
    insta::assert_snapshot!(printed(ROW).join("\n"), @r#"
    Wall(1,"h0, 1, 3, 2 blind, 3 street, 3 entry door")
    Wall(1,"h1, 2, 3, 2 blind, 3 street, 3 entry door, 4 blind")
    Wall(0,"h2, 1, 3, 2 entry door, 3 street, 4 blind")
    "#);
}

#[test]
fn an_edge_that_there_is_not_is_refused() {
    let told = |rest: &str| {
        refused(&format!(
            "local A = module(\"A\")\nlocal s = lsystem({{ object = footprint({{ {{ 0, 0 }}, {{ 8, 0 }}, {{ 8, 8 }} }}{rest}\n"
        ))
    };
    insta::assert_snapshot!(
        told(") })\ns:axiom(A())\ns:rule(\"A\", function(this)\n  return A(this:edge_length(4))\nend)\ns:derive(1)"),
        @r"
    error: s.lua:5:17: rule A: footprint:edge_length: unknown edge 4
      | return A(this:edge_length(4))
      |               ^^^^^^^^^^^
      module: A, step 1
      help: it has the edges 1 to 3: edges of the outer ring, followed by edges of holes
    "
    );
    for (rest, words) in [
        (", { edge_keywords = { [4] = { \"gate\" } } }) })", "edge_keywords refers to the unknown edge 4"),
        (", { edge_keywords = { \"gate\" } }) })", "{ [2] = { \"entry door\" } }, not {\"gate\"}"),
        (", { streets = { { 0, 0 }, { 1, 1 } } }) })", "created once before: streets(source)"),
    ] {
        assert!(told(rest).contains(words), "{}", told(rest));
    }
}
