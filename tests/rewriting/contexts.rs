//! Contexts along the tree: law 4 of the design, one line per case.

use burgeon::script::RunOptions;

use super::naive::{self, Pattern};
use super::scripts::{Case, Passing, Plain, chain, divided, error, lines, matched, run, run_with, words};

/// Ignored symbols, chain with a star before each matching module, and pattern.
const TABLE: &[(&str, &str, &str)] = &[
    // Along a chain without branches.
    ("", "A *B A", "A < B"),
    ("", "A *B B A", "A < B"),
    ("", "B A B *B A", "B < B > A"),
    ("", "*A *A A", "A > A"),
    ("", "A *A *A", "A < A"),
    ("", "A *A A", "A < A > A"),
    ("", "B C A B C *S", "A B C < S"),
    ("", "S *S A B S B", "S > A B"),
    ("", "A B", "B < A"),
    ("", "A B", "B > A"),
    // At the start and end of a chain there is nothing to match.
    ("", "S", "A < S"),
    ("", "S", "S > A"),
    ("", "A S", "A A < S"),
    ("", "S A", "S > A A"),
    // A left context is the path towards the axiom.
    ("", "A [ *S ]", "A < S"),
    ("", "A [ B *S ]", "A B < S"),
    ("", "A [ [ [ *S ] ] ]", "A < S"),
    ("", "A [ B ] *S", "A < S"),
    ("", "A [ B ] S", "B < S"),
    ("", "A [ B [ C ] D ] *S", "A < S"),
    ("", "A [ B [ C ] *S ]", "B < S"),
    ("", "A [ B ] [ *S ] *S [ S ] B [ S ]", "A < S"),
    ("", "[ A ] S", "A < S"),
    ("", "[ A ] [ S ]", "A < S"),
    // A right context follows the main path and skips branches.
    ("", "*S [ B ] A", "S > A"),
    ("", "*S [ B ] [ C [ D ] ] A [ B ] [ C ] D", "S > A D"),
    ("", "S [ A ]", "S > A"),
    ("", "[ S ] A", "S > A"),
    ("", "A [ S ] B", "S > B"),
    ("", "[ *S A ] A", "S > A"),
    ("", "*S [ ] A", "S > A"),
    // A right context enters branches that it names.
    ("", "*S [ A ]", "S > [ A ]"),
    ("", "*S [ A ] B", "S > [ A ] B"),
    ("", "S [ A ] C", "S > [ A ] B"),
    ("", "S A", "S > [ A ]"),
    ("", "S B [ A ]", "S > [ A ]"),
    ("", "*S B [ A ]", "S > B [ A ]"),
    ("", "*S [ B ] [ A ]", "S > [ A ]"),
    ("", "*S [ ] [ A ]", "S > [ A ]"),
    ("", "S [ ]", "S > [ A ]"),
    ("", "*S [ A C ]", "S > [ A ]"),
    ("", "S [ C A ]", "S > [ A ]"),
    ("", "*S [ A [ C ] B ]", "S > [ A B ]"),
    ("", "S [ [ A ] B ]", "S > [ A ]"),
    ("", "*S [ [ A ] B ]", "S > [ B ]"),
    ("", "*S [ [ A ] B ]", "S > [ [ A ] B ]"),
    ("", "*S [ [ A ] ]", "S > [ [ A ] ]"),
    ("", "S [ A ] B", "S > [ A B ]"),
    // Named branches match in order, each the first remaining one.
    ("", "*S [ A ] [ B ]", "S > [ A ] [ B ]"),
    ("", "S [ B ] [ A ]", "S > [ A ] [ B ]"),
    ("", "*S [ C ] [ A ] [ C ] [ B ] [ C ]", "S > [ A ] [ B ]"),
    ("", "*S [ A ] [ A ]", "S > [ A ] [ A ]"),
    ("", "S [ A ]", "S > [ A ] [ A ]"),
    ("", "S [ A B ] [ A ]", "S > [ A ] [ A B ]"),
    ("", "*S [ B ] A [ C ] [ D ]", "S > [ B ] A [ D ]"),
    ("", "S A [ D ]", "S > [ D ] A"),
    // Named branches within named branches.
    ("", "*S [ A [ B [ C ] ] ] D", "S > [ A [ B [ C ] ] ] D"),
    ("", "S [ A [ B ] [ C ] ] D", "S > [ A [ B [ C ] ] ] D"),
    ("", "*S [ A [ D ] [ B ] C ] D", "S > [ A [ B ] C ] D"),
    ("", "*S [ A [ D ] ] [ A [ B ] ]", "S > [ A [ B ] ]"),
    // The example of ABOP and of the design.
    ("", "A B C [ D E ] [ *S G [ H I [ J K ] L ] M N O ]", "B C < S > G [ H ] M"),
    ("", "A B C [ D E ] [ S G [ H I [ J K ] L ] M N O ]", "B C < S > G H M"),
    ("", "A B C [ D E ] [ *S G [ H I [ J K ] L ] M N O ]", "A B C < S > G [ H I [ J ] L ] M N O"),
    ("", "A B C [ D E ] [ S G [ H I [ J K ] L ] M N O ]", "E < S > G"),
    // Ignored symbols are skipped everywhere, and can still be rewritten.
    ("X", "A X *S", "A < S"),
    ("X", "A X X *S X B", "A < S > B"),
    ("X", "A [ X *S ] B", "A < S"),
    ("X", "A X [ X *S ]", "A < S"),
    ("X", "A [ X ] *S", "A < S"),
    ("X", "*S X [ A ]", "S > [ A ]"),
    ("X", "*S [ X A ] X B", "S > [ A ] B"),
    ("X", "*S [ X ] X [ X X A X B ] X C", "S > [ A B ] C"),
    ("X", "*S [ X [ A ] B ]", "S > [ B ]"),
    ("X", "*S [ X [ A ] B ]", "S > [ [ A ] B ]"),
    ("X", "S [ X ] X", "S > [ A ]"),
    ("X", "A *X B", "A < X > B"),
    ("X", "A *X *X B", "A < X > B"),
    ("X", "A [ *X ] B", "A < X"),
    ("X", "*X *X [ X A ]", "X > [ A ]"),
    ("X Y", "A X Y *S Y X [ Y A ] B", "A < S > [ A ] B"),
    // An ignored symbol never matches a context.
    ("X", "X S", "X < S"),
    ("X", "S X", "S > X"),
    ("X", "S [ X ]", "S > [ X ]"),
];

fn ignoring(names: &str) -> Passing<'_> {
    if names.is_empty() { Passing::Nothing } else { Passing::Ignore(names) }
}

/// Returns the chain without stars, and the numbers of the modules with a star.
fn starred(chain: &str) -> (String, Vec<usize>) {
    let modules = words(chain).into_iter().filter(|word| word != "[" && word != "]");
    let stars = modules.enumerate().filter(|(_, word)| word.starts_with('*')).map(|(number, _)| number);
    (chain.replace('*', ""), stars.collect())
}

fn check_table(options: RunOptions) {
    let cases: Vec<(Case, Vec<usize>)> = TABLE
        .iter()
        .map(|(ignored, chain, pattern)| {
            let (text, expected) = starred(chain);
            (
                Case { passing: ignoring(ignored), chains: vec![text], pattern: Pattern::parse(pattern) },
                expected,
            )
        })
        .collect();
    assert!(cases.len() >= 80, "the table has {} cases", cases.len());
    check(&cases, options);
}

fn check(cases: &[(Case, Vec<usize>)], options: RunOptions) {
    let all: Vec<Case> = cases.iter().map(|(case, _)| case.clone()).collect();
    let found = matched(&all, options);
    assert_eq!(found.len(), cases.len());
    let wrong: Vec<String> = cases
        .iter()
        .zip(&found)
        .filter(|((_, expected), found)| expected != *found)
        .map(|((case, expected), found)| format!("{case:?} matches {found:?}, not {expected:?}"))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn contexts_match_along_the_tree_in_every_case_of_the_table() {
    check_table(burgeon::options());
}

#[test]
fn the_table_holds_where_every_module_is_a_batch_of_its_own() {
    check_table(divided(1, 1));
}

#[test]
fn the_naive_matcher_agrees_with_the_table() {
    for (ignored, chain, pattern) in TABLE {
        let (text, expected) = starred(chain);
        let found = naive::matches(&naive::parse(&text), &Pattern::parse(pattern), &words(ignored));
        assert_eq!(found, expected, "{pattern} in {text} ignoring {ignored:?}");
    }
}

#[test]
fn contexts_end_at_the_borders_of_chains() {
    let table: [(&[&str], &str); 8] = [
        (&["A", "S", "B"], "A < S"),
        (&["A", "S", "B"], "S > B"),
        (&["A X", "X S X", "X B"], "A < S"),
        (&["A X", "X S X", "X B"], "S > B"),
        (&["S", "[ B ]"], "S > [ B ]"),
        (&["S [ A ]", "[ B ] B"], "S > [ A ] B"),
        (&["A *S B", "A [ *S B ]", "S B", "A S"], "A < S > B"),
        (&["", "A *S", "", "A *S"], "A < S"),
    ];
    let cases: Vec<(Case, Vec<usize>)> = table
        .iter()
        .map(|(chains, pattern)| {
            let (_, expected) = starred(&chains.join(" "));
            let chains = chains.iter().map(|chain| starred(chain).0).collect();
            (Case { passing: Passing::Ignore("X"), chains, pattern: Pattern::parse(pattern) }, expected)
        })
        .collect();
    for batch in [1, 2, 4096] {
        check(&cases, divided(1, batch));
    }
}

#[test]
fn consider_passes_over_all_other_symbols() {
    let cases: Vec<(Case, Vec<usize>)> = [
        ("A S B", "A X *S Y B", "A < S > B"),
        ("A S B", "A X Y [ X *S Y [ Z B ] ]", "A < S > [ B ]"),
        ("A B", "A X *S Y B", "A < S > B"),
        ("S", "A S", "A < S"),
        ("A S", "A [ X *S ] *S", "A < S"),
    ]
    .into_iter()
    .map(|(considered, chain, pattern)| {
        let (text, expected) = starred(chain);
        let passing = Passing::Consider(considered);
        (Case { passing, chains: vec![text], pattern: Pattern::parse(pattern) }, expected)
    })
    .collect();
    check(&cases, burgeon::options());
}

#[test]
fn ignore_takes_several_names_and_several_calls() {
    for ignoring in ["s:ignore(\"X Y\")", "s:ignore(\"X\", \"Y\")", "s:ignore(\"X\"):ignore(\"Y\")"] {
        let text = chain(&format!(
            r#"
            local A = module("A"); local B = module("B"); local C = module("C"); local X = module("X"); local Y = module("Y")
            local s = lsystem {{}}
            {ignoring}
            s:axiom(A(), X(), Y(), B())
            s:rule("A < B", function() return C() end)
            s:derive(1)
            "#
        ));
        assert_eq!(text, "A X Y C", "{ignoring}");
    }
}

#[test]
fn an_unknown_name_in_ignore_or_in_a_pattern_is_an_error() {
    let told = error(
        "local Apex = module(\"Apex\")\nlocal s = lsystem {}\ns:ignore(\"Apx\")\ns:axiom(Apex())\ns:derive(1)",
    );
    assert!(told.contains("main.lua:3") && told.contains("Apx") && told.contains("Apex?"), "{told}");
    let told = error(
        "local Apex = module(\"Apex\")\nlocal s = lsystem {}\ns:axiom(Apex())\ns:rule(\"Apx < Apex\", function() return nil end)\ns:derive(1)",
    );
    assert!(told.contains("main.lua:4") && told.contains("Apx") && told.contains("Apex?"), "{told}");
}

#[test]
fn parameters_of_contexts_arrive_in_the_order_of_the_pattern() {
    let text = chain(
        r#"
        local A = module("A", "a"); local B = module("B", "p", "q"); local C = module("C", "c"); local D = module("D", "d")
        local All = module("All", "a", "p", "q", "c", "d", "e"); local X = module("X")
        local s = lsystem {}
        s:ignore("X")
        s:axiom(A(1), X(), { A(2), X(), B(3, 4), X(), { X() }, { D(5), C(6) }, X(), D(7) })
        s:rule("A(_) A(a) < B(p, q) > [D(d) C(c)] D(e)", function(this, _, a, p, q, d, c, e)
          return All(a, p, q, c, d, e)
        end)
        s:derive(1)
        "#,
    );
    assert_eq!(text, "A(1) X [ A(2) X All(2,3,4,6,5,7) X [ X ] [ D(5) C(6) ] X D(7) ]");
}

#[test]
fn modules_of_a_pattern_may_leave_their_parameters_unnamed() {
    let text = chain(
        r#"
        local A = module("A", "a", "b"); local B = module("B", "p"); local R = module("R", "x")
        local s = lsystem {}
        s:axiom(A(1, 2), B(3), A(4, 5))
        s:rule("A < B > A(a, b)", function(this, a, b) return R(a * 10 + b) end)
        s:rule("A > B(p)", function(this, p) return R(p) end)
        s:rule("B(p) < A", function(this, p) return R(-p) end)
        s:derive(1)
        "#,
    );
    assert_eq!(text, "R(3) R(45) R(-3)");
}

#[test]
fn an_underscore_may_stand_for_several_parameters() {
    let text = chain(
        r#"
        local A = module("A", "a", "b", "c")
        local s = lsystem {}
        s:axiom(A(1, 2, 3), A(4, 5, 6))
        s:rule("A(_, _, x) < A(_, y, _)", [[ return A(x, y, 0) ]])
        s:derive(1)
        "#,
    );
    assert_eq!(text, "A(1,2,3) A(3,5,0)");
}

#[test]
fn a_branch_that_failed_to_match_leaves_no_parameters_behind() {
    let text = chain(
        r#"
        local S = module("S"); local A = module("A", "x"); local B = module("B", "x"); local R = module("R", "x", "y")
        local s = lsystem {}
        s:axiom(S(), { A(1), A(2) }, { A(3), B(4) })
        s:rule("S > [A(x) B(y)]", function(this, x, y) return R(x, y) end)
        s:derive(1)
        "#,
    );
    assert_eq!(text, "R(3,4) [ A(1) A(2) ] [ A(3) B(4) ]");
}

#[test]
fn contexts_read_the_chain_as_it_stood_when_the_step_began() {
    let shift = Plain { ignore: "", axiom: "A B B B", rules: "A < B -> A\nA -> B" };
    assert_eq!(shift.derive([1, 3]), ["B A B B", "B B B A"]);
    let both = Plain { ignore: "", axiom: "A B", rules: "A > B -> B\nA < B -> A" };
    assert_eq!(both.derive([1]), ["B A"]);
}

#[test]
fn chains_of_features_share_no_context_while_they_grow() {
    let script = r#"
        local A = module("A"); local B = module("B"); local C = module("C")
        local s = lsystem {}
        s:axiom(source { { id = "a", n = 2 }, { id = "b", n = 0 }, { id = "c", n = 1 } }, function(feature)
          local list = { A() }
          for i = 1, feature.n do table.insert(list, B()) end
          return table.unpack(list)
        end)
        s:rule("A < B", function() return A(), { C() } end)
        s:rule("B > A", function() return C() end)
        s:derive(2)
    "#;
    let expected = ["A A [ C ] A [ C ]", "A", "A A [ C ]"];
    assert_eq!(lines(&run(script)), expected);
    assert_eq!(lines(&run_with(script, divided(2, 1))), expected);
}
