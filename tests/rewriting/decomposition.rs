//! Decomposition rules, which apply repeatedly after the axiom and after each step.

use burgeon::script::{DerivationStore, RunOptions};
use std::sync::Arc;

use super::generate::Dice;
use super::naive;
use super::scripts::{Plain, all_chains, chain, divided, error, run, run_with, try_run};

#[test]
fn a_metamer_is_decomposed_within_the_step_that_makes_it() {
    let plant = Plain {
        ignore: "",
        axiom: "M A",
        rules: "A -> M A
M => I [ L ]",
    };
    assert_eq!(plant.derive([0, 2]), ["I [ L ] A", "I [ L ] I [ L ] I [ L ] A"]);
}

#[test]
fn contexts_of_decompositions_see_the_new_chain() {
    let system = Plain {
        ignore: "",
        axiom: "A B",
        rules: "A -> C
B -> D
C < D => E
C > E => F",
    };
    // D sees the new C; C then sees E in the next level.
    assert_eq!(system.derive([1]), ["F E"]);
}

#[test]
fn decompositions_recur_until_a_guard_ends_them() {
    let script = "local N, F = module('N', 'n'), module('F')
        local s = lsystem {}
        s:axiom(N(5))
        s:decompose('N(n)', { when = function(this, n) return n > 0 end }, function(this, n) return F(), N(n - 1) end)
        s:decompose('N(n)', function() return nil end)
        s:derive(0)";
    assert_eq!(chain(script), "F F F F F");
    assert!(run(script).warnings.is_empty());
}

#[test]
fn an_endless_decomposition_ends_at_its_depth_with_a_warning() {
    let script = |depth: usize| {
        format!(
            "local N, F = module('N', 'n'), module('F')
local s = lsystem {{ max_depth = {depth} }}
s:axiom(N(1))
s:decompose('N(n)', function(this, n) return F(), N(n + 1) end)
s:derive(0)"
        )
    };
    let made = run(&script(3));
    assert_eq!(all_chains(&made), "F F F N(4)\n");
    let [warning] = made.warnings.as_slice() else { panic!("{:?}", made.warnings) };
    assert_eq!(warning.message(), "decomposition stopped at the maximum depth 3, but the rule still applies");
    assert_eq!(warning.place().map(|place| place.line), Some(4));
    let text = warning.to_string();
    assert!(
        text.contains("rule N(n)")
            && text.contains("module: N(4), step 0")
            && text.contains("max_depth = 1000")
    );
    assert!(try_run(&script(3), RunOptions { strict: true, ..burgeon::options() }).is_err());
    assert!(error(&script(0)).contains("max_depth must be an integer of at least 1"));
}

#[test]
fn an_endless_decomposition_obeys_the_limits() {
    let script = "local N = module('N')
        local s = lsystem { max_depth = 1000 }
        s:axiom(N())
        s:decompose('N', function() return N(), N() end)
        s:derive(0)";
    let mut options = burgeon::options();
    options.limits.modules = 1000;
    let Err(error) = try_run(script, options) else { panic!("it should exceed the limit") };
    assert!(error.to_string().contains("exceeded 1000 modules"), "{error}");
}

#[test]
fn rules_and_decompositions_of_one_symbol_do_not_shadow_one_another() {
    let made = run("local A, B = module('A', 'n'), module('B', 'n')
        local s = lsystem {}
        s:axiom(A(0))
        s:rule('A(n)', function(this, n) return A(n + 1) end)
        s:decompose('A(n)', function(this, n) return B(n) end)
        s:rule('B(n)', function(this, n) return A(n + 10) end)
        s:derive(2)");
    assert_eq!(all_chains(&made), "B(20)\n");
    assert!(made.warnings.is_empty(), "{:?}", made.warnings);
}

/// Returns a random system whose rules and decompositions end.
fn random_system(dice: &mut Dice) -> (String, String) {
    // A decomposition makes only later letters, so that it ends.
    const LETTERS: [&str; 6] = ["A", "B", "C", "D", "E", "X"];
    let word = |dice: &mut Dice, from: usize| {
        let mut text = String::new();
        for _ in 0..dice.below(3) {
            let letter = LETTERS[from + dice.below(LETTERS.len() - from)];
            text += &if dice.chance(0.3) { format!("[ {letter} ] ") } else { format!("{letter} ") };
        }
        text
    };
    let mut rules = Vec::new();
    for (number, letter) in LETTERS.iter().enumerate().take(LETTERS.len() - 1) {
        for (arrow, from) in [("->", 0), ("=>", number + 1)] {
            if !dice.chance(0.6) {
                continue;
            }
            let left = if dice.chance(0.4) { format!("{} < ", dice.pick(&LETTERS)) } else { String::new() };
            let right = if dice.chance(0.4) { format!(" > {}", dice.pick(&LETTERS)) } else { String::new() };
            rules.push(format!("{left}{letter}{right} {arrow} {}", word(dice, from)));
        }
    }
    let axiom = (0..4).map(|_| dice.pick(&LETTERS)).collect::<Vec<_>>().join(" ");
    (axiom, rules.join("\n"))
}

#[test]
fn random_systems_decompose_as_the_plain_implementation_says() {
    let mut dice = Dice::new(35);
    let mut different = 0;
    for _ in 0..300 {
        let (axiom, rules) = random_system(&mut dice);
        let ignore = if dice.chance(0.3) { "X" } else { "" };
        let found = Plain { ignore, axiom: &axiom, rules: &rules }.first(4);
        for (steps, found) in found.iter().enumerate() {
            let expected = naive::derive(&axiom, &rules, ignore, steps);
            assert_eq!(*found, expected, "{axiom}\n{rules}\nignore {ignore}, {steps} steps");
        }
        let plain = rules.lines().filter(|rule| rule.contains("->")).collect::<Vec<_>>().join("\n");
        different += usize::from(naive::derive(&axiom, &plain, ignore, 3) != found[3]);
    }
    assert!(different > 100, "{different}");
}

const RANDOM: &str = "local A, S, Leaf = module('A', 'n'), module('S', 'l'), module('Leaf', 'x')
    local s = lsystem { object = turtle() }
    s:axiom(A(6), S(3))
    s:rule('A(n)', function(this, n) return S(random(1, 4)), { A(n - 1) }, A(n - 2) end)
    s:decompose('S(l)', { weight = 1, when = function(this, l) return l > 1 end }, function(this, l)
      return S(l / 2), { Leaf(random()) }, S(l / 2)
    end)
    s:decompose('S(l)', { weight = 2, when = function(this, l) return l > 1 end }, function(this, l) return F(l) end)
    s:interpret('Leaf(x)', function(this, x) this:forward(x) end)
    s:interpret('S(l)', function(this, l) this:forward(l) end)
    s:derive(6)";

#[test]
fn random_decompositions_are_the_same_for_any_threads_and_batches() {
    let whole = all_chains(&run(RANDOM));
    assert!(whole.matches("Leaf").count() > 10, "{whole}");
    for (threads, batch) in [(1, 1), (2, 3), (4, 4096)] {
        assert_eq!(all_chains(&run_with(RANDOM, divided(threads, batch))), whole);
    }
    let other = all_chains(&run_with(RANDOM, RunOptions { seed: 1, ..burgeon::options() }));
    assert_ne!(other, whole);
}

#[test]
fn a_run_continues_with_decompositions() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("main.lua");
    std::fs::write(&path, RANDOM).expect("a file");
    let store = Arc::<DerivationStore>::default();
    let made = |steps, store: Option<&Arc<DerivationStore>>| {
        let mut options = RunOptions { steps: Some(steps), ..burgeon::options() };
        options.inputs.derivations = store.cloned();
        let run = burgeon::run(&path, options).expect("a run");
        let rules: Vec<usize> = run.systems[0].rules.iter().map(|rule| rule.done.applied).collect();
        (all_chains(&run), rules)
    };
    for steps in [2, 4, 3, 6] {
        assert_eq!(made(steps, Some(&store)), made(steps, None), "{steps}");
    }
}

#[test]
fn queries_in_decompositions_are_answered_within_the_step() {
    let script = "local Town, House = module('Town'), module('House', 'id')
        source({ { id = 'a', geometry = point(0, 0) }, { id = 'b', geometry = point(1, 0) } }, { table = 'houses' })
        local s = lsystem {}
        s:axiom(Town())
        s:decompose('Town', function() return query('select id from houses order by id', House) end)
        s:derive(0)";
    assert_eq!(chain(script), "House(\"a\") House(\"b\")");
}
