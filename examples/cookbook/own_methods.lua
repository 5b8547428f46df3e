--!strict
-- An own vocabulary: `extend` adds methods to the extruder, and the interpretations read like a plan.
extend(extruder, {
  changes = {
    -- A block with a chamfered top.
    block = function(self, width: number, height: number, color: string)
      self:color(color):rectangle(width, width):scale(1):extrude(height * 0.9)
      return self:taper(0.86):extrude(height * 0.1)
    end,
    -- A lathe: a list of radii at equal heights.
    turned = function(self, height: number, radii: { number })
      self:regular(40)
      for number = 1, #radii - 1 do
        self:scale(radii[number]):taper(radii[number + 1]):extrude(height / (#radii - 1))
      end
      return self
    end,
  },
})

local Square, Pawn, King =
  module("Square", "x", "y"), module("Pawn", "x", "y", "color"), module("King", "x", "y", "color")

local board = lsystem({ object = extruder({ roughness = 0.3 }) })
local modules: { any } = {}
for x = 0, 3 do
  for y = 0, 3 do
    table.insert(modules, { Square(x, y) })
  end
  table.insert(modules, { Pawn(x, 1, "#e9dcc0") })
  table.insert(modules, { Pawn(x, 3, "#4a332a") })
end
table.insert(modules, { King(1, 0, "#e9dcc0") })
table.insert(modules, { King(2, 2, "#4a332a") })
board:axiom(sequence(modules))

board:interpret("Square(x, y)", function(this, x, y)
  this:jump({ x, y, 0 }):block(0.98, 0.2, if (x + y) % 2 == 0 then "#7a5138" else "#d9b98a")
end)
board:interpret("Pawn(x, y, color)", function(this, x, y, color)
  this
    :jump({ x, y, 0.2 })
    :color(color)
    :turned(0.55, { 0.3, 0.3, 0.2, 0.12, 0.1, 0.1, 0.17, 0.09, 0.17, 0.2, 0.17, 0.04 })
end)
board:interpret("King(x, y, color)", function(this, x, y, color)
  this
    :jump({ x, y, 0.2 })
    :color(color)
    :turned(1, { 0.34, 0.34, 0.24, 0.15, 0.12, 0.11, 0.11, 0.13, 0.24, 0.13, 0.2, 0.24, 0.1 })
  -- The scale of the last piece stays until the next one sets it.
  this:scale(1):rectangle(0.07, 0.07):extrude(0.25):advance(-0.12):rectangle(0.2, 0.07):extrude(0.07)
end)
board:derive()
