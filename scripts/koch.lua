--!strict
-- The Koch snowflake in relief. Seven snowflakes tile a snowflake: one in the centre, scaled by 1 / sqrt(3) and
-- rotated by 30 degrees, and six around it at a third of the size. Each flake is therefore a terrace with seven
-- smaller terraces.
local terraces =
  param("terraces", { default = 4, min = 0, max = 5, step = 1, doc = "Terraces on each other" })
local radius =
  param("radius", { default = 10, min = 1, max = 100, unit = "m", doc = "From the middle to a tip" })
local thickness =
  param("thickness", { default = 0.13, min = 0.02, max = 0.4, doc = "Of a terrace by its radius" })
local gap = param("gap", { default = 0.03, min = 0, max = 0.2, doc = "Between flakes by their radius" })
local low = param("low", { default = "#16407f", doc = "Colour of the lowest terrace" })
local high = param("high", { default = "#f4fbff", doc = "Colour of the highest" })

-- The outline: a triangle grows on the middle third of each edge, and smaller triangles on its edges.
local Edge = module("Edge", "length", "n") -- n generations remain, to its right
local Triangle = module("Triangle", "length")
local Corner = module("Corner", "angle")
local Along = module("Along", "length")

local function snowflake(generations: number, color)
  local plate = lsystem({
    object = extruder({ sides = 3, smooth = false, heading = { 0, 1, 0 }, color = color, roughness = 0.35 }),
    interpret = "last",
  })
  local side = math.sqrt(3)
  plate:axiom(
    Corner(90),
    Along(0.5),
    Corner(-90),
    Along(-side / 2),
    { Triangle(side) },
    Corner(-60),
    Edge(side, generations),
    Corner(120),
    Edge(side, generations),
    Corner(120),
    Edge(side, generations)
  )
  plate:rule("Edge(l, n)", function(this, l, n: number)
    if n == 0 then
      return Along(l)
    end
    local third = Edge(l / 3, n - 1)
    return third, { Triangle(l / 3) }, { Corner(-60), third, Corner(120), third }, Along(l / 3), third
  end)
  plate:interpret("Corner(angle)", function(this, angle)
    this:turn(angle)
  end)
  plate:interpret("Along(l)", function(this, l)
    this:advance(l)
  end)
  -- Pitched up, the extruder has the outside to its right. The centre of a triangle is l / sqrt(12) from its edges.
  plate:interpret("Triangle(l)", function(this, l)
    this:pitch(-90):shift(l / math.sqrt(12), l / 2)
    this:scale(l / math.sqrt(3)):extrude(thickness)
  end)
  return plate:derive()
end

-- A plate for each size and each tint. Small plates need fewer generations.
local plates = {}
for n = 0, terraces do
  plates[n] = {}
  for rank = 0, terraces - n do
    plates[n][rank] = snowflake(math.min(n + 1, 4), mix(low, high, rank / math.max(terraces, 1)))
  end
end

-- The terraces. The rank of a flake is the number of its central ancestors, which sets its height.
local Flake = module("Flake", "radius", "n", "rank")
local relief = lsystem({ object = turtle({}), interpret = "last" })
relief:axiom(Flake(radius, terraces, 0))

relief:rule("Flake(r, n, rank)", function(this, r: number, n: number, rank: number)
  local plate = Place(plates[n][rank], r * (1 - gap))
  if n == 0 then
    return plate
  end
  local parts =
    { plate, G(r * (1 - gap) * thickness), { Roll(30), Flake(r / math.sqrt(3), n - 1, rank + 1) } }
  for k = 1, 6 do
    table.insert(parts, { Roll(k * 60), Turn(-90), G(r * 2 / 3), Turn(90), Flake(r / 3, n - 1, rank) })
  end
  return table.unpack(parts)
end)

relief:derive()
