--!strict
-- Areas: properties of the outline of the land between streets.
local checks = require("checks")

local areas = {}

-- More streets than meet at one junction.
local ARMS = 64
-- The places of a sample of an area along each side of it.
local SAMPLES = 20

-- The outline of an area, counter-clockwise: its corners (m) with their junctions and how many streets meet there.
export type Area = {
  count: number,
  x: { number },
  y: { number },
  junction: { number },
  degree: { number },
  -- The depth of the street from each corner to the next.
  depth: { number },
  -- Twice the area on the left of the path from the first corner to each corner.
  swept: { number },
  size: number,
  middle: { number },
  -- The heading (degrees, up to a quarter turn) of most of the outline.
  turned: number,
}

-- Reads the area of a face of a network; its size is negative for the land outside of all streets.
function areas.read(face: any): Area?
  if not face then
    return nil
  end
  local count = #face.corners
  local area: any = { count = count, x = {}, y = {}, junction = {}, degree = {}, depth = {}, swept = { 0 } }
  for index, corner in face.corners do
    area.x[index], area.y[index] = corner.place.x, corner.place.y
    area.junction[index], area.degree[index], area.depth[index] = corner.junction, corner.degree, corner.depth
  end
  local x, y, swept, cosines, sines = 0, 0, 0, 0, 0
  local ox, oy = area.x[1], area.y[1]
  for index = 1, count do
    local after = index % count + 1
    local ax, ay = area.x[index] - ox, area.y[index] - oy
    local bx, by = area.x[after] - ox, area.y[after] - oy
    local cross = ax * by - ay * bx
    swept += cross
    area.swept[index + 1] = swept
    x += (ax + bx) * cross
    y += (ay + by) * cross
    -- The fourth power of a direction is the same after a quarter turn.
    local dx, dy = bx - ax, by - ay
    local length = math.sqrt(dx * dx + dy * dy)
    local fourfold = 4 * math.atan2(dy, dx)
    cosines += length * math.cos(fourfold)
    sines += length * math.sin(fourfold)
  end
  area.size = swept / 2
  area.middle = { ox + x / (3 * swept), oy + y / (3 * swept) }
  area.turned = math.deg(math.atan2(sines, cosines)) / 4
  return area
end

-- The faces of a network, each once: a list of tables with the `face`, and a `junction` and a `heading` from which it lies on the left.
function areas.faces(this: Network): { any }
  local places: { any } = this:places()
  local faces: { any }, seen: { [number]: boolean } = {}, {}
  for junction, corner in places do
    for index, heading in corner.headings do
      if seen[junction * ARMS + index] then
        continue
      end
      local face = this:face(junction, heading)
      local corners = face.corners
      for number, each in corners do
        local way = corners[number % #corners + 1].place - each.place
        local out = math.deg(math.atan2(way.y, way.x))
        local arm, least = 0, math.huge
        for other, towards in places[each.junction].headings do
          local off = math.abs(checks.between(out, towards))
          if off < least then
            arm, least = other, off
          end
        end
        seen[each.junction * ARMS + arm] = true
      end
      table.insert(faces, { face = face, junction = junction, heading = heading })
    end
  end
  return faces
end

-- The heading (degrees) of the outline from a corner to the next.
function areas.heading(area: Area, corner: number): number
  local after = corner % area.count + 1
  return math.deg(math.atan2(area.y[after] - area.y[corner], area.x[after] - area.x[corner]))
end

-- The angle (degrees) of an area at a corner, and the heading of its bisector.
function areas.angle(area: Area, corner: number): (number, number)
  local out = areas.heading(area, corner)
  if area.degree[corner] == 1 then
    return 360, out + 180
  end
  local open = 180 - checks.between(areas.heading(area, (corner - 2) % area.count + 1), out)
  return open, out + open / 2
end

-- The distance (m) of a corner from the next one.
function areas.length(area: Area, corner: number): number
  local after = corner % area.count + 1
  return math.sqrt((area.x[after] - area.x[corner]) ^ 2 + (area.y[after] - area.y[corner]) ^ 2)
end

-- The length (m) of the outline.
function areas.border(area: Area): number
  local border = 0
  for corner = 1, area.count do
    border += areas.length(area, corner)
  end
  return border
end

-- Tests if a street may leave at a corner: the distances (m) to other corners, and to other streets that leave the
-- outline on either side, are large enough.
function areas.is_apart(area: Area, corner: number, bends: number, streets: number): boolean
  local count = area.count
  for step = -1, 1, 2 do
    local at, far = corner, 0
    repeat
      local after = (at + step - 1) % count + 1
      far += areas.length(area, if step > 0 then at else after)
      at = after
      if far < bends or far < streets and area.degree[at] > 2 then
        return false
      end
    until far >= streets or at == corner
  end
  return true
end

-- Returns the distance (m) of the outline from a corner towards a heading, and the corner where the crossed piece
-- begins.
function areas.hit(area: Area, corner: number, heading: number): (number?, number)
  local east, north = math.cos(math.rad(heading)), math.sin(math.rad(heading))
  local x, y, count = area.x[corner], area.y[corner], area.count
  local xs, ys = area.x, area.y
  local before = (corner - 2) % count + 1
  local best, edge = math.huge, 0
  local ax, ay = xs[1] - x, ys[1] - y
  local a_side = east * ay - north * ax
  for index = 1, count do
    local after = index % count + 1
    local bx, by = xs[after] - x, ys[after] - y
    local b_side = east * by - north * bx
    -- Seen from inside, a ray crosses the outline from right to left.
    if a_side < 0 and b_side >= 0 and index ~= corner and index ~= before then
      local part = a_side / (a_side - b_side)
      local far = (ax + part * (bx - ax)) * east + (ay + part * (by - ay)) * north
      if far > 1 and far < best then
        best, edge = far, index
      end
    end
    ax, ay, a_side = bx, by, b_side
  end
  if edge == 0 then
    return nil, 0
  end
  return best, edge
end

-- The part (m²) of an area on the right of the straight line from a corner to a position on its outline.
function areas.part(area: Area, corner: number, edge: number, x: number, y: number): number
  local swept = area.swept[edge] - area.swept[corner]
  if edge < corner then
    swept += 2 * area.size
  end
  local ox, oy = area.x[1], area.y[1]
  local ex, ey = area.x[edge] - ox, area.y[edge] - oy
  local cx, cy = area.x[corner] - ox, area.y[corner] - oy
  local px, py = x - ox, y - oy
  return (swept + ex * py - ey * px + px * cy - py * cx) / 2
end

-- The distance (m) of a position from the outline, without the parts behind the position for a given heading.
function areas.distance(area: Area, x: number, y: number, heading: number?): number
  local angle: number = math.rad(heading or 0)
  local east: number, north: number = math.cos(angle), math.sin(angle)
  local least = math.huge
  for index = 1, area.count do
    local after = index % area.count + 1
    local ax, ay = area.x[index] - x, area.y[index] - y
    local dx, dy = area.x[after] - x - ax, area.y[after] - y - ay
    local part = math.clamp(-(ax * dx + ay * dy) / math.max(dx * dx + dy * dy, 1e-9), 0, 1)
    local px, py = ax + part * dx, ay + part * dy
    local square = px * px + py * py
    if square < least and (not heading or px * east + py * north > -0.71 * math.sqrt(square)) then
      least = square
    end
  end
  return math.sqrt(least)
end

-- The size (m²) of the part of an area for whose places a function is true, from a sample of them.
function areas.size_of(area: Area, is_of: (x: number, y: number) -> boolean): number
  local left: number, right: number = math.huge, -math.huge
  local low: number, high: number = math.huge, -math.huge
  for corner = 1, area.count do
    local x: number, y: number = area.x[corner], area.y[corner]
    left = math.min(left, x)
    right = math.max(right, x)
    low = math.min(low, y)
    high = math.max(high, y)
  end
  local all, some = 0, 0
  for row = 0.5, SAMPLES do
    local y = low + row / SAMPLES * (high - low)
    for column = 0.5, SAMPLES do
      local x = left + column / SAMPLES * (right - left)
      local is_inside = false
      for corner = 1, area.count do
        local after = corner % area.count + 1
        local ay, by = area.y[corner], area.y[after]
        if
          (ay > y) ~= (by > y)
          and x < area.x[corner] + (y - ay) / (by - ay) * (area.x[after] - area.x[corner])
        then
          is_inside = not is_inside
        end
      end
      if is_inside then
        all += 1
        some += if is_of(x, y) then 1 else 0
      end
    end
  end
  return area.size * some / math.max(all, 1)
end

return areas
