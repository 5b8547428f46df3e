-- Shoots branch at random times: each is as long as the time that it grew, up to 6 days.
local Tip, Shoot = module("Tip", "born"), module("Shoot", "length")
local plant = lsystem({ object = turtle({ width = 0.08, sides = 8, color = "#6f9a4a" }) })
plant:axiom(Tip(0))
plant:rule("Tip(born)", { propensity = 0.5 }, function(this, born)
  local first, second = { Turn(25), Tip(time()) }, { Turn(-25), Roll(90), Tip(time()) }
  return Shoot(time() - born), first, second
end)
plant:interpret("Shoot(length)", function(this, length)
  this:forward(length)
end)
plant:interpret("Tip(born)", function(this, born)
  this:forward(time() - born)
end)
plant:derive({ time = 6 })
