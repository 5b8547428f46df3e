--!strict
-- Roads from a word of characters.
local checks = require("checks")
local usual = require("options")

local words = {}

local number = checks.number

-- A symbol of a word: its character, the side of the next branch, and the depth of its road.
local Letter = module("Letter", "name", "side", "depth")
-- Turns to a side, 1 for left, at a branch.
local Branch = module("Branch", "side")
-- Removes remaining symbols.
local Tidy = module("Tidy")

local WORD = {
  axiom = "string",
  productions = "table",
  iterations = "number",
  bend = "number",
  branch = "number",
  split = "string",
  lengths = "table",
  heading = "number",
  network = "table",
  join = "number",
  detour = "number",
  dead_ends = "string",
}
-- The maximum number of symbols of a word.
local LONGEST = 500000

-- A word as a list of characters, with a nested list for each branch; refuses invalid words. Every character except
-- brackets and white space is a symbol.
local function parsed(what: string, word: string, ...: any): { any }
  if type(word) ~= "string" or not utf8.len(word) then
    error(`roads.word: {what} must be a word of characters, not {word}`, 3)
  end
  local open: { { any } } = { {} }
  local place = 0
  for _, code in utf8.codes(word) do
    local name = utf8.char(code)
    place += 1
    if name == "[" then
      local branch: { any } = {}
      table.insert(open, branch)
    elseif name == "]" then
      local branch = table.remove(open)
      if #open == 0 then
        error(`roads.word: {what} "{word}" has a ] at {place} that closes no [`, 3)
      end
      table.insert(open[#open], branch)
    elseif not string.find(name, "%s") then
      table.insert(open[#open], name)
    end
  end
  if #open > 1 then
    error(`roads.word: {what} "{word}" has {#open - 1} [ without a ]`, 3)
  end
  return open[1]
end

-- The number of occurrences of each symbol in a word.
local function counted(tree: { any }, counts: { [string]: number })
  for _, item in tree do
    if type(item) == "table" then
      counted(item, counts)
    else
      counts[item] = (counts[item] or 0) + 1
    end
  end
  return counts
end

-- An angle (degrees) that does not turn a road back onto itself.
local function angle(name: string, value: any, usual: number, ...: any): number
  local given = number(`roads.word: {name}`, value, usual, -360, 360, 4)
  if given % 180 == 0 then
    error(`roads.word: a {name} of {given} degrees leads a road onto itself; give one between 0 and 180`, 3)
  end
  return given
end

-- A system whose network is built by a word, which `productions` rewrite `iterations` times: { X = "F[X]FX" }, or a
-- list of words for a random choice. F builds a street with the length (m) of its depth in `lengths`, + and - turn by
-- `bend` (degrees), [ saves position and heading and leaves by `branch` (degrees), ] restores them. Symbols without a
-- production are copied. `split` sets the branches: "symmetric" to the left, while the road itself turns to the right
-- by the same angle; "alternate" alternately to the left and to the right; "plain" by the + and - within them.
function words.word(options: { [string]: any })
  checks.options("roads.word", options, WORD)
  local productions: { [string]: any } = options.productions or { X = { "F[X]F+X", "F[X]F-X", "F[X]FX" } }
  local iterations = number("roads.word: iterations", options.iterations, 6, 0, 30)
  local bend = angle("bend", options.bend, 20)
  local branch = angle("branch", options.branch, 90)
  local split = options.split or "alternate"
  if not table.find({ "symmetric", "alternate", "plain" }, split) then
    error(`roads.word: split is "symmetric", "alternate" or "plain", not "{split}"`, 2)
  end
  local lengths = options.lengths or { 110, 85, 70 }
  if #lengths == 0 then
    error("roads.word: lengths has no length; write lengths = { 110, 85 }", 2)
  end
  for depth, length in lengths do
    number(`roads.word: the length for depth {depth - 1}`, length, 80, 1, 10000)
  end
  local join = number("roads.word: join", options.join, 120, 0, 2000)
  local detour = number("roads.word: detour", options.detour, 2, 1, 100)
  local dead_ends = options.dead_ends or "keep"
  if dead_ends ~= "keep" and dead_ends ~= "remove" then
    error(`roads.word: dead_ends is "keep" or "remove", not "{dead_ends}"`, 2)
  end

  local trees: { [string]: { { any } } } = {}
  local growth: { [string]: { [string]: number } } = {}
  for name, list in productions do
    if type(name) ~= "string" or utf8.len(name) ~= 1 or string.find(name, "[%[%]%s]") then
      error(
        `roads.word: a production of {name} cannot be: one character is rewritten, which is no bracket and no white space`,
        2
      )
    end
    trees[name], growth[name] = {}, {}
    for _, word in if type(list) == "table" then list else { list } do
      local tree = parsed(`the production of {name},`, word)
      table.insert(trees[name], tree)
      for symbol, count in counted(tree, {}) do
        growth[name][symbol] = math.max(growth[name][symbol] or 0, count)
      end
    end
    if #trees[name] == 0 then
      error(`roads.word: {name} has an empty list of productions`, 2)
    end
  end
  local axiom = parsed("the axiom", options.axiom or "X")

  -- The maximum length of the word is computed in advance.
  local counts = counted(axiom, {})
  for step = 1, iterations do
    local after: { [string]: number } = {}
    local all = 0
    for symbol, count in counts do
      for each, times in growth[symbol] or { [symbol] = 1 } do
        after[each] = (after[each] or 0) + count * times
        all += count * times
      end
    end
    counts = after
    if all > LONGEST then
      error(
        `roads.word: after {step} of {iterations} iterations the word may have {all} symbols, and the limit is {LONGEST}; iterate less often, or shorten the productions`,
        2
      )
    end
  end

  -- The network allows the angles of the word, down to its own limit of 10 degrees.
  local leaves = if split == "plain" then bend else branch
  local sharpest = math.min(leaves % 180, 180 - leaves % 180)
  local sharp = math.clamp(sharpest, 10, 50)
  local fields: any = { streets = usual.STREETS, min_angle = sharp, snap = 25 }
  for name, value in options.network or {} do
    fields[name] = value
  end
  local system = lsystem({ object = checks.construct(network, fields) :: Network, interpret = "last" })

  -- The modules of a word.
  local function modules(tree: { any }, side: number, depth: number): { any }
    local list: { any } = {}
    for _, item in tree do
      if type(item) == "table" then
        local inner = modules(item, -side, depth + 1)
        if split ~= "plain" then
          table.insert(inner, 1, Branch(side))
        end
        table.insert(list, inner)
        if split == "alternate" then
          side = -side
        elseif split == "symmetric" then
          table.insert(list, Branch(-side))
        end
      else
        table.insert(list, Letter(item, side, depth))
      end
    end
    return list
  end

  local chain = modules(axiom, 1, 0)
  table.insert(chain, 1, Branch(0))
  table.insert(chain, Tidy())
  system:axiom(table.unpack(chain))
  system:rule("Letter(name, side, depth)", function(_, name: string, side: number, depth: number)
    local choices = trees[name]
    if not choices then
      return Letter(name, side, depth)
    end
    local drawn = if #choices > 1 then math.min(#choices, 1 + math.floor(random() * #choices)) else 1
    return table.unpack(modules(choices[drawn], side, depth))
  end)

  local heading = number("roads.word: heading", options.heading, 90, -360, 360)
  system:interpret(
    "Letter(name, side, depth)",
    function(this: Network, name: string, _: number, depth: number)
      if name == "F" then
        this:walk(lengths[math.min(depth + 1, #lengths)])
      elseif name == "+" then
        this:turn(-bend)
      elseif name == "-" then
        this:turn(bend)
      end
    end
  )
  system:interpret("Branch(side)", function(this: Network, side: number)
    -- The first symbol sets the initial direction of the road.
    this:turn(if side == 0 then heading else side * branch)
  end)
  system:interpret("Tidy", function(this: Network)
    this:join_dead_ends(join, detour)
    if dead_ends == "remove" then
      this:remove_dead_ends()
    end
  end)
  return system
end

return words
