--!strict
-- Traffic on a road: a car moves if the place before it is free (rule 184). One rule replaces a car and a gap
-- together by a gap and a car, so cars stay in order. Each car keeps its places, and is drawn as a line: time goes
-- up.
-- Source: S. Wolfram, Statistical mechanics of cellular automata, 1983.
local places = param("places", { default = 70, min = 4, max = 200, step = 1, doc = "Places of the road" })
local density =
  param("density", { default = 0.8, min = 0, max = 1, doc = "Cars per place in the first half of the road" })
local steps = param("steps", { default = 44, min = 0, max = 200, step = 1, doc = "Number of steps" })

local Car, Gap, Gone = module("Car", "place", "track"), module("Gap"), module("Gone", "track")

local road =
  lsystem({ object = turtle({ heading = { 0, 0, 1 }, width = 0.45, sides = 4 }), interpret = "last" })
local row: { any }, cars = {}, 0
local draw = stream("cars")
for place = 1, places do
  local is_car = place <= places / 2 and draw() < density
  row[place] = if is_car then Car(place, "") else Gap()
  cars += if is_car then 1 else 0
end
road:axiom(sequence(row))
-- The track has a letter for each step: m for a move, s for a stop.
road:rule("Car(place, track) Gap", function(this, place: number, track: string)
  return Gap(), Car(place + 1, track .. "m")
end)
road:rule("Car(place, track)", function(this, place: number, track: string)
  if place == places then
    return Gap(), Gone(track .. "m")
  end
  return Car(place, track .. "s")
end)
local function draw_track(this: Turtle, place: number, track: string)
  local moves = select(2, track:gsub("m", ""))
  this:jump({ place - moves, 0, 0 })
  for k = 1, #track do
    local is_move = track:sub(k, k) == "m"
    this:color(if is_move then "#3f7fb0" else "#c8452f")
    this:face(if is_move then { 1, 0, 1 } else { 0, 0, 1 }):forward(if is_move then math.sqrt(2) else 1)
  end
end
road:interpret("Car(place, track)", function(this, place, track)
  draw_track(this, place, track)
end)
road:interpret("Gone(track)", function(this, track)
  draw_track(this, places + 1, track)
end)
local result = road:derive(steps)

-- No car is lost, and no place of the road.
expect(result.counts.Car + result.counts.Gone, cars)
expect(result.counts.Car + result.counts.Gap, 70)
-- The jam has dissolved: all cars have moved in the last step.
expect(string.find(result.chains[1], 's"', 1, true) == nil, true)
-- Picture: --azimuth 180 --elevation 0
