--!strict
-- The growth of a red alga (Callithamnion roseum): ten states of cells, of which two put out branches.
-- Source: A. Lindenmayer, Mathematical models for cellular interactions in development, part II, 1968.
local steps = param("steps", { default = 11, min = 0, max = 16, step = 1, doc = "Steps of growth" })
local angle =
  param("angle", { default = 40, min = 10, max = 80, unit = "deg", doc = "Angle of the branches" })

local Cell, Side = module("Cell", "state"), module("Side", "angle")

local alga = lsystem({ object = turtle({ width = 0.45, sides = 8 }), interpret = "last" })
alga:axiom(Cell(4))
local successors: any = {
  [0] = { 1, 0 },
  { 3, 2 },
  { 3, branch = 4 },
  { 3 },
  { 5, 6 },
  { 3, 7 },
  { 5, 8 },
  { 3, branch = 9 },
  { 5, 0 },
  { 3, 9 },
}
alga:rule("Cell(state)", function(this, state): any
  local next = successors[state]
  if next.branch then
    return Cell(next[1]), { Side(if step() % 2 == 0 then angle else -angle), Cell(next.branch) }
  elseif next[2] then
    return Cell(next[1]), Cell(next[2])
  end
  return Cell(next[1])
end)
alga:interpret("Cell(state)", function(this, state)
  return Color(if state == 3 then "#a83a5a" elseif state == 9 or state == 0 then "#f0b0a0" else "#d0607a"),
    F(0.9),
    G(0.1)
end)
alga:interpret("Side(angle)", function(this, a)
  return Turn(a)
end)
local result = alga:derive(steps)

-- The string after eleven steps, as published: branches in brackets, states as digits.
local text = result.chains[1]:gsub("Side%(%-?%d+%)", ""):gsub("%a+%((%d)%)", "%1"):gsub("[%s]", "")
local from, to =
  text:find("33[333333339]33[33333339]33[3333339]33[33[339]33[39]33[9]3210]33[33[39]3", 1, true)
expect(from, 1)
-- Picture: --azimuth 180 --elevation 0
