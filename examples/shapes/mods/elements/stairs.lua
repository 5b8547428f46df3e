--!strict
-- Stairs on a horizontal face, their plan. They begin at its front edge (y = 0) and rise along y of its scope.
local outlines = require("./outlines")
local stairs = {}

local STAIR = {
  height = 3, -- of the whole stair
  rise = 0.17, -- of one step, nearly; steps are equal
  thickness = 0.2, -- of the slab below the steps; 0 for steps that stand on the ground
  color = "#cfc8b8",
}
local LANDING = {
  height = 3,
  rise = 0.17,
  landing = 1.2, -- length of the landing in the middle
  thickness = 0.2,
  color = "#cfc8b8",
}
local SPIRAL = {
  height = 3,
  rise = 0.18,
  turns = 1,
  newel = 0.1, -- radius of the post in the middle
  color = "#cfc8b8",
}
local RAMP = {
  height = 0.6,
  thickness = 0, -- 0 for a ramp that stands on the ground
  color = "#cfc8b8",
}
local PODIUM = {
  height = 0.9,
  rise = 0.15,
  run = 0.32, -- depth of a step
  color = "#cfc8b8",
}

-- Returns the number of steps for a height.
local function count_steps(height: number, rise: number): number
  return math.max(1, math.round(height / rise))
end

-- Returns the profile of a flight from { y, z } with `count` steps over `run`: { along, up } for `sweep`.
local function flight(
  y: number,
  z: number,
  count: number,
  run: number,
  rise: number,
  thickness: number
): { { number } }
  local tread = run / count
  local profile: { { number } } = { { y, z } }
  for step = 0, count - 1 do
    table.insert(profile, { y + step * tread, z + (step + 1) * rise })
    table.insert(profile, { y + (step + 1) * tread, z + (step + 1) * rise })
  end
  if thickness > 0 then
    -- The lower side is parallel to the line of the steps.
    table.insert(profile, { y + run, z + count * rise - rise - thickness })
    table.insert(profile, { y + tread, z - thickness })
    if z - thickness < 0 then
      profile[#profile] = { y + tread * (1 + thickness / rise), 0 }
    end
  else
    table.insert(profile, { y + run, 0 })
    profile[1] = { y, 0 }
  end
  return profile
end

-- Returns the solid of a profile { along y, up } over the whole width of a plan, from `x` on.
local function sweep(face: Shape, profile: { { number } }, x: number, width: number): Shape
  local corner = face:position() + face:x_axis() * x
  local points: { any }, ring: { number } = {}, {}
  for at, point in profile do
    points[at] = corner + face:y_axis() * point[1] + vec(0, 0, point[2])
    table.insert(ring, at)
  end
  -- The profile is clockwise in y and z, so its face looks against x; it is drawn along x from there.
  return shape({ points = points, faces = { ring } }):extrude(-width)
end

-- Refuses plans that are too small for steps.
local function check(owner: string, face: Shape, run: number, count: number)
  outlines.require_slope(owner, face, false)
  if run / count < 0.2 then
    error(
      `{owner}: {count} steps need {0.2 * count} m, but the run has {math.round(run * 100) / 100} m: `
        .. "use a longer face, a lower height or a larger rise",
      3
    )
  end
end

-- Returns a straight stair along the whole face: options as in STAIR.
function stairs.straight(face: Shape, given: any?): { Shape }
  local options = outlines.options("stairs.straight", STAIR, given)
  local size = face:size()
  local count = count_steps(options.height, options.rise)
  check("stairs.straight", face, size.y, count)
  local profile = flight(0, 0, count, size.y, options.height / count, options.thickness)
  return { sweep(face, profile, 0, size.x):color(options.color) }
end

-- Returns a stair of two flights with a landing between them: options as in LANDING.
function stairs.landing(face: Shape, given: any?): { Shape }
  local options = outlines.options("stairs.landing", LANDING, given)
  local size, thick = face:size(), options.thickness
  local count = 2 * math.max(1, math.round(count_steps(options.height, options.rise) / 2))
  local run = (size.y - options.landing) / 2
  check("stairs.landing", face, 2 * run, count)
  local rise, half = options.height / count, count / 2
  local level = half * rise
  local slab: { any } = {
    { run, level - math.max(thick, 0.12) },
    { run, level },
    { run + options.landing, level },
    { run + options.landing, level - math.max(thick, 0.12) },
  }
  if thick == 0 then
    slab[1][2], slab[4][2] = 0, 0
  end
  local list = {
    sweep(face, flight(0, 0, half, run, rise, thick), 0, size.x),
    sweep(face, slab, 0, size.x),
    sweep(face, flight(run + options.landing, level, half, run, rise, thick), 0, size.x),
  }
  for at, part in list do
    list[at] = part:color(options.color)
  end
  return list
end

-- Returns a spiral stair around a post in the middle of the face: options as in SPIRAL.
function stairs.spiral(face: Shape, given: any?): { Shape }
  local options = outlines.options("stairs.spiral", SPIRAL, given)
  outlines.require_slope("stairs.spiral", face, false)
  local size = face:size()
  local radius = math.min(size.x, size.y) / 2
  outlines.require_room("stairs.spiral", "post", 2 * options.newel + 1, 2 * radius)
  local count = count_steps(options.height, options.rise)
  local rise, angle = options.height / count, 2 * math.pi * options.turns / count
  if rise > 0.3 or radius * angle < 0.2 then
    error(`stairs.spiral: {count} steps do not fit: use fewer turns, a larger rise or a larger face`, 2)
  end
  local middle = face:center()
  local list = { cylinder(options.newel, options.height + 1, 16):translate(middle):color(options.color) }
  for step = 0, count - 1 do
    -- A step overlaps the next one by a nosing.
    local points: { any } = {}
    local from, to = angle * step, angle * (step + 1.15)
    for _, at in
      {
        { options.newel * 0.9, from },
        { radius, from },
        { radius, (from + to) / 2 },
        { radius, to },
        { options.newel * 0.9, to },
      }
    do
      table.insert(points, { middle.x + at[1] * math.cos(at[2]), middle.y + at[1] * math.sin(at[2]) })
    end
    local top = middle.z + rise * (step + 1)
    table.insert(
      list,
      shape({ points }, top - math.min(rise * 0.5, 0.08))
        :extrude(math.min(rise * 0.5, 0.08))
        :color(options.color)
    )
  end
  return list
end

-- Returns a ramp along the whole face: options as in RAMP.
function stairs.ramp(face: Shape, given: any?): { Shape }
  local options = outlines.options("stairs.ramp", RAMP, given)
  outlines.require_slope("stairs.ramp", face, false)
  local size = face:size()
  local profile = { { 0, 0 }, { size.y, options.height }, { size.y, 0 } }
  if options.thickness > 0 then
    local low = math.max(0, options.height - options.thickness)
    profile = {
      { 0, 0 },
      { size.y, options.height },
      { size.y, low },
      { size.y * math.min(1, options.thickness / options.height), 0 },
    }
  end
  return { sweep(face, profile, 0, size.x):color(options.color) }
end

-- Returns steps around all corners of a podium, whose upper side is the face raised by the height: options as in PODIUM.
function stairs.podium(face: Shape, given: any?): { Shape }
  local options = outlines.options("stairs.podium", PODIUM, given)
  outlines.require_slope("stairs.podium", face, false)
  local count = count_steps(options.height, options.rise)
  local rise = options.height / count
  local list: { Shape } = {}
  for step = 1, count do
    local wider = if step < count then face:offset(options.run * (count - step))[1] else face
    local slab = wider:translate(vec(0, 0, rise * (step - 1))):extrude(rise)
    table.insert(list, slab:color(options.color))
  end
  return list
end

return stairs
