--!strict
-- A Gothic rose window. A rose is a ring of stone with a smaller rose in its centre and a wreath of roses around it;
-- each touches its neighbours and the ring. The smallest roses are panes of coloured glass.
local depth = param("depth", { default = 3, min = 1, max = 4, step = 1, doc = "Roses within roses" })
local petals =
  param("petals", { default = 12, min = 5, max = 20, step = 1, doc = "Roses in the outer wreath" })
local inner =
  param("inner", { default = 6, min = 3, max = 12, step = 1, doc = "Roses in each smaller wreath" })
local radius = param("radius", { default = 5, min = 1, max = 12, unit = "m", doc = "Of the whole window" })
local stone = param("stone", { default = "#d8cbb4", doc = "Colour of the tracery" })

local GLASS = { "#7c1d2f", "#b3262e", "#173f8a", "#2a62b8", "#d99a2b", "#1f6b4f", "#5b2a78" }

local Rose = module("Rose", "radius", "n", "count", "tint")
local Ring = module("Ring", "radius", "width")
local Pane = module("Pane", "radius", "tint")
local Around = module("Around", "angle", "distance")
local Wall = module("Wall")

local window = lsystem({
  object = extruder({
    color = stone,
    heading = { 0, -1, 0 },
    position = { 0, 0, radius * 1.35 },
    roughness = 0.9,
  }),
  interpret = "last",
})

window:axiom({ Wall() }, Rose(radius, depth, petals, 2))

-- The fraction of the ring's radius for a circle that touches its neighbours in a wreath of `count`, and the ring.
local function share(count: number): number
  local sine = math.sin(math.pi / count)
  return sine / (1 + sine)
end

window:rule("Rose(r, n, count, tint)", function(this, r, n, count, tint)
  local width = 0.05 * radius * (r / radius) ^ 0.8
  local clear = r - width / 2
  if n == 0 then
    return { Ring(r, width) }, { Pane(clear, tint) }
  end
  local small = clear * share(count)
  local middle = clear - 2 * small
  -- The centre of the window has room for one more rose.
  local middle_n = if r == radius then n else n - 1
  local parts: { any } =
    { { Ring(r, width) }, { Pane(clear, tint + 2) }, { Rose(middle, middle_n, inner, tint + 1) } }
  for k = 1, count do
    table.insert(
      parts,
      { Around(k * 360 / count + 90, clear - small), Rose(small, n - 1, inner, tint + 3 + k % 2) }
    )
  end
  return table.unpack(parts)
end)

window:interpret("Around(angle, distance)", function(this, angle, distance)
  local place = math.rad(angle)
  this:shift(distance * math.cos(place), distance * math.sin(place))
end)

-- From the rightmost point, counter-clockwise all the way round.
window:interpret("Ring(r, width)", function(this, r, width)
  this:shift(r, 0):pitch(-90):bend(360, 0):regular(8):scale(width / 2, width * 0.8)
  this:resolution(math.ceil(16 + 56 * r / radius), 0):extrude(2 * math.pi * r)
end)

-- Smaller panes are thicker, so that they project from the panes behind them.
window:interpret("Pane(r, tint)", function(this, r, tint)
  local color = rgb(GLASS[tint % #GLASS + 1])
  this:smooth(false):regular(math.ceil(20 + 60 * r / radius)):scale(r):advance(-0.1)
  this:material({ color = color, roughness = 0.15, emissive = mix("#000000", color, 0.35), name = "glass" })
  this:extrude(0.1 + 0.06 * (1 - r / radius))
end)

window:interpret("Wall", function(this)
  local side, hole = radius * 1.35, {}
  for k = 0, 95 do
    local angle = k / 96 * 2 * math.pi
    table.insert(hole, { radius * math.cos(angle), radius * math.sin(angle) })
  end
  this:smooth(false):advance(-0.4)
  this:material({ color = "#cfc2a8", roughness = 0.95, name = "wall" })
  this:polygon({ { -side, -side }, { side, -side }, { side, side }, { -side, side } }, { hole })
  this:extrude(0.6)
end)

window:derive()
