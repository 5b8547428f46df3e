//! Object types of a program and of a script have the same capabilities and meet the same requirements as the
//! types of Burgeon.

#![allow(clippy::unwrap_used, reason = "a test stops at what is wrong")]
#![allow(unreachable_pub, reason = "what scripts can use is public")]

mod fuse;
mod joints;
mod orchard;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::Ordering;

use burgeon::Run;
use burgeon::kit::{Call, Construct, Kind, Registry, Table, TableKey, Value};
use burgeon::picture::Picture;
use burgeon::script::RunOptions;
use burgeon::trace::{Pick, pick};
use fuse::Fuse;
use orchard::{EXPANSIONS, LOOKED_FOR, Orchard};

/// Returns all types of Burgeon, and one external type.
fn registry() -> Registry {
    let mut registry = burgeon::registry();
    registry.add(Arc::clone(Orchard::kind())).unwrap();
    registry.add(Arc::clone(Fuse::kind())).unwrap();
    assert!(registry.add(Arc::clone(Orchard::kind())).is_err(), "the name is taken");
    assert!(registry.kinds().count() > 10);
    registry
}

/// Returns types of all origins: the types of the registry, and the types of the scripts in `examples/types`.
fn kinds() -> Vec<Arc<Kind>> {
    let mut kinds: Vec<Arc<Kind>> = registry().kinds().map(Arc::clone).collect();
    let (folder, mut scripts) = (Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/types"), 0);
    for entry in std::fs::read_dir(folder).unwrap() {
        let types = burgeon::check(&entry.unwrap().path(), burgeon::options()).unwrap().types;
        assert!(!types.is_empty());
        kinds.extend(types);
        scripts += 1;
    }
    assert!(scripts >= 4, "{scripts} scripts");
    kinds
}

/// Returns the types that are made from a table.
fn made_of_fields() -> Vec<Arc<Kind>> {
    let of_fields = |kind: &Arc<Kind>| matches!(kind.construct, Construct::Fields(_));
    kinds().into_iter().filter(of_fields).collect()
}

#[test]
fn what_scripts_can_do_with_a_type_is_documented() {
    for kind in kinds() {
        assert!(kind.doc.trim().ends_with('.'), "{}: {}", kind.name, kind.doc);
        for method in &kind.methods {
            assert!(method.doc.trim().ends_with('.'), "{}:{}", kind.name, method.name);
            assert!(method.arguments.iter().all(|argument| !argument.luau.is_empty()), "{}", method.name);
        }
        for field in &kind.fields {
            assert!(field.doc.trim().len() > 8 && !field.luau.is_empty(), "{}.{}", kind.name, field.name);
        }
    }
}

#[test]
fn a_constructor_refuses_an_unknown_field_and_names_the_nearest() {
    let mut refused = 0;
    for kind in made_of_fields() {
        let Some(field) = kind.fields.iter().max_by_key(|field| field.name.len()) else { continue };
        let misspelt = format!("{}x", field.name);
        let table =
            Table { class: None, entries: vec![(TableKey::Name(misspelt.as_str().into()), Value::Nil)] };
        let Err(error) = kind.make(&table) else { panic!("{} takes {misspelt}", kind.name) };
        let text = error.to_string();
        assert!(
            text.contains(&*kind.name) && text.contains(&format!("did you mean {}", field.name)),
            "{text}"
        );
        refused += 1;
    }
    assert!(refused > 9, "{refused}");
}

#[test]
fn what_begins_each_pass_empty_has_nothing_left_of_the_pass_before() {
    let (mut drawn, mut of_scripts) = (0, 0);
    for kind in made_of_fields().into_iter().filter(|kind| kind.begins_empty) {
        let Ok(mut object) = kind.make(&Table::default()) else { continue };
        object.begin();
        let fresh = object.triangles();
        for method in &kind.methods {
            let Call::Write { numbers: Some(call), .. } = &method.call else { continue };
            // Errors do not matter here.
            let _ = call(&mut *object, &vec![1.0; method.arguments.len()]);
        }
        let _ = object.end();
        drawn += usize::from(object.triangles() > fresh);
        of_scripts += usize::from(kind.script.is_some() && object.triangles() > fresh);
        object.begin();
        assert_eq!(object.triangles(), fresh, "{}", kind.name);
    }
    assert!(drawn > 2 && of_scripts > 0, "{drawn}, {of_scripts} of scripts");
}

const SCRIPT: &str = r#"
local land = source("land.geojson")
local Grow = module("Grow", "radius")
local orchards = lsystem({ object = orchard })
orchards:axiom(land, function(feature)
  return orchard(feature.geometry, { wells = land, spacing = 3 }), Grow(1)
end)
orchards:rule("Grow(r)", function(this, r)
  if this:trees() > 0 and this:nearest() < 1000 and this:wells() > 10 and r < 3 then return Grow(r + 1) end
end)
orchards:interpret("Grow(r)", function(this, r) this:crowns(r / 2) end)
orchards:derive()
"#;

/// Returns a folder with the script and its data, with enough fields that prefetching pays off.
fn folder() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let fields = (0..300).map(|number| {
        let (west, south) = (6.0 + f64::from(number % 20) * 4e-4, 45.0 + f64::from(number / 20) * 4e-4);
        let (east, north) = (west + 2e-4, south + 1e-4 + f64::from(number % 7) * 1e-5);
        format!(
            r#"{{"type":"Feature","id":{number},"properties":{{}},"geometry":{{"type":"Polygon","coordinates":
               [[[{west},{south}],[{east},{south}],[{east},{north}],[{west},{north}],[{west},{south}]]]}}}}"#
        )
    });
    let fields = fields.collect::<Vec<_>>().join(",");
    let land = format!(r#"{{"type":"FeatureCollection","features":[{fields}]}}"#);
    std::fs::write(folder.path().join("land.geojson"), land).unwrap();
    let script = folder.path().join("orchards.lua");
    std::fs::write(&script, SCRIPT).unwrap();
    (folder, script)
}

fn options(threads: usize) -> RunOptions {
    RunOptions { registry: registry(), threads: Some(threads), batch: 8, ..burgeon::options() }
}

#[test]
fn it_reads_a_layer_prefetches_gathers_expands_and_draws_the_same_for_any_number_of_threads() {
    let (folder, script) = folder();
    let bytes = |threads: usize| {
        let run: Run = burgeon::run(&script, options(threads)).unwrap();
        assert!(run.scene.triangles() > 100, "{} triangles", run.scene.triangles());
        assert!(run.systems[0].steps >= 2, "rules have asked it");
        let path = folder.path().join(format!("{threads}.glb"));
        burgeon::export::write(&run.scene, &path, &Picture::default()).unwrap();
        std::fs::read(path).unwrap()
    };
    let one = bytes(1);
    assert_eq!(one, bytes(2));
    assert!(LOOKED_FOR.load(Ordering::Relaxed) > 0, "a prefetch was handed out");
    assert!(EXPANSIONS.load(Ordering::Relaxed) > 0, "it expanded by itself");
}

#[test]
fn a_triangle_of_it_names_the_module_that_drew_it() {
    let (_folder, script) = folder();
    let options = options(1);
    let run = burgeon::run(&script, options.clone()).unwrap();
    let picked = pick(&script, &options, &run.scene, Pick { instance: 0, part: 0, triangle: 3 }).unwrap();
    let drawn = picked.drawn.unwrap();
    assert_eq!(drawn.interpretation.unwrap().text.as_ref() as &str, "Grow(r)");
    let path: Vec<&str> = drawn.path.iter().map(|ancestor| &*ancestor.module.text).take(3).collect();
    assert_eq!(path, ["Grow(1)", "Grow(2)", "Grow(3)"]);
    assert!(drawn.runs.iter().map(|run| run.count).sum::<usize>() > 3);
}

#[test]
fn a_script_that_uses_it_can_be_checked_without_expanding_it() {
    let (_folder, script) = folder();
    burgeon::check(&script, options(1)).unwrap();
}

#[test]
fn a_name_that_will_go_warns_once_with_its_line_and_what_is_used_instead() {
    let (_folder, script) = folder();
    let warned = |threads: usize| {
        let mut registry = burgeon::registry();
        let kind = Kind::clone(Orchard::kind());
        let kind = kind.deprecates("trees", "1.4", "orchard:count").deprecates("spacing", "1.5", "distance");
        registry
            .add(kind.deprecates("", "1.6", "grove").deprecates("nearest", "1.7", "orchard:near"))
            .unwrap();
        let run = burgeon::run(&script, RunOptions { registry, ..options(threads) }).unwrap();
        run.warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    };
    let one = warned(1);
    let file = script.display().to_string();
    insta::assert_snapshot!(one.replace(&file, "orchards.lua"), @r"
    orchards.lua:4: orchard is deprecated since version 1.6 of the script API
      help: use grove instead
    orchards.lua:6: orchard.spacing is deprecated since version 1.5 of the script API
      help: use distance instead
    orchards.lua:9: orchard:nearest is deprecated since version 1.7 of the script API
      help: use orchard:near instead
    orchards.lua:9: orchard:trees is deprecated since version 1.4 of the script API
      help: use orchard:count instead
    ");
    assert_eq!(one, warned(2));
    let current = burgeon::run(&script, options(1)).unwrap();
    assert!(!current.warnings.iter().any(|warning| warning.kind() == burgeon::WarningKind::Deprecated));
}

const FUSES: &str = r#"
local land = source("land.geojson")
local Ball, Bud = module("Ball", "radius"), module("Bud")
local fuses = lsystem({ object = fuse })
fuses:axiom(land, function(feature)
  return fuse({ blown = tonumber(feature.id) % 10 == 3 }), Ball(1), Bud()
end)
fuses:rule("Bud", function(this)
  WHERE
  return nil
end)
fuses:interpret("Ball(r)", function(this, r) this:ball(r) end)
fuses:ignore("Bud")
fuses:derive()
"#;

#[test]
fn a_type_that_panics_costs_only_its_own_chain_and_is_told() {
    for rule in ["", "this:ask()"] {
        let (_folder, script) = folder();
        std::fs::write(&script, FUSES.replace("WHERE", rule)).unwrap();
        for threads in [1, 2] {
            let run = burgeon::run(&script, options(threads)).unwrap();
            let system = &run.systems[0];
            assert_eq!(system.features.len() - run.scene.instances.len(), 30, "{rule}");
            let report = run.report();
            let text = format!("{report:?}");
            assert!(text.contains("the fuse is blown"), "{rule}: {text}");
        }
    }
}

const WARNED: &str = r#"
local Ball = module("Ball", "radius")
local torch = object("torch", { extends = fuse })
local lamp = object("lamp", { state = { inner = fuse() }, changes = {
  ball = function(self, radius) self.inner:ball(radius) end
} })
local function balls(object)
  local system = lsystem({ object = object })
  system:axiom(Ball(1), Ball(0))
  system:interpret("Ball(r)", function(this, r) this:ball(r) end)
  system:derive(0)
end
balls(OBJECT())
"#;

#[test]
fn what_it_warns_of_is_told_with_the_line_for_it_and_for_types_that_extend_or_hold_it() {
    let (_folder, script) = folder();
    for (object, line) in [("fuse", 10), ("torch", 10), ("lamp", 5)] {
        std::fs::write(&script, WARNED.replace("OBJECT", object)).unwrap();
        let run = burgeon::run(&script, options(1)).unwrap();
        assert!(run.scene.triangles() > 10, "{object}");
        let told: Vec<String> = run.warnings.iter().map(ToString::to_string).collect();
        assert_eq!(told.len(), 1, "{object}: {told:?}");
        assert!(told[0].contains("a ball without a radius draws nothing"), "{object}: {told:?}");
        assert_eq!(run.warnings[0].place().map(|place| place.line), Some(line), "{object}: {told:?}");
    }
}
