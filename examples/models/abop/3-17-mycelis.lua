--!strict
-- Mycelis muralis: a flowering signal climbs the stem, one node per step. The apex becomes a flower and sends down a
-- signal that releases the buds, so that the topmost branch grows first, and one at half the speed that lets the
-- branches flower. The lower branches have more time to grow.
-- Source: P. Prusinkiewicz and A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, chapter 3, Mycelis muralis.
local angle =
  param("angle", { default = 30, min = 10, max = 60, unit = "deg", doc = "Between stem and branches" })
local petals = param("petals", { default = "#e8c52f", doc = "Colour of the flowers" })

local Delay, Apex, Bud, Flower =
  module("Delay", "time"), module("Apex", "time"), module("Bud"), module("Flower")
local Node, Climbing, Release, Descent, Pause =
  module("Node"), module("Climbing"), module("Release"), module("Descent"), module("Pause")

local function stage(steps: number, x: number): any
  local pen = turtle({ position = { x, 0, 0 }, width = 0.35, color = "#5d8a44", sides = 5 })
  local plant = lsystem({ object = pen, interpret = "last" })
  -- A pause separates the two signals. If contexts did not see it, they would have the same speed.
  plant:consider("Node", "Climbing", "Release", "Descent", "Pause")
  plant:axiom(Delay(20), F(), Apex(0))

  plant:rule("Climbing < Apex(t)", "Release Descent Flower")
  plant:rule("Descent < Apex(t)", "Release Descent Flower")
  plant:rule("Apex(t)", function(this, t: number): any
    if t > 0 then
      return Apex(t - 1)
    end
    return Node(), { Left(angle), Bud() }, F(), RollRight(180), Apex(2)
  end)
  plant:rule("Climbing < Node", "Climbing")
  plant:rule("Climbing > Release", "Release")
  plant:rule("Release < Bud", "F Apex(2)")
  plant:rule("Descent < Node", "Climbing")
  plant:rule("Release > Descent", "Pause")
  plant:rule("Pause", "Descent")
  plant:rule("Delay(t)", function(this, t: number)
    return if t > 0 then Delay(t - 1) else Climbing()
  end)

  plant:interpret("Flower", function(this)
    this:forward(0.3)
    this:color(petals):sphere(0.45)
  end)
  return plant:derive(steps).counts
end

-- Nodes appear in steps 1, 4, 7 and so on; the signal starts in step 21 and takes a node in each step. It has all 11
-- nodes in step 32 and the apex in step 33.
local counts = stage(33, 0)
expect({ counts.Climbing, counts.Release, counts.Flower, counts.Node }, { 1 + 11, 1, 1, 0 })
for k, steps in { 45, 60, 110 } do
  stage(steps, k * 9 - 2)
end

-- Picture: --azimuth 180 --elevation 0
