--!strict
-- Lanterns along a curve: a model is built once, and placed at equal distances along the path.
local spacing =
  param("spacing", { default = 2.5, min = 0.5, max = 10, unit = "m", doc = "From lantern to lantern" })

local Post, Path, Lantern = module("Post"), module("Path"), module("Lantern", "part")

local smithy =
  lsystem({ object = extruder({ sides = 12, color = "#3b4148", metallic = 1, roughness = 0.5 }) })
smithy:axiom(Post())
smithy:interpret("Post", function(this)
  this:scale(0.16):extrude(0.15):scale(0.09):taper(0.05):extrude(0.5):scale(0.04):extrude(1.7)
  this:scale(0.06):taper(0.17):extrude(0.12)
  this:material({ color = "#ffe2a0", emissive = "#8a6a20" }):scale(0.15):taper(0.2):extrude(0.34)
  this:material({ color = "#3b4148", metallic = 1 }):scale(0.26):taper(0.03):extrude(0.22)
end)
local lantern = smithy:derive()

local path = curve({ { -9, -4, 0 }, { -4, 2, 0 }, { 2, -1.5, 0 }, { 6, 4, 0 }, { 11, 3, 0 } })
local count = math.floor(path:length() / spacing)

local way = lsystem({ object = extruder({ smooth = false }) })
local modules: { any } = { { Path() } }
for number = 0, count do
  table.insert(modules, { Lantern(number / count) })
end
way:axiom(sequence(modules))
way:interpret("Path", function(this)
  local points = {}
  for number = 0, 60 do
    table.insert(points, path:point(number / 60))
  end
  this:color("#b9ab90"):polygon(line(points):buffer(1.1, { cap = "flat" })):extrude(0.06)
end)
way:interpret("Lantern(part)", function(this, part)
  -- The tangent turned by a quarter points to the side of the path.
  local tangent = path:tangent(part)
  this:jump(path:point(part) + vec(-tangent.y, tangent.x, 0) * 1.3):place(lantern)
end)
way:derive()
