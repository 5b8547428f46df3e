--!strict
-- An aqueduct: each arch is a half circle of stones between two piers.
local arches = param("arches", { default = 4, min = 1, max = 12, step = 1, doc = "Number of arches" })
local radius =
  param("radius", { default = 2.6, min = 1, max = 6, unit = "m", doc = "Inner radius of an arch" })

local PIER, RING, DEPTH = 1.4, 0.7, 2

local Pier, Arch, Wall = module("Pier", "x"), module("Arch", "x"), module("Wall")

local bridge = lsystem({ object = extruder({ smooth = false, color = "#c9b48d" }) })
local span = 2 * radius + PIER
local modules = { { Pier(0) } }
for number = 1, arches do
  table.insert(modules, { Arch((number - 0.5) * span) })
  table.insert(modules, { Pier(number * span) })
end
table.insert(modules, { Wall() })
bridge:axiom(sequence(modules))

bridge:interpret("Pier(x)", function(this, x)
  this:jump({ x, 0, 0 }):rectangle(PIER + 0.3, DEPTH + 0.3):extrude(0.5)
  this:rectangle(PIER, DEPTH):extrude(3):rectangle(PIER + 0.3, DEPTH + 0.2):extrude(0.3)
end)
bridge:interpret("Arch(x)", function(this, x)
  for stone = 0, 12 do
    -- The corners of a stone, in the plane of the arch.
    local from, to = math.rad(stone * 180 / 13 + 0.4), math.rad((stone + 1) * 180 / 13 - 0.4)
    local corners = {}
    for _, corner in { { radius, from }, { radius + RING, from }, { radius + RING, to }, { radius, to } } do
      table.insert(corners, { corner[1] * math.cos(corner[2]), corner[1] * math.sin(corner[2]) })
    end
    this:color(mix("#c9b48d", "#8d7752", random(0, 0.5))):direction({ 0, 1, 0 }, { 0, 0, 1 })
    this:jump({ x, -DEPTH / 2 - 0.05, 3.8 }):polygon(corners):extrude(DEPTH + 0.1)
  end
end)
-- The wall above the arches is a long rectangle without the circles under the stones.
bridge:interpret("Wall", function(this)
  local wall = polygon({
    { -PIER / 2, 0 },
    { arches * span + PIER / 2, 0 },
    { arches * span + PIER / 2, radius + 1.3 },
    { -PIER / 2, radius + 1.3 },
  })
  for number = 1, arches do
    wall = wall:difference(point((number - 0.5) * span, 0):buffer(radius + 0.05))
  end
  this:direction({ 0, -1, 0 }, { 0, 0, 1 }):jump({ 0, DEPTH / 2, 3.8 }):polygon(wall):extrude(DEPTH)
  this:direction({ 0, 0, 1 }, { 0, 1, 0 }):jump({ arches * span / 2, 0, radius + 5.1 })
  this:rectangle(arches * span + PIER + 0.5, DEPTH + 0.5):extrude(0.35)
end)

bridge:derive()
