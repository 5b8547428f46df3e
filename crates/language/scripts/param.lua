-- A value that --set floors=7 or the live view can change.
local floors = param("floors", { default = 3, min = 1, max = 40, step = 1, doc = "How many floors." })
local Floor = module("Floor", "left")
local tower = lsystem({ object = extruder({ sides = 6 }) })
tower:axiom(Floor(floors))
tower:rule("Floor(left)", function(this, left)
  if left > 1 then
    return F(3), Floor(left - 1)
  end
  return F(3)
end)
tower:interpret("F(height)", function(this, height)
  this:extrude(height)
end)
tower:derive()
