//! Tests that a rule assigns only its own locals, and changes no object.

use insta::assert_snapshot;

use crate::support::{Folder, HEAD, chain, printed, refused, refused_rules, without_columns};

#[test]
fn a_rule_cannot_assign_a_captured_variable() {
    assert_snapshot!(refused_rules("local n = 0\ns:rule(\"A(x)\", function(this, x)\n  n = n + 1\n  return A(n)\nend)"), @r"
    error: s.lua:5:3: rule A(x): a rule assigns n, a variable declared outside
      | n = n + 1
      | ^
      help: pass it in a parameter of a module; to change the object, use an interpretation rule
    ");
    assert_snapshot!(refused_rules("local n = 0\ns:rule(\"A(x)\", function(this, x)\n  local function add() n += 1 end\n  add()\n  return A(n)\nend)"), @r"
    error: s.lua:5:24: rule A(x): a rule assigns n, a variable declared outside
      | local function add() n += 1 end
      |                      ^
      help: pass it in a parameter of a module; to change the object, use an interpretation rule
    ");
    assert_snapshot!(refused_rules("local f\ns:rule(\"A(x)\", function(this, x)\n  function f() end\n  return A(x)\nend)"), @r"
    error: s.lua:5:12: rule A(x): a rule assigns f, a variable declared outside
      | function f() end
      |          ^
      help: pass it in a parameter of a module; to change the object, use an interpretation rule
    ");
}

#[test]
fn a_guard_cannot_assign_a_captured_variable() {
    assert_snapshot!(
        refused_rules("local n = 0\ns:rule(\"A(x)\", { when = function(this, x)\n  n = n + 1\n  return n > 3\nend }, function() return B() end)"),
        @r"
    error: s.lua:5:3: rule A(x): a guard assigns n, a variable declared outside
      | n = n + 1
      | ^
      help: pass it in a parameter of a module; to change the object, use an interpretation rule
    "
    );
}

#[test]
fn an_interpretation_cannot_assign_a_captured_variable() {
    assert_snapshot!(refused_rules("local n = 0\ns:interpret(\"A(x)\", function(this, x)\n  n = n + 1\nend)"), @r"
    error: s.lua:5:3: rule A(x) (interpretation): an interpretation rule assigns n, a variable declared outside
      | n = n + 1
      | ^
      help: it can change only `this`; keep values in a parameter of a module
    ");
    assert_snapshot!(refused_rules("local n = 0\nlocal function add() n = n + 1 end\ns:interpret(\"A(x)\", function(this, x)\n  add()\nend)"), @r"
    error: s.lua:4:1: rule A(x) (interpretation): an interpretation rule assigns n, a variable declared outside
      | local function add() n = n + 1 end
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A(1), step 0
      help: a rule can assign only its own locals; pass it in a parameter of a module
    ");
}

#[test]
fn a_rule_cannot_assign_a_global() {
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", function(this, x)\n  count = 1\n  return A(x)\nend)"), @r"
    error: s.lua:4:3: rule A(x): cannot assign count: it is not a local variable
      | count = 1
      | ^^^^^
      help: a rule can assign only its own locals; declare it inside: local ..., or use an interpretation rule to change the object
    ");
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", function(this, x)\n  print = nil\n  return A(x)\nend)"), @r"
    error: s.lua:4:3: rule A(x): cannot assign print: it is built in
      | print = nil
      | ^^^^^
      help: choose another name: local ...
    ");
}

#[test]
fn a_rule_cannot_assign_through_a_helper() {
    assert_snapshot!(
        refused_rules("local n = 0\nlocal function count()\n  n = n + 1\n  return n\nend\ns:rule(\"A(x)\", function(this, x)\n  return A(count())\nend)"),
        @r"
    error: s.lua:5:3: rule A(x): a rule assigns n, a variable declared outside
      | n = n + 1
      | ^^^^^^^^^
      module: A(1), step 1
      help: a rule can assign only its own locals; pass it in a parameter of a module
    "
    );
}

#[test]
fn a_rule_cannot_count_with_a_closure_that_a_factory_made() {
    assert_snapshot!(
        refused_rules("local function counter()\n  local n = 0\n  return function()\n    n = n + 1\n    return n\n  end\nend\nlocal count = counter()\ns:rule(\"A(x)\", function(this, x)\n  return A(count())\nend)"),
        @r"
    error: s.lua:6:5: rule A(x): a rule assigns n, a variable declared outside
      | n = n + 1
      | ^^^^^^^^^
      module: A(1), step 1
      help: a rule can assign only its own locals; pass it in a parameter of a module
    "
    );
}

#[test]
fn a_rule_that_is_declared_later_is_guarded_too() {
    assert_snapshot!(
        refused_rules("local n = 0\nlocal function successor(this, x)\n  n = n + 1\n  return A(n)\nend\ns:rule(\"A(x)\", successor)"),
        @r"
    error: s.lua:5:3: rule A(x): a rule assigns n, a variable declared outside
      | n = n + 1
      | ^^^^^^^^^
      module: A(1), step 1
      help: a rule can assign only its own locals; pass it in a parameter of a module
    "
    );
}

#[test]
fn a_rule_cannot_write_into_a_captured_table() {
    assert_snapshot!(refused_rules("local t = { n = 0 }\ns:rule(\"A(x)\", function(this, x)\n  t.n = t.n + 1\n  return A(t.n)\nend)"), @r"
    error: s.lua:5:3: rule A(x): attempt to modify a readonly table
      | t.n = t.n + 1
      | ^^^^^^^^^^^^^
      module: A(1), step 1
      help: the library is read-only, and while rules run, so are tables from outside the rule; create a new table, or use table.clone
    ");
    for write in [
        "rawset(t, \"n\", 1)",
        "table.insert(t, 1)",
        "table.clear(t)",
        "table.remove(t)",
        "table.sort(t, function(a, b) return a > b end)",
        "table.move({ 1 }, 1, 1, 1, t)",
        "setmetatable(t, {})",
        "t.inner.n = 1",
        "list[1].n = 1",
        "read().n = 1",
        "getmetatable(t).n = 1",
        "next(list).n = 1",
    ] {
        let script = format!(
            "local t = setmetatable({{ 1, 2, n = 0, inner = {{}} }}, {{}})\nlocal list = {{ {{}}, [{{}}] = 1 }}\nlocal function read() return t end\ns:rule(\"A(x)\", function(this, x)\n  {write}\n  return A(x)\nend)"
        );
        let said = refused_rules(&script);
        assert!(
            without_columns(&said).contains("s.lua:7: rule A(x): ")
                && said.contains("module: A(1), step 1\n"),
            "{write}: {said}"
        );
    }
}

#[test]
fn a_rule_writes_its_own_locals_and_tables() {
    let script = format!(
        r#"{HEAD}local config = {{ by = 2 }}
s:rule("A(x)", function(this, x)
  local n, list = 0, {{}}
  local function add(m) n += m table.insert(list, n) end
  for i = 1, 3 do add(config.by) end
  local copy = table.clone(config)
  copy.by = n
  return A(copy.by + #list)
end)
s:derive(1)
config.by = 3
"#
    );
    assert_eq!(chain(&script, &[]), "A(9)\n");
}

#[test]
fn what_remembers_from_one_module_to_the_next_is_refused() {
    let remembering = [
        "local next = coroutine.wrap(function() local n = 0 while true do n += 1 coroutine.yield(n) end end)",
        "local co = coroutine.create(function() local n = 0 while true do n += 1 coroutine.yield(n) end end)\nlocal function next() local _, n = coroutine.resume(co) return n end",
        "local next = string.gmatch(\"abcdefghij\", \".\")",
        "local b = buffer.create(8)\nlocal function next() local n = buffer.readf64(b, 0) + 1 buffer.writef64(b, 0, n) return n end",
        "local state = { b = buffer.create(8) }\nlocal function next() local n = buffer.readf64(state.b, 0) + 1 buffer.writef64(state.b, 0, n) return n end",
        "local f = coroutine.wrap(function() local t = { n = 0 } while true do coroutine.yield(t) end end)\nlocal function next() local t = f() t.n += 1 return t.n end",
    ];
    for state in remembering {
        for rule in [
            "s:rule(\"A(x)\", function(this, x) return A(next()) end)",
            "s:rule(\"A(x)\", { when = function() next() return true end }, function(this, x) return A(1) end)",
            "s:interpret(\"A(x)\", function(this, x) next() end)",
        ] {
            let said = refused_rules(&format!("{state}\n{rule}"));
            assert!(
                said.starts_with("error: s.lua:") && said.contains("A(x)") && said.contains("help: "),
                "{state}: {said}"
            );
        }
    }
}

#[test]
fn a_rule_cannot_call_a_changing_method() {
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", function(this, x)\n  this:forward(1)\n  return A(x)\nend)"), @r"
    error: s.lua:4:8: rule A(x): turtle:forward is a write method, so a rule cannot call it
      | this:forward(1)
      |      ^^^^^^^
      module: A(1), step 1
      help: use an interpretation rule: system:interpret(pattern, function(this, ...) ... end)
    ");
    assert_snapshot!(
        refused_rules("s:rule(\"A(x)\", { when = function(this, x)\n  this:width(2)\n  return true\nend }, function() return B() end)"),
        @r"
    error: s.lua:4:8: rule A(x): turtle:width is a write method, so a rule cannot call it
      | this:width(2)
      |      ^^^^^
      module: A(1), step 1
      help: use an interpretation rule: system:interpret(pattern, function(this, ...) ... end)
    "
    );
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", function(this, x)\n  this:color(\"#ff0000\")\n  return A(x)\nend)"), @r##"
    error: s.lua:4:8: rule A(x): turtle:color is a write method, so a rule cannot call it
      | this:color("#ff0000")
      |      ^^^^^
      module: A(1), step 1
      help: use an interpretation rule: system:interpret(pattern, function(this, ...) ... end)
    "##);
    assert_snapshot!(refused_rules("local t = turtle()\ns:rule(\"A(x)\", function(this, x)\n  t:forward(1)\n  return A(x)\nend)"), @r"
    error: s.lua:5:5: rule A(x): turtle:forward is a write method, so a rule cannot call it
      | t:forward(1)
      |   ^^^^^^^
      module: A(1), step 1
      help: use an interpretation rule: system:interpret(pattern, function(this, ...) ... end)
    ");
    assert_snapshot!(refused_rules("local t = turtle()\nt:forward(1)"), @r"
    error: s.lua:4:3: turtle:forward is a write method, so only interpretation rules can call it
      | t:forward(1)
      |   ^^^^^^^
      help: use system:interpret(pattern, function(this, ...) ... end)
    ");
    assert_snapshot!(refused_rules("local t = turtle()\ns:interpret(\"A(x)\", function(this, x)\n  t:forward(1)\nend)"), @r"
    error: s.lua:5:5: rule A(x) (interpretation): turtle:forward changes an object that was made here, and nothing is drawn with it
      | t:forward(1)
      |   ^^^^^^^
      module: A(1), step 0
      help: let the type hold one from the beginning: state = { pen = extruder() }, and call self.pen:extrude(1)
    ");
    assert_snapshot!(refused_rules("local t = turtle()\nt.width = 3"), @r"
    error: s.lua:4:3: width of a turtle cannot be assigned
      | t.width = 3
      |   ^^^^^
      help: set fields in the constructor: turtle { width = ... }
    ");
    assert_snapshot!(refused_rules("s:interpret(\"A(x)\", function(this, x)\n  this.width = 3\nend)"), @r"
    error: s.lua:4:8: rule A(x) (interpretation): this.width is assigned, but methods change an object
      | this.width = 3
      |      ^^^^^
      module: A(1), step 0
      help: write this:width(3) if it has this method
    ");
}

#[test]
fn this_cannot_be_kept() {
    let said =
        refused_rules("local keep = {}\ns:interpret(\"A(x)\", function(this, x)\n  keep.this = this\nend)");
    assert!(without_columns(&said).starts_with("error: s.lua:5: rule A(x) (interpretation): "), "{said}");
}

#[test]
fn a_guard_draws_no_random_numbers() {
    assert_snapshot!(
        refused_rules("s:rule(\"A(x)\", { when = function(this, x)\n  return random() > 0.5\nend }, function() return B() end)"),
        @r"
    error: s.lua:4:10: rule A(x): a guard cannot use random numbers
      | return random() > 0.5
      |        ^^^^^^
      module: A(1), step 1
      help: call random in the successor, or set the weights of the rules: { weight = 2 }
    "
    );
}

#[test]
fn random_takes_no_bounds_or_two_numbers() {
    let drawn =
        |call: &str| refused_rules(&format!("s:rule(\"A(x)\", function(this, x)\n  return A({call})\nend)"));
    assert_snapshot!(drawn("random(3)"), @r"
    error: s.lua:4:12: rule A(x): random takes no bounds or two, not 1
      | return A(random(3))
      |          ^^^^^^
      module: A(1), step 1
      help: write random() or random(low, high)
    ");
    assert_snapshot!(drawn("random(nil, 1)"), @r"
    error: s.lua:4:12: rule A(x): random takes two numbers, not nothing and the number 1
      | return A(random(nil, 1))
      |          ^^^^^^
      module: A(1), step 1
      help: write random() or random(low, high)
    ");
    assert_snapshot!(drawn("random(0 / 0, 1)"), @r"
    error: s.lua:4:12: rule A(x): random takes two finite numbers, not NaN and 1
      | return A(random(0 / 0, 1))
      |          ^^^^^^
      module: A(1), step 1
      help: check where they come from, such as a division by 0
    ");
    assert_snapshot!(drawn("random(0, 1 / 0)"), @r"
    error: s.lua:4:12: rule A(x): random takes two finite numbers, not 0 and inf
      | return A(random(0, 1 / 0))
      |          ^^^^^^
      module: A(1), step 1
      help: check where they come from, such as a division by 0
    ");
    for call in ["random(\"a\", \"b\")", "random(1, {})", "random(nil)", "random(1, nil)", "random(1, 2, 3)"]
    {
        let said = drawn(call);
        assert!(
            without_columns(&said).starts_with("error: s.lua:4: rule A(x): random takes "),
            "{call}: {said}"
        );
    }
}

#[test]
fn random_numbers_lie_between_bounds_in_either_order_and_however_far_apart() {
    let said = printed(
        "local function within(low, high)
  for _ = 1, 1000 do
    local x = random(low, high)
    if x < math.min(low, high) or x > math.max(low, high) then return x end
  end
  return true
end
print(within(2, 5), within(5, 2), within(-1e308, 1e308), random(3, 3))
",
    );
    assert_eq!(said, ["true\ttrue\ttrue\t3"]);
}

#[test]
fn declarations_belong_at_the_top_level() {
    for call in [
        "s:rule(\"B\", function() return A(1) end)",
        "s:interpret(\"B\", function() end)",
        "s:axiom(B())",
        "s:ignore(\"B\")",
        "s:derive(1)",
        "other:derive(1)",
        "lsystem()",
        "module(\"C\")",
        "param(\"late\", { default = 1 })",
        "require(\"late\")",
    ] {
        for place in [
            format!("s:rule(\"A(x)\", function(this, x)\n  {call}\n  return A(x)\nend)"),
            format!(
                "s:rule(\"A(x)\", {{ when = function(this, x)\n  {call}\n  return true\nend }}, function(this, x) return A(x) end)"
            ),
            format!("s:interpret(\"A(x)\", function(this, x)\n  {call}\nend)"),
        ] {
            let script = format!("{HEAD}local other = lsystem() other:axiom(B())\n{place}\ns:derive(1)\n");
            let folder = Folder::new().with("s.lua", script).with("late.lua", "return 1\n");
            let said = folder.burgeon(&["run", "s.lua"]).failed();
            assert!(
                without_columns(&said).starts_with("error: s.lua:5: rule A(x)")
                    && said.contains("top level of the script"),
                "{call}: {said}"
            );
            assert!(said.contains("module: A(1), step "), "{call}: {said}");
        }
    }
}

#[test]
fn an_error_that_a_script_raises_keeps_its_text() {
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", function(this, x)\n  error(\"too wide: \" .. x)\nend)"), @r#"
    error: s.lua:4:3: rule A(x): too wide: 1
      | error("too wide: " .. x)
      | ^^^^^^^^^^^^^^^^^^^^^^^^
      module: A(1), step 1
    "#);
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", function(this, x)\n  assert(x > 3, \"too small\")\nend)"), @r#"
    error: s.lua:4:3: rule A(x): too small
      | assert(x > 3, "too small")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A(1), step 1
    "#);
    assert_snapshot!(refused("error(\"one\\ntwo\")\n"), @r#"
    error: s.lua:1:1: one
    two
      | error("one\ntwo")
      | ^^^^^^^^^^^^^^^^^
    "#);
    assert_snapshot!(refused("error(\"no place\", 0)\n"), @r#"
    error: s.lua:1:1: no place
      | error("no place", 0)
      | ^^^^^^^^^^^^^^^^^^^^
    "#);
    for value in ["{}", "nil", "print"] {
        let once = refused(&format!("local a = 1\nerror({value})\n"));
        assert!(once.starts_with("error: "), "{once}");
        assert_eq!(refused(&format!("local a = 1\nerror({value})\n")), once);
    }
}
