--!strict
-- Supports of walls and vaults: buttresses, flying buttresses, arcades and pinnacles.
local outlines = require("./outlines")
local openings = require("./openings")
local supports = {}

-- With types, since those of required files are unknown.
local make_box: (face: Shape, x: { number }, y: { number }, z: { number }) -> Shape = outlines.box
local sweep_across: (face: Shape, profile: any, x: number, width: number) -> Shape = outlines.across
local turn_profile: (profile: any, sides: number, flute: number?) -> Shape = outlines.turned

local BUTTRESS = {
  width = 0.8,
  height = 8,
  depth = 1.6, -- at the foot
  stages = 3, -- each less deep than the one below
  top = 0.45, -- depth of the uppermost stage as a share of the depth
  slope = 0.7, -- height of a weathered offset
  plinth = 0.5, -- height of the plinth; 0 for none
  color = "#d3c8b0",
}
local FLYER = {
  width = 0.6,
  reach = 5, -- from the wall to the pier
  height = 1.1, -- of the arch at its thinnest place
  foot = 4, -- height of the springing above the lower edge
  head = 8.5, -- height of the upper side at the wall
  drop = 2.4, -- descent of the upper side
  color = "#d3c8b0",
}
local PINNACLE = {
  height = 4,
  shaft = 0.38, -- share of the height without the spire
  crockets = 4, -- rows of knobs on the spire; 0 for none
  color = "#d3c8b0",
}
local ARCADE = {
  count = 3,
  kind = "round",
  width = 1.8, -- of an opening
  height = 3.2,
  depth = 0.5, -- of the wall
  imposts = true, -- slabs at the springing lines
  color = "#d3c8b0",
}

-- Returns a buttress before the middle of an upright face, with weathered offsets: options as in BUTTRESS.
function supports.buttress(face: Shape, given: any?): { Shape }
  local options = outlines.options("supports.buttress", BUTTRESS, given)
  outlines.require_slope("supports.buttress", face, true)
  local size, depth, height, stages = face:size(), options.depth, options.height, math.max(1, options.stages)
  outlines.require_room("supports.buttress", "width", options.width, size.x)
  outlines.require_room("supports.buttress", "height", height, size.y)
  if height < (stages + 1) * options.slope then
    error(
      `supports.buttress: {stages} stages need {(stages + 1) * options.slope} m: use a larger height or fewer stages`,
      2
    )
  end
  local profile: { any } = { { -0.05, 0 }, { depth, 0 } }
  local list: { Shape } = {}
  local last = depth * options.top
  for stage = 1, stages do
    local deep = if stages == 1 then depth else lerp(depth, last, (stage - 1) / (stages - 1))
    local next = if stage == stages then 0 else lerp(depth, last, stage / (stages - 1))
    -- Lower stages are higher.
    local top = height * (stage / stages) ^ 0.85
    local slope = math.min(options.slope * (deep - next) / (depth / stages), options.slope * 1.6)
    if stage == stages then
      slope = math.min(slope, height / stages * 0.8)
    end
    table.insert(profile, { deep + 0.06, top - slope - 0.12 })
    table.insert(profile, { deep + 0.06, top - slope })
    table.insert(profile, { math.max(next, 0), top })
    table.insert(profile, #profile - 2, { deep, top - slope - 0.2 })
  end
  profile[#profile][1] = -0.05
  local x = (size.x - options.width) / 2
  table.insert(list, sweep_across(face, profile, x, options.width):color(options.color))
  if options.plinth > 0 then
    local p = options.plinth
    local base =
      { { -0.04, 0 }, { depth + 0.12, 0 }, { depth + 0.12, p * 0.8 }, { depth + 0.02, p }, { -0.04, p } }
    table.insert(list, sweep_across(face, base, x - 0.1, options.width + 0.2):color(options.color))
  end
  return list
end

-- Returns a flying buttress from the middle of an upright face to a pier: options as in FLYER.
function supports.flyer(face: Shape, given: any?): { Shape }
  local options = outlines.options("supports.flyer", FLYER, given)
  outlines.require_slope("supports.flyer", face, true)
  local size, reach = face:size(), options.reach
  outlines.require_room("supports.flyer", "width", options.width, size.x)
  outlines.require_room("supports.flyer", "head", options.head, size.y)
  local crown = options.head - options.height - options.drop * 0.25
  if crown <= options.foot then
    error(`supports.flyer: foot is {options.foot}: use less than {crown} m, or a larger head`, 2)
  end
  -- The lower side is a quarter of an ellipse that rises from the pier to the wall.
  local profile: { any } = { { -0.05, crown } }
  for step = 0, 12 do
    local angle = math.pi / 2 * step / 12
    table.insert(
      profile,
      { reach * math.sin(angle), options.foot + (crown - options.foot) * math.cos(angle) }
    )
  end
  table.insert(profile, { reach + 0.05, options.foot })
  table.insert(profile, { reach + 0.05, options.head - options.drop })
  table.insert(profile, { -0.05, options.head })
  local x = (size.x - options.width) / 2
  local coping = {
    { 0, options.head },
    { reach, options.head - options.drop },
    { reach, options.head - options.drop + 0.18 },
    { 0, options.head + 0.18 },
  }
  return {
    sweep_across(face, profile, x, options.width):color(options.color),
    sweep_across(face, coping, x - 0.08, options.width + 0.16):color(options.color),
  }
end

-- Returns a pinnacle on a horizontal face: a shaft with four gables, and a spire with crockets and a finial: options as in
-- PINNACLE.
function supports.pinnacle(face: Shape, given: any?): { Shape }
  local options = outlines.options("supports.pinnacle", PINNACLE, given)
  outlines.require_slope("supports.pinnacle", face, false)
  local size, height = face:size(), options.height
  local side = math.min(size.x, size.y)
  local shaft = height * options.shaft
  local list: { Shape } =
    { face:extrude(shaft), face:offset(0.05)[1]:translate(vec(0, 0, shaft - 0.12)):extrude(0.12) }
  local middle = face:center()
  -- A gable in front of each side, which crosses the opposite one.
  local gable = side * 0.75
  for turn = 0, 1 do
    local along = if turn == 0 then face:x_axis() else face:y_axis()
    local across = if turn == 0 then face:y_axis() else face:x_axis()
    local half = side / 2 + 0.06
    local low = middle + vec(0, 0, shaft)
    local ring = {
      low - across * half - along * half,
      low + across * half - along * half,
      low - along * half + vec(0, 0, gable),
    }
    local solid =
      shape({ points = ring, faces = { if turn == 0 then { 3, 2, 1 } else { 1, 2, 3 } } }):extrude(-2 * half)
    table.insert(list, if solid:volume() < 0 then solid:reverse() else solid)
  end
  local spire = height - shaft
  local base = face:offset(-side * 0.08)[1]:translate(vec(0, 0, shaft))
  table.insert(list, base:taper(spire - side * 0.3, 0.06))
  for row = 1, options.crockets do
    local t = (row + 0.6) / (options.crockets + 1.4)
    local half = side * 0.42 * (1 - t * 0.94)
    local knob = math.max(side * 0.09 * (1 - t * 0.5), 0.02)
    for corner = 0, 3 do
      local x, y = if corner % 3 == 0 then half else -half, if corner < 2 then half else -half
      local at = middle + face:x_axis() * x + face:y_axis() * y + vec(0, 0, shaft + (spire - side * 0.3) * t)
      table.insert(list, cuboid(knob, knob, knob):translate(at - vec(knob / 2, knob / 2, knob / 2)))
    end
  end
  local top = middle + vec(0, 0, height - side * 0.34)
  local knob = side * 0.16
  local finial = {
    { knob * 0.3, -knob },
    { knob * 0.4, 0 },
    { knob, knob * 0.5 },
    { knob * 0.4, knob },
    { knob * 0.3, knob * 1.4 },
    { knob * 0.7, knob * 1.7 },
    { 0, knob * 2.3 },
  }
  table.insert(list, turn_profile(finial, 8):translate(top))
  for at, part in list do
    list[at] = part:color(options.color)
  end
  return list
end

-- Returns a wall with a row of arched openings instead of the face, `depth` thick behind it: options as in ARCADE.
function supports.arcade(face: Shape, given: any?): { Shape }
  local options = outlines.options("supports.arcade", ARCADE, given)
  outlines.require_slope("supports.arcade", face, true)
  local size, count, width = face:size(), options.count, options.width
  outlines.require_room("supports.arcade", "width", count * (width + 0.2), size.x)
  outlines.require_room("supports.arcade", "height", options.height + 0.05, size.y)
  local step = size.x / count
  local holes: { any } = {}
  local list: { Shape } = {}
  local spring = options.height - outlines.rise(options.kind, width)
  for number = 1, count do
    local x = step * (number - 0.5) - width / 2
    holes[number] = outlines.move(outlines.arch(options.kind, width, options.height), x, 0)
    if options.imposts and spring > 0.3 then
      for side = 0, 1 do
        local at = if side == 0 then x - (step - width) / 2 else x + width
        local box = make_box(
          face,
          { at - 0.04 * side + 0.001, at + (step - width) / 2 + 0.04 * (1 - side) - 0.001 },
          { spring - 0.18, spring },
          { -options.depth - 0.04, 0.05 }
        )
        table.insert(list, box:color(options.color))
      end
    end
  end
  local pierced: Shape = openings.wall(face, holes)
  table.insert(list, pierced:extrude(-options.depth):color(options.color))
  return list
end

return supports
