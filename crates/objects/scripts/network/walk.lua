-- A street that turns along its way, and a second street from the start of the first.
local Walk = module("Walk")
local roads = lsystem({ object = network({}) })
roads:axiom(Walk())
roads:interpret("Walk", function(this)
  this:move_to(1, 0):walk(60):turn(20):walk(60)
  this:grow_to(1, vec(0, 80, 0), 1)
end)
roads:derive()
