--!strict
-- A type that inherits from a footprint: a house whose walls show their timber frame, drawn by a child extruder.

local timbered = object("timbered", {
  doc = "A house with a timber frame: plastered walls, and posts, rails and braces in front of them.",
  extends = footprint,
  fields = {
    beam = { default = 0.18, min = 0.08, max = 0.4, unit = "m", doc = "Width of a beam." },
    bay = { default = 1.5, min = 0.6, max = 4, unit = "m", doc = "Distance of the posts, about." },
    timber = { default = "#4a2f1d", doc = "Colour of the beams." },
  },
  state = { raised = 0, beams = 0, frame = extruder() },
  reads = {
    beams = {
      doc = "How many beams it has.",
      function(self)
        return self.beams
      end,
    },
  },
  begin = function(self)
    self.frame:material({ color = self.timber, roughness = 0.9 })
  end,
  changes = {
    beam_between = {
      doc = "Draws a beam from one place to another (m) on a wall that faces `out`.",
      function(self, from, to, out)
        local way = vec(to) - vec(from)
        if way:length() > 0.01 then
          self.frame:jump(from):direction(way, out):rectangle(self.beam, self.beam):extrude(way:length())
          self.beams += 1
        end
      end,
    },
    storey = {
      doc = "Raises a storey by `height` (m) and frames its walls.",
      function(self, height: number)
        self:walls({ height = height, color = "#ece3cf" })
        local low = self:highest() + self.raised + self.beam / 2
        local high = low + height - self.beam
        for edge = 1, self:edges() do
          if self:edge_has(edge, "blind") then
            continue
          end
          local facing = math.rad(self:edge_facing(edge))
          local out = vec(math.cos(facing), math.sin(facing), 0)
          local along = vec(-math.sin(facing), math.cos(facing), 0)
          local length = self:edge_length(edge)
          local start = vec(self:edge_start(edge)) + out * (self.beam * 0.15)
          local function at(way: number, z: number)
            local place = start + along * way
            return vec(place.x, place.y, z)
          end
          local bays = math.max(1, math.round(length / self.bay))
          self:beam_between(at(0, low), at(length, low), out)
          self:beam_between(at(0, high), at(length, high), out)
          local inset = self.beam / 2
          for post = 0, bays do
            local way = inset + (length - self.beam) * post / bays
            self:beam_between(at(way, low), at(way, high), out)
          end
          -- The bays at the corners have a brace, the others a rail at sill height.
          for bay = 1, bays do
            local left = inset + (length - self.beam) * (bay - 1) / bays
            local right = inset + (length - self.beam) * bay / bays
            if bay == 1 or bay == bays then
              local foot, head = if bay == 1 then left else right, if bay == 1 then right else left
              self:beam_between(at(head, low), at(foot, high), out)
            else
              local sill = low + height * 0.36
              self:beam_between(at(left, sill), at(right, sill), out)
            end
          end
        end
        self.raised += height
      end,
    },
  },
})

local storeys = param("storeys", { default = 2, min = 1, max = 4, step = 1 })

local House = module("House", "storeys")
local Storey = module("Storey", "height")
local Top = module("Top")

local plan = { { 0, 0 }, { 9, 0 }, { 9, 4 }, { 6, 4 }, { 6, 7.5 }, { 0, 7.5 } }
local house = lsystem({ object = timbered(plan, { color = "#6b4a35" }) })
house:axiom(House(storeys))
house:rule("House(n)", function(this, n)
  if n == 0 then
    return Top()
  end
  return Storey(2.7), House(n - 1)
end)
house:interpret("Storey(height)", function(this, height)
  this:storey(height)
end)
house:interpret("Top", function(this)
  this:roof({ kind = "gable", slope = 48, overhang = 0.45, color = "#8b3f2a" })
end)
house:derive()

return timbered
