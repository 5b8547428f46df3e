//! CPU time of many steps that change little: growth at one place, with and without contexts, questions for a place, and events. Then the
//! CPU time of a step on many modules that see the new chain, or that ask an environment.
//!
//! `cargo bench --bench steps`. If the cost of a step is the cost of what changes, twice as many steps take twice as long.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]

use burgeon::script::RunOptions;
use cpu_time::ThreadTime;

/// Systems that add modules at one place, with the largest number of steps.
const SYSTEMS: [(&str, usize, &str); 12] = [
    ("growth", 80_000, "s:axiom(A()) s:rule('A', function() return F(), A() end)"),
    ("nested branches", 80_000, "s:axiom(A()) s:rule('A', function() return F(), { A() } end)"),
    ("left context", 80_000, "s:axiom(F(), A()) s:rule('F < A', function() return F(), A() end)"),
    (
        "guards and random numbers",
        80_000,
        "s:axiom(A()) s:rule('A', { when = function() return true end }, function() return random() < 2 and F(), A() end)",
    ),
    (
        "questions for the place",
        40_000,
        "s:axiom(A()) s:rule('A', { when = function(this) return this:position().z >= 0 end }, function() return F(), A() end)",
    ),
    (
        "questions in nested branches",
        40_000,
        "s:axiom(A()) s:interpret('F', function(this) this:forward(1) end)
         s:rule('A', { when = function(this) return this:position().z >= 0 end }, function() return F(), { A() } end)",
    ),
    (
        "questions beside branches",
        40_000,
        "s:axiom(A()) s:interpret('F', function(this) this:forward(1) end)
         s:rule('A', function(this) if this:position().z >= 0 then return F(), { F() }, A() end end)",
    ),
    (
        "one change among a million modules",
        20_000,
        "local list = table.create(1000000, F()) list[500000] = B(0) s:axiom(sequence(list))
         s:rule('B(n)', function(_, n) return B(n + 1) end)",
    ),
    (
        "events from one module",
        80_000,
        "s:axiom(A()) s:rule('A', { propensity = 1 }, function() return A(), A() end)",
    ),
    (
        "events among a million modules",
        20_000,
        "s:axiom(sequence(table.create(1000000, B(1))))
         s:rule('B(n)', { propensity = function(_, n) return n end }, function(_, n) return B(n + 1) end)",
    ),
    (
        "events and hooks, a million modules",
        20_000,
        "s:axiom(sequence(table.create(1000000, B(1))))
         s:rule('B(n)', { propensity = function(_, n) return n end }, function(_, n) return B(n + 1) end)
         s:after_step(function(now) if now.time < 0 then stop() end end)",
    ),
    (
        "events with contexts, a million modules",
        20_000,
        "local list = table.create(1000000, F()) for i = 500, 1000000, 1000 do list[i] = A() end
         s:axiom(sequence(list))
         s:rule('A < F', { propensity = 1 }, function() return A() end)
         s:rule('F > A', { propensity = 2 }, function() return A() end)",
    ),
];

/// Systems of which one step changes many modules, with their number.
const WIDE: [(&str, usize, &str); 3] = [
    (
        "new contexts along one axis",
        1_000_000,
        "local list = table.create(1000000, F()) s:axiom(B(0), sequence(list))
         s:rule('B(n) << F', function(_, n) return B(n + 1) end)",
    ),
    (
        "new contexts in 10,000 branches",
        1_000_000,
        "local list, branch = { B(0) }, table.create(100, F())
         for i = 1, 10000 do list[i + 1] = branch end
         s:axiom(sequence(list))
         s:rule('B(n) << F', function(_, n) return B(n + 1) end)",
    ),
    (
        "light of 100,000 tips",
        100_000,
        "local light = shadow_voxels({ size = 0.25, depth = 10 })
         s = lsystem({ object = turtle(), environment = light })
         local list = table.create(100000)
         for i = 1, 100000 do list[i] = B(i) end
         s:axiom(sequence(list))
         s:rule('B(n)', function(_, n)
           return if light:light(vec(n % 300, n // 300, n % 7)) < 0 then B(0) else B(n)
         end)
         s:interpret('B(n)', function(_, n) light:shade(vec(n % 300, n // 300, n % 7)) end)",
    ),
];

fn main() {
    println!("CPU time                       a step (s)   million modules a second");
    for (name, modules, rules) in WIDE {
        let (one, more) = (seconds(rules, 1), seconds(rules, 3));
        let none = seconds(rules, 0);
        // A rule with a context in the new chain changes the chain only once.
        let step = if name.starts_with("light") { (more - one) / 2.0 } else { one - none };
        println!("{name:32} {step:8.3} {:12.2}", modules as f64 / step / 1e6);
    }
    println!("CPU seconds            steps/8    steps/4    steps/2      steps   a step (us)");
    for (name, most, rules) in SYSTEMS {
        let times = [8, 4, 2, 1].map(|divisor| seconds(rules, most / divisor));
        let base = seconds(rules, 1);
        let each = (times[3] - base) / most as f64 * 1e6;
        let [a, b, c, d] = times;
        println!("{name:36} {a:8.3} {b:8.3} {c:8.3} {d:8.3} {each:8.1}  {most} steps");
    }
}

/// Returns the CPU time (s) of a run with one thread: the least of three.
fn seconds(rules: &str, steps: usize) -> f64 {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("main.lua");
    let script = format!(
        "local F, A, B = module('F'), module('A'), module('B', 'n')
        local s = lsystem({{ object = turtle() }})
        {rules}
        s:derive({steps})\n"
    );
    std::fs::write(&path, script).expect("a file");
    let options = RunOptions { threads: Some(1), ..burgeon::options() };
    let time = || {
        let begin = ThreadTime::now();
        burgeon::run(&path, options.clone()).expect("a run");
        begin.elapsed().as_secs_f64()
    };
    (0..3).map(|_| time()).fold(f64::INFINITY, f64::min)
}
