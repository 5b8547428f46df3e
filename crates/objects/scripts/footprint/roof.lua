-- flat, shed, gable, hip, gambrel, mansard, dutch_hip and pagoda, from the front left to the back right.
local House = module("House", "kind")
local plots = {}
for number, kind in { "flat", "shed", "gable", "hip", "gambrel", "mansard", "dutch_hip", "pagoda" } do
  local x, y = number % 4 * 16, number // 4 * -14
  local plan = { { x, y }, { x + 11, y }, { x + 11, y + 8 }, { x, y + 8 } }
  table.insert(plots, { id = kind, plan = plan })
end
local houses = lsystem({ object = footprint })
houses:axiom(source(plots), function(plot)
  return footprint(plot.plan), House(plot.id)
end)
houses:interpret("House(kind)", function(this, kind)
  this:walls({ height = 4 }):roof({ kind = kind, height = 4, color = "orange" })
end)
houses:derive()
