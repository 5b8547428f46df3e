//! Machine-readable codes of errors.

use burgeon::error::ErrorKind;

use super::support::{Folder, HEAD};

/// Returns the exit status and the codes of the errors that `arguments` cause.
fn codes(folder: &Folder, arguments: &[&str]) -> (i32, Vec<String>) {
    let said = folder.burgeon(&[arguments, &["--json"]].concat());
    let document = said.json();
    assert_eq!(document["ok"], false, "{document}");
    let code = |error: &serde_json::Value| error["code"].as_str().unwrap_or_default().to_owned();
    (said.status, document["errors"].as_array().unwrap().iter().map(code).collect())
}

/// Returns the code of the error of a script after [`HEAD`], run with `flags`.
fn code(script: &str, flags: &[&str]) -> String {
    let folder = Folder::new().with("s.lua", format!("{HEAD}{script}\n"));
    let (status, codes) = codes(&folder, &[&["run", "s.lua"], flags].concat());
    assert_eq!((status, codes.len()), (1, 1), "{script}: {codes:?}");
    codes[0].clone()
}

#[test]
fn each_failure_of_a_script_has_the_code_of_its_kind() {
    let grows = "s:rule(\"A(x)\", function(this, x) return A(x), A(x) end) s:derive(30)";
    let draws = "s:rule(\"A(x)\", function(this, x) return F(1), A(x) end) s:derive(30)";
    let cases: &[(&str, &[&str], &str)] = &[
        ("local x = = 3", &[], "syntax"),
        ("s:rule(\"A((x)\", function() end)", &[], "syntax"),
        ("print(flors)", &[], "not-found"),
        ("s:rule(\"C\", function() end)", &[], "not-found"),
        ("local t = turtle({ wdth = 3 })", &[], "not-found"),
        ("source(\"no.geojson\")", &[], "not-found"),
        ("local n = 1\ns:rule(\"A(x)\", function(this, x) n = 2 return B() end)", &[], "scope"),
        ("s:rule(\"A(x)\", function(this, x) this:forward(1) end) s:derive(1)", &[], "scope"),
        ("error(\"broken\")", &[], "script"),
        ("error({})", &[], "script"),
        ("local t = nil + 1", &[], "script"),
        ("A(1, 2)", &[], "argument"),
        ("s:derive(-1)", &[], "argument"),
        ("random(1)", &[], "argument"),
        ("local n = param(\"n\", { default = 3, max = 5 }) s:derive(n)", &["--set", "n=9"], "argument"),
        ("source(\"../out.geojson\")", &[], "file"),
        ("source(\"bad.geojson\")", &[], "data"),
        (grows, &["--module-limit", "1000"], "limit.modules"),
        (draws, &["--triangle-limit", "20"], "limit.triangles"),
        ("while true do end", &["--time-limit", "0.3"], "limit.time"),
        (
            "local t = {} while true do table.insert(t, buffer.create(1000000)) end",
            &["--memory-limit", "64"],
            "limit.memory",
        ),
    ];
    for (script, flags, expected) in cases {
        if script.contains("bad.geojson") {
            let folder =
                Folder::new().with("s.lua", format!("{HEAD}{script}\n")).with("bad.geojson", "{ \"type\": 3");
            assert_eq!(codes(&folder, &["run", "s.lua"]), (1, vec!["data".to_owned()]));
            continue;
        }
        assert_eq!(code(script, flags), *expected, "{script}");
    }
}

#[test]
fn each_failure_of_a_command_has_the_code_of_its_kind() {
    let folder = Folder::new().with("s.lua", format!("{HEAD}s:derive(1)\n"));
    let one = |status: i32, code: &str| (status, vec![code.to_owned()]);
    assert_eq!(codes(&folder, &["run", "s.lua", "--seed", "x"]), one(2, "usage"));
    assert_eq!(codes(&folder, &["fly"]), one(2, "usage"));
    assert_eq!(codes(&folder, &["run", "t.lua"]), one(1, "not-found"));
    assert_eq!(codes(&folder, &["run", "s.lua", "--set", "n=1"]), one(1, "not-found"));
    assert_eq!(codes(&folder, &["run", "s.lua", "-o", "no/a.glb"]), one(1, "file"));
    assert_eq!(codes(&folder, &["new", "s.lua"]), one(1, "file"));
    assert_eq!(codes(&folder, &["sources", "t.gpkg"]), one(1, "not-found"));
    assert_eq!(codes(&folder, &["fit", "mountain", "-o", "rules.lua"]), one(1, "not-found"));
}

#[test]
fn a_warning_that_ends_a_strict_run_has_its_own_code() {
    let folder = Folder::new().with("s.lua", format!("{HEAD}s:derive(1) s:derive(1)\n"));
    let (status, codes) = codes(&folder, &["run", "s.lua", "--strict"]);
    assert_eq!((status, codes.last().map(String::as_str)), (1, Some("warning.derived-twice")));
    let run = folder.burgeon(&["run", "s.lua", "--json"]).done().json();
    let warned = run["warnings"].as_array().unwrap().last().unwrap();
    assert_eq!(
        (&warned["code"], &warned["kind"]),
        (&"warning.derived-twice".into(), &"derived-twice".into())
    );
}

#[test]
fn all_problems_of_a_script_have_their_own_codes() {
    let script = "print(flors)\nlocal n = 1\ns:rule(\"A(x)\", function(this, x) n = 2 return B() end)";
    let folder = Folder::new().with("s.lua", format!("{HEAD}{script}\n"));
    let (_, codes) = codes(&folder, &["check", "s.lua"]);
    assert_eq!(codes, ["not-found", "scope"]);
    assert!(codes.iter().all(|code| ErrorKind::CODES.iter().any(|(known, _)| known == code)));
}
