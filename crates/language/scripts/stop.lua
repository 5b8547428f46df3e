-- A plant grows until it has 40 leaves.
local Apex, Leaf = module("Apex"), module("Leaf")
local plant = lsystem({ object = turtle({ step = 0.5, width = 0.1 }) })
plant:axiom(Apex())
plant:rule("Apex", function()
  return F(), { Turn(40), Leaf() }, Roll(137.5), { Turn(25), Apex() }, Apex()
end)
plant:interpret("Leaf", function(this)
  this:color("#5b8a3a"):sphere(0.2)
end)
plant:after_step(function(now)
  if now.counts.Leaf >= 40 then
    stop()
  end
end)
plant:derive(20)
