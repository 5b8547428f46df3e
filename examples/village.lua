--!strict
-- A village from a data file: walls by height, roofs by shape, colours by use, streets and trees.
-- burgeon run examples/village.lua -o village.glb
local storey = param(
  "storey",
  { default = 1, min = 0.5, max = 2, step = 0.1, text = "heights, as multiples of the data's" }
)
local pitch = param("pitch", { default = 42, min = 10, max = 60, unit = "deg", text = "slope of the roofs" })
local eaves =
  param("eaves", { default = 0.5, min = 0, max = 1.2, unit = "m", text = "overhang of the roofs" })
local trees = param("trees", { default = true, text = "whether trees are shown" })

local walls = {
  house = "#d9cdb8",
  shop = "#cdb79b",
  farm = "#b8a88f",
  barn = "#8d7358",
  church = "#c9c4b8",
  public = "#d3c3a5",
}
local roofs = {
  house = "#a4583f",
  shop = "#94503c",
  farm = "#8a5443",
  barn = "#6d625a",
  church = "#4f5960",
  public = "#5f666b",
}

local village = source("data/village.geojson")
local buildings, streets, plants = {}, {}, {}
for _, feature in village do
  if feature.use == "tree" then
    table.insert(plants, feature)
  elseif feature.use == "street" then
    table.insert(streets, feature)
  else
    table.insert(buildings, feature)
  end
end

-- The ground is a round plate with a bevelled edge.
local low, high = village.bounds.min, village.bounds.max
local ground = lsystem({ object = extruder({ color = "#8f9a6c", smooth = false, roughness = 1 }) })
local Plate = module("Plate", "width", "depth")
ground:axiom(Plate(high[1] - low[1] + 40, high[2] - low[2] + 40))
ground:interpret("Plate(w, d)", function(this, w, d)
  this:regular(96):jump({ (low[1] + high[1]) / 2, (low[2] + high[2]) / 2, -3 })
  this:scale(w / 2, d / 2):extrude(2.2)
  this:taper(w / 2 - 1, d / 2 - 1):extrude(0.8)
end)
ground:derive()

-- A street is a band along its line, a little above the ground.
local Street = module("Street", "points", "width")
local ways = lsystem({ object = extruder({ color = "#b9b0a0", smooth = false, roughness = 1 }) })
ways:axiom(source(streets), function(feature)
  return Street(feature.geometry.points, feature.width)
end)
ways:interpret("Street(points, width)", function(this, points, width)
  local left, right = {}, {}
  for index, point in points do
    local before, after = points[math.max(index - 1, 1)], points[math.min(index + 1, #points)]
    local along = vec(after[1] - before[1], after[2] - before[2], 0):unit()
    table.insert(left, { point[1] - along.y * width / 2, point[2] + along.x * width / 2 })
    table.insert(right, 1, { point[1] + along.y * width / 2, point[2] - along.x * width / 2 })
  end
  for _, point in left do
    table.insert(right, point)
  end
  this:polygon(right):jump({ 0, 0, 0 }):extrude(0.06)
end)
ways:derive()

-- A building is known by its outline around its own middle, turned so that its longest side lies along x.
local Building = module("Building", "outline", "holes", "turned", "height", "use")
local houses = lsystem({ object = extruder({ smooth = false }) })

local function middle(ring)
  local x, y, area = 0, 0, 0
  for index, a in ring do
    local b = ring[index % #ring + 1]
    local cross = (a[1] - ring[1][1]) * (b[2] - ring[1][2]) - (b[1] - ring[1][1]) * (a[2] - ring[1][2])
    x += (a[1] + b[1] + ring[1][1]) * cross / 3
    y += (a[2] + b[2] + ring[1][2]) * cross / 3
    area += cross
  end
  return x / area, y / area
end

local function longest(ring)
  local length, angle = 0, 0
  for index, a in ring do
    local b = ring[index % #ring + 1]
    local side = math.sqrt((b[1] - a[1]) ^ 2 + (b[2] - a[2]) ^ 2)
    if side > length then
      length, angle = side, math.atan2(b[2] - a[2], b[1] - a[1])
    end
  end
  return angle
end

houses:axiom(source(buildings), function(feature)
  local rings = feature.geometry.rings
  local x, y = middle(rings[1])
  local angle = longest(rings[1])
  local turned = {}
  for number, ring in rings do
    turned[number] = {}
    for index, point in ring do
      local dx, dy = point[1] - x, point[2] - y
      local c, s = math.cos(angle), math.sin(angle)
      turned[number][index] = { dx * c + dy * s, dy * c - dx * s }
    end
  end
  local holes = table.move(turned, 2, #turned, 1, {})
  return extruder({ smooth = false, position = { x, y, 0 } }),
    Building(turned[1], holes, math.deg(angle), feature.height * storey, feature.use)
end)

houses:interpret(
  "Building(outline, holes, turned, height, use)",
  function(this, outline, holes, turned, height, use)
    local width, depth = 0, 0
    for _, point in outline do
      width, depth = math.max(width, math.abs(point[1]) * 2), math.max(depth, math.abs(point[2]) * 2)
    end
    this:roll(turned):polygon(outline, holes)
    this:color("#9c958a"):scale(1.015):extrude(0.5)
    this:color(walls[use] or walls.house):scale(1):extrude(height - 0.5)
    -- The eaves, and from there on the roof: gabled on a rectangle, else towards the middle.
    local x, y = 1 + 2 * eaves / width, 1 + 2 * eaves / depth
    this:color(roofs[use] or roofs.house):scale(x, y):extrude(0.22)
    local rise = depth / 2 * math.tan(math.rad(pitch))
    if #holes > 0 then
      this:taper(x * 0.93, y * 0.93):extrude(rise * 0.16)
    elseif use == "church" and #outline == 4 then
      this:taper(0.02, 0.02):extrude(depth * 1.7)
    elseif #outline == 4 then
      this:taper(x * (use == "farm" and 0.55 or 1), 0.02):extrude(rise)
    else
      this:taper(x * 0.42, y * 0.42):extrude(rise * 0.55)
    end
  end
)
houses:derive()

-- Every tree is the same model, in its own size and turn.
if trees then
  local Trunk, Crown = module("Trunk"), module("Crown", "radius")
  local tree = lsystem({ object = turtle({ color = "#6b563f", width = 0.05 }) })
  tree:axiom(
    Trunk(),
    { Pitch(-12), Crown(0.26) },
    { Pitch(14), Crown(0.22) },
    { Roll(90), Pitch(15), Crown(0.2) }
  )
  tree:interpret("Trunk", function(this)
    this:forward(0.4)
  end)
  tree:interpret("Crown(r)", function(this, r)
    this:color("#5f7d45"):advance(0.25):sphere(r)
  end)
  local model = tree:derive()

  local Tree = module("Tree", "height", "turned")
  local wood = lsystem({ object = turtle() })
  wood:axiom(source(plants), function(feature)
    return turtle({ position = feature.geometry.points[1] }), Tree(feature.height, random(0, 360))
  end)
  wood:interpret("Tree(height, turned)", function(this, height, turned)
    this:roll(turned):place(model, height)
  end)
  wood:derive()
end
