//! Results of successors, and arguments of modules and methods.

use insta::assert_snapshot;

use crate::support::{chain, refused, refused_rules};

fn successor(body: &str) -> String {
    refused_rules(&format!("s:rule(\"A(x)\", function(this, x)\n  {body}\nend)"))
}

#[test]
fn a_successor_that_is_no_module_names_the_rule_the_module_and_the_step() {
    assert_snapshot!(successor("return x"), @r"
    error: s.lua:4:3: rule A(x): a successor must be modules, but one item is the number 1
      | return x
      | ^^^^^^^^
      module: A(1), step 1
      help: return modules, such as A(1), and branches of them, such as { A(1) }
    ");
    assert_snapshot!(successor("return \"B\""), @r#"
    error: s.lua:4:11: rule A(x): a successor must be modules, but one item is the string "B"
      | return "B"
      |         ^
      module: A(1), step 1
      help: give the string in place of the function: system:rule("A", "F[+F]F")
    "#);
    assert_snapshot!(successor("return B"), @r"
    error: s.lua:4:3: rule A(x): a successor must be modules, but one item is a function
      | return B
      | ^^^^^^^^
      module: A(1), step 1
      help: call the constructor of the module: F(1)
    ");
    assert_snapshot!(successor("return x > 0"), @r"
    error: s.lua:4:3: rule A(x): a successor must be modules, but one item is the boolean true
      | return x > 0
      | ^^^^^^^^^^^^
      module: A(1), step 1
      help: return modules, such as A(1), and branches of them, such as { A(1) }
    ");
    assert_snapshot!(successor("return B(), nil, B()"), @r"
    error: s.lua:4:3: rule A(x): a successor must be modules, but one item is nothing
      | return B(), nil, B()
      | ^^^^^^^^^^^^^^^^^^^^
      module: A(1), step 1
      help: return modules, such as A(1), and branches of them, such as { A(1) }
    ");
    assert_snapshot!(successor("return this"), @r"
    error: s.lua:4:3: rule A(x): a successor must be modules, but one item is a table
      | return this
      | ^^^^^^^^^^^
      module: A(1), step 1
      help: return modules, such as A(1), and branches of them, such as { A(1) }
    ");
    assert_snapshot!(successor("return turtle()"), @r"
    error: s.lua:4:3: rule A(x): a successor must be modules, but one item is an object
      | return turtle()
      | ^^^^^^^^^^^^^^^
      module: A(1), step 1
      help: return modules, such as A(1), and branches of them, such as { A(1) }
    ");
}

#[test]
fn a_branch_is_a_list_that_does_not_contain_itself() {
    assert_snapshot!(successor("local t = {} t[1] = t return t"), @r"
    error: s.lua:4:3: rule A(x): branches are nested more than 200 deep, or a branch contains itself
      | local t = {} t[1] = t return t
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A(1), step 1
      help: use a rule to add the rest step by step
    ");
    assert_snapshot!(successor("return B(), { n = B() }"), @r"
    error: s.lua:4:17: rule A(x): a branch is a list of modules, but this one has the field n
      | return B(), { n = B() }
      |               ^
      module: A(1), step 1
      help: write { A(1), B() }
    ");
    assert_snapshot!(successor("return { B(), [5] = B() }"), @r"
    error: s.lua:4:3: rule A(x): a branch is a list of modules, but this one has the field 5
      | return { B(), [5] = B() }
      | ^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A(1), step 1
      help: write { A(1), B() }
    ");
    assert_snapshot!(successor("return { B(), { 3 } }"), @r"
    error: s.lua:4:3: rule A(x): a successor must be modules, but one item is the number 3
      | return { B(), { 3 } }
      | ^^^^^^^^^^^^^^^^^^^^^
      module: A(1), step 1
      help: return modules, such as A(1), and branches of them, such as { A(1) }
    ");
    assert_snapshot!(refused_rules("local t = { B() } t[2] = t\ns:axiom(t)"), @r"
    error: s.lua:4:1: branches are nested more than 200 deep, or a branch contains itself
      | s:axiom(t)
      | ^^^^^^^^^^
      help: use a rule to add the rest step by step
    ");
}

#[test]
fn a_parameter_is_data() {
    assert_snapshot!(successor("return A(B())"), @r"
    error: s.lua:4:10: rule A(x): x of A cannot be a module
      | return A(B())
      |        ^
      module: A(1), step 1
      help: parameters are numbers, booleans, strings, tables of these, and objects
    ");
    assert_snapshot!(successor("return A(function() end)"), @r"
    error: s.lua:4:10: rule A(x): x of A cannot be a function
      | return A(function() end)
      |        ^
      module: A(1), step 1
      help: parameters are numbers, booleans, strings, tables of these, and objects
    ");
    assert_snapshot!(successor("return A(this)"), @r"
    error: s.lua:4:10: rule A(x): x of A cannot be a table
      | return A(this)
      |        ^
      module: A(1), step 1
      help: parameters are numbers, booleans, strings, tables of these, and objects
    ");
    assert_snapshot!(successor("return A(setmetatable({}, {}))"), @r"
    error: s.lua:4:3: rule A(x): a table with a metatable cannot be passed on
      | return A(setmetatable({}, {}))
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A(1), step 1
    ");
    assert_snapshot!(successor("local t = {} t.t = t return A(t)"), @r"
    error: s.lua:4:3: rule A(x): a table is nested more than 64 deep, or contains itself
      | local t = {} t.t = t return A(t)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A(1), step 1
    ");
    assert_snapshot!(successor("return A({ [{}] = 1 })"), @r"
    error: s.lua:4:3: rule A(x): a table has a table as a key
      | return A({ [{}] = 1 })
      | ^^^^^^^^^^^^^^^^^^^^^^
      module: A(1), step 1
      help: use names or integers as keys
    ");
    assert_snapshot!(refused_rules("s:axiom(A(B()))"), @r"
    error: s.lua:3:9: x of A cannot be a module
      | s:axiom(A(B()))
      |         ^
      help: parameters are numbers, booleans, strings, tables of these, and objects
    ");
    assert_snapshot!(refused_rules("s:axiom(A(print))"), @r"
    error: s.lua:3:9: x of A cannot be a function
      | s:axiom(A(print))
      |         ^
      help: parameters are numbers, booleans, strings, tables of these, and objects
    ");
}

#[test]
fn a_table_that_travels_in_a_module_is_frozen() {
    assert_snapshot!(
        refused_rules("s:axiom(A({ n = 1 }))\ns:rule(\"A(x)\", function(this, x)\n  x.n = 2\n  return A(x)\nend)"),
        @r"
    error: s.lua:5:3: rule A(x): attempt to modify a readonly table
      | x.n = 2
      | ^^^^^^^
      module: A({n=1}), step 1
      help: the library is read-only, and while rules run, so are tables from outside the rule; create a new table, or use table.clone
    "
    );
    assert_snapshot!(
        refused_rules("s:rule(\"A(x)\", function(this, x)\n  local t = { n = 1 }\n  local a = A(t)\n  t.n = 2\n  return a\nend)"),
        @r"
    error: s.lua:6:3: rule A(x): attempt to modify a readonly table
      | t.n = 2
      | ^^^^^^^
      module: A(1), step 1
      help: the library is read-only, and while rules run, so are tables from outside the rule; create a new table, or use table.clone
    "
    );
}

#[test]
fn a_length_that_is_no_finite_number_is_refused_by_turtle_and_extruder() {
    assert_snapshot!(refused_rules("s:interpret(\"A(x)\", function(this, x)\n  this:forward(0 / 0)\nend)"), @r"
    error: s.lua:4:8: rule A(x) (interpretation): turtle:forward: argument 1 must be a finite number, not NaN
      | this:forward(0 / 0)
      |      ^^^^^^^
      module: A(1), step 0
      help: write this:forward(length: number? = turtle.step)
    ");
    assert_snapshot!(refused_rules("s:interpret(\"A(x)\", function(this, x)\n  this:forward(x / 0)\nend)"), @r"
    error: s.lua:4:8: rule A(x) (interpretation): turtle:forward: length must be a finite number, not infinity
      | this:forward(x / 0)
      |      ^^^^^^^
      module: A(1), step 0
      help: write this:forward(length: number? = turtle.step)
    ");
    let extruded = |length: &str| {
        refused(&format!(
            "local A = module(\"A\", \"length\")\nlocal s = lsystem({{ object = extruder() }})\ns:axiom(A({length}))\ns:interpret(\"A(length)\", function(this, length)\n  this:extrude(length)\nend)\ns:derive(0)\n"
        ))
    };
    assert_snapshot!(extruded("0 / 0"), @r"
    error: s.lua:5:8: rule A(length) (interpretation): extruder:extrude: argument 1 must be a finite number, not NaN
      | this:extrude(length)
      |      ^^^^^^^
      module: A(nan), step 0
      help: write this:extrude(length: number)
    ");
    assert_snapshot!(extruded("-1 / 0"), @r"
    error: s.lua:5:8: rule A(length) (interpretation): extruder:extrude: length must be a finite number, not infinity
      | this:extrude(length)
      |      ^^^^^^^
      module: A(-inf), step 0
      help: write this:extrude(length: number)
    ");
    assert_snapshot!(extruded("\"long\""), @r#"
    error: s.lua:5:8: rule A(length) (interpretation): extruder:extrude: argument 1 must be a number, not the string "long"
      | this:extrude(length)
      |      ^^^^^^^
      module: A("long"), step 0
      help: write this:extrude(length: number)
    "#);
}

#[test]
fn a_constructor_refuses_unknown_fields_and_wrong_types() {
    assert_snapshot!(refused("local t = turtle({ wdth = 3 })\n"), @r"
    error: s.lua:1:20: unknown field `wdth` in turtle
      | local t = turtle({ wdth = 3 })
      |                    ^^^^
      help: did you mean width?
    ");
    assert_snapshot!(refused("local t = turtle({ width = \"wide\" })\n"), @r#"
    error: s.lua:1:29: turtle: width must be a number, not "wide"
      | local t = turtle({ width = "wide" })
      |                             ^^^^
      help: width takes a number, 0.1 unless given: Diameter of branches (m)
    "#);
    assert_snapshot!(refused("local t = turtle({ sides = 2 })\n"), @r"
    error: s.lua:1:11: turtle: sides must be from 3 to 64, not 2
      | local t = turtle({ sides = 2 })
      |           ^^^^^^
      help: sides takes a number, 8 unless given: Number of faces around branches
    ");
    assert_snapshot!(refused("local t = turtle({ sides = 2.5 })\n"), @r"
    error: s.lua:1:11: turtle: sides must be an integer of at least 0, not 2.5
      | local t = turtle({ sides = 2.5 })
      |           ^^^^^^
      help: sides takes a number, 8 unless given: Number of faces around branches
    ");
    assert_snapshot!(refused("local t = turtle({ color = \"rd\" })\n"), @r##"
    error: s.lua:1:29: turtle: color must be a colour, such as "red", not "rd"
      | local t = turtle({ color = "rd" })
      |                             ^^
      help: write color = "red", color = "#ff8000" or color = { 1, 0.5, 0 }
    "##);
    assert_snapshot!(refused("local t = turtle({ heading = { 1 } })\n"), @r"
    error: s.lua:1:11: turtle: heading must be a vector: { x, y, z } or vec(x, y, z), not {1}
      | local t = turtle({ heading = { 1 } })
      |           ^^^^^^
      help: heading takes a vector: vec(1, 0, 0) or { 1, 0, 0 }, vec(0, 0, 1) unless given: Initial heading
    ");
    assert_snapshot!(refused("local t = turtle({ 3 })\n"), @r"
    error: s.lua:1:11: turtle needs named fields, but 3 has no name
      | local t = turtle({ 3 })
      |           ^^^^^^
      help: write turtle { step = 3 }
    ");
    assert_snapshot!(refused("local e = extruder({ shape = { { 0, 0 }, 3 } })\n"), @r"
    error: s.lua:1:11: extruder: shape must be a list whose item 2 is a vector: { x, y, z } or vec(x, y, z), not 3
      | local e = extruder({ shape = { { 0, 0 }, 3 } })
      |           ^^^^^^^^
      help: shape takes { Vector }, {} unless given: Points of the cross-section, as { { x, y }, ..
    ");
}

#[test]
fn a_method_tells_what_it_takes() {
    let interpreted =
        |call: &str| refused_rules(&format!("s:interpret(\"A(x)\", function(this, x)\n  {call}\nend)"));
    assert_snapshot!(interpreted("this:foward(1)"), @r"
    error: s.lua:4:8: rule A(x) (interpretation): unknown method or field `foward` of turtle
      | this:foward(1)
      |      ^^^^^^
      module: A(1), step 0
      help: did you mean forward?
    ");
    assert_snapshot!(interpreted("this:forward(\"far\")"), @r#"
    error: s.lua:4:17: rule A(x) (interpretation): turtle:forward: argument 1 must be a number, not the string "far"
      | this:forward("far")
      |               ^^^
      module: A(1), step 0
      help: write this:forward(length: number? = turtle.step)
    "#);
    assert_snapshot!(interpreted("this:forward(1, 2)"), @r"
    error: s.lua:4:8: rule A(x) (interpretation): turtle:forward takes 1 argument
      | this:forward(1, 2)
      |      ^^^^^^^
      module: A(1), step 0
      help: write this:forward(length: number? = turtle.step)
    ");
    assert_snapshot!(interpreted("this:width()"), @r"
    error: s.lua:4:8: rule A(x) (interpretation): turtle:width: width must be a number, not nothing
      | this:width()
      |      ^^^^^
      module: A(1), step 0
      help: write this:width(width: number)
    ");
    assert_snapshot!(interpreted("this:width(-1)"), @r"
    error: s.lua:4:8: rule A(x) (interpretation): turtle:width: width must be at least 0, not -1
      | this:width(-1)
      |      ^^^^^
      module: A(1), step 0
      help: write this:width(width: number)
    ");
    assert_snapshot!(interpreted("this:color(\"#12\")"), @r##"
    error: s.lua:4:15: rule A(x) (interpretation): turtle:color: color must be a colour: "#rrggbb", a name such as "lightblue", or { red, green, blue } from 0 to 1, not "#12"
      | this:color("#12")
      |             ^^^
      module: A(1), step 0
      help: write this:color(color: Color)
    "##);
    assert_snapshot!(interpreted("this.forward(1)"), @r"
    error: s.lua:4:8: rule A(x) (interpretation): turtle:forward is a method, and must be called on this
      | this.forward(1)
      |      ^^^^^^^
      module: A(1), step 0
      help: write a colon: this:forward(...)
    ");
    assert_snapshot!(interpreted("this.forward()"), @r"
    error: s.lua:4:8: rule A(x) (interpretation): turtle:forward is a method, and must be called on this
      | this.forward()
      |      ^^^^^^^
      module: A(1), step 0
      help: write a colon: this:forward(...)
    ");
    assert_snapshot!(interpreted("this:end_polygon()"), @r"
    error: s.lua:4:8: rule A(x) (interpretation): turtle:end_polygon: no polygon is open
      | this:end_polygon()
      |      ^^^^^^^^^^^
      module: A(1), step 0
      help: begin it with BeginPolygon()
    ");
}

#[test]
fn nothing_leaves_a_module_and_nil_erases_it() {
    let head = "local A, B = module(\"A\", \"x\"), module(\"B\")\nlocal s = lsystem() s:axiom(A(1), B())\n";
    assert_eq!(chain(&format!("{head}s:rule(\"A(x)\", function() end) s:derive(1)"), &[]), "A(1) B\n");
    assert_eq!(chain(&format!("{head}s:rule(\"A(x)\", function() return nil end) s:derive(1)"), &[]), "B\n");
    assert_eq!(
        chain(&format!("{head}s:rule(\"A(x)\", function() return {{}} end) s:derive(1)"), &[]),
        "[ ] B\n"
    );
}

#[test]
fn modules_that_are_made_and_not_returned_leave_no_trace() {
    let head = "local A, B = module(\"A\", \"x\"), module(\"B\")\nlocal s = lsystem() s:axiom(A(1))\nlocal function make() return B() end\n";
    let bodies = [
        "pcall(make) return A(2)",
        "pcall(function() B() error(\"x\") end) return A(2)",
        "local c = coroutine.wrap(make) c() return A(2)",
        "local t = setmetatable({}, { __add = make }) local u = t + t return A(2)",
        "table.sort({ 1, 2, 3 }, function(a, b) make() return a < b end) return A(2)",
        "string.gsub(\"abc\", \".\", function() make() return nil end) return A(2)",
        "make() B() return A(2)",
        "local b = B() return A(2)",
    ];
    for body in bodies {
        let script = format!("{head}s:rule(\"A(x)\", function(this, x) {body} end) s:derive(1)");
        assert_eq!(chain(&script, &[]), "A(2)\n", "{body}");
    }
}
