--!strict
-- Synthetic topiary: an apex that leaves a box is cut, and a signal runs down from the cut to the next dormant bud,
-- which grows out, until no bud is left.
-- Source: P. Prusinkiewicz, M. James and R. Mech, Synthetic topiary, 1994; Virtual Laboratory (cpfg),
-- Enviro-sensitive/topiary.
local internode =
  param("internode", { default = 0.8, min = 0.7, max = 1, unit = "m", doc = "Length of an internode" })
local size =
  param("size", { default = 2.6, min = 1, max = 4, unit = "m", doc = "Half of the edge of the box" })
local angle =
  param("angle", { default = 32, min = 10, max = 60, unit = "deg", doc = "Angle of the branches" })
local phyllotaxis =
  param("phyllotaxis", { default = 90, min = 0, max = 180, unit = "deg", doc = "From bud to bud" })

local Apex, Cut, Signal, Bud = module("Apex"), module("Cut"), module("Signal"), module("Bud")
local Internode = module("Internode", "length")

local function is_outside(this: any): boolean
  local place = this:position()
  return place.z > 2 * size + 1 or place.z < 1 or math.abs(place.x) > size or math.abs(place.y) > size
end

local hedge = lsystem({ object = turtle({ width = 0.09, color = "#6b4f36", sides = 6 }) })
hedge:ignore("Turn", "Roll")
hedge:axiom(F(1), Internode(internode), Apex())

hedge:rule("Apex", { when = is_outside }, function()
  return Cut()
end)
hedge:rule("Apex", function()
  return Roll(phyllotaxis), Bud(), Internode(internode), Apex()
end)
-- The cut leaves a stub of the last internode, and sends the signal down.
hedge:rule("Internode(length) > Cut", function()
  return Signal(), Internode(0.02)
end)
hedge:rule("Cut", function()
  return nil
end)
hedge:rule("Internode(length) > Signal", function(this, length)
  return Signal(), Internode(length)
end)
hedge:rule("Internode(length) > [Signal]", function(this, length)
  return Signal(), Internode(length)
end)
hedge:rule("Signal", function()
  return nil
end)
hedge:rule("Bud > Signal", function()
  return { Turn(angle), Roll(phyllotaxis), Internode(internode), Apex() }
end)

hedge:interpret("Internode(length)", function(this, length)
  return F(length), { Color("#4f8f3c"), Sphere(0.16) }
end)
local result = hedge:derive()

-- The box, as a frame of wire.
local frame = lsystem({
  object = turtle({ width = 0.03, color = "#8a8a90", heading = { 1, 0, 0 }, position = { -size, -size, 1 } }),
})
local edges: any = { Roll(90) }
for _ = 1, 4 do
  local rise = { Pitch(-90), F(2 * size), Pitch(90), Turn(90), F(2 * size) }
  table.insert(edges, rise)
  table.insert(edges, F(2 * size))
  table.insert(edges, Turn(90))
end
frame:axiom(table.unpack(edges))
frame:derive(0)

-- Each cut wakes one bud as long as a branch has one below the cut, and each woken bud ends in a cut: the signal of the
-- last cut finds no bud, so in the end all buds have grown out, and no apex is left.
expect(result.counts.Bud + result.counts.Apex + result.counts.Signal, 0)
-- The branches end in the box: with the trunk, each has one stub.
local _, stubs = result.chains[1]:gsub("Internode%(0.02%)", "")
expect(stubs, result.counts.Turn + 1)
