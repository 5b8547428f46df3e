--!strict
-- The pipe model: each leaf is connected to the base by a pipe, which remains in the stem when the leaf has died.
-- Source: Virtual Laboratory (cpfg), Quantitative-info-flow/01-pipe-model, University of Calgary, after K. Shinozaki,
-- K. Yoda, K. Hozumi and T. Kira, A quantitative analysis of plant form: the pipe model theory, 1964.
local steps = param("steps", { default = 256, min = 0, max = 400, step = 1, doc = "Steps of growth" })
local life =
  param("life", { default = 53, min = 1, max = 200, step = 1, unit = "steps", doc = "Life of a leaf" })
local width = param("width", { default = 0.12, min = 0.01, max = 0.3, unit = "m", doc = "Width of one pipe" })

local Apex, Leaf = module("Apex", "wait"), module("Leaf", "left")
local Pipes = module("Pipes", "alive", "dead")

local plant = lsystem({ object = turtle({ angle = 45, sides = 10 }), interpret = "last" })
plant:consider("Pipes", "Leaf")
plant:axiom(Apex(16))
plant:rule("Apex(wait)", function(this, wait)
  if wait > 0 then
    return Apex(wait - 1)
  end
  return { Left(), Pipes(1, 0), Leaf(life) }, Pipes(1, 0), F(1), Roll(180), Apex(16)
end)
plant:rule("Leaf(left)", function(this, left: number)
  return Leaf(math.max(left - 1, 0))
end)
plant:rule("Pipes(alive, dead) > Leaf(left)", function(this, alive, dead, left)
  return if left == 0 then Pipes(0, 1) else Pipes(alive, dead)
end)
plant:rule(
  "Pipes(a, d) > [Pipes(b, e)] Pipes(c, f)",
  function(this, a: number, d: number, b: number, e: number, c: number, f: number)
    return Pipes(b + c, e + f)
  end
)

plant:interpret("Pipes(alive, dead)", function(this, alive, dead)
  return Color(mix("#7a5a3a", "#6fae48", alive / (alive + dead))), Width(width * (alive + dead))
end)
plant:interpret("Leaf(left)", function(this, left: number)
  return Color(if left > 0 then "#4fa83d" else "#a8894a"),
    F(0.4),
    {
      BeginPolygon(),
      Point(),
      Turn(30),
      G(0.6),
      Point(),
      Turn(-60),
      G(0.6),
      Point(),
      Turn(-120),
      G(0.6),
      Point(),
      EndPolygon(),
    }
end)
local tree = plant:derive(steps)

-- A metamer appears every 17 steps, and its pipe reaches the base after one step per internode: the pipes of the
-- first 14 metamers are there after 256 steps, the last one in the step 14 * 17 + 13. Leaves die after 53 steps.
expect(tree.counts.Leaf, 256 // 17)
local alive, dead = tree.chains[1]:match("%] Pipes%((%d+),(%d+)%)")
expect(tonumber(alive or 0) :: number + tonumber(dead or 0) :: number, 14)
-- Picture: --azimuth 180 --elevation 0
