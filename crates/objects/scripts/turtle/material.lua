-- A stem of polished metal.
local Stem = module("Stem")
local stem = lsystem({ object = turtle() })
stem:axiom(Stem())
stem:interpret("Stem", function(this)
  this:material({ color = "#b08d57", metallic = 1, roughness = 0.2 }):forward(2)
end)
stem:derive()
