--!strict
-- A gatehouse: a block with an arch, an oak gate behind a portcullis, and battlements all around.
local masonry = require("@masonry")
local materials = masonry.materials

local Gate = module("Gate", "width", "depth", "height")

-- Half the width of the passage (m), and the height (m) at which its arch begins.
local OPEN, SPRING = 1.9, 3.2

-- Returns a gatehouse. Its passage runs along y, and its front faces -y.
return function(width: number, depth: number, height: number)
  local gate = lsystem({ object = extruder({ smooth = false }) })
  gate:axiom(Gate(width, depth, height))

  gate:interpret("Gate(width, depth, height)", function(this, width, depth, height)
    local half, front = width / 2, -depth / 2
    -- The front is a cross-section that is extruded inwards: along y, its second axis points down.
    local outline = { { -half, 2 }, { -OPEN, 2 } }
    for step = 0, 12 do
      local angle = math.rad(180 - step * 15)
      table.insert(outline, { math.cos(angle) * OPEN, -SPRING - math.sin(angle) * OPEN })
    end
    for _, point in { { OPEN, 2 }, { half, 2 }, { half, -height }, { -half, -height } } do
      table.insert(outline, point)
    end
    this:jump({ 0, front, 0 }):direction({ 0, 1, 0 }):material(materials.ashlar)
    this:polygon(outline):scale(1):extrude(depth)
    this:material(materials.dressed)
    for step = 0, 12 do
      local points = {}
      for _, corner in { { -6.6, 0 }, { -6.6, 0.62 }, { 6.6, 0.62 }, { 6.6, 0 } } do
        local angle, radius = math.rad(step * 15 + corner[1]), OPEN + corner[2]
        table.insert(points, { math.cos(angle) * radius, -SPRING - math.sin(angle) * radius })
      end
      this:jump({ 0, front - 0.12, 0 }):polygon(points):scale(1):extrude(0.5)
    end
    this:direction({ 0, 0, 1 })

    local along = vec(1, 0, 0)
    this:material(materials.oak)
    masonry.block(this, vec(0, depth / 2 - 1.2, -1), along, 2 * OPEN + 0.2, 0.25, SPRING + OPEN + 1)
    this:material(materials.iron)
    for bar = -3, 3 do
      masonry.block(this, vec(bar * 0.52, front + 0.8, SPRING - 1.4), along, 0.11, 0.11, OPEN + 1.4)
    end
    for bar = 0, 4 do
      masonry.block(this, vec(0, front + 0.8, SPRING - 1 + bar * 0.6), along, 2 * OPEN, 0.11, 0.11)
    end

    for side = -1, 1, 2 do
      local foot = vec(side * half * 0.42, front, height - 3.2)
      this:material(materials.dressed)
      masonry.block(this, foot, along, 0.7, 0.2, 2.1)
      this:material(materials.void)
      masonry.block(this, foot + vec(0, 0, 0.2), along, 0.24, 0.28, 1.7)
    end
    this:material(materials.dressed)
    masonry.block(this, vec(0, 0, height), along, width + 0.8, depth + 0.8, 0.35)
    local x, y, z = half + 0.15, depth / 2 + 0.15, height + 0.35
    local corners = { vec(-x, -y, z), vec(x, -y, z), vec(x, y, z), vec(-x, y, z) }
    for number, corner in corners do
      masonry.battlements.straight(this, corner, corners[number % 4 + 1])
    end
  end)

  return gate:derive()
end
