//! Meshes that a script provides in lists and in buffers.

use crate::{open_edges, run, script};

#[test]
fn meshes_come_from_buffers_as_from_lists() {
    let text = |call: &str| {
        format!(
            r#"
local function floats(list)
  local made = buffer.create(#list * 4)
  for index, number in list do
    buffer.writef32(made, index * 4 - 4, number)
  end
  return made
end
local function whole(list)
  local made = buffer.create(#list * 4)
  for index, number in list do
    buffer.writeu32(made, index * 4 - 4, number)
  end
  return made
end
local A = module("A")
local s = lsystem({{ object = extruder }})
s:axiom(A())
s:interpret("A", function(this)
  {call}
end)
s:derive()
"#
        )
    };
    let corners = "0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1";
    let faces = "0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3";
    let scene = |call: &str| {
        let (_folder, path) = script(&text(call));
        let run = run(&path, 1);
        assert!(call.contains("flat") || open_edges(&run) == 0, "{call}");
        run.scene
    };
    let listed = scene(
        "this:mesh({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { { 1, 3, 2 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 1, 4 } })",
    );
    let held = scene(&format!("this:mesh(floats({{ {corners} }}), whole({{ {faces} }}))"));
    assert_eq!(listed.triangles(), 4);
    let points = |scene: &burgeon::scene::Scene| {
        let part = &scene.meshes[0].parts[0];
        let mut found: Vec<String> = part
            .triangles
            .iter()
            .flat_map(|corners| {
                corners.map(|at| format!("{} {:?}", part.positions[at as usize], part.normals[at as usize]))
            })
            .collect();
        found.sort();
        found
    };
    assert_eq!(points(&listed), points(&held));
    // Buffers and lists can be combined; triangles without area are skipped.
    let mixed = scene(&format!(
        "this:mesh({{ {{ 0, 0, 0 }}, {{ 1, 0, 0 }}, {{ 0, 1, 0 }}, {{ 0, 0, 1 }} }}, whole({{ {faces}, 1, 1, 2 }}))"
    ));
    assert_eq!(points(&mixed), points(&held));
    // Normals, texture coordinates and colours.
    let shaded = scene(&format!(
        "this:mesh(floats({{ {corners} }}), whole({{ {faces} }}), {{ normals = floats({{ {corners} }}), uvs = floats({{ 0, 0, 1, 0, 0, 1, 0.5, 0.5 }}),
           colors = whole({{ 0xff0000ff, 0xff00ff00, 0xff0000ff, 0xffff0000 }}) }})"
    ));
    assert_eq!((shaded.meshes[0].parts.len(), shaded.triangles()), (3, 4), "a part for each colour");
    let red = &shaded.materials[shaded.meshes[0].parts[0].material];
    assert_eq!(red.base_color, [1.0, 0.0, 0.0, 1.0]);
    let part = &shaded.meshes[0].parts[0];
    let at = part.positions.iter().position(|at| at.x > 0.5).unwrap();
    assert!((part.normals[at].vector().x - 1.0).abs() < 1e-3 && (part.uvs[at].x - 1.0).abs() < 1e-6);
    let quads = scene(
        "this:mesh({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }, { { 1, 2, 3, 4 } }, { colors = { \"red\" }, normals = { { 0, 0, 1 }, { 0, 0, 1 }, { 0, 1, 0 }, { 0, 0, 1 } } }) -- flat",
    );
    assert_eq!(quads.triangles(), 2);
}
