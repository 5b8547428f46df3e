--!strict
-- A twisting tower: parameters set its form, and a rule adds storey upon storey.
local floors = param("floors", { default = 34, min = 1, max = 120, step = 1, doc = "Number of storeys" })
local twist = param("twist", { default = 2.6, min = -12, max = 12, unit = "deg", doc = "Twist of a storey" })
local waist = param("waist", { default = 0.24, min = 0, max = 0.6, doc = "Depth of the waist" })

local Floor = module("Floor", "number")
local Storey = module("Storey", "radius")
local Crown = module("Crown", "radius")

-- The radius (m) of a storey: wide at the foot, narrow in the middle, wider again at the top.
local function radius(number: number): number
  local height = number / floors
  return 11 * (1 - waist * math.sin(math.pi * height) - 0.35 * height)
end

local tower = lsystem({ object = extruder({ smooth = false }) })

tower:axiom(Floor(0))

tower:rule("Floor(number)", function(this, number)
  if number == floors then
    return Crown(radius(number))
  end
  return Storey(radius(number)), Floor(number + 1)
end)

tower:interpret("Storey(radius)", function(this, radius)
  -- The slab juts out over the glass.
  this:rectangle(2, 2):twist(0):scale(radius)
  this:material({ color = "#efe9dd" }):extrude(0.45)
  this:scale(radius * 0.94):twist(twist)
  this:material({ color = "#55788c", roughness = 0.12 }):extrude(2.95)
end)

tower:interpret("Crown(radius)", function(this, radius)
  -- Without twist(0), the crown would twist as the last storey did.
  this:twist(0):scale(radius):material({ color = "#efe9dd" }):extrude(0.9)
  this:scale(radius * 0.6):taper(radius * 0.5):extrude(3)
  this:material({ color = "#9aa0a4", metallic = 1, roughness = 0.4 })
  this:scale(0.5):taper(0.06):extrude(16)
end)

tower:derive()
