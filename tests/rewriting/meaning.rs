//! Scripts have the same result in every machine that runs them: law 10 of the design.

use super::scripts::{all_chains, divided, error, lines, run_with, try_run};

const HEAD: &str = r#"
    local A = module("A", "x"); local B = module("B", "x")
    local function system(rule: any)
      local s = lsystem {}
      local list = {}
      for i = 1, 50 do list[i] = A(i) end
      s:axiom(table.unpack(list))
      if rule then s:rule("A(x)", rule) end
      return s
    end
"#;

/// Returns all chains. Asserts that every division into threads and batches gives equal chains.
fn everywhere(script: &str) -> Vec<String> {
    let script = format!("{HEAD}\n{script}");
    let alone = all_chains(&run_with(&script, divided(1, 4096)));
    for (threads, batch) in [(1, 1), (2, 1), (3, 10), (7, 1)] {
        let others = all_chains(&run_with(&script, divided(threads, batch)));
        assert_eq!(alone, others, "{threads} threads, batches of {batch}\n{script}");
    }
    alone.lines().map(str::to_owned).collect()
}

fn all(module: impl Fn(usize) -> String) -> String {
    (1..=50).map(module).collect::<Vec<_>>().join(" ")
}

#[test]
fn rules_see_a_local_as_it_was_when_derive_ran() {
    let found = everywhere(
        "local k = 1
         local s = system(function(this, x) return B(k) end)
         k = 2
         s:derive(1)
         k = 3
         s:derive(1)
         k = 4",
    );
    assert_eq!(found, [all(|_| "B(2)".into()), all(|_| "B(3)".into())]);
}

#[test]
fn rules_see_a_table_as_it_was_when_derive_ran() {
    let found = everywhere(
        "local t = { k = 1, list = {} }
         local s = system(function(this, x) return B(t.k + #t.list) end)
         t.k = 2
         s:derive(1)
         t.k = 3
         table.insert(t.list, 1)
         s:derive(1)",
    );
    assert_eq!(found, [all(|_| "B(2)".into()), all(|_| "B(4)".into())]);
}

#[test]
fn loops_may_create_systems_each_with_its_own_variables() {
    let found = everywhere(
        "local systems = {}
         for i = 1, 3 do
           local twice = i * 2
           systems[i] = system(function(this, x) return B(x * 100 + i * 10 + twice) end)
         end
         for i = 3, 1, -1 do systems[i]:derive(1) end",
    );
    let expected: Vec<String> = [3, 2, 1].map(|i| all(|x| format!("B({})", x * 100 + i * 12))).to_vec();
    assert_eq!(found, expected);
}

#[test]
fn results_of_an_earlier_derive_are_known_to_later_rules() {
    let found = everywhere(
        "local first = system(function(this, x) if x > 10 then return nil end return B(x) end):derive(1)
         local last = first.chains[1]
         system(function(this, x) return B(first.modules + #last) end):derive(1)
         local steps = first.steps
         system(function(this, x) return B(steps) end):derive(1)",
    );
    let text = (1..=10).map(|x| format!("B({x})")).collect::<Vec<_>>().join(" ");
    assert_eq!(found[0], text);
    assert_eq!(found[1], all(|_| format!("B({})", 10 + text.len())));
    assert_eq!(found[2], all(|_| "B(1)".into()));
}

#[test]
fn what_an_axiom_function_counts_is_known_to_rules() {
    let found = everywhere(
        "local count = 0
         local names = {}
         local s = system(nil)
         s:axiom(source { {}, {}, {} }, function(feature) count += 1 names[count] = `n{count}` return A(count), A(0) end)
         s:rule(\"A(x)\", function(this, x) return B(count * 10 + #names) end)
         s:derive(1)
         system(function(this, x) return B(count) end):derive(1)",
    );
    assert_eq!(found[..3], ["B(33) B(33)", "B(33) B(33)", "B(33) B(33)"]);
    assert_eq!(found[3], all(|_| "B(3)".into()));
}

#[test]
fn what_an_axiom_function_draws_leaves_the_machines_alike() {
    let found = everywhere(
        "local s = system(nil)
         s:axiom(source { {}, {} }, function(feature) return A(random()) end)
         s:derive(1)
         local u = random()
         system(function(this, x) return B(u) end):derive(1)",
    );
    let first = found[2].split(' ').next().unwrap_or("").to_owned();
    assert_eq!(found[2], vec![first; 50].join(" "));
}

#[test]
fn a_random_number_of_the_top_level_is_the_same_in_every_machine() {
    let found = everywhere("local u = random() system(function(this, x) return B(u) end):derive(1)");
    let first = found[0].split(' ').next().unwrap_or("").to_owned();
    assert!(first.starts_with("B(0."), "{first}");
    assert_eq!(found[0], vec![first; 50].join(" "));
}

#[test]
fn a_derive_that_fails_inside_pcall_does_not_confuse_the_next() {
    let found = everywhere(
        "local ok, message = pcall(function()
           system(function(this, x) if x == 40 then error(\"forty\") end return B(x) end):derive(1)
         end)
         system(function(this, x) return B(if ok then 1 else 2) end):derive(1)",
    );
    assert_eq!(found, [all(|_| "B(2)".into())]);
}

#[test]
fn a_derive_may_stand_in_a_function_a_loop_or_a_coroutine() {
    let found = everywhere(
        "local total = 0
         local function run(k) total += system(function(this, x) return B(k + total) end):derive(1).modules end
         for i = 1, 2 do run(i) end
         coroutine.wrap(function() run(3) end)()",
    );
    assert_eq!(found, [all(|_| "B(1)".into()), all(|_| "B(52)".into()), all(|_| "B(103)".into())]);
}

#[test]
fn a_rule_may_be_added_between_two_derivations() {
    let found = everywhere(
        "local s = system(function(this, x) return B(x) end)
         s:derive(2)
         s:rule(\"B(x)\", [[ return A(-x) ]])
         s:derive(2)",
    );
    assert_eq!(found, [all(|x| format!("B({x})")), all(|x| format!("A({})", -(x as i64)))]);
}

#[test]
fn helpers_shared_by_rules_see_the_locals_of_their_own_place() {
    let found = everywhere(
        "local factor = 10
         local function scale(x) return x * factor end
         do
           local factor = 1000
           system(function(this, x) return B(scale(x) + factor) end):derive(1)
         end",
    );
    assert_eq!(found, [all(|x| format!("B({})", x * 10 + 1000))]);
}

#[test]
fn the_steps_option_limits_every_system() {
    let script = format!("{HEAD} system(function(this, x) return A(x + 1) end):derive(5)");
    let options = burgeon::script::RunOptions { steps: Some(2), ..divided(2, 1) };
    assert_eq!(lines(&run_with(&script, options)), [all(|x| format!("A({})", x + 2))]);
}

#[test]
fn captured_state_that_would_depend_on_the_order_is_refused() {
    // Each script would let one application observe another, so threads and batches would change the result.
    let mut wrong = Vec::new();
    for state in [
        "local n = 0 local s = system(function(this, x) n += 1 return B(n) end)",
        "local t = { n = 0 } local s = system(function(this, x) t.n += 1 return B(t.n) end)",
        "local b = buffer.create(8)
         local s = system(function(this, x) buffer.writef64(b, 0, buffer.readf64(b, 0) + 1) return B(buffer.readf64(b, 0)) end)",
        "local next = coroutine.wrap(function() local i = 0 while true do i += 1 coroutine.yield(i) end end)
         local s = system(function(this, x) return B(next()) end)",
        "local co = coroutine.create(function() local i = 0 while true do i += 1 coroutine.yield(i) end end)
         local s = system(function(this, x) local _, i = coroutine.resume(co) return B(i) end)",
        "local function counter() local i = 0 return function() i += 1 return i end end
         local next = counter() local s = system(function(this, x) return B(next()) end)",
        "local cache = setmetatable({}, { __mode = \"k\" })
         local s = system(function(this, x) rawset(cache, x, x) return B(#cache) end)",
        "local other = system(nil)
         local s = system(function(this, x) other:rule(\"B\", function() return nil end) return B(x) end)",
        "local other = system(function(this, x) return B(x) end)
         local s = system(function(this, x) return B(other:derive(1).modules) end)",
        "local s = system(function(this, x) local C = module(\"C\" .. x) return C() end)",
        "local s = system(function(this, x) lsystem {} return B(x) end)",
    ] {
        match try_run(&format!("{HEAD} {state} s:derive(1)"), divided(1, 4096)) {
            Err(error) => assert!(error.to_string().contains("main.lua:"), "{state}: {error}"),
            Ok(run) => wrong.push(format!("{state}\n    gives {:.60}", all_chains(&run))),
        }
    }
    assert!(wrong.is_empty(), "not refused:\n{}", wrong.join("\n"));
}

#[test]
fn nothing_changes_a_vector() {
    for write in ["v.x = 5", "rawset(v, 'x', 5)", "local set = rawset set(v, 'x', 5)"] {
        let made = error(&format!("local v = vec(1, 2, 3)\n{write}"));
        assert!(made.contains("main.lua:2"), "{made}");
    }
}
