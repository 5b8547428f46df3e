--!strict
-- A wood of 2,500 trees: three models are built once, and placed with random sizes and turns.
local count = param("count", { default = 2500, min = 10, max = 20000, step = 10, doc = "Number of trees" })

local Trunk, Cone, Ball = module("Trunk", "height"), module("Cone", "radius"), module("Ball", "radius")

local function build(color: string, ...: Module): Derived
  local system = lsystem({ object = extruder({ sides = 8, color = "#5c4a39" }) })
  system:axiom(...)
  system:interpret("Trunk(height)", function(this, height)
    this:scale(0.22):extrude(height)
  end)
  system:interpret("Cone(radius)", function(this, radius)
    this:color(color):scale(radius):taper(radius * 0.15):extrude(radius * 1.7):advance(-radius * 0.6)
  end)
  system:interpret("Ball(radius)", function(this, radius)
    this:color(color):scale(radius * 0.5):taper(radius):extrude(radius * 0.7)
    this:taper(radius * 0.35):extrude(radius * 0.9)
  end)
  return system:derive(0)
end
local models = {
  build("#3b5a3a", Trunk(1.2), Cone(1.9), Cone(1.5), Cone(1)),
  build("#6f8f42", Trunk(2.4), Ball(2)),
  build("#b98a3c", Trunk(2), Ball(1.6)),
}

local Wood, Tree = module("Wood"), module("Tree", "kind", "x", "y")
local forest = lsystem({ object = turtle() })
forest:axiom(Wood())
forest:rule("Wood", function(this)
  local trees = {}
  while #trees < count do
    local x, y = random(-110, 110), random(-110, 110)
    -- Woods and glades follow noise; so do the kinds.
    if noise(x / 45, y / 45) + random(-0.25, 0.25) > -0.1 then
      local kind = if noise(x / 30, y / 30, 7) > 0.15 then 1 else choose({ 2, 2, 2, 3 })
      table.insert(trees, { Tree(kind, x, y) })
    end
  end
  return Wood(), sequence(trees)
end)
forest:interpret("Wood", function(this)
  local corners = { { -115, -115, 0 }, { 115, -115, 0 }, { 115, 115, 0 }, { -115, 115, 0 } }
  this:color("#87935c"):mesh(corners, { { 1, 2, 3, 4 } })
end)
forest:interpret("Tree(kind, x, y)", function(this, kind, x, y)
  this:jump({ x, y, 0 }):roll(random(0, 360)):place(models[kind], random(0.8, 1.7))
end)
forest:derive(1)
