--!strict
-- A type with child objects: a spiral stair draws its steps with one extruder, and its handrail with another one,
-- which continues from step to step while the first one jumps.

local stair = object("stair", {
  doc = "A spiral stair around a column.",
  extends = extruder,
  fields = {
    radius = {
      default = 1.3,
      min = 0.6,
      max = 5,
      unit = "m",
      doc = "From the axis to the ends of the steps.",
    },
    rise = { default = 0.18, min = 0.12, max = 0.22, unit = "m", doc = "Height of a step." },
    angle = { default = 24, min = 10, max = 45, unit = "degrees", doc = "Angle between two steps." },
    wood = { default = "#a9753f", doc = "Colour of the steps." },
    metal = { default = "#2c2f33", doc = "Colour of the column and the rail." },
  },
  state = {
    steps = 0,
    rail = extruder({ sides = 12, smooth = true }),
  },
  reads = {
    height = {
      doc = "How high it goes (m).",
      function(self)
        return self.steps * self.rise
      end,
    },
  },
  begin = function(self)
    self.rail:material({ color = self.metal, roughness = 0.4, metallic = 0.7 }):scale(0.022)
  end,
  changes = {
    handrail = {
      doc = "Goes on with the rail to a place (m).",
      function(self, to)
        local way = to - vec(self.rail:position())
        if self.steps == 0 then
          self.rail:jump(to)
        else
          self.rail:direction(way):extrude(way:length())
        end
      end,
    },
    step = {
      doc = "Adds a step, a post and a piece of the rail.",
      function(self)
        local inner, outer, half = 0.06, self.radius, math.rad(self.angle) * 0.56
        local height, angle = (self.steps + 1) * self.rise, math.rad(self.steps * self.angle)
        local wedge = { { inner * math.cos(angle - half), inner * math.sin(angle - half) } }
        for index = -3, 3 do
          local at = angle + half * index / 3
          table.insert(wedge, { outer * math.cos(at), outer * math.sin(at) })
        end
        table.insert(wedge, { inner * math.cos(angle + half), inner * math.sin(angle + half) })
        self:jump({ 0, 0, height - 0.045 })
        self
          :material({ color = self.wood, roughness = 0.55 })
          :scale(1)
          :smooth(false)
          :polygon(wedge)
          :extrude(0.045)

        local post = vec(math.cos(angle), math.sin(angle), 0) * (outer - 0.05)
        self:jump(post + vec(0, 0, height)):regular(10):smooth(true):scale(0.012)
        self:material({ color = self.metal, roughness = 0.4, metallic = 0.7 }):extrude(0.9)

        -- The rail follows the helix in short chords from the last post to this one.
        for piece = if self.steps == 0 then 0 else -4, 0 do
          local turned = angle + math.rad(self.angle) * piece / 5
          local hand = vec(math.cos(turned), math.sin(turned), 0) * (outer - 0.05)
          self:handrail(hand + vec(0, 0, height + 0.9 + self.rise * piece / 5))
        end
        self.steps += 1
      end,
    },
  },
  finish = function(self)
    local top = self.steps * self.rise
    self:jump({ 0, 0, 0 }):regular(24):smooth(true):scale(0.2)
    self:material({ color = self.metal, roughness = 0.4, metallic = 0.7 }):extrude(0.03)
    self:scale(0.06):extrude(top + 0.9):scale(0.09):extrude(0.05):scale(0.05):taper(0.004):extrude(0.06)
  end,
})

local storey =
  param("storey", { default = 3, min = 1, max = 12, unit = "m", doc = "How high the stair goes" })

local Step = module("Step")
local Climb = module("Climb")

local spiral = lsystem({ object = stair() })
spiral:axiom(Climb())
spiral:rule("Climb", function(this)
  if this:height() < storey - 0.001 then
    return Step(), Climb()
  end
  return nil
end)
spiral:interpret("Step", function(this)
  this:step()
end)
spiral:ignore("Climb")
spiral:derive()

return stair
