//! Six rewriting workloads, compared with the crate `symbios` in the same process: CPU time of one thread, wall-clock
//! time of two threads with and without the start of the second one, and peak memory.
//!
//! `cargo bench --bench rewriting [-- WORKLOAD...]`.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]

use std::io::Write;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use burgeon::script::RunOptions;
use cpu_time::ThreadTime;

struct Workload {
    name: &'static str,
    about: &'static str,
    steps: usize,
    script: &'static str,
    symbios: fn(&mut symbios::System),
}

const WORKLOADS: &[Workload] = &[
    Workload {
        name: "a",
        about: "parametric growth",
        steps: 32,
        script: r#"
local A, B = module("A", "x"), module("B", "x")
local s = lsystem()
s:axiom(A(1))
s:rule("A(x)", function(this, x) return A(x * 0.5), B(x) end)
s:rule("B(x)", function(this, x) return A(x) end)
"#,
        symbios: |system| {
            rules(system, &["A(x) -> A(x*0.5) B(x)", "B(x) -> A(x)"]);
            axiom(system, "A(1)");
        },
    },
    Workload {
        name: "b",
        about: "monopodial tree",
        steps: 20,
        script: r#"
local A, B, C = module("A", "l", "w"), module("B", "l", "w"), module("C", "l", "w")
local S, T, D, R = module("S", "l", "w"), module("T", "a"), module("D", "a"), module("R", "a")
local s = lsystem()
s:axiom(A(1, 10))
s:rule("A(l, w)", function(this, l, w)
  return S(l, w), { D(45), B(l * 0.6, w * 0.707) }, R(137.5), A(l * 0.9, w * 0.707)
end)
s:rule("B(l, w)", function(this, l, w)
  return S(l, w), { T(-45), C(l * 0.6, w * 0.707) }, C(l * 0.9, w * 0.707)
end)
s:rule("C(l, w)", function(this, l, w)
  return S(l, w), { T(45), B(l * 0.6, w * 0.707) }, B(l * 0.9, w * 0.707)
end)
"#,
        symbios: |system| {
            rules(
                system,
                &[
                    "A(l,w) -> F(l,w) [ &(45) B(l*0.6,w*0.707) ] /(137.5) A(l*0.9,w*0.707)",
                    "B(l,w) -> F(l,w) [ -(45) C(l*0.6,w*0.707) ] C(l*0.9,w*0.707)",
                    "C(l,w) -> F(l,w) [ +(45) B(l*0.6,w*0.707) ] B(l*0.9,w*0.707)",
                ],
            );
            axiom(system, "A(1,10)");
        },
    },
    Workload {
        name: "c acropetal",
        about: "a signal towards the tips",
        steps: 38,
        script: r#"
local A, I, T = module("A", "n"), module("I", "s"), module("T", "a")
local s = lsystem()
s:ignore("T")
s:axiom(I(1), A(18))
s:rule("A(n)", { when = function(this, n) return n > 0 end }, function(this, n)
  return I(0), { T(45), A(n - 1) }, A(n - 1)
end)
s:rule("I(a) < I(s)", function(this, a, s) return I((a + s) / 2) end)
"#,
        symbios: |system| {
            directive(system, "#ignore: +");
            rules(system, &["A(n) : n > 0 -> I(0) [ +(45) A(n-1) ] A(n-1)", "I(a) < I(s) -> I((a+s)/2)"]);
            axiom(system, "I(1) A(18)");
        },
    },
    Workload {
        name: "c basipetal",
        about: "a signal towards the base",
        steps: 38,
        script: r#"
local A, I, T = module("A", "n"), module("I", "s"), module("T", "a")
local s = lsystem()
s:ignore("T")
s:axiom(I(1), A(18))
s:rule("A(n)", { when = function(this, n) return n > 0 end }, function(this, n)
  return I(0), { T(45), A(n - 1) }, A(n - 1)
end)
s:rule("I(s) > I(a)", function(this, s, a) return I((a + s) / 2) end)
"#,
        symbios: |system| {
            directive(system, "#ignore: +");
            rules(system, &["A(n) : n > 0 -> I(0) [ +(45) A(n-1) ] A(n-1)", "I(s) > I(a) -> I((a+s)/2)"]);
            axiom(system, "I(1) A(18)");
        },
    },
    Workload {
        name: "d",
        about: "three weighted successors",
        steps: 11,
        script: r#"
local X, L, R = module("X", "x"), module("L"), module("R")
local s = lsystem()
s:axiom(X(1))
s:rule("X(x)", { weight = 1 }, function(this, x)
  local h = x / 2
  return X(h), { L(), X(h) }, X(h), { R(), X(h) }, X(h)
end)
s:rule("X(x)", { weight = 1 }, function(this, x)
  local h = x / 2
  return X(h), { L(), X(h) }, X(h)
end)
s:rule("X(x)", { weight = 1 }, function(this, x)
  local h = x / 2
  return X(h), { R(), X(h) }, X(h)
end)
"#,
        symbios: |system| {
            rules(
                system,
                &[
                    "1 : X(x) -> X(x/2) [ + X(x/2) ] X(x/2) [ - X(x/2) ] X(x/2)",
                    "1 : X(x) -> X(x/2) [ + X(x/2) ] X(x/2)",
                    "1 : X(x) -> X(x/2) [ - X(x/2) ] X(x/2)",
                ],
            );
            axiom(system, "X(1)");
        },
    },
    Workload {
        name: "w",
        about: "a thousand nested branches",
        steps: 1005,
        script: r#"
local A, I = module("A", "n"), module("I", "s")
local s = lsystem()
s:axiom(A(1000))
s:rule("A(n)", { when = function(this, n) return n > 0 end }, function(this, n)
  return I(0), { A(n - 1) }, I(0)
end)
s:rule("I(s) > I(a)", function(this, s, a) return I((a + s) / 2) end)
"#,
        symbios: |system| {
            rules(system, &["A(n) : n > 0 -> I(0) [ A(n-1) ] I(0)", "I(s) > I(a) -> I((a+s)/2)"]);
            axiom(system, "A(1000)");
        },
    },
];

fn rules(system: &mut symbios::System, rules: &[&str]) {
    for rule in rules {
        system.add_rule(rule).expect("the workload's rule is valid");
    }
}

fn axiom(system: &mut symbios::System, axiom: &str) {
    system.set_axiom(axiom).expect("the workload's axiom is valid");
}

fn directive(system: &mut symbios::System, directive: &str) {
    system.add_directive(directive).expect("the workload's directive is valid");
}

/// Writes the workload's script, which runs `times` times. From the second run on, the Lua machines of all threads
/// exist.
fn write_script(workload: &Workload, steps: usize, times: usize) -> PathBuf {
    let path = std::env::temp_dir().join(format!("burgeon bench {} {steps}.lua", std::process::id()));
    let mut file = std::fs::File::create(&path).expect("the temporary folder can be written to");
    for _ in 0..times {
        write!(file, "do\n{}\ns:derive({steps})\nend\n", workload.script).expect("the disk is not full");
    }
    path
}

struct Measure {
    cpu: Duration,
    wall: Duration,
    read: usize,
    modules: usize,
}

fn ours(workload: &Workload, threads: usize, steps: usize, times: usize) -> Measure {
    let path = write_script(workload, steps, times);
    let cpu = ThreadTime::now();
    let run = burgeon::run(&path, RunOptions { threads: Some(threads), seed: 7, ..burgeon::options() });
    let run = run.expect("the workload runs");
    let cpu = cpu.elapsed();
    std::fs::remove_file(path).ok();
    let system = &run.systems[times - 1];
    Measure {
        cpu,
        wall: system.times.rewriting,
        read: system.times.read,
        modules: system.chain.symbols.len(),
    }
}

fn theirs(workload: &Workload) -> Measure {
    let mut system = symbios::System::new();
    system.max_capacity = 1 << 28;
    system.state.max_capacity = 1 << 28;
    system.set_seed(7);
    (workload.symbios)(&mut system);
    let (begin, cpu) = (Instant::now(), ThreadTime::now());
    let mut read = 0;
    for _ in 0..workload.steps {
        read += system.state.len();
        system.derive(1).expect("the workload derives");
    }
    Measure { cpu: cpu.elapsed(), wall: begin.elapsed(), read, modules: system.state.len() }
}

#[allow(clippy::cast_precision_loss, reason = "shown with three digits")]
fn rate(read: usize, time: Duration) -> f64 {
    read as f64 / time.as_secs_f64() / 1e6
}

/// Returns the peak resident memory of this process so far (bytes).
fn peak() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.and_then(|line| line.split_whitespace().next()?.parse::<usize>().ok()).unwrap_or(0) * 1024
}

/// Measures the peak memory per final symbol (bytes) in a separate process, relative to a run without steps. Returns
/// `None` if there are too few symbols to measure.
fn memory(workload: &Workload) -> Option<f64> {
    let run = |steps: usize| -> (f64, f64) {
        let program = std::env::current_exe().expect("the bench knows its own file");
        let output = std::process::Command::new(program)
            .args(["memory", workload.name, &steps.to_string()])
            .output()
            .expect("the bench can run itself");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let mut numbers = text.split_whitespace().filter_map(|number| number.parse().ok());
        (numbers.next().unwrap_or(f64::NAN), numbers.next().unwrap_or(f64::NAN))
    };
    let (empty, _) = run(0);
    let (full, modules) = run(workload.steps);
    (modules > 100_000.0).then(|| (full - empty) / modules)
}

fn main() {
    let arguments: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    if let [command, name, steps] = arguments.as_slice()
        && command == "memory"
    {
        let workload = WORKLOADS.iter().find(|workload| workload.name == name).expect("a known workload");
        let measure = ours(workload, 1, steps.parse().expect("a number of steps"), 1);
        println!("{} {}", peak(), measure.modules);
        return;
    }
    println!("Rewriting, million symbols read per second; the best of five.");
    println!(
        "| workload | symbols read | Burgeon, 1 thread | symbios | ratio | 2 threads / 1 | with its start | bytes/symbol |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for workload in WORKLOADS {
        if !arguments.is_empty() && !arguments.iter().any(|name| workload.name.starts_with(name.as_str())) {
            continue;
        }
        let start = (0..5).map(|_| ours(workload, 1, 0, 1).cpu).min().unwrap_or_default();
        let (mut one, mut other) = (0.0f64, 0.0f64);
        let (mut wall_one, mut read) = (Duration::MAX, 0);
        let mut wall_two = Duration::MAX;
        let (mut first_one, mut first_two) = (Duration::MAX, Duration::MAX);
        for _ in 0..5 {
            let measure = ours(workload, 1, workload.steps, 1);
            one = one.max(rate(measure.read, measure.cpu.saturating_sub(start)));
            read = measure.read;
            wall_one = wall_one.min(ours(workload, 1, workload.steps, 2).wall);
            let measure = ours(workload, 2, workload.steps, 2);
            wall_two = wall_two.min(measure.wall);
            first_one = first_one.min(ours(workload, 1, workload.steps, 1).wall);
            first_two = first_two.min(ours(workload, 2, workload.steps, 1).wall);
            let measure = theirs(workload);
            other = other.max(rate(measure.read, measure.cpu));
        }
        let speedup = wall_one.as_secs_f64() / wall_two.as_secs_f64();
        let first = first_one.as_secs_f64() / first_two.as_secs_f64();
        let bytes = memory(workload).map_or_else(|| "few".to_owned(), |bytes| format!("{bytes:.1}"));
        println!(
            "| {}: {} | {:.1} M | {one:.1} | {other:.1} | {:.2} | {speedup:.2} | {first:.2} | {bytes} |",
            workload.name,
            workload.about,
            read as f64 / 1e6,
            one / other,
        );
    }
}
