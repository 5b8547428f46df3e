--!strict
-- Exports of require("@masonry"): the materials, wall templates and battlements of this package.
return {
  materials = require("./materials"),
  lancets = require("./lancets"),
  battlements = require("./battlements"),
  block = require("./blocks").block,
}
