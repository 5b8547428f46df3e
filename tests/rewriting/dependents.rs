//! Modules that depend on others of the same step: one call of functions gives the same results as a call for each module.
//!
//! A script that contains the word "print" is rewritten by calls for each module, so that printed texts keep their order.

use std::time::Duration;

use super::scripts::{all_chains, divided, try_run};
use burgeon::script::{Limits, RunOptions};

/// Divisions of the work: threads and modules in a batch.
const DIVISIONS: [(usize, usize); 4] = [(1, 1), (2, 2), (1, 7), (2, 4096)];

/// Returns a text with file names in place of paths, because each run has a folder of its own.
fn without_folders(text: &str) -> String {
    let words = text.split(' ').map(|word| word.rsplit('/').next().unwrap_or_default());
    words.collect::<Vec<_>>().join(" ")
}

/// Returns the chains and the warnings of a script, or its error, with these options.
fn outcome(script: &str, options: RunOptions) -> String {
    match try_run(script, options) {
        Ok(run) => {
            let warnings = run.warnings.iter().map(|warning| without_folders(&warning.to_string()));
            all_chains(&run) + &warnings.collect::<Vec<_>>().join("\n")
        }
        Err(error) => format!("error: {}", without_folders(&error.to_string())),
    }
}

/// Returns the outcome of `script`, which is the same with calls for each module and for any division of the work.
fn same_outcome(script: &str) -> String {
    let separate = format!("{script} -- print");
    let expected = outcome(&separate, divided(1, 4096));
    for (threads, batch) in DIVISIONS {
        let found = outcome(script, divided(threads, batch));
        assert_eq!(found, expected, "{threads} threads, batches of {batch}: {script}");
    }
    expected
}

/// Returns a script that derives `steps` steps of a long chain with branches.
fn grown(rules: &str, steps: usize) -> String {
    format!(
        "local A, B, C, X = module('A'), module('B', 'n'), module('C', 'x', 'what?'), module('X')
         local s = lsystem() s:ignore('X')
         local list = {{ B(1) }}
         for i = 1, 40 do
           table.insert(list, if i % 7 == 0 then X() elseif i % 5 == 0 then C(i) else A())
           if i % 6 == 0 then table.insert(list, {{ A(), {{ C(2, 'deep'), A() }}, X(), A() }}) end
         end
         s:axiom(sequence(list))
         {rules}
         s:derive({steps})"
    )
}

#[test]
fn random_numbers_and_streams_are_those_of_the_modules() {
    let found = same_outcome(&grown(
        "s:rule('B(n) << A', function(_, n)
           local r = stream('width')
           return B(random() + n), { A(), B(r(1, 2)) }
         end)
         s:rule('B(n) << C(x, _)', { when = function(_, n, x) return n > 1.5 or x == 5 end }, function(_, n, x)
           if x == 2 then return end
           return C(random(0, x)), B(n)
         end)",
        3,
    ));
    assert!(found.lines().count() == 1 && found.len() > 1000, "{found}");
}

#[test]
fn successors_of_every_form_are_the_contexts_of_later_modules() {
    let found = same_outcome(&grown(
        "local function several(n) return B(n), A() end
         local kept = C(9, 'kept')
         s:rule('B(n) << A', function(_, n)
           if n % 5 == 0 then return several(n + 1)
           elseif n % 5 == 1 then return sequence({ A(), B(n + 1), { B(0) }, X() })
           elseif n % 5 == 2 then local b = B(n + 1) local a = A() return a, { a }, b
           elseif n % 5 == 3 then return nil
           else return kept, B(n + 1) end
         end)
         s:rule('B(n) << C(x, what)', function(_, n, x, what)
           return C(x, { what, n }), B(n + (if type(what) == 'string' then #what else 0) + 1)
         end)
         s:rule('C(a, b) << C(x, y)', function(_, a, b, x, y) return C(x, b), C(a, y), B(4) end)",
        2,
    ));
    assert!(found.contains("kept") && found.len() > 300, "{found}");
    same_outcome(&grown(
        "local function turned(n) return { X() }, B(n) end
         s:rule('A >> B(n)', function(_, n)
           if n > 3 then return turned(n - 3) elseif n > 2 then return X(), B(n) end
           local x, b = X(), B(n + 1) return { b }, x, B(n + 1)
         end)
         s:rule('C(x, _) >> B(n)', function(_, x, n) return { C(x) }, B(n + x) end)
         s:rule('X >> *', function() return A(), B(2) end)
         s:rule('A > $', function() return B(1) end)",
        3,
    ));
}

#[test]
fn many_arguments_and_old_contexts_reach_the_functions() {
    let found = same_outcome(
        "local L = module('L', 'a', 'b', 'c') local s = lsystem()
         local list = {}
         for i = 1, 30 do list[i] = L(i, -i, i / 4) end
         s:axiom(sequence(list))
         s:rule('L(a, b, c) << L(d, e, f) < L(g, h, i) > L(j, k, l)',
           { when = function(_, a, b, c, d, e, f, g, h, i) return g % 3 > 0 end },
           function(_, a, b, c, d, e, f, g, h, i, j, k, l) return L(a + g, b + e + k, c + l + random()) end)
         s:rule('L(a, _, _) << L(b, _, _)', function(_, a, b) return L(b, a, 0) end)
         s:derive(2)",
    );
    assert!(found.contains("nil") || found.contains("L("), "{found}");
}

#[test]
fn guards_draw_no_random_numbers_although_successors_have() {
    let found = same_outcome(&grown(
        "s:rule('B(n) << A', { when = function(_, n) if n > 2 then random() end return true end }, function(_, n)
           return B(n + random(0, 1) // 2 + 1)
         end)",
        1,
    ));
    assert!(found.contains("a guard cannot use random numbers"), "{found}");
    let found = same_outcome(&grown(
        "local outside = 0
         s:rule('B(n) << A', function(_, n) if n > 3 then outside = n end return B(n + 1) end)",
        1,
    ));
    assert!(found.contains("assigns outside"), "{found}");
}

#[test]
fn the_error_is_that_of_the_module_with_the_fewest_others_before_it() {
    let told = same_outcome(
        "local N = module('N', 'n') local s = lsystem()
         s:axiom(N(0), { N(1), N(1), N(7) }, { N(1), N(9) }, { N(1), N(8) })
         s:rule('N(a) << N(b)', { when = function(_, a, b) if b == 8 then error('a guard') end return true end },
           function(_, a, b) if b > 6 then error('too much') end return N(a + b) end)
         s:derive(1)",
    );
    assert!(told.contains("a guard") && told.contains("N(8), step 1"), "{told}");
}

#[test]
fn features_with_wrong_data_are_left_out() {
    let found = same_outcome(
        "local N = module('N', 'n', 'what?') local s = lsystem({ object = turtle() })
         local features = {}
         for i = 1, 12 do features[i] = { id = i, n = if i % 4 == 0 then nil else i } end
         s:axiom(source(features), function(feature)
           return turtle(), N(1), { N(2, 'a'), N(3) }, N(4, feature.n), N(5)
         end)
         s:rule('N(a, x) << N(b, y)', function(_, a, x, b, y)
           return N(a + b + (if b == 4 then y + 1 else 0), x)
         end)
         s:derive(1)",
    );
    assert!(found.contains("skipped 3 of 12 features"), "{found}");
}

#[test]
fn rules_can_stop_a_derivation_and_read_the_step() {
    let found = same_outcome(&grown(
        "s:rule('B(n) << A', function(_, n) if n == 12 then stop() end return B(n + step()) end)
         s:rule('B(n) << B(m)', { when = function(_, n) return step() > 1 and n > 2 end }, function(_, n, m) return B(n + m) end)",
        5,
    ));
    assert!(found.contains("B("), "{found}");
}

#[test]
fn endless_rules_and_growth_without_end_reach_a_limit() {
    let limited =
        |limits: Limits, rule: &str| outcome(&grown(rule, 50), RunOptions { limits, ..divided(1, 4096) });
    let short = Limits { time: Duration::from_millis(800), ..Limits::default() };
    let told = limited(short, "s:rule('B(n) << A', function(_, n) while n > 3 do end return B(n + 1) end)");
    assert!(told.contains("time") && told.contains("B(n) << A") && told.contains("main.lua"), "{told}");
    let few = Limits { modules: 100_000, ..Limits::default() };
    let rule = "s:rule('B(n) << A', function(_, n) return B(n), sequence(table.create(900, A())), B(n) end)";
    let told = limited(few.clone(), rule);
    assert_eq!(told, limited(few, &format!("{rule} -- print\n")));
    assert!(told.contains("100000 modules"), "{told}");
}
