--!strict
-- A gate of rubble: a normal map gives flat walls the relief of stones in the light.
local slope = param("slope", { default = 1, min = 0, max = 2, doc = "Relief of the stones" })

local Pier, Wall, Tower = module("Pier", "x"), module("Wall", "x", "length"), module("Tower", "x")

-- Each face is flat. The map has 1.6 m by 1.6 m of wall, of any colour.
local rubble = {
  color = "#b3a184",
  roughness = 0.9,
  normal = "rubble_normal.png",
  normal_scale = slope,
  texture_size = { 1.6, 1.6 },
  name = "rubble",
}
local coping = { color = "#d3cab8", roughness = 0.8, name = "coping" }
local light = { color = "#fff1d6", emissive = { 1, 0.66, 0.3 }, name = "light" }

local gate = lsystem({ object = extruder({ smooth = false }) })
gate:axiom({ Wall(-3, 3.4) }, { Pier(-1) }, { Pier(1) }, { Wall(2, 1.4) }, { Tower(3.7) })

local function ball(this, radius)
  this:material(light):regular(32):smooth(true):scale(0.01)
  for band = 1, 12 do
    local angle = math.pi * band / 12
    local height = math.cos(angle - math.pi / 12) - math.cos(angle)
    this:taper(math.max(radius * math.sin(angle), 0.01)):extrude(radius * height)
  end
end

gate:interpret("Pier(x)", function(this, x)
  this:jump({ x, 0, 0 }):material(rubble):rectangle(0.7, 0.7):extrude(2.2)
  this:material(coping):rectangle(0.82, 0.82):extrude(0.1)
  ball(this, 0.24)
end)
gate:interpret("Wall(x, length)", function(this, x, length)
  this:jump({ x, 0, 0 }):material(rubble):rectangle(length, 0.4):extrude(1.3)
  this:material(coping):rectangle(length, 0.5):extrude(0.1)
end)
gate:interpret("Tower(x)", function(this, x)
  this:jump({ x, 0.5, 0 }):material(rubble):regular(48):smooth(true):extrude(3.6)
  this:material(coping):scale(1.08):extrude(0.16)
end)

gate:derive()
camera({ name = "gate", from = { -2.6, -6.6, 2.2 }, to = { 0.75, 0, 1.5 }, fov = 42 })
