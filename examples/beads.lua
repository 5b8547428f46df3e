--!strict
-- A string of beads that stops at a given height.
local Bead = module("Bead")
local Thread = module("Thread")

local string_of_beads = lsystem({ object = beads({ radius = 0.3, color = "#b03a2e" }) })

string_of_beads:axiom(Thread())

string_of_beads:rule("Thread", {
  when = function(this)
    return this:height() < 7
  end,
}, function()
  return Bead(), Thread()
end)

string_of_beads:interpret("Bead", function(this)
  this:add()
end)

string_of_beads:derive()
