--!strict
-- Growth on a grid with collisions: an apex sends three tentacles to the neighbouring cells. A free cell that only one
-- tentacle has reached gets an apex; other tentacles stay. A hook counts the tentacles of all cells before each step.
-- Source: Virtual Laboratory (cpfg), Open/01-ulam-collide, University of Calgary, after S. Ulam, 1962.
local steps = param("steps", { default = 15, min = 1, max = 40, step = 1, doc = "Generations" })
local young = param("young", { default = "#d9a441", doc = "Colour of the youngest cells" })
local old = param("old", { default = "#2f5f8f", doc = "Colour of the oldest cells" })

local Apex, Tentacle = module("Apex", "x", "y", "heading"), module("Tentacle", "x", "y", "heading")
local Cell = module("Cell", "x", "y", "heading", "birth")

-- How many cells and tentacles there are at a place, such as 3,-1.
local grid = variables({ taken = { ["0,0"] = 1 } :: { [string]: number } })

local COUNT = [[
  select x, y, count(*) as n from (select x, y from Cell union all select x, y from Tentacle) group by x, y
]]

local function key(x: number, y: number): string
  return `{x},{y}`
end

-- Headings are quarters of a turn: 0 is x, 1 is y.
local function step_from(x: number, y: number, heading: number): (number, number)
  local angle = heading % 4
  return x + (if angle == 0 then 1 elseif angle == 2 then -1 else 0),
    y + (if angle == 1 then 1 elseif angle == 3 then -1 else 0)
end

local growth =
  lsystem({ object = extruder({ sides = 4, smooth = false }), variables = grid, interpret = "last" })
local arms: { any } = { { Cell(0, 0, 0, 0) } }
for heading = 0, 3 do
  local x, y = step_from(0, 0, heading)
  table.insert(arms, { Tentacle(x, y, heading) })
end
growth:axiom(sequence(arms))
growth:before_step(function()
  local taken: { [string]: number } = {}
  for _, place in query(COUNT) do
    taken[key(place.x, place.y)] = place.n
  end
  grid.taken = taken
end)
growth:rule("Tentacle(x, y, heading)", {
  when = function(this, x, y)
    return grid.taken[key(x, y)] == 1
  end,
}, function(this, x, y, heading)
  return Cell(x, y, heading, step()), Apex(x, y, heading)
end)
growth:decompose("Apex(x, y, heading)", function(this, x: number, y: number, heading: number)
  local tentacles: { any } = {}
  for side = -1, 1 do
    local nx, ny = step_from(x, y, heading + side)
    table.insert(tentacles, { Tentacle(nx, ny, heading + side) })
  end
  return sequence(tentacles)
end)
growth:interpret("Cell(x, y, heading, birth)", function(this, x, y, heading, birth)
  this:jump({ x, y, 0 }):color(mix(old, young, birth / steps)):scale(0.48):extrude(0.3)
end)
local result = growth:derive(steps)

-- The cells of the Ulam-Warburton automaton: 1, 5, 9, 21, 25, 37, 49, 85, ... The number 2^k is (4^(k + 1) - 1) / 3.
expect(result.counts.Cell, (4 ^ 5 - 1) / 3)
-- Picture: --azimuth 180 --elevation 75
