--!strict
-- The parts of a castle: require("@castle") returns functions that make models of them.
return {
  tower = require("./towers"),
  curtain = require("./curtain"),
  gatehouse = require("./gatehouse"),
  keep = require("./keep"),
}
