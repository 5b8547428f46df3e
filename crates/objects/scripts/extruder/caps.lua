-- Both ends closed, only the start, and none.
local Part = module("Part")
local parts = lsystem({ object = extruder({ sides = 24 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  for number, ends in { { true, true }, { true, false }, { false, false } } do
    this:jump({ 2.6 * number, 0, 0 }):direction({ 0, -1, 1 })
    this:caps(ends[1], ends[2]):material({ color = "#8a9aa8", double_sided = true }):extrude(1.6)
  end
end)
parts:derive()
