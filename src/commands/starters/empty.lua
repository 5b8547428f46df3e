--!strict
-- One module, one rule and one interpretation.
local steps = param("steps", { default = 6, min = 0, max = 12, step = 1 })

local Part = module("Part", "length")

local system = lsystem({ object = turtle() })

system:axiom(Part(1))

-- In each step, a part becomes a piece of branch and a smaller part.
system:rule("Part(length)", function(this, length: number)
  return F(length), Turn(20), Part(length * 0.8)
end)

-- The last part.
system:interpret("Part(length)", function(this, length)
  this:sphere(0.1)
end)

system:derive(steps)
