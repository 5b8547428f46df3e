-- Houses report their floor areas (m²): burgeon run report.lua -o areas.csv has a row for each.
local House, Storey = module("House", "levels"), module("Storey", "height")
local houses = lsystem({ object = footprint })
local plots = {
  { id = "mill", levels = 2, outline = { { 0, 0 }, { 12, 0 }, { 12, 8 }, { 0, 8 } } },
  { id = "barn", levels = 1, outline = { { 20, 0 }, { 30, 0 }, { 30, 15 }, { 20, 15 } } },
}
houses:axiom(source(plots), function(feature)
  return footprint(feature.outline), House(feature.levels)
end)
houses:rule("House(levels)", function(this, levels)
  if levels > 0 then
    return Storey(3), House(levels - 1)
  end
end)
houses:interpret("Storey(height)", function(this, height)
  report("floor area", this:area())
  report("storeys", 1)
  this:walls({ height = height })
end)
houses:derive()
