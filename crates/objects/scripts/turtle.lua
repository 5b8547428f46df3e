local Apex = module("Apex", "length")
local bush = lsystem({ object = turtle({ angle = 25, width = 0.05 }) })
bush:axiom(Apex(1))
bush:rule("Apex(length)", function(this, length: number)
  return F(length), { Turn(), Apex(length / 2) }, { Turn(-25), Apex(length / 2) }
end)
bush:derive(4)
