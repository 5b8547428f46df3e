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

-- A blade of 1 m along z. Its halves are raised by `fold`, and its rib bends back by `arch` (both degrees).
local function blade(width: number, fold: number, arch: number): Surface
  local rows: { { Vector } } = {}
  local place, across, up = vec(0, 0, 0), math.cos(math.rad(fold)), math.sin(math.rad(fold))
  for k = 0, 6 do
    local half = width * math.sin(math.pi * (k / 6) ^ 0.8)
    local angle = math.rad(arch * k / 6)
    -- y is the side of the stem, from which the blade bends away.
    local rise = vec(0, -math.cos(angle), math.sin(angle)) * (half * up)
    local side = vec(half * across, 0, 0)
    rows[k + 1] = { place - side + rise, place, place + side + rise }
    place += vec(0, math.sin(angle), math.cos(angle)) / 6
  end
  return surface({ points = rows, kind = "b-spline", degree = 2, divisions = 2 })
end
local leaf_bud, leaf = blade(0.1, 75, -20), blade(0.2, 14, 65)
local petal_bud, petal = blade(0.22, 50, -60), blade(0.32, 16, 45)

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
  local open = ease.smooth(math.clamp(age / 10, 0, 1))
  this:color("#5c9440"):surface(leaf_bud:mix(leaf, open), grown(age, 11, 0.2 * scale))
end)
plant:interpret("Flower(age)", function(this, age)
  local open, size = ease.smooth(math.clamp(age / 8, 0, 1)), grown(age, 7, 0.1)
  this:width(WIDTH):forward(TIP + size * 0.4):color("#f2c84b"):sphere(size * lerp(0.1, 0.22, open))
  local shape = petal_bud:mix(petal, open)
  this:color(petals)
  for _ = 1, 6 do
    this:roll(60):pitch(lerp(5, 72, open)):surface(shape, size):pitch(-lerp(5, 72, open))
  end
end)

plant:derive()
