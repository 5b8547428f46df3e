-- A street of poles, seen by a person who stands on it.
camera({ name = "street", from = { 2, -6, 1.7 }, to = { 0, 20, 2.5 }, fov = 55 })
camera({ name = "map", view = "plan" })
local poles = lsystem({ object = turtle({ width = 0.2 }) })
local chain = {}
for number = 1, 10 do
  chain[number] = { Place({ 0, number * 4, 0 }), F(4) }
end
poles:axiom(chain)
poles:derive()
