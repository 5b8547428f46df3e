//! Tests that all memory that a script can fill counts towards `--memory-limit`.

use std::process::{Command, Stdio};
use std::time::Duration;

use crate::support::{Folder, assert_decent};

/// Store of a run whose size a script controls, as listed in the book, with a script that lets it grow
/// without end.
struct Store {
    name: &'static str,
    script: &'static str,
    arguments: &'static [&'static str],
}

/// Modules, and a system that draws with a turtle, in two lines.
const HEAD: &str = "local A, B = module(\"A\", \"x\"), module(\"B\", \"x\")\nlocal s = lsystem({ object = turtle() }) s:axiom(A(1))\n";

const fn store(name: &'static str, script: &'static str) -> Store {
    Store { name, script, arguments: &[] }
}

/// Stores; a table in the book lists the same.
const STORES: &[Store] = &[
    store("tables of Lua", "local t = {} while true do table.insert(t, { #t }) end"),
    store("strings of Lua", "local t = \"a\" while true do t = t .. t end"),
    store("buffers of Lua", "local t = {} while true do table.insert(t, buffer.create(100000)) end"),
    store(
        "functions and coroutines",
        "local t = {} while true do table.insert(t, coroutine.create(function() return t end)) end",
    ),
    Store {
        name: "virtual machines of all threads",
        script: "local all = string.rep(\"x\", 3e7)\ns:rule(\"A(x)\", function(this, x) return A(x + #all), A(x) end)\ns:derive(30)",
        arguments: &["--threads", "6", "--batch", "16"],
    },
    store(
        "values made in rules",
        "s:rule(\"A(x)\", function(this, x) local t = {} while true do table.insert(t, { x }) end end)\ns:derive(1)",
    ),
    store("modules of chains", "s:rule(\"A(x)\", function(this, x) return A(x), A(x + 1) end)\ns:derive()"),
    store(
        "strings in modules",
        "s:rule(\"A(x)\", function(this, x) return A(string.rep(\"x\", 5000) .. random()), A(x) end)\ns:derive()",
    ),
    store(
        "tables in modules",
        "s:rule(\"A(x)\", function(this, x)\n  local t = table.create(300, random()) t[1] = x return A(t), A(t)\nend)\ns:derive()",
    ),
    store(
        "chains and objects of features",
        "local list = {} for i = 1, 200000 do list[i] = { id = i } end\ns:axiom(source(list), function(feature) return A(1) end)\ns:rule(\"A(x)\", function(this, x) return A(x), B(x) end)\ns:derive()",
    ),
    store(
        "lists as sources",
        "local all = {} while true do local list = {} for i = 1, 1000 do list[i] = { id = i, name = \"n\" .. i } end table.insert(all, source(list)) end",
    ),
    store(
        "module tables",
        "local text = string.rep(\"x\", 2000)\ns:rule(\"A(x)\", function(this, x)\n  query(\"select count(*) as n from A\")\n  return A(x), A(text)\nend)\ns:derive()",
    ),
    store(
        "surfaces",
        "s:interpret(\"A(x)\", function(this, x) while true do this:forward(1):turn(7) end end)\ns:derive(1)",
    ),
    store(
        "surfaces of modules",
        "s:rule(\"A(x)\", function(this, x) return A(x), A(x), Turn(7), F(1) end)\ns:derive()",
    ),
    store(
        "faces of meshes in buffers",
        "s:interpret(\"A(x)\", function(this, x)\n  local points, faces = buffer.create(36), buffer.create(12e6) buffer.writef32(points, 12, 1) buffer.writef32(points, 28, 1)\n  for i = 0, 12e6 - 12, 12 do buffer.writeu32(faces, i + 4, 1) buffer.writeu32(faces, i + 8, 2) end\n  while true do this:mesh(points, faces) end\nend)\ns:derive(1)",
    ),
    store(
        "faces of meshes in lists",
        "local points, faces = {}, {} for i = 1, 60000 do points[i] = { i, i * i % 7, i * i % 11 } faces[i] = { i, i % 60000 + 1, (i + 1) % 60000 + 1 } end\ns:interpret(\"A(x)\", function(this, x) while true do this:mesh(points, faces) end end)\ns:derive(1)",
    ),
    store(
        "placed models",
        "local stone = lsystem({ object = extruder() }) stone:axiom(A(1)) stone:interpret(\"A(x)\", function(this) this:extrude(1) end)\nlocal model = stone:derive()\ns:interpret(\"A(x)\", function(this, x) while true do this:jump({ 1, 0, 0 }):place(model) end end)\ns:derive(1)",
    ),
    store(
        "nested models",
        "local last\nfor i = 1, 100000 do\n  local model = last\n  local next = lsystem({ object = turtle() }) next:axiom(A(1))\n  next:interpret(\"A(x)\", function(this) this:forward(1) if model then this:place(model):jump({ 1, 0, 0 }):place(model) end end)\n  last = next:derive()\nend",
    ),
    store(
        "report entries of objects",
        "local lamp = object(\"lamp\", { changes = { go = function(self, n) self:note(string.rep(\"x\", 1000) .. n) end } })\nlocal list = {} for i = 1, 2000 do list[i] = { id = i } end\nlocal l = lsystem({ object = lamp() })\nl:axiom(source(list), function() return lamp(), A(1) end)\nl:interpret(\"A(x)\", function(this, x) for i = 1, 1000 do this:go(i) end end)\nl:derive(1)",
    ),
    store(
        "reports",
        "s:interpret(\"A(x)\", function(this, x) local n = 0 while true do n += 1 report(string.rep(\"x\", 1000) .. n, 1) end end)\ns:derive(0)",
    ),
    store(
        "state of custom types",
        "local lamp = object(\"lamp\", { state = { text = \"\" }, changes = { go = function(self, n) self.text = string.rep(\"x\", 100000) .. n end } })\nlocal list = {} for i = 1, 15000 do list[i] = { id = i } end\nlocal l = lsystem({ object = lamp() })\nl:axiom(source(list), function(feature) return lamp(), A(feature.id) end)\nl:interpret(\"A(x)\", function(this, x) this:go(x) end)\nl:derive(1)",
    ),
    store(
        "child objects",
        "local lamp = object(\"lamp\", { state = { pen = extruder() }, changes = { go = function(self) for i = 1, 1000 do self.pen:extrude(1):roll(9) end end } })\nlocal list = {} for i = 1, 15000 do list[i] = { id = i } end\nlocal l = lsystem({ object = lamp() })\nl:axiom(source(list), function(feature) return lamp(), A(feature.id) end)\nl:interpret(\"A(x)\", function(this, x) this:go() end)\nl:derive(1)",
    ),
    store(
        "script parameters",
        "for i = 1, 1e7 do param(\"p\" .. i, { default = string.rep(\"x\", 1000) .. i }) end",
    ),
    store("systems", "while true do local t = lsystem({ object = turtle() }) t:axiom(A(1)) end"),
    store(
        "rules",
        "while true do local t = lsystem() t:axiom(A(1)) for i = 1, 60000 do t:rule(\"A(x)\", function(this, x) return A(x + i) end) end end",
    ),
    store(
        "object types",
        "for i = 1, 1e7 do object(\"type\" .. i, { doc = string.rep(\"x\", 10000) .. i, changes = { go = function(self) end } }) end",
    ),
    store(
        "objects in tables",
        "local t = {} while true do table.insert(t, footprint({ { 0, 0 }, { 10, 0 }, { 10, 8 }, { 0, 8 } })) end",
    ),
    store(
        "geometries in tables",
        "local t, g = {}, polygon({ { 0, 0 }, { 10, 0 }, { 10, 8 }, { 0, 8 } }) while true do table.insert(t, g:buffer(1 + #t)) end",
    ),
    store(
        "results of methods",
        "local n = universe({ seed = 3 }) local t = {} for i = 1, 1e9 do t[i] = n:galaxy(i, 0, 0) or i end",
    ),
    store(
        "street networks",
        "local list = {} for i = 1, 30000 do list[i] = { id = i } end\nlocal n = lsystem({ object = network() }) n:axiom(source(list), function() return network(), A(1) end)\nn:interpret(\"A(x)\", function(this, x) for i = 1, 12 do this:grow(1, i * 30, 50, 1) end end)\nn:derive(1)",
    ),
    store(
        "terrain",
        "local hills = { A = { \"A\", \"A\", \"A\", \"A\", change = { 0.2, -0.1, 0.1, -0.2 }, decay = 0.5 } }\nlocal land = lsystem({ object = terrain({ size = 4096, levels = 13, rules = hills, covers = { { color = \"#5b7a3a\" } } }) })\nland:derive()",
    ),
    store(
        "rules of sub-systems",
        "for i = 1, 3000 do module(\"O\" .. i) end\nfor i = 1, 3000 do s:subsystem(\"O\" .. i, lsystem({ object = turtle() })) end\ns:derive(1)",
    ),
    store(
        "terrain edits",
        "local hills = { A = { \"A\", \"A\", \"A\", \"A\", change = { 0.12, -0.06, 0.06, -0.12 }, decay = 0.55 } }\nlocal l = lsystem({ object = terrain({ size = 512, levels = 5, rules = hills, covers = { { color = \"#7d8f5a\" } } }) }) l:axiom(A(1))\nl:interpret(\"A(x)\", function(this, x) for i = 1, 1e7 do local p = {} for k = 1, 200 do p[k] = { k, i % 100 } end this:dig(p, 2, 1) end end)\nl:derive(1)",
    ),
    store(
        "indexes of lines",
        "local t = {} while true do local lines = {} for i = 1, 200 do lines[i] = { { i, 0 }, { i, 9 } } end table.insert(t, streets(lines)) end",
    ),
    store(
        "text of chains",
        "s:rule(\"A(x)\", function(this, x) return A(x + 0.123), A(x + 0.321) end)\nlocal d = s:derive(17)\nlocal t = {} for i = 1, 1000 do t[i] = s:derive(17).chains end",
    ),
    store("script files", "require(\"large\")"),
    store("printed strings", "print(string.rep(\"x\", 50e6))"),
    store("warnings of scripts", "local i = 0 while true do i += 1 warn(string.rep(\"x\", 1000) .. i) end"),
    store(
        "error messages",
        "local t = {} for i = 1, 5 do t[i] = string.rep(\"x\", 3e6) .. i end while true do local ok, e = pcall(error, t[1]) t[#t + 1] = e .. #t end",
    ),
];

/// Runs the program under a memory limit (MB). Returns its status, its output, and the maximum resident
/// memory (MB) that the system reports during the run.
fn run(folder: &Folder, arguments: &[&str], limit: usize) -> (i32, String, usize) {
    let limit = limit.to_string();
    let mut child = Command::new(env!("CARGO_BIN_EXE_burgeon"))
        .args(["run", "s.lua", "--time-limit", "120", "--memory-limit", &limit])
        .args(arguments)
        // The allocator returns free memory at once, not after a delay that depends on the load of the machine.
        .env("MIMALLOC_PURGE_DELAY", "0")
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(std::fs::File::create(folder.path().join("told")).unwrap())
        .spawn()
        .unwrap();
    let (path, mut peak) = (format!("/proc/{}/status", child.id()), 0);
    let status = loop {
        let status = std::fs::read_to_string(&path).unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<usize>().ok());
        peak = peak.max(kilobytes.unwrap_or(0) / 1000);
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        std::thread::sleep(Duration::from_millis(1));
    };
    let told = String::from_utf8_lossy(&std::fs::read(folder.path().join("told")).unwrap()).into_owned();
    (status.code().unwrap_or(-1), told, peak)
}

/// Maximum ratio of used memory to the limit: memory can be allocated before the run notices.
const OVER: f64 = 1.3;
/// Memory limit (MB) of these runs.
const LIMIT: usize = 64;

#[test]
fn every_store_that_a_script_grows_ends_at_the_memory_limit() {
    let empty = Folder::new().with("s.lua", format!("{HEAD}s:derive(1)\n"));
    let (code, told, base) = run(&empty, &[], LIMIT);
    assert_eq!(code, 0, "{told}");
    let mut wrong = String::new();
    let only = std::env::var("BURGEON_STORE").unwrap_or_default();
    for store in STORES.iter().filter(|store| store.name.contains(&only)) {
        let folder = Folder::new()
            .with("s.lua", format!("{HEAD}{}\n", store.script))
            .with("large.lua", "local x = { 1, 2, 3 }\n".repeat(100_000));
        let begin = std::time::Instant::now();
        #[allow(clippy::cast_precision_loss, reason = "megabytes")]
        let is_over = |peak: usize| peak as f64 > base as f64 + OVER * LIMIT as f64;
        let (code, told, peak) = run(&folder, store.arguments, LIMIT);
        let shown: String = told.chars().take(600).collect();
        eprintln!("{}: {peak} MB, {base} without, {:.1} s", store.name, begin.elapsed().as_secs_f64());
        let is_told = told.starts_with("error: ")
            && told.contains("memory limit of 64 MB")
            && told.contains("--memory-limit");
        if code != 1 || !is_told || is_over(peak) {
            wrong += &format!("\n{}: status {code}, {peak} MB, {base} without: {shown}", store.name);
        } else {
            assert_decent(&told);
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn the_book_lists_the_stores() {
    let page =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/book/src/security.md")).unwrap();
    let rows = page.split("## Memory").nth(1).unwrap().lines().filter_map(|line| line.strip_prefix("| "));
    let listed: Vec<&str> = rows.skip(2).map(|row| row.split(" |").next().unwrap()).collect();
    let names: Vec<&str> = STORES.iter().map(|store| store.name).collect();
    assert_eq!(listed, names);
}
