//! Lists of modules, which scripts return with `sequence`.

use super::scripts::{chain, error, run};

const HEAD: &str = "local A, B, C = module('A', 'n'), module('B'), module('C')
    local s = lsystem {}
    ";

#[test]
fn a_sequence_stands_for_the_modules_of_its_list() {
    for (rule, expected) in [
        ("local t = {} for i = 1, n do table.insert(t, B()) end return sequence(t)", "B B B"),
        (
            "local t = {} for i = 1, n do table.insert(t, { B() }) end return C(), sequence(t), C()",
            "C [ B ] [ B ] [ B ] C",
        ),
        (
            "local t = {} for i = 1, n do table.insert(t, B()) end return { sequence(t) }, sequence({ C() })",
            "[ B B B ] C",
        ),
        ("return sequence({ sequence({ B() }), sequence({}), C() })", "B C"),
        ("return sequence({})", ""),
    ] {
        let text =
            chain(&format!("{HEAD} s:axiom(A(3)) s:rule('A(n)', function(_, n) {rule} end) s:derive(1)"));
        assert_eq!(text, expected, "{rule}");
    }
}

#[test]
fn a_sequence_has_any_length() {
    let made = run(&format!(
        "{HEAD} s:axiom(A(50000))
        s:rule('A(n)', function(_, n) local t = table.create(n) for i = 1, n do t[i] = B() end return sequence(t) end)
        expect(s:derive(1).counts.B, 50000)"
    ));
    assert!(made.warnings.is_empty());
}

#[test]
fn axioms_interpretations_and_decompositions_take_sequences() {
    let text = chain(&format!(
        "{HEAD} local list = {{ B(), {{ C() }} }} s:axiom(sequence(list), A(1), sequence(list))
        s:decompose('A(n)', function() return sequence({{ C(), C() }}) end) s:derive(0)"
    ));
    assert_eq!(text, "B [ C ] C C B [ C ]");
    run("local A = module('A')
        local s = lsystem { object = turtle() }
        s:axiom(A())
        s:interpret('A', function() return sequence({ F(1), { F(5) }, F(2) }) end)
        expect(s:derive(0).objects[1]:position().z, 3, 1e-9)");
}

#[test]
fn sequences_outside_rules_are_used_again_and_again() {
    let text = chain(&format!(
        "{HEAD} local list = sequence({{ B(), C() }}) s:axiom(A(1), A(2))
        s:rule('A(n)', function(_, n) return list, list end) s:derive(1)"
    ));
    assert_eq!(text, "B C B C B C B C");
}

#[test]
fn a_rule_that_returns_a_table_that_it_filled_gets_a_warning() {
    let told = |rule: &str| {
        let made =
            run(&format!("{HEAD}\ns:axiom(A(2))\ns:rule('A(n)', function(_, n)\n{rule}\nend)\ns:derive(1)"));
        made.warnings.iter().map(ToString::to_string).collect::<String>()
    };
    let filled = told("local t = {} for i = 1, n do table.insert(t, B()) end\nreturn t");
    assert!(filled.contains(":7: rule A(n): a table is one branch"), "{filled}");
    assert!(filled.contains("return sequence(list)"), "{filled}");
    assert_eq!(told("local t = {} for i = 1, n do table.insert(t, B()) end return sequence(t)"), "");
    assert_eq!(told("local t = {} for i = 1, n do table.insert(t, B()) end return { sequence(t) }"), "");
    assert_eq!(told("local t = {} for i = 1, n do table.insert(t, B()) end return t, C()"), "");
    assert_eq!(told("return { B() }"), "");
}

#[test]
fn wrong_sequences_are_refused() {
    let said = |rule: &str| {
        error(&format!("{HEAD} s:axiom(A(1)) s:rule('A(n)', function(_, n) {rule} end) s:derive(1)"))
    };
    assert!(said("return sequence(B())").contains("sequence takes a list of modules, not a module"));
    assert!(said("return sequence(3)").contains("not the number 3"));
    assert!(said("return sequence({ 3 })").contains("one item is the number 3"));
    assert!(said("return sequence({ x = B() })").contains("this one has the field x"));
    assert!(said("local t = {} t[1] = sequence(t) return sequence(t)").contains("nested more than"));
}
