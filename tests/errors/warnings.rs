//! Warnings about modules that draw nothing, impossible rules and skipped data; errors in a strict run.

use std::fmt::Write as _;

use super::support::Folder;

/// Two modules, and a system with a turtle, in two lines.
const HEAD: &str = "local A, B = module(\"A\", \"x\"), module(\"B\")\nlocal s = lsystem({ object = turtle() }) s:axiom(A(1))\n";

/// Returns the warnings of runs of these scripts.
pub(super) fn warned(scripts: &[&str]) -> String {
    let mut told = String::new();
    for script in scripts {
        let folder = Folder::new().with("s.lua", script);
        let shown = script.strip_prefix(HEAD).unwrap_or(script);
        writeln!(told, "{}\n{}", shown.trim_end(), folder.warned(&["run", "s.lua"])).unwrap();
    }
    told
}

/// Returns the warnings of `check` for a script.
fn checked(script: &str) -> String {
    let folder = Folder::new().with("s.lua", script);
    let text = folder.burgeon(&["check", "s.lua"]).done().stderr;
    let document = folder.burgeon(&["check", "s.lua", "--json"]).done().json();
    assert_eq!(document["warnings"].as_array().unwrap().len(), text.matches("warning: ").count());
    text
}

pub(super) fn with(rest: &str) -> String {
    format!("{HEAD}{rest}")
}

/// Asserts that neither a run nor a check of these scripts reports anything.
pub(super) fn silent(scripts: &[&str]) {
    for script in scripts {
        let folder = Folder::new().with("s.lua", script);
        for command in
            [&["run", "s.lua", "--strict", "--json"][..], &["check", "s.lua", "--strict", "--json"]]
        {
            let said = folder.burgeon(command);
            assert_eq!(said.status, 0, "{command:?} of\n{script}\n{}{}", said.stdout, said.stderr);
        }
    }
}

#[test]
fn a_branch_without_a_smooth_joint_is_counted() {
    let tree = |branch: &str| {
        format!(
            "local s = lsystem({{ object = turtle({{ joints = \"smooth\", width = 0.2 }}) }})\ns:axiom(F(1), {branch}, F(1))\ns:derive(0)"
        )
    };
    silent(&[&tree("{ Turn(60), F(0.5) }")]);
    insta::assert_snapshot!(warned(&[&tree("{ Turn(60), F(0.05) }")]), @r#"
    local s = lsystem({ object = turtle({ joints = "smooth", width = 0.2 }) })
    s:axiom(F(1), { Turn(60), F(0.05) }, F(1))
    s:derive(0)
    warning: s.lua:1:39: 1 branch does not fit into its joint, so it is a closed tube of its own; smooth joints: 1
      | local s = lsystem({ object = turtle({ joints = "smooth", width = 0.2 }) })
      |                                       ^^^^^^
      help: make these branches longer than the radius of their parent, or their angles larger, or branches thinner
    "#);
}

#[test]
fn a_check_is_silent_about_values_that_depend_on_a_derivation() {
    let network = "local Ring = module(\"Ring\")\nlocal roads = lsystem({ object = network() })\nroads:axiom(Ring())\n\
        roads:interpret(\"Ring\", function(this)\n  \
        this:move_to(1, 0):walk(90):turn(90):walk(90):turn(90):walk(90):turn(90):walk(90)\nend)\n\
        local town = roads:derive().objects[1]\n";
    silent(&[
        &format!("{network}local sites = town:sites()\nassert(sites)\n"),
        &format!("{network}if #town:blocks() == 0 then\n  warn(\"no blocks\")\nend\n"),
    ]);
    let quick = ["check", "--quick", "s.lua"];
    let late = format!("{network}if #town:blocks() == 0 then\n  print(\"no blocks\")\nend\n");
    assert_eq!(Folder::new().with("s.lua", &late).burgeon(&quick).done().stderr, "s.lua: no problems\n");
    let early = Folder::new().with("s.lua", format!("print(\"one\")\nwarn(\"two\")\n{network}"));
    let said = early.burgeon(&quick).done().stderr;
    assert!(said.contains("one\n") && said.contains("warning: s.lua:2:1: two\n"), "{said}");
}

#[test]
fn calls_in_lists_that_lose_values() {
    let parts = "local parts = { B(), B() }\n";
    insta::assert_snapshot!(warned(&[
        &with(&format!(
            "{parts}s:rule(\"A(x)\", function() return table.unpack(parts), F(1) end)\ns:ignore(\"B\")\ns:derive(1)"
        )),
        &with(
            "s:rule(\"A(x)\", [[ local list = { F(1), F(1) } return table.unpack(list), F(1) ]])\ns:derive(1)",
        ),
        "local s = lsystem({ object = turtle() })\ns:axiom({ F(1), F(1) })\ns:derive(0)",
    ]), @r#"
    local parts = { B(), B() }
    s:rule("A(x)", function() return table.unpack(parts), F(1) end)
    s:ignore("B")
    s:derive(1)
    warning: s.lua:4:34: only the first value of table.unpack(parts) is used here, because Lua keeps the others only at the end of a list
      | s:rule("A(x)", function() return table.unpack(parts), F(1) end)
      |                                  ^^^^^^^^^^^^^^^^^^^
      help: write sequence(parts), or put it last; write (table.unpack(parts)) if only the first is meant

    s:rule("A(x)", [[ local list = { F(1), F(1) } return table.unpack(list), F(1) ]])
    s:derive(1)
    warning: s.lua:3:60: only the first value of table.unpack(list) is used here, because Lua keeps the others only at the end of a list
      | s:rule("A(x)", [[ local list = { F(1), F(1) } return table.unpack(list), F(1) ]])
      |                                                            ^^^^^^
      help: write sequence(list), or put it last; write (table.unpack(list)) if only the first is meant

    local s = lsystem({ object = turtle() })
    s:axiom({ F(1), F(1) })
    s:derive(0)
    warning: s.lua:2:3: a table is one branch, so this axiom is a single branch
      | s:axiom({ F(1), F(1) })
      |   ^^^^^
      help: write the modules of a list as system:axiom(sequence(list))
    "#);
    silent(&[
        &with(&format!(
            "{parts}s:rule(\"A(x)\", function() return F(1), table.unpack(parts) end)\ns:ignore(\"B\") s:derive(1)"
        )),
        "local s = lsystem({ object = turtle() })\ns:axiom(sequence({ F(1), F(1) }))\ns:derive(0)",
    ]);
}

#[test]
fn modules_that_an_interpretation_returns_are_drawn_without_a_warning() {
    silent(&[
        &with(
            "s:interpret(\"A(x)\", function(this, x)\n  this:forward(x)\n  return F(x), { F(x) }\nend)\ns:derive(0)",
        ),
        &with(
            "local function part(x) return F(x) end\ns:interpret(\"A(x)\", function(this, x) return part(x) end)\ns:derive(0)",
        ),
        &with("s:interpret(\"A(x)\", function(this, x) return this:forward(x) end) s:derive(0)"),
        &with(
            "s:interpret(\"A(x)\", function(this, x) if x > 3 then return end this:forward(x) return { x } end) s:derive(0)",
        ),
    ]);
}

#[test]
fn values_that_an_interpretation_returns() {
    insta::assert_snapshot!(warned(&[
        &with("s:interpret(\"A(x)\", function(this, x)\n  this:forward(x)\n  return x\nend)\ns:derive(0)"),
    ]), @r#"
    s:interpret("A(x)", function(this, x)
      this:forward(x)
      return x
    end)
    s:derive(0)
    warning: s.lua:3:1: rule A(x) (interpretation): the number 1 returned by an interpretation is ignored
      | s:interpret("A(x)", function(this, x)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A(1), step 0
      help: an interpretation returns modules or nothing
    "#);
    silent(&[&with(
        "s:interpret(\"A(x)\", function(this, x) this:forward(x) return x > 3 and this:forward(x) end) s:derive(0)",
    )]);
}

#[test]
fn systems_that_draw_nothing_beside_others() {
    let nothing = "local A, B = module(\"A\"), module(\"B\")\nlocal s = lsystem({ object = extruder })\ns:axiom(A())\n\
        s:interpret(\"A\", function(this) this:extrude(0) end)\nlocal model = s:derive(0)\n\
        local t = lsystem({ object = extruder })\nt:axiom(B())\n";
    insta::assert_snapshot!(warned(&[
        &format!("{nothing}t:interpret(\"B\", function(this) this:extrude(1) end)\nt:derive(0)"),
        &format!("{nothing}t:interpret(\"B\", function(this) this:extrude(1):place(model) end)\nt:derive(0)"),
    ]), @r#"
    local A, B = module("A"), module("B")
    local s = lsystem({ object = extruder })
    s:axiom(A())
    s:interpret("A", function(this) this:extrude(0) end)
    local model = s:derive(0)
    local t = lsystem({ object = extruder })
    t:axiom(B())
    t:interpret("B", function(this) this:extrude(1) end)
    t:derive(0)
    warning: s.lua:2:1: this system draws nothing
      | local s = lsystem({ object = extruder })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: its interpretations draw nothing: check that lengths and scales are above 0

    local A, B = module("A"), module("B")
    local s = lsystem({ object = extruder })
    s:axiom(A())
    s:interpret("A", function(this) this:extrude(0) end)
    local model = s:derive(0)
    local t = lsystem({ object = extruder })
    t:axiom(B())
    t:interpret("B", function(this) this:extrude(1):place(model) end)
    t:derive(0)
    warning: s.lua:2:1: this system draws nothing
      | local s = lsystem({ object = extruder })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: its interpretations draw nothing: check that lengths and scales are above 0
    "#);
    silent(&[&format!("{nothing}t:interpret(\"B\", function(this) this:extrude(1) end)\nt:derive(0)")
        .replace("extrude(0)", "extrude(2)")]);
}

#[test]
fn interpretations_without_an_object() {
    insta::assert_snapshot!(warned(&[
        "local A = module(\"A\")\nlocal s = lsystem()\ns:axiom(A())\ns:interpret(\"A\", function(this) this:forward(1) end)\ns:derive(0)",
    ]), @r#"
    local A = module("A")
    local s = lsystem()
    s:axiom(A())
    s:interpret("A", function(this) this:forward(1) end)
    s:derive(0)
    warning: s.lua:4:1: rule A (interpretation): the system has no object, so its interpretations never run
      | s:interpret("A", function(this) this:forward(1) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: set an object, such as lsystem({ object = turtle() })
    "#);
    silent(&[
        "local A = module(\"A\")\nlocal s = lsystem()\ns:axiom(A())\ns:rule(\"A\", function() return A(), A() end)\ns:derive(1)",
    ]);
}

#[test]
fn declarations_after_derive() {
    insta::assert_snapshot!(warned(&[
        &with("s:rule(\"A(x)\", function(this, x) return F(x) end)\ns:derive(1)\n\
            s:rule(\"B\", function() return F(1) end)\ns:interpret(\"B\", function(this) this:forward(1) end)\n\
            s:ignore(\"B\")\ns:consider(\"A\")\ns:axiom(B())"),
    ]), @r#"
    s:rule("A(x)", function(this, x) return F(x) end)
    s:derive(1)
    s:rule("B", function() return F(1) end)
    s:interpret("B", function(this) this:forward(1) end)
    s:ignore("B")
    s:consider("A")
    s:axiom(B())
    warning: s.lua:5:3: rule has no effect after derive
      | s:rule("B", function() return F(1) end)
      |   ^^^^
      help: call it before system:derive()
    warning: s.lua:6:1: interpretation has no effect after derive
      | s:interpret("B", function(this) this:forward(1) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: call it before system:derive()
    warning: s.lua:7:3: ignore has no effect after derive
      | s:ignore("B")
      |   ^^^^^^
      help: call it before system:derive()
    warning: s.lua:8:3: consider has no effect after derive
      | s:consider("A")
      |   ^^^^^^^^
      help: call it before system:derive()
    warning: s.lua:8:3: the system has both ignore and consider, the first in s.lua:7: contexts see only the modules of consider that ignore does not name
      | s:consider("A")
      |   ^^^^^^^^
      help: remove one of the two
    warning: s.lua:9:3: axiom has no effect after derive
      | s:axiom(B())
      |   ^^^^^
      help: call it before system:derive()
    "#);
    // A system may be derived repeatedly, with more declarations each time.
    silent(&[&with(
        "s:rule(\"A(x)\", function(this, x) return F(x) end)\ns:derive(1)\n\
        s:rule(\"B\", function() return F(1) end)\ns:axiom(B())\ns:derive(1)",
    )]);
}

#[test]
fn modules_that_nothing_draws() {
    let undrawn = with(
        "s:interpret(\"A(x)\", function(this, x) this:forward(x) end)\ns:rule(\"A(x)\", function(this, x) return A(x), B() end)\ns:derive(2)",
    );
    let other = "local A = module(\"A\")\nlocal s = lsystem({ object = extruder() })\ns:axiom(A(), F(1))\n\
        s:interpret(\"A\", function(this) this:extrude(1) end)\ns:derive(0)";
    let plain = "local A, B = module(\"A\"), module(\"B\")\nlocal s = lsystem({ object = turtle() })\ns:axiom(A())\n\
        s:rule(\"A\", function() return F(1), B() end)\ns:derive()";
    insta::assert_snapshot!(warned(&[&undrawn, other, plain]), @r#"
    s:interpret("A(x)", function(this, x) this:forward(x) end)
    s:rule("A(x)", function(this, x) return A(x), B() end)
    s:derive(2)
    warning: s.lua:1:10: B has neither a rule nor an interpretation, so it is never drawn
      | local A, B = module("A", "x"), module("B")
      |          ^
      help: system:interpret("B", function(this) ... end); if it is only a mark, ignore it: system:ignore("B")

    local A = module("A")
    local s = lsystem({ object = extruder() })
    s:axiom(A(), F(1))
    s:interpret("A", function(this) this:extrude(1) end)
    s:derive(0)
    warning: s.lua:2:1: the standard library draws F only with a turtle
      | local s = lsystem({ object = extruder() })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: system:interpret("F(length)", function(this, length) ... end)

    local A, B = module("A"), module("B")
    local s = lsystem({ object = turtle() })
    s:axiom(A())
    s:rule("A", function() return F(1), B() end)
    s:derive()
    warning: s.lua:1:10: B has neither a rule nor an interpretation, so it is never drawn
      | local A, B = module("A"), module("B")
      |          ^
      help: system:interpret("B", function(this) ... end); if it is only a mark, ignore it: system:ignore("B")
    "#);
    for script in [&*undrawn, other] {
        let folder = Folder::new().with("s.lua", script);
        assert!(checked(script).starts_with(&folder.warned(&["run", "s.lua"])));
    }
    silent(&[
        // Modules that a context names, ignored or considered modules, rewritten modules, and chains that the
        // script reads.
        &undrawn.replace("s:derive", "s:ignore(\"B\") s:derive"),
        &undrawn.replace("s:derive", "s:consider(\"B\") s:derive"),
        &undrawn.replace("s:rule", "s:rule(\"B < A(x)\", { when = function(this, x) return x > 9 end }, function() return nil end) s:rule"),
        &undrawn.replace("s:rule", "s:rule(\"A(x) > [B]\", { when = function(this, x) return x > 9 end }, function() return nil end) s:rule"),
        &undrawn.replace("s:derive", "s:rule(\"B\", { weight = 0 }, function() return nil end) s:derive"),
        // A system that draws nothing at all.
        "local A, B = module(\"A\"), module(\"B\")\nlocal s = lsystem()\ns:axiom(A())\ns:rule(\"A\", function() return B() end)\ns:derive()",
        // Modules of a library that this script does not use.
        &with("local Leaf = module(\"Leaf\", \"size\")\ns:interpret(\"A(x)\", function(this, x) this:forward(x) end)\ns:derive(0)"),
    ]);
    let read = Folder::new()
        .with("s.lua", undrawn.replace("s:derive(2)", "local made = s:derive(2) print(made.chains[1])"));
    assert_eq!(read.burgeon(&["run", "s.lua", "--strict"]).status, 0);
}

#[test]
fn a_module_of_the_library_that_is_declared_anew() {
    let hidden = "local F = module(\"F\", \"length\", \"width\")\nlocal s = lsystem({ object = turtle() })\ns:axiom(F(1, 2), Sphere(1))\n\
        s:rule(\"F(l, w)\", function(this, l, w) return F(l, w), F(l, w) end)\ns:derive(2)";
    insta::assert_snapshot!(warned(&[hidden]), @r#"
    local F = module("F", "length", "width")
    local s = lsystem({ object = turtle() })
    s:axiom(F(1, 2), Sphere(1))
    s:rule("F(l, w)", function(this, l, w) return F(l, w), F(l, w) end)
    s:derive(2)
    warning: s.lua:1:7: F(length, width) replaces the standard library's F(length?), so the turtle draws nothing for it
      | local F = module("F", "length", "width")
      |       ^
      help: interpret it, system:interpret("F(length, width)", function(this, length, width) ... end), or rename it
    "#);
    assert!(checked(hidden).contains("replaces the standard library's"));
    silent(&[
        &hidden.replace(
            "s:derive",
            "s:interpret(\"F(l, w)\", function(this, l, w) this:width(w):forward(l) end) s:derive",
        ),
        // A module with the same declaration, and a module of a system without an object of its own.
        "local F = module(\"F\", \"length?\")\nlocal s = lsystem({ object = turtle() })\ns:axiom(F(1))\ns:derive(0)",
        "local F = module(\"F\", \"h\")\nlocal s = lsystem({ object = extruder() })\ns:axiom(F(1))\ns:interpret(\"F(h)\", function(this, h) this:extrude(h) end)\ns:derive(0)\n\
         local t = lsystem({ object = turtle() })\nt:axiom(Sphere(1))\nt:derive(0)",
    ]);
}

#[test]
fn calls_that_draw_nothing() {
    let scale = "local A, B = module(\"A\", \"r\"), module(\"B\")\nlocal s = lsystem({ object = extruder() })\ns:axiom(A(0), B(), A(0))\n\
        s:interpret(\"A(r)\", function(this, r)\n  this:scale(1):extrude(1)\n  this:scale(r):extrude(1)\nend)\n\
        s:interpret(\"B\", function(this) this:scale(1):extrude(1) end)\ns:derive(0)";
    insta::assert_snapshot!(warned(&[scale]), @r#"
    local A, B = module("A", "r"), module("B")
    local s = lsystem({ object = extruder() })
    s:axiom(A(0), B(), A(0))
    s:interpret("A(r)", function(this, r)
      this:scale(1):extrude(1)
      this:scale(r):extrude(1)
    end)
    s:interpret("B", function(this) this:scale(1):extrude(1) end)
    s:derive(0)
    warning: s.lua:6:17: rule A(r) (interpretation): extruder:extrude draws nothing if the scale is 0 (2 times)
      | this:scale(r):extrude(1)
      |               ^^^^^^^
      module: A(0), step 0
      help: use a scale above 0, or advance without drawing: this:advance(length)
    "#);
    // If only some sizes are 0, there is no warning; a taper to 0 makes a cone.
    silent(&[
        &scale.replace("A(0), B", "A(0.5), B"),
        &scale.replace("scale(r):extrude(1)", "taper(r):extrude(1)"),
        &scale.replace("scale(r):extrude(1)", "scale(r):advance(1)"),
    ]);
}

#[test]
fn calls_of_an_object_that_is_held_name_their_line() {
    let held = "local post = object(\"post\", { state = { rail = extruder() }, changes = {\n  up = function(self, r)\n    self.rail:scale(r):extrude(1)\n  end,\n} })\n\
        local A = module(\"A\", \"r\")\nlocal s = lsystem({ object = post() })\ns:axiom(A(0))\ns:interpret(\"A(r)\", function(this, r)\n  this:up(r)\nend)\ns:derive(0)";
    insta::assert_snapshot!(warned(&[held]), @r#"
    local post = object("post", { state = { rail = extruder() }, changes = {
      up = function(self, r)
        self.rail:scale(r):extrude(1)
      end,
    } })
    local A = module("A", "r")
    local s = lsystem({ object = post() })
    s:axiom(A(0))
    s:interpret("A(r)", function(this, r)
      this:up(r)
    end)
    s:derive(0)
    warning: s.lua:3:24: rule A(r) (interpretation): extruder:extrude draws nothing if the scale is 0
      | self.rail:scale(r):extrude(1)
      |                    ^^^^^^^
      module: A(0), step 0
      help: use a scale above 0, or advance without drawing: this:advance(length)
    warning: s.lua:7:1: the model is empty: this system draws nothing
      | local s = lsystem({ object = post() })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: another warning shows the reason
    "#);
}

#[test]
fn a_system_that_is_derived_twice() {
    let twice = "local s = lsystem({ object = turtle() })\ns:axiom(F(1))\ns:rule(\"F(length)\", function(this, l) return F(l), Turn(90), F(l) end)\n\
        s:derive(1)\ns:derive(2)\nlocal last = s:derive(3)";
    insta::assert_snapshot!(warned(&[twice]), @r#"
    local s = lsystem({ object = turtle() })
    s:axiom(F(1))
    s:rule("F(length)", function(this, l) return F(l), Turn(90), F(l) end)
    s:derive(1)
    s:derive(2)
    local last = s:derive(3)
    warning: s.lua:5:1: the system is derived again after the time in s.lua:4, and both models are kept
      | s:derive(2)
      | ^^^^^^^^^^^
      help: derive it once; a model that another system places is not shown separately
    warning: s.lua:6:1: the system is derived again after the time in s.lua:4, and both models are kept
      | local last = s:derive(3)
      | ^^^^^^^^^^^^^^^^^^^^^^^^
      help: derive it once; a model that another system places is not shown separately
    "#);
    silent(&[
        // One of the models is placed and therefore not shown on its own, or each derivation begins from a
        // new axiom.
        "local s = lsystem({ object = turtle() })\ns:axiom(F(1))\ns:rule(\"F(length)\", function(this, l) return F(l), F(l) end)\n\
         local small = s:derive(1)\ns:axiom(F(1), Place(small))\ns:derive(0)",
        "local s = lsystem({ object = turtle() })\ns:axiom(F(1))\nlocal small = s:derive(0)\ns:derive(0)\n\
         local t = lsystem({ object = turtle() })\nt:axiom(F(1), Place(small))\nt:derive(0)",
        "local s = lsystem({ object = turtle() })\ns:axiom(F(1))\ns:derive(0)\ns:axiom(Turn(90), F(1))\ns:derive(0)",
        "local s = lsystem()\ns:axiom(F(1))\ns:derive(0)\ns:derive(0)",
    ]);
}

#[test]
fn systems_of_which_none_is_derived() {
    insta::assert_snapshot!(warned(&["local s = lsystem({ object = turtle() })\ns:axiom(F(1))"]), @r"
    local s = lsystem({ object = turtle() })
    s:axiom(F(1))
    warning: s.lua:1:1: no system is derived, so the model is empty
      | local s = lsystem({ object = turtle() })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: end the script with system:derive()
    ");
    // A file that other scripts require, and a script without systems.
    silent(&["local s = lsystem({ object = turtle() })\ns:axiom(F(1))\nreturn s", "print(1)"]);
}

#[test]
fn a_parameter_that_is_declared_twice() {
    insta::assert_snapshot!(warned(&[
        "local a = param(\"n\", { default = 1 })\nlocal b = param(\"n\", { default = 2, min = 0 })",
        "local a = param(\"n\", { default = 1 })\nlocal b = param(\"n\", { default = 1 })",
    ]), @r#"
    local a = param("n", { default = 1 })
    local b = param("n", { default = 2, min = 0 })
    warning: s.lua:2:1: the parameter n is already declared in s.lua:1, and users see only that declaration
      | local b = param("n", { default = 2, min = 0 })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: declare it once and reuse its value, or rename this one

    local a = param("n", { default = 1 })
    local b = param("n", { default = 1 })
    warning: s.lua:2:1: the parameter n is already declared in s.lua:1, and users see only that declaration
      | local b = param("n", { default = 1 })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: declare it once and reuse its value, or rename this one
    "#);
    // A parameter in a function that is called twice, and in a file that shares it.
    silent(&["local function n() return param(\"n\", { default = 1 }) end\nlocal a, b = n(), n()"]);
    let folder = Folder::new()
        .with("s.lua", "local a = param(\"n\", { default = 1 })\nlocal b = require(\"part\")")
        .with("part.lua", "return param(\"n\", { default = 1 })");
    assert_eq!(folder.burgeon(&["run", "s.lua", "--strict"]).done().status, 0);
}

#[test]
fn a_model_without_triangles() {
    let file = |script: &str| {
        let folder = Folder::new().with("s.lua", script);
        let told = folder.warned(&["run", "s.lua", "-o", "m.glb"]);
        assert!(folder.files().contains_key("m.glb"), "a warning is no error");
        told
    };
    insta::assert_snapshot!(warned(&[
        &with("s:rule(\"A(x)\", function(this, x) return A(x), A(x) end)\ns:derive(2)"),
        &with("s:derive()"),
        &with("s:interpret(\"A(x)\", function(this, x) this:advance(x) end)\ns:derive(0)"),
        "local A = module(\"A\")\nlocal s = lsystem({ object = turtle() })\ns:axiom(source({}), function() return F(1) end)\ns:derive()",
        "local s = lsystem({ object = turtle() })\ns:axiom(F(1))\nlocal made = s:derive(0)\nlocal t = lsystem({ object = extruder() })\nt:axiom(Place(made))\nt:derive()",
    ]), @r#"
    s:rule("A(x)", function(this, x) return A(x), A(x) end)
    s:derive(2)
    warning: s.lua:2:1: the model is empty: this system draws nothing
      | local s = lsystem({ object = turtle() }) s:axiom(A(1))
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: no module of its final chain is drawn: add system:interpret(pattern, function(this, ...) ... end)

    s:derive()
    warning: s.lua:1:1: A has neither a rule nor an interpretation, so it is never drawn
      | local A, B = module("A", "x"), module("B")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: system:interpret("A(x)", function(this, x) ... end); if it is only a mark, ignore it: system:ignore("A")
    warning: s.lua:2:1: the model is empty: this system draws nothing
      | local s = lsystem({ object = turtle() }) s:axiom(A(1))
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: another warning shows the reason

    s:interpret("A(x)", function(this, x) this:advance(x) end)
    s:derive(0)
    warning: s.lua:2:1: the model is empty: this system draws nothing
      | local s = lsystem({ object = turtle() }) s:axiom(A(1))
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: its interpretations draw nothing: check that lengths and scales are above 0

    local A = module("A")
    local s = lsystem({ object = turtle() })
    s:axiom(source({}), function() return F(1) end)
    s:derive()
    warning: s.lua:2:1: the model is empty: this system draws nothing
      | local s = lsystem({ object = turtle() })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: its source has no features

    local s = lsystem({ object = turtle() })
    s:axiom(F(1))
    local made = s:derive(0)
    local t = lsystem({ object = extruder() })
    t:axiom(Place(made))
    t:derive()
    warning: s.lua:4:1: the model is empty: this system draws nothing
      | local t = lsystem({ object = extruder() })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: another warning shows the reason
    warning: s.lua:4:1: the standard library draws Place only with a turtle
      | local t = lsystem({ object = extruder() })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: system:interpret("Place(model, scale)", function(this, model, scale) ... end)
    "#);
    insta::assert_snapshot!(file("local A = module(\"A\")\nlocal s = lsystem()\ns:axiom(A())\ns:derive(0)"), @r"
    warning: s.lua:2:1: the model is empty: no system has an object that draws
      | local s = lsystem()
      | ^^^^^^^^^^^^^^^^^^^
      help: set one, such as lsystem({ object = turtle() }); to write chains, use --chain FILE
    ");
    // `--steps` shows an earlier step.
    let folder =
        Folder::new().with("s.lua", with("s:rule(\"A(x)\", function(this, x) return F(x) end) s:derive(1)"));
    assert_eq!(folder.burgeon(&["run", "s.lua", "--steps", "0", "--strict", "-o", "m.glb"]).done().status, 0);
}

#[test]
fn warnings_are_the_same_for_any_number_of_threads() {
    let script = "local A = module(\"A\", \"r\")\nlocal s = lsystem({ object = extruder({ sides = 3 }) })\n\
        s:axiom(source(table.create(40, {})), function() return A(1) end)\n\
        s:rule(\"A(r)\", function(this, r) return A(0), A(0), A(0) end)\n\
        s:interpret(\"A(r)\", function(this, r)\n  if r == 0 then this:scale(r):extrude(1) end\n  return F(1)\nend)\ns:derive(3)\n";
    let folder = Folder::new().with("s.lua", script);
    let of = |threads: &str| {
        let arguments = ["run", "s.lua", "--json", "--threads", threads, "--batch", "7"];
        folder.burgeon(&arguments).done().json()["warnings"].clone()
    };
    let one = of("1");
    assert_eq!(one.as_array().map(Vec::len), Some(3), "{one}");
    assert_eq!((&one[1]["count"], &one[2]["count"]), (&1.into(), &(40 * 27).into()), "{one}");
    for threads in ["2", "3", "4"] {
        assert_eq!(of(threads), one);
    }
}

#[test]
fn a_sheet_of_variations_tells_each_warning_once() {
    let script = "local n = param(\"n\", { default = 1, min = 0, max = 3 })\nlocal s = lsystem({ object = turtle() })\n\
        s:axiom(F(n + 1))\ns:derive(0)\ns:derive(0)\n";
    let folder = Folder::new().with("s.lua", script);
    let said = folder
        .burgeon(&["variations", "s.lua", "--sweep", "n=0..3:1", "--size", "20x20", "-o", "v.png"])
        .done();
    assert_eq!(said.stderr.matches("warning: ").count(), 1, "{}", said.stderr);
    let document = folder
        .burgeon(&["variations", "s.lua", "--sweep", "n=0..3:1", "--size", "20x20", "-o", "v.png", "--json"])
        .done()
        .json();
    for cell in document["cells"].as_array().unwrap() {
        assert_eq!(cell["warnings"][0]["kind"], "derived-twice", "{document}");
    }
}

#[test]
fn an_axiom_declares_nothing_while_it_makes_chains() {
    let script = |body: &str| {
        format!(
            "local A = module(\"A\")\nlocal s = lsystem({{ object = turtle() }})\ns:axiom(source({{ {{}} }}), function(f)\n  {body}\n  return A()\nend)\ns:derive(1)\n"
        )
    };
    let mut told = String::new();
    for body in ["s:rule(\"A\", function() return F(1) end)", "lsystem()"] {
        let folder = Folder::new().with("s.lua", script(body));
        told += &folder.refuses(&["run", "s.lua"]);
    }
    insta::assert_snapshot!(told, @r#"
    error: s.lua:4:3: a declaration cannot be called in the function that returns each feature's chain
      | s:rule("A", function() return F(1) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: call it before derive, and use the result in the function
    error: s.lua:4:3: lsystem cannot be called in the function that returns each feature's chain
      | lsystem()
      | ^^^^^^^
      help: call it before derive, and use the result in the function
    "#);
}

#[test]
fn a_script_warns_with_its_line_and_a_remedy() {
    let script = "local function look(count)\n  if count < 3 then warn(`{count} trees are few`, \"plant more\") end\nend\n\
                  look(2)\nlook(5)\nwarn(\"a b\")";
    let folder = Folder::new().with("s.lua", script);
    insta::assert_snapshot!(folder.warned(&["run", "s.lua"]), @r#"
    warning: s.lua:2:3: 2 trees are few
      | if count < 3 then warn(`{count} trees are few`, "plant more") end
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: plant more
    warning: s.lua:6:1: a b
      | warn("a b")
      | ^^^^^^^^^^^
    "#);
    let document = folder.burgeon(&["run", "s.lua", "--json"]).done().json();
    let kinds: Vec<&str> =
        document["warnings"].as_array().unwrap().iter().map(|it| it["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds.iter().filter(|kind| **kind == "script").count(), 2, "{kinds:?}");
    assert!(folder.burgeon(&["run", "s.lua", "--strict"]).failed().contains("trees are few"));
    for (script, expected) in [
        ("warn()", "warn: text must be a string, not nothing"),
        ("warn({})", "warn: text must be a string, not a table"),
        ("warn(\"a\", 3)", "warn: help must be a string, not a number"),
    ] {
        let told = super::support::refused(script);
        assert!(told.contains(expected), "{script}: {told}");
    }
    let told = super::support::refused_rules("s:rule(\"A\", function() warn(\"no\") end)");
    assert!(told.contains("warn"), "{told}");
}
