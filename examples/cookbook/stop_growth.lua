--!strict
-- A shrub that stops as soon as it has 150 leaves or is 2.5 m high.
local Apex, Leaf = module("Apex"), module("Leaf")

local shrub = lsystem({ object = turtle({ width = 0.03, color = "#77583a" }) })

shrub:axiom({ Apex() }, { Roll(120), Turn(35), Apex() }, { Roll(240), Turn(35), Apex() })

shrub:rule("Apex", function(this)
  if this:position().z > 2.5 then
    return stop()
  end
  return F(random(0.25, 0.4)),
    { Turn(55), Leaf() },
    { Turn(-55), Leaf() },
    Roll(137.5),
    { Turn(random(20, 40)), Apex() },
    Turn(random(-20, 0)),
    Apex()
end)
shrub:after_step(function(now)
  if now.counts.Leaf >= 150 then
    stop()
  end
end)

shrub:interpret("Leaf", function(this)
  this:color("#6a9a45"):mesh(
    { { 0, 0, 0 }, { 0.06, 0.02, 0.1 }, { 0, 0, 0.24 }, { -0.06, 0.02, 0.1 } },
    { { 1, 2, 3, 4 }, { 4, 3, 2, 1 } }
  )
end)

local grown = shrub:derive(20)
print(`{grown.counts.Leaf} leaves after {grown.steps} steps`)
