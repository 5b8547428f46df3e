//! Columns and carets: each message about a script has its column, and a caret stands below the part that is wrong.

use insta::assert_snapshot;

use crate::support::{Folder, HEAD, printed, refused, refused_rules};

/// Returns line and column of the first message, and the text above its carets.
fn marked_columns(text: &str) -> (usize, usize, String) {
    let lines: Vec<&str> = text.lines().collect();
    let carets = lines.iter().position(|line| line.starts_with("  | ") && line.trim_end().ends_with('^'));
    let carets = carets.unwrap_or_else(|| panic!("no carets in: {text}"));
    let (begin, end) = (lines[carets].find('^').unwrap(), lines[carets].len());
    let part = lines[carets - 1].chars().skip(begin).take(end - begin).collect();
    let numbers: Vec<usize> =
        lines[0].split(':').filter_map(|part| part.trim().parse().ok()).take(2).collect();
    (numbers[0], numbers[1], part)
}

#[test]
fn carets_stand_below_the_part_that_is_wrong() {
    for (script, line, column, part) in [
        ("local a = 1\nprint(  flors)", 2, 9, "flors"),
        ("local t = turtle({ wdth = 3 })", 1, 20, "wdth"),
        ("local t = turtle({ width = \"a\" })", 1, 29, "a"),
        ("local t = {}\n  print(t.size.width)", 2, 16, "width"),
        ("local n\nprint(3 + n)", 2, 9, "+"),
        ("local f = nil\nlocal x = f(1)", 2, 11, "f"),
        ("if a != 2 then end", 1, 6, "!="),
        ("local a = 'é' .. nil", 1, 15, ".."),
        ("local c = rgb(\"#12\")", 1, 16, "#12"),
        ("  error('no way')", 1, 3, "error('no way')"),
        ("local x = 3\n\treturn\tx.y.z", 2, 11, "y"),
    ] {
        let text = refused(script);
        let found = marked_columns(&text);
        assert_eq!((found.0, found.1, found.2.as_str()), (line, column, part), "{script}\n{text}");
    }
}

#[test]
fn errors_of_rules_have_their_column_too() {
    assert_snapshot!(refused_rules("s:interpret(\"A(x)\", function(this, x)\n    this:forward(1, 2)\nend)"), @r"
    error: s.lua:4:10: rule A(x) (interpretation): turtle:forward takes 1 argument
      | this:forward(1, 2)
      |      ^^^^^^^
      module: A(1), step 0
      help: write this:forward(length: number? = turtle.step)
    ");
    assert_snapshot!(refused_rules("s:interpret(\"A(x)\", function(this, x) this.forward(1) end)"), @r#"
    error: s.lua:3:44: rule A(x) (interpretation): turtle:forward is a method, and must be called on this
      | s:interpret("A(x)", function(this, x) this.forward(1) end)
      |                                            ^^^^^^^
      module: A(1), step 0
      help: write a colon: this:forward(...)
    "#);
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", function(this, x) return A(x, 2) end)"), @r#"
    error: s.lua:3:41: rule A(x): A has 1 parameter, not 2
      | s:rule("A(x)", function(this, x) return A(x, 2) end)
      |                                         ^
      help: it was declared as A(x)
    "#);
}

#[test]
fn json_has_the_column_and_the_severity() {
    let folder = Folder::new().with("s.lua", format!("{HEAD}  print(flors)\ns:derive(0)\n"));
    let document = folder.burgeon(&["run", "s.lua", "--json"]).json();
    let error = &document["errors"][0];
    let parts = ["line", "column", "end_column", "severity"].map(|name| error[name].to_string());
    assert_eq!(parts, ["3", "9", "14", "\"error\""]);
    let folder = Folder::new().with("s.lua", format!("{HEAD}print(math.sin(90))\ns:derive(0)\n"));
    let document = folder.burgeon(&["check", "s.lua", "--json"]).done().json();
    let warnings = document["warnings"].as_array().unwrap();
    let doubtful = warnings.iter().find(|warning| warning["kind"] == "doubtful").unwrap();
    let parts = ["line", "column", "end_column", "severity"].map(|name| doubtful[name].to_string());
    assert_eq!(parts, ["3", "16", "18", "\"warning\""]);
}

#[test]
fn angles_of_the_wrong_unit_are_warned_about() {
    let folder = Folder::new().with(
        "s.lua",
        "local A = module(\"A\")\nlocal s = lsystem({ object = turtle() }) s:axiom(A())\ns:rule(\"A\", function() return Turn(math.rad(90)), F(math.sin(90)) end)\ns:derive(1)",
    );
    assert_snapshot!(folder.warned(&["run", "s.lua"]), @r#"
    warning: s.lua:3:36: Turn takes degrees, and math.rad returns radians
      | s:rule("A", function() return Turn(math.rad(90)), F(math.sin(90)) end)
      |                                    ^^^^^^^^^^^^
      help: angles of scripts are degrees: write Turn(90)
    warning: s.lua:3:62: math.sin takes radians, and 90 is more than a full turn of them
      | s:rule("A", function() return Turn(math.rad(90)), F(math.sin(90)) end)
      |                                                              ^^
      help: angles of scripts are degrees, and math.sin takes radians: write math.sin(math.rad(90))
    "#);
}

#[test]
fn a_check_finds_a_forgotten_return_and_a_dot_in_place_of_a_colon() {
    let script = |rules: &str| Folder::new().with("s.lua", format!("{HEAD}{rules}\ns:derive(1)\n"));
    let folder = script("s:rule(\"A(x)\", function(this, x)\n  if x > 1 then return B() end\n  B()\nend)");
    let text = folder.burgeon(&["check", "s.lua", "--quick"]).done().stderr;
    assert!(
        text.contains("s.lua:5:3: rule A(x): the function of the rule ends here without return"),
        "{text}"
    );
    let folder = script("s:interpret(\"A(x)\", function(this, x)\n  if x > 5 then this.forward(1) end\nend)");
    let text = folder.refuses(&["check", "s.lua"]);
    assert!(text.contains("s.lua:4:22: ") && text.contains("write a colon: this:forward(...)"), "{text}");
    let folder = script("if false then s.rule(\"A\", \"B\") end");
    let text = folder.refuses(&["check", "s.lua"]);
    assert!(text.contains("s.lua:3:17: ") && text.contains("write a colon: s:rule(...)"), "{text}");
}

#[test]
fn a_wrong_argument_or_field_has_the_declaration_as_its_remedy() {
    for (script, remedy) in [
        (
            "s:interpret(\"A(x)\", function(this, x) this:forward(1, 2) end)",
            "write this:forward(length: number?",
        ),
        ("local t = turtle({ color = \"redd\" })", "color = \"#ff8000\""),
        ("local t = turtle({ sides = \"a\" })", "sides takes a number"),
    ] {
        let text = refused_rules(script);
        assert!(text.contains(&format!("help: {remedy}")) || text.contains(remedy), "{script}\n{text}");
    }
}

#[test]
fn no_message_speaks_of_types_of_the_program() {
    for script in [
        "print(vec(\"a\"))",
        "turtle(3)",
        "lsystem(3)",
        "module(3)",
        "module(nil)",
        "param(3)",
        "param(\"a\", 3)",
        "source(nil)",
        "rgb({})",
        "noise(\"a\")",
        "random({}, 2)",
        "lsystem({ object = turtle(), seed = {} })",
        "local s = lsystem() s:rule(3, 4)",
        "local s = lsystem() s:derive({})",
        "turtle():forward({})",
        "footprint({ geometry = 3 })",
        "extruder({ sides = {} })",
        "string.rep()",
        "table.concat(3)",
        "math.floor({})",
        "tonumber()",
        "select(0)",
        "require(3)",
    ] {
        let text = refused(script);
        let words = [
            "f64", "i64", "u32", "usize", "Option<", "Vec<", "String", "HashMap", "UserData", "mlua",
            "serde", "&str",
        ];
        for word in words {
            assert!(!text.contains(word), "{word} in the message of {script}: {text}");
        }
        assert!(text.starts_with("error: s.lua:1:"), "{script}: {text}");
    }
}

#[test]
fn print_shows_tables_modules_and_objects() {
    let lines = printed(
        "local A = module(\"A\", \"x\", \"y?\")\nprint({ 1, { 2, \"b\" }, name = \"c\\\"d\", [\"e f\"] = true, [10] = 3 })\nprint({}, A, A(3), vec(1, 2, 3), print, nil)\nprint({ A(1), A }, turtle(), lsystem())\nlocal t = {} t.t = t print(t)\nprint(\"a\\27[2J\\255\", { \"\\255\\0\" })",
    );
    assert_snapshot!(lines.join("\n"), @r#"
    { 1, { 2, "b" }, ["e f"] = true, [10] = 3, name = "c\"d" }
    {}	module A(x, y?)	A(3)	vec(1, 2, 3)	function	nil
    { A(1), module A(x, y?) }	turtle	a system
    { t = { ... } }
    a\u{1b}[2J\xff	{ "\\xff\u{0}" }
    "#);
}

#[test]
fn print_of_a_large_table_is_short() {
    let lines = printed(
        "local t = {} for i = 1, 100000 do t[i] = i end print(t)\nlocal d = {} for i = 1, 100 do d = { d } end print(d)\nlocal w = {} for i = 1, 300 do w[\"k\" .. i] = string.rep(\"x\", 1000) end print(w)",
    );
    assert!(lines[0].ends_with("200, and 99800 more }") && lines[0].len() < 2000, "{}", lines[0]);
    assert!(lines[1].contains("{ ... }") && lines[1].len() < 100, "{}", lines[1]);
    assert!(lines[2].len() < 30_000 && lines[2].contains(" more }"), "{}", lines[2].len());
}

#[test]
fn literals_that_contradict_declared_types_are_found_by_a_check() {
    for (script, column, part) in [
        ("local x: number = \"a\"\nlocal y = x", 19, "x must be a number, not \"a\""),
        (
            "local function f(a: number, b: string?) return a, b end\nlocal both = { f(1), f(\"2\") }",
            24,
            "f: a must be a number",
        ),
        ("local x: { number } = 3\nlocal y = x", 23, "x must be a table"),
    ] {
        let text = Folder::new().with("s.lua", script).refuses(&["check", "s.lua"]);
        assert!(text.contains(&format!(":{column}: ")) && text.contains(part), "{script}: {text}");
    }
    let script = "type Color = number\nlocal a: Color = 3\nlocal b: number? = nil\nlocal function f<T>(x: T, y: \"a\" | \"b\") return x end\nprint(a, b, f(1, \"a\"), f(nil, \"b\"))";
    Folder::new().with("s.lua", script).burgeon(&["check", "s.lua"]).done();
}

#[test]
fn a_missing_texture_has_its_line_and_the_nearest_file() {
    let script = "local A = module(\"A\")\nlocal s = lsystem({ object = extruder() }) s:axiom(A())\ns:interpret(\"A\", function(this)\n  this:material({ texture = \"brik.png\" }):extrude(1)\nend)\ns:derive(0)\n";
    let folder = Folder::new().with("s.lua", script).with("brick.png", "");
    assert_snapshot!(folder.refuses(&["check", "s.lua"]), @r#"
    error: s.lua:4:30: texture not found: "brik.png"
      | this:material({ texture = "brik.png" }):extrude(1)
      |                            ^^^^^^^^
      help: textures are files next to the script: put the file there, or change its name in the script
    "#);
}

#[test]
fn a_dirt_map_without_its_file_its_set_or_a_shape_is_reported_with_its_line() {
    let tried = |fields: &str, draw: &str| {
        let script = format!(
            "local A = module(\"A\")\nlocal s = lsystem({{ object = extruder() }}) s:axiom(A())\ns:interpret(\"A\", function(this)\n  local wall = rectangle(4, 3)\n  local grime = {{ {fields} }}\n  {draw}\nend)\ns:derive(0)\n"
        );
        let folder = Folder::new().with("s.lua", &script).with("stain.png", "x");
        folder.burgeon(&["check", "s.lua"]).stderr
    };
    let own = "dirt = \"stain.png\", dirt_set = \"grime\"";
    assert_snapshot!(tried(own, "this:shape(wall:material(grime))"), @r#"
    warning: s.lua:6:28: rule A (interpretation): a face has no set "grime", which the dirt map of its material uses
      | this:shape(wall:material(grime))
      |                          ^^^^^
      module: A, step 0
      help: give its shape the set: shape:project(8, 4, { set = "grime" }), or omit dirt_set
    s.lua has 1 warning
    "#);
    assert_snapshot!(tried(own, "this:material(grime):shape(wall:project(2, 2, { set = \"soot\" }))"), @r#"
    warning: s.lua:6:17: rule A (interpretation): a face has no set "grime", which the dirt map of its material uses
      | this:material(grime):shape(wall:project(2, 2, { set = "soot" }))
      |               ^^^^^
      module: A, step 0
      help: give its shape the set: shape:project(8, 4, { set = "grime" }), or omit dirt_set
    s.lua has 1 warning
    "#);
    assert_snapshot!(tried(own, "this:material(grime):extrude(2)"), @r#"
    warning: s.lua:5:9: the dirt map of a material uses the set "grime", which surfaces that are no shapes lack
      | local grime = { dirt = "stain.png", dirt_set = "grime" }
      |       ^^^^^
      help: only shapes have sets, from shape:project: omit dirt_set, so that the image lies as the texture does
    s.lua has 1 warning
    "#);
    let set = tried(own, "this:shape(wall:material(grime):project(2, 2, { set = \"grime\" }))");
    assert!(!set.contains("warning"), "{set}");
    assert_snapshot!(tried("dirt = \"stein.png\"", "this:material(grime):extrude(2)"), @r#"
    error: s.lua:5:27: dirt map not found: "stein.png"
      | local grime = { dirt = "stein.png" }
      |                         ^^^^^^^^^
      help: dirt maps are files next to the script: put the file there, or change its name in the script
    "#);
    assert_snapshot!(tried("dirt_set = \"grime\"", "this:material(grime):extrude(2)"), @r"
    error: s.lua:6:8: rule A (interpretation): material: dirt_set has no effect without a dirt map
      | this:material(grime):extrude(2)
      |      ^^^^^^^^
      module: A, step 0
      help: give the image file of the dirt map in dirt
    ");
    assert_snapshot!(tried("dirt = \"stain.png\", dirt_size = { 2 }", "this:material(grime):extrude(2)"), @r"
    error: s.lua:6:8: rule A (interpretation): material: dirt_size must be { width, height } in metres, above 0
      | this:material(grime):extrude(2)
      |      ^^^^^^^^
      module: A, step 0
    ");
    assert_snapshot!(tried(own, "this:shape(wall:project(2, 2, { set = \"\" }))"), @r#"
    error: s.lua:6:19: rule A (interpretation): shape:project: the name of the set is empty
      | this:shape(wall:project(2, 2, { set = "" }))
      |                 ^^^^^^^
      module: A, step 0
      help: give a name, such as "dirt", or omit set to place the texture
    "#);
}

#[test]
fn a_missing_normal_map_has_its_line_and_an_impossible_one_its_reason() {
    let tried = |fields: &str| {
        let script = format!(
            "local A = module(\"A\")\nlocal s = lsystem({{ object = extruder() }}) s:axiom(A())\ns:interpret(\"A\", function(this)\n  this:material({{ {fields} }}):extrude(1)\nend)\ns:derive(0)\n"
        );
        Folder::new().with("s.lua", &script).with("waves.png", "x").refuses(&["check", "s.lua"])
    };
    assert_snapshot!(tried("normal = \"wavs.png\""), @r#"
    error: s.lua:4:29: normal map not found: "wavs.png"
      | this:material({ normal = "wavs.png" }):extrude(1)
      |                           ^^^^^^^^
      help: normal maps are files next to the script: put the file there, or change its name in the script
    "#);
    assert_snapshot!(tried("normal = \"waves.png\", texture_size = { 0, 1 }"), @r#"
    error: s.lua:4:8: rule A (interpretation): material: texture_size must be { width, height } in metres, above 0
      | this:material({ normal = "waves.png", texture_size = { 0, 1 } }):extrude(1)
      |      ^^^^^^^^
      module: A, step 0
    "#);
    assert_snapshot!(tried("normal = \"waves.png\", normal_scale = 11"), @r#"
    error: s.lua:4:8: rule A (interpretation): material: normal_scale must be from 0 to 10, not 11
      | this:material({ normal = "waves.png", normal_scale = 11 }):extrude(1)
      |      ^^^^^^^^
      module: A, step 0
    "#);
    assert_snapshot!(tried("normal_scale = 2"), @r#"
    error: s.lua:4:8: rule A (interpretation): material: normal_scale has no effect without a normal map
      | this:material({ normal_scale = 2 }):extrude(1)
      |      ^^^^^^^^
      module: A, step 0
      help: give the image file of the normal map in normal
    "#);
    assert_snapshot!(tried("normals = \"waves.png\""), @r#"
    error: s.lua:4:19: rule A (interpretation): unknown field `normals` in extruder:material
      | this:material({ normals = "waves.png" }):extrude(1)
      |                 ^^^^^^^
      help: did you mean normal?
    "#);
}
