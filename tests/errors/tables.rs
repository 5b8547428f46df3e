//! Numbers that interpretations report: sums by feature, `.csv` files and totals.

use serde_json::json;

use crate::support::Folder;

/// Three features whose chains grow for four steps; each drawing reports again.
const SCRIPT: &str = r#"local A, B = module("A", "n"), module("B", "n")
local s = lsystem({ object = turtle() })
local list = { { id = "one", n = 1 }, { id = "a \"b\", </script> 🌱", n = 2 }, { id = "three", n = 3 } }
s:axiom(source(list), function(feature) return A(feature.n) end)
s:rule("A(n)", function(this, n) return A(n), B(n) end)
s:interpret("B(n)", function(this, n)
  this:forward(1)
  report("length, m", 0.5 * n)
  if n > 2 then report("long", 1) end
end)
s:derive(4)
"#;

#[test]
fn the_sums_are_those_of_the_last_drawing_by_feature() {
    let folder = Folder::new().with("s.lua", SCRIPT);
    let csv = |arguments: &[&str]| {
        folder.burgeon(&[&["run", "s.lua", "-o", "a.csv"], arguments].concat()).done();
        folder.read("a.csv")
    };
    let expected =
        "system,feature,\"length, m\",long\n1,one,2,\n1,\"a \"\"b\"\", </script> 🌱\",4,\n1,three,6,4\n";
    assert_eq!(csv(&[]), expected);
    assert_eq!(csv(&["--threads", "4", "--batch", "2"]), expected);
    assert_eq!(
        csv(&["--steps", "1"]),
        "system,feature,\"length, m\",long\n1,one,0.5,\n1,\"a \"\"b\"\", </script> 🌱\",1,\n1,three,1.5,1\n"
    );
    // A rule that asks the object needs a drawing of each chain.
    let asking = SCRIPT.replace("return A(n), B(n)", "return A(n + 0 * this:position().x), B(n)");
    let folder = Folder::new().with("s.lua", asking);
    folder.burgeon(&["run", "s.lua", "-o", "a.csv"]).done();
    assert_eq!(folder.read("a.csv"), expected);
}

#[test]
fn the_summary_and_the_document_have_the_totals() {
    let folder = Folder::new().with("s.lua", SCRIPT);
    let said = folder.burgeon(&["run", "s.lua"]).done().stderr;
    assert!(said.contains("reported length, m: 12 in 3 chains"), "{said}");
    let document = folder.burgeon(&["run", "s.lua", "--json"]).done().json();
    assert_eq!(
        document["reports"],
        json!({ "length, m": { "sum": 12.0, "count": 12, "chains": 3 }, "long": { "sum": 4.0, "count": 4, "chains": 1 } })
    );
    let part = folder.burgeon(&["run", "s.lua", "--part", "3/3", "--reach", "10", "--json"]).done().json();
    assert_eq!(part["reports"]["length, m"], json!({ "sum": 6.0, "count": 4, "chains": 1 }));
}

#[test]
fn only_interpretations_report_and_only_finite_numbers_with_a_name() {
    let head = "local A = module(\"A\") local s = lsystem({ object = turtle() }) s:axiom(A())\n";
    let said = |text: &str| {
        Folder::new().with("s.lua", format!("{head}{text}\ns:derive(1)")).burgeon(&["run", "s.lua"]).failed()
    };
    assert!(said("report(\"a\", 1)").contains("the top level of the script cannot report"));
    assert!(
        said("s:rule(\"A\", function() report(\"a\", 1) return A() end)").contains("a rule cannot report")
    );
    let drawn = |call: &str| said(&format!("s:interpret(\"A\", function(this) {call} end)"));
    assert!(drawn("report(\"a\", 0 / 0)").contains("takes a finite number for a"));
    assert!(drawn("report(\"a\", \"1\")").contains("takes a finite number for a"));
    assert!(drawn("report(\"\", 1)").contains("takes the name of a number"));
    assert!(drawn("report(1, 1)").contains("takes the name of a number"));
}

#[test]
fn a_table_without_numbers_is_a_warning() {
    let script = "local A = module(\"A\") local s = lsystem({ object = turtle() }) s:axiom(A())\ns:interpret(\"A\", function(this) this:forward(1) end)\ns:derive(1)";
    let folder = Folder::new().with("s.lua", script);
    let warned = folder.warned(&["run", "s.lua", "-o", "a.csv"]);
    assert!(warned.contains("no numbers to write"), "{warned}");
}
