//! Slips of people who know other languages: each message has the line and a remedy.

use crate::support::refused;

/// Script, line of the slip, and part of the remedy.
const SLIPS: [(&str, usize, &str); 92] = [
    ("local a = [1, 2]", 1, "with braces: { 1, 2 }"),
    ("local a = { [1, 2], [3, 4] }", 1, "with braces: { 1, 2 }"),
    ("local a = 2 ** 3", 1, "x ^ 2"),
    ("local a = 1\nif a != 2 then print(a) end", 2, "~="),
    ("local a = 1\nif a == 1 && a == 2 then end", 2, "write and"),
    ("local a = 1\nif a == 1 || a == 2 then end", 2, "write or"),
    ("local a = 1\nif !a then end", 2, "write not"),
    ("local n = 1\nn++", 2, "n += 1"),
    ("local n = 1\nn = n > 1 ? 2 : 3", 2, "if a then b else c"),
    ("local n <const> = 4", 1, "no attributes"),
    ("# a plant\nlocal n = 4", 1, "comments with --"),
    ("// a plant\nlocal n = 4", 1, "comments with --"),
    ("/* a plant */\nlocal n = 4", 1, "comments with --"),
    ("local n = 4 // a number of leaves", 1, "comments with --"),
    ("$fn = 20", 1, "names with letters"),
    ("def grow(n):\n  return n", 1, "local function name(x)"),
    ("import math\nlocal n = 4", 1, "require"),
    ("from math import sin", 1, "require"),
    ("class Tree:\n  pass", 1, "object(\"name\""),
    ("let n = 4", 1, "local x = 1"),
    ("var n = 4", 1, "local x = 1"),
    ("int n = 4", 1, "local x = 1"),
    ("local f = lambda x: x + 1", 1, "function(x) return x end"),
    ("local f = x => x + 1", 1, "function(x) return x end"),
    ("local t = new Turtle()", 1, "without new"),
    ("for i in range(5):\n  print(i)", 2, "for i = 1, 5 do"),
    ("for i = 1, 5 {\n  print(i)\n}", 1, "no braces"),
    ("for (int i = 0; i < 5; i++) {\n}", 1, ""),
    ("local n = 3\nif n > 2:\n  print(n)", 2, "without a colon"),
    ("local n = 3\nif n > 2 {\n  print(n)\n}", 2, "no braces"),
    ("local n = 3\nif n = 2 then print(n) end", 2, "=="),
    ("local n = 3\nif n > 2\n  print(n)\nend", 3, "write then"),
    ("local n = 3\nif n > 2 then print(1) elif n > 1 then print(2) end", 2, "elseif"),
    ("local f = function(x) { return x }", 1, "no braces"),
    ("local function f(x)\n  return x\n  print(x)\nend", 3, "return last"),
    ("local function f(x)\n  if x then\n    print(x)\nend\n", 4, "end for the if in line 2"),
    (
        "local s = lsystem({ object = turtle() })\ns:interpret(\"F\", function(this)\n  for i = 1, 2 do\n    this:forward(i)\nend)\ns:derive()",
        5,
        "end for the for in line 3",
    ),
    (
        "local s = lsystem()\ns:rule(\"F\", function(this)\n  return F(1), { Turn(30), F(1)\nend)",
        4,
        "write } for the {",
    ),
    ("local s = lsystem()\ns:derive", 2, "with parentheses"),
    ("local s = lsystem(object = turtle())", 1, "named values in a table"),
    ("local s = lsystem()\ns:rule(\"F\", function(this) return F(1), +(30), F(1) end)", 2, "by their names"),
    ("local a = module(“A”)", 1, "straight quotes"),
    ("local a = 4 − 1", 1, "minus of the keyboard"),
    ("local a = 1 << 2", 1, "bit32.lshift"),
    ("local a = \"text", 1, "close the string"),
    ("local a = None", 1, "write nil"),
    ("local a = True", 1, "write true"),
    ("local a = sqrt(2)", 1, "math.sqrt"),
    ("local a = sin(30)", 1, "math.rad"),
    ("local a = len({ 1 })", 1, "#list"),
    ("local a = str(3)", 1, "tostring"),
    ("local a = Vector3.new(1, 2, 3)", 1, "vec(x, y, z)"),
    ("local a = f\"n is {n}\"", 1, "backticks"),
    ("wait(1)", 1, "does not wait"),
    ("local s = lsystem({})\ns.derive()", 2, "with a colon: s:derive"),
    ("local s = lsystem({})\ns.axiom()", 2, "with a colon: s:axiom"),
    ("local s = lsystem(extruder())", 1, "lsystem({ object = extruder() })"),
    ("local n = param(\"height\", 3)", 1, "param(\"height\", { default = 3 })"),
    ("local s = cuboid(1, 1, 1) + cuboid(1, 1, 2)", 1, "a:union(b)"),
    (
        "local A = module(\"A\")\nlocal s, t = lsystem({ object = extruder() }), lsystem({ object = extruder() })\ns:axiom(A())\ns:interpret(\"A\", function(this)\n  this:place(t)\nend)\ns:derive()",
        5,
        "derive it",
    ),
    ("translate({ 0, 0, 1 })", 1, "in an interpretation"),
    ("local n = 3\nprint(\"n is \" + n)", 2, "two dots"),
    ("local n\nprint(n + 1)", 2, "one side is nil"),
    ("local t = {}\nprint(t.size.width)", 2, "was assigned"),
    ("local s = lsystem({ object = turtle(), axiom = 1 })", 1, "system:axiom"),
    (
        "local A = module(\"A\")\nlocal s = lsystem()\ns:axiom(A())\ns:rule(\"A\", function(this)\n  return A, A\nend)\ns:derive(1)",
        5,
        "call the constructor",
    ),
    (
        "local A = module(\"A\")\nlocal s = lsystem()\ns:axiom(A())\ns:rule(\"A\", function(this)\n  return \"F[+F]\"\nend)\ns:derive(1)",
        5,
        "in place of the function",
    ),
    (
        "local F = module(\"F\", \"n\")\nlocal f = function(n)\n  return F(n) F(n)\nend",
        3,
        "a comma between two values",
    ),
    ("local t = { a = 1 b = 2 }", 1, "a comma between two fields"),
    ("local n = 3\nif n > 2: print(n)\n", 2, "without a colon"),
    ("for i in list: print(i)\n", 1, "without a colon"),
    ("local s = lsystem({})\ns:rule(\"F -> FF\")", 2, "system:rule(\"F\", \"FF\")"),
    ("local s = lsystem({})\ns:rule(\"F = FF\")", 2, "system:rule(\"F\", \"FF\")"),
    ("local s = lsystem({})\ns:rule(\"F(n) : n > 1\", \"FF\")", 2, "{ when = function"),
    ("local s = lsystem({ object = turtle(), steps = 5 })", 1, "system:derive(5)"),
    ("local s = lsystem({ object = turtle(), angle = 25 })", 1, "turtle({ angle = 25 })"),
    ("local s = lsystem({ object = \"turtle\" })", 1, "write object = turtle()"),
    ("local s = lsystem({})\ns.axiom = { F(1) }", 2, "system:axiom("),
    ("local s = lsystem({})\ns:iterate(4)", 2, "system:derive(5)"),
    ("local s = lsystem({})\ns:export(\"tree.glb\")", 2, "burgeon run script.lua -o model.glb"),
    (
        "local s = lsystem({ object = turtle() })\ns:axiom(\"F\")\ns:derive():save(\"tree.glb\")",
        3,
        "burgeon run script.lua -o",
    ),
    ("local s = turtle()\ns:axiom(\"F\")", 2, "lsystem({ object = turtle() })"),
    ("save(\"tree.glb\")", 1, "burgeon run script.lua -o model.glb"),
    ("local a = cube(2)", 1, "cuboid(x, y, z)"),
    ("local t = {}\nt.push(3)", 2, "table.insert(list, value)"),
    ("local a = F(1) + F(2)", 1, "one after another"),
    (
        "local A = module(\"A\")\nlocal s = lsystem()\ns:axiom(A())\ns:rule(\"A\", function(this)\n  return A() + A()\nend)\ns:derive(1)",
        5,
        "one after another",
    ),
    (
        "local A = module(\"A\")\nlocal s = lsystem()\ns:axiom(A())\ns:rule(\"A\", function(this)\n  return A() .. A()\nend)\ns:derive(1)",
        5,
        "one after another",
    ),
    (
        "local A = module(\"A\", \"n\")\nlocal s = lsystem({ object = turtle() })\ns:axiom(A(3))\ns:rule(\"A(n)\", function(n) return F(n), A(n - 1) end)",
        4,
        "function(this, n",
    ),
    (
        "local A = module(\"A\")\nlocal s = lsystem({ object = turtle() })\ns:axiom(A())\ns:interpret(\"A\", function(this)\n  this.color = \"red\"\nend)\ns:derive()",
        5,
        "this:color(\"red\")",
    ),
    (
        "local A = module(\"A\", \"n\", \"m\")\nlocal s = lsystem({ object = turtle() })\ns:axiom(A(3, 1))\ns:rule(\"A(n, m)\", {\n  when = function(n, m) return n > 1 end,\n}, \"F\")",
        5,
        "function(this, n, m)",
    ),
    ("local m = material({ texture = \"brick.png\" })", 1, "this:material("),
];

#[test]
fn every_slip_gets_its_line_and_a_remedy() {
    let mut wrong = Vec::new();
    for (script, line, remedy) in SLIPS {
        let message = refused(script);
        let has_line = message.contains(&format!("s.lua:{line}:"));
        let help = message.split_once("help: ").map_or("", |(_, help)| help);
        if !has_line || help.is_empty() || !help.contains(remedy) {
            wrong.push(format!("{script}\n{message}\n"));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), SLIPS.len(), wrong.join("\n"));
}

#[test]
fn the_given_slips_have_a_place_and_nine_in_ten_a_remedy() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/slips");
    let Ok(files) = std::fs::read_dir(&folder) else {
        eprintln!("skipped: there is no ../shared/data/slips");
        return;
    };
    let (mut count, mut without) = (0, Vec::new());
    for file in files.flatten() {
        let text = std::fs::read_to_string(file.path()).unwrap();
        let output =
            crate::support::Folder::new().with("s.lua", &text).burgeon(&["run", "s.lua", "-o", "s.glb"]);
        let said = format!("{}{}", output.stdout, output.stderr);
        count += 1;
        let is_helpful =
            ["help: ", "such as", "with a colon", "for these"].iter().any(|words| said.contains(words));
        if !said.contains("s.lua:") || !is_helpful {
            without.push(format!("{:?}: {said}", file.file_name()));
        }
        assert!(!said.contains("Option<") && !said.contains("::"), "{said}");
    }
    assert!(
        without.len() * 10 <= count,
        "{} of {count} have no remedy:\n{}",
        without.len(),
        without.join("\n")
    );
}

#[test]
fn a_function_with_names_that_it_does_not_use_is_no_slip() {
    for (pattern, names) in
        [("A(_, n)", "_, _, n"), ("A(n, _)", "_, n"), ("A(_n, m)", "_n, _, m"), ("A", "n")]
    {
        let script = format!(
            "local A = module(\"A\", \"n\", \"m\")\nlocal s = lsystem({{ object = turtle() }})\ns:axiom(A(1, 2))\n\
             s:rule(\"{pattern}\", function({names}) return F(1) end)\ns:derive(1)"
        );
        let output = crate::support::Folder::new()
            .with("s.lua", &script)
            .burgeon(&["run", "s.lua", "--strict", "-o", "s.glb"]);
        assert_eq!(output.status, 0, "{script}\n{}", output.stderr);
    }
}
