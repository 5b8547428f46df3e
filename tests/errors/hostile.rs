//! Hostile scripts that use objects, custom types and packages, and the limits that stop them.

use std::fmt::Write as _;
use std::time::{Duration, Instant};

use super::support::Folder;

/// Returns a script with this interpretation and these functions of a custom type.
fn drawn(extends: &str, body: &str, functions: &str) -> String {
    format!(
        "local A = module(\"A\")\nlocal own = object(\"own\", {{ extends = {extends}, state = {{ n = 0, list = {{}}, held = extruder() }}, {functions} }})\n\
         local s = lsystem({{ object = own }})\ns:axiom(A(), A())\ns:interpret(\"A\", function(this)\n  {body}\nend)\ns:derive()\n"
    )
}

/// Returns the error message for a script that must be cancelled within its limits.
fn stopped(script: &str) -> String {
    stopped_within(script, "20")
}

fn stopped_within(script: &str, seconds: &str) -> String {
    let begin = Instant::now();
    let flags =
        ["run", "s.lua", "--time-limit", seconds, "--memory-limit", "64", "--triangle-limit", "200000"];
    let said = Folder::new().with("s.lua", script).burgeon(&flags);
    assert!(begin.elapsed() < Duration::from_secs(40), "{script}: {:?}", begin.elapsed());
    said.failed()
}

#[test]
fn drawing_without_end_in_one_application_is_stopped_before_memory_is_full() {
    for (extends, body) in [
        ("turtle", "while true do this:sphere(1) end"),
        ("turtle", "while true do this:forward(1) end"),
        ("turtle", "while true do this:forward(1):turn(3):jump({ 1, 2, 3 }) end"),
        ("extruder", "while true do this:extrude(1) end"),
        ("extruder", "while true do this:extrude(1):turn(90) end"),
        (
            "extruder",
            "local b = buffer.create(12 * 3) buffer.writef32(b, 12, 1) buffer.writef32(b, 28, 1) local f = buffer.create(1200000) while true do this:mesh(b, f) end",
        ),
        ("extruder", "while true do this.held:extrude(1):turn(20) end"),
    ] {
        // Triangles without area are not counted, but their calls are.
        let script = drawn(extends, body, "");
        let text = stopped(&script);
        let is_limit =
            ["more than 200000 triangles", "calls more than 16777216 methods", "ran longer than", "time"];
        assert!(is_limit.iter().any(|limit| text.contains(limit)), "{body}: {text}");
        if !body.contains("mesh") {
            assert!(text.contains("more than 200000 triangles"), "{body}: {text}");
        }
    }
}

#[test]
fn what_is_kept_and_drawn_later_is_bounded_too() {
    for body in [
        "this:begin_polygon() while true do this:point() end",
        "while true do this:begin_polygon() end",
        "while true do this:note(\"more\") end",
    ] {
        let text = stopped_within(&drawn("turtle", body, ""), "4");
        let is_limit = ["calls more than 16777216 methods", "time", "memory limit of 64 MB"];
        let is_limit = is_limit.iter().any(|limit| text.contains(limit));
        assert!(is_limit, "{body}: {text}");
    }
}

#[test]
fn functions_of_types_end_like_all_others() {
    let forever = "while true do end";
    for (body, functions) in [
        ("this:go()", "changes = { go = function(self) WHAT end }"),
        ("this:go()", "reads = { go = function(self) WHAT end }"),
        ("", "begin = function(self) WHAT end"),
        ("", "finish = function(self) WHAT end"),
        (
            "this:go()",
            "changes = { go = function(self) pcall(function() WHAT end) while true do self.n += 1 end end }",
        ),
        ("this:go()", "changes = { go = function(self) coroutine.wrap(function() WHAT end)() end }"),
        (
            "this:go()",
            "changes = { go = function(self) for _ in setmetatable({}, { __iter = function() WHAT end }) do end end }",
        ),
        (
            "this:go()",
            "changes = { go = function(self) error(setmetatable({}, { __tostring = function() WHAT end })) end }",
        ),
        (
            "this:go()",
            "changes = { go = function(self) print(setmetatable({}, { __tostring = function() WHAT end })) end }",
        ),
        (
            "this:go()",
            "changes = { go = function(self) self.list = setmetatable({}, { __len = function() WHAT end }) return #self.list end }",
        ),
        ("this:as(setmetatable({}, { __call = function() WHAT end }))", ""),
    ] {
        let script = drawn("extruder", body, functions).replace("WHAT", forever);
        let text = stopped_within(&script, "2");
        let decent = text.contains("time")
            || text.contains("as takes the constructor")
            || text.contains("out of the limit");
        assert!(decent, "{body} {functions}: {text}");
    }
}

#[test]
fn memory_bombs_in_functions_of_types_and_in_buffers_are_stopped() {
    for bomb in [
        "local t = {} while true do t[#t + 1] = string.rep(\"x\", 1000) .. #t end",
        "self.list = {} while true do table.insert(self.list, {}) end",
        "local t = {} while true do t[#t + 1] = buffer.create(10000000) end",
        "buffer.create(1073741824)",
        "local s = \"x\" while true do s ..= s end",
        "table.create(100000000, 0)",
    ] {
        let text = stopped(&drawn(
            "extruder",
            "this:go()",
            &format!("changes = {{ go = function(self) {bomb} end }}"),
        ));
        assert!(text.contains("memory") || text.contains("table overflow"), "{bomb}: {text}");
    }
}

#[test]
fn nothing_that_remembers_gets_into_the_state_or_the_fields() {
    for (body, functions, said) in [
        (
            "this:go()",
            "changes = { go = function(self) self.n = buffer.create(8) end }",
            "n of the state of own cannot be a buffer",
        ),
        (
            "this:go()",
            "changes = { go = function(self) self.list[1] = buffer.create(8) end }",
            "list of the state of own cannot hold a buffer",
        ),
        (
            "this:go()",
            "changes = { go = function(self) self.n = coroutine.create(print) end }",
            "n of the state of own cannot be a thread",
        ),
        (
            "this:go()",
            "changes = { go = function(self) self.n = self.held end }",
            "n of the state has an unsupported value: a table with a metatable cannot be passed on",
        ),
        (
            "this:go()",
            "changes = { go = function(self) self.held = nil end }",
            "held of own is an object, which nothing replaces",
        ),
        (
            "this:go()",
            "changes = { go = function(self) setmetatable(self, {}) end }",
            "cannot change a protected metatable",
        ),
        (
            "this:go()",
            "changes = { go = function(self) getmetatable(self).__index = 3 end }",
            "attempt to index string with '__index'",
        ),
        ("this.extrude = 3", "", "this.extrude is assigned"),
        ("rawset(this, \"extrude\", 3)", "", "readonly"),
        ("rawset(getmetatable(\"\"), \"x\", 3)", "", "table"),
        ("this:extrude(buffer.create(8))", "", "argument 1 must be a number, not a buffer"),
        ("this:polygon(buffer.create(8))", "", "a line or a polygon, not a buffer"),
    ] {
        let text = stopped(&drawn("extruder", body, functions));
        assert!(text.contains(said), "{body} {functions}: {text}");
    }
    let text =
        stopped("object(\"own\", { fields = { data = { type = \"any\" } } })({ data = buffer.create(8) })");
    assert!(text.contains("a buffer cannot be passed on"), "{text}");
    let text = stopped("object(\"own\", { state = { data = buffer.create(8) } })");
    assert!(text.contains("data of the state of own: a buffer cannot be passed on"), "{text}");
}

#[test]
fn a_method_of_one_type_is_no_method_of_another() {
    let text = |body: &str| {
        format!(
            "local A = module(\"A\")\nlocal other = extruder()\nlocal extrude, polygon, ask = other.extrude, other.polygon, other.open_edges\n\
             local s = lsystem({{ object = turtle }})\ns:axiom(A())\ns:interpret(\"A\", function(this)\n  {body}\nend)\ns:derive()\n"
        )
    };
    for body in ["extrude(this, 1)", "polygon(this, {})", "print(ask(this))"] {
        let said = stopped(&text(body));
        assert!(said.contains("is a method of another type than the object's, turtle"), "{body}: {said}");
    }
    let held = "local own = object(\"own\", { state = { one = turtle(), two = extruder() }, changes = { go = function(self)\n  self.one.forward(self.two, 1)\nend } })\n\
                local A = module(\"A\")\nlocal s = lsystem({ object = own })\ns:axiom(A())\ns:interpret(\"A\", function(this) this:go() end)\ns:derive()";
    assert!(stopped(held).contains("turtle:forward needs its object"));
}

#[test]
fn an_object_that_is_kept_is_of_no_use_later() {
    for (body, functions) in [
        (
            "local co = coroutine.wrap(function() this:go() end) co()",
            "changes = { go = function(self) coroutine.yield(self) self.n += 1 end }",
        ),
        ("this:go()", "changes = { go = function(self) table.insert(self.list, self) end }"),
        ("this:go()", "changes = { go = function(self) self.list = { function() self.n += 1 end } end }"),
        ("this:go()", "changes = { go = function(self) return coroutine.yield(1) end }"),
    ] {
        let said = Folder::new().with("s.lua", drawn("extruder", body, functions)).burgeon(&["run", "s.lua"]);
        assert!(said.status < 2 && !said.stderr.contains("panicked"), "{functions}: {}", said.stderr);
        if !body.contains("co()") {
            assert_eq!(said.status, 1, "{functions}: {}", said.stderr);
        }
    }
}

#[test]
fn types_hold_each_other_to_a_depth_and_not_in_crowds() {
    let nested = |depth: usize, width: usize| {
        let mut text = String::from("local t = object(\"t0\", { extends = extruder })\n");
        for level in 1..=depth {
            let held: Vec<String> = (0..width).map(|number| format!("h{number} = t()")).collect();
            // Writing to a string cannot fail.
            let _ = writeln!(text, "t = object(\"t{level}\", {{ state = {{ {} }} }})", held.join(", "));
        }
        text + "lsystem({ object = t }):axiom()\n"
    };
    let run = |text: String| Folder::new().with("s.lua", text).burgeon(&["run", "s.lua"]);
    assert_eq!(run(nested(8, 1)).status, 0);
    let deep = run(nested(9, 1)).failed();
    assert!(deep.contains("t9 has child objects nested more than 8 deep"), "{deep}");
    let many = run(nested(3, 5)).failed();
    assert!(many.contains("t3 has 155 child objects, counted recursively; the limit is 64"), "{many}");
    let own = Folder::new()
        .with("s.lua", "local own\nown = object(\"own\", { state = { inner = own() } })")
        .burgeon(&["run", "s.lua"]);
    assert!(own.failed().contains("attempt to call a nil value"));
}

#[test]
fn a_manifest_of_an_odd_shape_is_refused_with_its_line() {
    let good = "name = \"odd\"\nversion = \"1.0.0\"\napi = \"1.0\"\n";
    let long = format!("{good}doc = \"{}\"\n", "x".repeat(2_000_000));
    let deep = format!("{good}[depends]\nmasonry = {}{}\n", "[".repeat(2000), "]".repeat(2000));
    for manifest in [
        "",
        "name = \"odd\"",
        "name = 3\nversion = \"1.0.0\"\napi = \"1.0\"\n",
        "name = [\"odd\"]\nversion = \"1.0.0\"\napi = \"1.0\"\n",
        "name = \"../odd\"\nversion = \"1.0.0\"\napi = \"1.0\"\n",
        "name = \"o\\u001bdd\"\nversion = \"1.0.0\"\napi = \"1.0\"\n",
        "name = \"odd\"\nversion = \"one\"\napi = \"1.0\"\n",
        "name = \"odd\"\nversion = \"1.0.0\"\napi = \"1.0\"\n[depends]\nodd = \"*\"\n",
        "name = \"odd\"\nname = \"even\"\nversion = \"1.0.0\"\napi = \"1.0\"\n",
        "[[name]]\nx = 1\n",
        "name = \"odd\"\nversion = \"1.0.0\"\napi = \"1.0\"\ndepends = \"masonry\"\n",
        "name = \"odd\"\nversion = \"1.0.0\"\napi = \"1.0\"\n[replaces]\n\"@castle/../x.png\" = \"y.png\"\n",
        "name = \"odd\"\nversion = \"1.0.0\"\napi = \"1.0\"\n[replaces]\n\"@castle/x.png\" = \"../../y.png\"\n",
        "name = \"odd\"\nversion = \"1.0.0\"\napi = \"1.0\"\n[params.castle]\nx = { a = 1 }\n",
        &long,
        &deep,
    ] {
        let folder = Folder::new().with("s.lua", "require(\"@odd\")").with("mods/odd/mod.toml", manifest);
        let text = folder.burgeon(&["run", "s.lua"]).failed();
        assert!(text.contains("mod.toml"), "{manifest:.60}: {text}");
        assert!(!text.contains('\u{1b}') && text.len() < 4000, "{manifest:.60}: {text:.300}");
    }
    let folder = Folder::new()
        .with("s.lua", "print(1)")
        .with("odd.lua", "require(\"@odd\")")
        .with("even.lua", "require(\"@even\")")
        .with("mods/odd/mod.toml/x", "")
        .with("mods/even/mod.toml", [0xff, 0xfe, 0]);
    // Only the scripts that require these packages are affected.
    folder.burgeon(&["run", "s.lua"]).done();
    for (script, manifest) in [("odd.lua", "mods/odd/mod.toml"), ("even.lua", "mods/even/mod.toml")] {
        let text = folder.burgeon(&["run", script]).failed();
        assert!(text.contains(manifest), "{text}");
    }
}

#[cfg(unix)]
#[test]
fn a_manifest_that_is_no_file_is_not_waited_for() {
    let folder = Folder::new().with("s.lua", "require(\"@odd\")").with("mods/odd/init.lua", "");
    let pipe = folder.path().join("mods/odd/mod.toml");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let begin = Instant::now();
    let said = folder.burgeon(&["run", "s.lua"]);
    assert!(begin.elapsed() < Duration::from_secs(10), "it waits for the pipe");
    assert!(said.failed().contains("mods/odd/mod.toml"));
}
