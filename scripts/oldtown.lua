--!strict
-- An old town within its wall: crooked lanes, rows of narrow houses, a market square with a church, gates at the
-- exits, and surrounding fields.
-- burgeon run scripts/oldtown.lua -o oldtown.glb
local build = require("templates/build")
local nature = require("templates/nature")
local quarters = require("templates/quarters")
local roads = require("templates/roads")

local extent = param("extent", { default = 165, min = 110, max = 400, unit = "m", doc = "From the middle" })
local wall_height = param("wall", { default = 7, min = 0, max = 14, unit = "m", doc = "0 for no wall" })
local plan = param("plan", {
  default = "grown",
  choices = { "grown", "laid out" },
  doc = "Crooked lanes, or straight ones of a town that was founded",
})
local with_trees = param("trees", { default = true })

local patterns = {
  grown = roads.organic({
    block = 36,
    bends = 30,
    branching = 0.95,
    cross = 0.35,
    gap = 0,
    variety = if extent < 150 then 0.1 else 0.35,
  }),
  ["laid out"] = roads.raster({ block = 62, width = 42, angle = 10, gap = 0.5, variety = 0.6 }),
}
local lanes = roads.grow({
  pattern = patterns[plan],
  extent = extent,
  steps = math.ceil(extent / 7) + 4,
  join = 170,
  detour = 1.8,
  dead_ends = "remove",
  exits = { count = if extent < 150 then 3 elseif extent < 250 then 4 else 5, length = 26 },
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

-- A church in the centre of a block, as long as fits, at least 18 m; nil if it does not fit.
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

-- Exits end where no other street continues. The wall surrounds all other streets.
local blocks = lanes:blocks()
local leads_out: { [number]: boolean } = {}
for _, open in lanes:open_ends() do
  leads_out[open.junction] = true
end
local exits: { any }, corners = {}, {}
for _, street in lanes:streets() do
  if leads_out[street.from] or leads_out[street.to] then
    table.insert(exits, street)
  else
    for _, place in street.geometry.points do
      table.insert(corners, { place[1], place[2] })
    end
  end
end
-- Without streets, the wall surrounds the centre.
local hull = if #corners > 2 then line(corners):convex_hull() else point(0, 0):buffer(extent / 2)
local centre = hull:centroid()

-- The market is the block next to the centre, if possible one with room for a church. All other blocks are divided
-- into narrow lots, and so are the parts of a large market that are far from the church.
local MARKET = 2400
local market, church, least = nil :: any, nil :: any, math.huge
for _, block in blocks do
  local far = block.geometry:distance(centre) + math.abs(block.area - MARKET) / 40
  local place = if church and far >= least then nil else church_in(block)
  if place and not church or (place ~= nil) == (church ~= nil) and far < least then
    market, church, least = block, place, far
  end
end
local square: any = if market then market.geometry else nil
local built = {}
for _, block in blocks do
  if block ~= market then
    table.insert(built, block)
  elseif church and block.area > MARKET then
    local middle = church:centroid()
    local open = block.geometry:exterior_ring():nearest_point(middle)
    local entry = line({ { middle:x(), middle:y() }, { open:x(), open:y() } }):buffer(9)
    square = block.geometry:intersection(church:buffer(10):convex_hull():union(entry))
    -- Parts that touch only in a corner are separated.
    for number, part in block.geometry:difference(square):inset(0.05):geometries() do
      if part:area() > 60 then
        table.insert(built, { id = `{block.id} {number}`, geometry = part })
      end
    end
  end
end

-- Houses; the front houses form rows.
local STYLES = { "half_timbered", "half_timbered", "porto", "row_house", "half_timbered", "porto" }
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
    local draw = stream("house", lot.id)
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
    -- A lot without room for a house is a yard.
    if #houses == before then
      table.insert(yards, lot)
    end
  else
    table.insert(yards, lot)
  end
end

-- Paths continue from the ends of exits, or begin at the wall if there is no street.
local REACH = extent * 1.2 + 110
local country = point(centre:x(), centre:y()):buffer(REACH)
local paths: { any }, path: any = {}, nil
local function track(from: Vector, heading: number): any
  local places, turned, at = { { from.x, from.y } }, heading, from
  while point(at.x, at.y):within(country) do
    at += 24 * vec(math.cos(math.rad(turned)), math.sin(math.rad(turned)), 0)
    -- The path winds and leads away from the town.
    local out = math.deg(math.atan2(at.y - centre:y(), at.x - centre:x()))
    turned += 0.4 * ((out - turned + 180) % 360 - 180) + random(-12, 12)
    table.insert(places, { at.x, at.y })
  end
  return line(places)
end
for _, open in lanes:open_ends() do
  local out = vec(math.cos(math.rad(open.heading)), math.sin(math.rad(open.heading)), 0)
  -- The path begins below the sidewalk around the end of the street.
  local way = track(open.place + out * 4.4, open.heading):buffer(2):intersection(country)
  table.insert(paths, way)
end
if #exits == 0 then
  local from, nearest = vec(centre:x(), centre:y(), 0), math.huge
  for _, corner in hull.rings[1] do
    local place = vec(corner[1], corner[2], 0)
    if lanes:distance(place) < nearest then
      from, nearest = place, lanes:distance(place)
    end
  end
  local out = from - vec(centre:x(), centre:y(), 0)
  local way = track(from + 5 * out:unit(), math.deg(math.atan2(out.y, out.x)))
  path = way:buffer(2.6)
  local outside = path:intersection(country)
  table.insert(paths, outside)
  table.insert(exits, { geometry = way, width = 5.2 })
end

-- Detached houses between the lanes and the wall.
local yard = hull:buffer(8)
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
  local is_free = site.geometry:within(yard) and not (path and site.geometry:intersects(path))
  for _, block in blocks do
    is_free = is_free and not site.geometry:intersects(block.geometry)
  end
  if is_free then
    local draw = stream("house", site.id)
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
local ways = quarters.ways(lanes)
town:axiom(source(houses), function(house)
  local style = build.style(house.style, 1 + math.floor(random() * 60))
  return footprint(house.geometry, { streets = ways }), build.Building(style, house.levels, 0, "")
end)
town:derive()

-- The ground: fields, a ditch, the yards of the blocks and the paved market.
quarters.areas({ country:difference(hull:buffer(24)) }, -5, -0.05, "#8b9a5b")
quarters.areas({ hull:buffer(24) }, -5, -0.06, if wall_height > 0 then "#8f8a68" else "#8b9a5b")
local ground = {}
for _, block in built do
  table.insert(ground, block.geometry)
end
quarters.areas(ground, -0.3, 0.14, "#8d8a6c")
quarters.areas(paths, -0.3, 0, "#8a8074")
if market then
  -- The paving continues below the surrounding lots, because some areas are too small for a lot.
  quarters.areas({ market.geometry }, -0.3, 0.13, "#b0a492")
end

-- A fountain and stalls on the market, away from the church and from the surroundings.
local Stall, Model, Fountain =
  module("Stall", "turned"), module("Model", "color"), module("Fountain", "place")
if market then
  local open = square:buffer(-3.5)
  local spots: { any } = {}
  for _ = 1, 90 do
    if #spots < 12 and not open:is_empty() then
      local at = open:random_point(random(), random())
      local is_free = not (church and at:distance(church) < 6)
      for _, spot in spots do
        is_free = is_free and at:distance(spot.geometry) > (if spot == spots[1] then 7 else 5.5)
      end
      if is_free then
        table.insert(spots, { id = `stall {#spots}`, geometry = at })
      end
    end
  end
  if #spots > 0 then
    local first = table.remove(spots, 1).geometry
    local fountain = lsystem({ object = extruder({ smooth = false, roughness = 0.9 }) })
    fountain:axiom(Fountain(vec(first:x(), first:y(), 0.14)))
    fountain:interpret("Fountain(place)", function(this, place)
      this:color("#97917f"):regular(12):scale(2.1):jump(place):extrude(0.6)
      this:color("#5f7f8c"):scale(1.75):jump(place + vec(0, 0, 0.6)):extrude(0.04)
      this:color("#97917f"):scale(0.4):jump(place + vec(0, 0, 0.6)):extrude(1.9)
    end)
    fountain:derive(0)
  end
  if #spots > 0 then
    local models = {}
    for number, color in { "#b5584a", "#d9c9a0", "#5f7a8a" } do
      local stall = lsystem({ object = extruder({ smooth = false, roughness = 1 }) })
      stall:axiom(Model(color))
      stall:interpret("Model(color)", function(this, cloth)
        this:color("#7a5f43"):rectangle(2.4, 1.3):jump({ 0, 0, 0 }):extrude(0.9)
        this:rectangle(2.6, 0.14):jump({ 0, 0.75, 0 }):extrude(2.4)
        this:color(cloth):rectangle(3, 2.2):jump({ 0, 0, 2.3 }):taper(0.4):extrude(0.7)
      end)
      models[number] = stall:derive(0)
    end
    local stalls = lsystem({ object = turtle() })
    stalls:axiom(source(spots), function(spot)
      return turtle({ position = vec(spot.geometry:x(), spot.geometry:y(), 0.14) }), Stall(random(0, 360))
    end)
    stalls:interpret("Stall(turned)", function(this, turned)
      this:roll(turned):place(models[1 + math.floor(turned) % #models])
    end)
    stalls:derive(0)
  end
end

-- The wall with its towers. A gate is at each crossing with a street, as wide as the street.
local Wall = module("Wall", "shape", "height", "color")
local Tower = module("Tower", "place", "radius", "height")
local TOWER, GATE_TOWER = 3.6, 3.1
if wall_height > 0 then
  local inner, outer = hull:buffer(12), hull:buffer(14.6)
  local ring = inner:buffer(1.3):exterior_ring()
  local wall = outer:difference(inner)
  local gates = {}
  for _, street in exits do
    local crossing = street.geometry:intersection(ring)
    if not crossing:is_empty() then
      local at = crossing:centroid()
      table.insert(gates, { place = vec(at:x(), at:y(), 0), street = street })
      wall = wall:difference(street.geometry:buffer(street.width / 2 + 0.2))
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
      is_free = is_free and gate.place:distance(place) > 22
    end
    if is_free then
      table.insert(modules, Tower(place, TOWER, wall_height + 3.5))
    end
  end
  for _, gate in gates do
    local length = ring:length()
    local at = ring:line_locate(point(gate.place.x, gate.place.y)) * length
    for side = -1, 1, 2 do
      -- Next to the street, at any angle to the wall.
      local away, beside: any = 0, nil
      repeat
        away += 0.5
        beside = ring:line_interpolate(((at + side * away) / length) % 1)
      until away > 20 or beside:distance(gate.street.geometry) > gate.street.width / 2 + GATE_TOWER * 1.12
      table.insert(modules, Tower(vec(beside:x(), beside:y(), 0), GATE_TOWER, wall_height + 6))
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
  local function near_path(at: any): boolean
    for _, each in paths do
      if each:distance(at) < 3 then
        return true
      end
    end
    return false
  end
  for number = 1, 500 do
    local angle, far = random(0, 2 * math.pi), REACH * math.sqrt(random(0.1, 1))
    local x, y = centre:x() + far * math.cos(angle), centre:y() + far * math.sin(angle)
    local at = point(x, y)
    if
      noise(x / 70, y / 70) > 0.1
      and at:within(country)
      and at:distance(hull) > 30
      and lanes:distance(vec(x, y, 0)) > 9
      and not near_path(at)
    then
      plant(x, y, -0.1, random(5, 11))
    end
  end
  nature.trees(trees)
end
