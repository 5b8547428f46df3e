//! Choice among rules, and parallel application: laws 1 and 2 of the design.

use super::candidates::compare;
use super::scripts::{Plain, chain, divided, error, lines, run_with};

const HEAD: &str = r#"
    local A = module("A", "n"); local X = module("X"); local Y = module("Y"); local Z = module("Z"); local B = module("B")
    local s = lsystem {}
"#;

/// Returns `X`, `Y` or `Z` for each of `A(1)` to `A(4)`, between two `B`.
fn chosen(rules: &str) -> String {
    let text = chain(&format!(
        "{HEAD}\n s:axiom(B(), A(1), B(), A(2), B(), A(3), B(), A(4), B())\n {rules}\n s:derive(1)"
    ));
    text.split(' ').filter(|word| *word != "B").collect::<Vec<_>>().join(" ")
}

#[test]
fn the_first_rule_whose_guard_holds_wins() {
    for (rules, expected) in [
        ("s:rule(\"A\", [[ return X() ]]) s:rule(\"A\", [[ return Y() ]])", "X X X X"),
        (
            "s:rule(\"A(n)\", { when = function(_, n) return n > 2 end }, [[ return X() ]])
             s:rule(\"A\", [[ return Y() ]])",
            "Y Y X X",
        ),
        (
            "s:rule(\"A\", [[ return Y() ]])
             s:rule(\"A(n)\", { when = function(_, n) return n > 2 end }, [[ return X() ]])",
            "Y Y Y Y",
        ),
        (
            "s:rule(\"A(n)\", { when = function(_, n) return n > 3 end }, [[ return X() ]])
             s:rule(\"A(n)\", { when = function(_, n) return n > 1 end }, [[ return Y() ]])
             s:rule(\"A(n)\", { when = function(_, n) return n > 2 end }, [[ return Z() ]])",
            "A(1) Y Y X",
        ),
        ("s:rule(\"A\", { when = function() return false end }, [[ return X() ]])", "A(1) A(2) A(3) A(4)"),
        ("s:rule(\"A\", { when = function() end }, [[ return X() ]])", "A(1) A(2) A(3) A(4)"),
        ("s:rule(\"A\", { when = function() return 0 end }, [[ return X() ]])", "X X X X"),
    ] {
        assert_eq!(chosen(rules), expected, "{rules}");
    }
}

#[test]
fn a_rule_that_returns_no_value_keeps_later_rules_from_their_turn() {
    let rules =
        "s:rule(\"A(n)\", function(_, n) if n > 2 then return X() end end) s:rule(\"A\", [[ return Y() ]])";
    assert_eq!(chosen(rules), "A(1) A(2) X X");
}

#[test]
fn contexts_and_guards_must_both_hold() {
    let rules = "s:rule(\"B < A(n) > B\", { when = function(_, n) return n % 2 == 0 end }, [[ return X() ]])
                 s:rule(\"A < A(n)\", { when = function() return true end }, [[ return Z() ]])
                 s:rule(\"B < A\", [[ return Y() ]])";
    assert_eq!(chosen(rules), "Y X Y X");
}

#[test]
fn guards_see_the_parameters_of_contexts() {
    let text = chain(
        r#"
        local S = module("S", "s"); local I = module("I", "l", "w")
        local s = lsystem {}
        s:axiom(S(0), I(1, 2), S(3), I(4, 5), { S(6), I(7, 8) }, I(9, 10))
        s:rule("S(x) < I(l, w)", { when = function(this, x, l, w) return x > 0 and w < 10 end },
          function(this, x, l, w) return I(l + x, w) end)
        s:derive(1)
        "#,
    );
    assert_eq!(text, "S(0) I(1,2) S(3) I(7,5) [ S(6) I(13,8) ] I(9,10)");
}

#[test]
fn a_guard_without_contexts_asks_only_what_may_still_be_decided() {
    // If an earlier rule applies, the guard of a later one does not run, so it need not handle all values.
    let rules = "s:rule(\"A(n)\", { when = function(_, n) return n < 4 end }, [[ return X() ]])
                 s:rule(\"A(n)\", { when = function(_, n) if n < 4 then error(\"asked\") end return true end }, [[ return Y() ]])";
    assert_eq!(chosen(rules), "X X X Y");
}

#[test]
fn a_rule_without_weight_loses_to_a_weighted_one_before_it() {
    let rules = "s:rule(\"A\", { weight = 1 }, [[ return X() ]]) s:rule(\"A\", [[ return Y() ]])";
    assert_eq!(chosen(rules), "X X X X");
    let rules = "s:rule(\"A\", [[ return Y() ]]) s:rule(\"A\", { weight = 1000 }, [[ return X() ]])";
    assert_eq!(chosen(rules), "Y Y Y Y");
}

#[test]
fn a_weighted_rule_whose_guard_fails_is_no_candidate() {
    let rules =
        "s:rule(\"A(n)\", { weight = 1000, when = function(_, n) return n == 2 end }, [[ return X() ]])
                 s:rule(\"A(n)\", { when = function(_, n) return n == 3 end }, [[ return Y() ]])
                 s:rule(\"A\", { weight = 0.001 }, [[ return Z() ]])";
    // For 2, the first candidate has a weight, so X and Z are drawn; with odds of a million to one the result
    // is X.
    assert_eq!(chosen(rules), "Z X Y Z");
}

#[test]
fn weighted_rules_between_others_are_drawn_only_where_they_come_first() {
    let rules = "s:rule(\"A(n)\", { when = function(_, n) return n <= 2 end }, [[ return X() ]])
                 s:rule(\"A\", { weight = 1 }, [[ return Y() ]])
                 s:rule(\"A(n)\", { when = function(_, n) return n == 4 end }, [[ return Z() ]])";
    assert_eq!(chosen(rules), "X X Y Y");
}

#[test]
fn rules_of_other_symbols_do_not_disturb_the_order() {
    let system = Plain {
        ignore: "",
        axiom: "A B A B",
        rules: "A < B -> C
                B -> D
                B < A -> E
                A -> F",
    };
    assert_eq!(system.derive([1, 2]), ["F C E C", "F C E C"]);
}

#[test]
fn all_modules_are_rewritten_at_once() {
    // Rule 90: each cell becomes the sum of its neighbours modulo 2. Any sequential application gives another
    // result.
    let script = r#"
        local Cell = module("Cell", "x")
        local s = lsystem {}
        local row = {}
        for i = 1, 65 do row[i] = Cell(if i == 33 then 1 else 0) end
        s:axiom(table.unpack(row))
        s:rule("Cell(l) < Cell(x) > Cell(r)", function(this, l, x, r) return Cell((l + r) % 2) end)
        s:derive(31)
    "#;
    let mut row = [0u8; 65];
    row[32] = 1;
    for _ in 0..31 {
        let before = row;
        for i in 1..64 {
            row[i] = before[i - 1] ^ before[i + 1];
        }
    }
    let expected: Vec<String> = row.iter().map(|x| format!("Cell({x})")).collect();
    for (threads, batch) in [(1, 4096), (1, 1), (2, 3), (7, 10)] {
        assert_eq!(lines(&run_with(script, divided(threads, batch))), [expected.join(" ")]);
    }
}

#[test]
fn derive_without_steps_ends_when_no_rule_applies() {
    let text = chain(&format!(
        "{HEAD}
        s:axiom(A(5))
        s:rule(\"A(n)\", {{ when = function(_, n) return n > 0 end }}, [[ return B(), A(n - 1) ]])
        s:derive()"
    ));
    assert_eq!(text, "B B B B B A(0)");
}

#[test]
fn derive_of_no_steps_is_the_axiom() {
    let text =
        chain(&format!("{HEAD} s:axiom(A(1), {{ B(), {{}} }}) s:rule(\"A\", [[ return X() ]]) s:derive(0)"));
    assert_eq!(text, "A(1) [ B [ ] ]");
}

#[test]
fn an_erased_chain_is_empty_and_stays_so() {
    let text =
        chain(&format!("{HEAD} s:axiom(A(1), A(2)) s:rule(\"A\", function() return nil end) s:derive(3)"));
    assert_eq!(text, "");
}

#[test]
fn a_weight_is_a_number_from_0() {
    for weight in ["-1", "0/0", "math.huge", "\"3\"", "true"] {
        let told = error(&format!(
            "{HEAD} s:axiom(A(1)) s:rule(\"A\", {{ weight = {weight} }}, [[ return X() ]]) s:derive(1)"
        ));
        assert!(told.contains("weight") && told.contains("rule A"), "{weight}: {told}");
    }
}

#[test]
fn a_rule_of_weight_0_is_no_candidate_whatever_the_other_rules_are() {
    let zero = "s:rule(\"A\", { weight = 0 }, [[ return X() ]])";
    let guarded = "s:rule(\"A(n)\", { when = function(_, n) return n == 3 end }, [[ return Y() ]])";
    let plain = "s:rule(\"A\", [[ return Z() ]])";
    let both = "s:rule(\"A(n)\", { weight = 0, when = function() return true end }, [[ return X() ]])";
    for (rules, expected) in [
        ([zero, ""], "A(1) A(2) A(3) A(4)"),
        ([zero, zero], "A(1) A(2) A(3) A(4)"),
        ([zero, guarded], "A(1) A(2) Y A(4)"),
        ([guarded, zero], "A(1) A(2) Y A(4)"),
        ([both, guarded], "A(1) A(2) Y A(4)"),
        ([both, plain], "Z Z Z Z"),
        ([zero, plain], "Z Z Z Z"),
    ] {
        assert_eq!(chosen(&rules.concat()), expected, "{rules:?}");
    }
}

#[test]
fn of_several_guards_that_fail_the_one_that_comes_first_in_the_chain_is_told() {
    let rules = "s:axiom(B(), A(1), X(), A(2))
                 s:rule(\"A(n)\", { when = function(_, n) if n == 2 then error(\"late\") end return false end }, [[ return Y() ]])
                 s:rule(\"A(n)\", { when = function(_, n) error(\"early\") end }, [[ return Y() ]])
                 s:rule(\"B\", { when = function() return true end }, [[ return Y() ]])
                 s:derive(1)";
    let told = error(&format!("{HEAD}{rules}"));
    assert!(told.contains("early") && told.contains("A(1)"), "{told}");
}

#[test]
fn random_systems_apply_what_the_law_of_choice_allows() {
    for (seed, options) in [(1, divided(1, 4096)), (2, divided(2, 3)), (3, divided(2, 4096))] {
        let compared = compare(seed, 200, options);
        assert!(compared.applied > 300 && compared.drawn > 50 && compared.weightless > 80, "{compared:?}");
    }
}
