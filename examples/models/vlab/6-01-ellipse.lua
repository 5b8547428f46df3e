--!strict
-- Pruning by place: a branch that leaves an ellipse ends in a fork.
-- Source: Virtual Laboratory (cpfg), Enviro-sensitive/ellipse, University of Calgary.
local steps = param("steps", { default = 30, min = 0, max = 40, step = 1, doc = "Steps of growth" })
local half =
  param("half", { default = 10, min = 2, max = 15, unit = "m", doc = "Half of the height of the ellipse" })
local narrow = param("narrow", { default = 2, min = 1, max = 6, doc = "Height of the ellipse by its width" })

local Apex, Branch, Fork = module("Apex"), module("Branch"), module("Fork", "height")

local function is_outside(this: any): boolean
  local place = this:position()
  return (narrow * place.x) ^ 2 + (place.z - half) ^ 2 > half ^ 2 + 1e-9
end

local plant = lsystem({ object = turtle({ angle = 60, width = 0.2, color = "#7a5a3a" }) })
plant:axiom(Apex())
for _, name in { "Apex", "Branch" } do
  plant:rule(name, { when = is_outside }, function(this)
    return Fork(this:position().z)
  end)
end
plant:rule("Apex", function()
  return { Left(), Branch() }, { Right(), Branch() }, F(1), Apex()
end)
plant:rule("Branch", function()
  return F(1), { Color("#5f9a3c"), Sphere(0.25) }, Branch()
end)
plant:interpret("Fork(height)", function(this, height)
  return Color("#8fbf4a"), { Turn(2 * height), F(1) }, { Turn(-2 * height), F(1) }
end)
local tree = plant:derive(steps)

-- A branch from the height y has its nodes at (k sin 60, y + k cos 60). It takes one step more than fit into the
-- ellipse: k is the root of 13/4 k^2 + d k + d^2 - 100 = 0, with d = y - 10. The axis has 21 internodes.
local segments = 21
for y = 0, 20 do
  local d = y - 10
  segments += 2 * (1 + math.floor((-d + math.sqrt(d * d - 13 * (d * d - 100))) / 6.5 + 1e-9))
end
expect(tree.counts.F, segments)
expect(tree.counts.Fork, 2 * 21 + 1)
-- Picture: --azimuth 180 --elevation 0
