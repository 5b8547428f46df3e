//! Errors of L-systems written as strings, and of `abop`.

use std::fmt::Write as _;

use insta::assert_snapshot;

use crate::support::{assert_decent, refused, without_columns};

/// Returns the error of each line in a script, with its remedy.
fn told(lines: &[&str]) -> String {
    let mut text = String::new();
    for line in lines {
        let said = refused(&format!(
            "local Q, B = module(\"Q\", \"n\"), module(\"B\")\nlocal s = lsystem()\ns:axiom(\"F\")\n{line}\ns:derive(1)\n"
        ));
        assert_decent(&said);
        assert!(said.contains("s.lua:4"), "{said}");
        let said = without_columns(&said);
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
        "s:rule(\"F\", \"F?F\")",
        "s:rule(\"F\", \"F = 2\")",
        "s:rule(\"F\", \"local x = 1\")",
        "s:rule(\"F\", \"F*\")",
        "s:rule(\"F\", \"F7\")",
        "s:rule(\"F\", \"F < B\")",
        "s:rule(\"F\", \"F[+F\")",
        "s:rule(\"F\", \"F]F\")",
        "s:rule(\"F\", string.rep(\"F\", 500) .. \"o\")",
    ]), @r#"
    s:rule("F", "F[+Foo]F")
      rule F: read as F [ + F o o ] F: o is no module
      help: declare it: local o = module("o"), or write the successor as a body of Lua with return
    s:rule("F", "F?F")
      rule F: read as F ? F: ? is no module
      help: the symbols of the turtle are F G f + - & ^ \ / | $ ! # { } . ; , ~ % _ @O @v [ ]; declare modules with letters, or write the successor as a body of Lua with return
    s:rule("F", "F = 2")
      rule F: read as F = 2: = is no module
      help: the symbols of the turtle are F G f + - & ^ \ / | $ ! # { } . ; , ~ % _ @O @v [ ]; declare modules with letters, or write the successor as a body of Lua with return
    s:rule("F", "local x = 1")
      rule F: read as l o c a l x = 1: l is no module
      help: declare it: local l = module("l"), or write the successor as a body of Lua with return
    s:rule("F", "F*")
      rule F: read as F *: * is no module
      help: the symbols of the turtle are F G f + - & ^ \ / | $ ! # { } . ; , ~ % _ @O @v [ ]; declare modules with letters, or write the successor as a body of Lua with return
    s:rule("F", "F7")
      rule F: read as F 7: 7 is no module
      help: declare it: local _7 = module("_7"), or write the successor as a body of Lua with return
    s:rule("F", "F < B")
      rule F: read as F < B: < is no module
      help: the symbols of the turtle are F G f + - & ^ \ / | $ ! # { } . ; , ~ % _ @O @v [ ]; declare modules with letters, or write the successor as a body of Lua with return
    s:rule("F", "F[+F")
      rule F: read as F [ + F: a branch is not closed
      help: close it with ]
    s:rule("F", "F]F")
      rule F: read as F ] F: a ] closes no branch
      help: remove it, or open the branch with [
    s:rule("F", string.rep("F", 500) .. "o")
      rule F: read as F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F ... (1001 characters in all) ... F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F F o: o is no module
      help: declare it: local o = module("o"), or write the successor as a body of Lua with return
    "#);
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
    ]), @r#"
    s:rule("F", "F(1")
      rule F: the arguments of F in "F(1" are not closed
      help: close them with )
    s:rule("F", "F(1, 2)")
      rule F: F has 0 to 1 parameters, not 2
      help: it was declared as F(length?)
    s:rule("F", "QB")
      rule F: read as Q B: Q has no arguments, but it was declared as Q(n)
      help: write its arguments in brackets, such as Q(n)
    s:rule("F", "F!F")
      rule F: read as F ! F: ! has no arguments, but it was declared as Width(width)
      help: write its arguments in brackets, such as !(width)
    s:rule("F", "B(1)")
      rule F: B has no parameters, not 1
      help: it was declared as B
    s:rule("F", "F(x)")
      rule F: unknown name x
      help: a string knows the parameters of the pattern and the names of all scripts; write a function to use others
    s:rule("F", "F(1 +)")
      rule F: Expected identifier when parsing expression, got ')'
    s:rule("Q(F)", "F(F)")
      rule Q(F): read as F(F): F is also a parameter
      help: give the parameter of the pattern another name
    s:rule("Q(size)", "Q(siz)")
      rule Q(size): unknown name siz
      help: did you mean size?
    "#);
}

#[test]
fn axioms_and_patterns_are_read_alike() {
    assert_snapshot!(told(&[
        "s:axiom(\"FoF\")",
        "s:axiom(\"F[F\")",
        "s:axiom(\"Q\")",
        "s:axiom(\"F(x)\")",
        "s:rule(\"+ < o\", \"F\")",
        "s:rule(\"F?\", \"F\")",
        "s:rule(\"F > o\", \"F\")",
        "s:ignore(\"+o\")",
        "s:ignore(\"+[F]\")",
        "s:consider(\"o\")",
    ]), @r#"
    s:axiom("FoF")
      read as F o F: o is no module
      help: declare it: local o = module("o")
    s:axiom("F[F")
      read as F [ F: a branch is not closed
      help: close it with ]
    s:axiom("Q")
      read as Q: Q has no arguments, but it was declared as Q(n)
      help: write its arguments in brackets, such as Q(n)
    s:axiom("F(x)")
      unknown name x
      help: a string knows the parameters of the pattern and the names of all scripts; write a function to use others
    s:rule("+ < o", "F")
      read as + < o: o is no module
      help: declare it: local o = module("o")
    s:rule("F?", "F")
      malformed pattern: unexpected '?' at character 2
      help: expected a module's name
    s:rule("F > o", "F")
      unknown symbol o in the pattern "F > o"
      help: declare it: local o = module("o")
    s:ignore("+o")
      read as + o: o is no module
      help: declare it: local o = module("o")
    s:ignore("+[F]")
      read as + [ F ]: only modules without brackets can be listed
      help: write their names or symbols, such as "+-F"
    s:consider("o")
      unknown symbol o
      help: declare it: local o = module("o")
    "#);
}

#[test]
fn abop_refuses_what_it_does_not_know() {
    assert_snapshot!(told(&[
        "abop(3)",
        "abop({})",
        "abop({ axiom = { F() } })",
        "abop({ axiom = \"F\", angel = 25 })",
        "abop({ axiom = \"F\", Leaf = \"F\" })",
        "abop({ axiom = \"F\", [\"Leaf(x)\"] = \"F\" })",
        "abop({ axiom = \"F\", \"F\" })",
        "abop({ axiom = \"F(1\" })",
        "abop({ axiom = \"F\", F = 3 })",
        "abop({ axiom = \"F\", F = {} })",
        "abop({ axiom = \"F\", F = { \"F\", 3 } })",
        "abop({ axiom = \"F\", F = { { \"F\", 2 } } })",
        "abop({ axiom = \"F\", F = { { -1, \"F\" } } })",
        "abop({ axiom = \"F\", angle = \"wide\" })",
        "abop({ axiom = \"F\", ignore = 3 })",
        "abop({ axiom = \"F\", object = turtle(), angle = 25 })",
        "abop({ axiom = \"F\", F = \"F?\" }):derive(1)",
        "abop({ axiom = \"Q\" }):derive(1)",
        "abop({ axiom = \"F\", [\"F < \"] = \"F\" }):derive(1)",
    ]), @r#"
    abop(3)
      abop takes a table, not the number 3
      help: write abop({ axiom = "X", X = "F[+X]F[-X]+X", F = "FF", angle = 25.7 })
    abop({})
      axiom of abop is nothing, not a string
      help: write abop({ axiom = "X", X = "F[+X]F[-X]+X", F = "FF", angle = 25.7 })
    abop({ axiom = { F() } })
      axiom of abop is a table, not a string
      help: write abop({ axiom = "X", X = "F[+X]F[-X]+X", F = "FF", angle = 25.7 })
    abop({ axiom = "F", angel = 25 })
      abop has no option angel
      help: it has axiom, angle, step, width, ignore, consider, object; other keys are patterns of rules
    abop({ axiom = "F", Leaf = "F" })
      Leaf in abop is neither a letter nor a module
      help: declare it before: local Leaf = module("Leaf")
    abop({ axiom = "F", ["Leaf(x)"] = "F" })
      Leaf in abop is neither a letter nor a module
      help: declare it before: local Leaf = module("Leaf")
    abop({ axiom = "F", "F" })
      a key of abop is the number 1, not the pattern of a rule
      help: write abop({ axiom = "X", X = "F[+X]F[-X]+X", F = "FF", angle = 25.7 })
    abop({ axiom = "F(1" })
      the arguments of F in "F(1" are not closed
      help: close them with )
    abop({ axiom = "F", F = 3 })
      the successor of F in abop is the number 3
      help: write a string, a list of strings, or a list of weights and strings: { { 2, "F" }, { 1, "FF" } }
    abop({ axiom = "F", F = {} })
      the successor of F in abop is a table
      help: write a string, a list of strings, or a list of weights and strings: { { 2, "F" }, { 1, "FF" } }
    abop({ axiom = "F", F = { "F", 3 } })
      successor 2 of F in abop is neither a string nor a weight with a string
      help: write { "F[+F]F", "F[-F]F" } or { { 2, "F" }, { 1, "FF" } }
    abop({ axiom = "F", F = { { "F", 2 } } })
      successor 1 of F in abop is neither a string nor a weight with a string
      help: write { "F[+F]F", "F[-F]F" } or { { 2, "F" }, { 1, "FF" } }
    abop({ axiom = "F", F = { { -1, "F" } } })
      successor 1 of F in abop is neither a string nor a weight with a string
      help: write { "F[+F]F", "F[-F]F" } or { { 2, "F" }, { 1, "FF" } }
    abop({ axiom = "F", angle = "wide" })
      turtle: angle must be a number, not "wide"
      help: angle takes a number, 90 unless given: Default angle of a turn (degrees)
    abop({ axiom = "F", ignore = 3 })
      ignore of abop is the number 3
      help: write ignore = "+-F"
    abop({ axiom = "F", object = turtle(), angle = 25 })
      abop has an object, so angle has no effect
      help: give it to the object: object = turtle({ angle = 25.7 })
    abop({ axiom = "F", F = "F?" }):derive(1)
      rule F: read as F ?: ? is no module
      help: the symbols of the turtle are F G f + - & ^ \ / | $ ! # { } . ; , ~ % _ @O @v [ ]; declare modules with letters, or write the successor as a body of Lua with return
    abop({ axiom = "Q" }):derive(1)
      read as Q: Q has no arguments, but it was declared as Q(n)
      help: write its arguments in brackets, such as Q(n)
    abop({ axiom = "F", ["F < "] = "F" }):derive(1)
      malformed pattern "F <": missing predecessor
      help: add the module to be rewritten
    "#);
}

#[test]
fn an_error_in_a_long_string_has_its_own_line() {
    let said = refused(
        "local s = lsystem()\ns:axiom(\"F\")\ns:rule(\"F\", [[\n  F[+F]\n  F(1, 2)\n]])\ns:derive(1)\n",
    );
    assert!(without_columns(&said).contains("s.lua:5: rule F: F has 0 to 1 parameters, not 2"), "{said}");
    let said =
        refused("local s = lsystem()\ns:axiom(\"F\")\ns:rule(\"F\", [[\n  F[+F]\n  F?\n]])\ns:derive(1)\n");
    assert!(
        without_columns(&said).contains("s.lua:5: rule F: read as F [ + F ] F ?: ? is no module"),
        "{said}"
    );
}

#[test]
fn a_failing_argument_of_a_string_names_the_module() {
    let said = refused(
        "local Q = module(\"Q\", \"n\")\nlocal s = lsystem()\ns:axiom(\"Q(1)\")\ns:rule(\"Q(n)\", \"Q(n.x)\")\ns:derive(1)\n",
    );
    assert!(
        without_columns(&said).contains("s.lua:4: rule Q(n): ") && said.contains("module: Q(1), step 1"),
        "{said}"
    );
}
