--!strict
-- Outlines in the plane of a face, and solids from them. An outline is a list of { x, y } (m), counter-clockwise, measured
-- from the lower left corner of a face with x to the right, y upwards and z outwards.
local outlines = {}

-- Lengths that cannot be 0.
local POSITIVE = { "width", "height", "depth", "radius", "run", "reach", "spacing", "count", "turns" }

-- Returns `given` with `defaults` where it has no value; refuses unknown options and lengths that are not possible.
function outlines.options(owner: string, defaults: { [string]: any }, given: any?): any
  local options: { [string]: any } = {}
  for name, value in defaults :: any do
    options[name] = value
  end
  for name, value in (given or {}) :: any do
    local default = defaults[name]
    if default == nil then
      local names = {}
      for known in defaults :: any do
        table.insert(names, known)
      end
      table.sort(names)
      error(`{owner} has no option {name}: use {table.concat(names, ", ")}`, 3)
    elseif type(value) ~= type(default) or value ~= value then
      error(`{owner}: {name} is {tostring(value)}: use a {type(default)}`, 3)
    elseif type(default) == "number" and value <= 0 and table.find(POSITIVE, name) then
      error(`{owner}: {name} is {value}: use a number above 0`, 3)
    elseif type(default) == "number" and value < 0 then
      error(`{owner}: {name} is {value}: use 0 or more`, 3)
    end
    options[name] = value
  end
  return options
end

-- Refuses a part that needs more than a face has, with the remedy.
function outlines.require_room(owner: string, what: string, needed: number, available: number)
  if needed > available + 1e-6 then
    error(
      `{owner}: the {what} is {math.round(needed * 100) / 100} m, but the face has {math.round(
        available * 100
      ) / 100} m: ` .. `use a smaller {what} or a larger face`,
      3
    )
  end
end

-- Refuses faces that are not upright, or not horizontal.
function outlines.require_slope(owner: string, face: Shape, upright: boolean)
  local slope = face:slope()
  if upright and math.abs(slope - 90) > 1 then
    error(`{owner} takes an upright face, but this one has a slope of {math.round(slope)} degrees`, 3)
  elseif not upright and slope > 1 and slope < 179 then
    error(`{owner} takes a horizontal face, but this one has a slope of {math.round(slope)} degrees`, 3)
  end
end

-- Returns the rectangle of a width and a height.
function outlines.rectangle(width: number, height: number): { { number } }
  return { { 0, 0 }, { width, 0 }, { width, height }, { 0, height } }
end

-- Returns the height of an arch above its springing line: "rectangle", "segmental", "round" or "pointed".
function outlines.rise(kind: string, width: number): number
  if kind == "rectangle" then
    return 0
  elseif kind == "segmental" then
    return width * 0.16
  elseif kind == "round" then
    return width / 2
  elseif kind == "pointed" then
    return width * math.sqrt(3) / 2
  end
  error(`unknown kind of arch {kind}: use rectangle, segmental, round or pointed`, 3)
end

-- Returns the outline of an opening with an arch of a kind at the top; `rise` replaces the height of the arch.
function outlines.arch(kind: string, width: number, height: number, rise: number?): { { number } }
  local up = rise or outlines.rise(kind, width)
  if up <= 0 then
    return outlines.rectangle(width, height)
  elseif up > height + 1e-9 then
    error(`a {kind} arch {width} m wide needs a height of {math.ceil(up * 100) / 100} m, not {height} m`, 3)
  end
  local spring = height - up
  local points: { { number } } = { { 0, 0 }, { width, 0 } }
  local segments = 9
  if kind == "pointed" then
    local radius = (width * width / 4 + up * up) / width
    local last = math.acos((radius - width / 2) / radius)
    for step = 0, segments do
      local angle = last * step / segments
      table.insert(points, { width - radius + radius * math.cos(angle), spring + radius * math.sin(angle) })
    end
    for step = segments - 1, 0, -1 do
      local angle = last * step / segments
      table.insert(points, { radius - radius * math.cos(angle), spring + radius * math.sin(angle) })
    end
  else
    local radius = (width * width / 4 + up * up) / (2 * up)
    local half = math.asin(math.min(1, width / 2 / radius))
    for step = 0, 2 * segments do
      local angle = half - half * step / segments
      table.insert(
        points,
        { width / 2 + radius * math.sin(angle), height - radius + radius * math.cos(angle) }
      )
    end
  end
  -- The ends of an arch without a wall below are the feet.
  if spring < 1e-9 then
    table.remove(points, 3)
    table.remove(points)
  end
  return points
end

-- Returns a regular polygon around { x, y }.
function outlines.circle(x: number, y: number, radius: number, sides: number?): { { number } }
  local points: { { number } } = {}
  local count = sides or 24
  for step = 0, count - 1 do
    local angle = 2 * math.pi * step / count
    table.insert(points, { x + radius * math.cos(angle), y + radius * math.sin(angle) })
  end
  return points
end

-- Returns a foil of `count` lobes with cusps between them around { x, y }, such as a quatrefoil; `turn` (degrees) is the
-- direction of the first lobe.
function outlines.foil(x: number, y: number, radius: number, count: number, turn: number?): { { number } }
  local sine, cosine = math.sin(math.pi / count), math.cos(math.pi / count)
  local far = radius / (1 + sine * 1.04)
  local lobe = radius - far
  local cusp = far * cosine + math.sqrt(lobe * lobe - far * far * sine * sine)
  local last = math.atan2(cusp * sine, cusp * cosine - far)
  local points: { { number } } = {}
  local segments = 7
  for number = 0, count - 1 do
    local axis = math.rad(turn or 90) + 2 * math.pi * number / count
    -- The last point of a lobe is the first of the next one.
    for step = 0, segments - 1 do
      local angle = axis - last + 2 * last * step / segments
      table.insert(points, {
        x + far * math.cos(axis) + lobe * math.cos(angle),
        y + far * math.sin(axis) + lobe * math.sin(angle),
      })
    end
  end
  return points
end

-- Returns the outline moved by { x, y }.
function outlines.move(outline: { { number } }, x: number, y: number): { { number } }
  local points: { { number } } = {}
  for at, point in outline do
    points[at] = { point[1] + x, point[2] + y }
  end
  return points
end

-- Returns the outline of the band between two arches that begin with their feet: a surround without a lower part.
function outlines.band(outer: { { number } }, inner: { { number } }): { { number } }
  local points: { { number } } = {}
  for at = 2, #outer do
    table.insert(points, outer[at])
  end
  table.insert(points, outer[1])
  table.insert(points, inner[1])
  for at = #inner, 2, -1 do
    table.insert(points, inner[at])
  end
  return points
end

-- Returns the outline of a face with one ring in the face's own coordinates.
function outlines.of(face: Shape, frame: Shape?): { { number } }
  local from = frame or face
  local corner, x, y = from:position(), from:x_axis(), from:y_axis()
  local points: { { number } } = {}
  for at, point in face:points() do
    points[at] = { (point - corner):dot(x), (point - corner):dot(y) }
  end
  return points
end

-- Returns an outline with holes as a face in the plane of `face`, moved by `z` (m) outwards.
function outlines.place(face: Shape, outline: { { number } }, holes: { any }?, z: number?): Shape
  local low, high = { math.huge, math.huge }, { -math.huge, -math.huge }
  for _, point in outline do
    for axis = 1, 2 do
      low[axis] = math.min(low[axis], point[axis])
      high[axis] = math.max(high[axis], point[axis])
    end
  end
  local rings: { any } = { outline }
  for _, hole in holes or {} do
    table.insert(rings, hole)
  end
  local frame = face:shift(vec(low[1], low[2], z or 0))
  return frame:resize(vec(high[1] - low[1], high[2] - low[2], 0)):fit(shape(rings):align())
end

-- Returns the upright face of corners from the lower left one, counter-clockwise seen from outside.
function outlines.face(corners: { any }): Shape
  local ring: { number } = {}
  for at in corners do
    ring[at] = at
  end
  return shape({ points = corners, faces = { ring } }):faces()[1]
end

-- Returns the solid box from x0 to x1, y0 to y1 and z0 to z1 (m) in the frame of a face.
function outlines.box(face: Shape, x: { number }, y: { number }, z: { number }): Shape
  local outline = outlines.move(outlines.rectangle(x[2] - x[1], y[2] - y[1]), x[1], y[1])
  return outlines.place(face, outline, nil, z[1]):extrude(z[2] - z[1])
end

-- Returns the solid of a profile of { outwards, up } (m), counter-clockwise, across a face, from `x` to the right by `width`.
function outlines.across(face: Shape, profile: { { number } }, x: number, width: number): Shape
  local corner = face:position() + face:x_axis() * x
  local points: { any }, ring: { number } = {}, {}
  for at, point in profile do
    points[at] = corner + face:z_axis() * point[1] + face:y_axis() * point[2]
    table.insert(ring, 1, at)
  end
  return shape({ points = points, faces = { ring } }):extrude(width)
end

-- Returns the solid of revolution of a profile of { radius, height } (m) from the bottom to the top, around the z axis. A
-- share `flute` of the radius is cut from every other corner.
function outlines.turned(profile: { { number } }, sides: number, flute: number?): Shape
  local points: { any }, faces: { any } = {}, {}
  local rows: { { number } } = {}
  for at, level in profile do
    rows[at] = {}
    if level[1] < 1e-6 then
      table.insert(points, vec(0, 0, level[2]))
      rows[at] = { #points }
      continue
    end
    for side = 0, sides - 1 do
      local angle = 2 * math.pi * (side + 0.5) / sides
      local radius = level[1] * (if side % 2 == 1 then 1 - (flute or 0) else 1)
      table.insert(points, vec(radius * math.cos(angle), radius * math.sin(angle), level[2]))
      rows[at][side + 1] = #points
    end
  end
  for at = 1, #rows - 1 do
    local lower, upper = rows[at], rows[at + 1]
    for side = 1, sides do
      local next = side % sides + 1
      if #lower > 1 and #upper > 1 then
        table.insert(faces, { lower[side], lower[next], upper[next], upper[side] })
      elseif #lower > 1 then
        table.insert(faces, { lower[side], lower[next], upper[1] })
      elseif #upper > 1 then
        table.insert(faces, { lower[1], upper[next], upper[side] })
      end
    end
  end
  local first, last = rows[1], rows[#rows]
  if #last > 1 then
    table.insert(faces, last)
  end
  if #first > 1 then
    local bottom: { number } = {}
    for _, point in first do
      table.insert(bottom, 1, point)
    end
    table.insert(faces, bottom)
  end
  return shape({ points = points, faces = faces })
end

-- Adds all shapes of a list to another list.
function outlines.add(list: { Shape }, others: { Shape })
  table.move(others, 1, #others, #list + 1, list)
end

return outlines
