--!strict
-- A warehouse with soot below its cornice: bricks by one set of texture coordinates, dirt over the whole wall by a second one.
local soot = param("soot", { default = true, doc = "Dirt on the walls" })

-- Bricks of 25 cm by 6.5 cm; the dirt lies once on each wall, by the set "wall".
local brick = {
  texture = "brick.jpg",
  texture_size = { 1, 0.52 },
  dirt = if soot then "grime.jpg" else nil,
  dirt_set = if soot then "wall" else nil,
  dirt_size = if soot then { 12, 9 } else nil,
  roughness = 0.9,
  name = "brick",
}
local stone = {
  color = "#d8cfba",
  dirt = brick.dirt,
  dirt_set = brick.dirt_set,
  dirt_size = brick.dirt_size,
  roughness = 0.85,
  name = "stone",
}
local cornice = { color = "#cfc6b2", roughness = 0.85, name = "cornice" }
local frame = { color = "#2f3a38", roughness = 0.5, name = "frame" }
local glass = { color = "#22303a", roughness = 0.08, metallic = 0.4, name = "glass" }

local Mass, Wall, Storey = module("Mass", "shape"), module("Wall", "face"), module("Storey", "face")
local Bay, Column, Opening = module("Bay", "face"), module("Column", "face"), module("Opening", "face")
local Stone, Window, Pane = module("Stone", "face", "depth"), module("Window", "face"), module("Pane", "face")
local Frame, Glass = module("Frame", "face"), module("Glass", "face")

local house = lsystem({ object = extruder() })
house:axiom(Mass(cuboid(13.5, 8.4, 9.6)))

house:rule("Mass(s)", function(this, s: Shape)
  local top = s:faces("top")[1]
  return components(s, "faces", { { "side", Wall }, { "top", Draw } }),
    Draw(
      top
        :molding({ { -0.4, -0.2 }, { 0.12, -0.2 }, { 0.3, 0.15 }, { 0.3, 0.35 }, { -0.4, 0.35 } })
        :material(cornice)
    )
end)

-- Both projections belong to the whole wall. All parts of it keep them.
house:rule("Wall(face)", function(this, face: Shape)
  local size = face:size()
  local wall = face:material(brick):project(1, 0.52):project(size.x, size.y, { set = "wall" })
  return split(wall, "y", { { 0.5, Storey }, { { "~3", Storey } } })
end)

house:rule("Storey(face)", function(this, face: Shape)
  if face:size().y < 1 then
    return Draw(face:extrude(0.08))
  end
  return split(face, "x", { { 0.45, Draw }, { { "~2.1", Bay } }, { 0.45, Draw } })
end)

house:rule("Bay(face)", function(this, face: Shape)
  return split(face, "x", { { "~1", Draw }, { 1.15, Column }, { "~1", Draw } })
end)

house:rule("Column(face)", function(this, face: Shape)
  return split(
    face,
    "y",
    { { 0.75, Draw }, { 0.12, Stone, 0.1 }, { 1.6, Opening }, { 0.24, Stone, 0.04 }, { "~1", Draw } }
  )
end)

-- The stones are bricks no more, and have the dirt of the wall around them.
house:rule("Stone(face, depth)", function(this, face: Shape, depth: number)
  return Draw(face:extrude(depth):material(stone))
end)

house:rule("Opening(face)", function(this, face: Shape)
  return components(
    face:recess(0.24),
    "faces",
    { { "tag:recess.side", Draw }, { "tag:recess.back", Window } }
  )
end)

house:rule("Window(face)", function(this, face: Shape)
  return split(face, "x", { { 0.06, Frame }, { { "~0.5", Pane }, { 0.05, Frame } }, { 0.06, Frame } })
end)
house:rule("Pane(face)", function(this, face: Shape)
  return split(face, "y", { { 0.06, Frame }, { { "~0.5", Glass }, { 0.05, Frame } }, { 0.06, Frame } })
end)
house:rule("Frame(face)", function(this, face: Shape)
  return Draw(face:extrude(0.05):material(frame))
end)
house:rule("Glass(face)", function(this, face: Shape)
  return Draw(face:material(glass))
end)

house:derive()
camera({ name = "warehouse", from = { -6.5, -15.5, 2.6 }, to = { 3.6, 0, 4.7 }, fov = 40 })
