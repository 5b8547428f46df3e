--!strict
-- Landscapes of five kinds: a square is divided into quadrants, and rules define the change of each quadrant.
local kinds = { "mountains", "hills", "ridge", "crater", "plain" }
local kind = param("kind", { default = "mountains", choices = kinds, doc = "What rises there" })
local size = param("size", { default = 3000, min = 500, max = 50000, unit = "m", doc = "Length of a side" })
local levels =
  param("levels", { default = 9, min = 3, max = 11, step = 1, doc = "How often the square is divided" })
local rough = param("rough", { default = 1, min = 0, max = 2, doc = "How much finer cells add" })
local trees = param("trees", { default = true, doc = "Whether trees grow" })

-- Properties of a kind: the height (m) of its form at a position from -1 to 1, the initial noise and its decay from
-- level to level, a mapping of the noise heights, the water level and the snow line.
type Kind = {
  form: ((x: number, y: number) -> number)?,
  noise: number,
  decay: number,
  remap: { { number } }?,
  water: number?,
  snow: number?,
  rivers: number?,
}
local function rise(from: number, to: number, at: number): number
  local along = math.clamp((at - from) / (to - from), 0, 1)
  return along * along * (3 - 2 * along)
end
local shapes: { [string]: Kind } = {
  -- Folded noise: values near zero become a crest, values far from zero a valley.
  mountains = {
    noise = 0.24,
    decay = 0.52,
    remap = {
      { -0.3, 0 },
      { -0.2, 0.012 },
      { -0.1, 0.07 },
      { -0.04, 0.15 },
      { 0, 0.225 },
      { 0.04, 0.15 },
      { 0.1, 0.07 },
      { 0.2, 0.012 },
      { 0.3, 0 },
    },
    snow = 0.13,
    rivers = 4,
  },
  hills = {
    noise = 0.13,
    decay = 0.46,
    remap = { { -0.3, -0.07 }, { -0.03, -0.014 }, { 0, 0 }, { 0.3, 0.36 } },
    water = -0.009,
    rivers = 5,
  },
  ridge = {
    form = function(x, y)
      local across = math.abs(y + 0.25 * math.sin(2.2 * x) - 0.1)
      return 0.15 * math.exp(-6 * across) * rise(1.3, 0.4, math.abs(x)) - 0.02
    end,
    noise = 0.075,
    decay = 0.535,
    -- Valleys are filled up to the base.
    remap = { { -0.2, -0.046 }, { -0.05, -0.04 }, { -0.025, -0.025 }, { 0.3, 0.3 } },
    snow = 0.11,
    rivers = 4,
  },
  crater = {
    form = function(x, y)
      local r = math.sqrt(x * x + y * y)
      local wall = 0.085 * rise(0.3, 0.5, r) * rise(1, 0.5, r)
      return wall - 0.04 * rise(0.45, 0.2, r) + 0.045 * rise(0.16, 0, r)
    end,
    noise = 0.05,
    decay = 0.53,
    remap = { { -0.2, -0.055 }, { -0.035, -0.035 }, { 0.3, 0.3 } },
    water = -0.03,
    rivers = 3,
  },
  plain = {
    noise = 0.022,
    decay = 0.47,
    remap = { { -0.1, -0.03 }, { -0.01, -0.004 }, { 0, 0 }, { 0.1, 0.03 } },
    water = -0.0035,
    rivers = 6,
  },
}
local shape = shapes[kind]
local remap = {}
for index, pair in shape.remap or {} do
  remap[index] = { pair[1] * size, pair[2] * size }
end

-- Parameters of a cell: noise, form, centre, width (the whole is 2), and remaining noise.
local Ground = module("Ground", "height", "form", "x", "y", "width", "noise")
local cells = lsystem()
cells:axiom(Ground(0, 0, 0, 0, 2, shape.noise * size))
cells:rule(
  "Ground(h, f, x, y, w, d)",
  function(this, h: number, f: number, x: number, y: number, w: number, d: number)
    local q = w / 4
    local function quadrant(x, y)
      local form = if shape.form then shape.form(x, y) * size else 0
      return Ground(h + random(-d, d) * if w < 0.1 then rough else 1, form, x, y, w / 2, d * shape.decay)
    end
    return quadrant(x - q, y + q), quadrant(x + q, y + q), quadrant(x - q, y - q), quadrant(x + q, y - q)
  end
)

-- A conifer grows from its whorls: each becomes a cone of branches and a smaller whorl above it.
local Trunk = module("Trunk", "height")
local Whorl = module("Whorl", "left", "radius")
local Branches = module("Branches", "radius")
local function conifer(height: number, color: string)
  local tree =
    lsystem({ object = extruder({ sides = 6, smooth = false, roughness = 1 }), interpret = "last" })
  tree:axiom(Trunk(height * 0.22), Whorl(3, height * 0.19))
  tree:rule("Whorl(n, r)", function(this, n, r)
    if n > 0 then
      return Branches(r), Whorl(n - 1, r * 0.74)
    end
    return nil
  end)
  tree:interpret("Trunk(h)", function(this, h)
    this:color("#4b3a2a"):scale(h * 0.14):extrude(h)
  end)
  tree:interpret("Branches(r)", function(this, r)
    this:color(color):scale(r):taper(0):extrude(r * 2.1):advance(-r * 1.15)
  end)
  return tree:derive()
end

local snow, shore = (shape.snow or 1) * size, (shape.water or -1) * size
local plants = {}
if trees then
  local line = if shape.snow then size * 0.085 else size
  plants = {
    {
      models = { conifer(13, "#2f4526"), conifer(17, "#37502b"), conifer(10, "#425a30") },
      -- Single trees are invisible on a very large square.
      density = math.min(60, 1.2e10 / (size * size)),
      on = {
        slope = { 32, 20 },
        -- Up to the tree line, or from the shore.
        height = if shape.water then { shore + size / 700, shore + size / 350 } else { line, line * 0.6 },
        noise = 0.5,
        patches = 0.92,
        scale = size / 9,
      },
      size = { 0.7, 1.5 },
      sink = 0.3,
    },
  }
end

local land = lsystem({
  object = terrain({
    size = size,
    levels = levels,
    rules = cells,
    remap = remap,
    error = size / 6000,
    base = -0.07 * size,
    water = if shape.water then { level = shape.water * size, clarity = size / 500 } else nil,
    covers = {
      { color = "#7b8250" },
      { color = "#56663a", on = { patches = 1, scale = size / 9 } },
      { color = "#8b8a55", on = { patches = 1, scale = size / 31 }, amount = 0.6 },
      { color = "#8d8166", on = { noise = 0.5, scale = size / 60, height = { size * 0.05, size * 0.11 } } },
      { color = "#857d71", on = { slope = { 21, 34 }, noise = 0.3, scale = size / 80 } },
      { color = "#6b655e", on = { slope = { 34, 48 }, noise = 0.3, scale = size / 120 } },
      {
        color = "#f3f5f8",
        on = { height = { snow * 0.8, snow * 1.1 }, slope = { 58, 40 }, noise = 0.35, scale = size / 60 },
      },
      { color = "#b7a987", on = { height = { shore + size / 900, shore + size / 2400 } } },
    },
    plants = plants,
  }),
})
local Spring = module("Spring", "x", "y")
local springs = {}
for index = 1, shape.rivers or 0 do
  springs[index] = Spring(random(-0.35, 0.35) * size, random(-0.35, 0.35) * size)
end
land:axiom(table.unpack(springs))
-- The bed of a river cuts through obstacles, so a river starts at the first position near its source that needs no
-- deep cut.
land:interpret("Spring(x, y)", function(this, x, y)
  local width = size / 170
  for turn = 0, 80 do
    local away, way = size * 0.035 * math.sqrt(turn), math.rad(137.5 * turn)
    local at = { x + away * math.cos(way), y + away * math.sin(way) }
    local inside = math.max(math.abs(at[1]), math.abs(at[2])) < 0.45 * size
    -- No river starts in the water or near its shore.
    if inside and this:height(at) > shore + size / 200 then
      local cut = this:river_cut(at, width)
      if cut and cut < math.max(width, 10) then
        this:river(at, width)
        return
      end
    end
  end
end)
land:derive()
