--!strict
-- Stones in a garden: random places in a polygon that keep a distance from each other and from the path.
local tries =
  param("tries", { default = 900, min = 10, max = 5000, step = 10, doc = "Number of random places" })

local garden = polygon({ { 0, 0 }, { 14, -2 }, { 18, 6 }, { 11, 11 }, { 2, 9 } })
local path = line({ { -1, 3 }, { 5, 5 }, { 10, 3 }, { 18, 7 } }):buffer(0.8)

local Ground, Stone = module("Ground"), module("Stone", "place", "size")
local yard = lsystem({ object = extruder({ sides = 12 }) })
yard:axiom(Ground())
yard:rule("Ground", function(this)
  local stones, taken = {}, {}
  for _ = 1, tries do
    local place = garden:random_point(random(), random())
    local at, size = place:place() :: Vector, random(0.12, 0.5)
    local is_free = place:distance(path) :: number > size + 0.1
      and place:distance(garden:boundary()) :: number > size
    for _, other in taken do
      is_free = is_free and at:distance(other.at) > size + other.size + 0.06
    end
    if is_free then
      table.insert(taken, { at = at, size = size })
      table.insert(stones, { Stone(at, size) })
    end
  end
  return Ground(), sequence(stones)
end)
yard:interpret("Ground", function(this)
  this:color("#c8bca4"):polygon(garden):jump({ 0, 0, -0.3 }):extrude(0.3)
  this:color("#8d8579"):polygon(path:intersection(garden)):jump({ 0, 0, -0.2 }):extrude(0.23)
end)
yard:interpret("Stone(place, size)", function(this, place, size)
  this:jump(place - vec(0, 0, 0.05)):regular(12):roll(random(0, 90))
  this:color(mix("#6c6f70", "#a8a294", random())):scale(size, size * random(0.7, 1))
  for _, part in { { 1, 0.9, 0.3 }, { 0.9, 0.55, 0.35 }, { 0.55, 0.1, 0.12 } } do
    this:scale(part[1] * size):taper(part[2] * size):extrude(part[3] * size)
  end
end)
yard:derive(1)
