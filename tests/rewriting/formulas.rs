//! Guards that only compare numbers, which are evaluated without Lua, against the same guards with a statement more, which Lua
//! runs.

use proptest::prelude::*;

use super::scripts::{all_chains, chain, try_run};

/// Rules whose guard is `condition` after `locals`, and whose successor is `modules` after them, once as they are and once after a
/// statement.
fn rules(
    axiom: &str,
    pattern: &str,
    parameters: &str,
    condition: &str,
    modules: &str,
    locals: &str,
) -> [String; 2] {
    ["", "do end "].map(|statement| {
        format!(
            r#"
            local A, B = module("A", "x", "y?"), module("B", "z", "w?")
            local limit, factor, no = 2, 0.5, nil
            local s = lsystem()
            s:axiom({axiom})
            s:rule("{pattern}", {{ when = function(_, {parameters}) {statement}{locals}return {condition} end }},
              function(_, {parameters}) {statement}{locals}return {modules} end)
            s:rule("{pattern}", function(_, {parameters}) return A(8, limit) end)
            s:derive(2)"#
        )
    })
}

/// Rules whose guard is `condition`, once as it is and once after a statement.
fn both(axiom: &str, pattern: &str, parameters: &str, condition: &str) -> [String; 2] {
    rules(axiom, pattern, parameters, condition, "B(9, x / 2)", "")
}

/// Returns the chain, or the error.
fn outcome(script: &str) -> Result<String, String> {
    let failed =
        |error: burgeon::Error| error.to_string().rsplit("main.lua").next().unwrap_or_default().to_owned();
    let run = try_run(script, burgeon::options()).map_err(failed)?;
    Ok(all_chains(&run))
}

/// Generates numbers as Lua text, without locals or with the locals `p` and `q`.
fn number_of(names: &'static [&'static str]) -> impl Strategy<Value = String> {
    let variable = prop::sample::select(names).prop_map(str::to_owned);
    let constant =
        prop::sample::select(vec!["0", "1", "-1.5", "3", "0x4", "1e300", "0.1"]).prop_map(str::to_owned);
    prop_oneof![3 => variable, 1 => constant].prop_recursive(3, 12, 2, |inner| {
        let operator = prop::sample::select(vec!["+", "-", "*", "/", "//", "%"]);
        prop_oneof![
            (inner.clone(), operator, inner.clone())
                .prop_map(|(a, operator, b)| format!("({a} {operator} {b})")),
            inner.prop_map(|a| format!("-({a})")),
        ]
    })
}

fn number() -> impl Strategy<Value = String> {
    number_of(&["x", "y", "z", "w", "limit", "factor"])
}

fn condition() -> impl Strategy<Value = String> {
    condition_of(number)
}

fn condition_of<S: Strategy<Value = String> + 'static>(number: fn() -> S) -> impl Strategy<Value = String> {
    let operator = prop::sample::select(vec!["<", "<=", ">", ">=", "==", "~="]);
    let comparison =
        (number(), operator, number()).prop_map(|(a, operator, b)| format!("{a} {operator} {b}"));
    comparison.prop_recursive(2, 6, 2, |inner| {
        prop_oneof![
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("({a} and {b})")),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("({a} or {b})")),
            inner.prop_map(|a| format!("not ({a})")),
        ]
    })
}

/// Generates up to three statements that declare locals, of which some shadow a parameter, a variable or an earlier one.
fn locals() -> impl Strategy<Value = String> {
    let name = || prop::sample::select(vec!["p", "q", "x", "z", "limit", "this"]);
    let one = (name(), number_with_locals()).prop_map(|(name, value)| format!("local {name} = {value} "));
    let two = (name(), name(), number_with_locals(), number_with_locals())
        .prop_map(|(a, b, c, d)| format!("local {a}, {b} = {c}, {d} "));
    prop::collection::vec(prop_oneof![2 => one, 1 => two], 0..4).prop_map(|locals| locals.concat())
}

/// Generates numbers that read parameters, variables and locals. The first local of a name reads a variable outside.
fn number_with_locals() -> impl Strategy<Value = String> {
    number_of(&["x", "y", "z", "w", "limit", "p", "p", "q", "q"])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 120, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn a_condition_holds_as_in_lua(
        condition in condition(), numbers in prop::collection::vec((-3..4i32, 0..8u32), 24)
    ) {
        let module = |(index, (x, y)): (usize, (i32, u32))| {
            let name = if index % 3 == 1 { "B" } else { "A" };
            let bracket = if index % 5 == 4 { ["{", "}"] } else { ["", ""] };
            format!("{}{name}({}, {}){}", bracket[0], f64::from(x) / 2.0, f64::from(y) / 4.0, bracket[1])
        };
        let axiom = numbers.into_iter().enumerate().map(module).collect::<Vec<_>>().join(", ");
        for (pattern, parameters) in
            [("A(x, y) > B(z, w)", "x, y, z, w"), ("B(z, w) < A(x, y)", "z, w, x, y"), ("B(z, w) < A(x, y) > A", "z, w, x, y")]
        {
            let [quick, by_lua] = both(&axiom, pattern, parameters, &condition).map(|script| outcome(&script));
            prop_assert_eq!(quick, by_lua, "{} {}", pattern, condition);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn formulas_of_locals_have_the_values_of_lua(
        locals in locals(), condition in condition_of(number_with_locals), first in number_with_locals(), second in number_with_locals(),
        numbers in prop::collection::vec((-3..4i32, 0..8u32), 12), other in prop::sample::select(vec!["", ", A(true, 1)", ", A(0 / 0, 2), B(1, 1)"])
    ) {
        let module = |(index, (x, y)): (usize, (i32, u32))| {
            format!("{}({}, {})", if index % 3 == 1 { "B" } else { "A" }, f64::from(x) / 2.0, f64::from(y) / 4.0)
        };
        let axiom = numbers.into_iter().enumerate().map(module).collect::<Vec<_>>().join(", ") + other;
        let modules = format!("A({first}, {second}), {{ B({second} - p, q) }}");
        for (pattern, parameters) in [("A(x, y) > B(z, w)", "x, y, z, w"), ("B(z, w) < A(x, y)", "z, w, x, y")] {
            let scripts = rules(&axiom, pattern, parameters, &condition, &modules, &locals);
            let [quick, by_lua] = scripts.map(|script| outcome(&script.replace("factor, no =", "p, q =").replace("0.5, nil", "0.5, -1")));
            prop_assert_eq!(quick, by_lua, "{} {} {} {}", pattern, locals, condition, modules);
        }
    }
}

#[test]
fn locals_that_are_no_numbers_behave_as_in_lua() {
    let mut errors = 0;
    for axiom in ["A(1, 2)", "A(1)", "A(\"a\", 1)", "A(0 / 0, 1)", "A(vec(1, 2, 3), 1)", "A(1, 0)"] {
        for locals in [
            "local p = x + y ",
            "local p, q = x, y ",
            "local p = x local q = p / y ",
            "local p = no ",
            "local p, x = x, missing ",
            "local x = y - x ",
            "local B = x ",
            "local p = -x local p = 3 ",
        ] {
            for (condition, modules) in
                [("x == x", "B(x)"), ("p == 3", "B(p, y)"), ("x ~= 7", "B(9, p)"), ("p < 5", "A(x, p)")]
            {
                let [quick, by_lua] = rules(axiom, "A(x, y)", "x, y", condition, modules, locals)
                    .map(|script| outcome(&script));
                errors += usize::from(quick.is_err());
                assert_eq!(quick, by_lua, "{axiom} {locals} {condition} {modules}");
            }
        }
    }
    assert!((40..150).contains(&errors), "{errors}");
}

#[test]
fn values_that_are_no_numbers_behave_as_in_lua() {
    let mut errors = 0;
    for axiom in
        ["A(1)", "A(1, true)", "A(\"a\")", "A(0 / 0)", "A({ 1 })", "A(1), A(2), A(false)", "A(vec(1, 2, 3))"]
    {
        for condition in
            ["x > 1", "x == 1", "x ~= y", "y < 2", "x < no", "x == no", "x < 0 or y > 2", "missing == x"]
        {
            let [quick, by_lua] = both(axiom, "A(x, y)", "x, y", condition).map(|script| outcome(&script));
            errors += usize::from(quick.is_err());
            // The statement is on the same line, so places are the same but for columns.
            assert_eq!(quick, by_lua, "{axiom} {condition}");
        }
    }
    assert!(errors > 10, "{errors}");
}

#[test]
fn a_guard_compares_with_the_values_of_its_variables_when_the_derivation_begins() {
    let text = chain(
        r#"
        local A, B = module("A", "n"), module("B", "n")
        local limit = 1
        local s = lsystem()
        s:axiom(A(1), A(2), A(3), A(4))
        s:rule("A(n)", { when = function(_, n) return n < limit end }, function(_, n) return B(n) end)
        limit = 3
        s:derive(1)
        limit = 4
        s:derive(1)"#,
    );
    assert_eq!(text, "B(1) B(2) B(3) A(4)");
}

/// Rules that return `modules`, once as they are and once after a statement.
fn successors(axiom: &str, modules: &str) -> [String; 2] {
    ["", "do end "].map(|statement| {
        format!(
            r#"
            local A, B = module("A", "x", "y?"), module("B", "z?")
            local limit, name = 2, "leaf"
            local s = lsystem()
            s:axiom({axiom})
            s:rule("A(x, y)", function(_, x, y) {statement}return {modules} end)
            s:rule("B < A(x) > B(z)", function(_, x, z) {statement}return A(x + z, z), {{ B(x) }} end)
            s:derive(3)"#
        )
    })
}

#[test]
fn a_rule_returns_the_same_modules_without_lua() {
    let mut errors = 0;
    for axiom in [
        "A(1, 2), { A(-3, 0.5) }, A(4, 8)",
        "A(1)",
        "A(1, true)",
        "B(1), A(\"a\", 3), B(2)",
        "A(0 / 0, 1)",
        "A(vec(1, 2, 3), 1)",
    ] {
        for modules in [
            "A(x / y, y)",
            "A(x + 1, y), { B(x), { B(-y), A(x * limit, y % 3) } }, B(x // y)",
            "A(y, x)",
            "A(x - x / 0, limit)",
            "B(0 * x / 0), A(7, y)",
            "B(), A(limit, y)",
            "B(name), A(limit, x)",
            "A(x)",
            "A(missing)",
            "B(), B()",
        ] {
            let [quick, by_lua] = successors(axiom, modules).map(|script| outcome(&script));
            errors += usize::from(quick.is_err());
            assert_eq!(quick, by_lua, "{axiom} {modules}");
        }
    }
    assert!(errors > 10, "{errors}");
}

#[test]
fn what_the_function_of_an_axiom_changes_is_in_the_formulas() {
    let text = chain(
        r#"
        local A = module("A", "n")
        local count = 0
        local s = lsystem()
        s:axiom(source({ { id = 1 } }), function(feature)
          count += 5
          return A(feature.id)
        end)
        s:rule("A(n)", { when = function(_, n) return n < count end }, function(_, n) return A(n + count) end)
        s:derive(3)"#,
    );
    assert_eq!(text, "A(6)");
}
