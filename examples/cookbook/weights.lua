--!strict
-- A brick wall: three of ten bricks are dark, one is missing, and the others are red.
local Row, Course, Brick = module("Row", "number"), module("Course", "number"), module("Brick")
local Red, Dark, Gap = module("Red"), module("Dark"), module("Gap")

local wall = lsystem({ object = extruder({ smooth = false }) })

local courses = {}
for number = 0, 15 do
  table.insert(courses, { Row(number) })
end
wall:axiom(sequence(courses))

wall:rule("Row(number)", function(this, number)
  local bricks = {}
  for _ = 1, 14 do
    table.insert(bricks, Brick())
  end
  return Course(number), sequence(bricks)
end)
wall:rule("Brick", { weight = 6 }, "Red()")
wall:rule("Brick", { weight = 3 }, "Dark()")
wall:rule("Brick", { weight = 1 }, "Gap()")

local function draw(color: string)
  return function(this: Extruder)
    this:color(mix(color, "#000000", random(0, 0.2))):extrude(0.24):advance(0.012)
  end
end
wall:interpret("Course(number)", function(this, number)
  local start = if number % 2 == 0 then 0 else 0.126
  this:jump({ start, 0, 0.036 + number * 0.084 }):direction({ 1, 0, 0 }, { 0, 0, 1 }):rectangle(0.115, 0.072)
end)
wall:interpret("Red", draw("#b5583c"))
wall:interpret("Dark", draw("#6e4640"))
wall:interpret("Gap", function(this)
  this:advance(0.252)
end)

wall:derive(2)
