//! Hooks between events, which run without a copy of the chain, have the effects of hooks between other steps.

use std::fmt::Write as _;

use burgeon::script::{Print, RunOptions};
use proptest::collection::vec;
use proptest::prelude::*;

use super::scripts::{all_chains, divided, error, run, try_run};

/// Line of a function, which the test never runs, after which each event is a phase of its own.
const ALONE: &str = "if now.step < 0 then query('select count(*) as n from S') end\n";

/// Output of a script: printed lines, then the chains or the error.
fn output(script: &str, mut options: RunOptions) -> (Vec<String>, String) {
    let (sender, lines) = std::sync::mpsc::channel();
    options.reports.print = Some(Print::new(move |line| sender.send(line.to_owned()).expect("a receiver")));
    let end = match try_run(script, options) {
        Ok(run) => format!("{}{}", run.systems[0].steps, all_chains(&run)),
        Err(error) => in_script(&error.to_string()),
    };
    (lines.try_iter().collect(), end)
}

/// Returns an error without the folder of the script.
fn in_script(error: &str) -> String {
    error.split_once("main.lua").map_or(error, |(_, rest)| rest).to_owned()
}

/// Script of a system with events, whose hooks are `hooks`. Each chain of `chains` is the axiom of a feature.
fn script(chains: usize, hooks: &str, derive: &str) -> String {
    let axiom = match chains {
        1 => "s:axiom(sequence(list))",
        _ => "s:axiom(source({ 1, 2, 3 }), function() return sequence(list) end)",
    };
    format!(
        "local S, I, K = module('S'), module('I', 'at'), module('K', 'text')
         local v = variables({{ rate = 1, note = 'a' }})
         local s = lsystem {{ variables = v }}
         local list = {{}}
         for i = 1, 90 do
             list[i] = if i % 30 == 0 then I(0) else if i % 7 == 0 then {{ S(), S() }} else S()
         end
         {axiom}
         s:rule('I < S', {{ propensity = function() return v.rate end }}, function() return I(time()) end)
         s:rule('I(at)', {{ propensity = 0.02 }}, function(_, at) return K(v.note .. step()), I(at) end)
         s:rule('S > I', {{ propensity = 0.5, group = 'late' }}, function() return I(random()), S() end)
         {hooks}
         local derived = s:derive({derive})
         print(derived.steps, derived.time)"
    )
}

/// Strategy for the body of a hook.
fn body() -> impl Strategy<Value = String> {
    let act = prop_oneof![
        Just("v.rate += 0.25"),
        Just("v.note ..= 'b'"),
        Just("print('rate', v.rate, v.note)"),
        Just("print('random', random(), random(1, 3))"),
        Just("print('modules', now.modules, now.counts.I, now.counts.K)"),
        Just("print('time', now.time, now.step, step())"),
        Just("use_group('late')"),
        Just("use_group()"),
        Just("if #CHAIN > 40 then print(#CHAIN, tostring(CHAIN[5])) end"),
        Just("REPLACE"),
        Just("stop()"),
        Just("error('a hook fails')"),
    ];
    let when = prop_oneof![
        5 => (1_usize..40).prop_map(|step| format!("now.step == {step}")),
        3 => (2_usize..12).prop_map(|every| format!("now.step % {every} == 1")),
        1 => Just("true".to_owned()),
    ];
    (when, act).prop_map(|(when, act)| match act {
        // An error or the end in each step shows little.
        "stop()" | "error('a hook fails')" => format!("if now.step > 25 and {when} then {act} end\n"),
        _ => format!("if {when} then {act} end\n"),
    })
}

/// Strategy for a hook.
fn hook() -> impl Strategy<Value = (String, Vec<String>)> {
    let moment = prop_oneof![
        5 => Just("before_step"),
        5 => Just("after_step"),
        1 => Just("at_start"),
        1 => Just("at_end"),
    ];
    (moment.prop_map(str::to_owned), vec(body(), 1..3))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn hooks_between_events_have_the_effects_of_hooks_around_single_events(
        hooks in vec(hook(), 1..4),
        chains in prop_oneof![4 => Just(1_usize), 1 => Just(3)],
        derive in prop_oneof![Just("60"), Just("1"), Just("{ time = 4 }"), Just("{ time = 0.2 }")],
        batch in 1_usize..200,
    ) {
        let mut text = String::new();
        for (moment, bodies) in &hooks {
            let replace = match (&**moment, chains) {
                ("before_step" | "at_start", 1) => "return S(), I(now.time), S(), sequence(now.chain)",
                _ => "print('no')",
            };
            let chain = if chains == 1 { "now.chain" } else { "{}" };
            let body = bodies.concat().replace("REPLACE", replace).replace("CHAIN", chain);
            writeln!(text, "s:{moment}(function(now)\n{body}end)").expect("a string");
        }
        let together = script(chains, &text, derive);
        let alone = script(chains, &format!("{text}s:at_end(function(now) {ALONE} end)"), derive);
        let expected = output(&alone, divided(1, 4096));
        for threads in [1, 3] {
            prop_assert_eq!(&output(&together, divided(threads, batch)), &expected, "{}", together);
        }
    }
}

#[test]
fn a_hook_ends_events_in_its_step() {
    let steps = |hook: &str| run(&script(1, hook, "60")).systems[0].steps;
    assert_eq!(steps("s:before_step(function(now) if now.step == 1 then stop() end end)"), 1);
    assert_eq!(steps("s:before_step(function(now) if now.step == 20 then stop() end end)"), 20);
    assert_eq!(steps("s:after_step(function(now) if now.step == 20 then stop() end end)"), 20);
    assert_eq!(steps("s:at_start(function(now) stop() end)"), 0);
}

#[test]
fn the_failure_of_a_hook_between_events_names_the_hook() {
    let hook = "s:after_step(function(now)\nif now.step == 20 then error('too late') end end)";
    let text = error(&script(1, hook, "60"));
    assert!(
        text.contains("main.lua:13") && text.contains("too late") && text.contains("after_step (hook)"),
        "{text}"
    );
    let alone = error(&script(1, &format!("{hook}\ns:at_end(function(now) {ALONE} end)"), "60"));
    assert_eq!(in_script(&text), in_script(&alone));
}

#[test]
fn a_hook_that_can_end_events_does_not_make_a_drawing_after_each_of_them() {
    let drawn = |stop: &str, more: &str| {
        let script = format!(
            "local S, I = module('S'), module('I')
             local s = lsystem({{ object = turtle() }})
             s:axiom(sequence(table.create(30, S())))
             s:rule('S', {{ propensity = 1 }}, function() return I() end)
             s:interpret('S', function(this) this:forward(1) {more} end)
             s:interpret('I', function(this) this:forward(2) end)
             s:after_step(function(now) if now.step == 20 then {stop} end end)
             s:derive()"
        );
        let run = run(&script);
        let uses = run.systems[0].rules.iter().filter(|rule| rule.interprets).map(|rule| rule.done.applied);
        (run.systems[0].steps, uses.sum::<usize>())
    };
    assert_eq!(drawn("stop()", ""), (20, 30));
    // An interpretation that can end the derivation runs after each step: on the axiom, and after 20 events.
    assert_eq!(drawn("stop()", "if false then stop() end"), (20, 21 * 30));
}
