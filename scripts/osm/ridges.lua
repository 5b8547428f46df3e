--!strict
-- Roofs mapped by their lines: ways with `roof:ridge` and `roof:edge`, and nodes with `roof:apex` or `roof:height`. Lengths are
-- in metres.
local squares = require("osm/squares")
local ridges = {}

export type RoofLines = { ridges: { any }, edges: { any }, apexes: { any } }
type Line = { points: { any }, middle: any, is_ridge: boolean, id: string }
type Apex = { place: any, id: string }

-- Lines and apexes by squares of the plane.
local lines: { [string]: { Line } } = {}
local apexes: { [string]: { Apex } } = {}
-- Lines and apexes that no plan has taken, in their order.
local unused: { [string]: boolean } = {}
local order: { string } = {}
-- Heights of nodes by their position, to a centimetre.
local heights: { [string]: number } = {}

local function key_of(place: any): string
  return `{math.round(place[1] * 100)},{math.round(place[2] * 100)}`
end

local function note(id: string)
  unused[id] = true
  table.insert(order, id)
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
        local apex: Apex = { place = { at[1], at[2], math.max(height, 0) }, id = feature.id }
        squares.put(apexes, squares.at(at[1], at[2]), apex)
        note(apex.id)
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
    local middle = feature.geometry:point_on_surface()
    local line: Line = { points = {}, middle = middle, is_ridge = is_ridge, id = feature.id }
    for _, point in feature.geometry.points do
      table.insert(line.points, { point[1], point[2], heights[key_of(point)] or own })
    end
    squares.put(lines, squares.at(middle:x(), middle:y()), line)
    note(line.id)
  end
end

-- The lines whose middle is on a plan, or nil if there are none.
function ridges.on(plan: any): RoofLines?
  local found: RoofLines = { ridges = {}, edges = {}, apexes = {} }
  for _, square in squares.of(plan) do
    for _, line in lines[square] or {} do
      if plan:contains(line.middle) then
        table.insert(if line.is_ridge then found.ridges else found.edges, line.points)
        unused[line.id] = nil
      end
    end
    for _, apex in apexes[square] or {} do
      if plan:contains(point(apex.place[1], apex.place[2])) then
        table.insert(found.apexes, apex.place)
        unused[apex.id] = nil
      end
    end
  end
  return if #found.ridges + #found.edges + #found.apexes > 0 then found else nil
end

-- Warns of lines and apexes that are on no building.
function ridges.report()
  local first, count = "", 0
  for _, id in order do
    if unused[id] then
      first, count = if count == 0 then id else first, count + 1
    end
  end
  if count > 0 then
    local what = if count == 1 then "1 line or apex of a roof is" else `{count} lines and apexes of roofs are`
    warn(`{what} on no building, the first is {first}`, "check whether the extract contains the building")
  end
end

return ridges
