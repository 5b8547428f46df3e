-- A block of streets: its streets and junctions, its block, and lots, sites and trees next to the streets.
local Ring = module("Ring")
local roads = lsystem({ object = network({ streets = { { trees = 10, lamps = 25 } } }) })
roads:axiom(Ring())
roads:interpret("Ring", function(this)
  this:move_to(1, 0):walk(90):turn(90):walk(90):turn(90):walk(90):turn(90):walk(90)
end)
local town = roads:derive().objects[1]
print(town:size(), #town:streets(), #town:junctions(), #town:blocks(), town:measures().length)
print(town:face(1, 0).area, town:measures().density)
print(#town:lots({ depth = 25 }), #town:sites(), #town:verge("tree"))
print(town:distance(vec(20, 30, 0)), town:height(vec(20, 30, 0)))
