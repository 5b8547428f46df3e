--!strict
-- Fibonacci numbers by context: each number becomes the sum of the two numbers on its left.
-- Source: L-Py, training/13-fibonacci, F. Boudon and C. Godin.
local length = param("length", { default = 20, min = 3, max = 40, step = 1, doc = "Numbers in the row" })

local Number = module("Number", "value")

local row = lsystem({ object = turtle({ heading = { 1, 0, 0 }, width = 0.6 }), interpret = "last" })
local chain = {}
for k = 1, length do
  chain[k] = Number(1)
end
row:axiom(table.unpack(chain))
row:rule("Number(a) Number(b) < Number(c)", function(this, a: number, b: number, c: number)
  return Number(a + b)
end)
row:interpret("Number(value)", function(this, value)
  local height = math.log(value) + 0.2
  return { Turn(90), Color(mix("#4763b0", "#e0a83f", height / 10)), F(height) }, G(0.8)
end)
local result = row:derive(length)

-- All 20 numbers are right after 18 steps. The twentieth Fibonacci number is 6765.
expect(result.chains[1]:match("Number%((%d+)%)$"), "6765")
-- Picture: --azimuth 180 --elevation 10
