--!strict
-- Shapes and materials of models: blocks, plates and beams, and the models themselves. They are seen from the front:
-- x to the right, z up, y into the wall; y = 0 is the surface. Lengths are in metres.
local shapes = {}

type Material = { [string]: any }
type Piece = { [string]: any }

-- Materials that many buildings use.
function shapes.matt(color: string): Material
  return { color = color, roughness = 0.92 }
end

function shapes.painted(color: string): Material
  return { color = color, roughness = 0.55 }
end

shapes.glass = { color = "#26333d", roughness = 0.08, metallic = 0.35, name = "glass" }
shapes.dark_glass = { color = "#161d22", roughness = 0.12, metallic = 0.2, name = "dark glass" }
shapes.clear_glass = { color = "#8fa9b3", roughness = 0.1, metallic = 0.3, name = "clear glass" }
shapes.iron = { color = "#23262a", roughness = 0.5, metallic = 0.6, name = "iron" }
shapes.steel = { color = "#8b9094", roughness = 0.4, metallic = 0.8, name = "steel" }
shapes.zinc = { color = "#737d87", roughness = 0.5, metallic = 0.45, name = "zinc" }
shapes.clay = { color = "#a3705a", roughness = 0.9, name = "clay" }

-- The model itself. It is not shown at its own position, even if nothing places it.
function shapes.kept(model)
  panel({ model = model, stretch = true })
  return model
end

local Shapes = module("Shapes", "list")

-- A block between two corners.
local function box(material: Material, x0, x1, y0, y1, z0, z1): Piece
  return { kind = "box", material = material, x = { x0, x1 }, y = { y0, y1 }, z = { z0, z1 } }
end
shapes.box = box

-- A plate with an outline of points { x, z }, from the depth y0 to y1.
local function plate(material: Material, outline: any, y0, y1): Piece
  local points = {}
  for _, point in outline do
    table.insert(points, { point[1], -point[2] })
  end
  return { kind = "plate", material = material, outline = points, y = { y0, y1 } }
end
shapes.plate = plate

-- A block with an outline on the ground of points { x, y }, from z0 to z1.
local function prism(material: Material, outline, z0, z1): Piece
  return { kind = "prism", material = material, outline = outline, z = { z0, z1 } }
end
shapes.prism = prism

-- A beam as wide as `width` from { x, z } to { x, z }, from the depth y0 to y1.
local function beam(material: Material, from: any, to: any, width, y0, y1): Piece
  local dx, dz = to[1] - from[1], to[2] - from[2]
  local length = math.sqrt(dx * dx + dz * dz)
  local x, z = -dz / length * width / 2, dx / length * width / 2
  local outline = {
    { from[1] - x, from[2] - z },
    { to[1] - x, to[2] - z },
    { to[1] + x, to[2] + z },
    { from[1] + x, from[2] + z },
  }
  return plate(material, outline, y0, y1)
end
shapes.beam = beam

-- A plate of the width 2 `w`, from the height and depth { y, z } down to another, `thick` high.
function shapes.leaning(material: Material, w: number, from, to, thick: number): Piece
  return { kind = "leaning", material = material, w = w, from = from, to = to, thick = thick }
end

-- A model of shapes, or of lists of shapes.
function shapes.model(...)
  local system = lsystem({ object = extruder({ smooth = false }) })
  local all: { any } = {}
  for _, given: any in { ... } do
    if given.kind then
      table.insert(all, given)
    else
      table.move(given, 1, #given, #all + 1, all)
    end
  end
  system:axiom(Shapes(all))
  system:interpret("Shapes(list)", function(this, list)
    for _, shape in list do
      this:material(shape.material):direction({ 0, 0, 1 })
      if shape.kind == "box" then
        local x, y, z = shape.x, shape.y, shape.z
        this:rectangle(x[2] - x[1], y[2] - y[1])
        this:jump({ (x[1] + x[2]) / 2, (y[1] + y[2]) / 2, z[1] }):extrude(z[2] - z[1])
      elseif shape.kind == "prism" then
        this:polygon(shape.outline)
        this:jump({ 0, 0, shape.z[1] }):extrude(shape.z[2] - shape.z[1])
      elseif shape.kind == "leaning" then
        local a, b, t = shape.from, shape.to, shape.thick
        -- Turned from z to x, the section has its x axis downwards.
        local outline = { { -a[2], a[1] }, { -b[2], b[1] }, { t - b[2], b[1] }, { t - a[2], a[1] } }
        this:direction({ 1, 0, 0 }):polygon(outline):jump({ -shape.w, 0, 0 }):extrude(2 * shape.w)
      else
        this:direction({ 0, 1, 0 }):polygon(shape.outline)
        this:jump({ 0, shape.y[1], 0 }):extrude(shape.y[2] - shape.y[1])
      end
    end
  end)
  return shapes.kept(system:derive(0))
end

return shapes
