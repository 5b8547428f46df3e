--!strict
-- A block divided into lots, each with a house and a garden, as in CGA's examples of subdivision: two rows along the streets,
-- which are halved until the parts are small enough.
local elements = require("@elements")
local openings, roofs = elements.openings, elements.roofs

local most =
  param("most", { default = 900, min = 250, max = 3000, unit = "m²", doc = "Largest area of a lot." })
local irregular =
  param("irregular", { default = 0.12, min = 0, max = 0.3, doc = "Random part of the place of a cut." })

local Block, Plan, Lot, House =
  module("Block", "plan"), module("Plan", "plan"), module("Lot", "plan"), module("House", "plan")
local town = lsystem({ object = extruder({ color = "#d8cdb8" }) })
local WALLS = { "#d9cdb4", "#c9b79a", "#e2dccd", "#b98f72", "#cfc9bd", "#d6b98c" }
local TILES = { "#8a4a38", "#7c5340", "#6b4a40", "#5d656d" }
local GREENS = { "#7f9468", "#869a66", "#778c5c", "#8a9a6e" }

local function pick(list: { string }): string
  return list[math.floor(random() * #list) + 1]
end

town:axiom(Block(shape({ { 0, 0 }, { 124, -6 }, { 138, 62 }, { 70, 84 }, { -6, 70 } })))
-- A street around the block, and a pavement along it.
town:rule("Block(plan)", function(this, plan: Shape)
  return Draw(plan:offset(9)[1]:translate(vec(0, 0, -0.4)):extrude(0.25):color("#6b6e70")),
    Draw(plan:offset(2.2)[1]:translate(vec(0, 0, -0.2)):extrude(0.17):color("#b5afa3")),
    split(plan, "y", {
      {
        "~1",
        function(row: Shape)
          return Plan(row:with("street", "front"))
        end,
      },
      {
        "~1",
        function(row: Shape)
          return Plan(row:with("street", "back"))
        end,
      },
    })
end)
-- Cuts a row across, near the middle, until a part is a lot. Each half has to be wide enough for a house.
town:rule("Plan(plan)", function(this, plan: Shape)
  if plan:area() <= most or plan:size().x < 27 then
    return Lot(plan)
  end
  local share = 50 + 100 * irregular * random(-1, 1)
  return split(plan, "x", { { `{share}%`, Plan }, { `{100 - share}%`, Plan } })
end)
-- A garden behind hedges, and a house on the largest rectangle that the law allows.
town:rule("Lot(plan)", function(this, plan: Shape)
  local parts: { any } = { Draw(plan:color(pick(GREENS))) }
  for _, hedge in plan:setback(0.3) do
    for _, strip in hedge:border(0.6) do
      if strip:area() > 3 and random() < 0.86 then
        table.insert(
          parts,
          Draw(strip:extrude(random(0.8, 1.5)):color(if random() < 0.5 then "#54683a" else "#61753f"))
        )
      end
    end
  end
  local free = plan:setback({ front = 5, back = 5, side = 2 })[1]
  local room = free and free:inner_rectangle()
  local house: Shape? = nil
  if room and room:size().x >= 6 and room:size().y >= 6 then
    -- Houses stand towards their street.
    local size = room:size()
    local wide, deep = math.min(size.x, random(9, 13)), math.min(size.y, random(8, 11))
    local y = if plan:get("street") == "front" then 0 else size.y - deep
    house = room:crop((size.x - wide) / 2, y, wide, deep)
    if house then
      table.insert(parts, House(house))
    end
  end
  local garden = plan:setback(2)[1]
  local seed = math.floor(random() * 1e6)
  for _, at in if garden then garden:scatter(7, { seed = seed }) else {} do
    if not house or house:distance(at) > 3.2 then
      local high, radius = random(1.6, 2.6), random(1.2, 2)
      table.insert(parts, Draw(cylinder(0.16, high + 0.6, 8):translate(at):color("#6a5744")))
      for number = 0, 3 do
        local angle = math.rad(number * 137.5)
        local crown = ball(radius * (0.9 - 0.1 * number), 9)
        local aside = vec(math.cos(angle), math.sin(angle), 0) * (radius * 0.35)
        crown = crown:translate(at + aside + vec(0, 0, high + radius * (0.5 + 0.2 * number)))
        table.insert(parts, Draw(crown:color(if number % 2 == 0 then "#67803f" else "#768d4a")))
      end
    end
  end
  return sequence(parts)
end)
-- One or two storeys with a door in front, a roof, dormers and a chimney.
town:rule("House(plan)", function(this, plan: Shape)
  local storeys, color, tiles = if random() < 0.6 then 2 else 1, pick(WALLS), pick(TILES)
  local parts: { any } = {}
  local function add(shapes: { Shape }, wall: boolean)
    for at, part in shapes do
      table.insert(parts, Draw(if wall and at == 1 then part:color(color) else part))
    end
  end
  local mass = plan:extrude(0.4 + 2.9 * storeys)
  for _, face in mass:faces("side") do
    local front = face:matches(plan:get("street"))
    for _, storey in face:split("y", { 0.4, "~2.9*" }) do
      if storey:index() == 1 then
        table.insert(parts, Draw(storey:extrude(0.05):color("#a89f8e")))
        continue
      end
      local count = math.max(1, math.round(face:size().x / 3.1))
      for _, bay in storey:split("x", { `~{face:size().x / count}*` }) do
        if front and storey:index() == 2 and bay:index() == (count + 1) // 2 then
          add(openings.door(bay, { leaves = 1, width = 1.05, height = 2.2, step = 0.8 }), true)
        else
          add(openings.window(bay, { width = 1.15, height = 1.35, sill = 0.85, surround = 0.09 }), true)
        end
      end
    end
  end
  local top = mass:faces("up")[1]
  local hip = random() < 0.45
  local rise = math.min(plan:size().x, plan:size().y) * random(0.36, 0.46)
  local roof = top:roof({ kind = if hip then "hip" else "gable", height = rise, overhang = 0.5 })
  for _, face in roof:faces() do
    table.insert(parts, Draw(face:color(if face:has_tag("roof.gable") then color else tiles)))
  end
  local stack = top:crop(top:size().x * 0.3, top:size().y * 0.5 + 0.4, 0.9, 0.55)
  if stack then
    add(roofs.chimney(stack, { height = rise + 0.8, pots = 2 }), false)
  end
  return sequence(parts)
end)
town:derive()

camera({ from = vec(28, -62, 44), to = vec(67, 27, -6), fov = 42 })
