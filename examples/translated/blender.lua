--!strict
-- A spiral of blocks, translated from a Python script for Blender.
local count = param("count", { default = 90, min = 5, max = 300, step = 1, doc = "Number of blocks" })

local Cube = module("Cube", "i")

-- bpy.data.materials.new(...) is a colour here, and a mesh object is a module.
local spiral = lsystem({ object = extruder({ smooth = false, roughness = 0.4 }) })

-- for i in range(count):
local cubes = {}
for i = 0, count - 1 do
  table.insert(cubes, { Cube(i) })
end
spiral:axiom(sequence(cubes))

--     angle = i * 0.22;  r = 0.6 + 0.045 * i
--     bpy.ops.mesh.primitive_cube_add(size=0.45, location=(r*cos(angle), r*sin(angle), 0), rotation=(0, 0, angle))
--     bpy.context.object.scale.z = 0.4 + 2.2 * (1 + sin(i * 0.3)) / 2
spiral:interpret("Cube(i)", function(this, i)
  local angle, r = i * 0.22, 0.6 + 0.045 * i
  local tall = 0.4 + 2.2 * (1 + math.sin(i * 0.3)) / 2
  this:color(hsv(200 + 120 * i / count, 0.5, 0.85)):jump({ r * math.cos(angle), r * math.sin(angle), 0 })
  this:roll(math.deg(angle)):rectangle(0.45, 0.45):extrude(tall)
end)

spiral:derive()
