--!strict
-- A round tower grows storey by storey, from its footing to its roof.
local masonry = require("@masonry")
local materials = masonry.materials

local Tower = module("Tower", "storeys", "radius")
local Footing = module("Footing", "radius")
local Storey = module("Storey", "radius", "number")
local Crown = module("Crown", "radius")
local Spire = module("Spire", "radius")

local STOREY = 4.2

-- Draws an arrow slit in the wall at an angle (degrees): a dark gap in dressed stone.
local function slit(this, center, radius: number, angle: number)
  local out = vec(math.cos(math.rad(angle)), math.sin(math.rad(angle)), 0)
  local along = vec(-out.y, out.x, 0)
  local face = center + out * (radius * 0.985)
  this:smooth(false):material(materials.dressed)
  masonry.block(this, face, along, 0.62, 0.3, 2)
  this:material(materials.void)
  masonry.block(this, face + vec(0, 0, 0.2), along, 0.2, 0.38, 1.6)
end

-- Returns a tower with `storeys` storeys; `roof` selects a spire instead of battlements.
return function(options: { storeys: number, radius: number, roof: boolean, seed: number })
  local tower = lsystem({ object = extruder({ smooth = true }), seed = options.seed })
  tower:axiom(Footing(options.radius), Tower(options.storeys, options.radius))

  tower:rule("Tower(storeys, radius)", function(this, storeys, radius)
    if storeys > 0 then
      return Storey(radius, storeys), Tower(storeys - 1, radius * 0.985)
    end
    if options.roof then
      return Crown(radius), Spire(radius)
    end
    return Crown(radius)
  end)

  tower:interpret("Footing(radius)", function(this, radius)
    this:regular(36):smooth(true):material(materials.footing):scale(radius * 1.14):taper(radius):extrude(2.2)
    this:material(materials.dressed):scale(radius * 1.03):extrude(0.25)
  end)

  tower:interpret("Storey(radius, number)", function(this, radius, number)
    local from = this:position()
    this
      :regular(36)
      :smooth(true)
      :material(materials.ashlar)
      :scale(radius)
      :taper(radius * 0.985)
      :extrude(STOREY)
    local top = this:position()
    for turn = 0, 2 do
      slit(this, from + vec(0, 0, 1.2), radius, number * 47 + turn * 120)
    end
    this:jump(top)
  end)

  -- Corbels support a wall walk that is wider than the tower.
  tower:interpret("Crown(radius)", function(this, radius)
    local wide = radius + 0.7
    local from = this:position()
    this:smooth(false):material(materials.dressed)
    local count = math.floor(2 * math.pi * radius / 0.95)
    for number = 1, count do
      local angle = math.rad(number * 360 / count)
      local out = vec(math.cos(angle), math.sin(angle), 0)
      for step = 0, 1 do
        local foot = from + out * (radius - 0.1 + step * 0.2) + vec(0, 0, step * 0.4 - 0.8)
        masonry.block(this, foot, out, 0.5 + step * 0.4, 0.42, 0.4)
      end
    end
    this:jump(from):regular(36):smooth(true):scale(wide):extrude(0.35)
    local walk = this:position()
    masonry.battlements.round(this, walk, wide)
    this:jump(walk)
  end)

  tower:interpret("Spire(radius)", function(this, radius)
    local inner = radius * 0.86
    this:regular(28):smooth(true):material(materials.ashlar):scale(inner):extrude(2.4)
    this:material(materials.slate):scale(inner * 1.2):taper(inner * 0.86):extrude(1.1)
    this:taper(0.1):extrude(radius * 2.3)
    this:regular(8):material(materials.iron):scale(0.07):extrude(1.6)
  end)

  return tower:derive()
end
