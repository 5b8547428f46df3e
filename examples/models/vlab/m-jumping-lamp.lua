--!strict
-- A lamp that bends, jumps and lands: functions of time give the angles of its joints and the path of its foot. A film:
-- burgeon run examples/models/vlab/m-jumping-lamp.lua --frames 0:1:0.02 --elevation 8 -o lamp.gif
-- Source: Virtual Laboratory (cpfg), CPFG manual, JumpingLamp, University of Calgary.
local time = param("time", { default = 0.5, min = 0, max = 1, doc = "Time: 0 before the jump, 1 after it" })
local poses =
  param("poses", { default = 4, min = 1, max = 9, step = 1, doc = "Further poses in the picture" })
local jump = param("jump", { default = 1.6, min = 0, max = 4, unit = "m", doc = "Height of the jump" })
local distance =
  param("distance", { default = 4.5, min = 0, max = 9, unit = "m", doc = "Length of the jump" })
local ARM = 1 -- length of each of the two arms (m)

-- The inclination of the arms and of the shade (degrees): standing, crouching, stretched, landing, standing.
local lower =
  ramp({ { 0, -25 }, { 0.2, -60 }, { 0.35, 10 }, { 0.5, 5 }, { 0.7, -25 }, { 0.85, -60 }, { 1, -25 } })
local upper =
  ramp({ { 0, 50 }, { 0.2, 95 }, { 0.35, 25 }, { 0.5, 40 }, { 0.7, 50 }, { 0.85, 95 }, { 1, 50 } })
local shade =
  ramp({ { 0, 120 }, { 0.2, 150 }, { 0.35, 70 }, { 0.5, 95 }, { 0.7, 130 }, { 0.85, 150 }, { 1, 120 } })
-- The path of the foot, from take-off to landing.
local along = ramp({ { 0.3, 0 }, { 0.75, 1 } }, { kind = "linear" })

local function foot(at: number): Vector
  local part = along:at(at)
  return vec(distance * part, 0, jump * 4 * part * (1 - part))
end

local Lamp = module("Lamp", "time", "color")

local scene = lsystem({ object = turtle({ sides = 16, roughness = 0.35 }) })
local lamps: { any } = {}
for k = 1, poses do
  table.insert(lamps, { Lamp((k - 1) / math.max(poses - 1, 1), "#9fb4c8") })
end
table.insert(lamps, Lamp(time, "#c8452f"))
scene:axiom(sequence(lamps))
scene:interpret("Lamp(time, color)", function(this, at, color)
  this:jump(foot(at)):color(color):width(0.9):forward(0.06):width(0.12):advance(0.02)
  -- Angles are relative to the part below.
  this:roll(-90):pitch(-lower:at(at)):sphere(0.08):forward(ARM)
  this:pitch(lower:at(at) - upper:at(at)):sphere(0.08):forward(ARM):sphere(0.08)
  this:pitch(upper:at(at) - shade:at(at)):width(0.25):forward(0.2):width(0.75):forward(0.35)
  this:color("#f7e3a0"):sphere(0.2)
end)
local result = scene:derive(0)

-- In the middle of the jump, the foot is at half of the distance in the full height.
expect(foot(0.525):distance(vec(4.5 / 2, 0, 1.6)), 0, 1e-9)
-- The lamp lands as it stood: in the same pose, at the distance of the jump.
expect({ lower:at(1), upper:at(1), shade:at(1) }, { lower:at(0), upper:at(0), shade:at(0) })
expect(foot(1).x - foot(0).x, 4.5, 1e-9)
expect(result.counts.Lamp, 5)
-- Picture: --azimuth 180 --elevation 12
