--!strict
-- A Doric temple as a shape grammar: steps, a colonnade around a cella, an entablature and a gabled roof. After the
-- measures of the Parthenon: 8 by 17 columns on a base of 31 m by 70 m.
local columns_of = require("@elements/columns")

local columns =
  param("columns", { default = 8, min = 4, max = 12, step = 1, doc = "Number of columns on a front." })
local column_height = param("column_height", { default = 10.4, min = 4, max = 16, unit = "m" })

local Temple, Steps, Hall, Colonnade, Top =
  module("Temple", "plan"),
  module("Steps", "plan"),
  module("Hall", "plan"),
  module("Colonnade", "plan"),
  module("Top", "plan")
local Column = module("Column", "foot")

local STONE, SHADE, ROOF = "#dccdac", "#bfae8c", "#a8663f"
local spacing = 30.9 / (columns - 0.55)

-- A fluted column with its capital, made once.
local foot = rectangle(2.1, 2.1):translate(vec(-1.05, -1.05, 0))
local order = {
  order = "doric",
  radius = math.min(0.92, column_height / 7),
  height = column_height,
  flute = 0.06,
  sides = 40,
  color = STONE,
}
local shaft = lsystem({ object = extruder() })
local drums: { any } = {}
for at, part in columns_of.column(foot, order) do
  drums[at] = Draw(part)
end
shaft:axiom(sequence(drums))
local column = shaft:derive()

local temple = lsystem({ object = extruder({ color = STONE }) })
temple:axiom(Temple(rectangle(30.9, spacing * (2 * columns + 0.45))))

temple:rule("Temple(plan)", function(this, plan: Shape)
  return Steps(plan),
    Colonnade(plan),
    Hall(plan:setback(4.6)[1]),
    Top(plan:translate(vec(0, 0, column_height)))
end)
-- Three steps, each wider than the one above.
temple:rule("Steps(plan)", function(this, plan: Shape)
  local steps: { any } = {}
  for step = 1, 3 do
    local slab = plan:offset(0.7 * step)[1]:translate(vec(0, 0, -0.5 * (step - 1)))
    steps[step] = Draw(slab:extrude(-0.5))
  end
  return sequence(steps)
end)
-- One column in the middle of each part of the strip along the edges; corners belong to the strips of the long sides.
temple:rule("Colonnade(plan)", function(this, plan: Shape)
  local size = plan:size()
  local feet: { any } = {}
  local function stand(x: number, y: number)
    table.insert(feet, { Column(vec(x, y, 0)) })
  end
  local dx, dy = (size.x - 2.2) / (columns - 1), (size.y - 2.2) / (2 * columns)
  for number = 0, columns - 1 do
    stand(1.1 + number * dx, 1.1)
    stand(1.1 + number * dx, size.y - 1.1)
  end
  for number = 1, 2 * columns - 1 do
    stand(1.1, 1.1 + number * dy)
    stand(size.x - 1.1, 1.1 + number * dy)
  end
  return sequence(feet)
end)
-- The cella: walls with a door in the east, and a floor.
temple:rule("Hall(plan)", function(this, plan: Shape)
  local walls = plan:extrude(column_height)
  local room = plan:setback(1.1)[1]:extrude(column_height + 1)
  local size, at = plan:size(), plan:position()
  local door = cuboid(4.6, 3, 8.2):translate(at + vec(size.x / 2 - 2.3, -1, 0))
  local hollow = walls:subtract(room)
  return if hollow then Draw((hollow:subtract(door) or hollow):color("#cdbd9a")) else nil
end)
-- The entablature in two bands, the frieze with triglyphs, and the roof with its pediments.
temple:rule("Top(plan)", function(this, plan: Shape)
  local beam = plan:extrude(1.35)
  local frieze = plan:translate(vec(0, 0, 1.35)):extrude(1.35)
  local parts: { any } = { Draw(beam), Draw(frieze:color(SHADE)) }
  for _, face in frieze:faces("side") do
    for _, part in face:split("x", { { "~0.85", 0.9, "~0.85" } }) do
      if part:entry() == 2 then
        table.insert(parts, Draw(part:extrude(0.12):color(STONE)))
      end
    end
  end
  local eaves = plan:translate(vec(0, 0, 2.7))
  table.insert(parts, Draw(eaves:offset(0.75)[1]:extrude(0.5)))
  local base = eaves:offset(0.75)[1]:translate(vec(0, 0, 0.5))
  local roof = base:roof({ kind = "gable", slope = 14 })
  for _, face in roof:faces() do
    table.insert(parts, Draw(face:color(if face:has_tag("roof.slope") then ROOF else SHADE)))
  end
  -- A raking cornice frames each pediment.
  for _, gable in roof:faces("tag:roof.gable") do
    local frame = gable:molding({ { -0.45, 0 }, { 0.05, 0 }, { 0.05, 0.35 }, { -0.45, 0.35 } })
    table.insert(parts, Draw(frame))
  end
  return sequence(parts)
end)
temple:interpret("Column(foot)", function(this, foot: Vector)
  this:jump(foot):place(column)
end)
temple:derive()

camera({ from = vec(-21, -37, 6), to = vec(13.5, 14, 7), fov = 38 })
