--!strict
-- Schoute's model of tree architecture: the apex of an axis forks into equal apices, as in some palms.
-- Source: L-Py, tutorial/11 - archimodels/schoute, F. Boudon and C. Godin, after F. Halle, R. Oldeman and P. Tomlinson,
-- Tropical trees and forests, 1978.
local forks = param("forks", { default = 4, min = 0, max = 6, step = 1, doc = "Number of forks" })
local angle = param("angle", { default = 16, min = 5, max = 45, unit = "deg", doc = "Angle of a branch" })
local spread =
  param("spread", { default = 4, min = 0, max = 10, unit = "deg", doc = "Bending outwards per internode" })
local fronds = param("fronds", { default = 9, min = 3, max = 20, step = 1, doc = "Leaves at a tip" })
local THICKENING = 0.012 -- of an internode in a step

local Apex, Internode = module("Apex", "left", "order"), module("Internode", "width")

local function internodes(order: number): number
  return 5 // (order + 1) + 5
end

local palm = lsystem({ object = turtle({ color = "#8a6d4a" }), interpret = "last" })
palm:axiom(Apex(internodes(0), 0))
palm:rule("Apex(left, order)", function(this, left, order): any
  if left > 0 then
    return Pitch(if order > 0 then spread else 0), Internode(0.4), Apex(left - 1, order)
  elseif order == forks then
    return Apex(0, order)
  end
  local next = Apex(internodes(order + 1), order + 1)
  return Roll(90), { Pitch(angle), next }, { Roll(180), Pitch(angle), next }
end)
palm:rule("Internode(width)", function(this, width: number)
  return Internode(width + THICKENING)
end)
palm:interpret("Internode(width)", function(this, width)
  return Width(width), F(1)
end)
palm:interpret("Apex", function()
  local crown: any = { Color("#5f9a3f"), Width(0.12) }
  for k = 1, fronds do
    table.insert(
      crown,
      { Roll(k * 137.5), Pitch(25 + 60 * k / fronds), F(1), Pitch(20), F(1), Pitch(30), F(1) }
    )
  end
  return table.unpack(crown)
end)
local steps = forks
for order = 0, forks do
  steps += internodes(order)
end
local result = palm:derive(steps)

-- Axes of the orders 0 to 4 have 10, 7, 6, 6 and 6 internodes, and their number doubles at each fork.
expect(result.counts.Apex, 2 ^ 4)
expect(result.counts.Internode, 10 + 2 * 7 + 4 * 6 + 8 * 6 + 16 * 6)
