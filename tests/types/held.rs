//! Child objects, and functions that override inherited ones.

use crate::{glb, open_edges, printed, run, script};

const NESTED: &str = r#"
local lamp = object("lamp", {
  extends = extruder,
  fields = { glow = 2 },
  state = { count = 0, log = {} },
  reads = { lit = function(self) return self.count * self.glow end },
  begin = function(self) self:color("red") end,
  push = function(self) table.insert(self.log, "push") end,
  finish = function(self) table.insert(self.log, "finish") end,
  changes = { light = function(self, reach) self.count += 1 return self:jump({ self.count, 0, 0 }):scale(0.1):extrude(reach) end },
})
local arm = object("arm", {
  state = { lamp = lamp({ glow = 3 }), length = 0, mast = extruder() },
  reads = { light = function(self) return self.lamp:lit() + self.length end },
  changes = { reach = function(self, n) self.length += n self.lamp:light(n):light(n) self.mast:jump({ 0, self.length, 0 }):extrude(n) end },
})
local tree = object("tree", {
  extends = turtle,
  state = { west = arm(), east = arm(), n = 0 },
  reads = { light = function(self) return self.west:light() * 100 + self.east:light() end },
  changes = {
    grow = function(self, n)
      self.n += 1
      self.west:reach(n)
      self.east:reach(2 * n):reach(n)
      self:forward(n)
    end,
  },
})
local A = module("A", "n")
local s = lsystem({ object = tree })
s:axiom(source("field.geojson"), function(feature) return A(1 + feature.n % 3), { A(1) } end)
s:rule("A(n)", function(this, n)
  if this:light() > 0 and this.west:light() < 40 then
    return A(n), A(this.west.lamp.count)
  end
end)
s:interpret("A(n)", function(this, n) this:grow(n) end)
local derived = s:derive(3)
for index = 1, 6 do
  local object = derived.objects[index]
  print(object.n, object:light(), object.west.length, object.west.lamp.count, object.west.lamp:lit(), table.concat(object.west.lamp.log, " "))
end
for _, chain in derived.chains do
  print(chain)
end
"#;

#[test]
fn objects_of_types_of_scripts_are_held_by_others_and_keep_a_state_for_each_chain() {
    let one = printed(NESTED, 1);
    // Features 0 and 3 begin equally, as do 1 and 4: chains do not share child objects.
    assert_eq!(
        (one[0] == one[3], one[1] == one[4], one[0] == one[1]),
        (true, true, false),
        "{:?}",
        &one[..6]
    );
    assert_eq!(one[0], "8\t9222\t42\t16\t48\tpush finish");
    for threads in [2, 7] {
        assert_eq!(printed(NESTED, threads), one, "{threads} threads");
    }
    let (_folder, path) = script(NESTED);
    let bytes: Vec<Vec<u8>> = [1, 2, 7].map(|threads| glb(&run(&path, threads))).to_vec();
    assert!(bytes.windows(2).all(|pair| pair[0] == pair[1]));
    let drawn = run(&path, 1);
    assert_eq!(
        (drawn.scene.instances.len(), open_edges(&drawn)),
        (200, 0),
        "each draws into its owner's drawing"
    );
}

#[test]
fn a_function_that_says_anew_what_another_does_can_call_it() {
    let text = r#"
local one = object("one", {
  extends = extruder,
  state = { text = "" },
  reads = { name = function(self) return "one" .. #self.text end },
  changes = { go = function(self, x) self.text ..= `one {self:name()} {x};` end },
})
local two = object("two", {
  extends = one,
  reads = { name = function(self) return self:as(one):name() .. " two" end },
  changes = { go = function(self, x)
    self.text ..= "two "
    return self:as(one):go(x + 1)
  end },
})
local three = object("three", {
  extends = two,
  changes = { go = function(self, x) self:as(two):go(x + 1):as(extruder):extrude(1) self:as(one):go(0) end },
})
local holder = object("holder", {
  state = { held = three() },
  reads = { text = function(self) return self.held.text .. self.held:as(one):name() end },
  changes = { go = function(self, x) self.held:go(x) end },
})
local A = module("A")
for _, constructor in { three, holder } do
  local s = lsystem({ object = constructor })
  s:axiom(A())
  s:interpret("A", function(this) this:go(1) end)
  s:rule("A", function(this)
    print("a rule reads", if constructor == three then this:as(one):name() else this.held:name())
    return nil
  end)
  local object = s:derive(0).objects[1]
  print(if constructor == three then object.text .. object:as(one):name() else object:text())
end
"#;
    let lines = printed(text, 1);
    assert_eq!(lines.len(), 2, "{lines:?}");
    assert!(lines.iter().all(|line| line.starts_with("two one one4 two 3;one one")), "{lines:?}");
    assert_eq!(lines[0], lines[1]);
}

#[test]
fn what_is_held_draws_with_its_own_colour_and_its_owner_with_its() {
    let text = r##"
local own = object("own", {
  extends = turtle,
  state = { pen = turtle({ color = "#ff0000", width = 0.3 }), rail = extruder({ color = "#00ff00" }) },
  changes = { go = function(self)
    self.pen:jump({ 1, 0, 0 }):forward(1)
    self.rail:jump({ 2, 0, 0 }):extrude(1)
  end },
})
local A = module("A")
local s = lsystem({ object = own({ color = "#0000ff" }) })
s:axiom(F(1), A(), F(1))
s:interpret("A", function(this) this:go() end)
s:derive(0)
"##;
    let (_folder, path) = script(text);
    let run = run(&path, 1);
    let mut seen: Vec<(String, i32)> = Vec::new();
    for part in &run.scene.meshes[0].parts {
        let [red, green, blue, _] = run.scene.materials[part.material].base_color;
        let middle: f32 = part.positions.iter().map(|at| at.x).sum::<f32>() / part.positions.len() as f32;
        #[allow(clippy::cast_possible_truncation, reason = "places are near")]
        seen.push((format!("{red} {green} {blue}"), middle.round() as i32));
    }
    seen.sort();
    assert_eq!(seen, [("0 0 1".to_owned(), 0), ("0 1 0".to_owned(), 2), ("1 0 0".to_owned(), 1)]);
}
