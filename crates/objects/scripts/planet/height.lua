-- The ground in a direction from the centre of the planet, and a near view of it.
local View = module("View")
local hills = { A = { "A", "A", "A", "A", change = { 1, -1, 0.5, -0.5 }, decay = 0.5 } }
local globe = lsystem({ object = planet({ radius = 1738000, levels = 8, rules = hills }) })
globe:axiom(View())
globe:rule("View", function(this)
  local east = vec(1, 0, 0)
  print(this:height(east), this:surface(east), this:symbol(east), this:heights())
  return View()
end)
globe:interpret("View", function(this)
  this:focus(1800000, 0, 0)
end)
globe:derive(1)
