//! CPU time of 300 steps of a plant of 13 rules with up to 18 parameters, guards and contexts, which grows to 1,900 internodes.
//! `cargo bench --bench plant`.
//!
//! An apex `A` makes internodes `I` with leaves `L` and dormant buds `B`. A signal of the apices passes down the internodes, and
//! a bud grows where it is weak. Internodes pass on what the roots send, lengthen and thicken. Apices end as flowers `K`, which
//! become fruits `Z`. All numbers are multiples of 1/128, so that programs with numbers of 32 bits compute the same chain.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]

use burgeon::script::RunOptions;
use cpu_time::ThreadTime;

/// Parameters of apices and buds: age, internodes, order, sap, sum, three constants of growth, limit and strength of the signal,
/// orders, length, and more.
const APEX: &str = "t, n, o, v, s, p, q, r, g, h, e, d, l, w, a, c, z, m";

/// Parameters of internodes: length, age, width, signal, sap, order, number and distance.
const INTERNODE: &str = "l, a, w, s, v, o, n, g";

/// Pattern, guard and successor of each rule. In patterns, `@` and `#` stand for the parameters of apices and internodes, and a
/// digit after them is added to each name.
const RULES: [(&str, &str, &str); 13] = [
    ("A(@)", "t < p and n < m", "A(t+1, n, o, v, s+v/64, p, q, r, g, h, e, d, l, w, a, c+1, z, m)"),
    (
        "A(@)",
        "n < m",
        "I(1, 0, w, h, v, o, n, 0), { L(1, 0, o) }, { B(0, 0, o+1, v/2, s, p+q, q, r, g, h, e, d, l, w, a, c, z+1, m-r*8) }, A(0, n+1, o, v, s, p, q, r, g, h, e, d+1, l, w, a, 0, z, m)",
    ),
    ("A(@)", "n >= m", "K(0, o)"),
    (
        "I(#0) < B(@)",
        "s0 < g and o < e and n0 < l*4",
        "A(t, n, o, v0, 0, p, q, r, g, h, e, d, l, w, a, c, z, m)",
    ),
    ("B(@)", "t < a", "B(t+1, n, o, v, s, p, q, r, g, h, e, d, l, w, a, c, z, m)"),
    ("I(#0) < I(#) > A(@1)", "", "I(l+1/16, a+1, w, h1, v0+1/64, o, n, g+1)"),
    ("I(#0) < I(#) > I(#1)", "s1 > 0 and a < 48", "I(l+1/8, a+1, w+1/64, s1-1, v0+1/64, o, n, g1+1)"),
    ("I(#) > I(#1)", "s1 > 0", "I(l, a+1, w+1/64, s1-1, v, o, n, g)"),
    ("I(#)", "a < 2000", "I(l, a+1, w, 0, v, o, n, g)"),
    ("L(x, a, o)", "a < 40", "L(x+1/8, a+1, o)"),
    ("L(x, a, o)", "a >= 40 and o > 0", "nil"),
    ("K(a, o)", "a < 30", "K(a+1, o)"),
    ("K(a, o)", "", "Z(o, a)"),
];

const STEPS: usize = 300;

fn main() {
    let (one, all) = (seconds(1), seconds(STEPS));
    println!("{STEPS} steps: {:.3} s of CPU time, {:.3} s with the start", all.0 - one.0, all.0);
    println!("{} modules, {} internodes", all.1, all.2);
}

/// Returns the names of parameters, each followed by `suffix`.
fn suffixed(names: &str, suffix: &str) -> String {
    names.split(", ").map(|name| format!("{name}{suffix}")).collect::<Vec<_>>().join(", ")
}

/// Returns a pattern with the names of all its parameters, and these names.
fn expanded(pattern: &str) -> (String, String) {
    let mut text = pattern.to_owned();
    for (sign, names) in [("@", APEX), ("#", INTERNODE)] {
        for suffix in ["0", "1", ""] {
            text = text.replace(&format!("({sign}{suffix})"), &format!("({})", suffixed(names, suffix)));
        }
    }
    let formals = text.split('(').skip(1).filter_map(|rest| rest.split(')').next());
    let formals = formals.collect::<Vec<_>>().join(", ");
    (text, formals)
}

fn script(steps: usize) -> String {
    let mut text = String::from("local s = lsystem({})\n");
    for (name, names) in
        [("A", APEX), ("B", APEX), ("I", INTERNODE), ("L", "x, a, o"), ("K", "a, o"), ("Z", "o, a")]
    {
        let names = names.replace(", ", "', '");
        text.insert_str(0, &format!("local {name} = module('{name}', '{names}')\n"));
    }
    text.push_str(
        "s:axiom(I(1, 0, 1, 8, 64, 0, 0, 0), A(0, 0, 0, 64, 0, 3, 4, 2, 2, 9, 3, 0, 3, 1, 100, 0, 0, 60))\n",
    );
    for (pattern, guard, successor) in RULES {
        let (pattern, formals) = expanded(pattern);
        let guard = match guard {
            "" => String::new(),
            guard => format!("{{ when = function(_, {formals}) return {guard} end }}, "),
        };
        text.push_str(&format!(
            "s:rule('{pattern}', {guard}function(_, {formals}) return {successor} end)\n"
        ));
    }
    text.push_str(&format!("s:derive({steps})\n"));
    text
}

/// Returns the CPU time (s) of a run with one thread, the least of five, and the numbers of modules and internodes.
fn seconds(steps: usize) -> (f64, usize, usize) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("main.lua");
    std::fs::write(&path, script(steps)).expect("a file");
    let options = RunOptions { threads: Some(1), ..burgeon::options() };
    let runs = (0..5).map(|_| {
        let begin = ThreadTime::now();
        let run = burgeon::run(&path, options.clone()).expect("a run");
        let time = begin.elapsed().as_secs_f64();
        let system = &run.systems[0];
        (time, system.modules(), system.chain_text().matches("I(").count())
    });
    runs.min_by(|one, two| one.0.total_cmp(&two.0)).expect("five runs")
}
