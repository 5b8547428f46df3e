--!strict
-- A village from a data file: walls by height, roofs by shape, colours by use, streets and trees.
-- burgeon run examples/village.lua -o village.glb
local storey = param(
  "storey",
  { default = 1, min = 0.5, max = 2, step = 0.1, doc = "heights, as multiples of the data's" }
)
local pitch = param("pitch", { default = 42, min = 10, max = 60, unit = "deg", doc = "slope of the roofs" })
local eaves = param("eaves", { default = 0.5, min = 0, max = 1.2, unit = "m", doc = "overhang of the roofs" })
local trees = param("trees", { default = true, doc = "whether trees are shown" })

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
local ground =
  lsystem({ object = extruder({ color = "#8f9a6c", smooth = false, roughness = 1 }), city = "LandUse" })
local Plate = module("Plate", "width", "depth")
ground:axiom(Plate(high[1] - low[1] + 40, high[2] - low[2] + 40))
ground:interpret("Plate(w, d)", function(this, w, d)
  this:regular(96):jump({ (low[1] + high[1]) / 2, (low[2] + high[2]) / 2, -3 })
  this:scale(w / 2, d / 2):extrude(2.2)
  this:taper(w / 2 - 1, d / 2 - 1):extrude(0.8)
end)
ground:derive()

-- A street is a band along its line, slightly above the ground.
local Street = module("Street", "points", "width")
local ways =
  lsystem({ object = extruder({ color = "#b9b0a0", smooth = false, roughness = 1 }), city = "Road" })
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

-- A building has its outline as plan: a plinth, walls, and a roof that suits its use and its size.
local Building = module("Building", "height", "use", "roof")
local houses = lsystem({ object = footprint })

houses:axiom(source(buildings), function(feature: any)
  local use = feature.use
  local tower = use == "church" and #feature.geometry.rings[1] == 4
  local roof = if tower then "spire" elseif use == "farm" then "dutch_hip" else "gable"
  return footprint(feature.geometry), Building(feature.height * storey, use, roof)
end)

houses:interpret("Building(height, use, roof)", function(this, height, use, roof)
  local color = walls[use] or walls.house
  this:walls({ height = 0.5, color = "#9c958a" }):walls({ height = height - 0.5, color = color })
  this:roof({
    kind = if roof == "spire" then "hip" else roof,
    slope = if roof == "spire" then 74 else pitch,
    overhang = if roof == "spire" then 0.2 else eaves,
    slab = 0.22,
    color = roofs[use] or roofs.house,
    gable = { color = color },
  })
end)
houses:derive()

-- All trees are the same model, with different sizes and rotations.
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
  local wood = lsystem({ object = turtle(), city = "SolitaryVegetationObject" })
  wood:axiom(source(plants), function(feature)
    return turtle({ position = feature.geometry.points[1] }), Tree(feature.height, random(0, 360))
  end)
  wood:interpret("Tree(height, turned)", function(this, height, turned)
    this:roll(turned):place(model, height)
  end)
  wood:derive()
end
