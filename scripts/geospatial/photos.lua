--!strict
-- Buildings with a photo on each frontage, by one rule.
-- burgeon run scripts/geospatial/photos.lua --data examples/data -o photos.glb
local details = require("details")
local layers = require("layers")

local Building = module("Building", "geom", "floors", "style", "roof")
local Facade, Photo = module("Facade", "line", "image", "floors"), module("Photo", "line", "image", "height")
local Roof = module("Roof", "geom", "height", "roof")

local storey = details.storey

local town = lsystem({ object = extruder({ smooth = false, roughness = 0.95 }) })
-- The style in the data selects the photo.
town:axiom(query(layers.buildings, Building))
town:rule("Building(geom, floors, image, roof)", function(_, geom, floors, image, roof)
  return Roof(geom, floors * storey, roof), Facade(geom:exterior_ring(), image, floors), fragment(Facade)
end)
town:rule("Facade(line, image, floors)", function(_, line, image, floors)
  return Photo(line, image, floors * storey)
end)

-- The photos show four storeys and four bays of about 3 m. A narrow wall shows as many bays as fit.
town:interpret("Photo(line, image, height)", function(this, line, image, height)
  local from, to = line:start_point():place(), line:end_point():place()
  local along, length = (to - from):unit(), line:length()
  local bays = math.max(1, math.round(length / 3))
  local out = vec(along.y, -along.x, 0) * 0.05
  this:material({
    texture = `textures/facade{image}.png`,
    texture_size = { length * 4 / bays, height },
    roughness = 0.95,
  })
  this:polygon({ from + out, to + out, to, from }):jump({ 0, 0, 0 }):extrude(height)
end)

town:interpret("Roof(geom, height, roof)", function(this, geom, height, roof)
  this:material({ color = "#cbbfa8" }):polygon(geom:inset(0.02)):jump({ 0, 0, 0 }):extrude(height)
  this
    :material({ color = "#e2d9c6" })
    :polygon(geom:buffer(0.25, { join = "mitre" }))
    :jump({ 0, 0, height - 0.2 })
    :extrude(0.3)
  if roof > 1 then
    this:material({ color = "#92513c" })
    details.roof(this, geom, height + 0.1, 0.6)
  else
    this:material({ color = "#8b8880" }):polygon(geom:inset(0.4)):jump({ 0, 0, height }):extrude(0.15)
  end
end)
town:derive()
