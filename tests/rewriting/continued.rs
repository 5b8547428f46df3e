//! Runs that continue from the chains of earlier runs, compared with whole runs.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use burgeon::Run;
use burgeon::export::gltf;
use burgeon::script::{DerivationStore, Print, RunOptions};

/// Returns the chains, warnings, notes and model of a run.
fn outcome(run: &Run) -> (Vec<String>, Vec<String>, Vec<String>, Vec<u8>) {
    let chains =
        run.systems.iter().map(|system| format!("{} {}", system.steps, system.chain_text())).collect();
    let warnings = run.warnings.iter().map(ToString::to_string).collect();
    let model = if run.scene.triangles() > 0 { gltf::glb(&run.scene).expect("a model") } else { Vec::new() };
    (chains, warnings, run.notes.clone(), model)
}

fn run(script: &Path, steps: usize, store: Option<&Arc<DerivationStore>>, seed: u64) -> Run {
    let mut options = RunOptions { steps: Some(steps), seed, ..burgeon::options() };
    options.inputs.derivations = store.cloned();
    burgeon::run(script, options).unwrap_or_else(|error| panic!("{}: {error}", script.display()))
}

fn write(name: &str, text: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("burgeon-continued-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join(name);
    std::fs::write(&path, text).expect("a script");
    path
}

/// Scripts of the kinds that can be continued, with the number of steps of their longest run.
const SCRIPTS: [(&str, &str); 9] = [
    (
        "numbers.lua",
        "local A, B = module('A', 'x'), module('B', 'x')
         local s = lsystem {}
         s:axiom(A(1))
         s:rule('A(x)', function(this, x) return A(x / 2), B(x) end)
         s:rule('B(x)', function(this, x) return A(x) end)
         s:derive()",
    ),
    (
        "values.lua",
        "local A, Leaf = module('A', 'n', 'colour', 'at'), module('Leaf', 'colour', 'at')
         local s = lsystem { object = extruder { sides = 5 } }
         s:axiom(A(0, { 'red', 1 }, point(0, 0)))
         s:rule('A(n, colour, at)', function(this, n, colour, at)
           return { Leaf(colour[1] .. n, at) }, A(n + 1, { colour[1], n % 3 }, point(n, n))
         end)
         s:interpret('Leaf(colour, at)', function(this, colour, at) this:scale(1 + at:x()):extrude(#colour) end)
         s:derive(20)",
    ),
    (
        "random.lua",
        "local X, F = module('X', 'n'), module('F', 'l')
         local s = lsystem { object = turtle() }
         s:axiom(X(1))
         s:rule('X(n)', { weight = 2 }, function(this, n) return F(random()), { X(n / 2) }, X(n / 3) end)
         s:rule('X(n)', { weight = 1 }, function(this, n) return F(random(1, 2)), X(n / 2) end)
         s:interpret('F(l)', function(this, l) this:forward(l) end)
         s:derive(8)",
    ),
    (
        "asks.lua",
        "local Tip, Step = module('Tip', 'z'), module('Step', 'h')
         local s = lsystem { object = extruder() }
         s:axiom(Tip(0))
         s:rule('Tip(z)', function(this, z) return Step(1 + this:position().z / 10), Tip(this:position().z) end)
         s:interpret('Step(h)', function(this, h) this:extrude(h) end)
         s:derive(12)",
    ),
    (
        "two.lua",
        "local A, B = module('A', 'x'), module('B', 'x')
         local first = lsystem {}
         first:axiom(A(1))
         first:rule('A(x)', function(this, x) return A(x + 1), B(x) end)
         local derived = first:derive(6)
         local count = #derived.chains[1]
         local second = lsystem {}
         second:axiom(A(count))
         second:rule('A(x)', function(this, x) return A(x + count), B(count) end)
         second:derive(6)",
    ),
    (
        "steps.lua",
        "local A, B = module('A', 'n'), module('B', 'n')
         local s = lsystem {}
         s:axiom(A(0))
         s:rule('A(n)', { when = function() return step() % 4 == 3 end }, function() return B(step()), A(step()) end)
         s:rule('B(n)', function(this, n) if step() > 6 then return B(n + step() / 10) end end)
         s:derive(12)",
    ),
    (
        "drawn_steps.lua",
        "local A = module('A')
         local s = lsystem { object = extruder() }
         s:axiom(A())
         s:rule('A', { when = function(this) return this:position().z > 90 end }, [[ return nil ]])
         s:interpret('A', function(this) this:extrude(1 + step()) end)
         s:derive(12)",
    ),
    (
        "streams.lua",
        "local A, B = module('A', 'n'), module('B', 'u')
         local s = lsystem { object = extruder() }
         s:axiom(A(stream('first')()))
         s:rule('A(n)', function(this, n) return B(stream('b')()), A(random() + stream('a', step())()) end)
         s:interpret('B(u)', function(this, u) this:extrude(u + stream('draws')(1, 2)) end)
         s:derive(12)",
    ),
    (
        "ends.lua",
        "local A, B = module('A', 'n'), module('B', 'n')
         local s = lsystem {}
         s:axiom(A(0))
         s:rule('A(n)', { when = function(this, n) return n < 5 end }, function(this, n) return B(n), A(n + 1) end)
         s:derive()",
    ),
];

#[test]
fn a_run_that_continues_gives_the_bytes_of_a_whole_run() {
    for (name, text) in SCRIPTS {
        let script = write(name, text);
        let store = Arc::new(DerivationStore::default());
        // Forwards, backwards, to a step that is stored, and beyond the end.
        for steps in [2, 5, 3, 8, 8, 1, 12] {
            let continued = run(&script, steps, Some(&store), 7);
            let whole = run(&script, steps, None, 7);
            assert_eq!(outcome(&continued), outcome(&whole), "{name}, {steps} steps");
            let uses = |run: &Run| -> Vec<(usize, usize)> {
                let rules = run.systems.iter().flat_map(|system| &system.rules);
                rules
                    .filter(|rule| !rule.interprets)
                    .map(|rule| (rule.done.applied, rule.done.made))
                    .collect()
            };
            assert_eq!(uses(&continued), uses(&whole), "{name}, {steps} steps");
        }
        assert!(!store.is_empty(), "{name} stores nothing");
    }
}

#[test]
fn steps_that_are_stored_are_not_derived_again() {
    let script = write("counted.lua", SCRIPTS[0].1);
    let store = Arc::new(DerivationStore::default());
    let first = run(&script, 10, Some(&store), 1);
    let next = run(&script, 12, Some(&store), 1);
    let whole = run(&script, 12, None, 1);
    // `read` is the number of symbols that the steps of this run have read.
    let read = |run: &Run| run.systems[0].times.read;
    assert_eq!(read(&first) + read(&next), read(&whole));
    assert_eq!(read(&run(&script, 12, Some(&store), 1)), 0);
}

#[test]
fn a_change_of_the_script_the_seed_or_a_parameter_starts_from_the_axiom() {
    let text = |by: u32| {
        format!(
            "local by = param('by', {{ default = 1, min = 0, max = 9, step = 1 }})
             local A, B = module('A', 'x'), module('B', 'x')
             local s = lsystem {{}}
             s:axiom(A(0))
             s:rule('A(x)', function(this, x) return B(random()), A(x + by + {by}) end)
             s:derive(6)"
        )
    };
    let script = write("changed.lua", &text(1));
    let store = Arc::new(DerivationStore::default());
    let chain = |seed, set: &[(&str, &str)], store: Option<&Arc<DerivationStore>>| {
        let mut options = RunOptions { seed, ..burgeon::options() };
        options.params.set =
            set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
        options.inputs.derivations = store.cloned();
        burgeon::run(&script, options).expect("a run").systems[0].chain_text()
    };
    let mut chains = Vec::new();
    for (seed, set) in [(1, &[][..]), (2, &[]), (1, &[("by", "3")])] {
        assert_eq!(chain(seed, set, Some(&store)), chain(seed, set, None));
        chains.push(chain(seed, set, Some(&store)));
    }
    // A save within the resolution of the file system's clock must differ in length.
    std::fs::write(&script, text(20)).expect("a script");
    assert_eq!(chain(1, &[], Some(&store)), chain(1, &[], None));
    chains.push(chain(1, &[], Some(&store)));
    chains.sort();
    chains.dedup();
    assert_eq!(chains.len(), 4);
}

#[test]
fn rules_that_print_and_objects_that_keep_their_state_are_derived_again() {
    let prints = "local A = module('A', 'n')
         local s = lsystem {}
         s:axiom(A(0))
         s:rule('A(n)', function(this, n) print(n) return A(n + 1) end)
         s:derive(4)";
    let keeps = "local A, F = module('A'), module('F')
         local s = lsystem { object = network {} }
         s:axiom(A())
         s:rule('A', function() return F(), A() end)
         s:interpret('F', function(this) end)
         s:derive(4)";
    for (name, text) in [("prints.lua", prints), ("keeps.lua", keeps)] {
        let script = write(name, text);
        let store = Arc::new(DerivationStore::default());
        for steps in [2, 4] {
            let continued = run(&script, steps, Some(&store), 1);
            assert_eq!(outcome(&continued), outcome(&run(&script, steps, None, 1)), "{name}");
        }
        assert!(store.is_empty(), "{name} is stored");
    }
}

#[test]
fn a_script_that_changes_while_it_runs_does_not_give_its_chains_to_the_next_run() {
    let text = |by: u32| {
        format!(
            "print('begin')
             local A, B = module('A', 'x'), module('B', 'x')
             local s = lsystem {{}}
             s:axiom(A(0))
             s:rule('A(x)', function(this, x) return B(x), A(x + {by}) end)
             s:derive(6)"
        )
    };
    let script = write("saved.lua", &text(1));
    let store = Arc::new(DerivationStore::default());
    let mut options = burgeon::options();
    options.inputs.derivations = Some(Arc::clone(&store));
    let saved = (script.clone(), text(2));
    options.reports.print = Some(Print::new(move |_| std::fs::write(&saved.0, &saved.1).expect("a script")));
    let first = burgeon::run(&script, options).expect("a run");
    assert!(!store.is_empty());
    let second = run(&script, 6, Some(&store), 0);
    assert_eq!(outcome(&second), outcome(&run(&script, 6, None, 0)));
    assert_ne!(first.systems[0].chain_text(), second.systems[0].chain_text());
}
