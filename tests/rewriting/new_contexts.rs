//! Contexts in the chain that a step writes, rings, and modules that single rules ignore: known answers.

use super::scripts::{all_chains, chain, chain_of_each, divided, error, run, run_with};

/// Returns the chain after one step of `rules`.
fn after(axiom: &str, rules: &str) -> String {
    chain(&format!(
        "local A, B, C, X = module('A'), module('B'), module('C'), module('X')
         local N, W = module('N', 'n'), module('W', 'w')
         local s = lsystem() s:ignore('X') s:axiom({axiom}) {rules} s:derive(1)"
    ))
}

#[test]
fn a_left_context_in_the_new_chain_carries_a_value_along_the_whole_chain_in_one_step() {
    let sum = "s:rule('N(a) << N(b)', function(this, a, b) return N(a + b) end)";
    assert_eq!(after("N(1), N(2), N(3), N(4)", sum), "N(1) N(3) N(6) N(10)");
    assert_eq!(after("N(1), X(), { N(2), N(3) }, N(4)", sum), "N(1) X [ N(3) N(6) ] N(5)");
    // The old neighbour is B, the new one A.
    let both = "s:rule('A << B < B', [[ return C() ]]) s:rule('A << B', [[ return A() ]])";
    assert_eq!(after("A(), B(), B(), B()", both), "A A C B");
    let erased =
        "s:rule('C', [[ return nil ]]) s:rule('N(a) << N(b)', function(this, a, b) return N(a + b) end)";
    assert_eq!(after("N(1), C(), C(), N(2)", erased), "N(1) N(3)");
    let inside = "s:rule('C', [[ return A(), { B() }, X() ]]) s:rule('A << N(b)', [[ return B() ]])";
    assert_eq!(after("C(), N(1)", inside), "A [ B ] X B");
    assert_eq!(after("A(), B(), B()", "s:rule('^ << B', [[ return C() ]])"), "A B B");
    assert_eq!(
        after("A(), B(), B()", "s:rule('A', [[ return nil ]]) s:rule('^ << B', [[ return C() ]])"),
        "C B"
    );
}

#[test]
fn a_right_context_in_the_new_chain_sums_branches_from_the_tips_to_the_root_in_one_step() {
    let area = "s:rule('W(w) >> [W(a)] [W(b)] W(c)', function(this, w, a, b, c) return W(a + b + c) end)
                s:rule('W(w) >> [W(a)] W(b)', function(this, w, a, b) return W(a + b) end)
                s:rule('W(w) >> W(a)', function(this, w, a) return W(a) end)";
    assert_eq!(
        after("W(0), { W(0), W(1) }, W(0), { W(2) }, { W(3) }, W(0), W(4)", area),
        "W(10) [ W(1) W(1) ] W(9) [ W(2) ] [ W(3) ] W(4) W(4)"
    );
    let grown = "s:rule('B', [[ return A(), C() ]]) s:rule('A >> A C', [[ return X() ]])";
    assert_eq!(after("A(), B()", grown), "X A C");
    assert_eq!(after("A(), A(), B()", "s:rule('A >> $', [[ return C() ]])"), "A A B");
    assert_eq!(
        after("A(), A(), B()", "s:rule('A >> $', [[ return C() ]]) s:rule('B', [[ return nil ]])"),
        "A C"
    );
}

#[test]
fn guards_weights_random_numbers_and_texts_work_with_new_contexts() {
    let texts = "local T = module('T', 'what')
        s:rule('A', function() return T('made in this step') end)
        s:rule('T(\"made in this step\") << N(n)', function(this, n) return N(n + 1) end)";
    assert_eq!(after("A(), N(1)", texts), "T(\"made in this step\") N(2)");
    let guarded = "s:rule('N(a) << N(b)', { when = function(this, a, b) return a < 3 end },
                     function(this, a, b) return N(a + b) end)";
    assert_eq!(after("N(1), N(1), N(1), N(1), N(1)", guarded), "N(1) N(2) N(3) N(1) N(2)");
    let script = "local N = module('N', 'n') local s = lsystem()
        s:axiom(source({ { id = 'a' }, { id = 'b' }, { id = 'c' } }), function()
          return N(random()), { N(1), { N(2) }, N(3) }, N(4)
        end)
        s:rule('N(a) << N(b)', { weight = 2 }, function(this, a, b) return N(a + random()), { N(b) } end)
        s:rule('N(a) << N(b)', { weight = 1 }, function(this, a, b) return N(-a) end)
        s:derive(4)";
    let expected = all_chains(&run(script));
    assert_eq!(expected.lines().count(), 3);
    for division in [(1, 1), (2, 1), (2, 3), (1, 4096)] {
        assert_eq!(all_chains(&run_with(script, divided(division.0, division.1))), expected, "{division:?}");
    }
}

#[test]
fn groups_rewrite_in_both_directions_one_after_the_other() {
    let derived = chain_of_each(
        "local N = module('N', 'n') local s = lsystem()
         s:axiom(N(1), N(1), N(1))
         s:before_step(function(now) use_group(if now.step % 2 == 1 then 'up' else 'down') end)
         s:rule('N(a) >> N(b)', { group = 'up' }, function(this, a, b) return N(a + b) end)
         s:rule('N(a) << N(b)', { group = 'down' }, function(this, a, b) return N(a + b) end)
         for steps = 1, 3 do s:derive(steps) end",
    );
    assert_eq!(derived, ["N(3) N(2) N(1)", "N(3) N(5) N(6)", "N(14) N(11) N(6)"]);
}

#[test]
fn new_contexts_that_no_step_can_match_are_refused() {
    let told = |rules: &str| {
        error(&format!(
            "local A, B = module('A'), module('B') local s = lsystem() s:axiom(A(), B())
             {rules}
             s:derive(1)"
        ))
    };
    let both = told("s:rule('A << B', [[ return A() ]]) s:rule('A >> B', [[ return A() ]])");
    assert!(
        both.contains("\"A << B\" sees the new chain before it, and \"A >> B\" the new chain after it"),
        "{both}"
    );
    assert!(both.contains("main.lua:2") && both.contains("group"), "{both}");
    let one = told("s:rule('A << B >> A', [[ return A() ]])");
    assert!(one.contains("the rule \"A << B >> A\""), "{one}");
    let run = told("s:rule('A << B', [[ return A() ]]) s:rule('A B', [[ return A() ]])");
    assert!(run.contains("several modules at once"), "{run}");
    assert!(
        told("s:decompose('A << B', [[ return A() ]])")
            .contains("a decomposition has no contexts in the new")
    );
    assert!(
        told("s:interpret('A << B', function() end)")
            .contains("an interpretation has no contexts in the new")
    );
    assert!(told("s:rule('A < A << B', [[ return A() ]])").contains("new left << left < predecessor"));
    assert!(told("s:rule('A >> B > A', [[ return A() ]])").contains("new left << left < predecessor"));
    assert!(told("s:rule('A << B <', [[ return A() ]])").contains("malformed pattern"));
    assert!(told("s:rule('A >>', [[ return A() ]])").contains("the context next to >> is empty"));
}

#[test]
fn errors_of_rules_with_new_contexts_name_the_module_and_the_line() {
    let told = error(
        "local N = module('N', 'n') local s = lsystem() s:axiom(N(1), N(2), N(3))
         s:rule('N(a) << N(b)', function(this, a, b)
           if b == 3 then error('too much') end
           return N(a + b)
         end)
         s:derive(1)",
    );
    assert!(
        told.contains("too much") && told.contains("main.lua:3") && told.contains("N(3), step 1"),
        "{told}"
    );
}

#[test]
fn strings_of_symbols_have_new_contexts_too() {
    let text = |rule: &str| {
        chain(&format!("local s = lsystem() s:axiom('F+G') s:ignore('+') s:rule({rule}) s:derive(1)"))
    };
    assert_eq!(text("'F << f', 'F'"), "F Left F");
    assert_eq!(text("'F >> f', 'f'"), "G Left G");
    let abop = chain("abop({ axiom = 'ABBB', ['A<<B'] = 'A' }):derive(1)");
    assert_eq!(abop, "A A A A");
}

#[test]
fn the_first_and_the_last_module_of_a_ring_are_neighbours() {
    let ring = |options: &str, axiom: &str, rules: &str| {
        chain(&format!(
            "local A, B, C, X = module('A'), module('B'), module('C'), module('X')
             local s = lsystem({options}) s:ignore('X') s:axiom({axiom}) {rules} s:derive(1)"
        ))
    };
    let rule = "s:rule('A < B', [[ return C() ]])";
    assert_eq!(ring("{ ring = true }", "B(), B(), A()", rule), "C B A");
    assert_eq!(ring("", "B(), B(), A()", rule), "B B A");
    let right = "s:rule('A > [B] C', [[ return B() ]])";
    assert_eq!(ring("{ ring = true }", "X(), { B() }, C(), A(), X()", right), "X [ B ] C B X");
    assert_eq!(ring("{ ring = true }", "A()", "s:rule('A A < A > A A', [[ return B() ]])"), "B");
    assert_eq!(ring("{ ring = true }", "A(), { A() }", "s:rule('A > $', [[ return B() ]])"), "A [ B ]");
    assert_eq!(ring("{ ring = true }", "A(), A()", "s:rule('^ < A', [[ return B() ]])"), "A A");
    let told = error("lsystem({ ring = 1 })");
    assert!(told.contains("ring must be true or false"), "{told}");
}

#[test]
fn interpretations_see_rings() {
    run("local A, B = module('A'), module('B')
         local seen = variables({ count = 0 })
         local s = lsystem({ object = turtle(), ring = true, variables = seen })
         s:axiom(B(), A())
         s:interpret('A < B', function() seen.count += 1 end)
         s:interpret('A', function() end)
         expect(s:derive(0).variables.count, 1)");
}

#[test]
fn a_rule_can_ignore_other_modules_than_the_system() {
    let rule = |option: &str| format!("s:rule('A < B', {{ {option} }}, [[ return N(1) ]])");
    assert_eq!(after("A(), X(), B()", &rule("")), "A X N(1)");
    assert_eq!(after("A(), X(), B()", &rule("ignore = {}")), "A X B");
    assert_eq!(after("A(), C(), X(), B()", &rule("ignore = 'C X'")), "A C X N(1)");
    assert_eq!(after("A(), C(), X(), B()", &rule("ignore = { 'C', 'X' }")), "A C X N(1)");
    assert_eq!(after("A(), C(), W(1), B()", &rule("consider = 'A'")), "A C W(1) N(1)");
    assert_eq!(after("A(), C(), W(1), B()", &rule("consider = { 'A', 'W' }")), "A C W(1) B");
    let others = format!("{} s:rule('A < C', [[ return N(2) ]])", rule("ignore = 'C'"));
    assert_eq!(after("A(), X(), C(), B()", &others), "A X N(2) B");
    let told =
        error("local A = module('A') local s = lsystem() s:axiom(A()) s:rule('A', { ignore = 1 }, 'A')");
    assert!(told.contains("ignore and consider take names of modules"), "{told}");
    let run = run("local A, B = module('A'), module('B') local s = lsystem() s:axiom(A(), B())
        s:rule('A < B', { ignore = 'A' }, [[ return A() ]]) s:derive(1)");
    let warnings: String = run.warnings.iter().map(ToString::to_string).collect();
    assert!(warnings.contains("A is ignored by this rule, so this context never occurs"), "{warnings}");
}
