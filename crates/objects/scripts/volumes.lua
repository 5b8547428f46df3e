--!strict
-- Boxes at random places; each stays only if it overlaps none before it.
local Block = module("Block", "shape")
local space = volumes()
local boxes = lsystem({ object = extruder({ color = "#b9825a" }), environment = { space } })

local places: { any } = {}
for number = 1, 60 do
  local size = 1 + 2 * noise(number * 0.7)
  local s = cuboid(2 + size, 2 + size, 1 + 3 * math.abs(noise(number * 1.3, 5)))
  places[number] = Block(s:translate(vec(24 * noise(number * 2.1, 1), 24 * noise(number * 3.7, 9), 0)))
end
boxes:axiom(sequence(places))
boxes:rule("Block(s)", function(this, s: Shape)
  return if space:has(s) then Draw(s) else nil
end)
boxes:interpret("Block(s)", function(this, s: Shape)
  space:claim(s)
end)
boxes:derive(1)
