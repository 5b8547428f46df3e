//! Errors that static analysis finds without running the script.

use insta::assert_snapshot;

use crate::support::{Folder, HEAD, refused, refused_rules, without_columns};

#[test]
fn a_syntax_error_names_its_line() {
    assert_snapshot!(refused("local a = 1\nlocal x = = 3\n"), @r"
    error: s.lua:2:1: Expected identifier when parsing expression, got '='
      | local x = = 3
      | ^^^^^^^^^^^^^
      help: complete the code before '=', or remove '='
    ");
    assert_snapshot!(refused("local function f("), @r"
    error: s.lua:1:1: Expected identifier when parsing variable name, got <eof>
      | local function f(
      | ^^^^^^^^^^^^^^^^^
      help: the script ends too early: complete its last statement
    ");
    assert_snapshot!(refused("local text = \"never ends\n"), @r#"
    error: s.lua:1:1: Malformed string; did you forget to finish it?
      | local text = "never ends
      | ^^^^^^^^^^^^^^^^^^^^^^^^
      help: close the string in its line, or write it with [[ and ]] or as several joined by ..
    "#);
}

#[test]
fn an_unknown_name_is_told_with_the_nearest_one() {
    assert_snapshot!(refused("local floors = 3\nprint(flors)\n"), @r"
    error: s.lua:2:7: unknown name flors
      | print(flors)
      |       ^^^^^
      help: did you mean floors?
    ");
    assert_snapshot!(refused("local s = lsytem()\n"), @r"
    error: s.lua:1:11: unknown name lsytem
      | local s = lsytem()
      |           ^^^^^^
      help: did you mean lsystem?
    ");
    assert_snapshot!(refused("print(window)\n"), @r"
    error: s.lua:1:7: unknown name window
      | print(window)
      |       ^^^^^^
      help: declare it: local window = ...
    ");
    assert_snapshot!(refused_rules(r#"s:rule("A(x)", function(this, x) return Bud() end)"#), @r#"
    error: s.lua:3:41: rule A(x): unknown name Bud
      | s:rule("A(x)", function(this, x) return Bud() end)
      |                                         ^^^
      help: declare it as a module: local Bud = module("Bud")
    "#);
}

#[test]
fn several_problems_are_told_at_once_in_the_order_of_their_lines() {
    assert_snapshot!(
        refused_rules(
            r#"
s:rule("A(x)", function(this, x) return A(1, 2), Bogus() end)
s:interpret("B", function(this) count = 1 end)
local unused = flors
print(nothing)"#,
        ),
        @r#"
    error: s.lua:4:41: rule A(x): A has 1 parameter, not 2
      | s:rule("A(x)", function(this, x) return A(1, 2), Bogus() end)
      |                                         ^
      help: it was declared as A(x)
    error: s.lua:4:50: rule A(x): unknown name Bogus
      | s:rule("A(x)", function(this, x) return A(1, 2), Bogus() end)
      |                                                  ^^^^^
      help: declare it as a module: local Bogus = module("Bogus")
    error: s.lua:5:33: rule B (interpretation): cannot assign count: it is not a local variable
      | s:interpret("B", function(this) count = 1 end)
      |                                 ^^^^^
      help: a rule can assign only its own locals; declare it inside: local ..., or use an interpretation rule to change the object
    error: s.lua:6:16: unknown name flors
      | local unused = flors
      |                ^^^^^
      help: declare it: local flors = ...
    error: s.lua:7:7: unknown name nothing
      | print(nothing)
      |       ^^^^^^^
      help: declare it: local nothing = ...
    "#
    );
}

#[test]
fn check_tells_the_problems_of_the_patterns_and_of_required_files_too() {
    let script = format!(
        r#"{HEAD}local lib = pcall(require, "lib/parts")
s:rule("Aa(x)", function(this, x) return B() end)
s:rule("A(x, y)", function(this, x) return B() end)
s:interpret("B", function(this) return unknown end)
s:rule("A(x)", function(this, x, y) return B() end)
s:rule("A(x)", {{ wen = 3 }}, function(this, x) return A(1) end)
s:derive(1)
"#
    );
    let folder = Folder::new()
        .with("s.lua", script)
        .with("lib/parts.lua", "local a = 1\nlocal c = aa + bb\nreturn {}\n");
    assert_snapshot!(folder.refuses(&["check", "s.lua"]), @r#"
    error: lib/parts.lua:2:11: unknown name aa
      | local c = aa + bb
      |           ^^
      help: did you mean a?
    error: lib/parts.lua:2:16: unknown name bb
      | local c = aa + bb
      |                ^^
      help: declare it: local bb = ...
    error: s.lua:4:9: unknown symbol Aa in the pattern "Aa(x)"
      | s:rule("Aa(x)", function(this, x) return B() end)
      |         ^^^^^
      help: did you mean A?
    error: s.lua:5:9: malformed pattern "A(x, y)": A has 1 parameter, not 2
      | s:rule("A(x, y)", function(this, x) return B() end)
      |         ^^^^^^^
      help: it was declared as A(x); write all parameters or no brackets
    error: s.lua:6:40: rule B (interpretation): unknown name unknown
      | s:interpret("B", function(this) return unknown end)
      |                                        ^^^^^^^
      help: declare it: local unknown = ...
    error: s.lua:7:1: rule A(x): the successor has 3 parameters, but the pattern has 2
      | s:rule("A(x)", function(this, x, y) return B() end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: write function(this, x)
    error: s.lua:8:18: rule A(x): unknown option `wen` of a rule
      | s:rule("A(x)", { wen = 3 }, function(this, x) return A(1) end)
      |                  ^^^
      help: did you mean when?
    "#);
}

#[test]
fn names_of_lua_that_scripts_do_not_have_come_with_a_remedy() {
    assert_snapshot!(refused("print(os.time())\nlocal x = math.random(6)\nloadstring(\"x = 1\")()\n_G.x = 1\n"), @r#"
    error: s.lua:1:7: unknown name os
      | print(os.time())
      |       ^^
      help: scripts cannot use files, the clock or programs; load other scripts of the folder with require
    error: s.lua:2:11: unknown name math.random
      | local x = math.random(6)
      |           ^^^^
      help: write random() or random(low, high), which depend on the seed and the module
    error: s.lua:3:1: unknown name loadstring
      | loadstring("x = 1")()
      | ^^^^^^^^^^
      help: scripts cannot compile text; a successor can be a string
    error: s.lua:4:1: unknown name _G
      | _G.x = 1
      | ^^
      help: globals cannot be changed; pass values as parameters or with require
    "#);
}

#[test]
fn names_of_the_engine_cannot_be_used_or_declared() {
    let names = [
        "__open",
        "__close",
        "__list",
        "__done",
        "__erased",
        "__guard",
        "__epoch",
        "__prepared",
        "__class",
        "__interpretation",
        "__cut",
        "__put_1",
    ];
    let said = refused(&names.map(|name| format!("{name}(1)\n")).concat());
    for (line, name) in (1..).zip(names) {
        assert!(
            without_columns(&said).contains(&format!("error: s.lua:{line}: unknown name {name}\n")),
            "{said}"
        );
    }
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", function(this, x) local __done = nil return A(x) end)"), @r#"
    error: s.lua:3:40: rule A(x): a variable cannot be named __done
      | s:rule("A(x)", function(this, x) local __done = nil return A(x) end)
      |                                        ^^^^^^
      help: names that begin with two underscores are reserved
    "#);
    assert_snapshot!(refused("local function __guard() end\n"), @r"
    error: s.lua:1:16: a variable cannot be named __guard
      | local function __guard() end
      |                ^^^^^^^
      help: names that begin with two underscores are reserved
    ");
}

#[test]
fn what_burgeon_gives_cannot_be_assigned() {
    assert_snapshot!(refused("random = function() return 4 end\n"), @r"
    error: s.lua:1:1: cannot assign random: it is built in
      | random = function() return 4 end
      | ^^^^^^
      help: choose another name: local ...
    ");
    assert_snapshot!(refused("Turn = nil\n"), @r"
    error: s.lua:1:1: cannot assign Turn: it is built in
      | Turn = nil
      | ^^^^
      help: choose another name: local ...
    ");
    assert_snapshot!(refused("local a = 1\nb = a\n"), @r"
    error: s.lua:2:1: cannot assign b: it is not a local variable
      | b = a
      | ^
      help: scripts cannot define globals; write local b = ...
    ");
}

#[test]
fn syntax_that_only_luau_knows_does_not_switch_the_checks_off() {
    assert_snapshot!(
        refused_rules("@[native] local function f() end\nlocal n = 0\ns:rule(\"A(x)\", function(this, x) n += 1 return A(n) end)"),
        @r"
    error: s.lua:3:1: Burgeon does not support this Luau syntax
      | @[native] local function f() end
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: write it differently; attributes in brackets, such as @[native], are not needed
    "
    );
}

#[test]
fn nesting_without_end_is_refused() {
    for (open, close) in
        [("(", ")"), ("{", "}"), ("not ", ""), ("1 .. ", ""), ("1 + ", ""), ("- ", ""), ("f(", ")")]
    {
        let said = refused(&format!(
            "local f = tostring\nlocal x = {}1{}\n",
            open.repeat(20_000),
            close.repeat(20_000)
        ));
        assert!(without_columns(&said).starts_with("error: s.lua:2: "), "{}", &said[..said.len().min(200)]);
        assert!(said.len() < 500, "{open}: {}", said.len());
    }
    let said = refused(&format!("{}{}", "do ".repeat(20_000), "end ".repeat(20_000)));
    assert!(without_columns(&said).starts_with("error: s.lua:1: "), "{}", &said[..said.len().min(200)]);
}

#[test]
fn the_line_is_right_in_files_of_windows() {
    assert_snapshot!(refused("local a = 1\r\nlocal b = 2\r\nprint(c)\r\n"), @r"
    error: s.lua:3:7: unknown name c
      | print(c)
      |       ^
      help: declare it: local c = ...
    ");
}
