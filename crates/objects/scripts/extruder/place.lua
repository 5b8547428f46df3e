-- The model of another system, placed six times at increasing scale.
local Stone, Part = module("Stone"), module("Part")
local stones = lsystem({ object = extruder({ sides = 5, smooth = false }) })
stones:axiom(Stone())
stones:interpret("Stone", function(this)
  this:scale(0.3):taper(0.15):extrude(0.6)
end)
local stone = stones:derive()

local parts = lsystem({ object = extruder() })
parts:axiom(Part())
parts:interpret("Part", function(this)
  for number = 0, 5 do
    this:jump({ number, 0, 0 }):place(stone, 0.6 + 0.2 * number)
  end
end)
parts:derive()
