--!strict
-- Lotka's reactions: a species Y1 multiplies on constant food, Y2 feeds on Y1, and Y2 decays. The numbers of both molecules
-- oscillate irregularly, since each reaction is a random event. One module holds both numbers, and each reaction is a rule
-- whose propensity depends on them.
-- Source: D. T. Gillespie, Exact stochastic simulation of coupled chemical reactions, 1977, reactions (38) and figure 8.
local duration = param("duration", { default = 5, min = 1, max = 30, doc = "Time of the simulation" })

local State, Sample = module("State", "y1", "y2", "next"), module("Sample", "time", "y1", "y2")

local reactions = lsystem()
reactions:axiom(State(1000, 1000, 0))

-- The state after a reaction; it leaves a sample once in each hundredth of a unit of time.
local function after(y1: number, y2: number, next: number): any
  if time() < next then
    return State(y1, y2, next)
  end
  return Sample(time(), y1, y2), State(y1, y2, next + 0.01)
end

reactions:rule("State(y1, y2, next)", {
  propensity = function(this, y1: number)
    return 10 * y1
  end,
}, function(this, y1, y2, next)
  return after(y1 + 1, y2, next)
end)
reactions:rule("State(y1, y2, next)", {
  propensity = function(this, y1: number, y2: number)
    return 0.01 * y1 * y2
  end,
}, function(this, y1, y2, next)
  return after(y1 - 1, y2 + 1, next)
end)
reactions:rule("State(y1, y2, next)", {
  propensity = function(this, y1: number, y2: number)
    return 10 * y2
  end,
}, function(this, y1, y2, next)
  return after(y1, y2 - 1, next)
end)
local result = reactions:derive({ time = duration })

-- The numbers of both species as curves over the time: 1 m is 100 molecules, or a tenth of a unit of time.
local From, To, Color = module("From", "x", "z"), module("To", "x", "z"), module("Color", "color")
local first, second = {}, {}
local sums = { y1 = 0, y2 = 0 }
for _, item in result:chain() do
  if item.name == "Sample" then
    local place: any = if #first == 0 then From else To
    first[#first + 1] = place(10 * item.time, item.y1 / 100)
    second[#second + 1] = place(10 * item.time, item.y2 / 100)
    sums.y1 += item.y1
    sums.y2 += item.y2
  end
end

local plot = lsystem({ object = turtle({ sides = 8, width = 0.3, color = "#4d8f6a" }) })
plot:axiom({ sequence(first) }, { Color("#c8553d"), sequence(second) })
plot:interpret("Color(color)", function(this, color: string)
  this:color(color)
end)
plot:interpret("From(x, z)", function(this, x: number, z: number)
  this:jump(vec(x, 0, z))
end)
plot:interpret("To(x, z)", function(this, x: number, z: number)
  local move = vec(x, 0, z) - this:position()
  this:face(move):forward(move:length())
end)
plot:derive(0)

-- One sample in each hundredth of a unit of time; on average, there are 1000 molecules of each species.
local count = #first
expect(count, 100 * duration, 2)
expect(sums.y1 / count, 1000, 150)
expect(sums.y2 / count, 1000, 150)
