//! Rules with propensities: events, their times and what is derived from them.

use burgeon::script::RunOptions;

use super::scripts::{all_chains, chain, chains, divided, error, run, run_with, try_run};

const DECLARED: &str = "local A, B, C = module('A'), module('B', 'n'), module('C')\n";

#[test]
fn a_step_is_one_event_and_the_times_of_pure_births_are_those_of_the_yule_process() {
    // From n modules, the next birth takes 1 / n on average.
    let script = format!(
        "{DECLARED}
         for seed = 1, 400 do
             local s = lsystem({{ seed = seed }})
             s:axiom(A())
             s:rule('A', {{ propensity = 1 }}, function() return A(), A() end)
             local d = s:derive(99)
             expect(d.modules, 100)
             expect(d.steps, 99)
         end"
    );
    let run = run(&script);
    let expected: f64 = (1..100).map(|n| 1.0 / f64::from(n)).sum();
    let variance: f64 = (1..100).map(|n| 1.0 / f64::from(n * n)).sum();
    let mean = run.systems.iter().map(|system| system.time).sum::<f64>() / 400.0;
    let error = (variance / 400.0).sqrt();
    assert!((mean - expected).abs() < 4.0 * error, "{mean} instead of {expected}, error {error}");
}

#[test]
fn events_are_drawn_in_proportion_to_propensities_that_functions_compute() {
    // The rates are 3, 6 and 2 in the first step.
    let script = "local N = module('N', 'n')
         for seed = 1, 1100 do
             local s = lsystem({ seed = seed })
             s:axiom(N(1), N(2))
             s:rule('N(n)', { propensity = function(this, n) return 3 * n end }, function(this, n) return N(n + 1) end)
             s:rule('N(n)', { when = function(this, n) return n > 1 end, propensity = function(this, n) return n end },
                 function(this, n) return N(n - 1) end)
             s:derive(1)
         end";
    let run = run(script);
    let mut counts = [0_i32; 3];
    for system in &run.systems {
        let text = system.chain_text();
        let index =
            ["N(2) N(2)", "N(1) N(3)", "N(1) N(1)"].iter().position(|known| *known == text.trim_end());
        counts[index.unwrap_or_else(|| panic!("{text}"))] += 1;
    }
    for (count, expected) in counts.iter().zip([300, 600, 200]) {
        assert!((count - expected).abs() < 75, "{counts:?}");
    }
}

#[test]
fn a_derivation_until_a_time_has_the_events_up_to_it_and_ends_at_it() {
    let script = "local Atom, Rest = module('Atom'), module('Rest', 'time')
         local s = lsystem {}
         local atoms = {}
         for i = 1, 1000 do atoms[i] = Atom() end
         s:axiom(sequence(atoms))
         s:rule('Atom', { propensity = 2 }, function() return Rest(time()) end)
         local half = s:derive({ time = 0.25 })
         expect(half.time, 0.25)
         local both = s:derive({ time = 0.5 })
         local all = s:derive()
         expect(all.steps, 1000)
         expect(s:derive({ time = 0.5, steps = 3 }).steps, 3)
         local function before(list, limit)
             local count = 0
             for _, module in list do
                 if module.name == 'Rest' and module.time <= limit then count += 1 end
             end
             return count
         end
         expect(before(all:chain(), 0.25), half.counts.Rest)
         expect(before(all:chain(), 0.5), both.counts.Rest)
         expect(before(both:chain(), math.huge), both.counts.Rest)";
    let run = run(script);
    let left = run.systems[1].chain_text().matches("Atom").count();
    assert!(
        (left as f64 - 1000.0 / std::f64::consts::E).abs() < 62.0,
        "{left} of 1000 are left, expected 368"
    );
    assert!(run.systems[2].time > 1.0, "the last atom");
}

#[test]
fn the_same_events_occur_for_any_number_of_threads_and_size_of_batches() {
    let script = "local S, I = module('S'), module('I', 'at')
         local s = lsystem {}
         local list = {}
         for i = 1, 400 do list[i] = if i % 50 == 0 then I(0) else if i % 7 == 0 then { S(), S() } else S() end
         s:axiom(sequence(list))
         s:rule('I < S', { propensity = 1 }, function() return I(time()) end)
         s:rule('S > I', { propensity = 0.5 }, function() return I(random()) end)
         s:rule('S > [S]', { propensity = 0.1 }, function() return S(), S() end)
         s:derive(300)";
    let first = all_chains(&run_with(script, divided(1, 4096)));
    assert_eq!(first, all_chains(&run_with(script, divided(2, 7))));
    assert_eq!(first, all_chains(&run_with(script, divided(2, 64))));
    // Without the branch, contexts are near, and the chain is divided.
    let near = script.replace("S > [S]", "S > S");
    let first = all_chains(&run_with(&near, divided(1, 4096)));
    assert_eq!(first, all_chains(&run_with(&near, divided(2, 7))));
    // A hook asks for the chain after each event.
    let observed =
        near.replace("s:derive", "s:after_step(function(now) expect(now.step > 0, true) end) s:derive");
    assert_eq!(first, all_chains(&run(&observed)));
}

#[test]
fn each_chain_of_a_source_has_its_own_events() {
    let script = |features: &str| {
        format!(
            "local A = module('A', 'born')
             local s = lsystem {{}}
             s:axiom(source({{ {features} }}), function(feature) return A(0) end)
             s:rule('A', {{ propensity = 1 }}, function() return A(time()), A(0) end)
             local d = s:derive({{ time = 2 }})
             expect(d.time, 2)"
        )
    };
    let two = chains(&script("{ id = 'x' }, { id = 'y' }"));
    let three = chains(&script("{ id = 'w' }, { id = 'x' }, { id = 'y' }"));
    assert_eq!(two, three[1..], "a feature more changes no other chain");
    assert_ne!(two[0], two[1]);
}

#[test]
fn hooks_read_the_time_and_end_the_derivation() {
    let script = format!(
        "{DECLARED}
         local v = variables({{ last = 0 }})
         local s = lsystem {{ variables = v }}
         s:axiom(A())
         s:rule('A', {{ propensity = 1 }}, function() return A(), A() end)
         s:after_step(function(now)
             expect(now.time > v.last, true)
             v.last = now.time
             if now.time > 2 then stop() end
         end)
         local d = s:derive()
         expect(d.time, d.variables.last)
         expect(d.time > 2, true)"
    );
    run(&script);
}

#[test]
fn variables_that_hooks_assign_change_the_propensities() {
    let script = format!(
        "{DECLARED}
         local v = variables({{ rate = 0 }})
         local s = lsystem {{ variables = v }}
         s:axiom(A())
         s:rule('A', {{ propensity = function() return v.rate end }}, function() return A(), C() end)
         s:before_step(function(now) if now.step == 4 then v.rate = 1 end end)
         expect(s:derive(10).modules, 8)"
    );
    run(&script);
}

#[test]
fn groups_of_events_and_of_steps_follow_one_another() {
    let script = format!(
        "{DECLARED}
         local s = lsystem {{}}
         s:axiom(A(), A(), A())
         s:rule('A', {{ group = 'mutate', propensity = 1 }}, function() return C() end)
         s:rule('A', {{ group = 'grow' }}, function() return A(), A() end)
         s:derive(1, 'grow')
         s:derive({{ steps = 2, group = 'mutate' }})"
    );
    let run = run(&script);
    let texts: Vec<String> = run.systems.iter().map(|system| system.chain_text()).collect();
    assert_eq!(texts[0], "A A A A A A\n");
    assert_eq!((texts[1].matches('C').count(), texts[1].matches('A').count()), (2, 1));
}

#[test]
fn an_event_whose_rule_returns_nothing_changes_nothing_but_the_time() {
    let script = format!(
        "{DECLARED}
         local s = lsystem {{}}
         s:axiom(B(1))
         s:rule('B(n)', {{ propensity = 1 }}, function(this, n) if random() < 0.7 then return end return B(n + 1) end)
         local d = s:derive(50)
         expect(d.steps, 50)
         expect(d.modules, 1)"
    );
    let text = chain(&script);
    let n: f64 = text.trim_start_matches("B(").trim_end_matches(')').parse().expect("a number");
    assert!((5.0..30.0).contains(&n), "{text}");
}

#[test]
fn interpretations_read_the_time_of_the_chain() {
    let script = "local A = module('A', 'born')
         local s = lsystem { object = turtle() }
         s:axiom(A(0))
         s:rule('A(born)', { propensity = 1 }, function() return A(time()), A(time()) end)
         s:interpret('A(born)', function(this, born)
             this:forward(time() - born)
         end)
         s:derive({ time = 1.5 })";
    assert!(run(script).scene.triangles() > 0);
}

#[test]
fn a_system_that_continues_the_chains_of_another_draws_other_events() {
    let script = format!(
        "{DECLARED}
         local s = lsystem {{}}
         s:axiom(A(), A())
         s:rule('A', {{ propensity = 1 }}, function() return A(), A() end)
         local d = s:derive(1)
         local t = lsystem {{}}
         t:axiom(d)
         t:rule('A', {{ propensity = 1 }}, function() return A(), A() end)
         local e = t:derive(1)
         local again = t:derive(1)
         expect(e.time, again.time)
         expect(math.abs(e.time * 3 - d.time * 2) > 1e-9, true)"
    );
    run(&script);
}

#[test]
fn events_stop_at_the_limits() {
    let script = format!(
        "{DECLARED}
         local s = lsystem {{}}
         s:axiom(A())
         s:rule('A', {{ propensity = 1 }}, function() return A(), A() end)
         s:derive()"
    );
    let limited = |change: fn(&mut RunOptions)| {
        let mut options = burgeon::options();
        change(&mut options);
        try_run(&script, options).err().expect("births never end").to_string()
    };
    let modules = limited(|options| options.limits.modules = 1000);
    assert!(modules.contains("the chain exceeded 1000 modules in step"), "{modules}");
    let time = limited(|options| options.limits.time = std::time::Duration::from_millis(200));
    assert!(time.contains("time limit"), "{time}");
}

#[test]
fn misuse_of_propensities_says_where_and_what_to_do() {
    let system = |text: &str| {
        format!(
            "local A, B = module('A'), module('B', 'n')
local s = lsystem {{ object = turtle() }}
s:axiom(A(), B(1))
{text}
s:derive({{ time = 2 }})"
        )
    };
    let rule = |options: &str| system(&format!("s:rule('A', {{ {options} }}, function() return A() end)"));
    for (script, expected) in [
        (rule("propensity = -1"), "propensity must be a number from 0 to 1e9"),
        (rule("propensity = 2e9"), "propensity must be a number from 0 to 1e9"),
        (rule("propensity = 'x'"), "propensity must be a number from 0 to 1e9"),
        (rule("propensity = function() return 'a' end"), "a propensity must be a number, not the string"),
        (rule("propensity = function() return 0 / 0 end"), "the propensity is NaN"),
        (rule("propensity = function() return -2 end"), "the propensity is -2"),
        (rule("propensity = function() return random() end"), "a propensity cannot use random numbers"),
        (rule("propensity = function() return time() end"), "a propensity cannot read the time"),
        (rule("propensity = 1, when = function() return time() > 1 end"), "a guard cannot read the time"),
        (rule("propensity = function() stop() return 1 end"), "a propensity cannot stop"),
        (rule("propensity = function(this, x) return 1 end"), "the propensity has 2 parameters"),
        (rule("propensity = 1, weight = 2"), "a weight or a propensity, not both"),
        (rule("propensit = 1"), "unknown option `propensit`"),
        (rule("weight = 1"), "a time needs rules with propensities"),
        (
            system("s:decompose('A', { propensity = 1 }, function() return B(1) end)"),
            "a decomposition has no propensity",
        ),
        (
            system("s:interpret('A', { propensity = 1 }, function() end)"),
            "an interpretation has no propensity",
        ),
        (
            system("s:rule('A', { propensity = 1 }, function() end) s:rule('B', function() end)"),
            "\"A\" has a propensity",
        ),
        (
            system(
                "s:rule('A', { propensity = 1 }, function() end) s:rule('B << A', { propensity = 1 }, function() end)",
            ),
            "sees the new chain",
        ),
        (system("s:derive({ tme = 1 })"), "unknown option `tme` of derive"),
        (system("s:derive({ time = -1 })"), "the time of derive must be"),
        (system("s:derive({ time = 1 }, 'x')"), "takes a table and nothing else"),
        (system("print(time())"), "time() is known only while"),
        (
            system("s:rule('A', function() return B(time()) end) s:derive(1)"),
            "time() needs rules with propensities",
        ),
    ] {
        let found = error(&script);
        assert!(found.contains(expected), "{script}: {found}");
        assert!(found.contains("main.lua:"), "{script} has no line: {found}");
    }
}
