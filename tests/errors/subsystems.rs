//! Sub-systems: declarations and combinations that cannot work.

use insta::assert_snapshot;

use crate::support::{Folder, printed, refused, refused_rules};

/// Returns the error for declarations of a module `In` and a system `t`, of which `options` are the fields.
fn with(options: &str, declared: &str) -> String {
    refused_rules(&format!("local In, t = module(\"In\", \"scale\"), lsystem({{ {options} }})\n{declared}"))
}

const TURTLE: &str = "object = turtle()";

#[test]
fn subsystem_takes_a_declared_module_and_a_system() {
    assert_snapshot!(with(TURTLE, "s:subsystem(\"In\")"), @r#"
    error: s.lua:4:3: subsystem takes the name of a module and a system
      | s:subsystem("In")
      |   ^^^^^^^^^
      help: write system:subsystem("Leaf", leaf), with a module and a system
    "#);
    assert_snapshot!(with(TURTLE, "s:subsystem(\"In\", turtle())"), @r#"
    error: s.lua:4:3: subsystem takes the name of a module and a system
      | s:subsystem("In", turtle())
      |   ^^^^^^^^^
      help: write system:subsystem("Leaf", leaf), with a module and a system
    "#);
    assert_snapshot!(with(TURTLE, "s:subsystem(\"Im\", t)"), @r#"
    error: s.lua:4:1: unknown symbol Im
      | s:subsystem("Im", t)
      | ^^^^^^^^^^^^^^^^^^^^
      help: did you mean In?
    "#);
    assert_snapshot!(with(TURTLE, "s:subsystem(\"F\", t)"), @r#"
    error: s.lua:4:1: F is a module of the standard library
      | s:subsystem("F", t)
      | ^^^^^^^^^^^^^^^^^^^
      help: declare a module that begins the sub-system: local InLeaf = module("InLeaf", "scale")
    "#);
}

#[test]
fn a_module_begins_one_subsystem() {
    assert_snapshot!(with(TURTLE, "s:subsystem(\"In\", t)\ns:subsystem(\"In\", s)"), @r#"
    error: s.lua:5:1: In already begins a sub-system in s.lua:4
      | s:subsystem("In", s)
      | ^^^^^^^^^^^^^^^^^^^^
      help: declare another module for the other sub-system
    "#);
    assert_snapshot!(with(TURTLE, "s:subsystem(\"In\", t)\nt:subsystem(\"In\", s)"), @r#"
    error: s.lua:5:1: In begins another sub-system in s.lua:4
      | t:subsystem("In", s)
      | ^^^^^^^^^^^^^^^^^^^^
      help: use a module of its own for each sub-system
    "#);
}

#[test]
fn the_objects_of_both_systems_have_the_same_type() {
    assert_snapshot!(with("object = extruder()", "s:subsystem(\"In\", t)"), @r#"
    error: s.lua:4:1: the sub-system has the object extruder, but this system has the object turtle
      | s:subsystem("In", t)
      | ^^^^^^^^^^^^^^^^^^^^
      help: give both systems the same type of object
    "#);
    assert_snapshot!(with("", "s:subsystem(\"In\", t)"), @r#"
    error: s.lua:4:1: the sub-system has no object, but this system has the object turtle
      | s:subsystem("In", t)
      | ^^^^^^^^^^^^^^^^^^^^
      help: give both systems the same type of object
    "#);
    assert_snapshot!(refused(
        "local A, In = module(\"A\"), module(\"In\", \"scale\")
local s, t = lsystem({ object = extruder() }), lsystem({ object = extruder() })
s:axiom(In(0.5), A())
s:subsystem(\"In\", t)
s:derive(1)"
    ), @r#"
    error: s.lua:4:1: an object of the type extruder has no scale
      | s:subsystem("In", t)
      | ^^^^^^^^^^^^^^^^^^^^
      help: declare In without a parameter scale
    "#);
}

#[test]
fn what_belongs_to_whole_derivations_is_refused_in_a_subsystem() {
    let hook = "s:subsystem(\"In\", t)\nt:after_step(function(now) end)";
    assert_snapshot!(with(TURTLE, hook), @r#"
    error: s.lua:4:1: the sub-system has a hook, after_step in s.lua:5, which would not run
      | s:subsystem("In", t)
      | ^^^^^^^^^^^^^^^^^^^^
      help: declare the hook in the system that is derived
    "#);
    assert_snapshot!(with("object = turtle(), ring = true", "s:subsystem(\"In\", t)"), @r#"
    error: s.lua:4:1: the sub-system has rings, but its modules are parts of other chains
      | s:subsystem("In", t)
      | ^^^^^^^^^^^^^^^^^^^^
      help: set ring = true only in the system that is derived
    "#);
    assert_snapshot!(with("object = turtle(), variables = variables({ x = 1 })", "s:subsystem(\"In\", t)"), @r#"
    error: s.lua:4:1: the sub-system has other variables than this system
      | s:subsystem("In", t)
      | ^^^^^^^^^^^^^^^^^^^^
      help: give both systems the same variables
    "#);
    assert_snapshot!(with("object = turtle(), environment = shadow_voxels()", "s:subsystem(\"In\", t)"), @r#"
    error: s.lua:4:1: the sub-system has other environments than this system
      | s:subsystem("In", t)
      | ^^^^^^^^^^^^^^^^^^^^
      help: give both systems the same environments
    "#);
}

#[test]
fn events_are_refused_together_with_subsystems() {
    let of_outer = "s:subsystem(\"In\", t)\ns:rule(\"B\", { propensity = 1 }, function() return A(1) end)";
    assert_snapshot!(with(TURTLE, of_outer), @r#"
    error: s.lua:5:15: rule B: it has a propensity, but rules of sub-systems apply in every step
      | s:rule("B", { propensity = 1 }, function() return A(1) end)
      |               ^^^^^^^^^^
      help: use guards or weights, or place a derived system: Place(model)
    "#);
    let of_inner = "s:subsystem(\"In\", t)\nt:rule(\"B\", { propensity = 1 }, function() return A(1) end)";
    assert_snapshot!(with(TURTLE, of_inner), @r#"
    error: s.lua:5:15: rule B: it has a propensity, but rules of sub-systems apply in every step
      | t:rule("B", { propensity = 1 }, function() return A(1) end)
      |               ^^^^^^^^^^
      help: use guards or weights, or place a derived system: Place(model)
    "#);
}

#[test]
fn an_object_cannot_apply_the_rules_of_a_system_with_subsystems() {
    let text = refused(
        "local A, In = module(\"A\"), module(\"In\")
local t, rules = lsystem(), lsystem()
rules:subsystem(\"In\", t)
rules:rule(\"A\", [[ return A() ]])
local world = lsystem({ object = terrain({ rules = rules, start = \"A\", size = 100, levels = 3 }) })
world:derive()",
    );
    assert!(text.contains("which must not have sub-systems"), "{text}");
}

#[test]
fn a_scale_is_a_number_above_0() {
    let of = |scale: &str| {
        refused(&format!(
            "local In = module(\"In\", \"scale\")
local s, t = lsystem({{ object = turtle() }}), lsystem({{ object = turtle() }})
s:axiom(F(1), In({scale}), F(1))
s:subsystem(\"In\", t)
s:derive(0)"
        ))
    };
    assert_snapshot!(of("0"), @r#"
    error: s.lua:4:1: the scale must be above 0 and finite, not 0
      | s:subsystem("In", t)
      | ^^^^^^^^^^^^^^^^^^^^
      module: In(0), step 0
      help: use 0.5 for half of the size
    "#);
    assert_snapshot!(of("\"half\""), @r#"
    error: s.lua:4:1: the scale must be a number, not "half"
      | s:subsystem("In", t)
      | ^^^^^^^^^^^^^^^^^^^^
      module: In("half"), step 0
      help: use 0.5 for half of the size
    "#);
}

#[test]
fn rules_of_a_subsystem_are_blamed_as_other_rules() {
    assert_snapshot!(refused(
        "local A, B, In = module(\"A\", \"x\"), module(\"B\"), module(\"In\")
local s, t = lsystem(), lsystem()
s:axiom(In(), A(1))
s:subsystem(\"In\", t)
t:rule(\"A(x)\", function(this, x) return B(x) end)
s:derive(1)"
    ), @r#"
    error: s.lua:5:41: rule A(x): B has no parameters, not 1
      | t:rule("A(x)", function(this, x) return B(x) end)
      |                                         ^
      help: it was declared as B
    "#);
}

#[test]
fn a_subsystem_needs_no_derivation_and_its_rules_are_checked() {
    let head = "local A, B, In = module('A'), module('B'), module('In')
        local t, s = lsystem({ object = turtle() }), lsystem({ object = turtle() })
        s:axiom(F(1), In(), A()) s:subsystem('In', t)\n";
    let told = |rules: &str| {
        let script = format!("{head}{rules} s:derive(1)\n");
        Folder::new().with("s.lua", script).burgeon(&["run", "s.lua"]).done().stderr
    };
    assert!(!told("t:rule('A', 'F(1)')").contains("warning"), "{}", told("t:rule('A', 'F(1)')"));
    let twice = told("t:rule('A', 'F(1)') t:rule('A', 'F(2)') s:rule('A', 'F(3)')");
    assert!(twice.contains("this rule is never applied: A in s.lua:4 always applies first"), "{twice}");
    let ignored = told("t:ignore('B') t:rule('B < A', 'F(1)')");
    assert!(ignored.contains("B is ignored, so this context never occurs"), "{ignored}");
    let undrawn = told("t:rule('A', 'B')");
    assert!(undrawn.contains("B has neither a rule nor an interpretation"), "{undrawn}");
    let returned = told("t:rule('A', 'B') t:interpret('B', function(this) return In() end)");
    assert!(
        returned.contains("In, which an interpretation returned, begins a sub-system only in chains"),
        "{returned}"
    );
    assert_eq!(
        printed(
            "local In = module('In') local t, s = lsystem(), lsystem() s:axiom(In()) print(s:subsystem('In', t) == nil)"
        ),
        ["false"]
    );
}
