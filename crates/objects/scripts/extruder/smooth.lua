-- 14 sides: smooth, and flat.
local Part = module("Part")
local parts = lsystem({ object = extruder({ sides = 14 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  for number, smooth in { true, false } do
    this:smooth(smooth):jump({ 2.6 * number, 0, 0 }):extrude(1.6)
  end
end)
parts:derive()
