--!strict
-- A fence around a plot: the edges of a polygon, boards at equal distances, and a gap for the gate.
local spacing =
  param("spacing", { default = 0.16, min = 0.1, max = 1, unit = "m", doc = "From board to board" })

local plot = polygon({ { 0, 0 }, { 9, 0 }, { 11, 5 }, { 6, 8 }, { 0, 6.5 } })
local gate = point(4.5, 0):buffer(0.7)

local Lawn, Board, Post = module("Lawn"), module("Board", "place", "facing"), module("Post", "place")

local garden = lsystem({ object = extruder({ smooth = false }) })
local modules: { any } = { { Lawn() } }
for _, edge in plot:boundary():segments() do
  local length = edge:length()
  local count = math.max(1, math.floor(length / spacing))
  for number = 0, count - 1 do
    local place = edge:line_interpolate((number + 0.5) / count)
    if place:disjoint(gate) then
      table.insert(modules, { Board(place, edge:direction()) })
    end
  end
  table.insert(modules, { Post(edge:start_point()) })
end
garden:axiom(sequence(modules))
garden:interpret("Lawn", function(this)
  this:color("#86a05a"):polygon(plot:buffer(0.4)):jump({ 0, 0, -0.15 }):extrude(0.15)
end)
garden:interpret("Board(place, facing)", function(this, place, facing)
  this:jump(place:place()):roll(facing or 0):color("#f2eee4"):rectangle(0.1, 0.03):extrude(1)
  this:scale(1):taper(0.05, 1):extrude(0.08)
end)
garden:interpret("Post(place)", function(this, place)
  this:jump(place:place()):color("#8a6f52"):rectangle(0.14, 0.14):extrude(1.25)
end)
garden:derive()
