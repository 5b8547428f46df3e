//! The number of the step in rules, guards and interpretations, and derivations that continue because of it.

use std::sync::Arc;

use burgeon::script::{DerivationStore, Print, RunOptions};
use burgeon::{Result, Run};
use burgeon_rewriting::ClosureSystem;

use super::scripts::{all_chains, chain, divided, error, run, run_with, try_run};

/// Returns the number of steps and the chain of the system that was derived last.
fn ends(script: &str) -> (usize, String) {
    let run = run(script);
    let system = run.systems.last().expect("a derived system");
    (system.steps, system.chain_text().trim_end().to_owned())
}

/// Returns a script with a system of modules `A` and `B(n)`, whose axiom is `A`.
fn system(rules: &str, end: &str) -> String {
    format!(
        "local A, B = module('A'), module('B', 'n')
         local s = lsystem {{}}
         s:axiom(A())
         {rules}
         {end}"
    )
}

/// Returns the lines that a script prints.
fn prints(script: &str, options: RunOptions) -> Vec<String> {
    let (sender, lines) = std::sync::mpsc::channel();
    let mut options = options;
    options.reports.print = Some(Print::new(move |line| sender.send(line.to_owned()).expect("a receiver")));
    run_with(script, options);
    lines.try_iter().collect()
}

#[test]
fn the_first_step_has_the_number_1() {
    let rules = "s:rule('A', function() return A(), { B(step()) } end)
                 s:rule('B(n)', { when = function(this, n) return n == step() - 1 end }, [[ return B(n * 10), B(step()) ]])";
    assert_eq!(chain(&system(rules, "s:derive(3)")), "A [ B(3) ] [ B(20) B(3) ] [ B(10) B(20) B(3) ]");
}

#[test]
fn an_interpretation_has_the_number_of_the_step_that_made_its_chain() {
    let script = |object: &str, end: &str| {
        format!(
            "local A, B = module('A'), module('B')
             local s = lsystem {{ object = extruder(){object} }}
             s:axiom(A())
             s:rule('A', function(this) local edges = this:open_edges() return A(), B() end)
             s:interpret('A', function(this) print(step()) this:extrude(1) end)
             {end}"
        )
    };
    assert_eq!(prints(&script("", "s:derive(3)"), burgeon::options()), ["0", "1", "2", "3"]);
    assert_eq!(prints(&script(", interpret = 'last'", "s:derive(3)"), burgeon::options()), ["3"]);
    assert_eq!(prints(&script("", "s:derive(0)"), burgeon::options()), ["0"]);
    let options = RunOptions { steps: Some(2), ..burgeon::options() };
    assert_eq!(prints(&script("", "s:derive()"), options), ["0", "1", "2"]);
}

#[test]
fn a_derivation_continues_if_a_guard_or_a_rule_reads_the_number() {
    let late = "s:rule('A', { when = function() return step() == 4 end }, function() return B(step()) end)";
    assert_eq!(ends(&system(late, "s:derive(6)")), (4, "B(4)".into()));
    assert_eq!(ends(&system(late, "s:derive(3)")), (3, "A".into()));
    let kept = "s:rule('A', function() if step() == 4 then return B(step()) end end)";
    assert_eq!(ends(&system(kept, "s:derive(6)")), (4, "B(4)".into()));
    let helper = "local function late(n: number): boolean return step() >= n end
                  s:rule('A', { when = function() return late(4) end }, function() return B(step()) end)";
    assert_eq!(ends(&system(helper, "s:derive(6)")), (4, "B(4)".into()));
    let string = "s:rule('A', [[ if step() == 4 then return B(step()) end ]])";
    assert_eq!(ends(&system(string, "s:derive(6)")), (4, "B(4)".into()));
    // `B` is replaced by itself only while the guard reads the number.
    let guarded = "s:rule('A', function() return B(0) end)
                   s:rule('B(n)', { when = function(this, n) return n == 0 and step() == 5 end }, [[ return B(step()) ]])";
    assert_eq!(ends(&system(guarded, "s:derive(9)")), (5, "B(5)".into()));
}

#[test]
fn a_system_that_does_not_read_the_number_ends_as_before() {
    let other = "local t = lsystem {}
                 t:axiom(A())
                 t:rule('A', { when = function() return step() == 4 end }, [[ return B(1) ]])
                 t:derive(6)
                 s:rule('A', function() return B(2) end)
                 s:derive()";
    assert_eq!(ends(&system(other, "")), (1, "B(2)".into()));
    let unread = "s:rule('A', function() return B(2) end)
                  s:rule('B(n)', { when = function(this, n) return n > 5 and step() == 4 end }, [[ return A() ]])
                  s:derive(9)";
    assert_eq!(ends(&system(unread, "")), (1, "B(2)".into()));
    // A local variable of this name is something else.
    let local = "local step = 3
                 s:rule('A', function() return B(step) end)
                 s:derive()";
    assert_eq!(ends(&system(local, "")), (1, "B(3)".into()));
}

#[test]
fn a_derivation_continues_if_an_interpretation_reads_the_number() {
    let script = |rules: &str, object: &str| {
        format!(
            "local A, B = module('A'), module('B')
             local s = lsystem {{ object = extruder(){object} }}
             s:axiom(A())
             {rules}
             s:interpret('A', function(this) this:extrude(1 + step()) end)
             s:derive(5)"
        )
    };
    let height = |run: &Run| {
        let positions = run.scene.meshes.iter().flat_map(|mesh| &mesh.parts).flat_map(|part| &part.positions);
        positions.map(|position| f64::from(position.z)).fold(0.0, f64::max)
    };
    // With and without passes before the last.
    for (rules, object) in [
        ("", ""),
        ("s:rule('B', function(this) local at = this:position() return A() end)", ""),
        ("s:rule('B', function(this) local at = this:position() return A() end)", ", interpret = 'last'"),
        ("s:rule('A', { when = function() return step() < 3 end }, [[ return A() ]])", ""),
    ] {
        let run = run(&script(rules, object));
        assert_eq!((run.systems[0].steps, height(&run)), (5, 6.0), "{rules} {object}");
    }
}

#[test]
fn the_number_needs_a_number_of_steps() {
    let late = "s:rule('A', { when = function() return step() == 4 end }, [[ return B(1) ]])";
    for rules in [late, "s:rule('A', function() return B(step()) end)"] {
        let told = error(&system(rules, "s:derive()"));
        assert!(
            told.contains("step() needs a number of steps") && told.contains("system:derive(20)"),
            "{rules}: {told}"
        );
    }
    let drawn = "local A = module('A')
         local s = lsystem { object = extruder() }
         s:axiom(A())
         s:interpret('A', function(this) this:extrude(step()) end)
         s:derive()";
    assert!(error(drawn).contains("step() needs a number of steps"));
    let options = RunOptions { steps: Some(6), ..burgeon::options() };
    let run = run_with(&system(late, "s:derive()"), options);
    assert_eq!((run.systems[0].steps, all_chains(&run)), (4, "B(1)\n".into()));
}

#[test]
fn the_top_level_and_functions_of_axioms_have_no_step() {
    for script in [
        "print(step())",
        "local A = module('A', 'n')
         local s = lsystem {}
         s:axiom(source({ { id = 'a' } }), function() return A(step()) end)
         s:derive(1)",
        "local A = module('A')
         local s = lsystem {}
         s:axiom(A())
         s:rule('A', function() return A() end)
         s:derive(2)
         print(step())",
    ] {
        let told = error(script);
        assert!(told.contains("step() is known only while"), "{told}");
    }
}

#[test]
fn a_derivation_without_a_number_of_steps_does_not_continue_from_one_with_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("main.lua");
    let late = "s:rule('A', { when = function() return step() == 2 end }, [[ return B(step()) ]])";
    std::fs::write(&path, system(late, "s:derive()")).expect("a script");
    let store = Arc::new(DerivationStore::default());
    let run = |steps: Option<usize>| -> Result<Run> {
        let mut options = RunOptions { steps, ..burgeon::options() };
        options.inputs.derivations = Some(Arc::clone(&store));
        burgeon::run(&path, options)
    };
    assert_eq!(all_chains(&run(Some(4)).expect("a run")), "B(2)\n");
    assert!(!store.is_empty());
    let Err(error) = run(None) else { panic!("step() needs a number of steps") };
    assert!(error.to_string().contains("step() needs"), "{error}");
    assert_eq!(all_chains(&run(Some(5)).expect("a run")), "B(2)\n");
}

#[test]
fn the_number_is_the_same_for_any_number_of_threads_and_any_batch() {
    let script = "local A, B = module('A', 'n'), module('B', 'n')
        local list = {}
        for i = 1, 300 do list[i] = A(i) end
        local s = lsystem { object = extruder() }
        s:axiom(table.unpack(list))
        s:rule('A(n)', { when = function(this, n) return (n + step()) % 7 == 3 end }, [[ return B(n * 100 + step()), A(n) ]])
        s:rule('B(n)', function(this, n) if step() > 8 then return B(n + step()), B(1) end end)
        s:interpret('B(n)', function(this, n) this:extrude(1 + (n + step()) % 5) end)
        s:derive(12)";
    let outcome = |threads, batch| {
        let run = run_with(script, divided(threads, batch));
        (all_chains(&run), burgeon::export::gltf::glb(&run.scene).expect("a model"))
    };
    let expected = outcome(1, 4096);
    for (threads, batch) in [(1, 1), (3, 10), (5, 100)] {
        assert!(outcome(threads, batch) == expected, "{threads} threads, {batch} modules");
    }
}

#[test]
fn in_the_rules_of_a_terrain_the_step_is_the_level_of_the_new_cells() {
    let script = "local Cell = module('Cell', 'height')
        local cells = lsystem {}
        cells:axiom(Cell(0))
        cells:rule('Cell(height)', function(this, height)
          local up = if step() == 1 then 100 else 0
          return Cell(height + up), Cell(height + up), Cell(height + up), Cell(height + up)
        end)
        local land = lsystem { object = terrain { rules = cells, size = 400, levels = 5 } }
        land:derive()";
    match try_run(script, burgeon::options()) {
        Ok(run) => {
            let parts = run.scene.meshes.iter().flat_map(|mesh| &mesh.parts);
            let top = parts.flat_map(|part| &part.positions).map(|at| at.z).fold(0.0, f32::max);
            assert!((99.0..=101.0).contains(&top), "{top}");
        }
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn closures_read_the_number_too() {
    let mut system = ClosureSystem::new(0);
    let (a, b) = (system.module("A", &[]).expect("A"), system.module("B", &["n"]).expect("B"));
    system
        .rule_when("A", |module| module.step() == 4, move |module, out| out.push(b, &[module.step() as f64]))
        .expect("a rule");
    let first = system.chain(|out| out.push(a, &[])).expect("a chain");
    assert_eq!(system.text(&system.derive(first.clone(), 3).expect("a chain")), "A\n");
    assert_eq!(system.text(&system.derive(first, 9).expect("a chain")), "B(4)\n");
}
