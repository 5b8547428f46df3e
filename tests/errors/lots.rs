//! Blocks, lots and sites: errors, properties in scripts, and heights of the buildings on them.

use std::path::Path;
use std::time::{Duration, Instant};

use insta::assert_snapshot;

use crate::support::{Folder, printed, refused};
use crate::warnings::warned;

/// Script of a network of nine blocks, which later lines use as `streets`.
const GRID: &str = r#"local Lead = module("Lead", "from", "x", "y", "depth")
local starts = {}
for x = 0, 3 do
  for y = 0, 3 do
    table.insert(starts, { x * 120, y * 90 })
  end
end
local roads = lsystem({ object = network({ starts = starts, snap = 6 }) })
local ways = {}
for x = 0, 3 do
  for y = 0, 3 do
    local from = x * 4 + y + 1
    if x < 3 then
      table.insert(ways, Lead(from, (x + 1) * 120, y * 90, y % 2))
    end
    if y < 3 then
      table.insert(ways, Lead(from, x * 120, (y + 1) * 90, 1 + x % 2))
    end
  end
end
roads:axiom(table.unpack(ways))
roads:interpret("Lead(from, x, y, depth)", function(this, from, x, y, depth)
  this:grow_to(from, { x, y }, depth)
end)
local streets = roads:derive(0).objects[1]
"#;

fn asked(what: &str) -> String {
    format!("{GRID}{what}")
}

#[test]
fn lots_that_cannot_be_are_refused() {
    assert_snapshot!(refused(&asked("streets:lots({ width = 0 })")), @r"
    error: s.lua:26:9: network:lots: width must be from 1 to 500 m, not 0
      | streets:lots({ width = 0 })
      |         ^^^^
      help: write this:lots(options: { [string]: any }?)
    ");
    assert_snapshot!(refused(&asked("streets:lots({ area = 200, min_area = 150 })")), @r"
    error: s.lua:26:9: network:lots: area (200 m²) is less than twice min_area (150 m²), so a lot above it could not be divided
      | streets:lots({ area = 200, min_area = 150 })
      |         ^^^^
      help: use a greater area, or a smaller min_area
    ");
    assert_snapshot!(refused(&asked("streets:lots({ width = 8, min_width = 12 })")), @r"
    error: s.lua:26:9: network:lots: min_width (12 m) is more than width (8 m)
      | streets:lots({ width = 8, min_width = 12 })
      |         ^^^^
      help: use a greater width, or a smaller min_width
    ");
    assert_snapshot!(refused(&asked("streets:lots({ kind = \"strip\" })")), @r#"
    error: s.lua:26:24: network:lots: unknown kind of lots "strip"
      | streets:lots({ kind = "strip" })
      |                        ^^^^^
      help: did you mean strips?
    "#);
    assert_snapshot!(refused(&asked("streets:lots({ widht = 8 })")), @r"
    error: s.lua:26:16: unknown field `widht` in network:lots
      | streets:lots({ widht = 8 })
      |                ^^^^^
      help: did you mean width?
    ");
    assert_snapshot!(refused(&asked("streets:lots({ blocks = { 3 } })")), @r"
    error: s.lua:26:9: network:lots: blocks must be a list whose item 1 is a polygon: feature.geometry, or { { { x, y }, { x, y }, { x, y } }, hole, ... }, not 3
      | streets:lots({ blocks = { 3 } })
      |         ^^^^
      help: write this:lots(options: { [string]: any }?)
    ");
    assert_snapshot!(refused(&asked("streets:lots({ width = 400, depth = 400 })")), @r"
    error: s.lua:26:9: network:lots: none of 9 blocks has room for a lot with 200 m of front and 48000 m²: the greatest has 7833 m²
      | streets:lots({ width = 400, depth = 400 })
      |         ^^^^
      help: use a smaller width and depth, or fewer parks
    ");
}

#[test]
fn lots_that_are_too_long_are_told() {
    let thin = "local thin = polygon({ { 0, 0 }, { 90, 0 }, { 90, 9 }, { 0, 9 } })\n\
        local lots = network({}):lots({ blocks = { thin }, width = 80, min_width = 60 })\nassert(#lots == 0)";
    let told = warned(&[thin]);
    let told: Vec<&str> = told.lines().skip_while(|line| !line.contains("network:lots")).take(3).collect();
    assert_snapshot!(told.join("\n"), @r"
    warning: s.lua:2:1: network:lots: skipped 1 lot more than 4 times as long as wide, up to 10.0 times
      | local lots = network({}):lots({ blocks = { thin }, width = 80, min_width = 60 })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
    ");
    let whole = thin.replace("min_width = 60", "min_width = 60, elongation = 11").replace("== 0", "== 1");
    assert_eq!(printed(&format!("{whole}\nprint(\"sound\")")), ["sound"]);
    assert_snapshot!(refused(&asked("streets:lots({ terrace = 0 })")), @r"
    error: s.lua:26:9: network:lots: terrace must be from 0.5 to 1000 m, not 0
      | streets:lots({ terrace = 0 })
      |         ^^^^
      help: write this:lots(options: { [string]: any }?)
    ");
}

/// Returns the warnings of a run about lots and sites.
fn left_out(script: &str) -> String {
    let folder = Folder::new().with("s.lua", script);
    let said = folder.burgeon(&["run", "s.lua"]).done().stderr;
    let lines: Vec<&str> = said.lines().collect();
    let of = |at: &usize| lines[*at].starts_with("warning: ") && lines[*at].contains("network:");
    (0..lines.len()).filter(of).map(|at| lines[at..at + 3].join("\n")).collect::<Vec<_>>().join("\n")
}

#[test]
fn lots_that_an_obstacle_reaches_into_are_told_once_and_counted() {
    let pond = "polygon({ { 30, 20 }, { 60, 20 }, { 60, 40 }, { 30, 40 } })";
    let wet = |what: &str| asked(what).replace("snap = 6", &format!("snap = 6, obstacles = {{ {pond} }}"));
    assert_snapshot!(left_out(&wet("streets:lots({ width = 16 })")), @r"
    warning: s.lua:26:9: network:lots: skipped 4 lots that overlap an obstacle or water
      | streets:lots({ width = 16 })
      |         ^^^^
    ");
    // With `all = true`, blocked lots are included.
    let all = "local blocked = 0\nfor _, lot in streets:lots({ width = 16, all = true }) do\n\
        blocked += if lot.use == \"blocked\" then 1 else 0\nend\nassert(blocked > 0)";
    assert_eq!(left_out(&wet(all)), "");
    assert_eq!(left_out(&asked("streets:lots({ width = 16 })")), "");
    let ponds = "local ponds = {}\nfor x = 0, 240, 120 do\n  for y = 0, 180, 90 do\n    table.insert(ponds, polygon({ { x + 15, y + 15 }, \
                 { x + 105, y + 15 }, { x + 105, y + 75 }, { x + 15, y + 75 } }))\n  end\nend\n";
    let ponds = format!("{ponds}{}", asked("streets:lots({ width = 16 })"));
    assert_snapshot!(refused(&ponds.replace("snap = 6", "snap = 6, obstacles = ponds")), @r"
    error: s.lua:32:9: network:lots: all 147 lots overlap an obstacle or water
      | streets:lots({ width = 16 })
      |         ^^^^
      help: use a smaller width and depth, or fewer obstacles
    ");
}

#[test]
fn blocks_and_networks_without_any_lot_are_told() {
    let given = |blocks: &str| {
        format!(
            "local blocks = {{ {blocks} }}\nnetwork({{}}):lots({{ blocks = blocks, width = 12, elongation = 9 }})"
        )
    };
    let yard = "{ { { 0, 0 }, { 90, 0 }, { 90, 60 }, { 0, 60 } } }";
    let flat = "{ { { 0, 0 }, { 90, 0 }, { 180, 0 } } }";
    let far = "{ { { 9e6, 0 }, { 9.0001e6, 0 }, { 9.0001e6, 60 } } }";
    let small = "{ { { 0, 0 }, { 5, 0 }, { 5, 4 }, { 0, 4 } } }";
    assert_eq!(left_out(&given(yard)), "");
    assert_eq!(left_out(&given("")), "");
    assert_snapshot!(left_out(&given(&format!("{yard}, {flat}, {far}"))), @r"
    warning: s.lua:2:13: network:lots: skipped 2 of 3 blocks: they have no area inside their borders, or are more than 500 km from the origin
      | network({}):lots({ blocks = blocks, width = 12, elongation = 9 })
      |             ^^^^
    ");
    assert_snapshot!(left_out(&given(&format!("{small}, {small}"))), @r"
    warning: s.lua:2:13: network:lots: none of 2 blocks has room for a lot with 6 m of front and 100.8 m²: the greatest has 20 m²
      | network({}):lots({ blocks = blocks, width = 12, elongation = 9 })
      |             ^^^^
    ");
    assert_eq!(left_out(&given(&format!("{small}, {yard}"))), "");
    assert_eq!(left_out(&given(small).replace("width", "parks = 1, width")), "");
    assert_snapshot!(left_out("network({}):lots({})\nnetwork({}):sites({})"), @r"
    warning: s.lua:1:13: network:lots: the streets enclose no block to divide
      | network({}):lots({})
      |             ^^^^
    warning: s.lua:2:13: network:sites: the network has no streets
      | network({}):sites({})
      |             ^^^^^
    ");
}

#[test]
fn sites_that_cannot_be_are_refused() {
    assert_snapshot!(refused(&asked("streets:sites({ sizes = {} })")), @r"
    error: s.lua:26:9: network:sites: sizes must contain at least one pair of numbers from 1 to 500
      | streets:sites({ sizes = {} })
      |         ^^^^^
      help: write sizes = { { 24, 18 }, { 12, 10 } }
    ");
    assert_snapshot!(refused(&asked("streets:sites({ along = 0 })")), @r"
    error: s.lua:26:9: network:sites: along must be from 0.5 to 1000, not 0
      | streets:sites({ along = 0 })
      |         ^^^^^
      help: write this:sites(options: { [string]: any }?)
    ");
    assert_snapshot!(refused(&asked("streets:sites({ setback = 30, distance = 10 })")), @r"
    error: s.lua:26:9: network:sites: setback (30 m) is more than distance (10 m), so no site fits next to a street
      | streets:sites({ setback = 30, distance = 10 })
      |         ^^^^^
      help: use a smaller setback, or a greater distance
    ");
    // Four streets of 60 m leave no room between them for such a hall.
    let cross = format!(
        "local Go = module(\"Go\")\nlocal s = lsystem({{ object = network() }}) s:axiom(Go())\n\
         s:interpret(\"Go\", function(this) for way = 0, 270, 90 do this:grow(1, way, 60, 0) end end)\n\
         s:derive(0).objects[1]:sites({})",
        "{ sizes = { { 200, 200 } } }"
    );
    assert_snapshot!(refused(&cross), @r"
    error: s.lua:4:24: network:sites: no room for a site at any of 176 positions: 176 overlap a street
      | s:derive(0).objects[1]:sites({ sizes = { { 200, 200 } } })
      |                        ^^^^^
      help: use smaller sizes, or a smaller setback
    ");
    assert_snapshot!(refused(&asked("streets:sites({ along = 0.5, away = 0.5, distance = 2000 })")), @r"
    error: s.lua:26:9: network:sites: 40289760 positions along the streets are too many
      | streets:sites({ along = 0.5, away = 0.5, distance = 2000 })
      |         ^^^^^
      help: use greater distances along and away
    ");
}

#[test]
fn lots_of_a_block_do_not_depend_on_the_other_blocks() {
    let said = printed(&asked(
        r#"
local every = {}
for _, kind in { "boxes", "strips", "skeleton" } do
  local known = {}
  for _, lot in streets:lots({ kind = kind, seed = 4 }) do
    known[lot.id] = lot
  end
  local same, count = 0, 0
  for _, block in streets:blocks() do
    for _, lot in streets:lots({ kind = kind, seed = 4, blocks = { block } }) do
      count += 1
      if known[lot.id] and known[lot.id].geometry:wkt() == lot.geometry:wkt() and known[lot.id].block == block.id then
        same += 1
      end
    end
  end
  local all = 0
  for _ in known do
    all += 1
  end
  assert(same == count and count == all, `{kind}: {same} of {count} of {all}`)
end
local parks, area = 0, 0
for _, block in streets:blocks() do
  area += block.area
end
for _, lot in streets:lots({ parks = 0.5, all = true, kind = "strips", depth = 20, width = 12 }) do
  parks += if lot.use == "park" then 1 else 0
  area -= lot.area
end
assert(math.abs(area) < 0.01, `{area}`)
print(parks > 0 and parks < 9)
"#,
    ));
    assert_eq!(said, ["true"]);
}

/// Returns the output of a script that requires the templates.
fn told(script: &str) -> String {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts/templates/skyline.lua");
    let folder = Folder::new()
        .with("templates/skyline.lua", std::fs::read(source).unwrap())
        .with("s.lua", asked(script));
    folder.burgeon(&["run", "s.lua"]).done().stderr
}

#[test]
fn heights_fall_with_the_depth_of_the_street_and_vary_with_the_height() {
    let said = told(
        r#"
local skyline = require("templates/skyline")
local function ranks(values)
  local order, rank = {}, {}
  for index in values do
    table.insert(order, index)
  end
  table.sort(order, function(a, b) return values[a] < values[b] end)
  local first = 1
  while first <= #order do
    local last = first
    while last < #order and values[order[last + 1]] == values[order[first]] do
      last += 1
    end
    for place = first, last do
      rank[order[place]] = (first + last) / 2
    end
    first = last + 1
  end
  return rank
end
local function correlation(a, b)
  local x, y, n = ranks(a), ranks(b), #a
  local mean = (n + 1) / 2
  local xy, xx, yy = 0, 0, 0
  for index = 1, n do
    xy += (x[index] - mean) * (y[index] - mean)
    xx += (x[index] - mean) ^ 2
    yy += (y[index] - mean) ^ 2
  end
  return xy / math.sqrt(xx * yy)
end
local depths, heights, kinds, spans = {}, {}, {}, {}
for number = 1, 3000 do
  local depth = number % 5
  local lot = { id = tostring(number), street_depth = depth, access = vec(0, 0, 0) }
  local building = skyline.building(lot, { chance = 0 })
  depths[number], heights[number] = depth, building.height
  kinds[building.kind] = (kinds[building.kind] or 0) + 1
  local span = spans[depth] or { math.huge, 0 }
  spans[depth] = { math.min(span[1], building.height), math.max(span[2], building.height) }
end
local found = correlation(depths, heights)
assert(found < -0.9, `Spearman {found}`)
for depth = 1, 4 do
  local main, side = spans[depth - 1], spans[depth]
  assert(main[2] - main[1] > side[2] - side[1], "the random share grows with the height")
end
assert(kinds.detached > 500 and kinds.block > 500)
-- The tallest, and they alone, may be skyscrapers; low houses all have one size.
local towers = 0
for number = 1, 3000 do
  local lot = { id = tostring(number), street_depth = number % 5, access = vec(0, 0, 0) }
  local building = skyline.building(lot, { chance = 0.2 })
  if building.kind == "tower" then
    towers += 1
    assert(number % 5 == 0)
  elseif building.kind == "detached" then
    assert(building.width == 11 and building.depth == 9)
  else
    local wide, deep = building.width / (12 + building.height * 0.28), building.depth / (11 + building.height * 0.22)
    assert(math.max(wide, deep) > 1 - 1e-9 and math.min(wide, deep) >= 0.5)
  end
end
assert(towers > 20, `{towers}`)
for _, by in { "noise", "centres", "presets", { depth = 1, noise = 1 } } do
  local low, high = math.huge, 0
  for number = 1, 300 do
    local lot = { id = tostring(number), street_depth = 1, access = vec(number * 7, number % 17 * 40, 0) }
    local building = skyline.building(lot, { by = by })
    low, high = math.min(low, building.height), math.max(high, building.height)
  end
  assert(low > 0 and high > low * 1.3, "heights differ")
end
print("fine")
"#,
    );
    assert!(said.contains("fine"), "{said}");
}

#[test]
fn plans_of_all_forms_stay_in_their_lots() {
    let said = told(
        r#"
local skyline = require("templates/skyline")
local count, forms = 0, {}
for _, kind in { "boxes", "strips", "skeleton" } do
  for _, form in { "any", table.unpack(skyline.forms) } do
    local lots = streets:lots({ kind = kind, width = 26, depth = 34 })
    local plans = if form == "any" then nil else { form = form, side = 1 }
    local parts = skyline.buildings(lots, { low = 20 }, plans, 7)
    assert(#parts >= #lots * 0.8, `{#parts} parts on {#lots} lots`)
    local plans_of = {}
    for number, part in parts do
      local rings = {}
      for _, ring in part.geometry.rings do
        local flat = {}
        for _, point in ring do
          table.insert(flat, { point[1], point[2] })
        end
        table.insert(rings, flat)
      end
      local plan = polygon(rings)
      assert(plan:is_valid(), `{form}: {plan:validity()}`)
      assert(part.lot.geometry:covers(plan), `{form} of {part.id} leaves its lot`)
      assert(form == "row" or part.lot.geometry:boundary():distance(plan) > 0.99, form)
      count += 1
      for other = 1, number - 1 do
        if parts[other].lot ~= part.lot then
          assert(not plan:overlaps(plans_of[other]), `{form}: plans overlap`)
        end
      end
      table.insert(plans_of, plan)
    end
  end
  for _, lot in streets:lots({ kind = kind, width = 14, depth = 30 }) do
    local row = skyline.row(lot, 12)
    assert(row:is_empty() or lot.geometry:covers(row))
  end
end
print(`fine {count > 500}`)
"#,
    );
    assert!(said.contains("fine true"), "{said}");
}

#[test]
fn blocks_that_lie_on_each_other_are_told() {
    let divided = |places: &str| {
        left_out(&format!(
            "local blocks = {{}}\nfor _, x in {{ {places} }} do\n\
             table.insert(blocks, polygon({{ {{ x, 0 }}, {{ x + 80, 0 }}, {{ x + 80, 60 }}, {{ x, 60 }} }}))\nend\n\
             network({{}}):lots({{ blocks = blocks }})"
        ))
    };
    assert_snapshot!(divided("0, 70"), @r#"
    warning: s.lua:5:13: network:lots: the blocks "40:30" and "110:30" overlap by 600.00 m², so lots overlap
      | network({}):lots({ blocks = blocks })
      |             ^^^^
    "#);
    let told = divided("0, 79, 40");
    assert!(told.contains("overlap by 2460.00 m², and 2 more pairs of blocks overlap, so lots"), "{told}");
    // For very many pairs, the message does not have the exact number.
    let many = (0..20).map(|x| x.to_string()).collect::<Vec<_>>().join(", ");
    let told = divided(&many);
    assert!(told.contains("and at least 99 more pairs of blocks overlap"), "{told}");
    // Blocks with a common border do not overlap.
    assert_eq!(divided("0, 80, 160"), "");
}

#[test]
fn lots_are_stopped_at_the_time_limit() {
    let many = "for i = 0, 199 do\n  for j = 0, 49 do\n    local x, y = i * 100, j * 100\n    table.insert(blocks, \
                polygon({ { x, y }, { x + 90, y }, { x + 90, y + 60 }, { x, y + 60 } }))\n  end\nend\n";
    // Every part of a comb is near its border, and therefore next to streets.
    let comb = "local ring = { { 0, -30 }, { 30000, -30 } }\nfor tooth = 999, 0, -1 do\n  local x = tooth * 30\n  \
                for _, place in { { 24, 400 }, { 4, 400 }, { 4, 0 }, { 0, 0 } } do\n    \
                table.insert(ring, { x + place[1], place[2] })\n  end\nend\nblocks[1] = polygon(ring)\n";
    for (blocks, kind) in [(many, "strips"), (comb, "boxes"), (comb, "skeleton")] {
        let script = format!(
            "local blocks = {{}}\n{blocks}network({{}}):lots({{ blocks = blocks, kind = \"{kind}\", width = 3, depth = 9 }})"
        );
        let folder = Folder::new().with("s.lua", &script);
        let begin = Instant::now();
        let said = folder.burgeon(&["run", "s.lua", "--time-limit", "1"]).failed();
        assert!(begin.elapsed() < Duration::from_secs(10), "{kind}: {:?}", begin.elapsed());
        assert!(
            said.contains("the run exceeded the time limit of 1 s") && said.contains("network({}):lots"),
            "{said}"
        );
    }
}
