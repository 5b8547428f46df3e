-- From smooth metal to rough paint.
local Part = module("Part")
local parts = lsystem({ object = extruder({ sides = 32 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  for number = 0, 3 do
    this:jump({ 2.2 * number, 0, 0 })
    this:material({ color = "#c98a3a", roughness = 0.15 + 0.25 * number, metallic = 1 - number / 3 })
    for ring = 1, 12 do
      local low, high = math.rad(15 * ring - 15), math.rad(15 * ring)
      this:scale(math.sin(low)):taper(math.sin(high)):extrude(math.cos(low) - math.cos(high))
    end
  end
end)
parts:derive()
