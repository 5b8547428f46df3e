--!strict
-- A plant with opposite leaves, translated from L-Py.
local N = param("N", { default = 9, min = 1, max = 16, step = 1, doc = "Number of nodes" })

local A, L = module("A", "n"), module("L", "age")

local plant = lsystem({ object = turtle({ width = 0.04, color = "#6f8d45", sides = 10 }) })

-- Axiom: _(0.02)A(0)
plant:axiom(A(0))

-- A(n): if n < N: nproduce F(1)[&(50)L(0)][^(50)L(0)]/(90)A(n+1)   else: produce @O(0.1)
plant:rule("A(n)", function(this, n)
  if n < N then
    return F(0.3), { Pitch(50), L(0) }, { Up(50), L(0) }, RollLeft(90), A(n + 1)
  end
  return Color("#d9648c"), Sphere(0.09)
end)

-- L(age): produce L(age+1)
plant:rule("L(age)", {
  when = function(this, age)
    return age < N
  end,
}, "L(age + 1)")

-- interpretation: L(age): produce ,(2)~l(age*0.1)
local blade = surface({
  { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 } },
  { { -0.4, 0.1, 0.3 }, { -0.13, -0.05, 0.3 }, { 0.13, -0.05, 0.3 }, { 0.4, 0.1, 0.3 } },
  { { -0.35, 0.05, 0.7 }, { -0.1, -0.1, 0.7 }, { 0.1, -0.1, 0.7 }, { 0.35, 0.05, 0.7 } },
  { { 0, -0.2, 1 }, { 0, -0.2, 1 }, { 0, -0.2, 1 }, { 0, -0.2, 1 } },
})
plant:interpret("L(age)", function(this, age)
  this:width(0.015):forward(0.06):color("#5f9440"):surface(blade, 0.1 + age * 0.055)
end)

plant:derive(N + 1)
