-- Contexts consider only signals and waits, and skip all other modules.
local Signal, Wait = module("Signal"), module("Wait")
local row = lsystem({ object = turtle() })
row:axiom(Signal(), Turn(5), F(1), Wait())
row:consider("Signal", "Wait")
row:rule("Signal < Wait", function()
  return F(3)
end)
row:derive(1)
