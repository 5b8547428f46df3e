-- Fine leaves only at full detail.
local leaves = if lod >= 3 then 5 else 1
local bush = lsystem({ object = turtle() })
local chain = {}
for number = 1, leaves do
  chain[number] = { Turn(number * 360 / leaves), F(1) }
end
bush:axiom(sequence(chain))
bush:derive()
