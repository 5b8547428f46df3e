--!strict
-- Reports: warnings of parts of a town that growth leaves without streets.
local reports = {}

-- The warning about land that remains much larger than its blocks.
local function warn_of_land(land: { any })
  table.sort(land, function(a: any, b: any)
    if a.area ~= b.area then
      return a.area > b.area
    end
    return a.x < b.x or a.x == b.x and a.y < b.y
  end)
  local of = land[1]
  warn(
    `roads.grow: land stays undivided in {#land} {if #land > 1 then "places" else "place"}, at most {of.area // 1} m² near {of.x // 1}, {of.y // 1} (m), where blocks have up to {of.block // 1} m²`,
    "try narrower streets, a smaller clearance of the network, a larger block or another seed"
  )
end

-- The warning about sectors with a failed outline.
local function warn_of_outline(open: { any })
  table.sort(open, function(a: any, b: any)
    return a.x < b.x or a.x == b.x and a.y < b.y
  end)
  warn(
    `roads.grow: the outline of the town stays open in {#open} {if #open > 1 then "places" else "place"}, the first near {open[1].x // 1}, {open[1].y // 1} (m), and land there has no streets`,
    "try another seed, a greater extent or a smaller block"
  )
end

-- The warning about streets of the last step that would continue in further steps.
local function warn_of_end(count: number, steps: number)
  local streets = if count > 1 then `{count} streets continue` else "a street continues"
  warn(
    `roads.grow: growth stops after {steps} {if steps > 1 then "steps" else "step"}, while {streets} within the extent`,
    "derive more steps: give a greater `steps`, or a smaller `extent`"
  )
end

-- Warns of the land, the outline and the streets that a derived town leaves unfinished. `of` are its options.
function reports.warn_of(derived: any, of: any)
  local town: Network = derived.objects[1]
  local found: { [string]: { any } } = { Undivided = {}, Unclosed = {}, Tip = {} }
  for _, each in derived:chain() do
    local list = each.name and found[each.name]
    if list then
      table.insert(list, each)
    end
  end
  if #found.Unclosed > 0 then
    warn_of_outline(found.Unclosed)
  end
  if #found.Undivided > 0 then
    warn_of_land(found.Undivided)
  end
  local count = 0
  for _, tip in found.Tip do
    local at = town:open_end(tip.junction, tip.heading)
    local place = at and town:place(at)
    if place and of.inside(place.x, place.y) then
      count += 1
    end
  end
  if count > 0 then
    warn_of_end(count, of.steps)
  end
end

return reports
