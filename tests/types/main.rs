//! Script-declared object types while chains are drawn. `tests/kind` tests requirements on types from all
//! origins.

#![allow(clippy::unwrap_used, reason = "a test stops at what is wrong")]

mod held;
mod meshes;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use burgeon::kit::declare::as_ref;
use burgeon::kit::{ScriptObject, Value};
use burgeon::picture::Picture;
use burgeon::script::{RunOptions, RunReports};
use burgeon::trace::{Pick, pick};
use burgeon::{Run, export};

/// Returns the scripts in `examples/types`, each of which declares a type.
fn examples() -> Vec<PathBuf> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("examples/types");
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|it| it.unwrap().path()).collect();
    paths.sort();
    assert!(paths.len() >= 4, "{paths:?}");
    paths
}

fn options(threads: usize) -> RunOptions {
    RunOptions { threads: Some(threads), batch: 8, ..burgeon::options() }
}

fn run(script: &Path, threads: usize) -> Run {
    burgeon::run(script, options(threads)).unwrap_or_else(|error| panic!("{}: {error}", script.display()))
}

/// Returns a script in a temporary folder, next to the features of `field.geojson`.
fn script(text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let points = (0..200).map(|number| {
        let east = 2.0 + f64::from(number % 20) * 3e-4;
        let north = 48.0 + f64::from(number / 20) * 2e-4;
        format!(
            r#"{{"type":"Feature","id":"{number}","properties":{{"n":{number}}},
               "geometry":{{"type":"Point","coordinates":[{east},{north}]}}}}"#
        )
    });
    let points = points.collect::<Vec<_>>().join(",");
    let field = format!(r#"{{"type":"FeatureCollection","features":[{points}]}}"#);
    std::fs::write(folder.path().join("field.geojson"), field).unwrap();
    let path = folder.path().join("s.lua");
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

/// Returns the output of the run, line by line.
fn printed(text: &str, threads: usize) -> Vec<String> {
    let (_folder, path) = script(text);
    let lines = Arc::new(std::sync::Mutex::new(Vec::new()));
    let into = Arc::clone(&lines);
    let print = burgeon::script::Print::new(move |line: &str| into.lock().unwrap().push(line.to_owned()));
    let reports = RunReports { print: Some(print), ..RunReports::default() };
    burgeon::run(&path, RunOptions { reports, ..options(threads) }).unwrap();
    std::mem::take(&mut *lines.lock().unwrap())
}

fn glb(run: &Run) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.glb");
    export::write(&run.scene, &path, &Picture::default()).unwrap();
    std::fs::read(path).unwrap()
}

/// Returns the number of edges that do not belong to exactly two faces; points nearer than 1 nm are equal.
fn open_edges(run: &Run) -> usize {
    let mut edges: BTreeMap<[[i64; 3]; 2], i32> = BTreeMap::new();
    for mesh in &run.scene.meshes {
        for part in &mesh.parts {
            #[allow(clippy::cast_possible_truncation, reason = "models are small")]
            let at =
                |corner: u32| part.positions[corner as usize].to_array().map(|x| (f64::from(x) * 1e5) as i64);
            for corners in part.triangles.iter() {
                for side in 0..3 {
                    let (a, b) = (at(corners[side]), at(corners[(side + 1) % 3]));
                    let (key, turn) = if a < b { ([a, b], 1) } else { ([b, a], -1) };
                    *edges.entry(key).or_default() += turn;
                }
            }
        }
    }
    edges.values().filter(|turns| **turns != 0).count()
}

#[test]
fn every_example_gives_a_closed_model_and_the_same_for_any_number_of_threads() {
    for path in examples() {
        let one = run(&path, 1);
        assert!(one.scene.triangles() > 500, "{}: {} triangles", path.display(), one.scene.triangles());
        assert!(one.warnings.is_empty(), "{}: {:?}", path.display(), one.warnings);
        let open = open_edges(&one);
        assert!(open == 0 || path.ends_with("timber.lua"), "{}: {open} open edges", path.display());
        let bytes = glb(&one);
        for threads in [2, 7] {
            assert!(glb(&run(&path, threads)) == bytes, "{} with {threads} threads", path.display());
        }
    }
}

#[test]
fn a_triangle_names_the_module_that_drew_it_with_the_object_that_is_held() {
    let path = examples().into_iter().find(|path| path.ends_with("stair.lua")).unwrap();
    let run = run(&path, 1);
    let mut modules = BTreeMap::new();
    for (part, mesh) in run.scene.meshes[0].parts.iter().enumerate() {
        for triangle in (0..mesh.triangles.len()).step_by(211) {
            let picked = pick(&path, &options(1), &run.scene, Pick { instance: 0, part, triangle }).unwrap();
            let drawn = picked.drawn.and_then(|drawn| drawn.interpretation).map(|rule| rule.text.to_string());
            *modules.entry(drawn.unwrap_or_default()).or_insert(0) += 1;
        }
    }
    assert!(modules["Step"] > 8, "{modules:?}");
}

const COUNTERS: &str = r#"
local counter = object("counter", {
  fields = { start = { type = "number" } },
  state = { n = 0, log = {} },
  reads = {
    total = function(self) return self.start + self.n end,
    at = function(self, index) return self.log[index] or -1 end,
  },
  changes = { add = function(self, x) self.n += x table.insert(self.log, x) end },
})
local A = module("A", "x")
local s = lsystem({ object = counter({ start = 0 }) })
s:axiom(source("field.geojson"), function(feature) return counter({ start = feature.n }), A(feature.n) end)
s:rule("A(x)", function(this, x) return A(x + this:total()), { A(this:at(1)) } end)
s:interpret("A(x)", function(this, x) this:add(x) end)
local derived = s:derive(3)
local sum = 0
for index, object in derived.objects do
  sum += object:total() * index
end
print(sum, derived.objects[3]:total(), derived.objects[3].start, derived.objects[3].log[2])
for _, chain in derived.chains do
  print(chain)
end
"#;

#[test]
fn each_chain_has_a_state_of_its_own_which_rules_read_as_the_last_pass_left_it() {
    let one = printed(COUNTERS, 1);
    // Feature 2 begins with A(2). Each step adds the sum of the previous pass, and stores the first value.
    let (mut chain, start) = (vec![2.0], 2.0);
    for _ in 0..3 {
        let (total, first) = (start + chain.iter().sum::<f64>(), chain[0]);
        chain = chain.iter().flat_map(|x| [x + total, first]).collect();
    }
    let total = start + chain.iter().sum::<f64>();
    let [_, of_three, began, second] = one[0].split('\t').collect::<Vec<_>>()[..] else {
        panic!("{}", one[0])
    };
    assert_eq!((of_three.parse(), began, second.parse()), (Ok(total), "2", Ok(chain[1])));
    assert_eq!(one.len(), 201);
    for threads in [2, 7] {
        assert_eq!(printed(COUNTERS, threads), one, "{threads} threads");
    }
}

#[test]
fn hooks_run_around_chains_and_branches() {
    let text = r#"
local log = object("log", {
  state = { text = "", depth = 0 },
  reads = { text = function(self) return self.text end },
  begin = function(self) self.text ..= "<" end,
  push = function(self) self.depth += 1 self.text ..= "[" .. self.depth end,
  pop = function(self) self.text ..= self.depth .. "]" self.depth -= 1 end,
  finish = function(self) self.text ..= ">" end,
  changes = { write = function(self, x) self.text ..= x end },
})
local A = module("A", "x")
local s = lsystem({ object = log })
s:axiom(A("a"), { A("b"), { A("c") } }, A("d"), {})
s:interpret("A(x)", function(this, x) this:write(x) end)
local derived = s:derive(2)
print(derived.objects[1]:text())
"#;
    assert_eq!(printed(text, 1), ["<a[1b[2c2]1]d[11]>"]);
}

#[test]
fn a_type_extends_a_type_of_a_script_and_overrides_what_that_does() {
    let text = r#"
local one = object("one", {
  extends = turtle,
  fields = { k = 1 },
  state = { n = 0 },
  reads = { count = function(self) return self.n end },
  changes = { go = function(self) self.n += self.k self:forward(1) end, back = function(self) return self:turn_around() end },
})
local two = object("two", {
  extends = one,
  fields = { k = 2 },
  state = { m = 5 },
  changes = { go = function(self) self.n += self.k self.m += 1 self:forward(2):back() end },
})
local A = module("A")
local s = lsystem({ object = two({ width = 0.5 }) })
s:axiom(A(), F(3), A())
s:interpret("A", function(this) this:go() end)
local object = s:derive(0).objects[1]
print(object:count(), object.m, object:position().z, tostring(object))
"#;
    // Two forward and turn around; then three back down; then two further down, and turn around.
    assert_eq!(printed(text, 1), ["4\t7\t-3\ttwo"]);
}

#[test]
fn extending_a_type_adds_methods_for_rules_and_for_interpretations() {
    let text = r#"
extend(extruder, {
  reads = { high = function(self) return self:position().z end },
  changes = { up = function(self, n) self:extrude(n) end },
})
local A, Top = module("A"), module("Top")
local s = lsystem({ object = extruder() })
s:axiom(A(), Top())
s:rule("Top", function(this)
  if this:high() < 5 then
    return A(), Top()
  end
end)
s:interpret("A", function(this)
  this:up(1):up(1)
end)
local derived = s:derive(9)
print(derived.modules, derived.objects[1]:high())
"#;
    assert_eq!(printed(text, 1), ["4\t6"]);
}

#[test]
fn an_object_whose_data_is_at_fault_is_left_out_and_the_others_stand() {
    let text = r#"
local post = object("post", {
  extends = extruder,
  fields = { n = { type = "number" } },
  state = { length = 0 },
  changes = { raise = function(self)
    if self.n % 10 == 3 then
      self:extrude(nil + 1)
    end
    self:extrude(1 + self.n)
    self.length += 1
  end },
})
local Post = module("Post")
local s = lsystem({ object = post({ n = 0 }) })
s:axiom(source("field.geojson"), function(feature)
  return post({ n = feature.n, position = feature.geometry.points[1] }), Post(), Post()
end)
s:interpret("Post", function(this) this:raise() end)
s:derive(0)
"#;
    let (_folder, path) = script(text);
    let bytes: Vec<Vec<u8>> = [1, 2, 7]
        .into_iter()
        .map(|threads| {
            let run = run(&path, threads);
            assert_eq!(run.scene.instances.len(), 180, "{threads} threads");
            let lengths =
                run.systems[0].objects.iter().filter_map(|object| as_ref::<ScriptObject>(&**object));
            let whole = lengths.filter(|object| object.state().get("length") == Some(&Value::Number(2.0)));
            assert_eq!(whole.count(), 180);
            glb(&run)
        })
        .collect();
    assert!(bytes.windows(2).all(|pair| pair[0] == pair[1]));
}

#[test]
fn hooks_draw_random_numbers_of_their_own() {
    let text = r#"
local die = object("die", {
  state = { thrown = {}, n = 0 },
  begin = function(self) table.insert(self.thrown, random()) end,
  push = function(self) table.insert(self.thrown, random()) end,
  pop = function(self) table.insert(self.thrown, random()) end,
  finish = function(self) table.insert(self.thrown, random()) end,
  reads = { thrown = function(self) return self.thrown end },
  changes = { throw = function(self) table.insert(self.thrown, random()) end },
})
local A = module("A")
local s = lsystem({ object = die })
s:axiom(source("field.geojson"), function(feature) return A(), { A(), { A() }, {} } end)
s:rule("A", function() return A(), { A() } end)
s:interpret("A", function(this) this:throw() end)
for _, object in s:derive(1).objects do
  for _, number in object:thrown() do
    print(number)
  end
end
"#;
    let one = printed(text, 1);
    assert_eq!(
        one.len(),
        200 * (1 + 6 + 2 * 6 + 1),
        "each chain begins, ends, and has six modules and six branches"
    );
    let different: std::collections::BTreeSet<&String> = one.iter().collect();
    assert_eq!(different.len(), one.len(), "no number twice");
    for threads in [2, 7] {
        assert!(printed(text, threads) == one, "{threads} threads");
    }
}

#[test]
fn a_type_draws_less_in_lower_levels_of_detail_and_notes_what_it_left_out() {
    let text = r#"
local post = object("post", {
  extends = extruder,
  state = { inner = object("cap", { changes = { cap = function(self) self:note("no cap", "the space is too small") end } })() },
  changes = { raise = function(self)
    if self:detail() < 2 then
      self:note("a plain post", `detail {self:detail()}`)
      self.inner:cap()
    end
    self:regular(if self:detail() < 2 then 4 else 32):extrude(3)
  end },
})
local A = module("A")
local s = lsystem({ object = post })
s:axiom(source("field.geojson"), function(feature) return post({ position = feature.geometry.points[1] }), A() end)
s:interpret("A", function(this) this:raise() end)
s:derive()
"#;
    let (_folder, path) = script(text);
    let run = |lod: u8| burgeon::run(&path, RunOptions { lod, ..options(2) }).unwrap();
    let (whole, less) = (run(3), run(1));
    assert!(less.scene.triangles() * 5 < whole.scene.triangles());
    assert_eq!(format!("{:?}", whole.report()).matches("a plain post").count(), 0);
    let said = format!("{:?}", less.report());
    assert!(said.contains("a plain post") && said.contains("detail 1") && said.contains("no cap"), "{said}");
}

#[test]
fn an_object_is_placed_as_a_prototype_without_a_system_of_its_own() {
    let text = r#"
        local lantern = object("lantern", {
          extends = extruder,
          fields = { height = { default = 4 } },
          begin = function(self) self:extrude(self.height) end,
        })
        local lamps = { prototype(lantern({ height = 5, sides = 6 })), prototype(lantern({ sides = 6 })) }
        local Post = module("Post", "x", "kind")
        local street = lsystem({ object = extruder() })
        street:axiom({ Post(0, 1) }, { Post(10, 2) }, { Post(20, 1) })
        street:interpret("Post(x, kind)", function(this, x, kind) this:jump({ x, 0, 0 }):place(lamps[kind]) end)
        street:derive()
        print(lamps[1].modules, lamps[1].steps)
    "#;
    for threads in [1, 2] {
        let (_folder, path) = script(text);
        let made = run(&path, threads).scene;
        assert_eq!((made.instances.len(), made.meshes.len()), (3, 2));
        assert_eq!(printed(text, threads), ["0\t0"]);
    }
    let (_folder, path) = script("prototype(3)");
    let error = burgeon::run(&path, options(1)).map(|_| ()).unwrap_err();
    assert!(error.message().contains("object"), "{error}");
}
