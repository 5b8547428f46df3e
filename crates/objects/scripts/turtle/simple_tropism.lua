-- The simple tropism of cpfg: upwards with an increasing strength, and towards y.
local Limb = module("Limb", "x")
local parts = lsystem({
  object = turtle({
    width = 0.15,
    simple_tropism = { 0, 0, 1 },
    simple_elasticity = 0.05,
    simple_increment = 0.05,
  }),
})
parts:axiom({ Limb(0) }, { Limb(3) })
parts:interpret("Limb(x)", function(this, x)
  this:jump({ x, 0, 0 }):face({ 1, 0, 0 })
  if x > 0 then
    this:simple_tropism({ 0, 1, 0 }, 0.2)
  end
  for _ = 1, 8 do
    this:forward(0.3):simple_elasticity()
  end
end)
parts:derive()
