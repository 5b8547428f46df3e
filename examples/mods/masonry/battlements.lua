--!strict
-- Battlements for extruders: a parapet with merlons, straight or around a tower.
local materials = require("./materials")
local block = require("./blocks").block

local battlements = {
  thick = 0.5,
  parapet = 1,
  merlon = 1.1,
  gap = 0.8,
}

local function merlon(this, foot, way)
  local size, thick = battlements.merlon, battlements.thick
  this:material(materials.ashlar)
  block(this, foot, way, size, thick, 0.9)
  this:material(materials.dressed)
  block(this, foot + vec(0, 0, 0.9), way, size + 0.14, thick + 0.14, 0.14)
end

-- Draws battlements between two positions on the wall walk.
function battlements.straight(this, from, to)
  local span = to - from
  local length = span:length()
  local way = span:unit()
  local middle = (from + to) * 0.5
  this:smooth(false):material(materials.ashlar)
  block(this, middle, way, length, battlements.thick, battlements.parapet)
  local pitch = battlements.merlon + battlements.gap
  local count = math.max(1, math.floor((length - battlements.gap) / pitch))
  for number = 1, count do
    local along = (number - (count + 1) / 2) * pitch
    merlon(this, middle + way * along + vec(0, 0, battlements.parapet), way)
  end
end

-- Draws battlements around a centre at a radius (m).
function battlements.round(this, center, radius: number)
  local ring, hole = {}, {}
  for step = 0, 35 do
    local x, y = math.cos(math.rad(step * 10)), math.sin(math.rad(step * 10))
    table.insert(ring, { x * radius, y * radius })
    table.insert(hole, 1, { x * (radius - battlements.thick), y * (radius - battlements.thick) })
  end
  this:smooth(false):material(materials.ashlar):jump(center):scale(1)
  this:polygon(ring, { hole }):extrude(battlements.parapet)
  local count = math.floor(2 * math.pi * radius / (battlements.merlon + battlements.gap))
  for number = 1, math.max(6, count) do
    local angle = math.rad(number * 360 / math.max(6, count))
    local out = vec(math.cos(angle), math.sin(angle), 0)
    local foot = center + out * (radius - battlements.thick / 2) + vec(0, 0, battlements.parapet)
    merlon(this, foot, vec(-out.y, out.x, 0))
  end
end

return battlements
