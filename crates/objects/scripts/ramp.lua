-- The length of an internode by its age: slow, fast, slow.
local growth = ramp({ { 0, 0.1 }, { 4, 0.3 }, { 8, 0.9 }, { 12, 1 } })
local Internode = module("Internode", "age")
local stems = lsystem({ object = turtle({ width = 0.06, color = "#7fa650" }) })
stems:axiom(Internode(1), Internode(5), Internode(9), Internode(20))
stems:interpret("Internode(age)", function(this, age)
  this:forward(growth:at(age)):turn(8)
end)
stems:derive()
