--!strict
-- What masons know: require("@masonry") gives the materials, wall templates and battlements of this package.
return {
  materials = require("./materials"),
  lancets = require("./lancets"),
  battlements = require("./battlements"),
  block = require("./blocks").block,
}
