//! Hooks, variables, groups of rules, and the end of a derivation by a function.

use burgeon::script::{Print, RunOptions};

use super::scripts::{all_chains, chain, chain_of_each, divided, error, run, run_with};

/// Returns the lines that a script prints.
fn prints(script: &str) -> Vec<String> {
    let (sender, lines) = std::sync::mpsc::channel();
    let mut options = burgeon::options();
    options.reports.print = Some(Print::new(move |line| sender.send(line.to_owned()).expect("a receiver")));
    run_with(script, options);
    lines.try_iter().collect()
}

const DECLARED: &str = "local A, B, C = module('A'), module('B', 'n'), module('C')\n";

#[test]
fn hooks_run_around_the_steps_in_the_order_of_their_declaration() {
    let script = format!(
        "{DECLARED}
         local s = lsystem {{ object = turtle() }}
         s:axiom(A())
         s:rule('A', function() return A(), C() end)
         s:interpret('A', function(this) print('drawn') this:forward(1) end)
         s:interpret('C', function(this) this:forward(1) end)
         s:rule('C', function(this) local p = this:position() end)
         s:after_step(function(now) print('after', now.step, now.modules, now.counts.C) end)
         s:before_step(function(now) print('before', now.step, now.modules) end)
         s:before_step(function() print('again') end)
         s:at_start(function(now) print('start', now.step, now.modules, step()) end)
         s:at_end(function(now) print('end', now.step, now.modules) end)
         s:derive(2)"
    );
    let expected = [
        "start 0 1 0",
        "drawn",
        "before 1 1",
        "again",
        "drawn",
        "after 1 2 1",
        "before 2 2",
        "again",
        "drawn",
        "after 2 3 2",
        "end 2 3",
    ];
    let found: Vec<String> = prints(&script).iter().map(|line| line.replace('\t', " ")).collect();
    assert_eq!(found, expected);
}

#[test]
fn rules_read_variables_as_the_step_began_and_hooks_and_interpretations_assign_them() {
    let script = format!(
        "{DECLARED}
         local v = variables({{ time = 0, drawn = 0, name = 'a', list = {{ 1, 2 }} }})
         local s = lsystem {{ object = turtle(), variables = v }}
         s:axiom(A())
         s:before_step(function() v.time += 0.5 end)
         s:rule('A', function() return B(v.time), B(v.drawn), A() end)
         s:interpret('B(n)', function(this, n) v.drawn += 1 v.list = {{ v.drawn, n }} end)
         s:interpret('A', function(this) v.name ..= 'x' end)
         local d = s:derive(3)
         expect(d.variables.time, 1.5)
         expect(d.variables.drawn, 0 + 2 + 4 + 6)
         expect(d.variables.name, 'axxxx')
         expect(d.variables.list[1], 12)
         expect(s:derive(1).variables.time, 0.5)"
    );
    assert_eq!(
        chain_of_each(&script)[0],
        "B(0.5) B(0) B(1) B(2) B(1.5) B(6) A",
        "two modules B are drawn after step 1, so that the rule of step 2 reads 2, and that of step 3 reads 6"
    );
}

#[test]
fn variables_are_the_same_for_any_number_of_threads() {
    let script = format!(
        "{DECLARED}
         local v = variables({{ time = 0, total = 0 }})
         local s = lsystem {{ object = turtle(), variables = v }}
         local features = {{}}
         for i = 1, 40 do features[i] = {{ id = tostring(i) }} end
         s:axiom(source(features), function(feature) return A(), B(tonumber(feature.id)) end)
         s:before_step(function(now) v.time += random() end)
         s:rule('A', function() return B(v.time), B(v.total), B(random()), A() end)
         s:interpret('B(n)', function(this, n) v.total = (v.total * 3 + n) % 1000 end)
         local d = s:derive(4)
         local t = lsystem {{}}
         t:axiom(B(d.variables.total), B(d.variables.time))
         t:derive(0)"
    );
    let plain = all_chains(&run_with(&script, divided(1, 4096)));
    for (threads, batch) in [(2, 1), (3, 2), (2, 4096)] {
        assert_eq!(
            all_chains(&run_with(&script, divided(threads, batch))),
            plain,
            "{threads} threads, {batch}"
        );
    }
}

#[test]
fn rules_of_a_group_apply_only_while_it_is_used_and_rules_without_a_group_always() {
    let system = |end: &str| {
        format!(
            "{DECLARED}
             local s = lsystem {{}}
             s:axiom(A())
             s:rule('A', {{ group = 'grow' }}, function() return A(), B(1) end)
             s:rule('A', {{ group = 'end' }}, function() return C() end)
             s:rule('B(n)', function(this, n) return B(n + 1) end)
             {end}"
        )
    };
    assert_eq!(chain(&system("s:derive(2, 'grow')")), "A B(1) B(2)");
    assert_eq!(chain(&system("s:derive(2)")), "A");
    assert_eq!(chain(&system("s:derive(2, 'end')")), "C");
    let chosen =
        "s:before_step(function(now) use_group(if now.step < 3 then 'grow' else 'end') end) s:derive(3)";
    assert_eq!(chain(&system(chosen)), "C B(2) B(3)");
    let left = "s:after_step(function(now) use_group() end) s:derive(3, 'grow')";
    assert_eq!(chain(&system(left)), "A B(3)");
    let continued = "local grown = s:derive(2, 'grow') s:axiom(grown) s:derive(1, 'end')";
    assert_eq!(chain_of_each(&system(continued)), ["A B(1) B(2)", "C B(2) B(3)"]);
}

#[test]
fn decompositions_have_groups_too() {
    let script = format!(
        "{DECLARED}
         local s = lsystem {{}}
         s:axiom(A())
         s:rule('A', function() return A(), C() end)
         s:decompose('C', {{ group = 'split' }}, function() return B(1), B(2) end)
         s:derive(2)
         s:derive(1, 'split')"
    );
    assert_eq!(chain_of_each(&script), ["A C C", "A B(1) B(2)"]);
}

#[test]
fn a_function_ends_the_derivation_after_its_step() {
    let script = |rule: &str, more: &str| {
        format!(
            "{DECLARED}
             local s = lsystem {{ object = turtle() }}
             s:axiom(B(0))
             s:rule('B(n)', function(this, n) {rule} return B(n + 1), C() end)
             s:interpret('C', function(this) this:forward(1) end)
             {more}
             s:derive(10)"
        )
    };
    assert_eq!(chain(&script("if n == 2 then stop() end", "")), "B(3) C C C");
    let drawn = "s:interpret('B(n)', function(this, n) if n == 4 then stop() end end)";
    assert_eq!(chain(&script("", drawn)), "B(4) C C C C");
    let hook = "s:after_step(function(now) if now.counts.C == 2 then stop() end end)";
    assert_eq!(chain(&script("", hook)), "B(2) C C");
    assert_eq!(chain(&script("", "s:at_start(function() stop() end)")), "B(0)");
    let before = "s:before_step(function(now) if now.step == 2 then stop() end end)";
    assert_eq!(chain(&script("", before)), "B(2) C C", "the step that begins still runs");
    let split = "s:decompose('C', function() if false then return C() end stop() end)";
    assert_eq!(chain(&script("", split)), "B(1) C");
}

#[test]
fn the_end_of_a_derivation_is_the_same_for_any_number_of_threads() {
    let script = "local A, B = module('A', 'n'), module('B', 'u')
         local s = lsystem {}
         for i = 1, 1 do s:axiom(A(0)) end
         s:rule('A(n)', function(this, n) if n == 9 then stop() end return A(n + 1), A(n + 1), B(random()) end)
         s:derive(30)";
    let ends = |threads, batch| {
        let run = run_with(script, divided(threads, batch));
        (run.systems[0].steps, all_chains(&run))
    };
    let plain = ends(1, 4096);
    assert_eq!(plain.0, 10);
    for (threads, batch) in [(2, 1), (2, 64), (3, 7)] {
        assert!(ends(threads, batch) == plain, "{threads} threads, {batch}");
    }
}

#[test]
fn a_derivation_without_a_number_of_steps_ends_when_rules_and_variables_settle_or_a_hook_stops_it() {
    let counted = format!(
        "{DECLARED}
         local v = variables({{ n = 0 }})
         local s = lsystem {{ object = turtle(), variables = v }}
         s:axiom(A())
         s:rule('A', {{ when = function() return v.n == 3 end }}, function() return C() end)
         s:interpret('A', function() if v.n < 3 then v.n += 1 end end)
         s:interpret('C', function() end)
         s:derive()"
    );
    assert_eq!(chain(&counted), "C", "a guard can hold once a variable has changed");
    let stopped = format!(
        "{DECLARED}
         local s = lsystem {{}}
         s:axiom(A())
         s:after_step(function(now) if now.step == 5 then stop() end end)
         s:derive()"
    );
    assert_eq!(run(&stopped).systems[0].steps, 5);
}

#[test]
fn a_hook_asks_queries_about_the_modules_of_the_chain() {
    let script = format!(
        "{DECLARED}
         local v = variables({{ sum = 0 }})
         local s = lsystem {{ variables = v }}
         s:axiom(A())
         s:rule('A', function() return A(), B(2) end)
         s:after_step(function(now) v.sum = query('select sum(n) as total from B')[1].total end)
         expect(s:derive(4).variables.sum, 8)"
    );
    run(&script);
}

#[test]
fn random_numbers_of_hooks_depend_on_the_step_and_change_no_others() {
    let script = |hook: &str| {
        format!(
            "{DECLARED}
             local v = variables({{ u = 0 }})
             local s = lsystem {{ variables = v }}
             s:axiom(A())
             s:rule('A', function() return A(), B(random()) end)
             {hook}
             local d = s:derive(3)
             local t = lsystem {{}} t:axiom(B(d.variables.u)) t:derive(0)"
        )
    };
    let plain = chain_of_each(&script(""));
    let hook = chain_of_each(&script("s:before_step(function() v.u = random() end)"));
    let other = chain_of_each(&script("s:after_step(function() v.u = random() end)"));
    let two = chain_of_each(&script(
        "s:before_step(function() random() end) s:before_step(function() v.u = random() end)",
    ));
    assert_eq!((&hook[0], &other[0], &two[0]), (&plain[0], &plain[0], &plain[0]));
    let numbers = [&plain[1], &hook[1], &other[1], &two[1]];
    for (index, number) in numbers.iter().enumerate() {
        assert!(!numbers[..index].contains(number), "{number} was drawn twice");
    }
}

#[test]
fn a_chain_that_is_continued_keeps_its_variables() {
    let script = format!(
        "{DECLARED}
         local v = variables({{ n = 0 }})
         local s = lsystem {{ variables = v }}
         s:axiom(A())
         s:rule('A', function() return A(), B(v.n) end)
         s:before_step(function() v.n += 1 end)
         local first = s:derive(2)
         s:axiom(first)
         expect(s:derive(2).variables.n, 4)"
    );
    assert_eq!(chain_of_each(&script)[1], "A B(4) B(3) B(2) B(1)");
}

#[test]
fn a_hook_that_returns_modules_replaces_the_chain_before_the_rules_run() {
    let script = format!(
        "{DECLARED}
         local s = lsystem {{}}
         s:axiom(A(), {{ C() }}, B(1))
         s:rule('B(n)', function(this, n) return B(n + 1) end)
         s:before_step(function(now)
             local list = now.chain
             table.insert(list, 1, B(10 * now.step))
             return sequence(list)
         end)
         s:derive(2)"
    );
    assert_eq!(chain(&script), "B(21) B(12) A [ C ] B(3)");
    let first = script.replace("before_step", "at_start").replace("derive(2)", "derive(0)");
    assert_eq!(chain(&first), "B(0) A [ C ] B(1)");
    let erased = script.replace("return sequence(list)", "return {}");
    assert_eq!(chain(&erased), "[ ]", "a table is a branch");
}

#[test]
fn modules_that_a_hook_keeps_have_their_random_numbers_and_new_ones_have_others() {
    let script = |hook: &str| {
        format!(
            "local A, B = module('A', 'x'), module('B')
             local s = lsystem {{}}
             s:axiom(A(0), {{ A(0) }}, A(0))
             s:rule('A', function() return A(random()) end)
             {hook}
             s:derive(3)"
        )
    };
    let plain = chain(&script(""));
    let kept = chain(&script(
        "s:before_step(function(now) local list = now.chain table.insert(list, 1, B()) return sequence(list) end)",
    ));
    assert_eq!(kept, format!("B B B {plain}"));
    let made = chain(&script("s:before_step(function(now) return sequence(now.chain), A(0) end)"));
    let numbers: Vec<&str> = made.split(' ').filter(|part| part.starts_with("A(")).collect();
    assert!(made.starts_with(&plain), "{made}");
    assert_eq!(numbers.len(), 6);
    let mut different = numbers.clone();
    different.sort_unstable();
    different.dedup();
    assert_eq!(different.len(), 6, "{made}");
}

#[test]
fn a_replaced_chain_is_drawn_and_recorded() {
    let script = format!(
        "{DECLARED}
         local s = lsystem {{ object = turtle() }}
         s:axiom(A())
         s:interpret('C', function(this) this:forward(1) end)
         s:before_step(function(now) return C(), {{ C() }}, C() end)
         s:derive(1)"
    );
    let mut options = burgeon::options();
    options.reports.records = true;
    let run = run_with(&script, options);
    assert!(run.scene.triangles() > 0);
}

#[test]
fn misuse_says_where_and_what_to_do() {
    let system = |text: &str| {
        format!(
            "local A, B = module('A'), module('B', 'n')
local v = variables({{ time = 0 }})
local s = lsystem {{ object = turtle(), variables = v }}
s:axiom(A())
{text}
s:derive(2)"
        )
    };
    for (text, expected) in [
        ("s:rule('A', function() v.time = 1 return A() end)", "a rule cannot assign the variable time"),
        (
            "s:rule('A', { when = function() v.time = 1 return true end }, function() return A() end)",
            "a guard cannot assign",
        ),
        ("v.time = 2", "the top level of the script cannot assign the variable time"),
        ("local t = v.time", "known only while its system is derived"),
        ("s:before_step(function() v.tim = 1 end)", "unknown variable tim"),
        ("s:before_step(function() v.time = nil end)", "cannot be nil"),
        ("s:before_step(function() v.time = 0 / 0 end)", "would not be a number"),
        ("s:before_step(function() v.time = function() end end)", "a function cannot be passed on"),
        ("s:before_step(function() use_group('grow') end)", "no rules of the group grow"),
        ("s:rule('A', { group = 3 }, function() return A() end)", "group must be a name"),
        ("s:interpret('A', { group = 'x' }, function() end)", "an interpretation has no group"),
        ("s:derive(2, 'gro')", "no rules of the group gro"),
        ("use_group('x')", "only a hook can call it"),
        ("stop()", "none is running"),
        (
            "s:rule('A', { when = function() stop() return true end }, function() return A() end)",
            "a guard cannot stop",
        ),
        ("local n = 0 s:before_step(function() n = 1 end)", "a hook assigns n, a variable declared outside"),
        ("local t = {} s:before_step(function() t.x = 1 end)", "modify a readonly table"),
        ("s:before_step(function(now) print(now.stepp) end)", "unknown field `stepp`"),
        ("s:before_step(function(now, x) end)", "has 2 parameters"),
        ("s:before_step(3)", "takes one function"),
        ("s:before_step(function() s:derive(1) end)", "can be called only at the top level"),
        ("s:before_step(function() error('broken') end)", "broken"),
        ("s:before_step(function() query('select n from B', B) end)", "a hook makes no modules"),
        (
            "s:before_step(function() return 3 end)",
            "the chain that a hook returns must contain only modules, but one item is the number 3",
        ),
        ("s:after_step(function() return A() end)", "after_step cannot replace the chain"),
        ("s:at_end(function() return A() end)", "at_end cannot replace the chain"),
        ("s:before_step(function() return A(), nil, A() end)", "must contain only modules"),
        (
            "s:axiom(source({ { id = 'x' }, { id = 'y' } }), function() return A() end) s:before_step(function(now) return sequence(now.chain) end)",
            "this system has several",
        ),
        ("variables(3)", "takes a table of names"),
        ("variables({ 1 })", "a variable needs a name"),
        ("lsystem({ variables = { time = 0 } })", "must be a result of variables"),
    ] {
        let found = error(&system(text));
        assert!(found.contains(expected), "{text}: {found}");
        assert!(found.contains("main.lua:"), "{text} has no line: {found}");
    }
    let whole = error(&system("s:rule('A', function() v.time = 1 return A() end)"));
    assert!(whole.contains("main.lua:5") && whole.contains("rule A"), "{whole}");
}

#[test]
fn an_endless_hook_is_stopped_by_the_time_limit() {
    let mut options: RunOptions = burgeon::options();
    options.limits.time = std::time::Duration::from_millis(300);
    let script = "local A = module('A') local s = lsystem {} s:axiom(A()) s:before_step(function() while true do end end) s:derive(1)";
    let failed = super::scripts::try_run(script, options).err().expect("it never ends").to_string();
    assert!(failed.contains("time"), "{failed}");
}
