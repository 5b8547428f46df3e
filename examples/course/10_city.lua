--!strict
-- A small city: streets that grow, lots between them, towers in the middle, houses at the edge, and parks.
local extent =
  param("extent", { default = 400, min = 200, max = 900, unit = "m", doc = "From the middle to the edge" })
local highest =
  param("highest", { default = 105, min = 12, max = 250, unit = "m", doc = "Height in the middle" })
local parks =
  param("parks", { default = 0.1, min = 0, max = 0.6, doc = "Fraction of the blocks that are parks" })

-- 1. Streets. Two avenues cross in the middle. Side streets leave them, and further streets leave those.
local Tip = module("Tip", "junction", "heading", "depth")
local edge = point(0, 0):buffer(extent)
local roads = lsystem({
  object = network({
    streets = {
      { width = 25, lanes = 4, median = 2.5, sidewalk = 4.5, trees = 12 },
      { width = 15, lanes = 2, sidewalk = 3, trees = 14 },
      { width = 11, lanes = 2, sidewalk = 2.2 },
    },
    limit = edge,
    snap = 34,
    clearance = 26,
    min_angle = 60,
    square_ends = true,
  }),
})
roads:axiom(Tip(1, 12, 0), Tip(1, 100, 0), Tip(1, 192, 0), Tip(1, 280, 0))
roads:rule("Tip(junction, heading, depth)", function(this, junction, heading: number, depth: number)
  local at = this:open_end(junction, heading)
  if not at then
    return nil
  end
  local side = math.min(depth + 1, 2)
  return Tip(at, heading + random(-5, 5), depth), Tip(at, heading + 90, side), Tip(at, heading - 90, side)
end)
roads:interpret("Tip(junction, heading, depth)", function(this, junction, heading, depth)
  this:grow(junction, heading, if depth == 0 then 96 else 78, depth)
end)
local city: Network = roads:derive(16).objects[1]

-- 2. Lots. Each is a feature with its polygon, its area and its use.
local blocks = city:blocks()
local lots =
  city:lots({ blocks = blocks, kind = "strips", width = 24, depth = 26, parks = parks, all = true })

-- 3. The ground: a plate under the city, and lawns in the blocks.
local Plate = module("Plate", "shape", "from", "to", "color")
local ground = lsystem({ object = extruder({ smooth = false, roughness = 1 }) })
local plates = { Plate(edge:buffer(16), -8, -0.3, "#8a8f74") }
for _, block in blocks do
  table.insert(plates, Plate(block.geometry, -0.3, 0.14, "#93996f"))
end
for _, lot in lots do
  if lot.use == "park" then
    table.insert(plates, Plate(lot.geometry, 0.14, 0.2, "#6f9150"))
  end
end
ground:axiom(sequence(plates))
ground:interpret("Plate(shape, from, to, color)", function(this, shape, from, to, color)
  this:jump({ 0, 0, from }):color(color):polygon(shape):extrude(to - from)
end)
ground:derive(0)

-- 4. Facades. A grid of windows in four styles.
local function windows(wall: string, glass: string, wide: number, gap: number): Facade
  local face = panel({
    material = { color = glass, roughness = 0.12 },
    width = { wide, wide * 1.2, wide * 1.5 },
    height = { 1.6, 2, 2.4 },
  })
  local cell = bordered(face, { left = gap, right = gap, bottom = 0.7, top = 0.5 })
  -- Walls that are too narrow for a window stay plain.
  local plain = template({ wall = panel({}), weight = 0, material = { color = wall } })
  return facade({ template({ wall = grid(cell), material = { color = wall } }), plain })
end
local styles = {
  windows("#d9cdb8", "#4a5a62", 1.3, 0.6),
  windows("#b98d72", "#3f4a50", 1.2, 0.7),
  windows("#e6e2d8", "#56707e", 2.2, 0.25),
  windows("#8fa0a8", "#35515f", 2.6, 0.12),
}

-- 5. Buildings. The height falls with the distance from the middle. Tall buildings stand on a broad base.
local Tower, House = module("Tower", "height", "style"), module("House", "height", "style")
local sites: { any } = {}
for _, lot in lots do
  local plan = lot.geometry:inset(2.5):geometry_n(1)
  local away = lot.geometry:distance(point(0, 0)) / extent
  local height = highest * math.exp(-4.5 * away) * random(0.6, 1.25) + random(7, 12)
  if lot.use ~= "building" or not plan then
    continue
  elseif height < 24 or plan:area() < 220 then
    table.insert(
      sites,
      { id = lot.id, geometry = plan, height = math.min(height, 21), style = choose({ 1, 2 }) }
    )
  else
    local core = plan:inset(3):geometry_n(1)
    local style = choose({ 1, 3, 3, 4, 4 })
    table.insert(sites, { id = lot.id, geometry = plan, height = 10, style = style })
    if core then
      local ring = {}
      for _, corner in core.rings[1] do
        table.insert(ring, { corner[1], corner[2], 10 })
      end
      table.insert(
        sites,
        { id = `{lot.id} core`, geometry = polygon(ring), height = height - 10, style = style }
      )
    end
  end
end
local buildings = lsystem({ object = footprint })
buildings:axiom(source(sites), function(site)
  local this = footprint(site.geometry, { height = site.height })
  return this,
    if site.height < 13 and site.style < 3
      then House(site.height, site.style)
      else Tower(site.height, site.style)
end)
buildings:interpret("Tower(height, style)", function(this, height, style)
  this:walls({ height = height, templates = styles[style] })
  this:roof({ kind = "flat", border = 0.9, color = "#a8a59c" })
end)
buildings:interpret("House(height, style)", function(this, height, style)
  this:walls({ height = height * 0.75, templates = styles[style] })
  this:roof({
    kind = choose({ "gable", "hip" }),
    slope = 36,
    overhang = 0.4,
    color = choose({ "#93503c", "#7d4538", "#66676b" }),
  })
end)
buildings:derive()

-- 6. Trees, built once, along the streets and in the parks.
local Trunk, Crown = module("Trunk"), module("Crown")
local nursery = lsystem({ object = turtle({ sides = 6, color = "#6a5440" }) })
nursery:axiom(Trunk(), Crown())
nursery:interpret("Trunk", function(this)
  this:width(0.3):forward(2.4)
end)
nursery:interpret("Crown", function(this)
  this:color("#5d8540"):advance(1.1):sphere(1.9):color("#6c9449"):turn(80):advance(1):sphere(1.3)
end)
local tree = nursery:derive(0)

local places: { any } = {}
for _, verge in city:verge("tree") do
  table.insert(places, { id = verge.id, geometry = point(verge.place) })
end
for _, lot in lots do
  for number = 1, if lot.use == "park" then lot.area / 60 elseif lot.use == "court" then lot.area / 160 else 0 do
    table.insert(
      places,
      { id = `{lot.id} tree {number}`, geometry = lot.geometry:random_point(random(), random()) }
    )
  end
end
local Tree = module("Tree", "place")
local trees = lsystem({ object = turtle() })
trees:axiom(source(places), function(place)
  return Tree(place.geometry:place())
end)
trees:interpret("Tree(place)", function(this, place)
  this:jump(place):roll(random(0, 360)):place(tree, random(0.8, 1.5))
end)
trees:derive()
