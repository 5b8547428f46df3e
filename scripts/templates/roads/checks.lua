--!strict
-- Checks of the options of roads, and comparisons of headings.
local checks = {}

-- Refuses unknown fields of a table. The error is at the line of the caller's caller, or the given number of levels
-- up.
function checks.options(name: string, given: { [string]: any }, known: { [string]: string }, ...: number)
  for key, value in given do
    local kinds = known[key]
    if not kinds then
      local names = {}
      for each in known do
        table.insert(names, each)
      end
      table.sort(names)
      error(`{name} has no option {key}; it has {table.concat(names, ", ")}`, (...) or 3)
    elseif not string.find(kinds, type(value), 1, true) then
      error(`{name}: {key} is a {type(value)}, and must be a {kinds}`, (...) or 3)
    end
  end
end

-- Returns the number of an option, and refuses a number out of range, at the line of the caller's caller. (A function
-- with more arguments is not inlined, so its caller can be reported.)
function checks.number(
  name: string,
  value: any,
  usual: number,
  least: number,
  greatest: number,
  ...: number
): number
  local given = if value == nil then usual else value
  if type(given) ~= "number" or not (given >= least and given <= greatest) then
    local range = if greatest < math.huge then ` from {least} to {greatest}` else ""
    error(`{name} must be a number{range}, not {given}`, (...) or 3)
  end
  return given
end

-- Degrees from one heading to another, from -180 to 180.
function checks.between(from: number, to: number): number
  return (to - from + 180) % 360 - 180
end

-- The modules as a rule returns them; an empty list removes the rewritten module.
function checks.successor(modules: { any }): ...any
  if #modules == 0 then
    return nil
  end
  return table.unpack(modules)
end

-- The heading of a list that is nearest to another.
function checks.nearest(heading: number, headings: { number }): number
  local best = headings[1]
  for _, other in headings do
    if math.abs(checks.between(heading, other)) < math.abs(checks.between(heading, best)) then
      best = other
    end
  end
  return best
end

-- Returns two finite numbers, and refuses other values, as `number` does.
function checks.place(name: string, value: any, ...: number): { number }
  local x, y
  if type(value) == "table" then
    x, y = value[1], value[2]
  end
  if type(x) ~= "number" or type(y) ~= "number" or x - x ~= 0 or y - y ~= 0 then
    error(`{name} must be a place (m), such as \{ 0, 0 }`, (...) or 3)
  end
  return value
end

-- Returns a function that returns a number at a position, and refuses other values, as `number` does.
function checks.field(name: string, value: any, ...: number): (x: number, y: number) -> number
  if type(value) ~= "function" then
    error(
      `{name} must be a function of a place, function(x, y) return 0.5 end, not a {type(value)}`,
      (...) or 3
    )
  end
  return value
end

-- Returns the object of a constructor for `fields`; errors have the location that `number` uses.
function checks.construct(constructor: (fields: any) -> any, fields: any, ...: number): any
  local is_made, made = pcall(constructor, fields)
  if not is_made then
    error(made, (...) or 3)
  end
  return made
end

return checks
