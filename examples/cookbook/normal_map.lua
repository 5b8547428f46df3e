--!strict
-- A gate of rubble: a normal map gives flat walls the relief of stones in the light.
local slope = param("slope", { default = 1, min = 0, max = 2, doc = "Relief of the stones" })

local Pier, Wall, Tower = module("Pier", "x"), module("Wall", "x", "length"), module("Tower", "x")

-- Each face is flat. The map has 1.6 m by 1.6 m of wall, of any colour.
local rubble = {
  color = "#a39279",
  roughness = 0.9,
  normal = "rubble_normal.png",
  normal_scale = slope,
  texture_size = { 1.6, 1.6 },
  name = "rubble",
}
local coping = { color = "#c9c0ae", roughness = 0.8, name = "coping" }
local light = { color = "#fff1d6", emissive = { 1, 0.72, 0.36 }, name = "light" }

local gate = lsystem({ object = extruder({ sides = 4, smooth = false }) })
gate:axiom(Pier(-1.4), Pier(1.4), Wall(-4.05, 4.5), Wall(2.9, 2.2), Tower(5.2))

local function top(this, width, depth)
  this:material(coping):rectangle(width + 0.12, depth + 0.12):extrude(0.12)
end
gate:interpret("Pier(x)", function(this, x)
  this:jump({ x, 0, 0 }):material(rubble):rectangle(0.8, 0.8):extrude(2.4)
  top(this, 0.8, 0.8)
  this:material(light):regular(24):smooth(true):scale(0.02):taper(0.2):extrude(0.12):extrude(0.16):taper(0.02):extrude(0.12)
end)
gate:interpret("Wall(x, length)", function(this, x, length)
  this:jump({ x, 0, 0 }):material(rubble):rectangle(length, 0.4):extrude(1.3)
  top(this, length, 0.4)
end)
gate:interpret("Tower(x)", function(this, x)
  this:jump({ x, 0, 0 }):material(rubble):regular(48):smooth(true):scale(1.25):extrude(4)
  this:material(coping):scale(1.35):extrude(0.2)
end)

gate:derive()
