--!strict
-- Models to place: trees by species, and street furniture that faces east.
local models = {}

local Part = module("Part", "color", "ring", "from", "to")
local Ball = module("Ball", "x", "y", "z", "radius", "color")

-- The model itself. It is not shown at its own position, even if nothing places it.
local function kept(model: any): any
  panel({ model = model, stretch = true })
  return model
end

-- A model of upright pieces, each with its colour, the ring that it stands on, its start and its end (m).
local function built(parts: { any }): any
  local system = lsystem({ object = extruder({ smooth = false, roughness = 0.7 }) })
  local chain = {}
  for _, part in parts do
    table.insert(chain, { Part(part[1], part[2], part[3], part[4]) })
  end
  system:axiom(table.unpack(chain))
  system:interpret("Part(color, ring, from, to)", function(this, color, ring, from, to)
    this:color(color):polygon(ring):jump({ 0, 0, from }):extrude(to - from)
  end)
  return kept(system:derive(0))
end

local function box(x: number, y: number, width: number, depth: number): { { number } }
  local w, d = width / 2, depth / 2
  return { { x - w, y - d }, { x + w, y - d }, { x + w, y + d }, { x - w, y + d } }
end

local METAL, GLASS, WOOD = "#4a4f54", "#9fb4bd", "#8a6642"

-- By the codes of the data.
models.furniture = {
  -- A bus stop, open to the east, towards the street.
  [1] = built({
    { GLASS, box(-0.75, 0, 0.05, 3.6), 0.25, 2.3 },
    { GLASS, box(0, 1.8, 1.5, 0.05), 0.25, 2.3 },
    { METAL, box(-0.75, -1.8, 0.09, 0.09), 0, 2.4 },
    { METAL, box(-0.75, 1.8, 0.09, 0.09), 0, 2.4 },
    { METAL, box(0.7, 1.8, 0.09, 0.09), 0, 2.4 },
    { METAL, box(0.7, -1.8, 0.09, 0.09), 0, 2.4 },
    { "#d8443c", box(0.05, 0, 1.9, 4), 2.4, 2.55 },
    { WOOD, box(-0.5, 0, 0.4, 2.4), 0.42, 0.48 },
    { METAL, box(-0.5, -1, 0.1, 0.1), 0, 0.42 },
    { METAL, box(-0.5, 1, 0.1, 0.1), 0, 0.42 },
    { METAL, box(0.9, -2.4, 0.08, 0.08), 0, 2.9 },
    { "#f2c230", box(0.9, -2.4, 0.1, 0.6), 2.3, 2.9 },
  }),
  -- A lamp with an arm over the street.
  [2] = built({
    { METAL, box(0, 0, 0.34, 0.34), 0, 0.35 },
    { METAL, box(0, 0, 0.13, 0.13), 0.35, 6.2 },
    { METAL, box(0.55, 0, 1.2, 0.09), 6.1, 6.2 },
    { "#f4e7b8", box(1.05, 0, 0.6, 0.24), 5.98, 6.1 },
  }),
  -- A bench.
  [3] = built({
    { WOOD, box(0, 0, 0.45, 1.7), 0.42, 0.48 },
    { WOOD, box(-0.24, 0, 0.05, 1.7), 0.55, 0.85 },
    { METAL, box(0, 0.7, 0.45, 0.07), 0, 0.42 },
    { METAL, box(0, -0.7, 0.45, 0.07), 0, 0.42 },
    { METAL, box(-0.26, 0.7, 0.05, 0.07), 0.42, 0.85 },
    { METAL, box(-0.26, -0.7, 0.05, 0.07), 0.42, 0.85 },
  }),
  -- An advertising panel.
  [4] = built({
    { METAL, box(0, 0, 0.3, 0.5), 0, 0.5 },
    { METAL, box(0, 0, 0.2, 1.4), 0.5, 2.5 },
    { "#e9e2c8", box(0.1, 0, 0.03, 1.2), 0.6, 2.4 },
    { "#c4574a", box(0.12, 0, 0.02, 1.2), 1.3, 2.0 },
  }),
}

-- A furniture item that faces a direction (degrees), independent of the previous item.
function models.stand(this: any, place: any, code: number, direction: number)
  local angle = math.rad(direction)
  this:jump(place:place() + vec(0, 0, 0.15))
  this:direction({ 0, 0, 1 }, { -math.sin(angle), math.cos(angle), 0 }):place(models.furniture[code])
end

-- A tree of 1 m height with a crown of 0.5 m radius. Its height scales each instance.
local function tree(color: string, seed: number, slender: number): any
  local system = lsystem({ object = turtle({ color = "#66543f", width = 0.045, sides = 7 }) })
  local crown = { F(0.45) }
  for ball = 1, 8 do
    local angle, level = ball * 2.4 + seed, ball / 8
    local out = 0.2 * slender * math.sin(math.pi * (0.2 + 0.75 * level))
    local radius = (0.2 - 0.06 * level + 0.02 * math.sin(ball * 5 + seed * 3)) * math.sqrt(slender)
    local shade = mix(color, "#b9c27a", math.max(0, level * 0.35))
    table.insert(
      crown,
      { Ball(out * math.cos(angle), out * math.sin(angle), 0.4 + 0.42 * level, radius, shade) }
    )
  end
  system:axiom(table.unpack(crown))
  system:interpret("Ball(x, y, z, radius, color)", function(this, x, y, z, radius, color)
    this:jump({ x, y, z }):color(color):sphere(radius)
  end)
  return kept(system:derive(0))
end

-- By species; the sixth is alone in its flower bed.
models.trees = {
  tree("#5f7444", 0, 1),
  tree("#6b7a45", 1, 0.85),
  tree("#54693f", 2, 1.1),
  tree("#7c8246", 3, 0.7),
  tree("#4e6a4a", 4, 0.6),
  tree("#8a5a3c", 5, 1.2),
}

return models
