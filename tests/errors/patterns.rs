//! Patterns, arities and options of rules.

use insta::assert_snapshot;

use crate::support::{HEAD, refused, refused_rules, without_columns};

fn pattern(pattern: &str) -> String {
    refused_rules(&format!("s:rule(\"{pattern}\", function() return B() end)"))
}

#[test]
fn an_unknown_symbol_is_told_with_the_nearest_one() {
    assert_snapshot!(pattern("Aa(x)"), @r#"
    error: s.lua:3:9: unknown symbol Aa in the pattern "Aa(x)"
      | s:rule("Aa(x)", function() return B() end)
      |         ^^^^^
      help: did you mean A?
    "#);
    assert_snapshot!(pattern("B < A(x) > Window"), @r#"
    error: s.lua:3:9: unknown symbol Window in the pattern "B < A(x) > Window"
      | s:rule("B < A(x) > Window", function() return B() end)
      |         ^^^^^^^^^^^^^^^^^
      help: declare it: local Window = module("Window")
    "#);
    assert_snapshot!(refused_rules("s:ignore(\"Trun\")"), @r#"
    error: s.lua:3:1: unknown symbol Trun
      | s:ignore("Trun")
      | ^^^^^^^^^^^^^^^^
      help: did you mean Turn?
    "#);
}

#[test]
fn a_wrong_arity_is_told_with_the_declaration() {
    assert_snapshot!(pattern("A(x, y)"), @r#"
    error: s.lua:3:9: malformed pattern "A(x, y)": A has 1 parameter, not 2
      | s:rule("A(x, y)", function() return B() end)
      |         ^^^^^^^
      help: it was declared as A(x); write all parameters or no brackets
    "#);
    assert_snapshot!(pattern("A()"), @r#"
    error: s.lua:3:9: malformed pattern "A()": A has 1 parameter, not 0
      | s:rule("A()", function() return B() end)
      |         ^^^
      help: it was declared as A(x); write all parameters or no brackets
    "#);
    assert_snapshot!(pattern("B(x)"), @r#"
    error: s.lua:3:9: malformed pattern "B(x)": B has no parameters, not 1
      | s:rule("B(x)", function() return B() end)
      |         ^^^^
      help: it was declared as B; write all parameters or no brackets
    "#);
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", function(this, x) return A(1, 2) end)"), @r#"
    error: s.lua:3:41: rule A(x): A has 1 parameter, not 2
      | s:rule("A(x)", function(this, x) return A(1, 2) end)
      |                                         ^
      help: it was declared as A(x)
    "#);
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", function(this, x) return A() end)"), @r#"
    error: s.lua:3:41: rule A(x): A has 1 parameter, not 0
      | s:rule("A(x)", function(this, x) return A() end)
      |                                         ^
      help: it was declared as A(x)
    "#);
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", function(this, x) return A(nil) end)"), @r#"
    error: s.lua:3:41: rule A(x): A has 1 parameter; x is missing
      | s:rule("A(x)", function(this, x) return A(nil) end)
      |                                         ^
      module: A(1), step 1
      help: it was declared as A(x)
    "#);
    assert_snapshot!(refused_rules("s:axiom(A(1), B(2))"), @r"
    error: s.lua:3:15: B has no parameters, not 1
      | s:axiom(A(1), B(2))
      |               ^
      help: it was declared as B
    ");
}

#[test]
fn an_arity_that_only_running_shows_is_told_with_the_module_and_the_step() {
    assert_snapshot!(
        refused_rules("local function make(...) return A(...) end\ns:rule(\"A(x)\", function(this, x) return make(x, 2) end)"),
        @r"
    error: s.lua:3:33: rule A(x): A has 1 parameter, not 2
      | local function make(...) return A(...) end
      |                                 ^
      module: A(1), step 1
      help: it was declared as A(x)
    "
    );
    assert_snapshot!(
        refused_rules("local function make(...) return A(...) end\ns:rule(\"A(x)\", function(this, x) return make() end)"),
        @r"
    error: s.lua:3:33: rule A(x): A has 1 parameter; x is missing
      | local function make(...) return A(...) end
      |                                 ^
      module: A(1), step 1
      help: it was declared as A(x)
    "
    );
    assert_snapshot!(refused_rules("local make = A\nmake()"), @r"
    error: s.lua:4:1: A has 1 parameter; x is missing
      | make()
      | ^^^^^^
      help: it was declared as A(x)
    ");
}

#[test]
fn a_function_with_more_parameters_than_the_pattern_gives_is_refused() {
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", function(this, x, y) return B() end)"), @r#"
    error: s.lua:3:1: rule A(x): the successor has 3 parameters, but the pattern has 2
      | s:rule("A(x)", function(this, x, y) return B() end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: write function(this, x)
    "#);
    assert_snapshot!(refused_rules("s:rule(\"A\", { when = function(this, x) return true end }, function() return B() end)"), @r#"
    error: s.lua:3:1: rule A: the guard has 2 parameters, but the pattern has 1
      | s:rule("A", { when = function(this, x) return true end }, function() return B() end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: write function(this)
    "#);
    assert_snapshot!(refused_rules("s:interpret(\"B\", function(this, x) end)"), @r#"
    error: s.lua:3:1: rule B: the interpretation has 2 parameters, but the pattern has 1
      | s:interpret("B", function(this, x) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: write function(this)
    "#);
}

#[test]
fn a_malformed_pattern_shows_the_place() {
    assert_snapshot!(pattern("A((x)"), @r#"
    error: s.lua:3:11: malformed pattern: unexpected '(' at character 3
        A((x)
          ^
      | s:rule("A((x)", function() return B() end)
      |           ^
      help: expected a parameter's name or a value
    "#);
    assert_snapshot!(pattern("A(x) > B [ B"), @r#"
    error: s.lua:3:18: malformed pattern: unexpected '[' at character 10
        A(x) > B [ B
                 ^
      | s:rule("A(x) > B [ B", function() return B() end)
      |                  ^
      help: this branch is not closed
    "#);
    assert_snapshot!(pattern("A(x) > B > B"), @r#"
    error: s.lua:3:18: malformed pattern: unexpected '>' at character 10
        A(x) > B > B
                 ^
      | s:rule("A(x) > B > B", function() return B() end)
      |                  ^
      help: a pattern is: left context < predecessor > right context; contexts in the new chain stand outside of these: new left << left < predecessor > right >> new right
    "#);
    assert_snapshot!(pattern("A(x) > []"), @r#"
    error: s.lua:3:16: malformed pattern: unexpected '[' at character 8
        A(x) > []
               ^
      | s:rule("A(x) > []", function() return B() end)
      |                ^
      help: a branch in a context must contain at least one module
    "#);
    assert_snapshot!(pattern("A(x, x)"), @r#"
    error: s.lua:3:14: malformed pattern: unexpected 'x' at character 6
        A(x, x)
             ^
      | s:rule("A(x, x)", function() return B() end)
      |              ^
      help: duplicate parameter name x
    "#);
    assert_snapshot!(pattern("A(1x)"), @r#"
    error: s.lua:3:11: malformed pattern: unexpected '1' at character 3
        A(1x)
          ^
      | s:rule("A(1x)", function() return B() end)
      |           ^
      help: expected a number such as 2, -1.5 or 1e-3
    "#);
    assert_snapshot!(pattern("A('x)"), @r#"
    error: s.lua:3:11: malformed pattern: unexpected ''' at character 3
        A('x)
          ^
      | s:rule("A('x)", function() return B() end)
      |           ^
      help: this text is not closed
    "#);
    assert_snapshot!(pattern("B < A(x) é"), @r#"
    error: s.lua:3:18: malformed pattern: unexpected 'é' at character 10
        B < A(x) é
                 ^
      | s:rule("B < A(x) é", function() return B() end)
      |                  ^
      help: expected a module's name
    "#);
}

#[test]
fn a_pattern_has_predecessors_and_no_empty_context() {
    assert_snapshot!(pattern(""), @r#"
    error: s.lua:3:1: malformed pattern "": missing predecessor
      | s:rule("", function() return B() end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: add the module to be rewritten
    "#);
    assert_snapshot!(pattern("* B"), @r#"
    error: s.lua:3:9: malformed pattern "* B": the first module of a predecessor needs one symbol
      | s:rule("* B", function() return B() end)
      |         ^^^
      help: write one rule for each symbol; * and (A|B) can only follow it, or stand in contexts
    "#);
    assert_snapshot!(pattern("(A|B)"), @r#"
    error: s.lua:3:9: malformed pattern "(A|B)": the first module of a predecessor needs one symbol
      | s:rule("(A|B)", function() return B() end)
      |         ^^^^^
      help: write one rule for each symbol; * and (A|B) can only follow it, or stand in contexts
    "#);
    assert_snapshot!(pattern("A > (A|B)(x)"), @r#"
    error: s.lua:3:9: malformed pattern "A > (A|B)(x)": B has no parameters, not 1
      | s:rule("A > (A|B)(x)", function() return B() end)
      |         ^^^^^^^^^^^^
      help: it was declared as B; write all parameters or no brackets
    "#);
    assert_snapshot!(pattern("A > *(x)"), @r#"
    error: s.lua:3:14: malformed pattern: unexpected '(' at character 6
        A > *(x)
             ^
      | s:rule("A > *(x)", function() return B() end)
      |              ^
      help: * matches modules with any number of parameters, so it names none of them
    "#);
    assert_snapshot!(pattern("(A B) < A"), @r#"
    error: s.lua:3:12: malformed pattern: unexpected 'B' at character 4
        (A B) < A
           ^
      | s:rule("(A B) < A", function() return B() end)
      |            ^
      help: expected | or ), as in (A|B)
    "#);
    assert_snapshot!(pattern("< A(x)"), @r#"
    error: s.lua:3:9: malformed pattern "< A(x)": the context next to < is empty
      | s:rule("< A(x)", function() return B() end)
      |         ^^^^^^
      help: add a module, or remove the separator
    "#);
    assert_snapshot!(pattern("B <"), @r#"
    error: s.lua:3:9: malformed pattern "B <": missing predecessor
      | s:rule("B <", function() return B() end)
      |         ^^^
      help: add the module to be rewritten
    "#);
    assert_snapshot!(pattern("[B] < A(x)"), @r#"
    error: s.lua:3:9: malformed pattern "[B] < A(x)": a left context cannot have branches
      | s:rule("[B] < A(x)", function() return B() end)
      |         ^^^^^^^^^^
      help: it is the path towards the axiom; write only the modules on it
    "#);
    assert_snapshot!(pattern("[B]"), @r#"
    error: s.lua:3:9: malformed pattern "[B]": a predecessor cannot have branches
      | s:rule("[B]", function() return B() end)
      |         ^^^
      help: its modules stand next to one another; put branches into the right context: A > [B]
    "#);
}

#[test]
fn an_interpretation_of_several_modules_is_refused() {
    assert_snapshot!(refused_rules("s:interpret(\"A(x) B\", function(this, x) end)"), @r#"
    error: s.lua:3:1: rule A(x) B: an interpretation is of one module, but the pattern has several
      | s:interpret("A(x) B", function(this, x) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: interpret each module, and write the others as contexts: A < B > C
    "#);
}

#[test]
fn a_rule_is_declared_with_a_pattern_options_and_a_successor() {
    assert_snapshot!(refused_rules("s:rule(\"A(x)\")"), @r#"
    error: s.lua:3:3: rule A(x): rule takes 2 or 3 arguments, not 1
      | s:rule("A(x)")
      |   ^^^^
      help: write system:rule("A(x)", function(this, x) return ... end)
    "#);
    assert_snapshot!(refused_rules("s:rule(function() end)"), @r#"
    error: s.lua:3:3: the first argument of a rule must be a pattern
      | s:rule(function() end)
      |   ^^^^
      help: write system:rule("A(x)", function(this, x) return ... end)
    "#);
    let said = refused_rules("s:rule(\"A(x)\", 3)");
    assert!(
        without_columns(&said)
            .starts_with("error: s.lua:3: rule A(x): the successor must be a function or a string, not "),
        "{said}"
    );
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", 3, function() end)"), @r#"
    error: s.lua:3:3: rule A(x): the options of a rule must be a table
      | s:rule("A(x)", 3, function() end)
      |   ^^^^
      help: write { weight = 2 }
    "#);
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", { wieght = 3 }, function() end)"), @r#"
    error: s.lua:3:18: rule A(x): unknown option `wieght` of a rule
      | s:rule("A(x)", { wieght = 3 }, function() end)
      |                  ^^^^^^
      help: did you mean weight?
    "#);
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", { weight = -3 }, function() end)"), @r#"
    error: s.lua:3:18: rule A(x): weight must be a number of at least 0, not -3
      | s:rule("A(x)", { weight = -3 }, function() end)
      |                  ^^^^^^
      help: a rule with weight 0 is never chosen
    "#);
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", { when = true }, function() end)"), @r#"
    error: s.lua:3:18: rule A(x): when must be a function, not a boolean
      | s:rule("A(x)", { when = true }, function() end)
      |                  ^^^^
      help: write { when = function(this, x) return x > 0 end }
    "#);
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", function() end, function() end, 3)"), @r#"
    error: s.lua:3:3: rule A(x): rule takes 2 or 3 arguments, not 4
      | s:rule("A(x)", function() end, function() end, 3)
      |   ^^^^
      help: write system:rule("A(x)", function(this, x) return ... end)
    "#);
}

#[test]
fn a_module_has_one_interpretation_that_always_applies() {
    assert_snapshot!(refused_rules("s:interpret(\"A(x)\", function(this, x) end)\ns:interpret(\"A(y)\", function(this, y) end)"), @r#"
    error: s.lua:4:1: rule A(y): A(y) is already interpreted in line 3
      | s:interpret("A(y)", function(this, y) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: join the two functions, or declare an interpretation with contexts, a guard or a weight first
    "#);
    assert_snapshot!(refused_rules("s:interpret(\"A(x)\", 3)"), @r#"
    error: s.lua:3:1: rule A(x): an interpretation needs a function
      | s:interpret("A(x)", 3)
      | ^^^^^^^^^^^^^^^^^^^^^^
      help: write system:interpret("A(x)", function(this, x) ... end)
    "#);
}

#[test]
fn an_error_in_a_text_successor_names_its_line_wherever_the_text_begins() {
    let line = |rule: &str| {
        let said = refused_rules(rule);
        said.split(':').nth(2).unwrap().parse::<usize>().unwrap()
    };
    for wrong in ["return C(x)", "error('no')", "x.y = 1"] {
        assert_eq!(line(&format!("s:rule(\"A(x)\", [[ {wrong} ]])")), 3);
        assert_eq!(line(&format!("s:rule(\"A(x)\", [[\n  {wrong} ]])")), 4);
        assert_eq!(line(&format!("s:rule(\"A(x)\", [==[\n\n  {wrong} ]==])")), 5);
        assert_eq!(line(&format!("s:rule(\n  \"A(x)\",\n  {{ weight = 2 }},\n  [[\n  {wrong} ]]\n)")), 7);
        assert_eq!(line(&format!("s:rule(\"A(x)\", \"\\n{wrong}\")")), 4);
    }
}

#[test]
fn a_successor_given_as_text_tells_its_mistakes_with_its_rule() {
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", [[ return A(x ]])"), @r"
    error: s.lua:4:11: rule A(x): Expected ')' (to close '(' at line 3), got 'end'
      | s:derive(1)
      |           ^
    ");
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", [[ return A(y) ]])"), @r#"
    error: s.lua:3:1: rule A(x): unknown name y
      | s:rule("A(x)", [[ return A(y) ]])
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: declare it: local y = ...
    "#);
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", [[\n  if x > 0 then\n    return A(1, 2)\n  end ]])"), @r"
    error: s.lua:5:12: rule A(x): A has 1 parameter, not 2
      | return A(1, 2)
      |        ^
      help: it was declared as A(x)
    ");
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", [[ return x.y ]])"), @r#"
    error: s.lua:3:28: rule A(x): attempt to index number with 'y'
      | s:rule("A(x)", [[ return x.y ]])
      |                            ^
      module: A(1), step 1
    "#);
}

#[test]
fn a_module_is_declared_once_and_with_names() {
    assert_snapshot!(refused("local A = module(\"A\", \"x\")\nlocal B = module(\"A\", \"y\")\n"), @r#"
    error: s.lua:2:11: module A(x) is already declared
      | local B = module("A", "y")
      |           ^^^^^^
      help: declare it once, or rename the other module
    "#);
    assert_snapshot!(refused("local A = module(\"3A\")\n"), @r#"
    error: s.lua:1:19: invalid module name "3A"
      | local A = module("3A")
      |                   ^^
      help: a name is a letter followed by letters, digits and underscores
    "#);
    assert_snapshot!(refused("local A = module(\"A\", \"x\", \"x\")\n"), @r#"
    error: s.lua:1:11: module A has two parameters named `x`
      | local A = module("A", "x", "x")
      |           ^^^^^^
    "#);
    assert_snapshot!(refused("local A = module(\"A\", \"x?\", \"y\")\n"), @r#"
    error: s.lua:1:11: module A: y follows an optional parameter, so it must be optional too
      | local A = module("A", "x?", "y")
      |           ^^^^^^
      help: write "y?"
    "#);
    assert_snapshot!(refused("local A = module(\"A\", \"a b\")\n"), @r#"
    error: s.lua:1:24: invalid parameter name "a b" of A
      | local A = module("A", "a b")
      |                        ^^^
      help: a name is a letter followed by letters, digits and underscores
    "#);
}

#[test]
fn a_system_tells_what_it_takes() {
    assert_snapshot!(refused("local s = lsystem({ objekt = turtle() })\n"), @r"
    error: s.lua:1:21: unknown field `objekt` in lsystem
      | local s = lsystem({ objekt = turtle() })
      |                     ^^^^^^
      help: did you mean object?
    ");
    assert_snapshot!(refused("local s = lsystem({ object = 3 })\n"), @r"
    error: s.lua:1:11: lsystem: object must be an object, not a number
      | local s = lsystem({ object = 3 })
      |           ^^^^^^^
      help: write object = turtle()
    ");
    assert_snapshot!(refused("local s = lsystem({ interpret = \"first\" })\n"), @r#"
    error: s.lua:1:11: lsystem: interpret must be "last"
      | local s = lsystem({ interpret = "first" })
      |           ^^^^^^^
      help: omit it to interpret after every step
    "#);
    assert_snapshot!(refused("local s = lsystem({ seed = -1 })\n"), @r"
    error: s.lua:1:11: lsystem: seed must be an integer of at least 0
      | local s = lsystem({ seed = -1 })
      |           ^^^^^^^
    ");
    assert_snapshot!(refused_rules("s:derives()"), @r"
    error: s.lua:3:3: unknown method `derives` of a system
      | s:derives()
      |   ^^^^^^^
      help: did you mean derive?
    ");
    assert_snapshot!(refused("lsystem():derive(1)\n"), @r"
    error: s.lua:1:1: the system has no axiom
      | lsystem():derive(1)
      | ^^^^^^^^^^^^^^^^^^^
      help: write system:axiom(A(1))
    ");
    let said = refused_rules("s:axiom(3)");
    assert!(
        said.starts_with("error: s.lua:") && said.contains(": an axiom must contain only modules, but "),
        "{said}"
    );
    assert_snapshot!(refused_rules("print(s:derive(0).step)"), @r"
    error: s.lua:3:19: unknown field `step` of a derived system
      | print(s:derive(0).step)
      |                   ^^^^
      help: did you mean steps?
    ");
}

#[test]
fn derive_takes_a_whole_number_of_steps_from_0() {
    for steps in ["-1", "2.5", "0/0", "1/0", "true", "\"many\"", "{ steps = 1.5 }"] {
        let said = refused(&format!("{HEAD}s:derive({steps})\n"));
        assert!(
            without_columns(&said)
                .starts_with("error: s.lua:3: derive needs an integer number of steps of at least 0, not "),
            "{said}"
        );
    }
    assert_snapshot!(refused(&format!("{HEAD}s:derive(-1)\n")), @r"
    error: s.lua:3:3: derive needs an integer number of steps of at least 0, not -1
      | s:derive(-1)
      |   ^^^^^^
      help: omit it to derive until no rule applies
    ");
}
