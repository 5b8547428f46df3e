//! Texts that scripts print, as pages receive them.

use serde_json::{Value, json};

use crate::support::{Page, Server, script};

/// Receives messages until one has the type `kind` and `lines`, if the latter matter.
fn until(page: &mut Page, kind: &str, lines: Option<usize>) -> Value {
    loop {
        let message = page.any();
        let count = message["lines"].as_array().map(Vec::len);
        if message["type"] == kind && (lines.is_none() || count == lines) {
            return message;
        }
    }
}

#[test]
fn printed_texts_come_before_the_model_with_their_lines_and_counts() {
    let text = format!(
        "for i = 1, 3 do print(\"again\") end\nrequire(\"part\")\n{}print({{ a = 1 }}, \"b\")\n",
        script(1)
    );
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.lua"), text).unwrap();
    std::fs::write(folder.path().join("part.lua"), "\nprint(\"from a part\")\n").unwrap();
    let server = Server::start(folder, &[]);
    let mut page = server.page();
    let printed = until(&mut page, "printed", Some(3));
    assert_eq!(
        printed["lines"],
        json!([
            { "text": "again", "file": "s.lua", "line": 1, "count": 3 },
            { "text": "from a part", "file": "part.lua", "line": 2, "count": 1 },
            { "text": "{ a = 1 }\tb", "file": "s.lua", "line": 10, "count": 1 },
        ])
    );
    assert_eq!((&printed["gap"], &printed["left_out"]), (&json!(3), &json!(0)));
    // A page that comes later receives them too, and a run without prints empties the list.
    let mut later = server.page();
    assert_eq!(until(&mut later, "printed", None)["lines"], printed["lines"]);
    until(&mut page, "model", None);
    server.write("s.lua", script(1));
    assert_eq!(until(&mut page, "printed", Some(0))["left_out"], 0);
}

#[test]
fn prints_of_a_run_that_fails_come_before_its_error() {
    let server = Server::new(Some("for i = 1, 1000 do print(i) end\nerror(\"over\")\n"));
    let mut page = server.page();
    let printed = until(&mut page, "printed", Some(500));
    assert_eq!((&printed["gap"], &printed["left_out"]), (&json!(300), &json!(500)));
    assert_eq!(printed["lines"][300]["text"], "801");
    assert!(until(&mut page, "error", None)["text"].as_str().unwrap().contains("over"));
}
