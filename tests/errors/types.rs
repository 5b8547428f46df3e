//! Errors of script-declared object types.

use insta::assert_snapshot;

use crate::support::{refused, stopped};

#[test]
fn a_declaration_that_means_nothing_is_refused() {
    assert_snapshot!(refused("object(\"lamp\", { chnages = {} })"), @r#"
    error: s.lua:1:18: unknown part `chnages` of object lamp
      | object("lamp", { chnages = {} })
      |                  ^^^^^^^
      help: did you mean changes?
    "#);
    assert_snapshot!(refused("object(\"Street lamp\", {})"), @r#"
    error: s.lua:1:9: "Street lamp" is not a valid name of an object type
      | object("Street lamp", {})
      |         ^^^^^^^^^^^
      help: use lowercase letters, digits and _, such as "street_lamp"
    "#);
    assert_snapshot!(refused("object({})"), @r#"
    error: s.lua:1:1: the first argument of object must be the type name
      | object({})
      | ^^^^^^
      help: write object("lantern", { changes = { lamp = function(self) ... end } })
    "#);
    assert_snapshot!(refused("object(\"lamp\")"), @r#"
    error: s.lua:1:1: the second argument of object must be a table
      | object("lamp")
      | ^^^^^^
      help: write object("lantern", { changes = { lamp = function(self) ... end } })
    "#);
    assert_snapshot!(refused("object(\"lamp\", { extends = extruder() })"), @r#"
    error: s.lua:1:1: object lamp: extends must be the constructor of a type
      | object("lamp", { extends = extruder() })
      | ^^^^^^
      help: write extends = extruder, without a table after it
    "#);
    assert_snapshot!(refused("object(\"lamp\", { extends = elevation })"), @r#"
    error: s.lua:1:1: elevation is not made of fields, so lamp cannot extend it
      | object("lamp", { extends = elevation })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
    "#);
    assert_snapshot!(refused("object(\"lamp\", { changes = { go = 3 } })"), @r#"
    error: s.lua:1:30: go of changes of object lamp must be a function, not a number
      | object("lamp", { changes = { go = 3 } })
      |                              ^^
      help: write name = function(self, ...) ... end, or name = { doc = "...", function(self, ...) ... end }
    "#);
    assert_snapshot!(refused("object(\"lamp\", { fields = { height = { defualt = 3 } } })"), @r#"
    error: s.lua:1:40: field lamp.height: unknown key `defualt`
      | object("lamp", { fields = { height = { defualt = 3 } } })
      |                                        ^^^^^^^
      help: did you mean default?
    "#);
    assert_snapshot!(refused("object(\"lamp\", { fields = { height = { default = 3, min = 4 } } })"), @r#"
    error: s.lua:1:29: lamp: height must be 4 or more, not 3
      | object("lamp", { fields = { height = { default = 3, min = 4 } } })
      |                             ^^^^^^
    "#);
    assert_snapshot!(refused("object(\"lamp\", { fields = { height = { doc = \"How high.\" } } })"), @r#"
    error: s.lua:1:29: field lamp.height: missing default or type
      | object("lamp", { fields = { height = { doc = "How high." } } })
      |                             ^^^^^^
      help: write { default = ... }, or { type = "number" } for a required field
    "#);
    assert_snapshot!(refused("object(\"lamp\", { state = { rail = footprint } })"), @r#"
    error: s.lua:1:28: rail of the state of lamp: a function cannot be passed on
      | object("lamp", { state = { rail = footprint } })
      |                            ^^^^
      help: a state variable is a number, a boolean, a string, a table of these, or an object
    "#);
    assert_snapshot!(refused("object(\"lamp\", { state = { [1] = 3 } })"), @r#"
    error: s.lua:1:18: state of object lamp must be a table of names, but has 1 as a key
      | object("lamp", { state = { [1] = 3 } })
      |                  ^^^^^
      help: write state = { name = ... }
    "#);
}

#[test]
fn a_name_stands_for_one_thing() {
    assert_snapshot!(refused("object(\"turtle\", {})"), @r#"
    error: s.lua:1:9: object type `turtle` is already declared, as a built-in type
      | object("turtle", {})
      |         ^^^^^^
      help: rename this one, or add methods to the other: extend(constructor, { ... })
    "#);
    assert_snapshot!(refused("object(\"lamp\", {})\nobject(\"lamp\", {})"), @r#"
    error: s.lua:2:9: object type `lamp` is already declared, in s.lua:1
      | object("lamp", {})
      |         ^^^^
      help: rename this one, or add methods to the other: extend(constructor, { ... })
    "#);
    assert_snapshot!(refused("object(\"lamp\", { extends = extruder, changes = { extrude = function(self) end } })"), @r#"
    error: s.lua:1:50: extruder already has a method `extrude`
      | object("lamp", { extends = extruder, changes = { extrude = function(self) end } })
      |                                                  ^^^^^^^
      help: rename the method of lamp
    "#);
    assert_snapshot!(refused("object(\"lamp\", { fields = { height = 3 }, reads = { height = function(self) return 3 end } })"), @r#"
    error: s.lua:1:1: lamp has a field and a method named `height`
      | object("lamp", { fields = { height = 3 }, reads = { height = function(self) return 3 end } })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: rename one of them
    "#);
    assert_snapshot!(refused("object(\"lamp\", { fields = { height = 3 }, state = { height = 3 } })"), @r#"
    error: s.lua:1:43: `height` is both a field and a state variable of lamp
      | object("lamp", { fields = { height = 3 }, state = { height = 3 } })
      |                                           ^^^^^
      help: rename one of them
    "#);
    assert_snapshot!(refused("object(\"lamp\", { reads = { high = function(self) end }, changes = { high = function(self) end } })"), @r#"
    error: s.lua:1:18: high is in both reads and changes of object lamp
      | object("lamp", { reads = { high = function(self) end }, changes = { high = function(self) end } })
      |                  ^^^^^
      help: a method is either a read method or a write method
    "#);
    assert_snapshot!(refused("extend(extruder, { changes = { extrude = function(self) end } })"), @r"
    error: s.lua:1:32: extruder already has a method `extrude`
      | extend(extruder, { changes = { extrude = function(self) end } })
      |                                ^^^^^^^
      help: rename this one
    ");
    assert_snapshot!(refused("extend(extrude, { changes = {} })"), @r"
    error: s.lua:1:8: unknown name extrude
      | extend(extrude, { changes = {} })
      |        ^^^^^^^
      help: did you mean extruded?
    ");
}

#[test]
fn a_constructor_takes_what_was_declared() {
    assert_snapshot!(refused("local lamp = object(\"lamp\", { extends = extruder, fields = { height = { default = 3, max = 9 } } })\nlamp({ height = 10 })"), @r"
    error: s.lua:2:1: lamp: height must be 9 or less, not 10
      | lamp({ height = 10 })
      | ^^^^
      help: height takes a number, 3 unless given:
    ");
    assert_snapshot!(refused("local lamp = object(\"lamp\", { extends = extruder, fields = { height = { default = 3, max = 9 } } })\nlamp({ hieght = 1 })"), @r"
    error: s.lua:2:8: unknown field `hieght` in lamp
      | lamp({ hieght = 1 })
      |        ^^^^^^
      help: did you mean height?
    ");
    assert_snapshot!(refused("local lamp = object(\"lamp\", { extends = extruder, fields = { height = { default = 3, max = 9 } } })\nlamp({ sides = \"many\" })"), @r#"
    error: s.lua:2:17: extruder: sides must be an integer of at least 0, not "many"
      | lamp({ sides = "many" })
      |                 ^^^^
      help: sides takes a number, 16 unless given: Number of sides of the cross-section, a regular polygon with radius 1
    "#);
    assert_snapshot!(refused("local lamp = object(\"lamp\", { fields = { height = { type = \"number\" } } })\nlamp()"), @r"
    error: s.lua:2:1: lamp: missing field `height`
      | lamp()
      | ^^^^
      help: write lamp { height = ... }
    ");
    assert_snapshot!(refused("local lamp = object(\"lamp\", { fields = { kind = { default = \"gas\", choices = { \"gas\", \"arc\" } } } })\nlamp({ kind = \"oil\" })"), @r#"
    error: s.lua:2:16: lamp: kind must be one of "gas", "arc", not "oil"
      | lamp({ kind = "oil" })
      |                ^^^
      help: kind takes "gas" | "arc", "gas" unless given:
    "#);
    assert_snapshot!(refused("local lamp = object(\"lamp\", { fields = { kind = 3 } })\nlocal one = lamp()\none.kind = 4"), @r"
    error: s.lua:3:5: kind of a lamp cannot be assigned
      | one.kind = 4
      |     ^^^^
      help: set fields in the constructor: lamp { kind = ... }
    ");
}

#[test]
fn a_rule_reads_only() {
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:rule(\"A\", function(this)\n    this:go(1)\n  end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", { changes = { go = function(self, n) end } }))\n"), @r"
    error: s.lua:7:10: rule A: lamp:go is a write method, so a rule cannot call it
      | this:go(1)
      |      ^^
      module: A, step 1
      help: use an interpretation rule: system:interpret(pattern, function(this, ...) ... end)
    ");
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:rule(\"A\", function(this)\n    if this:count() > 0 then return A(), A() end\n  end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  state = { n = 0 },\n  reads = { count = function(self)\n    self.n += 1\n    return self.n\n  end },\n  changes = { go = function(self, n) end },\n}))\n"), @r"
    error: s.lua:14:10: rule A: lamp: a read method assigns n
      | self.n += 1
      |      ^
      module: A, step 1
      help: move it to the changes of the type, which interpretations can call
    ");
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:rule(\"A\", function(this)\n    if this:count() > 0 then return A(), A() end\n  end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  extends = extruder,\n  reads = { count = function(self)\n    self:extrude(1)\n    return 1\n  end },\n  changes = { go = function(self, n) end },\n}))\n"), @r"
    error: s.lua:14:10: rule A: lamp:extrude is a write method, so a read method cannot call it
      | self:extrude(1)
      |      ^^^^^^^
      module: A, step 1
      help: move it to the changes of the type
    ");
    assert_snapshot!(refused("extend(extruder, { changes = { up = function(self, n) self:extrude(n) end } })\nlocal A = module(\"A\")\nlocal s = lsystem({ object = extruder() })\ns:axiom(A())\ns:rule(\"A\", function(this)\n  this:up(1)\n  return A()\nend)\ns:derive(1)\n"), @r"
    error: s.lua:6:8: rule A: extruder:up is a write method, so a rule cannot call it
      | this:up(1)
      |      ^^
      module: A, step 1
      help: use an interpretation rule: system:interpret(pattern, function(this, ...) ... end)
    ");
}

#[test]
fn a_function_of_a_type_assigns_only_its_state() {
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  changes = { go = function(self, n)\n    self.nothing = n\n  end },\n}))\n"), @r"
    error: s.lua:10:10: rule A (interpretation): lamp: unknown state variable `nothing`
      | self.nothing = n
      |      ^^^^^^^
      module: A, step 0
      help: declare it: state = { nothing = ... }
    ");
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  fields = { height = 3 },\n  changes = { go = function(self, n)\n    self.height = n\n  end },\n}))\n"), @r"
    error: s.lua:11:10: rule A (interpretation): height is a field of lamp, which only the constructor sets
      | self.height = n
      |      ^^^^^^
      module: A, step 0
      help: keep changing values in the state
    ");
    assert_snapshot!(refused("local kept\nlocal A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  changes = { go = function(self, n)\n    kept = self\n  end },\n}))\n"), @r"
    error: s.lua:11:5: rule A (interpretation): an interpretation rule assigns kept, a variable declared outside
      | kept = self
      | ^^^^
      module: A, step 0
      help: a rule can assign only its own locals; pass it in a parameter of a module
    ");
    assert_snapshot!(refused("local kept = {}\nlocal A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  changes = { go = function(self, n)\n    kept[1] = self\n  end },\n}))\n"), @r"
    error: s.lua:11:5: rule A (interpretation): attempt to modify a readonly table
      | kept[1] = self
      | ^^^^^^^^^^^^^^
      module: A, step 0
      help: the library is read-only, and while rules run, so are tables from outside the rule; create a new table, or use table.clone
    ");
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  state = { n = 0 },\n  changes = { go = function(self, n)\n    self.n = function() end\n  end },\n}))\n"), @r"
    error: s.lua:11:10: rule A (interpretation): n of the state of lamp cannot be a function
      | self.n = function() end
      |      ^
      module: A, step 0
      help: a state variable is a number, a boolean, a string, a table of these, or an object
    ");
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  state = { n = 0 },\n  changes = { go = function(self, n)\n    self.n = self\n  end },\n}))\n"), @r"
    error: s.lua:6:3: rule lamp: finish: n of the state has an unsupported value: a table is nested more than 64 deep, or contains itself
      | s:derive(1)
      | ^^^^^^^^^^^
      help: a state variable is a number, a boolean, a string, a table of these, or an object
    ");
}

#[test]
fn what_a_function_of_a_type_does_wrong_is_told_in_its_line() {
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  changes = { go = function(self, n)\n    error(\"out of oil\")\n  end },\n}))\n"), @r#"
    error: s.lua:10:5: rule A (interpretation): out of oil
      | error("out of oil")
      | ^^^^^^^^^^^^^^^^^^^
      module: A, step 0
    "#);
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  changes = { go = function(self, n)\n    coroutine.yield()\n  end },\n}))\n"), @r"
    error: s.lua:10:15: rule A (interpretation): attempt to yield across metamethod/C-call boundary
      | coroutine.yield()
      |           ^^^^^
      module: A, step 0
      help: rules, guards, interpretations and hooks cannot pause: return modules that continue in the next step, or wrap the code in a coroutine of its own, coroutine.wrap(function() ... end)
    ");
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  changes = { go = function(self)\n  end },\n}))\n"), @r#"
    error: s.lua:5:40: rule A (interpretation): lamp:go takes no arguments
      | s:interpret("A", function(this) this:go(2) end)
      |                                      ^^
      module: A, step 0
      help: write this:go()
    "#);
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  changes = { goo = function(self)\n  end },\n}))\n"), @r#"
    error: s.lua:5:40: rule A (interpretation): unknown method or field `go` of lamp
      | s:interpret("A", function(this) this:go(2) end)
      |                                      ^^
      module: A, step 0
      help: did you mean goo?
    "#);
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  extends = extruder,\n  changes = { go = function(self, n)\n    self:scale(\"big\")\n  end },\n}))\n"), @r#"
    error: s.lua:11:17: rule A (interpretation): lamp:scale: argument 1 must be a number, not the string "big"
      | self:scale("big")
      |             ^^^
      module: A, step 0
      help: write this:scale(scale: number, y: number? = scale)
    "#);
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  extends = extruder,\n  changes = { go = function(self, n)\n    self:scale(1 / 0):extrude(n)\n  end },\n}))\n"), @r"
    error: s.lua:11:10: rule A (interpretation): extruder:scale: scale must be a finite number, not infinity
      | self:scale(1 / 0):extrude(n)
      |      ^^^^^
      module: A, step 0
      help: write this:scale(scale: number, y: number? = scale)
    ");
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  state = { rail = extruder() },\n  changes = { go = function(self, n)\n    self.rail:scale(1 / 0)\n  end },\n}))\n"), @r"
    error: s.lua:11:15: rule A (interpretation): extruder:scale: scale must be a finite number, not infinity
      | self.rail:scale(1 / 0)
      |           ^^^^^
      module: A, step 0
      help: write this:scale(scale: number, y: number? = scale)
    ");
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  state = { rail = extruder() },\n  changes = { go = function(self, n)\n    self.rail:extrud(1)\n  end },\n}))\n"), @r"
    error: s.lua:11:15: rule A (interpretation): unknown method or field `extrud` of extruder
      | self.rail:extrud(1)
      |           ^^^^^^
      module: A, step 0
      help: did you mean extrude?
    ");
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  begin = function(self)\n    error(\"no oil\")\n  end,\n  changes = { go = function(self, n) end },\n}))\n"), @r#"
    error: s.lua:10:5: rule lamp: begin: no oil
      | error("no oil")
      | ^^^^^^^^^^^^^^^
    "#);
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  state = { a = 1 },\n  finish = function(self)\n    self.a = nil + 1\n  end,\n  changes = { go = function(self, n) end },\n}))\n"), @r"
    error: s.lua:11:18: rule lamp: finish: attempt to perform arithmetic (add) on nil and number
      | self.a = nil + 1
      |              ^
      help: give the value a number before: one side is nil
    ");
}

#[test]
fn what_never_ends_is_stopped_wherever_it_stands() {
    assert_snapshot!(stopped("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  changes = { go = function(self, n)\n    while true do end\n  end },\n}))\n", &["--time-limit", "1"]), @r"
    error: s.lua:10:5: rule A (interpretation): the run exceeded the time limit of 1 s
      | while true do end
      | ^^^^^^^^^^^^^^^^^
      module: A, step 0
      help: look for an endless loop, or raise the limit: --time-limit SECONDS
    ");
    assert_snapshot!(stopped("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  changes = { go = function(self, n)\n    pcall(function() while true do end end)\n    while true do end\n  end },\n}))\n", &["--time-limit", "1"]), @r"
    error: s.lua:10:5: rule A (interpretation): the run exceeded the time limit of 1 s
      | pcall(function() while true do end end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A, step 0
      help: look for an endless loop, or raise the limit: --time-limit SECONDS
    ");
    assert_snapshot!(stopped("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  extends = extruder,\n  changes = { go = function(self, n)\n    while true do self:roll(1) end\n  end },\n}))\n", &["--time-limit", "1"]), @r"
    error: s.lua:11:5: rule A (interpretation): the run exceeded the time limit of 1 s
      | while true do self:roll(1) end
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A, step 0
      help: look for an endless loop, or raise the limit: --time-limit SECONDS
    ");
    assert_snapshot!(stopped("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  begin = function(self)\n    while true do end\n  end,\n  changes = { go = function(self, n) end },\n}))\n", &["--time-limit", "1"]), @r"
    error: s.lua:10:5: rule lamp: begin: the run exceeded the time limit of 1 s
      | while true do end
      | ^^^^^^^^^^^^^^^^^
      help: look for an endless loop, or raise the limit: --time-limit SECONDS
    ");
    assert_snapshot!(stopped("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  finish = function(self)\n    while true do end\n  end,\n  changes = { go = function(self, n) end },\n}))\n", &["--time-limit", "1"]), @r"
    error: s.lua:10:5: rule lamp: finish: the run exceeded the time limit of 1 s
      | while true do end
      | ^^^^^^^^^^^^^^^^^
      help: look for an endless loop, or raise the limit: --time-limit SECONDS
    ");
    assert_snapshot!(stopped("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:rule(\"A\", function(this)\n    if this:count() then return A(), A() end\n  end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  reads = { count = function(self)\n    while true do end\n  end },\n  changes = { go = function(self, n) end },\n}))\n", &["--time-limit", "1"]), @r"
    error: s.lua:13:5: rule A: the run exceeded the time limit of 1 s
      | while true do end
      | ^^^^^^^^^^^^^^^^^
      module: A, step 1
      help: look for an endless loop, or raise the limit: --time-limit SECONDS
    ");
    assert_snapshot!(stopped("print(setmetatable({}, { __tostring = function()\n  while true do end\nend }))\n", &["--time-limit", "1"]), @r"
    error: s.lua:2:3: the run exceeded the time limit of 1 s
      | while true do end
      | ^^^^^^^^^^^^^^^^^
      help: look for an endless loop, or raise the limit: --time-limit SECONDS
    ");
    assert_snapshot!(stopped("for _ in setmetatable({}, { __iter = function() return function() return 1 end end }) do\nend\n", &["--time-limit", "1"]), @r"
    error: s.lua:1:1: the run exceeded the time limit of 1 s
      | for _ in setmetatable({}, { __iter = function() return function() return 1 end end }) do
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: look for an endless loop, or raise the limit: --time-limit SECONDS
    ");
}

#[test]
fn what_takes_all_memory_is_stopped_wherever_it_stands() {
    assert_snapshot!(stopped("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  state = { list = {} },\n  changes = { go = function(self, n)\n    while true do\n      table.insert(self.list, string.rep(\"x\", 1e6) .. #self.list)\n    end\n  end },\n}))\n", &["--memory-limit", "100"]), @r#"
    error: s.lua:12:7: rule A (interpretation): the run exceeds the memory limit of 100 MB
      | table.insert(self.list, string.rep("x", 1e6) .. #self.list)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A, step 0
      help: look for a growing table, string or report, or raise the limit: --memory-limit MEGABYTES
    "#);
    assert_snapshot!(stopped("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  state = { list = {} },\n  begin = function(self)\n    while true do\n      table.insert(self.list, string.rep(\"x\", 1e6) .. #self.list)\n    end\n  end,\n  changes = { go = function(self, n) end },\n}))\n", &["--memory-limit", "100"]), @r#"
    error: s.lua:12:7: rule lamp: begin: the run exceeds the memory limit of 100 MB
      | table.insert(self.list, string.rep("x", 1e6) .. #self.list)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: look for a growing table, string or report, or raise the limit: --memory-limit MEGABYTES
    "#);
    assert_snapshot!(stopped("object(\"lamp\", { doc = string.rep(\"x\", 3e8) })", &["--memory-limit", "100"]), @r#"
    error: s.lua:1:1: the run exceeds the memory limit of 100 MB
      | object("lamp", { doc = string.rep("x", 3e8) })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: look for a growing table, string or report, or raise the limit: --memory-limit MEGABYTES
    "#);
}

#[test]
fn what_types_share_cannot_be_changed() {
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  changes = { go = function(self, n)\n    setmetatable(self, {})\n  end },\n}))\n"), @r"
    error: s.lua:10:5: rule A (interpretation): cannot change a protected metatable
      | setmetatable(self, {})
      | ^^^^^^^^^^^^^^^^^^^^^^
      module: A, step 0
    ");
    assert_snapshot!(refused("local A = module(\"A\")\nlocal function draw(object)\n  local s = lsystem({ object = object })\n  s:axiom(A())\n  s:interpret(\"A\", function(this) this:go(2) end)\n  s:derive(1)\nend\ndraw(object(\"lamp\", {\n  changes = { go = function(self, n)\n    getmetatable(self).__index = nil\n  end },\n}))\n"), @r"
    error: s.lua:10:24: rule A (interpretation): attempt to index string with '__index'
      | getmetatable(self).__index = nil
      |                    ^^^^^^^
      module: A, step 0
    ");
    assert_snapshot!(refused("getmetatable(\"\").__index = nil"), @r#"
    error: s.lua:1:1: attempt to modify a readonly table
      | getmetatable("").__index = nil
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: the library is read-only, and while rules run, so are tables from outside the rule; create a new table, or use table.clone
    "#);
    assert_snapshot!(refused("local lamp = object(\"lamp\", { extends = extruder })\nlamp().extrude = nil"), @r"
    error: s.lua:2:8: extrude of a lamp cannot be assigned
      | lamp().extrude = nil
      |        ^^^^^^^
      help: set fields in the constructor: lamp { extrude = ... }
    ");
}
