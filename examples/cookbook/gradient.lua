--!strict
-- A shell of twisted plates, with colours by place: `mix` between two colours, `hsv` for a colour of the rainbow.
local plates = param("plates", { default = 60, min = 5, max = 150, step = 1, doc = "Number of plates" })

local Plate = module("Plate", "part")

local shell = lsystem({ object = extruder({ smooth = false }) })
local modules = {}
for number = 0, plates - 1 do
  table.insert(modules, Plate(number / (plates - 1)))
end
shell:axiom(sequence(modules))

shell:interpret("Plate(part)", function(this, part)
  local wide = 1.4 * math.sin(math.pi * (0.12 + 0.85 * part)) + 0.25
  this
    :color(mix("#17324f", "#f2b36b", part))
    :rectangle(2 * wide, 1.1 * wide)
    :extrude(0.06)
    :advance(0.02)
    :roll(4)
end)

shell:derive()
