//! Values that rules and packages share are read-only: all ways to reach a value, with all ways to write to
//! it.

use crate::packages::{about, castle};
use crate::support::{Folder, without_columns};

/// Ways in which a rule, or the user of a package, reaches a table: outside code, and the expression for the
/// table inside.
const WAYS: [(&str, &str); 14] = [
    ("local t = { n = 0, 1, 2 }", "t"),
    ("local o = { { { n = 0, 1, 2 } } }", "o[1][1]"),
    ("local o = table.freeze({ inner = { n = 0, 1, 2 } })", "o.inner"),
    ("local inner = { n = 0, 1, 2 } local o = setmetatable({}, { __index = { t = inner } })", "o.t"),
    (
        "local inner = { n = 0, 1, 2 } local o = setmetatable({}, { __index = function() return inner end })",
        "o.t",
    ),
    (
        "local inner = { n = 0, 1, 2 } local o = setmetatable({}, { __index = setmetatable({}, { __index = { t = inner } }) })",
        "o.t",
    ),
    ("local inner = { n = 0, 1, 2 } local o = { get = function() return inner end }", "o.get()"),
    (
        "local inner = { n = 0, 1, 2 } local o = setmetatable({}, { __call = function() return inner end })",
        "o()",
    ),
    ("local o = setmetatable({}, { n = 0, 1, 2 })", "getmetatable(o)"),
    ("local key = { n = 0, 1, 2 } local o = { [key] = 1 }", "next(o)"),
    (
        "local inner = { n = 0, 1, 2 } local function deep() return function() return inner end end",
        "deep()()",
    ),
    (
        "local inner = { n = 0, 1, 2 } local o = setmetatable({}, { __iter = function() return next, { inner } end })",
        "each(o)",
    ),
    (
        "local inner = { n = 0, 1, 2 } local o = setmetatable({}, { __add = function() return inner end })",
        "(o + 1)",
    ),
    (
        "local inner = { n = 0, 1, 2 } local o = setmetatable({}, { __len = function() return 1 end, __index = { inner } })",
        "o[#o]",
    ),
];

/// Ways to change a table.
const WRITES: [&str; 14] = [
    "TABLE.n = TABLE.n + 1",
    "TABLE.n += 1",
    "TABLE[1] = 9",
    "rawset(TABLE, 'n', 9)",
    "table.insert(TABLE, 9)",
    "table.remove(TABLE)",
    "table.clear(TABLE)",
    "table.move({ 9, 8 }, 1, 2, 1, TABLE)",
    "table.sort(TABLE, function(a, b) return a > b end)",
    "setmetatable(TABLE, { __index = function() return 9 end })",
    "pcall(function() TABLE.n = 9 end)",
    "pcall(rawset, TABLE, 'n', 9)",
    "coroutine.wrap(function() TABLE.n = 9 end)()",
    "table.freeze(TABLE)",
];

/// Functions that return the content of a table as one number.
const SEEN: &str = "local function seen(t) local sum = 0 for _, v in ipairs(t) do sum = sum * 10 + v end return (t.n or 7) * 1000 + sum end\n\
                    local function each(o) for _, v in o do return v end end\n";

/// Returns the chain of a script with two modules, which a rule rewrites one after the other.
fn chain(folder: &Folder) -> Result<String, String> {
    let options = burgeon::script::RunOptions { threads: Some(1), batch: 1, ..burgeon::options() };
    let run = burgeon::run(&folder.path().join("s.lua"), options).map_err(|error| error.to_string())?;
    Ok(run.systems[0].chain_text())
}

#[test]
fn no_rule_remembers_through_anything_that_it_reaches() {
    let (mut refused, mut without_effect) = (0, 0);
    for (outside, table) in WAYS {
        for write in WRITES {
            let script = format!(
                "{SEEN}{outside}\nlocal A, B = module(\"A\"), module(\"B\", \"n\")\nlocal s = lsystem()\ns:axiom(A(), A(), A())\n\
                 s:rule(\"A\", function()\n  {}\n  return B(seen({table}))\nend)\ns:derive(1)\n",
                write.replace("TABLE", table)
            );
            let folder = Folder::new().with("s.lua", &script);
            match chain(&folder) {
                Ok(chain) => {
                    assert_eq!(chain.trim(), "B(12) B(12) B(12)", "{script}");
                    without_effect += 1;
                }
                Err(error) => {
                    assert!(error.contains("read"), "{error}\n{script}");
                    refused += 1;
                }
            }
        }
    }
    assert_eq!(refused + without_effect, WAYS.len() * WRITES.len());
    assert!(refused > 150, "{refused}");
}

#[test]
fn what_remembers_and_cannot_be_frozen_is_refused_wherever_it_is() {
    let made = [
        (
            "buffer.create(8)",
            "buffer.writeu8(VALUE, 0, buffer.readu8(VALUE, 0) + 1)",
            "buffer.readu8(VALUE, 0)",
        ),
        (
            "coroutine.wrap(function() local n = 0 while true do n += 1 coroutine.yield(n) end end)",
            "",
            "VALUE()",
        ),
        (
            "coroutine.create(function() local n = 0 while true do n += 1 coroutine.yield(n) end end)",
            "",
            "select(2, coroutine.resume(VALUE))",
        ),
        ("string.gmatch(\"123\", \".\")", "", "tonumber(VALUE())"),
    ];
    let holders = [
        ("local v = MADE", "v"),
        ("local v = { { MADE } }", "v[1][1]"),
        ("local v = table.freeze({ inner = MADE })", "v.inner"),
        ("local v = setmetatable({}, { __index = { inner = MADE } })", "v.inner"),
        ("local inner = MADE local v = setmetatable({}, { __index = function() return inner end })", "v.x"),
        ("local inner = MADE local function v() return inner end", "v()"),
        (
            "local inner = MADE local v = object(\"own\", { extends = extruder, reads = { get = function() return inner end } })",
            "nothing",
        ),
    ];
    for (value, write, read) in made {
        for (holder, name) in holders {
            let (holder, write, read) =
                (holder.replace("MADE", value), write.replace("VALUE", name), read.replace("VALUE", name));
            let (write, read) =
                if name == "nothing" { (String::new(), "1".to_owned()) } else { (write, read) };
            let script = format!(
                "{holder}\nlocal A, B = module(\"A\"), module(\"B\", \"n\")\nlocal s = lsystem()\ns:axiom(A(), A())\n\
                 s:rule(\"A\", function() {write} return B({read}) end)\ns:derive(1)\n"
            );
            let error = chain(&Folder::new().with("s.lua", &script)).expect_err(&script);
            assert!(error.contains("which keeps state from one module to the next"), "{error}\n{script}");
        }
    }
}

#[test]
fn what_a_package_returns_is_changed_by_nobody_however_it_is_reached() {
    // Captured variables of returned functions stay writable, as documented in the book.
    let given = WAYS.iter().filter(|(outside, _)| !outside.contains("function"));
    let mut count = 0;
    for (outside, table) in given {
        for write in WRITES.iter().filter(|write| !write.contains("pcall") && !write.contains("freeze")) {
            let name = outside.split("local ").last().unwrap().split(' ').next().unwrap();
            let script =
                format!("local {name} = require(\"@castle/towers\")\n{}\n", write.replace("TABLE", table));
            let folder = castle("")
                .with("mods/castle/towers.lua", format!("{outside}\nreturn {name}\n"))
                .with("s.lua", &script);
            let error = burgeon::run(&folder.path().join("s.lua"), burgeon::options())
                .map(|_| ())
                .expect_err(&script)
                .to_string();
            assert!(error.contains("readonly"), "{outside}: {error}\n{script}");
            count += 1;
        }
    }
    assert!(count > 60, "{count}");
    for value in [
        "buffer.create(4)",
        "{ { buffer.create(4) } }",
        "table.freeze({ b = buffer.create(4) })",
        "setmetatable({}, { __index = { b = buffer.create(4) } })",
    ] {
        let folder = castle("")
            .with("mods/castle/towers.lua", format!("return {value}\n"))
            .with("s.lua", "require(\"@castle/towers\")");
        insta::allow_duplicates! {
            insta::assert_snapshot!(folder.refuses(&["run", "s.lua"]).lines().next().unwrap(), @"error: mods/castle/towers.lua:1:1: the package castle returns a buffer, which one user could change for all others");
        }
    }
}

#[test]
fn two_users_of_a_package_do_not_hear_of_each_other() {
    let folder = castle("")
        .with("mods/castle/towers.lua", "return { list = table.freeze({ { n = 1 } }) }")
        .with("mods/ruins/mod.toml", about("ruins", "[depends]\ncastle = \"1\""))
        .with("mods/ruins/init.lua", "local t = require(\"@castle/towers\")\nlocal done = pcall(function() t.list[1].n = 2 end)\nreturn done")
        .with("s.lua", "print(require(\"@ruins\"), require(\"@castle/towers\").list[1].n)");
    assert_eq!(crate::packages::prints(&folder, &[]), "false\t1\n");
}

/// Returns the error message for a type whose interpretation assigns an invalid state.
fn kept(assignment: &str) -> String {
    let script = format!(
        "local lamp = object(\"lamp\", {{ extends = extruder, state = {{ n = 0, list = {{}}, held = extruder() }}, changes = {{\n  go = function(self)\n    \
         local function f() end\n    {assignment}\n  end,\n}} }})\nlocal A = module(\"A\")\nlocal s = lsystem({{ object = lamp() }})\ns:axiom(A())\n\
         s:interpret(\"A\", function(this) this:go():extrude(1) end)\ns:derive()\n"
    );
    Folder::new().with("s.lua", script).refuses(&["run", "s.lua"])
}

#[test]
fn state_that_cannot_be_kept_is_told_of_where_it_is_assigned() {
    let cyclic = "local t = {} t.t = { t } self.list = t";
    for (assignment, what) in [
        ("self.n = f", "n of the state of lamp cannot be a function"),
        ("self.n = if true then f else nil", "n of the state of lamp cannot be a function"),
        ("self.list = { 1, { f } }", "list of the state of lamp cannot be a function"),
        ("self.list[1] = f", "list of the state of lamp cannot hold a function"),
        ("self.list.deep = { f }", "list of the state of lamp cannot hold a function"),
        (cyclic, "list of the state of lamp cannot be a table that contains itself"),
        ("self.n = coroutine.create(f)", "n of the state of lamp cannot be a thread"),
        ("self.n = buffer.create(3)", "n of the state of lamp cannot be a buffer"),
        (
            "self.n = { [true] = 1 }",
            "n of the state of lamp cannot be a table with the boolean true for a key",
        ),
        ("self.n = F(1)", "n of the state of lamp cannot be a module"),
        ("self.pen = extruder()", "lamp: unknown state variable `pen`"),
        ("self.held = extruder()", "held of lamp is an object, which nothing replaces"),
        ("self.n = extruder() self.n:extrude(1)", "extruder:extrude changes an object that was made here"),
    ] {
        let error = kept(assignment);
        assert!(without_columns(&error).starts_with("error: s.lua:4: "), "{assignment}: {error}");
        assert!(error.contains(what) && error.contains("help: "), "{assignment}: {error}");
    }
    insta::assert_snapshot!(kept("self.pen = extruder()"), @r"
    error: s.lua:4:10: rule A (interpretation): lamp: unknown state variable `pen`
      | self.pen = extruder()
      |      ^^^
      module: A, step 0
      help: declare the child object: state = { pen = extruder() }, and call its methods: self.pen:...
    ");
    insta::assert_snapshot!(kept("self.n = f"), @r"
    error: s.lua:4:10: rule A (interpretation): n of the state of lamp cannot be a function
      | self.n = f
      |      ^
      module: A, step 0
      help: a state variable is a number, a boolean, a string, a table of these, or an object
    ");
    insta::assert_snapshot!(kept("self.n = extruder() self.n:extrude(1)"), @r"
    error: s.lua:4:32: rule A (interpretation): extruder:extrude changes an object that was made here, and nothing is drawn with it
      | self.n = extruder() self.n:extrude(1)
      |                            ^^^^^^^
      module: A, step 0
      help: let the type hold one from the beginning: state = { pen = extruder() }, and call self.pen:extrude(1)
    ");
    // Valid values are accepted, and other tables named self are not affected.
    let script = "local lamp = object(\"lamp\", { extends = extruder, state = { n = 0, list = {} }, reads = { all = function(self) return self.n + #self.list end },\n\
        changes = { go = function(self) self.n = math.max(3, 2) self.list = { 1, { 2 } } self.list[3] = vec(1, 2) end } })\n\
        local Class = {} function Class.new() local self = {} self.f = function() return 4 end return self end\n\
        local A = module(\"A\")\nlocal s = lsystem({ object = lamp() })\ns:axiom(A())\n\
        s:interpret(\"A\", function(this) this:go():extrude(Class.new().f()) end)\nprint(s:derive().objects[1]:all())\n";
    assert_eq!(crate::packages::prints(&Folder::new().with("s.lua", script), &[]), "6\n");
}
