--!strict
-- A custom object type: a street lantern. It inherits all methods of an extruder, and adds a lamp.

local lantern = object("lantern", {
  doc = "A street lantern: a mast with arms, each with a lamp that glows.",
  extends = extruder,
  fields = {
    height = { default = 5, min = 2, max = 12, unit = "m", doc = "From the ground to the arms." },
    glow = { default = "#ffd9a0", doc = "Colour of the light." },
    metal = { default = "#2b3338", doc = "Colour of the mast." },
  },
  state = { lamps = 0 },
  reads = {
    lamps = {
      doc = "How many lamps it has.",
      function(self)
        return self.lamps
      end,
    },
  },
  changes = {
    mast = {
      doc = "Draws the foot and the mast.",
      function(self)
        self:material({ color = self.metal, roughness = 0.45, metallic = 0.8 }):smooth(true):regular(24)
        -- The foot narrows into the shaft. Rings mark the bottom of the shaft and the base of the arms.
        self
          :scale(0.16)
          :extrude(0.12)
          :taper(0.1)
          :extrude(0.1)
          :scale(0.1)
          :extrude(0.5)
          :taper(0.06)
          :extrude(0.15)
        self:scale(0.085):extrude(0.04):scale(0.055):taper(0.04):extrude(self.height - 1.06)
        self:scale(0.07):extrude(0.05):scale(0.03):taper(0.004):extrude(0.25)
      end,
    },
    lamp = {
      doc = "Draws an arm that reaches out by `reach` (m) to the side at `toward` (degrees), and a lamp at its end.",
      function(self, reach: number, toward: number)
        self:jump({ 0, 0, self.height - 0.4 }):roll(toward):pitch(20)
        self:material({ color = self.metal, roughness = 0.45, metallic = 0.8 })
        self:regular(16):scale(0.022):bend(130, 270):extrude(reach * 1.7):bend(0)
        local at = self:position()
        -- The lamp hangs from the end of the arm: a cap, a glowing globe, and a knob below it.
        self:jump(at + vec(0, 0, 0.03)):direction({ 0, 0, -1 }):regular(24)
        self:scale(0.03):extrude(0.06):scale(0.05):taper(0.2):extrude(0.1):scale(0.21):extrude(0.02)
        self:material({ color = self.glow, emissive = self.glow, roughness = 0.3 })
        for ring = 1, 8 do
          local above, below = math.rad(40 + 14 * ring), math.rad(54 + 14 * ring)
          self:scale(0.2 * math.sin(above)):taper(0.2 * math.sin(below))
          self:extrude(0.2 * (math.cos(above) - math.cos(below)))
        end
        self:material({ color = self.metal, roughness = 0.45, metallic = 0.8 })
        self:scale(0.1):extrude(0.015):scale(0.03):taper(0.01):extrude(0.05)
        self.lamps += 1
      end,
    },
  },
})

local arms = param("arms", { default = 3, min = 1, max = 6, step = 1, doc = "Arms of a lantern" })
local height = param("height", { default = 4.5, min = 2, max = 12, unit = "m" })

local Mast = module("Mast")
local Bud = module("Bud", "toward")
local Arm = module("Arm", "toward")

local post = lsystem({ object = lantern({ height = height }) })
post:axiom(Mast(), Bud(0))

-- A rule reads the object: the bud makes arms until there are enough lamps. Each arm is a branch from the mast.
post:rule("Bud(toward)", function(this, toward)
  if this:lamps() < arms then
    return { Arm(toward) }, Bud(toward + 360 / arms)
  end
  return nil
end)

post:interpret("Mast", function(this)
  this:mast()
end)
post:interpret("Arm(toward)", function(this, toward)
  this:lamp(0.9, toward)
end)
post:ignore("Bud")
post:derive()

return lantern
