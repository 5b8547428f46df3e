--!strict
-- A tree by space colonisation: points of a crown attract the nearest node, and vanish when a node comes near.
-- Hooks find the mean direction of the points of each node, and a node with such a direction grows by a segment.
-- Source: A. Runions, B. Lane and P. Prusinkiewicz, Modeling trees with a space colonization algorithm, 2007.
local count = param("count", { default = 1000, min = 10, max = 3000, step = 1, doc = "Attraction points" })
local segment =
  param("segment", { default = 0.2, min = 0.1, max = 1, unit = "m", doc = "Length of a segment" })
local reach = param("reach", { default = 12, min = 2, max = 40, unit = "segments", doc = "Attraction" })
local near = param("near", { default = 2, min = 1, max = 8, unit = "segments", doc = "Where points vanish" })
local steps = param("steps", { default = 60, min = 1, max = 200, step = 1, doc = "Steps of growth" })
local TIP, EXPONENT = 0.02, 2.3 -- width (m) of a tip, and exponent of the sum where branches join

-- The name of a child is that of its parent and a number.
local Node = module("Node", "x", "y", "z", "name", "children")

-- Points in an ellipsoid.
local points: { Vector } = {}
local draw = stream("points")
while #points < count do
  local place = vec(draw(-1, 1), draw(-1, 1), draw(-1, 1))
  if place:length() <= 1 then
    table.insert(points, vec(place.x * 2.4, place.y * 2.4, 3.6 + place.z * 1.8))
  end
end

local leaf = surface({
  { vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0) },
  { vec(-0.35, 0.1, 0.4), vec(0, 0, 0.4), vec(0.35, 0.1, 0.4) },
  { vec(0, 0.2, 1), vec(0, 0.2, 1), vec(0, 0.2, 1) },
}, { kind = "b-spline", degree = 2, divisions = 3 })

local crown = variables({
  left = points,
  pull = {} :: { [string]: Vector },
  width = {} :: { [string]: number },
})

type NodePlace = { name: string, place: Vector }

local function nodes(): { NodePlace }
  local list: { NodePlace } = {}
  for k, row in query("select name, x, y, z from Node") do
    list[k] = { name = row.name, place = vec(row.x, row.y, row.z) }
  end
  return list
end

local pen = turtle({ color = "#6d543c", sides = 5 })
local tree = lsystem({ object = pen, variables = crown, interpret = "last" })
tree:axiom(Node(0, 0, 0, "0", 0))
tree:before_step(function()
  local all, pull = nodes(), {} :: { [string]: Vector }
  for _, point: Vector in crown.left do
    local best, distance = "", reach * segment
    for _, node in all do
      local away = point:distance(node.place)
      if away < distance then
        best, distance = node.name, away
      end
    end
    for _, node in if best == "" then {} else all do
      if node.name == best then
        pull[best] = (pull[best] or vec(0, 0, 0)) + (point - node.place):unit()
      end
    end
  end
  crown.pull = pull
  -- Widths from the tips to the root: the names of children are longer than that of their parent.
  table.sort(all, function(a: NodePlace, b: NodePlace): boolean
    return if #a.name == #b.name then a.name < b.name else #a.name > #b.name
  end)
  local load: { [string]: number }, width = {}, {} :: { [string]: number }
  for _, node in all do
    local sum = load[node.name] or TIP ^ EXPONENT
    width[node.name] = sum ^ (1 / EXPONENT)
    local parent = string.match(node.name, "^(.*)%.%d+$") or ""
    load[parent] = (load[parent] or 0) + sum
  end
  crown.width = width
end)
tree:rule("Node(x, y, z, name, children)", {
  when = function(this, x, y, z, name, children)
    return crown.pull[name] ~= nil and crown.pull[name]:length() > 0 and children < 6
  end,
}, function(this, x, y, z, name, children)
  local place = vec(x, y, z) + crown.pull[name]:unit() * segment
  return Node(x, y, z, name, children + 1), { Node(place.x, place.y, place.z, `{name}.{children + 1}`, 0) }
end)
tree:after_step(function()
  local all = nodes()
  local left: { Vector } = {}
  for _, point: Vector in crown.left do
    local is_free = true
    for _, node in all do
      is_free = is_free and point:distance(node.place) > near * segment
    end
    if is_free then
      left[#left + 1] = point
    end
  end
  crown.left = left
  if #left == 0 then
    stop()
  end
end)
tree:interpret("Node(x, y, z, name, children)", function(this, x, y, z, name, children)
  local along = vec(x, y, z) - this:position()
  if along:length() > 0 then
    this:face(along):width(crown.width[name] or TIP):forward(along:length())
  else
    this:width(crown.width[name] or TIP)
  end
  if (crown.width[name] or TIP) < 1.8 * TIP then
    this:color("#6f9f48"):roll(random(0, 360)):pitch(50):surface(leaf, 0.32)
  end
end)
local result = tree:derive(steps)

-- No point is left: each has been reached by a node.
expect(#result.variables.left, 0)
-- Picture: --azimuth 180 --elevation 12
