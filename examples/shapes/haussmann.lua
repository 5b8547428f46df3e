--!strict
-- A Parisian block around a courtyard: storeys, bays with French windows, balconies, cornices, a mansard roof with dormers.
local storeys =
  param("storeys", { default = 5, min = 3, max = 8, step = 1, doc = "Number of storeys above the shops." })
local bay_width = param("bay_width", { default = 2.7, min = 2, max = 5, unit = "m" })

local STONE, TRIM, ZINC, GLASS, IRON, SHOP = "#d8cbb0", "#e6dcc6", "#727a82", "#39444d", "#23272b", "#3a4a44"
local GROUND, STOREY, ATTIC = 4.4, 3.3, 3.4

local Block, Storey, Front, Bay, Roof =
  module("Block", "plan"),
  module("Storey", "mass"),
  module("Front", "face"),
  module("Bay", "face"),
  module("Roof", "plan")
local block = lsystem({ object = extruder({ color = STONE }) })

block:axiom(Block(shape({
  { { 0, 0 }, { 46, 0 }, { 52, 26 }, { 4, 34 } },
  { { 14, 12 }, { 36, 12 }, { 38, 19 }, { 16, 22 } },
})))
block:rule("Block(plan)", function(this, plan: Shape)
  local height = GROUND + storeys * STOREY
  local mass = plan:extrude(height):with("top", storeys)
  local parts: { any } = { Roof(plan:translate(vec(0, 0, height))) }
  for _, storey in mass:split("z", { GROUND, `~{STOREY}*` }) do
    table.insert(parts, Storey(storey:with("level", storey:index() - 1)))
  end
  return sequence(parts)
end)
-- The walls of a storey, a band above it, and on the second and the last storey a balcony along the street.
block:rule("Storey(mass)", function(this, mass: Shape)
  local parts: { any } = {}
  for _, face in mass:faces("side") do
    table.insert(parts, Front(face))
  end
  local band = mass:faces("up")[1]
  table.insert(
    parts,
    Draw(band:molding({ { -0.1, -0.28 }, { 0.12, -0.2 }, { 0.16, 0 }, { -0.1, 0 } }):color(TRIM))
  )
  return sequence(parts)
end)
block:rule("Front(face)", function(this, face: Shape)
  local level, size = face:get("level"), face:size()
  -- A quoin at both ends, and bays between them.
  local parts: { any } = {}
  for _, part in face:split("x", { 0.7, `~{bay_width}*`, 0.7 }) do
    table.insert(parts, if part:entry() == 2 then Bay(part) else Draw(part:extrude(0.06):color(TRIM)))
  end
  if level == 2 or level == storeys then
    local slab = face:split("y", { 0.14, "~1" })[1]:extrude(0.75)
    table.insert(parts, Draw(slab:color(TRIM)))
    local outer = face:shift(vec(0, 0.14, 0.7)):split("y", { 0.95, "~1" })[1]
    for _, bar in outer:split("x", { { 0.03, "~0.14" } }) do
      if bar:entry() == 1 then
        table.insert(parts, Draw(bar:extrude(0.03):color(IRON)))
      end
    end
    local rail = face:shift(vec(0, 1.06, 0.68)):split("y", { 0.05, "~1" })[1]:extrude(0.07)
    table.insert(parts, Draw(rail:color(IRON)))
  end
  return sequence(parts)
end)
-- An opening in a wall: the wall around it, the reveals, and glass or a shop window behind.
local function opening(parts: { any }, hole: Shape, depth: number, color: string)
  for _, reveal in hole:extrude(-depth):faces("tag:extrude.side") do
    table.insert(parts, Draw(reveal:reverse():color(TRIM)))
  end
  local pane = hole:shift(vec(0, 0, -depth))
  table.insert(parts, Draw(pane:color(GLASS)))
  -- Frames: a border, a post and a rail.
  for _, strip in pane:border(0.07) do
    table.insert(parts, Draw(strip:extrude(0.05):color(color)))
  end
  local size = pane:size()
  local post = pane:split("x", { "~1", 0.06, "~1" })[2]
  table.insert(parts, Draw(post:extrude(0.04):color(color)))
end
block:rule("Bay(face)", function(this, face: Shape)
  local level = face:get("level")
  local parts: { any } = {}
  local width, sill, head = 1.15, 0.25, 0.6
  if level == 0 then
    width, sill, head = face:size().x - 0.5, 0.35, 0.8
  end
  for _, column in face:split("x", { "~1", width, "~1" }) do
    if column:entry() == 2 then
      local rows = column:split("y", { sill, "~1", head })
      table.insert(parts, Draw(if level == 0 then rows[1]:color(SHOP) else rows[1]))
      opening(parts, rows[2], if level == 0 then 0.15 else 0.28, if level == 0 then SHOP else TRIM)
      table.insert(parts, Draw(if level == 0 then rows[3]:color(SHOP) else rows[3]))
      if level > 0 then
        -- A surround, and a lintel that juts out.
        for _, strip in rows[2]:offset(0.14)[1]:border(0.14) do
          table.insert(parts, Draw(strip:extrude(0.05):color(TRIM)))
        end
        local lintel = rows[3]:split("y", { 0.16, "~1" })[1]:extrude(0.16)
        table.insert(parts, Draw(lintel:color(TRIM)))
      end
    else
      table.insert(parts, Draw(column))
    end
  end
  return sequence(parts)
end)
-- The cornice, the mansard, dormers over the bays, and chimneys.
block:rule("Roof(plan)", function(this, plan: Shape)
  local parts: { any } = {}
  local profile = { { -0.3, -0.1 }, { 0.2, 0.0 }, { 0.45, 0.22 }, { 0.55, 0.4 }, { -0.3, 0.4 } }
  table.insert(parts, Draw(plan:molding(profile):color(TRIM)))
  local base = plan:translate(vec(0, 0, 0.4))
  table.insert(parts, Draw(base:roof({ kind = "mansard", height = ATTIC * 1.35 }):color(ZINC)))
  local wall = base:extrude(2.4)
  for _, face in wall:faces("side") do
    for _, bay in face:split("x", { 0.7, `~{bay_width}*`, 0.7 }) do
      if bay:entry() == 2 and bay:index() % 2 == 0 then
        local column = bay:split("x", { "~1", 1.3, "~1" })[2]
        local front = column:split("y", { 0.2, 1.75, "~1" })[2]:shift(vec(0, 0, -0.25))
        local body = front:extrude(-2.2)
        for _, side in body:faces("tag:extrude.side") do
          table.insert(parts, Draw(side:color(TRIM)))
        end
        for _, strip in front:border(0.16) do
          table.insert(parts, Draw(strip:extrude(0.06):color(TRIM)))
        end
        local panes = front:setback(0.16)
        if panes[1] then
          opening(parts, panes[1], 0.12, TRIM)
        end
        local top = body:faces("up")[1]
        table.insert(parts, Draw(top:offset(0.12)[1]:taper(0.5, 0.3):color(ZINC)))
      end
    end
  end
  for _, strip in plan:setback(5)[1]:border(1.1) do
    if strip:size().x > 8 then
      for _, part in strip:split("x", { "~1", 2.2, "~1" }) do
        if part:entry() == 2 then
          table.insert(parts, Draw(part:extrude(ATTIC * 1.35 + 1.6):color("#a98d76")))
        end
      end
    end
  end
  return sequence(parts)
end)
block:derive()

camera({ from = vec(-26, -34, 15), to = vec(21, 12, 9), fov = 42 })
