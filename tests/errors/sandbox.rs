//! Sandbox for untrusted scripts.

use crate::support::{Folder, HEAD, assert_decent, chain, printed, refused, refused_rules, without_columns};

#[test]
fn the_system_is_out_of_reach_by_name() {
    let names = [
        "os",
        "io",
        "loadstring",
        "load",
        "dofile",
        "loadfile",
        "getfenv",
        "setfenv",
        "debug",
        "_G",
        "newproxy",
        "collectgarbage",
        "gcinfo",
        "package",
        "shared",
        "vector",
        "_ENV",
        "arg",
        "ffi",
        "math.random",
        "math.randomseed",
    ];
    let said = refused(&names.map(|name| format!("print({name})\n")).concat());
    for (line, name) in (1..).zip(names) {
        assert!(
            without_columns(&said).contains(&format!("error: s.lua:{line}: unknown name {name}\n")),
            "{said}"
        );
    }
}

#[test]
fn the_system_is_out_of_reach_by_detours() {
    let lines = printed(
        r#"
local function tell(name, value) print(name, if value == nil then "nil" else type(value)) end
local strings: any = getmetatable("").__index
tell("string.dump", strings.dump)
for _, library in { math, string, table, coroutine, bit32, utf8, buffer } :: { any } do
  for name, value in library do
    if name == "random" or name == "randomseed" or name == "dump" or name == "clock" then tell("found", value) end
  end
end
local m: any, c: any = math, coroutine
tell("random", m.random)
tell("rand" .. "om", m["rand" .. "om"])
tell("running", c.running and 1)
tell("metatable of turtle", getmetatable(turtle()) or nil)
tell("metatable of a system", getmetatable(lsystem()) or nil)
tell("metatable of print", getmetatable(print :: any))
tell("metatable of a number", getmetatable(1 :: any))
tell("rawget", rawget(m, "random"))
local t = setmetatable({}, { __gc = function() error("collected") end })
t = nil :: any
for i = 1, 100000 do local garbage = { i } end
"#,
    );
    assert_eq!(
        lines,
        [
            "string.dump\tnil",
            "random\tnil",
            "random\tnil",
            "running\tnumber",
            "metatable of turtle\tnil",
            "metatable of a system\tnil",
            "metatable of print\tnil",
            "metatable of a number\tnil",
            "rawget\tnil",
        ]
    );
}

#[test]
fn nothing_that_scripts_share_can_be_written() {
    let targets = [
        "math",
        "string",
        "table",
        "coroutine",
        "bit32",
        "utf8",
        "buffer",
        "getmetatable(\"\")",
        "getmetatable(vec(1, 2, 3))",
    ];
    let writes = [
        "t.sneaked = 1",
        "rawset(t, \"sneaked\", 1)",
        "setmetatable(t, {})",
        "t.__index = {}",
        "table.insert(t, 1)",
        "table.clear(t)",
    ];
    let tries: String = targets
        .iter()
        .flat_map(|target| {
            writes.iter().map(move |write| {
                format!("print((pcall(function()\n  local t: any = {target}\n  {write}\nend)), [[{target}: {write}]])\n")
            })
        })
        .collect();
    let lines = printed(&tries);
    assert_eq!(lines.len(), targets.len() * writes.len());
    for line in lines {
        assert!(line.starts_with("false\t"), "{line}");
    }
    let lines = printed(
        "print((pcall(function() local t: any = turtle() t.x = 1 end)))\nprint((pcall(function() local t: any = lsystem() t.rule = 1 end)))",
    );
    assert_eq!(lines, ["false", "false"]);
}

#[test]
fn a_rule_leaves_no_trace_for_another_in_what_the_language_shares() {
    for write in [
        "string.trace = x",
        "getmetatable(\"\").__index.trace = x",
        "rawset(math, \"trace\", x)",
        "getmetatable(\"\").__add = function() return x end",
        "getmetatable(this).trace = x",
        "rawset(this, \"trace\", x)",
        "setmetatable(this, { trace = x })",
        "table.insert(this, x)",
        "getmetatable(A(1)).trace = x",
        "getmetatable(vec(1, 2, 3)).trace = x",
    ] {
        let said = refused_rules(&format!(
            "s:rule(\"A(x)\", function(this: any, x)\n  {write}\n  return A(x)\nend)"
        ));
        assert!(
            without_columns(&said).starts_with("error: s.lua:4: rule A(x): ")
                && said.contains("module: A(1), step 1\n"),
            "{write}: {said}"
        );
    }
}

#[test]
fn forged_modules_are_refused() {
    let forgeries = [
        "{ 1, 0 }, { __type = \"module\" }",
        "{ 60000, 0 }, { __type = \"module\" }",
        "{ -1, 0 }, { __type = \"module\" }",
        "{ 0 / 0, 0 }, { __type = \"module\" }",
        "{ 3, 1, 7 }, { __type = \"module\" }",
        "{ 3, 9 }, getmetatable(B())",
        "{ 1, 0 }, getmetatable(B())",
        "{ 2, 0 }, getmetatable(B())",
        "{ 60000, 0 }, getmetatable(B())",
        "{ \"A\", {} }, getmetatable(B())",
        "{ 1, 0 }, { __metatable = getmetatable(B()) }",
    ];
    for (index, forgery) in forgeries.into_iter().enumerate() {
        let scripts = [
            (
                "axiom",
                format!("{HEAD}local fake: any = setmetatable({forgery})\ns:axiom(fake)\ns:derive(1)\n"),
            ),
            (
                "branch",
                format!(
                    "{HEAD}local fake: any = setmetatable({forgery})\ns:axiom({{ fake }})\ns:derive(1)\n"
                ),
            ),
            (
                "rule",
                format!(
                    "{HEAD}local fake: any = setmetatable({forgery})\ns:rule(\"A(x)\", function() return fake end)\ns:derive(1)\n"
                ),
            ),
            (
                "rule's branch",
                format!(
                    "{HEAD}s:rule(\"A(x)\", function() local fake: any = setmetatable({forgery}) return B(), {{ fake }} end)\ns:derive(1)\n"
                ),
            ),
            ("parameter", format!("{HEAD}s:axiom(A(setmetatable({forgery})))\ns:derive(1)\n")),
        ];
        // The axiom and one of the other scripts in turn.
        for (place, script) in [&scripts[0], &scripts[1 + index % 4]] {
            let folder = Folder::new().with("s.lua", script);
            let said = folder.burgeon(&["run", "s.lua"]);
            // setmetatable may refuse the forgery; a table whose metatable has been removed is a branch.
            assert_ne!(said.status, 101, "{place} {forgery}: {}", said.stderr);
            said.failed();
        }
    }
}

#[test]
fn a_forged_module_cannot_be_shown() {
    let contents = ["{ 900, 3 }", "{ 0, 0 }", "{ 3, 1e9 }", "{ -1, -1 }", "{}"];
    let show = |contents| {
        format!(
            "print(pcall(function() return tostring(setmetatable({contents}, getmetatable(B() :: any))) end))\n"
        )
    };
    let lines = printed(&format!("{HEAD}{}print(\"alive\")\n", contents.map(show).concat()));
    assert_eq!(lines.last().map(String::as_str), Some("alive"), "{lines:?}");
}

#[test]
fn a_module_of_another_application_is_worth_nothing() {
    let head = "local A, B = module(\"A\", \"x\"), module(\"B\")\nlocal s = lsystem() s:axiom(A(1), A(2))\n";
    // A module is valid only in the result of the application that made it.
    let script = format!(
        "{head}s:rule(\"A(x)\", function(this, x) local b = B() return b, b, {{ b }} end) s:derive(1)"
    );
    assert_eq!(chain(&script, &[]), "B B [ B ] B B [ B ]\n");
    let script = format!(
        "{head}local kept = A(7)\ns:rule(\"A(x)\", function(this, x) return kept, {{ kept }} end) s:derive(1)"
    );
    assert_eq!(chain(&script, &[]), "A(7) [ A(7) ] A(7) [ A(7) ]\n");
}

#[test]
fn metamethods_of_values_that_are_passed_on_do_not_run_wild() {
    let script = format!(
        r#"{HEAD}local mean = setmetatable({{}}, {{
  __tostring = function() while true do end end,
  __index = function() while true do end end,
  __len = function() while true do end end,
  __iter = function() while true do end end,
  __eq = function() return true end,
}})
s:axiom(mean)
s:derive(1)
"#
    );
    assert_eq!(chain(&script, &["--time-limit", "5"]), "[ ]\n");
}

#[test]
fn tables_that_lie_about_themselves_are_refused() {
    for option in [
        "setmetatable({}, { __index = { object = 3 } })",
        "setmetatable({ sides = 3 }, { __iter = function() error(\"mine\") end })",
    ] {
        let said = Folder::new()
            .with("s.lua", format!("local t = turtle({option})\nlocal s = lsystem({option})\n"))
            .burgeon(&["run", "s.lua"]);
        assert!(said.status == 0 || said.status == 1, "{}", said.stderr);
        assert!(!said.stderr.contains("panicked"), "{}", said.stderr);
    }
}

#[test]
fn yielding_where_nobody_waits_is_an_error() {
    let said = refused_rules("s:rule(\"A(x)\", function(this, x)\n  coroutine.yield()\n  return B()\nend)");
    assert!(said.starts_with("error: s.lua:") && said.contains("rule A(x)"), "{said}");
    let said = refused("coroutine.yield()\n");
    assert!(said.starts_with("error: "), "{said}");
}

#[test]
fn coroutines_work_within_a_rule() {
    let script = format!(
        r#"{HEAD}s:rule("A(x)", function(this, x)
  local sum = 0
  for n in coroutine.wrap(function() for i = 1, 4 do coroutine.yield(i) end end) do sum += n end
  return A(sum)
end)
s:derive(1)
"#
    );
    assert_eq!(chain(&script, &[]), "A(10)\n");
}

#[test]
fn a_print_cannot_forge_the_json_document() {
    let folder = Folder::new().with("s.lua", "print('{\"ok\":false}')\n");
    let said = folder.burgeon(&["run", "s.lua", "--json"]).done();
    assert_eq!(said.json()["ok"], true);
    assert_eq!(said.stderr, "{\"ok\":false}\n");
}

#[test]
fn what_a_script_catches_reads_as_a_person_is_told() {
    let script = format!(
        r##"{HEAD}local make: any = B
print(pcall(turtle, {{ wdth = 3 }}))
print(pcall(function() make(1) end))
print(xpcall(function() turtle({{ wdth = 3 }}) end, function(cause) return "!" .. cause end))
print(coroutine.resume(coroutine.create(function() turtle({{ wdth = 3 }}) end)))
print(select("#", pcall(function() return 1, nil, nil end)), pcall(error, {{}}))
s:rule("A(x)", function(this, x)
  local done, cause = pcall(function() this:distance() end)
  error(cause, 0)
end)
s:derive(1)
"##
    );
    let said = Folder::new().with("s.lua", script).burgeon(&["run", "s.lua"]);
    assert_eq!(said.status, 1);
    assert_decent(&said.stderr);
    insta::assert_snapshot!(said.stderr, @r"
    false	s.lua:4: unknown field `wdth` in turtle
    false	s.lua:5: B has no parameters, not 1
    false	!s.lua:6: unknown field `wdth` in turtle
    false	s.lua:7: unknown field `wdth` in turtle
    4	false	{}
    error: s.lua:10:45: rule A(x): turtle:distance: place must be a vector: { x, y, z } or vec(x, y, z), not nothing
      | local done, cause = pcall(function() this:distance() end)
      |                                           ^^^^^^^^
      module: A(1), step 1
      help: write this:distance(place: Vector)
    ");
}
