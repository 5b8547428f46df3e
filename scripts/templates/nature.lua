--!strict
-- Everything between buildings: land and water, parks and squares, streets with pavements, bridges and trees.
local parts = require("templates/parts")
local nature = {}

-- Heights (m). Land is flat, and the water is below it.
local WATER, SQUARE, PARK, PAVEMENT, ROAD = -2.2, 0.04, 0.07, 0.1, 0.13
local THICK = 4

local COLORS = {
  land = "#969c70",
  park = "#7f9159",
  square = "#b3aa9a",
  water = "#5f7b80",
  pavement = "#bdb8ad",
  road = "#6d6d6b",
  stone = "#a59b8a",
}

local Area = module("Area", "rings", "from", "to", "color")
local Street = module("Street", "points", "width", "bridge")

-- Draws an area with its holes between two heights.
local function areas(features, from: number, to: number, color: string)
  if #features == 0 then
    return
  end
  local system = lsystem({ object = extruder({ smooth = false, roughness = 1 }) })
  system:axiom(source(features), function(feature)
    return Area(feature.geometry.rings, from, to, color)
  end)
  system:interpret("Area(rings, from, to, color)", function(this, rings, from, to, color)
    local holes = table.move(rings, 2, #rings, 1, {})
    this:color(color):polygon(rings[1], holes):jump({ 0, 0, from }):extrude(to - from)
  end)
  system:derive(0)
end

-- The ground with areas on it: `of.land`, or a plate under everything, and `of.water`, `of.park` and `of.square`.
function nature.ground(of, bounds: any)
  local land = of.land
  if #land == 0 then
    local low, high, m = bounds.min, bounds.max, 15
    local ring = {
      { low[1] - m, low[2] - m },
      { high[1] + m, low[2] - m },
      { high[1] + m, high[2] + m },
      { low[1] - m, high[2] + m },
    }
    land = { { id = "land", geometry = { rings = { ring } } } }
    areas(land, -THICK, 0, COLORS.square)
    areas(of.water, -1, PARK, COLORS.water)
  else
    areas(land, -THICK, -0.2, COLORS.stone)
    areas(land, -0.2, 0, COLORS.land)
    areas(of.water, -THICK, WATER, COLORS.water)
  end
  areas(of.park, -1, PARK, COLORS.park)
  areas(of.square, -1, SQUARE, COLORS.square)
end

-- The outline of a band along a line, `width` (m) wide.
local function band(points: any, width: number)
  local left, right = {}, {}
  for index, point in points do
    local before, after = points[math.max(index - 1, 1)], points[math.min(index + 1, #points)]
    local along = vec(after[1] - before[1], after[2] - before[2], 0):unit()
    table.insert(left, { point[1] - along.y * width / 2, point[2] + along.x * width / 2 })
    table.insert(right, 1, { point[1] + along.y * width / 2, point[2] - along.x * width / 2 })
  end
  return table.move(right, 1, #right, #left + 1, left)
end

-- Streets with their points, with pavements on both sides; streets with the attribute `bridge` have piers and
-- parapets.
function nature.streets(features)
  if #features == 0 then
    return
  end
  local system = lsystem({ object = extruder({ smooth = false, roughness = 1 }) })
  system:axiom(source(features), function(feature)
    return Street(feature.points, tonumber(feature.width) or 6, feature.bridge == true)
  end)
  system:interpret("Street(points, width, bridge)", function(this, points, width, bridge)
    if bridge then
      this:color(COLORS.stone):polygon(band(points, width + 4.4)):jump({ 0, 0, -1.2 }):extrude(1.25)
      for side = -1, 1, 2 do
        local parapet = {}
        for _, ring in { band(points, width + 4.4), band(points, width + 3.8) } do
          local half = #ring / 2
          local first = if side < 0 then 1 else half + 1
          for index = first, first + half - 1 do
            -- The inner side runs backwards.
            local at = if #parapet >= half then first + half - 1 - (#parapet - half) else index
            table.insert(parapet, ring[at])
          end
        end
        this:polygon(parapet):jump({ 0, 0, 0 }):extrude(1.05)
      end
      local from, to = points[1], points[#points]
      for pier = 1, 3 do
        local x, y = lerp(from[1], to[1], pier / 4), lerp(from[2], to[2], pier / 4)
        this:rectangle(width + 5.5, 3.4):jump({ x, y, -THICK }):extrude(THICK - 0.4)
      end
    end
    local pavement = if width > 5 then 4.4 else 1.2
    this
      :color(COLORS.pavement)
      :polygon(band(points, width + pavement))
      :jump({ 0, 0, -0.5 })
      :extrude(0.5 + PAVEMENT)
    this:color(COLORS.road):polygon(band(points, width)):jump({ 0, 0, -0.4 }):extrude(0.4 + ROAD)
    if width >= 8 then
      for index = 1, #points - 1 do
        local a, b = points[index], points[index + 1]
        local turn = math.deg(math.atan2(b[2] - a[2], b[1] - a[1]))
        local length = math.sqrt((b[1] - a[1]) ^ 2 + (b[2] - a[2]) ^ 2)
        local dashes = math.max(1, math.floor(length / 6))
        for dash = 1, dashes do
          local t, c, s = (dash - 0.5) / dashes, math.cos(math.rad(turn)), math.sin(math.rad(turn))
          local x, y = lerp(a[1], b[1], t), lerp(a[2], b[2], t)
          local mark = {}
          for _, corner in { { -1.3, -0.07 }, { 1.3, -0.07 }, { 1.3, 0.07 }, { -1.3, 0.07 } } do
            table.insert(mark, { x + corner[1] * c - corner[2] * s, y + corner[1] * s + corner[2] * c })
          end
          this:color("#c9c7bf"):polygon(mark):jump({ 0, 0, 0.05 }):extrude(ROAD - 0.04)
        end
      end
    end
  end)
  system:derive(0)
end

local Trunk, Leaves = module("Trunk"), module("Leaves", "x", "y", "z", "radius")

-- A tree of 1 m height, with a crown of spheres.
local function tree(color: string, seed: number)
  local system = lsystem({ object = turtle({ color = "#66543f", width = 0.045, sides = 8 }) })
  local crown = {}
  for ball = 1, 9 do
    local angle = ball * 2.4 + seed
    local level = ball / 9
    local out = 0.21 * math.sin(math.pi * (0.2 + 0.75 * level))
    local radius = 0.2 - 0.06 * level + 0.02 * math.sin(ball * 5 + seed * 3)
    table.insert(crown, { Leaves(out * math.cos(angle), out * math.sin(angle), 0.42 + 0.42 * level, radius) })
  end
  system:axiom(Trunk(), table.unpack(crown))
  system:interpret("Trunk()", function(this)
    this:forward(0.5)
  end)
  system:interpret("Leaves(x, y, z, radius)", function(this, x, y, z, radius)
    local shade = mix(color, "#b9c27a", math.max(0, (z - 0.4) * 0.7))
    this:jump({ x, y, z }):color(shade):sphere(radius)
  end)
  return parts.kept(system:derive(0))
end

local Tree = module("Tree", "kind", "height", "turned")

-- A tree at every feature, with the height of its attribute `height` (m).
function nature.trees(features)
  if #features == 0 then
    return
  end
  local kinds = { tree("#5f7444", 0), tree("#6b7a45", 1), tree("#54693f", 2) }
  local wood = lsystem({ object = turtle() })
  wood:axiom(source(features), function(feature)
    local height = tonumber(feature.height) or random(6, 10)
    local kind = 1 + math.floor(random() * 2.999)
    return turtle({ position = feature.geometry.points[1] }), Tree(kind, height, random(0, 360))
  end)
  wood:interpret("Tree(kind, height, turned)", function(this, kind, height, turned)
    this:roll(turned):place(kinds[kind], height)
  end)
  wood:derive(0)
end

local Hut, Shed = module("Hut"), module("Shed", "turned")

-- Garden sheds: features with a `place` (m) and a direction `facing` (degrees).
function nature.sheds(features)
  if #features == 0 then
    return
  end
  local hut = lsystem({ object = extruder({ smooth = false, roughness = 1 }) })
  hut:axiom(Hut())
  hut:interpret("Hut()", function(this)
    this:color("#7d6a52"):rectangle(1.8, 2.4):jump({ 0, 0, -0.2 }):extrude(2.2)
    this:color("#5d5a55"):rectangle(2.1, 2.7):jump({ 0, 0, 2 }):extrude(0.14)
  end)
  local model = parts.kept(hut:derive(0))
  local row = lsystem({ object = turtle() })
  row:axiom(source(features), function(feature)
    return turtle({ position = feature.place }), Shed(feature.facing)
  end)
  row:interpret("Shed(turned)", function(this, turned)
    this:roll(turned):place(model)
  end)
  row:derive(0)
end

local Pole, Lamp = module("Pole"), module("Lamp", "turned")

-- Lamps next to streets, `height` (m) high, with arms over the street: nature.lamps(roads:verge("lamp")).
function nature.lamps(features, height: number?)
  if #features == 0 then
    return
  end
  local high = height or 7
  local pole = lsystem({ object = extruder({ smooth = false, roughness = 0.5 }) })
  pole:axiom(Pole())
  pole:interpret("Pole()", function(this)
    this:color("#3d4144"):rectangle(0.34, 0.34):jump({ 0, 0, 0 }):extrude(0.5)
    this:rectangle(0.14, 0.14):jump({ 0, 0, 0.5 }):extrude(high - 0.5)
    this:rectangle(1.7, 0.09):jump({ 0.8, 0, high - 0.1 }):extrude(0.09)
    this:color("#e9e2c8"):rectangle(0.62, 0.24):jump({ 1.55, 0, high - 0.18 }):extrude(0.1)
  end)
  local lamp = parts.kept(pole:derive(0))
  local row = lsystem({ object = turtle() })
  row:axiom(source(features), function(feature)
    return turtle({ position = feature.geometry.points[1] }), Lamp(feature.heading)
  end)
  row:interpret("Lamp(turned)", function(this, turned)
    this:roll(turned):place(lamp)
  end)
  row:derive(0)
end

return nature
