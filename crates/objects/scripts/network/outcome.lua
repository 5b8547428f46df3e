-- A rule reads the outcome of a proposed street, and predicts the outcome of another street.
local Tip = module("Tip")
local roads = lsystem({ object = network({}) })
roads:axiom(Tip())
roads:rule("Tip", function(this)
  local junction = this:end_junction(1, 0)
  print(this:outcome(1, 0), junction, this:probe(1, 90, 60, 0).outcome)
  if junction then
    print(this:place(junction), this:degree(junction), #this:places())
  end
  return Tip()
end)
roads:interpret("Tip", function(this)
  this:grow(1, 0, 60, 0)
end)
roads:derive(1)
