//! Errors of L-systems written as strings, and of `abop`.

use std::fmt::Write as _;

use insta::assert_snapshot;

use crate::support::{assert_decent, refused};

/// Returns the error of each line in a script, with its remedy.
fn told(lines: &[&str]) -> String {
    let mut text = String::new();
    for line in lines {
        let said = refused(&format!(
            "local Q, B = module(\"Q\", \"n\"), module(\"B\")\nlocal s = lsystem()\ns:axiom(\"F\")\n{line}\ns:derive(1)\n"
        ));
        assert_decent(&said);
        assert!(said.contains("s.lua:4"), "{said}");
        let kept = said.lines().filter(|line| line.contains("error: ") || line.contains("help: "));
        let kept: Vec<&str> = kept.map(|line| line.trim().trim_start_matches("error: s.lua:4: ")).collect();
        let _ = writeln!(text, "{line}\n  {}", kept.join("\n  "));
    }
    text
}

#[test]
fn an_error_says_how_a_string_was_split() {
    assert_snapshot!(told(&[
        "s:rule(\"F\", \"F[+Foo]F\")",
        "s:rule(\"F\", \"F%F\")",
        "s:rule(\"F\", \"F = 2\")",
        "s:rule(\"F\", \"local x = 1\")",
        "s:rule(\"F\", \"F*\")",
        "s:rule(\"F\", \"F7\")",
        "s:rule(\"F\", \"F < B\")",
        "s:rule(\"F\", \"F[+F\")",
        "s:rule(\"F\", \"F]F\")",
        "s:rule(\"F\", string.rep(\"F\", 500) .. \"o\")",
    ]), @"");
}

#[test]
fn an_error_says_what_is_wrong_with_the_arguments_of_a_string() {
    assert_snapshot!(told(&[
        "s:rule(\"F\", \"F(1\")",
        "s:rule(\"F\", \"F(1, 2)\")",
        "s:rule(\"F\", \"QB\")",
        "s:rule(\"F\", \"F!F\")",
        "s:rule(\"F\", \"B(1)\")",
        "s:rule(\"F\", \"F(x)\")",
        "s:rule(\"F\", \"F(1 +)\")",
        "s:rule(\"Q(F)\", \"F(F)\")",
        "s:rule(\"Q(size)\", \"Q(siz)\")",
    ]), @"");
}

#[test]
fn axioms_and_patterns_are_read_alike() {
    assert_snapshot!(told(&[
        "s:axiom(\"FoF\")",
        "s:axiom(\"F[F\")",
        "s:axiom(\"Q\")",
        "s:axiom(\"F(x)\")",
        "s:rule(\"+ < o\", \"F\")",
        "s:rule(\"F%\", \"F\")",
        "s:rule(\"F-F\", \"F\")",
        "s:rule(\"F > o\", \"F\")",
        "s:ignore(\"+o\")",
        "s:ignore(\"+[F]\")",
        "s:consider(\"o\")",
    ]), @"");
}

#[test]
fn abop_refuses_what_it_does_not_know() {
    assert_snapshot!(told(&[
        "abop(3)",
        "abop({})",
        "abop({ axiom = { F() } })",
        "abop({ axiom = \"F\", angel = 25 })",
        "abop({ axiom = \"F\", \"F\" })",
        "abop({ axiom = \"F\", F = 3 })",
        "abop({ axiom = \"F\", F = {} })",
        "abop({ axiom = \"F\", F = { \"F\", 3 } })",
        "abop({ axiom = \"F\", F = { { \"F\", 2 } } })",
        "abop({ axiom = \"F\", F = { { -1, \"F\" } } })",
        "abop({ axiom = \"F\", angle = \"wide\" })",
        "abop({ axiom = \"F\", ignore = 3 })",
        "abop({ axiom = \"F\", object = turtle(), angle = 25 })",
        "abop({ axiom = \"F\", F = \"F%\" }):derive(1)",
        "abop({ axiom = \"Q\" }):derive(1)",
        "abop({ axiom = \"F\", [\"F < \"] = \"F\" }):derive(1)",
    ]), @"");
}

#[test]
fn an_error_in_a_long_string_has_its_own_line() {
    let said = refused(
        "local s = lsystem()\ns:axiom(\"F\")\ns:rule(\"F\", [[\n  F[+F]\n  F(1, 2)\n]])\ns:derive(1)\n",
    );
    assert!(said.contains("s.lua:5: rule F: F has 0 to 1 parameters, not 2"), "{said}");
}

#[test]
fn a_failing_argument_of_a_string_names_the_module() {
    let said = refused(
        "local Q = module(\"Q\", \"n\")\nlocal s = lsystem()\ns:axiom(\"Q(1)\")\ns:rule(\"Q(n)\", \"Q(n.x)\")\ns:derive(1)\n",
    );
    assert!(said.contains("s.lua:4: rule Q(n): ") && said.contains("module: Q(1), step 1"), "{said}");
}
