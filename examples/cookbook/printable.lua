--!strict
-- A coral for a 3D printer: all branches are one closed surface, on a plate, and thick enough.
-- burgeon run printable.lua -o coral.stl
local order = param("order", { default = 6, min = 2, max = 8, step = 1, doc = "Forks one above another" })

local Plate, Tip = module("Plate"), module("Tip", "left")

-- A millimetre of the print is a millimetre here.
local coral =
  lsystem({ object = turtle({ joints = "smooth", sides = 16, color = "#d9775f", width = 0.009 }) })
coral:axiom(Plate(), Tip(order))
coral:rule("Tip(left)", function(this, left: number)
  if left == 0 then
    return nil
  end
  local width = 0.002 + 0.0008 * left
  local side = random(34, 44)
  return Width(width),
    F(random(0.01, 0.013)),
    { Turn(side), Tip(left - 1) },
    { Turn(-side), Roll(random(70, 110)), Tip(left - 1) }
end)
coral:interpret("Plate", function(this)
  this:width(0.034):forward(0.002):width(0.009):forward(0.003)
end)
coral:derive()
