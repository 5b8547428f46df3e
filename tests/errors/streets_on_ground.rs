//! Streets on a terrain, and the terrain under them.

use insta::assert_snapshot;

use crate::networks::grown;
use crate::support::{printed, refused};
use crate::warnings::warned;

/// Returns a script with streets on hills, with the terrain adapted to them; it prints the values `asked`.
fn on_hills(seed: u32, fields: &str, asked: &str) -> String {
    format!(
        r#"
local Tip = module("Tip", "junction", "heading", "depth")
local function land(roads)
  return lsystem({{
    object = terrain({{
      size = 640, levels = 7, error = 0.1, decay = 40, under = roads, visible = roads ~= nil,
      rules = {{ A = {{ "A", "A", "A", "A", change = {{ {{ -1, 1 }}, {{ -1, 1 }}, {{ -1, 1 }}, {{ -1, 1 }} }}, decay = 0.5 }} }},
    }}),
    seed = {seed},
  }}):derive().objects[1]
end
local roads = lsystem({{
  object = network({{
    streets = {{ {{ width = 20, lanes = 2 }}, {{ width = 12 }} }}, on = land(),
    limit = {{ {{ -240, -240 }}, {{ 240, -240 }}, {{ 240, 240 }}, {{ -240, 240 }} }}, {fields}
  }}),
  seed = {seed},
}})
roads:axiom(Tip(1, 10, 0), Tip(1, 100, 0), Tip(1, 190, 0))
roads:rule("Tip(junction, heading, depth)", function(this, junction, heading, depth)
  local at = this:open_end(junction, heading)
  if not at then
    return nil
  end
  return Tip(at, heading + random(-9, 9), depth), Tip(at, heading + 90, depth + 1), Tip(at, heading - 90, depth + 1)
end)
roads:interpret("Tip(junction, heading, depth)", function(this, junction, heading, depth)
  this:grow(junction, heading, 75, depth)
end)
local streets = roads:derive(3).objects[1]
local ground = land(streets)
{asked}
"#
    )
}

#[test]
fn the_ground_under_streets_is_level_with_their_sidewalks() {
    for seed in 1..=6 {
        let asked = r#"
local under, high, most = 0, 0, -math.huge
for x = -250, 250, 3.1 do
  for y = -250, 250, 3.1 do
    local at = { x, y }
    -- Half of the narrowest street. The ground that is shown has holes there.
    if streets:distance(at) < 6 then
      under += 1
      local above = ground:height(at) - streets:height(at)
      most = math.max(most, above)
      high += if above < -1.5 then 1 else 0
    end
  end
end
assert(under > 500, under)
-- The triangles of the ground are off by 0.1 m.
assert(most < 0.2, `the ground is {most} m above a sidewalk`)
-- Where another street beside it lies lower.
assert(high < 0.03 * under, `{high} of {under} places of streets are high above the ground`)
print("sound")
"#;
        let script = on_hills(seed, "max_slope = 9", asked);
        assert_eq!(printed(&script), ["sound"], "seed {seed}");
    }
}

#[test]
fn streets_that_cut_deep_into_the_ground_are_told() {
    let warnings = warned(&[&on_hills(3, "max_slope = 1", "")]);
    let told = warnings.lines().find(|line| line.starts_with("warning")).unwrap_or_default();
    assert_snapshot!(told, @"warning: s.lua:4:3: network: 33 of 57 street segments are more than 8 m above or below the ground, up to 24.1 m, to keep max_slope = 1 %");
}

#[test]
fn ground_that_is_shown_without_its_streets_is_told() {
    let is_told =
        |script: &str| warned(&[script]).contains("the visible terrain is not adapted to the streets");
    let script = on_hills(3, "max_slope = 9", "");
    assert!(!is_told(&script), "{script}");
    let shown = script.replace("visible = roads ~= nil", "visible = true");
    assert!(shown != script && is_told(&shown), "{script}");
}

#[test]
fn streets_beyond_their_ground_are_refused() {
    assert_snapshot!(refused(&grown("on = 3", "")), @r"
    error: s.lua:2:30: network: on must be a derived terrain: land:derive().objects[1], not 3
      | local s = lsystem({ object = network({ on = 3 }) })
      |                              ^^^^^^^
      help: on takes Terrain: Terrain under the streets, which must already be derived
    ");
    assert_snapshot!(refused(&grown("max_slope = 0", "")), @r"
    error: s.lua:2:30: network: max_slope must be from 0.1 to 100, not 0
      | local s = lsystem({ object = network({ max_slope = 0 }) })
      |                              ^^^^^^^
      help: max_slope takes a number, 10 unless given: Maximum slope (%) of streets on the terrain
    ");
    let land = "local land = lsystem({ object = terrain({ size = 64, levels = 4, rules = { A = { \"A\", \"A\", \"A\", \"A\" } } }) }):derive().objects[1]\n";
    assert_snapshot!(refused(&format!("{land}{}", grown("on = land", "this:grow(1, 0, 200, 0)"))), @r"
    error: s.lua:3:30: network: on: the terrain has no ground at (200.0, 0.0), below a street
      | local s = lsystem({ object = network({ on = land }) })
      |                              ^^^^^^^
      help: enlarge the terrain, derive it before, or keep streets on it: network { limit = ... }
    ");
}
