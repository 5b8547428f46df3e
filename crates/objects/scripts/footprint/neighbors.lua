-- Two adjoining houses: a rule reads the number of neighbours, the shared fraction of an edge, and a distance.
local House = module("House", "height")
local row = lsystem({ object = footprint })
local houses = source({
  { id = "one", geometry = polygon({ 0, 0 }, { 6, 0 }, { 6, 8 }, { 0, 8 }) },
  { id = "two", geometry = polygon({ 6, 0 }, { 12, 0 }, { 12, 8 }, { 6, 8 }) },
})
row:axiom(houses, function(feature)
  return footprint(feature.geometry), House(5)
end)
row:rule("House(height)", function(this, height)
  print(this:neighbors(), this:shared(2), this:distance(vec(20, 0, 0)))
  return House(height + this:neighbors())
end)
row:interpret("House(height)", function(this, height)
  this:walls({ height = height })
end)
row:derive(1)
