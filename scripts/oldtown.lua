--!strict
-- An old town within its wall: crooked lanes, rows of narrow houses, a market square with a church, gates where the streets
-- leave, and fields around.
-- burgeon run scripts/oldtown.lua -o oldtown.glb
local build = require("templates/build")
local nature = require("templates/nature")
local quarters = require("templates/quarters")
local roads = require("templates/roads")
local skyline = require("templates/skyline")

local extent = param("extent", { default = 165, min = 110, max = 400, unit = "m", text = "From the middle" })
local wall_height = param("wall", { default = 7, min = 0, max = 14, unit = "m", text = "0 for no wall" })
local plan = param("plan", {
  default = "grown",
  choices = { "grown", "laid out" },
  text = "Crooked lanes, or straight ones of a town that was founded",
})
local with_trees = param("trees", { default = true })

local patterns = {
  grown = roads.organic({
    block = 36,
    bends = 30,
    branching = 0.95,
    cross = 0.35,
    variety = if extent < 150 then 0.1 else 0.35,
  }),
  ["laid out"] = roads.raster({ block = 62, width = 42, angle = 10 }),
}
local lanes = roads.grow({
  pattern = patterns[plan],
  extent = extent,
  steps = math.ceil(extent / 7),
  join = 170,
  detour = 1.8,
  headings = { 10, 130, 250 },
  network = {
    streets = {
      { width = 10, lanes = 2, sidewalk = 1.6 },
      { width = 7, lanes = 1, sidewalk = 1 },
      { width = 5.5 },
    },
    snap = 18,
    min_angle = 48,
    corner = 1.5,
    clearance = 12,
    markings = false,
    asphalt = "#8a8074",
    paving = "#a89e8f",
  },
}).objects[1] :: Network

-- A church in the middle of a block, as long as there is room for it, and at least 18 m; nil where there is none.
local function church_in(block: any): any
  local middle = block.geometry:point_on_surface()
  local shape = block.geometry:oriented_envelope().rings[1]
  local along = vec(shape[2][1] - shape[1][1], shape[2][2] - shape[1][2], 0):unit()
  local across = vec(-along.y, along.x, 0)
  local place = vec(middle:x(), middle:y(), 0)
  for length = 34, 18, -4 do
    local ring = {}
    for _, corner in { { -0.5, -0.22 }, { 0.5, -0.22 }, { 0.5, 0.22 }, { -0.5, 0.22 } } do
      local at = place + along * (corner[1] * length) + across * (corner[2] * length)
      table.insert(ring, { at.x, at.y })
    end
    if polygon(ring):buffer(5):within(block.geometry) then
      return polygon(ring)
    end
  end
  return nil
end

-- The market is the block next to the middle, if possible one with room for a church; all others are divided into narrow
-- lots.
local blocks = lanes:blocks()
local market, church, least = nil :: any, nil :: any, math.huge
for _, block in blocks do
  local far = block.geometry:distance(point(0, 0)) + math.abs(block.area - 2200) / 60
  local place = if church and far >= least then nil else church_in(block)
  if place and not church or (place ~= nil) == (church ~= nil) and far < least then
    market, church, least = block, place, far
  end
end
local built = {}
local corners = {}
for _, block in blocks do
  if block ~= market then
    table.insert(built, block)
  end
  for _, place in block.geometry.rings[1] do
    table.insert(corners, place)
  end
end
-- Without a block the wall goes around the middle.
local hull = if #corners > 0 then line(corners):convex_hull() else point(0, 0):buffer(extent / 2)

-- Houses, the front ones in rows that touch.
local STYLES = { "half_timbered", "half_timbered", "porto", "terrace_house", "half_timbered", "porto" }
local houses: { any }, yards: { any } = {}, {}
for _, lot in
  lanes:lots({
    blocks = built,
    kind = "strips",
    width = 7.5,
    depth = 14,
    min_width = 5,
    jitter = 0.45,
    terrace = 11,
    all = true,
  })
do
  if lot.use == "building" then
    local draw = skyline.stream(lot.id, 11)
    local before = #houses
    for number, part in lot.terrace or {} do
      if part:area() > 26 then
        table.insert(houses, {
          id = `{lot.id}.{number}`,
          geometry = part,
          style = STYLES[1 + math.floor(draw() * #STYLES)],
          levels = 2 + math.floor(draw() * 2.4),
        })
      end
    end
    -- What has no room for a house is a yard.
    if #houses == before then
      table.insert(yards, lot)
    end
  else
    table.insert(yards, lot)
  end
end

-- Where streets leave the town; a path does, where none of them goes so far.
local exits: { any }, path: any = {}, nil
for _, open in lanes:open_ends() do
  local way = math.rad(open.heading)
  local out = vec(math.cos(way), math.sin(way), 0)
  local from, to = open.place - out * 200, open.place + out * 60
  if not point(open.place.x, open.place.y):within(hull:buffer(14)) then
    table.insert(exits, line({ { from.x, from.y }, { to.x, to.y } }))
  end
end
if #exits == 0 then
  local from, nearest = vec(0, 0, 0), math.huge
  for _, corner in hull.rings[1] do
    local place = vec(corner[1], corner[2], 0)
    if lanes:distance(place) < nearest then
      from, nearest = place, lanes:distance(place)
    end
  end
  local to = from + from:unit() * 80
  local way = line({ { from.x, from.y }, { to.x, to.y } })
  path = way:buffer(2.6)
  table.insert(exits, way)
end

-- Between the lanes and the wall houses stand by themselves.
for _, site in
  lanes:sites({
    sizes = { { 11, 9 }, { 9, 8 } },
    along = 5,
    away = 12,
    distance = 22,
    setback = 0.6,
    gap = 1.5,
  })
do
  local is_free = site.geometry:within(hull:buffer(6)) and not (path and site.geometry:intersects(path))
  for _, block in blocks do
    is_free = is_free and not site.geometry:intersects(block.geometry)
  end
  if is_free then
    local draw = skyline.stream(site.id, 11)
    table.insert(houses, {
      id = site.id,
      geometry = site.geometry,
      style = STYLES[1 + math.floor(draw() * #STYLES)],
      levels = 1 + math.floor(draw() * 2.4),
    })
  end
end

if church then
  table.insert(houses, { id = "church", geometry = church, style = "church", levels = 1 })
else
  local why = if market then "no block has room for one of 18 m" else "the lanes enclose no block"
  print(`oldtown: no church, for {why}: try another seed, or a greater extent`)
end

local town = build.system()
town:axiom(source(houses), function(house)
  local style = build.style(house.style, 1 + math.floor(random() * 60))
  return footprint(house.geometry), build.Building(style, house.levels, 0, "")
end)
town:derive()

-- The ground: fields, a ditch, the yards of the blocks and the paved market.
local country = point(0, 0):buffer(extent * 1.45 + 60)
quarters.areas({ country:difference(hull:buffer(24)) }, -5, -0.05, "#8b9a5b")
quarters.areas({ hull:buffer(24) }, -5, -0.06, if wall_height > 0 then "#8f8a68" else "#8b9a5b")
local ground = {}
for _, block in built do
  table.insert(ground, block.geometry)
end
quarters.areas(ground, -0.3, 0.14, "#8d8a6c")
if path then
  quarters.areas({ path }, -0.3, 0, "#8a8074")
end
if market then
  quarters.areas({ market.geometry }, -0.3, 0.14, "#b0a492")
end

-- The wall with its towers. A gate stands where a street leaves.
local Wall = module("Wall", "shape", "height", "color")
local Tower = module("Tower", "place", "radius", "height")
if wall_height > 0 then
  local inner, outer = hull:buffer(12), hull:buffer(14.6)
  local ring = inner:buffer(1.3):exterior_ring()
  local wall = outer:difference(inner)
  local gates = {}
  for _, street in exits do
    local crossing = street:intersection(ring)
    if not crossing:is_empty() then
      local at = crossing:centroid()
      table.insert(gates, vec(at:x(), at:y(), 0))
      wall = wall:difference(street:buffer(4.2))
    end
  end
  local walls = lsystem({ object = extruder({ smooth = false, roughness = 0.95 }) })
  local modules = {}
  for _, part in wall:geometries() do
    table.insert(modules, Wall(part, wall_height, "#a79a84"))
  end
  -- A parapet on the outer edge.
  for _, part in wall:difference(inner:buffer(1.9)):geometries() do
    table.insert(modules, Wall(part, wall_height + 1.1, "#9f927d"))
  end
  local count = math.max(5, math.floor(ring:length() / 46))
  for number = 0, count - 1 do
    local at = ring:line_interpolate(number / count)
    local place = vec(at:x(), at:y(), 0)
    local is_free = true
    for _, gate in gates do
      is_free = is_free and gate:distance(place) > 20
    end
    if is_free then
      table.insert(modules, Tower(place, 3.6, wall_height + 3.5))
    end
  end
  for _, gate in gates do
    local near = ring:nearest_point(point(gate.x, gate.y))
    local at = ring:line_locate(near) * ring:length()
    for side = -1, 1, 2 do
      local beside = ring:line_interpolate(((at + side * 7.4) / ring:length()) % 1)
      table.insert(modules, Tower(vec(beside:x(), beside:y(), 0), 3.1, wall_height + 6))
    end
  end
  walls:axiom(table.unpack(modules))
  walls:interpret("Wall(shape, height, color)", function(this, shape, height, color)
    this:color(color):polygon(shape):jump({ 0, 0, -0.3 }):extrude(height + 0.3)
  end)
  walls:interpret("Tower(place, radius, height)", function(this, place, radius, height)
    this:color("#a3967f"):regular(20):scale(radius):jump(place):extrude(height)
    this:scale(radius * 1.12):jump(place + vec(0, 0, height)):extrude(1.6)
    this
      :color("#8c4a36")
      :scale(radius * 1.25)
      :jump(place + vec(0, 0, height + 1.6))
      :taper(0.05)
      :extrude(radius * 1.9)
  end)
  walls:derive(0)
end

if with_trees then
  local trees = {}
  local function plant(x: number, y: number, z: number, tall: number)
    table.insert(trees, { id = `tree {#trees}`, geometry = { points = { vec(x, y, z) } }, height = tall })
  end
  for _, yard in yards do
    for _ = 1, math.floor(yard.area / 70) do
      local at = yard.geometry:random_point(random(), random())
      plant(at:x(), at:y(), 0.1, random(4, 8))
    end
  end
  for number = 1, 500 do
    local angle, far = random(0, 2 * math.pi), extent * random(1.1, 1.75) + 30
    local x, y = far * math.cos(angle), far * math.sin(angle)
    local at = point(x, y)
    if
      noise(x / 70, y / 70) > 0.1
      and at:within(country)
      and at:distance(hull) > 30
      and lanes:distance(vec(x, y, 0)) > 9
    then
      plant(x, y, -0.1, random(5, 11))
    end
  end
  nature.trees(trees)
end
