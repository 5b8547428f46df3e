-- The results of a derivation.
local line = lsystem({ object = turtle() })
line:axiom(F())
line:rule("F", function()
  return F(), F()
end)
local derived = line:derive(2)
print(derived.steps, derived.modules, derived.chains[1], derived.objects[1]:position())
print(#derived:chain(), derived:chain()[1].name)
