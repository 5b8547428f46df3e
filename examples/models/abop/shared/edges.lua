--!strict
-- Edge rewriting: L and R are edges of the same length, and a rule replaces an edge by a path of edges.

--- Derives the system of `plant`, which are the arguments of abop, in a number of steps. Draws each edge.
return function(plant: { [string]: any }, steps: number): Derived
  local curve = abop(plant)
  for _, letter in { "L", "R" } do
    curve:interpret(letter, function(this)
      this:forward()
    end)
  end
  return curve:derive(steps)
end
