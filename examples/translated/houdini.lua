--!strict
-- Copies on points, translated from Houdini: scatter, attributes in a wrangle, and copy to points.
local count = param("count", { default = 260, min = 10, max = 1000, step = 10, doc = "Number of points" })

-- The geometry of the second input of Copy to Points: a crystal.
local Crystal = module("Crystal")
local source_geometry =
  lsystem({ object = extruder({ sides = 6, smooth = false, color = "#7fb6c9", roughness = 0.1 }) })
source_geometry:axiom(Crystal())
source_geometry:interpret("Crystal", function(this)
  this:scale(0.12):taper(0.15):extrude(0.8):taper(0.01):extrude(0.3)
end)
local crystal = source_geometry:derive()

-- Scatter: a point is a module, and its attributes are its parameters.
local Scatter, Point3 = module("Scatter"), module("Pt", "P", "N", "pscale")
local copies = lsystem({ object = turtle({ color = "#6d6259", sides = 24 }) })
copies:axiom(Scatter())
copies:rule("Scatter", function(this)
  local points = {}
  for number = 1, count do
    -- @P on a half sphere, and in the wrangle: @N = normalize(@P); @pscale = fit01(rand(@ptnum), 0.4, 1.5);
    local z, turn = math.sqrt(random()), random(0, 2 * math.pi)
    local flat = math.sqrt(1 - z * z)
    local N = vec(flat * math.cos(turn), flat * math.sin(turn), z)
    local pscale = lerp(0.4, 1.5, random() ^ 2) * (0.5 + 0.7 * z)
    table.insert(points, { Point3(N * 0.9, N, pscale) })
  end
  return Scatter(), sequence(points)
end)
copies:interpret("Scatter", function(this)
  this:sphere(1)
end)
copies:interpret("Pt(P, N, pscale)", function(this, P, N, pscale)
  this:jump(P):face(N):place(crystal, pscale)
end)
copies:derive(1)
