-- Each twig is drawn like the one that carries it, at two thirds of its size.
local Twig, Smaller = module("Twig", "left"), module("Smaller")
local twigs = lsystem({ object = turtle({ width = 0.2, color = "#7a6248" }) })
twigs:axiom(Twig(7))
twigs:interpret("Twig(left)", function(this, left)
  this:forward(1)
  if left > 0 then
    return { Turn(40), Smaller(), Twig(left - 1) }, { Turn(-25), Smaller(), Twig(left - 1) }
  end
end)
twigs:interpret("Smaller", function(this)
  this:scale(2 / 3)
end)
twigs:derive()
