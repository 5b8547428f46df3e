//! Tracing from the image to the script and back.

use serde_json::{Value, json};

use crate::support::{Page, Server, script, triangles};

#[track_caller]
fn ask(page: &mut Page, message: Value) -> Value {
    page.say(&message);
    page.any()
}

fn pick(page: &mut Page, triangle: usize) -> Value {
    ask(
        page,
        json!({ "type": "pick", "id": 1, "mesh": 0, "primitive": 0, "triangle": triangle, "instance": null, "node": 0 }),
    )
}

#[test]
fn a_picked_triangle_names_its_module_and_the_way_from_the_axiom() {
    let server = Server::new(Some(&script(3)));
    let mut page = server.page();
    let model = page.next("model");
    let picked = pick(&mut page, triangles(3) / 2);
    assert_eq!((&picked["type"], &picked["found"]), (&json!("picked"), &json!(true)), "{picked}");
    assert_eq!((&picked["module"]["symbol"], &picked["module"]["text"]), (&json!("S"), &json!("S")));
    assert_eq!(picked["interpretation"], json!({ "text": "S", "file": "s.lua", "line": 6 }));
    let path = picked["path"].as_array().unwrap();
    assert_eq!(
        path[0],
        json!({ "step": 0, "module": "A(3)", "rule": null, "file": "s.lua", "line": 4, "ordinal": 0 })
    );
    assert_eq!((&path[1]["rule"], &path[1]["line"]), (&json!("A(n)"), &json!(5)));
    assert_eq!(picked["chain_text"]["at"], "S");
    let all: u64 = picked["ranges"].as_array().unwrap().iter().map(|it| it["count"].as_u64().unwrap()).sum();
    assert!(all > 0 && all < model["triangles"].as_u64().unwrap());
    for wrong in [triangles(3), usize::MAX] {
        assert_eq!(pick(&mut page, wrong)["type"], "refused");
    }
    let chain = ask(&mut page, json!({ "type": "chain", "id": 2, "system": 0, "chain": 0, "module": 0 }));
    assert_eq!(
        (&chain["id"], &chain["at"], &chain["before"]),
        (&json!(2), &json!("S"), &json!("")),
        "{chain}"
    );
    let far =
        ask(&mut page, json!({ "type": "chain", "id": 2, "system": 0, "chain": 0, "module": 999_999_999 }));
    assert_eq!(far["type"], "chain");
    for (system, chain) in [(1, 0), (0, 1), (usize::MAX, usize::MAX)] {
        let wrong = json!({ "type": "chain", "id": 3, "system": system, "chain": chain, "module": 0 });
        assert_eq!(ask(&mut page, wrong)["type"], "refused");
    }
    server.write("s.lua", "local = 1");
    page.next("error");
    assert!(pick(&mut page, 0)["text"].as_str().unwrap().contains("has changed"));
}

#[test]
fn a_line_shows_what_it_made_and_the_profile_names_the_lines() {
    let server = Server::new(Some(&script(3)));
    let mut page = server.page();
    let model = page.next("model");
    let rules = model["rules"].as_array().unwrap();
    let rule = rules.iter().find(|rule| rule["text"] == "A(n)").unwrap();
    assert_eq!(
        (&rule["kind"], &rule["file"], &rule["line"], &rule["applied"]),
        (&json!("rule"), &json!("s.lua"), &json!(5), &json!(4))
    );
    let system = &model["systems"][0];
    assert_eq!((&system["place"], &system["steps"]), (&json!("s.lua:3"), &model["steps"]));
    assert!(system["symbols"].as_array().unwrap().contains(&json!({ "name": "S", "count": 3 })));
    let lit = ask(&mut page, json!({ "type": "highlight", "id": 5, "file": "s.lua", "line": 6 }));
    assert_eq!(
        (&lit["type"], &lit["modules"], &lit["what"]),
        (&json!("highlighted"), &json!(3), &json!("S")),
        "{lit}"
    );
    let all: u64 = lit["ranges"].as_array().unwrap().iter().map(|it| it["count"].as_u64().unwrap()).sum();
    assert_eq!(all, model["triangles"].as_u64().unwrap());
    let nothing = ask(&mut page, json!({ "type": "highlight", "id": 6, "file": "s.lua", "line": 1 }));
    assert_eq!((&nothing["modules"], &nothing["ranges"]), (&json!(0), &json!([])));
    for (line, says) in [(0, "7 lines"), (8, "unknown line 8"), (4_000_000_000_u64, "7 lines")] {
        let lit = ask(&mut page, json!({ "type": "highlight", "id": 6, "file": "s.lua", "line": line }));
        assert!(lit["text"].as_str().unwrap().contains(says), "{lit}");
    }
    let foreign = ask(&mut page, json!({ "type": "highlight", "id": 7, "file": "/etc/passwd", "line": 1 }));
    assert_eq!((&foreign["type"], &foreign["id"]), (&json!("refused"), &json!(7)));
}

#[test]
fn a_line_of_a_required_file_is_found_by_any_name_that_means_it_alone() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir_all(folder.path().join("a/b")).unwrap();
    let text = "local S = module(\"S\")\nreturn function(s)\n  s:axiom(S(), S())\n                \n  s:interpret(\"S\", function(this) this:forward(1) end)\nend\n";
    std::fs::write(folder.path().join("a/b/parts.lua"), text).unwrap();
    std::fs::write(
        folder.path().join("s.lua"),
        "local s = lsystem({ object = turtle() })\nrequire(\"a/b/parts\")(s)\ns:derive()\n",
    )
    .unwrap();
    // A file written just before the start of the server counts as changed.
    std::thread::sleep(std::time::Duration::from_millis(200));
    let server = Server::start(folder, &[]);
    let mut page = server.page();
    page.next("model");
    for name in ["a/b/parts.lua", "b/parts.lua", "parts.lua"] {
        let lit = ask(&mut page, json!({ "type": "highlight", "id": 1, "file": name, "line": 5 }));
        assert_eq!((&lit["modules"], &lit["what"]), (&json!(2), &json!("S")), "{name}: {lit}");
    }
    let lit = ask(&mut page, json!({ "type": "highlight", "id": 1, "file": "arts.lua", "line": 5 }));
    assert_eq!(lit["type"], "refused", "{lit}");
}
