--!strict
-- Elements of buildings: require("@elements") returns a table of these rooms. Each function takes a face or a solid and a
-- table of options, and returns a list of shapes. Lengths are in metres.
return {
  outlines = require("./outlines"),
  openings = require("./openings"),
  tracery = require("./tracery"),
  columns = require("./columns"),
  cornices = require("./cornices"),
  balustrades = require("./balustrades"),
  stairs = require("./stairs"),
  bays = require("./bays"),
  supports = require("./supports"),
  roofs = require("./roofs"),
}
