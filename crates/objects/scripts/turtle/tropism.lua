-- Tropism towards y, with an elasticity of 0, 0.1 and 0.3.
local Part = module("Part")
local parts = lsystem({ object = turtle({ width = 0.15 }) })
parts:axiom(Part())
parts:interpret("Part", function(this)
  for number, elasticity in { 0, 0.1, 0.3 } do
    this:jump({ 1.5 * number, 0, 0 }):face({ 0, 0.3, 1 })
    this:tropism({ 0, 1, 0 }, elasticity)
    for _ = 1, 8 do
      this:forward(0.3)
    end
  end
end)
parts:derive()
