//! Tests of the limits on time, memory, modules and triangles.

use std::time::{Duration, Instant};

use insta::assert_snapshot;

use crate::support::{Folder, HEAD, refused_with, stopped, without_columns};

const SOON: [&str; 2] = ["--time-limit", "1"];
const SMALL: [&str; 2] = ["--memory-limit", "64"];

fn endless(rules: &str) -> String {
    stopped(&format!("{HEAD}{rules}\ns:derive(1)\n"), &SOON)
}

fn greedy(rules: &str) -> String {
    stopped(&format!("{HEAD}{rules}\ns:derive(1)\n"), &SMALL)
}

#[test]
fn runaway_growth_names_the_rule_that_grew_most() {
    let script = format!(
        "{HEAD}s:rule(\"B\", function() return B() end)\ns:rule(\"A(x)\", function(this, x) return A(x), A(x + 1), B() end)\ns:derive()\n"
    );
    assert_snapshot!(refused_with(&script, &["--module-limit", "100000"]), @r#"
    error: s.lua:4:1: rule A(x) (which grew most): the chain exceeded 100000 modules in step 16
      | s:rule("A(x)", function(this, x) return A(x), A(x + 1), B() end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: end the growth with a guard or a counter, derive fewer steps, or raise the limit: --module-limit N
    "#);
    let said = |threads: &str| refused_with(&script, &["--module-limit", "100000", "--threads", threads]);
    assert_eq!(said("1"), said("2"));
}

#[test]
fn a_derivation_without_a_number_of_steps_that_does_not_end_names_the_rule() {
    let script = format!("{HEAD}s:rule(\"A(x)\", function(this, x) return A(x + 1) end)\ns:derive()\n");
    assert_snapshot!(refused_with(&script, &[]), @r#"
    error: s.lua:3:1: rule A(x) (applied most, 200,000 times): the derivation has not ended after 200,000 steps (modules in the chain: 1)
      | s:rule("A(x)", function(this, x) return A(x + 1) end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: end the rule with a guard or a counter, or write the number of steps: system:derive(1000000)
    "#);
    let given = script.replace("derive()", "derive(200001)");
    Folder::new().with("s.lua", &given).burgeon(&["run", "s.lua"]).done();
}

#[test]
fn runaway_within_one_application_of_a_rule_is_stopped() {
    let limit = ["--module-limit", "100000"];
    let script = |body: &str| {
        format!("{HEAD}local b = B()\ns:rule(\"A(x)\", function(this, x)\n  {body}\nend)\ns:derive(1)\n")
    };
    assert_snapshot!(stopped(&script("while true do B() end"), &limit), @r"
    error: s.lua:5:3: rule A(x): one application of a rule returned more than 100000 modules
      | while true do B() end
      | ^^^^^^^^^^^^^^^^^^^^^
      module: A(1), step 1
      help: look for an endless loop, or raise the limit: --module-limit N
    ");
    for body in [
        "local t = {} for i = 1, 10000000 do table.insert(t, B()) end return t",
        "return table.create(200000, b)",
        "local t = table.create(1000, b) return table.create(1000, t)",
    ] {
        let said = stopped(&script(body), &limit);
        assert!(
            without_columns(&said).starts_with(
                "error: s.lua:5: rule A(x): one application of a rule returned more than 100000 modules"
            ),
            "{body}: {said}"
        );
        assert!(said.contains("  module: A(1), step 1\n") && said.contains("--module-limit"), "{said}");
    }
}

#[test]
fn an_endless_loop_in_a_rule_is_stopped() {
    assert_snapshot!(endless("s:rule(\"A(x)\", function(this, x)\n  local n = 0\n  while true do\n    n += 1\n  end\nend)"), @r"
    error: s.lua:5:3: rule A(x): the run exceeded the time limit of 1 s
      | while true do
      | ^^^^^^^^^^^^^
      module: A(1), step 1
      help: look for an endless loop, or raise the limit: --time-limit SECONDS
    ");
}

#[test]
fn an_endless_loop_in_a_guard_is_stopped() {
    assert_snapshot!(endless("s:rule(\"A(x)\", { when = function(this, x)\n  repeat until false\nend }, function() return B() end)"), @r"
    error: s.lua:4:3: rule A(x): the run exceeded the time limit of 1 s
      | repeat until false
      | ^^^^^^^^^^^^^^^^^^
      module: A(1), step 1
      help: look for an endless loop, or raise the limit: --time-limit SECONDS
    ");
}

#[test]
fn an_endless_loop_in_an_interpretation_is_stopped() {
    let said = endless("s:interpret(\"A(x)\", function(this, x)\n  while true do this:position() end\nend)");
    // The time limit is reached in the loop or in the call inside it; both are on one line.
    assert!(
        without_columns(&said).starts_with(
            "error: s.lua:4: rule A(x) (interpretation): the run exceeded the time limit of 1 s\n"
        ),
        "{said}"
    );
    assert!(said.contains("module: A(1), step 0\n") && said.contains("--time-limit"), "{said}");
}

#[test]
fn an_endless_loop_at_the_top_level_is_stopped() {
    assert_snapshot!(stopped("local a = 1\nwhile true do\nend\n", &SOON), @r"
    error: s.lua:2:1: the run exceeded the time limit of 1 s
      | while true do
      | ^^^^^^^^^^^^^
      help: look for an endless loop, or raise the limit: --time-limit SECONDS
    ");
}

#[test]
fn an_endless_loop_in_a_required_file_is_stopped() {
    let folder = Folder::new().with("s.lua", "require(\"lib\")\n").with("lib.lua", "\n\nwhile true do end\n");
    let said = folder.burgeon(&["run", "s.lua", "--time-limit", "1"]).failed();
    assert!(
        without_columns(&said).starts_with("error: lib.lua:3: the run exceeded the time limit of 1 s\n"),
        "{said}"
    );
}

#[test]
fn derivation_without_end_is_stopped() {
    let said = endless("s:rule(\"A(x)\", function(this, x) return A(x + 1) end)\ns:derive(900000000)");
    assert!(said.contains("the run exceeded the time limit of 1 s\n") && said.contains("help: "), "{said}");
}

#[test]
fn pcall_and_coroutines_do_not_outlive_the_time() {
    let bodies = [
        "while true do pcall(function() while true do end end) end",
        "while true do xpcall(function() while true do end end, function() while true do end end) end",
        "while true do pcall(function() while true do pcall(coroutine.wrap(function() while true do pcall(function() while true do end end) end end)) end end) end",
        "local function f() pcall(f) return f() end f()",
        "local t = setmetatable({}, { __index = function(t, k) while true do end end }) while true do pcall(function() return t.x end) end",
        "table.sort({ 1, 2, 3, 4 }, function(a, b) while true do end end)",
        "string.gsub(\"aaaa\", \"a\", function() while true do end end)",
    ];
    for body in bodies {
        let said = endless(&format!("s:rule(\"A(x)\", function(this, x)\n  {body}\nend)"));
        assert!(
            without_columns(&said)
                .starts_with("error: s.lua:4: rule A(x): the run exceeded the time limit of 1 s\n"),
            "{body}: {said}"
        );
        assert!(said.contains("module: A(1), step 1\n"), "{body}: {said}");
    }
}

#[test]
fn library_functions_do_not_outlive_the_time() {
    let bodies = [
        "local a = string.rep(\"a\", 40) return A(string.find(a, string.rep(\"a?\", 40) .. a) or 0)",
        "return A(#string.gsub(string.rep(\"a\", 3000), string.rep(\"a*\", 20) .. \"b\", \"\"))",
        "for w in string.gmatch(string.rep(\"a\", 30000), \".-.-.-b\") do end return A(1)",
        "local t = table.create(3000000, \"a\") while true do table.concat(t) end",
    ];
    for body in bodies {
        let said = endless(&format!("s:rule(\"A(x)\", function(this, x)\n  {body}\nend)"));
        assert!(
            without_columns(&said)
                .starts_with("error: s.lua:4: rule A(x): the run exceeded the time limit of 1 s\n"),
            "{body}: {said}"
        );
    }
}

#[test]
fn the_time_limit_is_kept_with_helpers_too() {
    let script = format!(
        "{HEAD}s:rule(\"A(x)\", function(this, x)\n  if x < 14 then return A(x + 1), A(x + 1) end\n  while true do pcall(function() while true do end end) end\nend)\ns:derive()\n"
    );
    let begin = Instant::now();
    let said = stopped(&script, &["--time-limit", "1", "--threads", "2"]);
    assert!(begin.elapsed() < Duration::from_secs(6), "{said}");
    assert!(
        without_columns(&said)
            .starts_with("error: s.lua:5: rule A(x): the run exceeded the time limit of 1 s\n"),
        "{said}"
    );
}

#[test]
fn a_table_that_grows_is_stopped_at_the_memory_limit() {
    assert_snapshot!(greedy("s:rule(\"A(x)\", function(this, x)\n  local t = {}\n  while true do\n    table.insert(t, {})\n  end\nend)"), @r"
    error: s.lua:6:5: rule A(x): the run exceeds the memory limit of 64 MB
      | table.insert(t, {})
      | ^^^^^^^^^^^^^^^^^^^
      module: A(1), step 1
      help: look for a growing table, string or report, or raise the limit: --memory-limit MEGABYTES
    ");
}

#[test]
fn a_string_that_doubles_is_stopped_at_the_memory_limit() {
    assert_snapshot!(greedy("s:rule(\"A(x)\", function(this, x)\n  local t = \"a\"\n  while true do t = t .. t end\nend)"), @r"
    error: s.lua:5:3: rule A(x): the run exceeds the memory limit of 64 MB
      | while true do t = t .. t end
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A(1), step 1
      help: look for a growing table, string or report, or raise the limit: --memory-limit MEGABYTES
    ");
}

#[test]
fn the_memory_limit_is_kept_everywhere() {
    // Each script exceeds the limit in line 4.
    let places = [
        "local t = \"a\" while true do\n t = t .. t end",
        "local t = {} while true do\n table.insert(t, buffer.create(1000000)) end",
        "local t = table.create(1000000, \"aaaaaaaaaaaaaaaaaaaaaaa\")\nlocal x = table.concat(t) .. table.concat(t) .. table.concat(t)",
        "s:axiom(source({ {} }), function() local t = {}\n while true do table.insert(t, { 1 }) end end)",
        "s:rule(\"A(x)\", function(this, x)\n return A(string.rep(\"a\", 1000000000)) end)",
        "s:rule(\"A(x)\", function(this, x)\n return A(buffer.len(buffer.create(1000000000))) end)",
        "s:rule(\"A(x)\", { when = function(this, x) local t = {}\n while true do table.insert(t, {}) end end }, function() return B() end)",
        "s:interpret(\"A(x)\", function(this, x) local t = {}\n while true do table.insert(t, {}) end end)",
        "s:rule(\"A(x)\", function(this, x) local t = {}\n while true do table.insert(t, coroutine.create(function() end)) end end)",
        "s:rule(\"A(x)\", function(this, x)\n coroutine.wrap(function() local t = {} while true do table.insert(t, {}) end end)() end)",
        "s:rule(\"A(x)\", function(this, x)\n for i = 1, 100 do A(string.rep(\"a\", 10000000) .. i) end return B() end)",
    ];
    for place in places {
        let said = greedy(place);
        assert!(
            without_columns(&said).starts_with("error: s.lua:4: ")
                && said.contains("memory limit of 64 MB")
                && said.contains("--memory-limit"),
            "{place}: {said}"
        );
    }
}

#[test]
fn strings_that_travel_in_modules_do_not_escape_the_memory_limit() {
    let said = greedy(
        "s:rule(\"A(x)\", function(this, x)\n  for i = 1, 100 do A(string.rep(\"a\", 10000000) .. i) end\n  return B()\nend)",
    );
    assert!(said.contains("memory"), "{said}");
}

#[test]
fn recursion_without_end_is_stopped() {
    assert_snapshot!(stopped(&format!("{HEAD}local function f(n)\n  return 1 + f(n)\nend\ns:rule(\"A(x)\", function(this, x) return A(f(1)) end)\ns:derive(1)\n"), &[]), @r"
    error: s.lua:4:3: rule A(x): stack overflow
      | return 1 + f(n)
      | ^^^^^^^^^^^^^^^
      module: A(1), step 1
      help: look for an endless recursion
    ");
}

#[test]
fn triangles_are_bounded() {
    let script = format!(
        "{HEAD}s:rule(\"A(x)\", function(this, x) return A(x), A(x) end)\ns:interpret(\"A(x)\", function(this, x)\n  this:forward(x)\nend)\ns:derive(10)\n"
    );
    assert_snapshot!(refused_with(&script, &["--triangle-limit", "2000"]), @r"
    error: s.lua:7:1: the system draws more than 2000 triangles
      | s:derive(10)
      | ^^^^^^^^^^^^
      help: draw with fewer sides, derive fewer steps, or raise the limit: --triangle-limit N
    ");
}

#[test]
fn branches_are_not_nested_without_end() {
    let said = stopped(
        &format!(
            "{HEAD}s:rule(\"A(x)\", function(this, x)\n  local t = {{ B() }}\n  for i = 1, 100000 do t = {{ t }} end\n  return t\nend)\ns:derive(1)\n"
        ),
        &[],
    );
    assert!(said.starts_with("error: s.lua:") && said.contains("nested"), "{said}");
}

#[test]
fn a_script_that_is_too_large_is_refused_before_it_is_read() {
    let large = "local x = 1 -- a line\n".repeat(200_000);
    let folder = Folder::new().with("s.lua", &large).with("t.lua", "require(\"s\")\n");
    assert_snapshot!(folder.refuses(&["run", "s.lua"]), @r"
    error: s.lua is larger than 4 MB
      help: divide it; require loads other files of its folder
    ");
    let said = folder.refuses(&["run", "t.lua"]);
    assert!(
        without_columns(&said).starts_with("error: t.lua:1: ") && said.contains("s.lua is larger than 4 MB"),
        "{said}"
    );
}

#[test]
fn a_run_whose_time_is_over_tells_how_far_it_came() {
    let said = endless("s:rule(\"A(x)\", function(this, x) return B(), A(x + 1) end)\ns:derive(1e8)");
    assert!(said.contains("the run exceeded the time limit of 1 s\n"), "{said}");
    assert!(
        said.contains(" is complete, with ") && said.contains(" modules: derive fewer steps, "),
        "{said}"
    );
}

#[test]
fn branches_of_a_context_are_not_nested_without_end() {
    for depth in [201, 40_000] {
        let pattern = format!("A > {}B{}", "[".repeat(depth), "]".repeat(depth));
        let folder = Folder::new()
            .with("s.lua", format!("{HEAD}s:rule(\"{pattern}\", function() return B() end)\ns:derive(1)\n"));
        for command in ["run", "check"] {
            let said = folder.burgeon(&[command, "s.lua"]).failed();
            assert!(
                without_columns(&said)
                    .starts_with("error: s.lua:3: malformed pattern: unexpected '[' at character 205\n"),
                "{said}"
            );
            assert!(
                said.contains("help: branches are nested at most 200 deep") && said.len() < 1000,
                "{said}"
            );
        }
    }
    let pattern = format!("A > {}B{}", "[".repeat(200), "]".repeat(200));
    let axiom = format!("s:axiom(A(1), {}B(){})", "{ ".repeat(200), "}".repeat(200));
    let folder = Folder::new().with(
        "s.lua",
        format!("{HEAD}{axiom}\ns:rule(\"{pattern}\", function() return nil end)\ns:derive(1)\n"),
    );
    let said = folder.burgeon(&["run", "s.lua", "--chain", "-"]).done();
    assert_eq!(said.stdout.replace(' ', ""), format!("{}B{}\n", "[".repeat(200), "]".repeat(200)));
}

#[test]
fn a_system_has_no_more_rules_than_can_be_numbered() {
    let script = |count: usize| {
        format!(
            "{HEAD}for i = 1, {count} do\n  s:rule(\"A(x)\", {{ when = function(this, x) return x == -i end }}, function() return B() end)\nend\ns:derive(1)\n"
        )
    };
    assert_snapshot!(refused_with(&script(65_100), &[]), @r#"
    error: s.lua:4:3: a system can have at most 65,000 rules
      | s:rule("A(x)", { when = function(this, x) return x == -i end }, function() return B() end)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: join rules into one, and distinguish the cases by a parameter
    "#);
    let mut last = script(64_999);
    last = last.replace("s:derive(1)", "s:rule(\"A(x)\", function() return B(), B() end)\ns:derive(1)");
    let folder = Folder::new().with("s.lua", &last);
    assert_eq!(folder.burgeon(&["run", "s.lua", "--chain", "-"]).done().stdout, "B B\n");
}
