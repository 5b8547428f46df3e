//! Namespaces of packages: random sets of packages whose modules, types, methods and parameters have equal
//! names, used together in one script.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::sync::{Arc, Mutex};

use burgeon::script::{ParamValues, Print, RunOptions};
use proptest::prelude::*;

use crate::packages::{about, castle, prints};
use crate::support::Folder;

const PACKAGES: [&str; 4] = ["alpha", "beta", "gamma-rays", "delta_2"];
const MODULES: [&str; 3] = ["Stone", "Wall", "F"];
const TYPES: [&str; 2] = ["turret", "gate"];
const METHODS: [&str; 2] = ["mark", "tell"];
const PARAMS: [&str; 2] = ["size", "tint"];

/// Declarations of a package, each with a number that distinguishes it from the declarations of other
/// packages.
#[derive(Debug, Clone)]
struct Declared {
    /// Modules, each with its number of parameters.
    modules: BTreeMap<usize, usize>,
    types: BTreeSet<usize>,
    methods: BTreeSet<usize>,
    params: BTreeSet<usize>,
    needs: BTreeSet<usize>,
}

fn declared() -> impl Strategy<Value = Declared> {
    let set = |most: usize| prop::collection::btree_set(0..most, 0..=most);
    (
        prop::collection::btree_map(0..MODULES.len(), 1..3_usize, 0..=MODULES.len()),
        set(TYPES.len()),
        set(METHODS.len()),
        set(PARAMS.len()),
        prop::collection::btree_set(0..PACKAGES.len(), 0..2),
    )
        .prop_map(|(modules, types, methods, params, needs)| Declared {
            modules,
            types,
            methods,
            params,
            needs,
        })
}

fn parameters(count: usize) -> &'static str {
    if count == 1 { "w" } else { "w, h" }
}

/// Returns the script of the package `number`, which declares everything and uses it by plain names.
fn init(number: usize, of: &Declared) -> String {
    let mut text = String::from("local M = {}\n");
    // A package requires only packages with lower numbers, so use no cycles.
    for other in of.needs.iter().filter(|other| **other < number) {
        let _ = writeln!(text, "require(\"@{}\")", PACKAGES[*other]);
    }
    for (module, count) in &of.modules {
        let name = MODULES[*module];
        let quoted = parameters(*count).split(", ").map(|it| format!(", \"{it}\"")).collect::<String>();
        let _ = writeln!(text, "M.{name} = module(\"{name}\"{quoted})");
    }
    for kind in &of.types {
        let name = TYPES[*kind];
        let _ = writeln!(
            text,
            "M.{name} = object(\"{name}\", {{ extends = extruder, reads = {{ id = function(self) return {number} end }} }})"
        );
    }
    let functions: String = of
        .methods
        .iter()
        .map(|it| format!("{} = function(self) return {number} end, ", METHODS[*it]))
        .collect();
    let _ = writeln!(text, "extend(extruder, {{ reads = {{ {functions} }} }})");
    for param in &of.params {
        let name = PARAMS[*param];
        let _ = writeln!(text, "M.{name} = param(\"{name}\", {{ default = {number} }})");
    }
    for (module, count) in &of.modules {
        let (name, ones) = (MODULES[*module], ["1", "1, 1"][count - 1]);
        let methods: String = of
            .methods
            .iter()
            .map(|it| format!(" print(\"own method\", {number}, this:{}())", METHODS[*it]))
            .collect();
        let _ = writeln!(
            text,
            "do local s = lsystem({{ object = extruder() }})\n s:axiom(M.{name}({ones}))\n\
             s:rule(\"{name}({})\", [[ if w < 3 then return {name}({}) end ]])\n\
             s:interpret(\"{name}\", function(this){methods} this:extrude(1) end)\n\
             print(\"own module\", {number}, #s:derive().chains[1])\n\
             local copies = lsystem({{ object = extruder() }})\n\
             copies:axiom(query(\"select * from {name}\", M.{name}))\n\
             copies:derive(0)\n\
             local rows = query(\"select a.w as w from {name} a, {name} where a.w = {name}.w order by 1\")\n\
             print(\"rows\", {number} * 10 + {module}, #rows, rows[1].w, #query(\"{name}\")) end",
            parameters(*count),
            ["w + 1", "w + 1, h"][count - 1],
        );
    }
    text + "return M\n"
}

/// Returns the packages that are loaded when `required` are required, in order.
fn loaded(packages: &[Declared], required: &[usize]) -> Vec<usize> {
    fn load(packages: &[Declared], package: usize, all: &mut Vec<usize>) {
        if !all.contains(&package) {
            packages[package]
                .needs
                .iter()
                .filter(|it| **it < package)
                .for_each(|it| load(packages, *it, all));
            all.push(package);
        }
    }
    let mut all = Vec::new();
    required.iter().for_each(|it| load(packages, *it, &mut all));
    all
}

/// Returns which of the `owners` of a name the script refers to, after requiring `required`.
fn meant(owners: &[usize], required: &[usize]) -> Option<usize> {
    let near: Vec<usize> = owners.iter().filter(|it| required.contains(it)).copied().collect();
    match (owners, near.as_slice()) {
        ([one], _) | (_, [one]) => Some(*one),
        _ => None,
    }
}

fn folder(packages: &[Declared], script: &str) -> Folder {
    let mut folder = Folder::new().with("s.lua", script);
    for (number, package) in packages.iter().enumerate() {
        let needs: String = package
            .needs
            .iter()
            .filter(|it| **it < number)
            .map(|it| format!("{} = \"1\"\n", PACKAGES[*it]))
            .collect();
        let name = PACKAGES[number];
        folder = folder
            .with(&format!("mods/{name}/mod.toml"), about(name, &format!("[depends]\n{needs}")))
            .with(&format!("mods/{name}/init.lua"), init(number, package));
    }
    folder
}

/// Returns the output of a script, or its error message.
fn run(folder: &Folder, set: Vec<(String, String)>) -> Result<Vec<String>, String> {
    let printed = Arc::new(Mutex::new(Vec::new()));
    let into = Arc::clone(&printed);
    let base = burgeon::options();
    let print = Print::new(move |text| into.lock().unwrap().push(text.to_owned()));
    let options = RunOptions {
        params: ParamValues::from(set),
        reports: burgeon::script::RunReports { print: Some(print), ..base.reports.clone() },
        threads: Some(2),
        ..base
    };
    let made = burgeon::run(&folder.path().join("s.lua"), options);
    made.map_err(|error| error.to_string())?;
    Ok(std::mem::take(&mut *printed.lock().unwrap()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn packages_with_equal_names_work_together(
        packages in prop::collection::vec(declared(), PACKAGES.len()),
        order in Just((0..PACKAGES.len()).collect::<Vec<_>>()).prop_shuffle(),
        count in 1..=PACKAGES.len(),
        values in prop::collection::vec((0..=PACKAGES.len(), 0..PARAMS.len()), 0..3),
    ) {
        let required = &order[..count];
        let all = loaded(&packages, required);
        let (mut script, mut expected) = (String::from("local all = {}\n"), Vec::new());
        for package in required {
            let _ = writeln!(script, "all[{package}] = require(\"@{}\")", PACKAGES[*package]);
        }
        let mut errors = Vec::new();
        script += "local s = lsystem({ object = extruder() })\nlocal Ask = module(\"Ask\")\ns:axiom(Ask())\n";
        let mut body = String::new();
        for (method, name) in METHODS.iter().enumerate() {
            let owners: Vec<usize> = all.iter().copied().filter(|it| packages[*it].methods.contains(&method)).collect();
            for owner in &owners {
                let _ = write!(body, " print(\"full method\", this:{}_{name}())", PACKAGES[*owner].replace('-', "_"));
                expected.push(format!("full method\t{owner}"));
            }
            match meant(&owners, required) {
                Some(owner) => {
                    let _ = write!(body, " print(\"method\", this:{name}())");
                    expected.push(format!("method\t{owner}"));
                }
                None if owners.len() > 1 => errors.push((format!("this:{name}()"), format!("{name} is a method of"), owners)),
                None => {}
            }
        }
        let _ = writeln!(script, "s:interpret(\"Ask\", function(this){body} this:extrude(1) end)");
        for (module, name) in MODULES.iter().enumerate() {
            let owners: Vec<usize> = all.iter().copied().filter(|it| packages[*it].modules.contains_key(&module)).collect();
            for owner in owners.iter().filter(|it| required.contains(it)) {
                let count = packages[*owner].modules[&module];
                let (ones, full) = (["1", "1, 1"][count - 1], PACKAGES[*owner]);
                let _ = writeln!(
                    script,
                    "do local t = lsystem({{ object = extruder() }}) t:axiom(all[{owner}].{name}({ones}))\n\
                     t:rule(\"{full}.{name}({})\", function(this, w) if w < 4 then return all[{owner}].{name}({}) end end)\n\
                     t:interpret(\"{full}.{name}\", function(this) this:extrude(1) end) t:derive() end",
                    parameters(count), ["w + 1", "w + 1, 1"][count - 1],
                );
            }
            for owner in &all {
                if packages[*owner].modules.contains_key(&module) {
                    // The chain has a module whose first parameter has grown to 3, and a copy of it.
                    expected.push(format!("rows\t{}\t4\t3\t2", owner * 10 + module));
                }
            }
            for owner in owners.iter().filter(|it| required.contains(it)) {
                // Qualified names include the modules that the script has made.
                let full = PACKAGES[*owner];
                let _ = writeln!(script, "print(\"seen\", {owner}, #query([[select w from \"{full}\".{name}]]), #query(\"{full}.{name}\"))");
                expected.push(format!("seen\t{owner}\t3\t3"));
            }
            if *name == "F" {
                continue;
            }
            match meant(&owners, required) {
                Some(owner) => {
                    let _ = writeln!(script, "print(\"plain\", {owner}, #query(\"{name}\"))");
                    expected.push(format!("plain\t{owner}\t{}", if required.contains(&owner) { 3 } else { 2 }));
                }
                None if owners.len() > 1 => errors.push((format!("query(\"{name}\")"), format!("{name} is a module of"), owners.clone())),
                None => {}
            }
            match meant(&owners, required) {
                Some(owner) => {
                    let _ = writeln!(script, "lsystem({{ object = extruder() }}):rule(\"{name}({})\", function() end)", parameters(packages[owner].modules[&module]));
                }
                None if owners.len() > 1 => errors.push((format!("lsystem():rule(\"{name}\", function() end)"), format!("{name} is a module of"), owners)),
                None => {}
            }
        }
        for (kind, name) in TYPES.iter().enumerate() {
            for owner in required.iter().filter(|it| packages[**it].types.contains(&kind)) {
                let _ = writeln!(script, "print(\"type\", all[{owner}].{name}():id())");
                expected.push(format!("type\t{owner}"));
            }
        }
        // Parameter values, some of them by plain names.
        let mut set: BTreeMap<String, usize> = BTreeMap::new();
        for (index, (owner, param)) in values.iter().enumerate() {
            let name = PARAMS[*param];
            let full = PACKAGES.get(*owner).map_or(name.to_owned(), |owner| format!("{owner}.{name}"));
            set.insert(full, 100 + index);
        }
        let owners_of = |param: usize| all.iter().copied().filter(|it| packages[*it].params.contains(&param)).collect::<Vec<_>>();
        let mut wrong = Vec::new();
        for name in set.keys() {
            let is_known = match name.split_once('.') {
                Some((package, short)) => {
                    let package = PACKAGES.iter().position(|it| *it == package).unwrap();
                    owners_of(PARAMS.iter().position(|it| *it == short).unwrap()).contains(&package)
                }
                None => owners_of(PARAMS.iter().position(|it| it == name).unwrap()).len() == 1,
            };
            if !is_known {
                wrong.push(name.clone());
            }
        }
        for package in required {
            for param in &packages[*package].params {
                let name = PARAMS[*param];
                let full = format!("{}.{name}", PACKAGES[*package]);
                let value = set.get(&full).or_else(|| set.get(name)).copied().unwrap_or(*package);
                let _ = writeln!(script, "print(\"param\", all[{package}].{name})");
                expected.push(format!("param\t{value}"));
            }
        }
        script += "s:derive()\n";
        let folder = folder(&packages, &script);
        let given: Vec<(String, String)> = set.iter().map(|(name, value)| (name.clone(), value.to_string())).collect();
        let ran = run(&folder, given);
        if !wrong.is_empty() {
            let error = ran.expect_err("a parameter that there is not, or that use several of");
            prop_assert!(wrong.iter().any(|name| error.contains(name)) && error.contains("help: "), "{}", error);
            return Ok(());
        }
        let printed = match ran {
            Ok(printed) => printed,
            Err(error) => return Err(TestCaseError::fail(format!("{error}\n{script}\n{packages:?}"))),
        };
        for line in printed.iter().filter(|line| line.starts_with("own method")) {
            let numbers: Vec<&str> = line.split('\t').skip(1).collect();
            prop_assert_eq!(numbers[0], numbers[1], "{}", line);
        }
        let mut told: Vec<String> = printed.into_iter().filter(|line| !line.starts_with("own")).collect();
        // A chain can be interpreted more than once.
        told.sort();
        told.dedup();
        expected.sort();
        expected.dedup();
        prop_assert_eq!(told, expected, "{}", script);
        // The error for an ambiguous name lists all candidates and their qualified names.
        if let Some((call, message, owners)) = errors.into_iter().next() {
            let draws = call.starts_with("this");
            let wrong = if draws { format!("s:interpret(\"Ask2\", function(this) {call} end) s:derive()\n") } else { format!("{call}\n") };
            let requires: String = required.iter().map(|it| format!("require(\"@{}\")\n", PACKAGES[*it])).collect();
            let script = format!("{requires}local s = lsystem({{ object = extruder() }})\nlocal Ask2 = module(\"Ask2\")\ns:axiom(Ask2())\n{wrong}");
            let folder = folder.with("s.lua", script);
            let error = run(&folder, Vec::new()).expect_err("one of several");
            prop_assert!(error.contains(&message), "{}", error);
            let named = owners.iter().all(|owner| error.contains(PACKAGES[*owner]) || error.contains(&PACKAGES[*owner].replace('-', "_")));
            prop_assert!(named && error.contains("specify one"), "{}", error);
        }
    }
}

/// Returns a folder with two packages that both contain the declarations `lua`.
fn two(lua: &str, script: &str) -> Folder {
    castle("")
        .with("mods/castle/init.lua", lua.replace("ID", "1"))
        .with("mods/towers/mod.toml", about("towers", ""))
        .with("mods/towers/init.lua", lua.replace("ID", "2"))
        .with("s.lua", format!("local castle, towers = require(\"@castle\"), require(\"@towers\")\n{script}"))
}

#[test]
fn what_may_be_one_of_several_is_told_with_what_to_write() {
    let lua = "extend(extruder, { changes = { turret = function(self, h) self:extrude(h * ID) end } })\n\
               return { Stone = module(\"Stone\", \"w\"), size = param(\"size\", { default = ID }) }";
    let draw = |call: &str| {
        format!(
            "local s = lsystem({{ object = extruder() }})\ns:axiom(castle.Stone(1))\ns:interpret(\"castle.Stone\", function(this) {call} end)\ns:derive()"
        )
    };
    insta::assert_snapshot!(two(lua, &draw("this:turret(1)")).refuses(&["run", "s.lua"]), @r#"
    error: s.lua:4:49: rule castle.Stone (interpretation): turret is a method of extruder added by castle and towers
      | s:interpret("castle.Stone", function(this) this:turret(1) end)
      |                                                 ^^^^^^
      module: castle.Stone(1), step 0
      help: specify one: this:castle_turret(...) or this:towers_turret(...)
    "#);
    insta::assert_snapshot!(
        two(lua, "lsystem():rule(\"Stone(w)\", function() end)").refuses(&["run", "s.lua"]), @r#"
    error: s.lua:2:17: Stone is a module of castle and of towers in the pattern "Stone(w)"
      | lsystem():rule("Stone(w)", function() end)
      |                 ^^^^^^^^
      help: specify one: castle.Stone or towers.Stone
    "#);
    insta::assert_snapshot!(
        two(lua, "lsystem():rule(\"castle.Stole(w)\", function() end)").refuses(&["run", "s.lua"]), @r#"
    error: s.lua:2:17: unknown symbol castle.Stole in the pattern "castle.Stole(w)"
      | lsystem():rule("castle.Stole(w)", function() end)
      |                 ^^^^^^^^^^^^^^^
      help: did you mean castle.Stone?
    "#);
    insta::assert_snapshot!(
        two(lua, "lsystem():rule(\"castle.Stone(w)\", \"return Stone(w)\")").refuses(&["run", "s.lua"]), @r#"
    error: s.lua:2:1: rule castle.Stone(w): Stone is a module of castle and of towers
      | lsystem():rule("castle.Stone(w)", "return Stone(w)")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: return it from a function, with a constructor of the package: function(this) return stone(1) end
    "#);
    insta::assert_snapshot!(two(lua, "").refuses(&["run", "s.lua", "--set", "size=9"]), @r#"
    error: mods/towers/init.lua:2:40: size is a parameter of castle and of towers
      | return { Stone = module("Stone", "w"), size = param("size", { default = 2 }) }
      |                                        ^^^^
      called at s.lua:1
      help: specify one: --set castle.size=VALUE or --set towers.size=VALUE
    "#);
    insta::assert_snapshot!(two(lua, "").refuses(&["run", "s.lua", "--set", "castle.sizes=9"]), @r"
    error: s.lua: unknown parameter `castle.sizes`
      help: did you mean castle.size?
    ");
    let fine = two(
        lua,
        &format!("{} print(castle.size, towers.size)", draw("this:castle_turret(1):towers_turret(1)")),
    );
    assert_eq!(prints(&fine, &["--set", "castle.size=9"]), "9\t2\n");
    fine.burgeon(&["check", "s.lua"]).done();
    // A plain name denotes the script's own parameter, even if it is declared later.
    let own = two(
        lua,
        &format!(
            "print(castle.size, towers.size, param(\"size\", {{ default = 5 }}))\n{}",
            draw("this:castle_turret(1)")
        ),
    );
    assert_eq!(prints(&own, &["--set", "size=7", "--set", "towers.size=8"]), "1\t8\t7\n");
    let document = fine.burgeon(&["run", "s.lua", "--json", "--set", "towers.size=3"]).done().json();
    assert_eq!(document["params"]["towers.size"], 3.0);
}

#[test]
fn the_packages_of_a_run_are_locked_in_its_summary_and_in_its_model() {
    let folder = castle("[depends]\nmasonry = \"1\"")
        .with("mods/masonry/mod.toml", about("masonry", ""))
        .with("mods/unused/mod.toml", about("unused", ""))
        .with("mods/broken/mod.toml", "nonsense");
    let run = |folder: &Folder, output: &str| {
        folder.burgeon(&["run", "s.lua", "--json", "-o", output]).done().json()
    };
    let locked = run(&folder, "a.gltf")["packages"].clone();
    assert_eq!(
        (&locked[0]["name"], &locked[1]["name"], &locked[2]),
        (&"masonry".into(), &"castle".into(), &serde_json::Value::Null)
    );
    assert!(locked[1]["hash"].as_str().unwrap().starts_with("blake3:") && locked[1]["version"] == "1.0.0");
    let model: serde_json::Value =
        serde_json::from_slice(&std::fs::read(folder.path().join("a.gltf")).unwrap()).unwrap();
    assert_eq!(model["asset"]["extras"]["packages"], locked);
    for (output, mark) in [
        ("a.x3d", "<meta name='package' content='castle 1.0.0 blake3:"),
        ("a.obj", "# package castle 1.0.0 blake3:"),
    ] {
        run(&folder, output);
        assert!(std::fs::read_to_string(folder.path().join(output)).unwrap().contains(mark), "{output}");
    }
    let folder = folder.with("mods/unused/a.lua", "return 1");
    assert_eq!(run(&folder, "a.gltf")["packages"], locked);
    let folder = folder.with("mods/castle/towers.lua", "return { height = 13, name = \"castle\" }\n");
    let other = run(&folder, "a.gltf")["packages"].clone();
    assert_eq!(other[0], locked[0]);
    assert_ne!(other[1]["hash"], locked[1]["hash"]);
}

#[test]
fn a_package_is_switched_off_and_on() {
    let folder = castle("").with("other.lua", "print(1)");
    insta::assert_snapshot!(folder.burgeon(&["mods", "disable", "castle"]).done().stderr, @"disabled castle in mods/disabled.txt; to enable it: burgeon mods enable castle");
    insta::assert_snapshot!(folder.refuses(&["run", "s.lua"]), @r#"
    error: s.lua:1:1: the package castle is disabled in mods/disabled.txt
      | local towers = require("@castle/towers")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: enable it: burgeon mods enable castle
    "#);
    insta::assert_snapshot!(folder.burgeon(&["mods"]).done().stdout, @"disabled: castle 1.0.0 in mods/castle");
    insta::assert_snapshot!(folder.refuses(&["mods", "disable", "castel"]), @r"
    error: unknown package `castel`
      help: did you mean castle?
    ");
    folder.burgeon(&["run", "other.lua"]).done();
    folder.burgeon(&["mods", "enable", "castle"]).done();
    assert_eq!(prints(&folder, &[]), "12\tcastle\n");
    assert!(!folder.path().join("mods/disabled.txt").exists());
}

#[cfg(unix)]
#[test]
fn links_to_checkouts_are_used_and_never_replaced() {
    use std::os::unix::fs::symlink;
    let folder = castle("")
        .with("work/mod.toml", about("castle", ""))
        .with("work/towers.lua", "return { height = 5, name = \"work\" }");
    std::fs::remove_dir_all(folder.path().join("mods/castle")).unwrap();
    symlink("../work", folder.path().join("mods/castle")).unwrap();
    assert_eq!(prints(&folder, &[]), "5\twork\n");
    let other = folder.with("new/mod.toml", about("castle", ""));
    insta::assert_snapshot!(other.refuses(&["mods", "add", "new", "--replace"]), @r"
    error: mods/castle is a link, so it is not replaced
      help: move it away, or remove it yourself; then add the package again
    ");
    assert!(other.path().join("work/towers.lua").exists());
    std::fs::remove_dir_all(other.path().join("work")).unwrap();
    insta::assert_snapshot!(other.refuses(&["run", "s.lua"]), @r#"
    error: s.lua:1:1: mods/castle is a broken link
      | local towers = require("@castle/towers")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: remove it, or replace it by a package
    "#);
}

#[test]
fn what_is_no_package_is_never_deleted_and_what_is_missing_is_told() {
    let folder = Folder::new()
        .with("work/mod.toml", about("castle", "[depends]\nmasonry = \"1\""))
        .with("mods/castle/diary.txt", "dear");
    insta::assert_snapshot!(folder.refuses(&["mods", "add", "work"]), @r#"
    error: work/mod.toml:5:1: the package castle needs masonry ^1, which is not installed
      | masonry = "1"
      | ^^^^^^^
      help: install it next to the other packages: burgeon mods add FOLDER
    "#);
    let folder = folder.with("mods/masonry/mod.toml", about("masonry", ""));
    insta::assert_snapshot!(folder.refuses(&["mods", "add", "work", "--replace"]), @r"
    error: mods/castle is not a package, so it is not replaced
      help: move it away, or remove it yourself; then add the package again
    ");
    let folder = folder.with("mods/castle/mod.toml", about("other", ""));
    insta::assert_snapshot!(folder.refuses(&["mods", "add", "work", "--replace"]), @r"
    error: mods/castle is the package other, so it is not replaced
      help: move it away, or remove it yourself; then add the package again
    ");
    let folder = folder.with("mods/castle/mod.toml", about("castle", "")).with("mods/castle/.git/HEAD", "x");
    insta::assert_snapshot!(folder.refuses(&["mods", "add", "work", "--replace"]), @r"
    error: mods/castle is a checkout with a folder .git, so it is not replaced
      help: move it away, or remove it yourself; then add the package again
    ");
    assert_eq!(std::fs::read_to_string(folder.path().join("mods/castle/diary.txt")).unwrap(), "dear");
    std::fs::remove_dir_all(folder.path().join("mods/castle/.git")).unwrap();
    folder.burgeon(&["mods", "add", "work", "--replace"]).done();
    let folder = folder.with("work/mod.toml", about("castle", "[depends]\nmasonry = \"2\""));
    insta::assert_snapshot!(folder.refuses(&["mods", "add", "work", "--replace"]), @r#"
    error: work/mod.toml:5:1: the package castle needs masonry ^2, but 1.0.0 is in mods/masonry
      | masonry = "2"
      | ^^^^^^^
      help: install a masonry of that version
    "#);
}
