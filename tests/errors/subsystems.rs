//! Sub-systems: declarations and combinations that cannot work.

use insta::assert_snapshot;

use crate::support::{Folder, HEAD, printed, refused, refused_rules};

/// Returns the error for declarations of a module `In` and a system `t`, of which `options` are the fields.
fn with(options: &str, declared: &str) -> String {
    refused_rules(&format!(
        "local In, t = module(\"In\", \"scale\"), lsystem({{ {options} }})\ns:axiom(In(0.5), A(1))\n{declared}"
    ))
}

const TURTLE: &str = "object = turtle()";

#[test]
fn subsystem_takes_a_declared_module_and_a_system() {
    assert_snapshot!(with(TURTLE, "s:subsystem(\"In\")"), @"");
    assert_snapshot!(with(TURTLE, "s:subsystem(\"In\", turtle())"), @"");
    assert_snapshot!(with(TURTLE, "s:subsystem(\"Im\", t)"), @"");
    assert_snapshot!(with(TURTLE, "s:subsystem(\"F\", t)"), @"");
}

#[test]
fn a_module_begins_one_subsystem() {
    assert_snapshot!(with(TURTLE, "s:subsystem(\"In\", t)\ns:subsystem(\"In\", s)"), @"");
    assert_snapshot!(with(TURTLE, "s:subsystem(\"In\", t)\nt:subsystem(\"In\", s)"), @"");
}

#[test]
fn the_objects_of_both_systems_have_the_same_type() {
    assert_snapshot!(with("object = extruder()", "s:subsystem(\"In\", t)"), @"");
    assert_snapshot!(with("", "s:subsystem(\"In\", t)"), @"");
    assert_snapshot!(refused(
        "local A, In = module(\"A\"), module(\"In\", \"scale\")
local s, t = lsystem({ object = extruder() }), lsystem({ object = extruder() })
s:axiom(In(0.5), A())
s:subsystem(\"In\", t)
s:derive(1)"
    ), @"");
}

#[test]
fn what_belongs_to_whole_derivations_is_refused_in_a_subsystem() {
    let hook = "s:subsystem(\"In\", t)\nt:after_step(function(now) end)";
    assert_snapshot!(with(TURTLE, hook), @"");
    assert_snapshot!(with("object = turtle(), ring = true", "s:subsystem(\"In\", t)"), @"");
    assert_snapshot!(with("object = turtle(), variables = variables({ x = 1 })", "s:subsystem(\"In\", t)"), @"");
    assert_snapshot!(with("object = turtle(), environment = shadow_voxels()", "s:subsystem(\"In\", t)"), @"");
}

#[test]
fn events_are_refused_together_with_subsystems() {
    let of_outer = "s:subsystem(\"In\", t)\ns:rule(\"B\", { propensity = 1 }, function() return A(1) end)";
    assert_snapshot!(with(TURTLE, of_outer), @"");
    let of_inner = "s:subsystem(\"In\", t)\nt:rule(\"B\", { propensity = 1 }, function() return A(1) end)";
    assert_snapshot!(with(TURTLE, of_inner), @"");
}

#[test]
fn an_object_cannot_apply_the_rules_of_a_system_with_subsystems() {
    let text = refused(
        "local A, In = module(\"A\"), module(\"In\")
local t, rules = lsystem(), lsystem()
rules:subsystem(\"In\", t)
rules:rule(\"A\", [[ return A() ]])
local world = lsystem({ object = terrain({ rules = rules, start = \"A\", size = 100, resolution = 50 }) })
world:derive()",
    );
    assert!(text.contains("which must not have sub-systems"), "{text}");
}

#[test]
fn a_scale_is_a_number_above_0() {
    let of = |scale: &str| {
        refused(&format!(
            "{HEAD}local In, t = module(\"In\", \"scale\"), lsystem({{ object = turtle() }})
s:axiom(F(1), In({scale}), F(1))
s:subsystem(\"In\", t)
s:derive(0)"
        ))
    };
    assert_snapshot!(of("0"), @"");
    assert_snapshot!(of("\"half\""), @"");
}

#[test]
fn rules_of_a_subsystem_are_blamed_as_other_rules() {
    assert_snapshot!(with(TURTLE, "s:subsystem(\"In\", t)\nt:rule(\"A(x)\", function(this, x) return B(x) end)"), @"");
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
