-- Four twigs: the stem rolls by 120 degrees, by 120 degrees again, and back by 60.
local stem = lsystem({ object = turtle({ step = 1 }) })
local function twig()
  return { Turn(50), F() }
end
stem:axiom(F(), twig(), Roll(120), F(), twig(), RollLeft(120), F(), twig(), RollRight(60), F(), twig())
stem:derive()
