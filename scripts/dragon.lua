--!strict
-- The dragon curve: a strip of paper, folded in half repeatedly in the same direction, and opened until every fold is
-- a right angle. A wall that rises along the strip draws it, with each fold rounded to an arc.
local folds =
  param("folds", { default = 11, min = 1, max = 14, step = 1, doc = "How often the strip is folded" })
local angle = param(
  "angle",
  { default = 90, min = 60, max = 120, unit = "deg", doc = "Of a fold; 90 never crosses itself" }
)
local height =
  param("height", { default = 3, min = 0.5, max = 20, unit = "m", doc = "Of the wall where it ends" })
local thickness =
  param("thickness", { default = 0.34, min = 0.05, max = 0.4, unit = "m", doc = "Of the wall" })

local Strip = module("Strip", "n", "side", "from", "to") -- n folds remain; from 0 to 1 along the strip
local Fold = module("Fold", "side", "at")

local COLORS = 40
local stops = { "#20264d", "#3d4f8f", "#2f8f8a", "#8fc06a", "#f2d272", "#ee8a4f", "#c8384f" }
local function color(t: number)
  local place = t * (#stops - 1)
  local k = math.min(math.floor(place), #stops - 2)
  return mix(stops[k + 1], stops[k + 2], place - k)
end

local dragon = lsystem({
  object = extruder({
    -- The path is level, so the y axis of the section points down.
    heading = { 0, 1, 0 },
    shape = { { -thickness / 2, -1 }, { thickness / 2, -1 }, { thickness / 2, 0 }, { -thickness / 2, 0 } },
    along = 5,
    roughness = 0.6,
  }),
  interpret = "last",
})

dragon:axiom(Strip(folds, 1, 0, 1))

-- Both halves of a strip are folded like the whole, but the second half is seen from behind.
dragon:rule("Strip(n, side, from, to)", function(this, n: number, side, from, to)
  if n == 0 then
    return nil
  end
  local middle = (from + to) / 2
  return Strip(n - 1, 1, from, middle), Fold(side, middle), Strip(n - 1, -1, middle, to)
end)

-- An arc between the centres of two edges of 1 m.
dragon:interpret("Fold(side, at)", function(this, side, at)
  local radius = 0.5 / math.tan(math.rad(angle / 2))
  local rise = lerp(0.5, height, at)
  this:bend(angle, if side > 0 then 0 else 180)
  this:color(color(math.floor(at * COLORS) / COLORS))
  this:taper(1, rise)
  this:extrude(radius * math.rad(angle))
end)

dragon:derive()
