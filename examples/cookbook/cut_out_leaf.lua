--!strict
-- A window plant: leaves with slits and holes, cut out of one outline by the operations of geometries.
local leaves = param("leaves", { default = 7, min = 1, max = 15, step = 1, doc = "Number of leaves" })

local Stalk, Leaf = module("Stalk", "length"), module("Leaf", "size")

-- The outline (m) of a heart, with its tip at the bottom; then slits from the edge, and holes next to the midrib.
local outline = {}
for number = 0, 47 do
  local angle = math.rad(7.5 * number)
  local x = 0.032 * 16 * math.sin(angle) ^ 3
  local y = 0.032
    * (13 * math.cos(angle) - 5 * math.cos(2 * angle) - 2 * math.cos(3 * angle) - math.cos(4 * angle))
  table.insert(outline, { x, y })
end
local shape = polygon(outline)
for number = 0, 4 do
  local y = 0.2 - 0.14 * number
  for _, side in { 1, -1 } do
    shape = shape:difference(
      line({ side * (0.2 - 0.01 * number), y + 0.04 }, { side * 0.7, y - 0.12 }):buffer(0.022)
    )
    shape = shape:difference(line({ side * 0.08, y - 0.03 }, { side * 0.12, y - 0.045 }):buffer(0.014))
  end
end

-- A leaf is a thin plate of that section, built once.
local Blade = module("Blade")
local press = lsystem({ object = extruder({ smooth = false, color = "#3f7a3d" }) })
press:axiom(Blade())
press:interpret("Blade", function(this)
  for _, part in shape:geometries() do
    this:polygon(part):extrude(0.006):advance(-0.006)
  end
end)
local blade = press:derive()

local plant = lsystem({ object = turtle({ width = 0.035, color = "#6a8a45", sides = 10 }) })
local modules = {}
for number = 1, leaves do
  table.insert(modules, Roll(137.5))
  table.insert(modules, { Stalk(0.7 + 0.12 * number), Leaf(0.55 + 0.05 * number) })
end
plant:axiom(sequence(modules))
plant:interpret("Stalk(length)", function(this, length)
  this:pitch(12)
  for _ = 1, 6 do
    this:forward(length / 6):pitch(5)
  end
end)
plant:interpret("Leaf(size)", function(this, size)
  this:pitch(62):roll(180):advance(-0.2 * size):pitch(-90):place(blade, size)
end)
plant:derive()
