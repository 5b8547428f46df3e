--!strict
-- A space station: parts dock at free ports, unless they would overlap a part that is there already.
local flights = param("flights", { default = 6, min = 1, max = 12, step = 1, doc = "Rounds of construction" })
local color = param("color", { default = "#e6e7e8", doc = "Colour of the hulls" })

-- A port becomes a plan, and a plan becomes a part with ports of its own.
local Port, Plan = module("Port", "at", "way"), module("Plan", "kind", "at", "way", "length")
local Part = module("Part", "kind", "at", "way", "length")
local space = volumes()
local station = lsystem({ object = extruder({ sides = 32 }), environment = space })

local WAYS = { vec(1, 0, 0), vec(-1, 0, 0), vec(0, 1, 0), vec(0, -1, 0), vec(0, 0, 1), vec(0, 0, -1) }
local GREY, GOLD = "#9aa0a6", "#b9862e"

-- The box around a part that extends from `at` by `length` along `way`.
local function room(kind: string, at: Vector, way: Vector, length: number): Shape
  local wide = if kind == "wing" then 3.4 else 1.95
  local across = vec(wide, wide, wide) - vec(math.abs(way.x), math.abs(way.y), math.abs(way.z)) * wide
  local from, to = at + way * 0.1, at + way * length
  local low = vec(math.min(from.x, to.x), math.min(from.y, to.y), math.min(from.z, to.z)) - across
  local high = vec(math.max(from.x, to.x), math.max(from.y, to.y), math.max(from.z, to.z)) + across
  local size = high - low
  return cuboid(size.x, size.y, size.z):translate(low)
end

station:axiom(Plan("node", vec(0, 0, -2), vec(0, 0, 1), 4))
station:rule("Port(at, way)", function(this, at: Vector, way: Vector)
  local kind = choose({ "hull", "node", "wing" }, { 3, 2, if way.z == 0 then 3 else 0 })
  local length = if kind == "node" then 4 elseif kind == "hull" then random(6, 10) else random(14, 20)
  if space:is_free(room(kind, at, way, length), "part") then
    return Plan(kind, at, way, length)
  end
  return nil
end)
-- Of two plans that overlap, the first one is built.
station:rule("Plan(kind, at, way, length)", function(this, kind, at: Vector, way: Vector, length: number)
  if not space:has(room(kind, at, way, length)) then
    return nil
  end
  local parts: { any } = { { Part(kind, at, way, length) } }
  if kind == "hull" then
    table.insert(parts, Port(at + way * length, way))
  elseif kind == "node" then
    for _, other in WAYS do
      if other:dot(way) > -0.5 then
        table.insert(parts, Port(at + way * 2 + other * 2, other))
      end
    end
  end
  return sequence(parts)
end)
station:interpret("Plan(kind, at, way, length)", function(this, kind, at: Vector, way: Vector, length: number)
  space:claim(room(kind, at, way, length))
end)

local function hull(this: Extruder, at: Vector, way: Vector, length: number)
  local body = length - 2.2
  this:taper(2):extrude(0.8)
  for part = 1, 5 do
    this:color(if part % 2 == 0 then "#c9ccd0" else color):scale(2):extrude(body / 5)
  end
  this:taper(1.1):extrude(0.8):color(GREY):extrude(0.3)
  -- Windows and rails around the hull.
  local side = way:cross(if way.z == 0 then vec(0, 0, 1) else vec(1, 0, 0))
  for turn = 30, 360, 30 do
    local out = side * math.cos(math.rad(turn)) + way:cross(side) * math.sin(math.rad(turn))
    if turn % 90 == 0 then
      this:jump(at + way * 1.3 + out * 2):direction(way):color(GOLD):scale(0.08):extrude(body - 0.4)
    else
      this:color("#2b3946"):direction(out):scale(0.28)
      for window = 1, 3 do
        this:jump(at + way * (1.1 + body * (window - 0.5) / 3) + out * 1.9):extrude(0.14)
      end
    end
  end
end
local function node(this: Extruder, center: Vector)
  this:jump(center):direction({ 0, 0, 1 }):shape(ball(1.9, 32):smooth())
  for _, way in WAYS do
    this:jump(center + way * 1.4):direction(way):color(GREY):scale(1.1):extrude(0.6)
  end
end
local function wing(this: Extruder, at: Vector, way: Vector, length: number)
  local across = way:cross(vec(0, 0, 1))
  this:color(GREY):scale(0.22):extrude(length - 0.4):smooth(false):scale(1)
  for bay = 3.2, length - 2, 2.1 do
    for _, side in { -1.8, 1.8 } do
      this:jump(at + way * bay + across * side):direction(way, { 0, 0, 1 })
      this:color("#22355f"):rectangle(2.7, 0.06):extrude(1.9):color(GOLD):rectangle(2.9, 0.1):extrude(0.06)
    end
  end
end
station:interpret("Part(kind, at, way, length)", function(this, kind, at: Vector, way: Vector, length: number)
  space:claim(room(kind, at, way, length), "part")
  this:jump(at):direction(way):color(GREY):scale(1.1):extrude(0.3):color(color)
  if kind == "hull" then
    hull(this, at, way, length)
  elseif kind == "node" then
    node(this, at + way * 2)
  else
    wing(this, at, way, length)
  end
end)
station:derive(2 * flights)
