--!strict
-- A skyscraper of 17 storeys with an ornate front, as in CGA's tutorial of the Candler building: base, shaft and arched top
-- storeys, divided by ledges into a regular grid between corner bays.
local elements = require("@elements")
local openings, cornices, balustrades, outlines =
  elements.openings, elements.cornices, elements.balustrades, elements.outlines

local make_box: (face: Shape, x: { number }, y: { number }, z: { number }) -> Shape = outlines.box

local storeys = param("storeys", { default = 11, min = 3, max = 30, step = 1, doc = "Storeys of the shaft." })
local bay_width = param("bay_width", { default = 2.9, min = 2, max = 5, unit = "m" })

local STONE, TRIM, GLASS, IRON, PANEL = "#e3dac6", "#efe8d8", "#34424d", "#2f3a37", "#a8b0a4"
local GROUND, MEZZANINE, FLOOR, TOP, LEDGE = 5.4, 4.4, 3.6, 10.8, 0.8

local Tower, Band, Front, Ground, Bay, Arch, Corner =
  module("Tower", "plan"),
  module("Band", "mass"),
  module("Front", "face"),
  module("Ground", "face"),
  module("Bay", "face"),
  module("Arch", "face"),
  module("Corner", "face")
local building = lsystem({ object = extruder({ color = STONE }) })

local function draw(shapes: { Shape }): any
  local parts: { any } = {}
  for at, part in shapes do
    parts[at] = Draw(part)
  end
  return sequence(parts)
end

local plan = shape({ { 0, 0 }, { 27, 0 }, { 31, 4 }, { 31, 24 }, { 0, 34 } })
building:axiom(
  Draw(plan:offset(9)[1]:translate(vec(0, 0, -0.5)):extrude(0.3):color("#77797b")),
  Draw(plan:offset(5)[1]:translate(vec(0, 0, -0.2)):extrude(0.2):color("#a7a59f")),
  Tower(plan)
)
-- The storeys and the ledges between them; then the cornice, the roof and a balustrade on its edge.
building:rule("Tower(plan)", function(this, base: Shape)
  local height = GROUND + MEZZANINE + storeys * FLOOR + TOP + 3 * LEDGE + FLOOR
  local mass = base:extrude(height)
  local parts: { any } = {}
  local kinds = { "ground", "mezzanine", "ledge", "floor", "ledge", "arches", "ledge", "attic" }
  local sizes: { any } = { GROUND, MEZZANINE, LEDGE, `~{FLOOR}*`, LEDGE, TOP, LEDGE, FLOOR }
  for _, band in mass:split("z", sizes) do
    table.insert(parts, Band(band:with("kind", kinds[band:entry()])))
  end
  local top = mass:faces("up")[1]
  table.insert(parts, Draw(top:color("#8d8a82")))
  for _, part in cornices.cornice(top:translate(vec(0, 0, -0.6)), { height = 1.5, depth = 1.7, color = TRIM }) do
    table.insert(parts, Draw(part))
  end
  for _, face in mass:faces("side") do
    for _, bracket in
      cornices.brackets(
        face:shift(vec(0, -0.6, 0)),
        { height = 0.9, depth = 1.2, spacing = 1.1, width = 0.3, color = TRIM }
      )
    do
      table.insert(parts, Draw(bracket))
    end
    local edge = face:shift(vec(0, height + 0.9, -0.4))
    for _, part in
      balustrades.stone(
        edge,
        { spacing = 0.7, radius = 0.18, height = 1.4, pier = 1.2, sides = 8, color = TRIM }
      )
    do
      table.insert(parts, Draw(part))
    end
  end
  -- Tanks and a house on the roof.
  for _, house in top:setback(7) do
    table.insert(parts, Draw(house:extrude(4.6):color("#c7bda6")))
    for _, part in
      cornices.cornice(house:translate(vec(0, 0, 4.2)), { height = 0.5, depth = 0.4, color = TRIM })
    do
      table.insert(parts, Draw(part))
    end
  end
  return sequence(parts)
end)
building:rule("Band(mass)", function(this, mass: Shape)
  if mass:get("kind") ~= "ledge" then
    return components(mass, "faces", { { "side", Front } })
  end
  local bottom = mass:faces("down")[1]:reverse()
  return components(mass, "faces", { { "side", Draw } }),
    draw(cornices.cornice(bottom, { height = LEDGE, depth = 0.6, color = TRIM }))
end)
-- A corner bay at both ends of a front, and a grid between them.
building:rule("Front(face)", function(this, face: Shape)
  local kind = face:get("kind")
  local bay = if kind == "ground" then Ground elseif kind == "arches" then Arch else Bay
  local count = if kind == "arches" or kind == "ground" then 2 else 1
  if face:size().x < 8 then
    return split(face, "x", { { { "~2.9", Corner } } })
  end
  -- As many bays as pairs fit, so that arches and shop fronts stand above each other.
  local pairs_of = math.max(1, math.round((face:size().x - 6.4) / (2 * bay_width)))
  local width = (face:size().x - 6.4) / (2 * pairs_of) * count
  return split(face, "x", { { 3.2, Corner }, { { `~{width}`, bay } }, { 3.2, Corner } })
end)
-- A shop front: a wide window with a door in every third bay.
building:rule("Ground(face)", function(this, face: Shape)
  local size = face:size()
  if face:index() % 3 == 2 then
    local door =
      { kind = "round", width = 2.6, height = 4.4, light = 1.4, keystone = true, wood = IRON, trim = TRIM }
    return draw(openings.door(face, door))
  end
  return draw(openings.window(face, {
    width = size.x - 1.3,
    height = GROUND - 1.6,
    sill = 0.7,
    columns = 3,
    rows = 2,
    depth = 0.35,
    wood = IRON,
    trim = TRIM,
    glass = GLASS,
  }))
end)
-- A window of the grid between shallow piers, with a panel below.
building:rule("Bay(face)", function(this, face: Shape)
  local size = face:size()
  local shapes = openings.window(face, {
    width = math.min(size.x - 1, 1.9),
    height = size.y - 1.35,
    sill = 0.85,
    depth = 0.3,
    surround = 0.1,
    wood = "#56605c",
    trim = TRIM,
    glass = GLASS,
  })
  table.insert(shapes, make_box(face, { 0, 0.2 }, { 0, size.y }, { 0, 0.16 }))
  table.insert(shapes, make_box(face, { size.x - 0.2, size.x }, { 0, size.y }, { 0, 0.16 }))
  local panel = make_box(face, { 0.6, size.x - 0.6 }, { 0.15, 0.62 }, { 0, 0.07 })
  table.insert(shapes, panel:color(TRIM))
  return draw(shapes)
end)
-- Three storeys behind one arch, with cast panels at the floors.
building:rule("Arch(face)", function(this, face: Shape)
  local size = face:size()
  local width = size.x - 1.7
  local shapes = openings.window(face, {
    kind = "round",
    width = width,
    height = TOP - 1.1,
    sill = 0.5,
    columns = 4,
    rows = 6,
    depth = 0.5,
    frame = 0.1,
    surround = 0.3,
    keystone = true,
    wood = "#56605c",
    trim = TRIM,
    glass = GLASS,
  })
  for storey = 1, 2 do
    local y = 0.5 + storey * FLOOR * 0.95
    local x = (size.x - width) / 2
    table.insert(shapes, make_box(face, { x, x + width }, { y - 0.5, y + 0.4 }, { -0.5, -0.36 }):color(PANEL))
  end
  table.insert(
    shapes,
    make_box(face, { size.x / 2 - 0.14, size.x / 2 + 0.14 }, { 0.5, TOP - 2.4 }, { -0.5, -0.3 }):color(TRIM)
  )
  table.insert(shapes, make_box(face, { 0, 0.28 }, { 0, size.y }, { 0, 0.22 }))
  table.insert(shapes, make_box(face, { size.x - 0.28, size.x }, { 0, size.y }, { 0, 0.22 }))
  return draw(shapes)
end)
-- A corner bay is solid, rusticated by grooves, with a narrow window in each storey.
building:rule("Corner(face)", function(this, face: Shape)
  local size = face:size()
  local count = math.max(1, math.round(size.y / FLOOR))
  local shapes: { Shape } = {}
  for _, storey in face:split("y", { `~{size.y / count}*` }) do
    local high = storey:size().y
    local parts = openings.window(storey, {
      width = math.min(1, storey:size().x - 1.2),
      height = high - 1.5,
      sill = 0.9,
      columns = 1,
      depth = 0.3,
      surround = 0.14,
      trim = TRIM,
      wood = "#56605c",
      glass = GLASS,
    })
    table.move(parts, 1, #parts, #shapes + 1, shapes)
    for _, side in { 0, storey:size().x - 0.72 } do
      for course = 0, math.floor(high / 0.6) - 1 do
        table.insert(
          shapes,
          make_box(storey, { side, side + 0.72 }, { course * 0.6 + 0.05, course * 0.6 + 0.57 }, { 0, 0.12 })
        )
      end
    end
  end
  return draw(shapes)
end)
building:derive()

camera({ from = vec(78, -66, 14), to = vec(15, 14, 33), fov = 46 })
