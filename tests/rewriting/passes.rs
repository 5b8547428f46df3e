//! Skipped passes, which nothing can observe: the output is equal with and without them, for random systems.

use burgeon::export::gltf;
use burgeon::{Run, WarningKind};
use proptest::collection::vec;
use proptest::prelude::*;

use super::scripts::{all_chains, divided, run, run_with};

/// Objects of random systems, and interpretations of their modules.
const TURTLE: &str = r#"local s = lsystem({ object = turtle({ sides = 3, angle = 30 }) })
s:interpret("A(x)", function(this, x) this:width(0.1 + random() * 0.1):forward(0.1 + x % 3) end)
s:interpret("B(x)", function(this, x) this:turn(x * 40):roll(random(0, 90)):forward(0.5) end)
s:interpret("C", function(this) this:sphere(0.2 + this:position().z % 1) end)
"#;
const EXTRUDER: &str = r#"local s = lsystem({ object = extruder({ sides = 4 }) })
s:interpret("A(x)", function(this, x) this:scale(0.5 + random()):extrude(0.1 + x % 3) end)
s:interpret("B(x)", function(this, x) this:turn(x * 40):taper(0.5):extrude(1 + this:position().z % 1) end)
s:interpret("C", function(this) this:bend(20):extrude(0.5) end)
"#;

/// Rule that never applies but may read the object, so that all passes run.
const ASKS: &str =
    "local Never = module(\"Never\")\ns:rule(\"Never\", function(this) return B(this:position().z) end)\n";

fn item() -> impl Strategy<Value = String> {
    let module = || {
        prop_oneof![
            Just("A(x + 1)".to_owned()),
            Just("A(random() * 2)".to_owned()),
            Just("B(x * 0.7)".to_owned()),
            Just("C()".to_owned())
        ]
    };
    prop_oneof![4 => module(), 1 => vec(module(), 1..3).prop_map(|inner| format!("{{ {} }}", inner.join(", ")))]
}

fn successor() -> impl Strategy<Value = String> {
    prop_oneof![
        8 => vec(item(), 1..4).prop_map(|items| format!("return {}", items.join(", "))),
        1 => Just("return nil".to_owned()),
        1 => Just("if x > 2 then return end return A(x + 1), C()".to_owned())
    ]
}

fn rule() -> impl Strategy<Value = String> {
    let pattern =
        prop_oneof![Just("A(x)"), Just("B(x)"), Just("A(y) < B(x)"), Just("B(x) > C"), Just("C > A(x)")];
    let options = prop_oneof![
        4 => Just(""),
        2 => Just("{ weight = 2 }, "),
        2 => Just("{ when = function(_, x) return x < 3 end }, ")
    ];
    (pattern, options, successor(), any::<bool>()).prop_map(|(pattern, options, successor, as_text)| {
        // The first parameter of the pattern may have another name.
        let (options, successor) = match pattern {
            "A(y) < B(x)" => (options.replace("(_, x)", "(_, _, x)"), successor),
            _ => (options.to_owned(), successor),
        };
        let formals = if pattern == "A(y) < B(x)" { "this, y, x" } else { "this, x" };
        if as_text {
            format!("s:rule(\"{pattern}\", {options}[[ {successor} ]])\n")
        } else {
            format!("s:rule(\"{pattern}\", {options}function({formals}) {successor} end)\n")
        }
    })
}

/// Returns the random parts of a script: object, axiom, rules and steps.
fn script() -> impl Strategy<Value = [String; 2]> {
    let object = prop_oneof![Just(TURTLE), Just(EXTRUDER)];
    (object, vec(item(), 1..4), vec(rule(), 0..5), 0usize..6).prop_map(|(object, axiom, rules, steps)| {
        let axiom = axiom.join(", ");
        let head =
            format!("local A, B, C = module(\"A\", \"x\"), module(\"B\", \"x\"), module(\"C\")\n{object}");
        let tail = format!("local x = 1\ns:axiom({axiom})\n{}s:derive({steps})\n", rules.concat());
        [format!("{head}{tail}"), format!("{head}{ASKS}{tail}")]
    })
}

/// Returns the number of modules that were interpreted in all passes.
fn interpreted(run: &Run) -> usize {
    let rules = run.systems.iter().flat_map(|system| &system.rules).filter(|rule| rule.interprets);
    rules.map(|rule| rule.done.applied).sum()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 250, failure_persistence: None, rng_seed: proptest::test_runner::RngSeed::Fixed(11), ..ProptestConfig::default() })]

    #[test]
    fn nobody_can_tell_whether_the_passes_before_the_last_were_made(
        scripts in script(),
        threads in 1usize..3,
        batch in prop_oneof![Just(2usize), Just(4096)],
    ) {
        let [few, all] = scripts.each_ref().map(|script| run_with(script, divided(threads, batch)));
        prop_assert_eq!(all_chains(&few), all_chains(&all));
        prop_assert_eq!(few.systems[0].steps, all.systems[0].steps);
        prop_assert_eq!(gltf::glb(&few.scene).unwrap(), gltf::glb(&all.scene).unwrap());
        let kinds = |run: &Run| run.warnings.iter().map(|it| it.kind()).collect::<Vec<_>>();
        prop_assert_eq!(kinds(&few), kinds(&all));
        let names = |run: &Run| -> usize {
            let text = all_chains(run);
            text.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| matches!(*word, "A" | "B" | "C")).count()
        };
        prop_assert_eq!(interpreted(&few), names(&few));
        prop_assert!(interpreted(&all) >= interpreted(&few));
    }
}

#[test]
fn a_pass_is_made_after_each_step_only_where_a_rule_may_look() {
    let head = "local A = module(\"A\", \"n\")\nlocal helper = function(o) return o:position().z end\nlocal s = lsystem({ object = turtle() })\n\
        s:interpret(\"A(n)\", function(this, n) this:forward(1) end)\ns:axiom(A(0))\n";
    let made = |rule: &str| interpreted(&run(&format!("{head}{rule}\ns:derive(4)")));
    for unseen in [
        "s:rule(\"A(n)\", function(this, n) return A(n + 1) end)",
        "s:rule(\"A(n)\", function(_, n) return A(n + 1) end)",
        "s:rule(\"A(n)\", function() return A(1) end)",
        "s:rule(\"A(n)\", [[ return A(n + 1) ]])",
        "s:rule(\"A(n)\", { when = function(this, n) return n < 9 end }, function(this, n) return A(n + 1) end)",
        "local function grow(this, n) return A(n + 1) end\ns:rule(\"A(n)\", grow)",
        "s:rule(\"A(n)\", function(this, n) local this = 3 return A(this) end)",
    ] {
        assert_eq!(made(unseen), 1, "{unseen}");
    }
    for seen in [
        "s:rule(\"A(n)\", function(this, n) return A(this:position().z) end)",
        "s:rule(\"A(n)\", function(object, n) return A(helper(object)) end)",
        "s:rule(\"A(n)\", function(...) return A(select(2, ...)) end)",
        "s:rule(\"A(n)\", [[ return A(this:position().z) ]])",
        "s:rule(\"A(n)\", { when = function(this) return this:position().z < 9 end }, function(_, n) return A(n) end)",
        "s:rule(\"A(n)\", function(this, n) local f = function() return this end return A(n + 1) end)",
        "local function grow(this, n) return A(n + helper(this)) end\ns:rule(\"A(n)\", grow)",
        "s:rule(\"A(n)\", function(this, n) return A(n + 1) end) s:rule(\"A(n)\", { when = helper }, function() return A(1) end)",
        "local f = function(a) return 1 end local g = function\n(this, n) return A(this:position().z) end s:rule(\"A(n)\", g)",
    ] {
        assert_eq!(made(seen), 5, "{seen}");
    }
}

#[test]
fn what_a_call_draws_nothing_with_in_the_last_pass_is_told_and_in_earlier_ones_not() {
    let script = |asks: &str, last: f64| {
        format!(
            "local A = module(\"A\", \"n\")\nlocal s = lsystem({{ object = extruder() }})\ns:axiom(A(0))\n\
             s:rule(\"A(n)\", function(this, n) {asks} return A({last}) end)\n\
             s:interpret(\"A(n)\", function(this, n) this:scale(n):extrude(1) end)\ns:derive(1)\n"
        )
    };
    for asks in ["", "local place = this:position()"] {
        let kinds = |last| -> Vec<WarningKind> {
            run(&script(asks, last)).warnings.iter().map(|warning| warning.kind()).collect()
        };
        assert_eq!(kinds(1.0), []);
        assert_eq!(kinds(0.0), [WarningKind::EmptyModel, WarningKind::DrawsNothing]);
    }
}
