--!strict
-- A twisted tower of towers: tiers of storeys, storeys of pillars, pillars of thinner pillars. The turrets on its
-- setbacks are towers too.
local floors = param("floors", { default = 24, min = 1, max = 120, step = 1, doc = "Storeys of the tower" })
local twist = param("twist", { default = 4, min = -15, max = 15, unit = "deg", doc = "Turn of each storey" })
local sides = param("sides", { default = 8, min = 3, max = 12, step = 1, doc = "Sides of the plan" })
local detail = param("detail", { default = 1, min = 0, max = 3, step = 1, doc = "How often pillars divide" })
local stone = param("stone", { default = "#d9c3a0", doc = "Colour of the walls" })

local HEIGHT = 3.6 -- of a storey (m)
local TIER = 6 -- storeys between two setbacks

local Tower = module("Tower", "n", "radius") -- n storeys remain
local Storey = module("Storey", "radius", "height")
local Setback = module("Setback", "radius")
local Turret = module("Turret", "radius", "n")
local Crown = module("Crown", "radius")
local Pillar = module("Pillar", "width", "height", "level")
local Block = module("Block", "width", "depth", "height") -- four walls
local Drum = module("Drum", "radius", "height", "top") -- one wall per edge of the plan; the top can be smaller
local Glass = module("Glass", "radius", "height")
local Spire = module("Spire", "radius", "height")
local Rise = module("Rise", "height")
local Out = module("Out", "distance")

local tower =
  lsystem({ object = extruder({ sides = sides, smooth = false, color = stone }), interpret = "last" })

tower:axiom(Drum(18, 0.7, 1), Drum(17, 0.7, 1), Drum(16, 0.7, 1), Tower(floors, 14.5))

-- The tower grows by storeys, and is set back after each tier.
tower:rule("Tower(n, r)", function(this, n, r)
  if n == 0 then
    return Crown(r)
  elseif n % TIER == 0 and n < floors then
    return Setback(r), Storey(r * 0.78, HEIGHT), Roll(twist), Tower(n - 1, r * 0.78)
  end
  return Storey(r, HEIGHT), Roll(twist), Tower(n - 1, r * 0.98)
end)

-- Glass walls behind pillars: a strong pillar at each corner and two slender ones along each side.
tower:rule("Storey(r, h)", function(this, r, h)
  local parts = { { Glass(r * 0.86, h) }, Drum(r, h * 0.1, 0.985) }
  for side = 1, sides do
    table.insert(parts, { Roll(side * 360 / sides), Out(r * 0.9), Pillar(r * 0.15, h * 0.9, detail) })
    for place = 1, 2 do
      local angle = (side + place / 3) * 360 / sides
      local across = r
        * 0.86
        * math.cos(math.pi / sides)
        / math.cos(math.rad((place / 3 - 0.5) * 360 / sides))
      table.insert(parts, { Roll(angle), Out(across), Pillar(r * 0.07, h * 0.9, detail - 1) })
    end
  end
  table.insert(parts, Rise(h * 0.9))
  return table.unpack(parts)
end)

-- A pillar is a plinth, four thinner pillars and a capital.
tower:rule("Pillar(w, h, level)", function(this, w, h, level)
  if level <= 0 then
    return Block(w, w, h)
  end
  local thin = Pillar(w * 0.4, h * 0.74, level - 1)
  local apart = w * 0.27
  return Block(w, w, h * 0.12),
    { Roll(45), Out(apart), thin },
    { Roll(135), Out(apart), thin },
    { Roll(225), Out(apart), thin },
    { Roll(315), Out(apart), thin },
    Rise(h * 0.74),
    Block(w, w, h * 0.14)
end)

-- A cornice, and on each of its corners a turret.
tower:rule("Setback(r)", function(this, r: number)
  local parts = { Drum(r * 0.98, 0.5, 1.07), Drum(r * 1.05, 0.5, 1) }
  for side = 1, sides do
    table.insert(parts, { Roll(side * 360 / sides), Out(r * 0.92), Turret(r * 0.13, 3) })
  end
  return table.unpack(parts)
end)

tower:rule("Turret(r, n)", function(this, r, n: number)
  if n == 0 then
    return Drum(r * 1.3, r * 0.4, 1), Spire(r * 1.1, r * 6)
  end
  return { Glass(r * 0.8, r * 2) },
    Drum(r * 1.2, r * 0.3, 1),
    Drum(r, r * 1.7, 0.96),
    Roll(45),
    Turret(r * 0.88, n - 1)
end)

-- Rings that close over each other like the leaves of a bud, with the spire from their centre.
tower:rule("Crown(r)", function(this, r)
  if r < 1.6 then
    return Spire(r, r * 9)
  end
  local ring = { Drum(r, 0.5, 1.05), Drum(r * 0.96, 0.5, 0.94) }
  for side = 1, sides do
    table.insert(
      ring,
      { Roll(side * 360 / sides), Out(r * 0.84), Pillar(r * 0.12, r * 0.5, 1), Spire(r * 0.09, r * 0.8) }
    )
  end
  table.insert(ring, { Glass(r * 0.72, r * 0.5) })
  table.insert(ring, Rise(r * 0.5))
  table.insert(ring, Crown(r * 0.76))
  return table.unpack(ring)
end)

tower:interpret("Roll(angle)", function(this, angle)
  this:roll(angle)
end)
tower:interpret("Rise(height)", function(this, height)
  this:advance(height)
end)
tower:interpret("Out(distance)", function(this, distance)
  this:shift(distance, 0)
end)
tower:interpret("Block(w, d, h)", function(this, w, d, h)
  this:rectangle(w, d):scale(1):extrude(h)
end)
tower:interpret("Drum(r, h, top)", function(this, r, h, top)
  this:regular(sides):scale(r):taper(r * top):extrude(h)
end)
tower:interpret("Glass(r, h)", function(this, r, h)
  this:material({ color = "#27485a", roughness = 0.15, metallic = 0.4, name = "glass" })
  this:regular(sides):scale(r):extrude(h)
end)
tower:interpret("Spire(r, h)", function(this, r, h)
  this:material({ color = "#e0ac4a", roughness = 0.4, metallic = 0.3, name = "bronze" })
  this:star(sides, 0.6):scale(r):taper(r * 0.03):twist(90):extrude(h):twist(0)
end)

tower:derive()
