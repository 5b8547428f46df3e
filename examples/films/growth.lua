--!strict
-- A plant that grows continuously: each module has an age, and sizes and angles are smooth functions of it. A film:
-- burgeon run examples/films/growth.lua --frames 0:36:0.25 -o growth.gif
local time = param("time", { default = 36, min = 0, max = 60, unit = "days", doc = "Age of the plant" })
local interval =
  param("interval", { default = 2, min = 0.5, max = 6, unit = "days", doc = "Between two leaves of a shoot" })
local nodes = param("nodes", { default = 10, min = 2, max = 20, step = 1, doc = "Leaves of the main shoot" })
local petals = param("petals", { default = "#d9688f", doc = "Colour of the flowers" })

local DELAY = 5 -- days from a bud to its first growth
local TINY = 1e-4 -- size of a module at its birth (m)
local TIP, WIDTH = 0.006, 0.004 -- length and width of the tip of a shoot (m)

-- Modules that create others know their age (days), and pass the rest of it on.
local Apex = module("Apex", "age", "left", "order")
local Bud = module("Bud", "age", "left", "order")
local Internode = module("Internode", "age", "order")
local Leaf = module("Leaf", "age", "order")
local Flower = module("Flower", "age")

-- A blade of 1 m in strips on both sides of its rib, which bends by `arch` (degrees).
local Rib = module("Rib", "k", "arch", "width")
local function blade(color, arch: number, width: number)
  local system = lsystem({ object = turtle({ color = color, roughness = 0.6 }) })
  system:axiom(Rib(0, arch, width))
  system:rule("Rib(k, arch, width)", function(this, k: number, arch, width)
    if k == 6 then
      return nil
    end
    local near = width * math.sin(math.pi * (k / 6) ^ 0.8)
    local far = if k == 5 then 0 else width * math.sin(math.pi * ((k + 1) / 6) ^ 0.8)
    local function strip(side: number): any
      return {
        Roll(side * 18),
        BeginPolygon(),
        Point(),
        { Turn(side * 90), G(near), Point() },
        { G(1 / 6), Turn(side * 90), G(far), Point() },
        { G(1 / 6), Point() },
        EndPolygon(),
      }
    end
    return strip(1), strip(-1), G(1 / 6), Pitch(arch / 6), Rib(k + 1, arch, width)
  end)
  return system:derive()
end
local green, petal = blade("#5c9440", 60, 0.19), blade(petals, 35, 0.3)

-- Growth from a size at birth to another after some days, without a jump in value or speed.
local function grown(age: number, days: number, size: number, birth: number?): number
  return lerp(birth or TINY, size, ease.smooth(math.clamp(age / days, 0, 1)))
end

local plant = lsystem({ object = turtle({ color = "#7ba24c", sides = 8 }), interpret = "last" })
plant:axiom(Apex(time, nodes, 0))

-- A shoot creates a node after each interval: an internode, a leaf and a bud, which have existed since then. Numbers are
-- drawn when the rule applies, so they are the same in every frame.
plant:rule("Apex(age, left, order)", {
  when = function(this, age, left)
    return age > interval and left > 0
  end,
}, function(this, age, left, order)
  local rest = age - interval
  return Internode(rest, order),
    { Leaf(rest, order) },
    { Pitch(40), Bud(rest, math.ceil(left / 3), order + 1) },
    Roll(137.5 + random(-8, 8)),
    Apex(rest, left - 1, order)
end)
-- The last node bears a flower.
plant:rule("Apex(age, left, order)", {
  when = function(this, age, left)
    return age > interval and left == 0
  end,
}, function(this, age)
  return Flower(age - interval)
end)
-- Buds of the main shoot grow out; those of its branches rest.
plant:rule("Bud(age, left, order)", {
  when = function(this, age, left, order)
    return age > DELAY and order == 1
  end,
}, function(this, age, left, order)
  return Apex(age - DELAY, left, order)
end)

-- Whatever replaces a module begins with its size, so that nothing jumps.
plant:interpret("Apex", function(this)
  this:width(WIDTH):forward(TIP)
end)
plant:interpret("Bud(age, left, order)", function(this, age)
  this:width(grown(age, DELAY, WIDTH)):forward(grown(age, DELAY, TIP))
end)
plant:interpret("Internode(age, order)", function(this, age, order)
  local scale = 0.7 ^ order
  this:width(grown(age, 30, 0.018 * scale, WIDTH)):forward(grown(age, 9, 0.085 * scale))
end)
plant:interpret("Leaf(age, order)", function(this, age, order)
  local scale = 0.75 ^ order
  this:pitch(lerp(6, 58, ease.smooth(math.clamp(age / 12, 0, 1))))
  this:width(grown(age, 12, 0.006 * scale)):forward(grown(age, 10, 0.05 * scale))
  this:place(green, grown(age, 11, 0.2 * scale))
end)
plant:interpret("Flower(age)", function(this, age)
  local open, size = ease.smooth(math.clamp(age / 8, 0, 1)), grown(age, 7, 0.1)
  local whorl: { any } = { Width(WIDTH), F(TIP + size * 0.4), { Color("#f2c84b"), Sphere(size * 0.22) } }
  for k = 1, 6 do
    table.insert(whorl, { Roll(k * 60), Pitch(lerp(5, 72, open)), Place(petal, size) })
  end
  return sequence(whorl)
end)

plant:derive()
