--!strict
-- A common pool of carbon: organs demand it, a hook divides it in proportion to the demands, and the apex makes a new
-- internode and a leaf as soon as the last internode is full. The three phases of a day are groups of rules.
-- Source: L-Py, tutorial/09 - carbon/globalpool, F. Boudon and C. Godin.
local days = param("days", { default = 90, min = 1, max = 300, step = 1, doc = "Number of days" })
local start = param("start", { default = 30, min = 1, max = 100, doc = "Carbon at the beginning" })
local FULL_LEAF, FULL_INTERNODE = 10, 5 -- carbon of an organ that does not grow any more
local GROWTH, UPKEEP, GAIN = 1, 0.3, 1 -- most in a day: for growth, for upkeep, and from a full leaf
local LEAF_SINK = 2 -- leaves are served twice as well as internodes

local Apex, Internode, Leaf = module("Apex"), module("Internode", "carbon"), module("Leaf", "carbon")

-- The share of their demand that the organs get, and the balance.
local pool = variables({ carbon = start, leaf_share = 0, internode_share = 0, gained = 0, spent = 0 })

local function upkeep(carbon: number, full: number): number
  return UPKEEP * math.min(carbon / full, 1)
end

local function demand(carbon: number, full: number): number
  return upkeep(carbon, full) + (if carbon < full then GROWTH else 0)
end

-- The carbon of an organ that gets a share of its demand. Without enough for its upkeep, it loses no carbon.
local function grown(carbon: number, full: number, share: number): number
  return carbon + math.max(demand(carbon, full) * share - upkeep(carbon, full), 0)
end

local plant = lsystem({ object = turtle({ color = "#6f8f3f" }), variables = pool, interpret = "last" })
plant:axiom(Internode(0), Apex())

local PHASES = { "allocate", "grow" }
plant:before_step(function(now)
  local phase = PHASES[(now.step - 1) % #PHASES + 1]
  use_group(phase)
  if phase == "allocate" then
    local leaves, internodes = 0, 0
    for _, leaf in query("select carbon from Leaf") do
      leaves += demand(leaf.carbon, FULL_LEAF)
      pool.carbon += GAIN * leaf.carbon / FULL_LEAF
      pool.gained += GAIN * leaf.carbon / FULL_LEAF
    end
    for _, internode in query("select carbon from Internode") do
      internodes += demand(internode.carbon, FULL_INTERNODE)
    end
    -- What the leaves do not need of their part is left for the internodes.
    local wanted = LEAF_SINK * leaves + internodes
    local for_leaves = math.min(leaves, if wanted > 0 then pool.carbon * LEAF_SINK * leaves / wanted else 0)
    local for_internodes = math.min(internodes, pool.carbon - for_leaves)
    pool.leaf_share = if leaves > 0 then for_leaves / leaves else 0
    pool.internode_share = if internodes > 0 then for_internodes / internodes else 0
    pool.carbon -= for_leaves + for_internodes
    pool.spent += for_leaves + for_internodes
  end
end)

plant:rule("Internode(carbon)", { group = "allocate" }, function(this, carbon)
  return Internode(grown(carbon, FULL_INTERNODE, pool.internode_share))
end)
plant:rule("Leaf(carbon)", { group = "allocate" }, function(this, carbon)
  return Leaf(grown(carbon, FULL_LEAF, pool.leaf_share))
end)
plant:rule("Internode(carbon) < Apex", {
  group = "grow",
  when = function(this, carbon)
    return carbon >= FULL_INTERNODE
  end,
}, function()
  return Roll(137.5), { Leaf(0) }, Internode(0), Apex()
end)
plant:ignore("Roll")
local blade = surface({
  { vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0) },
  { vec(-0.4, 0, 0.4), vec(0, 0.1, 0.4), vec(0.4, 0, 0.4) },
  { vec(0, 0.3, 1), vec(0, 0.3, 1), vec(0, 0.3, 1) },
}, { kind = "b-spline", degree = 2 })
plant:interpret("Internode(carbon)", function(this, carbon)
  this:width(0.9):forward(carbon)
end)
plant:interpret("Leaf(carbon)", function(this, carbon)
  this:color(mix("#c9d86f", "#3f7f3a", carbon / FULL_LEAF)):pitch(55):surface(blade, 1.2 * carbon)
end)
plant:interpret("Apex", function(this)
  this:color("#c9d86f"):sphere(0.5)
end)
local result = plant:derive(2 * days)

-- No carbon is lost: what was there and what leaves have gained is in the pool or was given to organs.
local last = result.variables
expect(last.carbon + last.spent, 30 + last.gained, 1e-9)
expect(result.counts.Internode, result.counts.Leaf + 1)
-- Picture: --azimuth 200 --elevation 12
