--!strict
-- Profiles of cornices, and what stands below them. A cornice takes a horizontal face and goes around its outline; dentils and
-- brackets take an upright face and stand along its upper edge.
local outlines = require("./outlines")
local cornices = {}

-- With types, since those of required files are unknown.
local make_box: (face: Shape, x: { number }, y: { number }, z: { number }) -> Shape = outlines.box
local sweep_across: (face: Shape, profile: any, x: number, width: number) -> Shape = outlines.across

local CORNICE = {
  profile = "classical", -- see `cornices.profile`
  height = 0.5,
  depth = 0.45, -- projection
  inside = 0.2, -- depth behind the outline
  color = "#e2dac6",
}
local DENTILS = {
  width = 0.12,
  height = 0.16,
  depth = 0.14,
  spacing = 0.24, -- between the middles
  color = "#e2dac6",
}
local BRACKETS = {
  width = 0.18,
  height = 0.5,
  depth = 0.45,
  spacing = 1.2,
  color = "#e2dac6",
}

-- Outlines of profiles from the bottom to the top, as shares of the depth and of the height.
local PROFILES: { [string]: { { number } } } = {
  fillet = { { 1, 0 }, { 1, 1 } },
  slope = { { 1, 0 }, { 1, 0.35 }, { 0, 1 } },
  cavetto = { { 0.12, 0 }, { 0.18, 0.3 }, { 0.36, 0.6 }, { 0.68, 0.82 }, { 1, 0.88 }, { 1, 1 } },
  ovolo = { { 0.1, 0 }, { 0.1, 0.12 }, { 0.5, 0.2 }, { 0.82, 0.42 }, { 0.94, 0.7 }, { 1, 0.86 }, { 1, 1 } },
  cyma = {
    { 0, 0 },
    { 0.22, 0.06 },
    { 0.42, 0.2 },
    { 0.5, 0.42 },
    { 0.58, 0.66 },
    { 0.78, 0.84 },
    { 1, 0.9 },
    { 1, 1 },
  },
  classical = {
    { 0.08, 0 },
    { 0.08, 0.14 },
    { 0.2, 0.18 },
    { 0.34, 0.32 },
    { 0.36, 0.38 },
    { 0.74, 0.38 },
    { 0.74, 0.6 },
    { 0.8, 0.64 },
    { 0.84, 0.78 },
    { 0.98, 0.9 },
    { 1, 0.92 },
    { 1, 1 },
  },
  plinth = { { 1, 0 }, { 1, 0.7 }, { 0.6, 0.84 }, { 0.4, 1 } },
  string = { { 0.3, 0 }, { 0.7, 0.12 }, { 1, 0.4 }, { 1, 0.7 }, { 0.2, 1 } },
}

-- Returns the closed profile of a name for `molding`: "fillet", "slope", "cavetto", "ovolo", "cyma", "classical", "plinth" or
-- "string".
function cornices.profile(name: string, height: number, depth: number, inside: number): { any }
  local shares = PROFILES[name]
  if not shares then
    local names = {}
    for known in PROFILES :: any do
      table.insert(names, known)
    end
    table.sort(names)
    error(`unknown profile {name}: use {table.concat(names, ", ")}`, 3)
  end
  local points: { any } = { { -inside, 0 } }
  for _, share in shares do
    table.insert(points, { share[1] * depth, share[2] * height })
  end
  table.insert(points, { -inside, height })
  return points
end

-- Returns a cornice with a named profile around a horizontal face, from its height upwards: options as in CORNICE.
function cornices.cornice(face: Shape, given: any?): { Shape }
  local options = outlines.options("cornices.cornice", CORNICE, given)
  outlines.require_slope("cornices.cornice", face, false)
  local profile = cornices.profile(options.profile, options.height, options.depth, options.inside)
  return { face:molding(profile):color(options.color) }
end

-- Returns boxes along the upper edge of an upright face, about `spacing` apart: options as in DENTILS.
function cornices.dentils(face: Shape, given: any?): { Shape }
  local options = outlines.options("cornices.dentils", DENTILS, given)
  outlines.require_slope("cornices.dentils", face, true)
  local size = face:size()
  outlines.require_room("cornices.dentils", "width", options.width, size.x)
  outlines.require_room("cornices.dentils", "height", options.height, size.y)
  local count = math.max(1, math.round((size.x - options.width) / options.spacing))
  local list: { Shape } = {}
  for number = 0, count do
    local x = (size.x - options.width) * number / count
    local box = make_box(
      face,
      { x, x + options.width },
      { size.y - options.height, size.y },
      { 0, options.depth }
    )
    table.insert(list, box:color(options.color))
  end
  return list
end

-- Returns scrolled brackets along the upper edge of an upright face: options as in BRACKETS.
function cornices.brackets(face: Shape, given: any?): { Shape }
  local options = outlines.options("cornices.brackets", BRACKETS, given)
  outlines.require_slope("cornices.brackets", face, true)
  local size, width, d, h = face:size(), options.width, options.depth, options.height
  outlines.require_room("cornices.brackets", "width", width, size.x)
  outlines.require_room("cornices.brackets", "height", h, size.y)
  local profile: { any } = { { 0, size.y - h }, { d * 0.24, size.y - h } }
  for step = 1, 6 do
    local t = step / 6
    table.insert(profile, { d * (0.24 + 0.76 * t ^ 2), size.y - h + h * 0.8 * (1 - (1 - t) ^ 2) })
  end
  table.insert(profile, { d, size.y })
  table.insert(profile, { 0, size.y })
  local count = math.max(1, math.round((size.x - width) / options.spacing))
  local list: { Shape } = {}
  for number = 0, count do
    local x = (size.x - width) * number / count
    table.insert(list, sweep_across(face, profile, x, width):color(options.color))
  end
  return list
end

return cornices
