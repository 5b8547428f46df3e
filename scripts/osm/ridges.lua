--!strict
-- Roofs mapped by their lines: ways with `roof:ridge` and `roof:edge`, and nodes with `roof:apex` or `roof:height`. Lengths are
-- in metres.
local ridges = {}

export type RoofLines = { ridges: { any }, edges: { any }, apexes: { any } }
type Line = { points: { any }, middle: any, is_ridge: boolean }

local SQUARE = 60
-- Lines and apexes by squares of the plane, so that those of a plan are found without comparing all of them.
local lines: { [string]: { Line } } = {}
local apexes: { [string]: { any } } = {}
-- Heights of nodes by their position, to a centimetre.
local heights: { [string]: number } = {}

local function key_of(place: any): string
  return `{math.round(place[1] * 100)},{math.round(place[2] * 100)}`
end

local function put<T>(squares: { [string]: { T } }, place: any, item: T)
  local key = `{place[1] // SQUARE},{place[2] // SQUARE}`
  squares[key] = squares[key] or {}
  table.insert(squares[key], item)
end

-- Reads the lines of an extract.
function ridges.read(extract: string)
  local has_points, points =
    pcall(source, extract, { tags = { { ["roof:apex"] = true }, { ["roof:height"] = "*" } }, kind = "point" })
  if has_points then
    for _, feature in points do
      local at = { feature.geometry:x(), feature.geometry:y() }
      local height: number = feature.roof_height or 0
      if height > 0 then
        heights[key_of(at)] = height
      end
      if feature["roof:apex"] and feature["roof:apex"] ~= "no" then
        put(apexes, at, { at[1], at[2], math.max(height, 0) })
      end
    end
  end
  local has_ways, ways =
    pcall(source, extract, { tags = { { ["roof:ridge"] = true }, { ["roof:edge"] = true } }, kind = "line" })
  if not has_ways then
    return
  end
  for _, feature in ways do
    local own: number = math.max(feature.roof_height or 0, 0)
    local is_ridge: boolean = feature["roof:ridge"] ~= nil and feature["roof:ridge"] ~= "no"
    local line: Line = { points = {}, middle = feature.geometry:point_on_surface(), is_ridge = is_ridge }
    for _, point in feature.geometry.points do
      table.insert(line.points, { point[1], point[2], heights[key_of(point)] or own })
    end
    put(lines, { line.middle:x(), line.middle:y() }, line)
  end
end

-- The lines whose middle is on a plan, or nil if there are none.
function ridges.on(plan: any): RoofLines?
  local found: RoofLines = { ridges = {}, edges = {}, apexes = {} }
  local low, high = { math.huge, math.huge }, { -math.huge, -math.huge }
  for _, corner in plan.rings[1] do
    for axis = 1, 2 do
      low[axis], high[axis] = math.min(low[axis], corner[axis]), math.max(high[axis], corner[axis])
    end
  end
  for x = low[1] // SQUARE, high[1] // SQUARE do
    for y = low[2] // SQUARE, high[2] // SQUARE do
      for _, line in lines[`{x},{y}`] or {} do
        if plan:contains(line.middle) then
          table.insert(if line.is_ridge then found.ridges else found.edges, line.points)
        end
      end
      for _, apex in apexes[`{x},{y}`] or {} do
        if plan:contains(point(apex[1], apex[2])) then
          table.insert(found.apexes, apex)
        end
      end
    end
  end
  return if #found.ridges + #found.edges + #found.apexes > 0 then found else nil
end

return ridges
