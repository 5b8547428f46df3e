--!strict
-- A stem as a generalised cylinder, with leaves between a bud and a mature form.
-- burgeon run examples/leaf.lua -o leaf.glb
local leaves = param("leaves", { default = 14, min = 1, max = 40, step = 1 })

--- A leaf blade, folded along its midrib by `fold`, and bent down by `bend` at its tip.
local function blade(width: number, fold: number, bend: number): Surface
  local profile = ramp({ { 0, 0.1 }, { 0.3, 1 }, { 0.7, 0.7 }, { 1, 0 } })
  local rows = {}
  for row = 0, 6 do
    local v = row / 6
    local half, drop = width * profile:at(v), bend * v * v
    local points = {}
    for column = 0, 6 do
      local u = column / 3 - 1
      table.insert(points, vec(half * u, fold * half * math.abs(u) - drop, v * (1 - 0.3 * bend * v)))
    end
    table.insert(rows, points)
  end
  return surface({ points = rows, kind = "b-spline", divisions = 4 })
end

local bud = blade(0.05, 1.5, -0.3)
local mature = param("leaf", { default = blade(0.3, 0.35, 0.55), doc = "Mature leaf." })
-- The size and the opening of a leaf by its age, from 0 to 1, and the angle to the stem.
local size = ramp({ { 0, 0.15 }, { 0.5, 0.8 }, { 1, 1 } })
local opening = ramp({ { 0.1, 0 }, { 0.8, 1 } })
local angle = ramp({ { 0, 5 }, { 0.4, 35 }, { 1, 75 } })
local ribbed = curve({
  points = {
    { 1, 0 },
    { 0.75, 0.75 },
    { 0, 1 },
    { -0.75, 0.75 },
    { -1, 0 },
    { -0.75, -0.75 },
    { 0, -1 },
    { 0.75, -0.75 },
  },
  closed = true,
})

local Base, Apex = module("Base"), module("Apex", "number")
local Internode, Leaf, Tip = module("Internode", "age"), module("Leaf", "age"), module("Tip")
local plant = lsystem({ object = turtle({ width = 0.1, sides = 16, color = "#6d8f45", roughness = 0.6 }) })
plant:axiom(Base(), Apex(0))
plant:rule("Apex(number)", function(_, number: number)
  if number == leaves then
    return Tip()
  end
  local age = 1 - number / leaves
  return Internode(age), { Leaf(age) }, Roll(137.5), Apex(number + 1)
end)
plant:interpret("Base", function(this)
  this:contour(ribbed):begin_cylinder()
end)
plant:interpret("Internode(age)", function(this, age)
  this:turn(3):width(0.03 + 0.06 * age):forward(0.05 + 0.2 * size:at(age))
end)
plant:interpret("Tip", function(this)
  this:contour():width(0):forward(0.1):end_cylinder()
end)
plant:interpret("Leaf(age)", function(this, age)
  this:color("#5c8f3a"):pitch(angle:at(age)):surface(bud:mix(mature, opening:at(age)), size:at(age))
end)
plant:derive(leaves + 1)
