//! Patterns with several predecessors, values, wildcards and ends, cuts, rings and contexts in the new chain: random systems in
//! Lua, compared with a plain implementation, and known answers.

use std::fmt::Write as _;

use burgeon_rewriting::ModuleKey;

use super::scripts::{all_chains, chain, chain_of_each, divided, error, run, try_run};
use plain::{Part, PlainValue};
use systems::{MODULES, Origin, RandomSystem, Template};

#[path = "../../crates/rewriting/tests/patterns/plain.rs"]
pub(crate) mod plain;
#[path = "../../crates/rewriting/tests/patterns/plain_events.rs"]
mod plain_events;
#[path = "../../crates/rewriting/tests/patterns/systems.rs"]
mod systems;

/// Returns `parts` as arguments of `axiom` and values of `return`.
fn lua(parts: &[Part]) -> String {
    let texts = parts.iter().map(|part| match part {
        Part::Branch(inner) => format!("{{ {} }}", lua(inner)),
        Part::Module(module) => {
            let values: Vec<String> = module.values.iter().map(|value| value.text()).collect();
            format!("{}({})", module.name, values.join(", "))
        }
    });
    texts.collect::<Vec<_>>().join(", ")
}

/// Returns the text of a chain, in the format of the engine.
fn text(parts: &[Part]) -> String {
    let texts = parts.iter().map(|part| match part {
        Part::Branch(inner) if inner.is_empty() => "[ ]".to_owned(),
        Part::Branch(inner) => format!("[ {} ]", text(inner)),
        Part::Module(module) => {
            let mut values: Vec<String> = module
                .values
                .iter()
                .map(|value| match value {
                    PlainValue::Number(number) => burgeon::kit::Value::Number(*number).to_string(),
                    other => other.text(),
                })
                .collect();
            while module.values.get(values.len().wrapping_sub(1)) == Some(&PlainValue::Nil) {
                values.pop();
            }
            match values.is_empty() {
                true => module.name.to_owned(),
                false => format!("{}({})", module.name, values.join(",")),
            }
        }
    });
    texts.collect::<Vec<_>>().join(" ")
}

fn module_of(template: &Template) -> String {
    let origins = template.origins.iter().map(|origin| match origin {
        Origin::Value(value) => value.text(),
        Origin::Argument(index) => format!("p{}", index + 1),
        Origin::Half => "sum / 2".to_owned(),
        Origin::Random => "random()".to_owned(),
    });
    let module = format!("{}({})", template.name, origins.collect::<Vec<_>>().join(", "));
    format!("{}{module}{}", "{ ".repeat(template.depth), " }".repeat(template.depth))
}

/// Returns a script that derives the system.
fn script(system: &RandomSystem, steps: usize, are_events: bool) -> String {
    let mut script =
        String::from("local function n(v: any) return if type(v) == 'number' then v else 0 end\n");
    for (name, count) in MODULES.iter().filter(|(name, _)| *name != "Cut") {
        let parameters: String = (0..*count).map(|index| format!(", \"v{index}?\"")).collect();
        let _ = writeln!(script, "local {name} = module(\"{name}\"{parameters})");
    }
    let _ = writeln!(script, "local s = lsystem({{ ring = {} }})", system.settings.ring);
    let _ = writeln!(script, "s:axiom({})", lua(&system.axiom));
    let _ = writeln!(script, "local of = {{ [0] = s }}");
    for region in 0..=system.settings.ignored_in.len() {
        if region > 0 {
            let _ = writeln!(script, "of[{region}] = lsystem()");
        }
        for name in system.settings.ignored_in(u16::try_from(region).expect("few regions")) {
            let _ = writeln!(script, "of[{region}]:ignore(\"{name}\")");
        }
    }
    for (name, region) in &system.settings.openers {
        // A sub-system can declare the module, too.
        let _ = writeln!(script, "s:subsystem(\"{name}\", of[{region}])");
        let _ = writeln!(
            script,
            "if {region} % 2 == 1 then of[{region}]:subsystem(\"{name}\", of[{region}]) end"
        );
    }
    for (number, rule) in system.rules.iter().enumerate() {
        let (pattern, count) = rule.pattern.text();
        let formals: String = (1..=count).map(|number| format!(", p{number}: any")).collect();
        let sum: String = (1..=count).map(|number| format!(" + n(p{number})")).collect();
        let mut options = String::new();
        if let Some(weight) = rule.weight {
            let _ = write!(options, "weight = {weight}, ");
        }
        if are_events && number.is_multiple_of(2) {
            let _ = write!(options, "propensity = {}, ", plain_events::rate(number, &[]));
        } else if are_events {
            let _ = write!(
                options,
                "propensity = function(this{formals})
                   local sum = 0{sum}
                   return if math.floor(sum * 8) % 3 == 2 then 0 else math.min(math.abs(sum) + 0.1, 1e6)
                 end, "
            );
        }
        if let Some(least) = rule.least {
            let _ = write!(options, "when = function(this{formals}) return 0{sum} >= {least} end, ");
        }
        if let Some(ignored) = &rule.ignored {
            let names: Vec<String> = ignored.iter().map(|name| format!("\"{name}\"")).collect();
            let _ = write!(options, "ignore = {{ {} }}", names.join(", "));
        }
        let keeps = rule.keeps.map_or_else(String::new, |most| format!("if sum <= {most} then return end"));
        let made: Vec<String> = rule.successor.iter().map(module_of).collect();
        let made = if made.is_empty() { "nil".to_owned() } else { made.join(", ") };
        let _ = writeln!(
            script,
            "of[{}]:rule([=[{pattern}]=], {{ {options} }}, function(this{formals})
               local sum = 0{sum} {keeps} return {made} end)",
            rule.region
        );
    }
    let _ = writeln!(script, "s:derive({steps})");
    script
}

#[test]
fn random_systems_derive_the_same_chains_in_lua_and_plainly() {
    let changed = compare_systems(600, RandomSystem::new);
    assert!(changed > 300, "{changed}");
}

#[test]
fn random_systems_with_subsystems_derive_the_same_chains_in_lua_and_plainly() {
    let changed = compare_systems(600, |dice| {
        let mut system = RandomSystem::with_regions(dice);
        // Modules of the standard library do not begin sub-systems.
        system.settings.openers.retain(|(name, _)| *name != "Cut");
        system
    });
    assert!(changed > 300, "{changed}");
}

/// Compares the chains of `count` systems, and returns the number of those that change.
fn compare_systems(count: u64, make: fn(&mut systems::Dice) -> RandomSystem) -> usize {
    let mut changed = 0;
    for seed in 0..count {
        let system = make(&mut systems::Dice::new(seed));
        let axiom = plain::axiom(system.axiom.clone(), 0);
        let (mut expected, mut steps) = (axiom.clone(), 0);
        while steps < 3 && plain::modules(&expected) < 200 {
            let cut = plain::cut_branches(&expected, "Cut");
            expected = plain::step(&cut, &system.rules, &system.settings);
            steps += 1;
        }
        let (threads, batch) = (1 + seed as usize % 2, [1, 2, 7, 4096][seed as usize / 2 % 4]);
        let text_of = script(&system, steps, false);
        let run =
            try_run(&text_of, divided(threads, batch)).unwrap_or_else(|error| panic!("{error}\n{text_of}"));
        assert_eq!(all_chains(&run).trim_end(), text(&expected), "seed {seed}: {text_of}");
        changed += usize::from(expected != axiom);
    }
    changed
}

#[test]
fn random_systems_of_dependent_modules_derive_the_same_chains_in_lua_and_plainly() {
    let mut changed = 0;
    for seed in 0..600 {
        let system = RandomSystem::of_dependents(&mut systems::Dice::new(seed));
        let axiom = plain::axiom(system.axiom.clone(), 0);
        let (mut expected, mut steps) = (axiom.clone(), 0);
        while steps < 3 && plain::modules(&expected) < 200 {
            let cut = plain::cut_branches(&expected, "Cut");
            expected = plain::step(&cut, &system.rules, &system.settings);
            steps += 1;
        }
        let (threads, batch) = (1 + seed as usize % 2, [1, 2, 7, 4096][seed as usize / 2 % 4]);
        let text_of = script(&system, steps, false);
        let run =
            try_run(&text_of, divided(threads, batch)).unwrap_or_else(|error| panic!("{error}\n{text_of}"));
        assert_eq!(all_chains(&run).trim_end(), text(&expected), "seed {seed}: {text_of}");
        changed += usize::from(expected != axiom);
    }
    assert!(changed > 400, "{changed}");
}

#[test]
fn random_systems_of_events_derive_the_same_chains_in_lua_and_plainly() {
    let (mut changed, mut ended) = (0, 0);
    for seed in 0..200 {
        let system = RandomSystem::of_events(&mut systems::Dice::new(seed));
        let (mut expected, mut steps, mut time) = (plain::axiom(system.axiom.clone(), 0), 0, 0.0);
        let axiom = expected.clone();
        while steps < 20 {
            let cut = plain::cut_branches(&expected, "Cut");
            let next = plain_events::plain_event(&system, &cut, (steps + 1, time), ModuleKey::seed(0));
            // A step that only cuts branches counts, too.
            let has_cut = cut != expected;
            (expected, time) = match next {
                Some(next) => next,
                None if has_cut => (cut, time),
                None => break,
            };
            steps += 1;
        }
        ended += usize::from(steps < 20);
        let division = [(1, 1), (2, 2), (1, 7), (2, 4096)][seed as usize % 4];
        let text_of = script(&system, 20, true);
        let run = try_run(&text_of, divided(division.0, division.1))
            .unwrap_or_else(|error| panic!("{error}\n{text_of}"));
        assert_eq!(all_chains(&run).trim_end(), text(&expected), "seed {seed}: {text_of}");
        assert_eq!(run.systems[0].time.to_bits(), time.to_bits(), "seed {seed}: {text_of}");
        assert_eq!(run.systems[0].steps, steps, "seed {seed}: {text_of}");
        changed += usize::from(expected != axiom);
    }
    assert!(changed > 100 && ended > 5, "{changed} {ended}");
}

/// Returns the chain after one step of a system of a few modules that ignores X.
fn after(axiom: &str, rules: &str) -> String {
    chain(&format!(
        "local A, B, C, D, X = module('A'), module('B'), module('C'), module('D'), module('X')
         local N, T = module('N', 'n'), module('T', 'n', 'what?')
         local s = lsystem() s:ignore('X') s:axiom({axiom}) {rules} s:derive(1)"
    ))
}

#[test]
fn a_run_is_replaced_as_a_whole_and_the_leftmost_wins() {
    let rule = "s:rule('A A', function() return B() end)";
    assert_eq!(after("A(), A(), A()", rule), "B A");
    assert_eq!(after("A(), X(), A()", rule), "A X A", "ignored modules are not skipped");
    assert_eq!(after("A(), { A() }, A()", rule), "A [ A ] A");
    let sum = "s:rule('N(a) N(b) T(c, _)', function(this, a, b, c) return N(a * 100 + b * 10 + c) end)";
    assert_eq!(after("N(1), N(2), T(3), N(4)", sum), "N(123) N(4)");
    let around = "s:rule('B < A C > D', function() return C() end)";
    assert_eq!(after("B(), A(), C(), D(), A(), C()", around), "B C D A C");
    let kept = "s:rule('A B', function() end) s:rule('B', [[ return C() ]])";
    assert_eq!(after("A(), B(), B()", kept), "A B C", "a run that stays takes its modules, too");
    let first = "s:rule('A B', { when = function() return false end }, [[ return D() ]]) s:rule('A', [[ return C() ]])";
    assert_eq!(after("A(), B()", first), "C B");
}

#[test]
fn a_guard_is_called_only_for_modules_that_no_run_takes() {
    let rules = "s:rule('N(a) N(b)', { when = function(this, a, b)
                   if a == 2 then error('not to be called') end return a == 1 end },
                 function(this, a, b) return N(a + b) end)";
    assert_eq!(after("N(1), N(2), N(3)", rules), "N(3) N(3)");
    let told = error(&format!(
        "local N = module('N', 'n') local s = lsystem() s:axiom(N(5), N(2), N(3)) {rules} s:derive(1)"
    ));
    assert!(told.contains("not to be called") && told.contains("N(2) N(3)"), "{told}");
}

#[test]
fn errors_name_all_modules_of_a_run() {
    let told = error(
        "local A, B = module('A', 'x'), module('B', 'y') local s = lsystem() s:axiom(A(1), B(2))
         s:rule('A(x) B(y)', function(this, x, y) error('stop') end) s:derive(1)",
    );
    assert!(told.contains("rule A(x) B(y)") && told.contains("A(1) B(2), step 1"), "{told}");
}

#[test]
fn values_wildcards_and_ends_match_as_the_book_says() {
    let zero = "s:rule('N(0)', [[ return A() ]]) s:rule('T(x, \"left\")', function(this, x) return N(x) end)";
    assert_eq!(
        after("N(0), N(1), T(7, 'left'), T(7, 'right'), T(7)", zero),
        "A N(1) N(7) T(7,\"right\") T(7)"
    );
    assert_eq!(after("T(1), T(1, true)", "s:rule('T(1, nil)', [[ return A() ]])"), "A T(1,true)");
    assert_eq!(after("A(), B(), C()", "s:rule('* < B > *', [[ return D() ]])"), "A D C");
    assert_eq!(after("A(), B(), C(), B()", "s:rule('(A|D) < B', [[ return D() ]])"), "A D C B");
    assert_eq!(after("A(), A(), X(), { B() }", "s:rule('A > $', [[ return D() ]])"), "A D X [ B ]");
    assert_eq!(after("X(), A(), A(), { A() }", "s:rule('^ < A', [[ return D() ]])"), "X D A [ A ]");
    assert_eq!(after("A(), B(), A(), B(), C()", "s:rule('A > B $', [[ return D() ]])"), "A B A B C");
    assert_eq!(after("A(), { B() }, C()", "s:rule('A > [B $] C $', [[ return D() ]])"), "D [ B ] C");
}

#[test]
fn symbols_of_strings_and_ends_of_patterns_are_told_apart() {
    let turtle = |axiom: &str, rule: &str| {
        chain(&format!("local s = lsystem() s:axiom(\"{axiom}\") s:rule({rule}) s:derive(1)"))
    };
    assert_eq!(turtle("F+F", "\"+ < F > $\", \"f\""), "F Left G");
    assert_eq!(turtle("F$F", "\"F > $ F\", \"f\""), "G Level F");
    assert_eq!(turtle("^F", "\"^\", \"f\""), "G F");
    assert_eq!(turtle("F-F", "\"F-\", \"f\""), "G F");
    assert_eq!(turtle("+F-F&F", "\"(Left|Right) < F\", \"f\""), "Left G Right G Down F");
    let abop = chain("abop({ axiom = 'AB(1)B(2)', ['A B(1)'] = 'B(3)', ['^ < B(x) > $'] = 'A' }):derive(2)");
    assert_eq!(abop, "B(3) B(2)");
}

#[test]
fn a_cut_erases_the_rest_of_its_branch_at_the_beginning_of_the_next_step() {
    let chains = chain_of_each(
        "local A, B = module('A'), module('B', 'n')
         for steps = 0, 3 do
           local s = lsystem()
           s:axiom(A(), { B(1), Cut(), B(2), { B(3) } }, B(4))
           s:rule('B(4)', [[ return Cut(), B(5) ]])
           s:derive(steps)
         end",
    );
    let expected = ["A [ B(1) Cut B(2) [ B(3) ] ] B(4)", "A [ B(1) ] Cut B(5)", "A [ B(1) ]", "A [ B(1) ]"];
    assert_eq!(chains, expected);
    let run = run("local A = module('A') local s = lsystem() s:axiom(A(), Cut(), A()) s:derive()");
    assert_eq!((all_chains(&run).trim_end(), run.systems[0].steps), ("A", 1));
    let percent = chain("local s = lsystem() s:axiom('F%F[F]') s:derive(1)");
    assert_eq!(percent, "F");
}

#[test]
fn places_and_queries_of_a_step_do_not_see_what_was_cut() {
    let text = chain(
        "local A, H = module('A'), module('H', 'x', 'count')
         local s = lsystem({ object = turtle() })
         s:axiom({ F(1), Cut(), F(2) }, F(3), A())
         s:rule('A', function(this) return H(this:position().z, #query('F')) end)
         s:interpret('H(x, count)', function() end)
         s:derive(1)",
    );
    assert_eq!(text, "[ F(1) ] F(3) H(3,2)");
}

#[test]
fn interpretations_choose_by_values_and_take_one_module() {
    let script = |pattern: &str| {
        format!(
            "local B, P = module('B', 'n', 'what?'), module('P', 'n', 'what?')
             local s = lsystem({{ object = extruder() }})
             s:axiom(B(0, 'left'), B(2), B(3, 'left'))
             s:interpret('B(n, \"left\")', function(this, n) if n == 0 then return B(5) end this:extrude(10 + n) end)
             s:interpret('{pattern}', function(this, n) this:extrude(n) end)
             s:derive(0)
             print('done')"
        )
    };
    let run = run(&script("B(n, nil)"));
    let (low, high) = run.scene.bounds().expect("a model");
    let height = high.z - low.z;
    assert!((height - 20.0).abs() < 1e-9, "5 + 2 + 13, not {height}");
    let told = error(&script("B P"));
    assert!(told.contains("an interpretation is of one module"), "{told}");
}

#[test]
fn the_lineage_of_a_run_is_that_of_its_first_module_and_survives_cuts() {
    let file = tempfile::Builder::new().suffix(".lua").tempfile().expect("a file").into_temp_path();
    let script = "local A, B, Slab = module('A', 'n'), module('B', 'n'), module('Slab', 'h')
        local s = lsystem({ object = extruder() })
        s:axiom({ B(7), Cut(), B(8) }, A(1), B(2))
        s:rule('A(a) B(b)', function(this, a, b) return Slab(a + b), B(9) end)
        s:interpret('Slab(h)', function(this, h) this:extrude(h) end)
        s:derive(1)";
    std::fs::write(&file, script).expect("a script");
    let run = burgeon::run(&file, burgeon::options()).expect("it runs");
    assert_eq!(all_chains(&run).trim_end(), "[ B(7) ] Slab(3) B(9)");
    let asked = burgeon::trace::Pick { instance: 0, part: 0, triangle: 0 };
    let picked = burgeon::trace::pick(&file, &burgeon::options(), &run.scene, asked).expect("it is known");
    let path = picked.drawn.expect("a module made it").path;
    let path: Vec<_> = path.iter().map(|ancestor| ancestor.module.text.as_str()).collect();
    assert_eq!(path, ["A(1)", "Slab(3)"]);
}

#[test]
fn runs_decompose_and_never_cross_the_chains_of_features() {
    let run = run("local A, B = module('A', 'n'), module('B', 'n')
         local s = lsystem()
         s:axiom(source({ { id = 'a', n = 1 }, { id = 'b', n = 2 }, { id = 'c', n = 5 } }), function(feature)
           local list = {}
           for i = 1, feature.n do list[i] = A(i) end
           return sequence(list)
         end)
         s:decompose('A(a) A(b)', function(this, a, b) return A(a + b) end)
         s:rule('A(n)', function(this, n) return B(n), B(random() // 1 + n) end)
         s:decompose('B(a) B(b)', { weight = 1 }, function(this, a, b) return B(a * b) end)
         s:derive(1)");
    assert_eq!(all_chains(&run), "B(1)\nB(9)\nB(225)\n");
    let uses: Vec<usize> = run.systems[0].rules.iter().map(|rule| rule.done.applied).collect();
    assert_eq!(uses, [5, 3, 3]);
}

#[test]
fn rules_that_no_module_can_reach_are_told() {
    let told = |rules: &str| {
        let run = run(&format!(
            "local A, B, X = module('A', 'n'), module('B'), module('X')
             local s = lsystem() s:axiom(A(1), B(), X()) s:ignore('X') {rules} s:derive(1)"
        ));
        run.warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    };
    let quiet = "s:rule('A(0)', [[ return nil ]]) s:rule('A(1)', [[ return B() ]]) s:rule('A(n) B', [[ return nil ]])
                 s:rule('A > (B|X)', [[ return nil ]]) s:rule('A > $', [[ return nil ]]) s:rule('A', [[ return nil ]])";
    assert_eq!(told(quiet), "");
    let twice = "s:rule('A(0) B', [[ return nil ]]) s:rule('A(0) B', [[ return B() ]])";
    assert!(told(twice).contains("never applied: A(0) B"), "{}", told(twice));
    let sole = "s:rule('A', [[ return nil ]]) s:rule('A(n) B', [[ return B() ]])";
    assert!(told(sole).contains("never applied: A"), "{}", told(sole));
    assert!(told("s:rule('A > (X|X)', [[ return nil ]])").contains("X is ignored"));
    assert!(told("s:rule('A > Cut', [[ return nil ]])").contains("Cut is erased before rules are matched"));
}
