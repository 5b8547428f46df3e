-- A cube whose side faces become slabs, and whose top becomes a pyramid.
local Mass = module("Mass", "shape")
local cube = lsystem({ object = extruder({ color = "#8fa3b0" }) })
cube:axiom(Mass(cuboid(4, 4, 4)))
cube:rule("Mass(s)", function(this, s: Shape)
  local function slab(face: Shape)
    return Draw(face:setback(0.5)[1]:extrude(0.4))
  end
  local function roof(face: Shape)
    return Draw(face:taper(2):color("#7a4a3c"))
  end
  return Draw(s), components(s, "faces", { { "side", slab }, { "top", roof } })
end)
cube:derive()
