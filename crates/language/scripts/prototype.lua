-- A post that draws itself in `begin`, built once and placed three times.
local post = object("post", {
  extends = extruder,
  begin = function(self)
    self:scale(0.1):extrude(2)
  end,
})
local model = prototype(post)
local fence = lsystem({ object = turtle() })
fence:axiom(Place(model), G(2), Place(model), G(2), Place(model))
fence:derive()
