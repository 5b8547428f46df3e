--!strict
-- Four models from the same rules, as in figure 3 of the ML-System paper: recursion 1 at low and at high resolution
-- in the back, recursion 2 and 3 in front. An arm is a row of segments, each with its own length, curvature, twist
-- and scale. Each further level of recursion adds arms to the segments.
local segments = param("segments", { default = 14, min = 5, max = 18, step = 1, doc = "Segments of an arm" })
local curl =
  param("curl", { default = 58, min = 0, max = 80, unit = "deg", doc = "Bend of the last segment" })
local arms = param("arms", { default = 3, min = 1, max = 5, step = 1, doc = "Arms that a segment bears" })
local lobes = param("lobes", { default = 5, min = 3, max = 9, step = 1, doc = "Lobes of the cross-section" })

local TAPER = 0.86 -- from one segment to the next

local Arm = module("Arm", "n", "radius", "level", "fineness") -- n segments remain
local Section = module("Section", "fineness")
local Segment = module("Segment", "radius", "curvature")
local Tip = module("Tip", "radius")
local Leave = module("Leave", "angle", "radius") -- turns to the start of a side arm

-- Fineness is the number of pieces per segment and of points per lobe.
local models = source({
  { id = "recursion 1, low", recursion = 1, fineness = 2, color = "#c8553d", place = { -8, 2.8, 0 } },
  { id = "recursion 1, high", recursion = 1, fineness = 10, color = "#e3a03b", place = { 2.6, 2.8, 0 } },
  { id = "recursion 2, high", recursion = 2, fineness = 10, color = "#3f8f8c", place = { -2.6, -2.8, 0 } },
  { id = "recursion 3, high", recursion = 3, fineness = 10, color = "#7f5aa8", place = { 8, -2.8, 0 } },
})

local sweeps = lsystem({ object = extruder({}), interpret = "last" })

-- Each model has its own extruder, so the four models grow in parallel.
sweeps:axiom(models, function(model)
  local fineness = model.fineness
  local body =
    extruder({ color = model.color, position = model.place, smooth = fineness > 2, roughness = 0.5 })
  return body, Section(fineness), Arm(segments, 1.15, model.recursion, fineness)
end)

-- A segment has a ring of arms at its end; the foot and the tip have none.
sweeps:rule(
  "Arm(n, r, level, fineness)",
  function(this, n: number, r: number, level: number, fineness: number)
    if n == 0 then
      return Tip(r)
    end
    local along = 1 - n / segments
    local parts = { Segment(r, lerp(6, curl, ease.smooth(along))) }
    if level > 1 and n > segments / 3 and n < segments then
      local finer = math.max(math.floor(fineness / 2), 2)
      for k = 1, arms do
        local side = Arm(segments - 3, r * 0.36, level - 1, finer)
        table.insert(parts, { Leave((k + n / 2) * 360 / arms, r), Section(finer), side })
      end
    end
    table.insert(parts, Arm(n - 1, r * TAPER, level, fineness))
    return table.unpack(parts)
  end
)

-- The cross-section: a circle with lobes.
sweeps:interpret("Section(fineness)", function(this, fineness)
  local outline = {}
  for k = 0, lobes * fineness - 1 do
    local angle = k / (lobes * fineness) * 2 * math.pi
    local radius = 0.82 + 0.18 * math.cos(lobes * angle)
    table.insert(outline, { radius * math.cos(angle), radius * math.sin(angle) })
  end
  this:resolution(fineness, 0)
  this:polygon(outline)
end)

sweeps:interpret("Segment(r, bend)", function(this, r, bend)
  this:scale(r):taper(r * TAPER):twist(9):bend(bend, 180):extrude(r * 1.5)
end)

sweeps:interpret("Tip(r)", function(this, r)
  this:taper(r * 0.1):extrude(r * 1.5)
end)

sweeps:interpret("Leave(angle, r)", function(this, angle, r)
  this:roll(angle):pitch(65):advance(r * 0.3)
end)

sweeps:derive()
